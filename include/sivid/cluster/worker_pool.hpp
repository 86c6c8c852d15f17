// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_WORKER_POOL_HPP
#define SIVID_CLUSTER_WORKER_POOL_HPP

#include <sivid/cluster/identity.hpp>
#include <sivid/cluster/transport.hpp>
#include <sivid/cluster/worker.hpp>
#include <sivid/work_limit.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace sivid::cluster {

/// A worker that must not take part: another program, another problem.
struct worker_mismatch : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

/// What handing out took.
struct traffic {
    std::size_t requests = 0;
    std::size_t messages = 0;   ///< both ways
    std::size_t bytes_sent = 0; ///< to workers
    std::size_t bytes_received = 0;
    double asking = 0; ///< seconds in which the coordinator waited for answers
    double worked = 0; ///< seconds of the processor that workers worked on them, summed up
};

/// The coordinator's view of those who work for it. Requests go to whoever is free, or to the one
/// they are meant for; a worker is sent a second one while it works, so that it need not wait.
/// Members join as soon as they have shown that they run the same program on the same problem.
class worker_pool {
public:
    struct task {
        /// The request, written when it is known to whom.
        std::function<std::string(std::size_t worker)> request;
        std::optional<std::size_t> meant_for = std::nullopt;
    };
    struct answer {
        std::string body;
        std::size_t worker = 0;
        double seconds = 0;     ///< of the processor that the worker took
        bool cut_short = false; ///< told to stop, it need not have finished
    };
    /// How tasks are handed out.
    struct manner {
        std::size_t ahead = 2; ///< requests that a worker has at most, one of them being worked on
        double patience = 10;  ///< seconds in which workers may end what is no longer wanted
        std::function<void(std::size_t task, answer const&)> arrived = nullptr;
    };
    /// By task; empty where none came before the patience ended.
    using answers = std::vector<std::optional<answer>>;

    /// @param workers  all others of that transport; is referred to
    worker_pool(transport& workers, identity who)
        : transport_(&workers),
          who_(std::move(who)),
          present_(workers.others()),
          busy_(workers.others()) {}
    worker_pool(worker_pool const&) = delete;
    worker_pool& operator=(worker_pool const&) = delete;

    [[nodiscard]] std::size_t size() const { return present_.size(); }
    /// Whether a worker has shown that it may take part.
    [[nodiscard]] bool is_present(std::size_t worker) const { return present_[worker] != 0; }
    [[nodiscard]] sivid::cluster::traffic const& traffic() const { return traffic_; }

    /// Tells all workers what the work is about.
    /// @param mine  what must be the same there, beside the program
    void begin(std::string_view about, identity mine) {
        expected_ = who_;
        for (auto& p : mine.parts) expected_.parts.push_back(std::move(p));
        hello_ = about;
        hail();
    }

    /// Has tasks done. Once `go_on` is false nothing more is handed out, workers are told to stop,
    /// and what they have by then is waited for.
    /// @throws worker_mismatch, std::runtime_error (a worker's fault)
    [[nodiscard]] answers ask(std::vector<task> const& tasks, std::function<bool()> const& go_on,
                              manner const& how) {
        stopwatch const watch;
        if (stopped_ && go_on()) hail();
        answers done(tasks.size());
        std::size_t left = tasks.size();
        std::deque<std::size_t> common;
        std::vector<std::deque<std::size_t>> own(size());
        for (std::size_t k = 0; k < tasks.size(); ++k) {
            (tasks[k].meant_for ? own[*tasks[k].meant_for] : common).push_back(k);
        }
        std::map<std::uint64_t, std::size_t> sent; // numbers, and which task
        std::optional<clock::time_point> end;
        patience rest;
        while (left > 0) {
            for (std::size_t most = 1; most <= how.ahead && !stopped_; ++most) {
                for (std::size_t m = 0; m < size(); ++m) {
                    if (!present_[m] || busy_[m] >= most) continue;
                    auto& list = own[m].empty() ? common : own[m];
                    if (list.empty()) continue;
                    auto const k = list.front();
                    list.pop_front();
                    sent[++number_] = k;
                    ++busy_[m];
                    ++traffic_.requests;
                    send(m, {message::kind::ask, number_, tasks[k].request(m)});
                }
            }
            while (auto letter = transport_->receive()) {
                rest.renew();
                auto got = taken(*letter);
                if (!got) continue;
                auto const which = sent.find(got->first);
                if (which == sent.end()) continue; // waited for in vain, once
                if (how.arrived) how.arrived(which->second, got->second);
                done[which->second] = std::move(got->second);
                sent.erase(which);
                --left;
            }
            if (left == 0) break;
            if (!stopped_ && !go_on()) stop();
            if (stopped_) {
                if (!end) {
                    end = clock::now() + std::chrono::duration_cast<clock::duration>(
                                             std::chrono::duration<double>(how.patience));
                }
                if (sent.empty() || clock::now() > *end) break;
            }
            rest.wait();
        }
        traffic_.asking += watch.spent();
        return done;
    }

    [[nodiscard]] answers ask(std::vector<task> const& tasks, std::function<bool()> const& go_on) {
        return ask(tasks, go_on, manner{});
    }

    /// Tells all that what they work on is no longer wanted, until somebody asks for more.
    void stop() {
        stopped_ = true;
        for (std::size_t m = 0; m < size(); ++m) send(m, {message::kind::stop});
    }
    /// The service is over.
    void end() {
        for (std::size_t m = 0; m < size(); ++m) send(m, {message::kind::end});
    }

private:
    using clock = std::chrono::steady_clock;

    void hail() {
        for (std::size_t m = 0; m < size(); ++m) {
            present_[m] = 0;
            send(m, {message::kind::hello, 0, hello_});
        }
        stopped_ = false;
    }
    void send(std::size_t to, message m) {
        ++traffic_.messages;
        traffic_.bytes_sent += m.bytes();
        transport_->send(to, std::move(m));
    }
    /// An answer and the number of its request.
    [[nodiscard]] std::optional<std::pair<std::uint64_t, answer>>
    taken(transport::letter const& l) {
        auto const& m = l.says;
        ++traffic_.messages;
        traffic_.bytes_received += m.bytes();
        auto const name = transport_->name_of(l.from);
        if (m.what == message::kind::fault) throw std::runtime_error(name + ": " + m.body);
        if (m.what == message::kind::welcome) {
            require_same(name, m.who);
            present_[l.from] = true;
            return std::nullopt;
        }
        if (m.what != message::kind::answer)
            throw std::logic_error(name + ": a message of a kind that no worker sends");
        if (busy_[l.from] > 0) --busy_[l.from];
        traffic_.worked += m.seconds;
        return std::pair{m.number, answer{m.body, l.from, m.seconds, m.cut_short}};
    }
    void require_same(std::string const& name, identity const& who) const {
        auto const* const p = expected_.differing(who);
        if (p == nullptr) return;
        std::string theirs = "something else";
        for (auto const& q : who.parts) {
            if (q.what == p->what) theirs = q.value;
        }
        throw worker_mismatch(name + " differs from the coordinator in its " + p->what + " (" +
                              theirs + ", not " + p->value + "): " + p->remedy);
    }

    transport* transport_;
    identity who_, expected_;
    std::vector<char> present_;     ///< whether a worker has shown who it is
    std::vector<std::size_t> busy_; ///< requests that a worker has not answered
    std::uint64_t number_ = 0;
    std::string hello_; ///< what the work is about
    bool stopped_ = false;
    sivid::cluster::traffic traffic_;
};

/// The pool of others and of a thread of the coordinator's own, so that the processor of the one
/// who waits works, too. Begins the work when it is made, and ends it for all with its life.
class working_coordinator {
public:
    /// @param others  is referred to
    /// @param about   what the work is about, for all
    /// @param mine    what must be the same there
    /// @param answer  of the own thread; may ask the worker given whether its work is wanted
    working_coordinator(transport& others, std::string_view about, identity const& mine,
                        std::function<std::string(worker&, std::string_view)> answer)
        : all_(*inside_.of_first, others), who_(identity_of_program()), pool_(all_, who_) {
        pool_.begin(about, mine);
        thread_ = std::thread([this, mine, answer = std::move(answer)] {
            worker self(*inside_.of_workers[0], who_);
            self.serve({[&mine](std::string_view) { return mine; },
                        [&](std::string_view request) { return answer(self, request); }});
        });
    }
    working_coordinator(working_coordinator const&) = delete;
    working_coordinator& operator=(working_coordinator const&) = delete;
    ~working_coordinator() {
        pool_.stop();
        pool_.end();
        thread_.join();
    }

    [[nodiscard]] worker_pool& helpers() { return pool_; }

private:
    memory_transport inside_{1};
    joined_transport all_;
    identity who_;
    worker_pool pool_;
    std::thread thread_;
};

/// Lets go those who wait for work that never came.
inline void release(transport& others) {
    for (std::size_t m = 0; m < others.others(); ++m) others.send(m, {message::kind::end});
}

/// Lets them go with the end of its life, whatever ends it, unless work has come meanwhile: then a
/// `working_coordinator` does.
class released_at_end {
public:
    /// @param others  is referred to
    explicit released_at_end(transport& others) : others_(&others) {}
    released_at_end(released_at_end const&) = delete;
    released_at_end& operator=(released_at_end const&) = delete;
    ~released_at_end() {
        if (others_ != nullptr) release(*others_);
    }
    void work_has_come() { others_ = nullptr; }

private:
    transport* others_;
};

} // namespace sivid::cluster

#endif
