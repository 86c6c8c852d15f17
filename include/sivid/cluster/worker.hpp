// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_WORKER_HPP
#define SIVID_CLUSTER_WORKER_HPP

#include <sivid/cluster/identity.hpp>
#include <sivid/cluster/transport.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <deque>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace sivid::cluster {

/// What a worker of a pool does.
struct service {
    /// Takes the work up, from what the coordinator says of it, and names what must be the same as
    /// there: a digest of the problem, say.
    std::function<identity(std::string_view about)> take_up;
    /// Answers a request. Work that `worker::wanted` has ended is answered, too, as far as it got.
    std::function<std::string(std::string_view request)> answer;
};

/// One that works for a coordinator.
class worker {
public:
    /// @param coordinator  the only other of that transport; is referred to
    worker(transport& coordinator, identity who) : transport_(&coordinator), who_(std::move(who)) {}

    /// False once the coordinator no longer wants what is being worked on; what a running
    /// integration asks (`keep_going`). By any thread; messages are taken in by the one that
    /// serves.
    [[nodiscard]] bool wanted() const {
        if (wanted_ && std::this_thread::get_id() == own_) {
            auto const now = clock::now();
            if (now >= next_look_) {
                next_look_ = now + std::chrono::milliseconds(1);
                take_in();
            }
        }
        return wanted_;
    }

    /// Answers until the coordinator ends the service. What the service throws is reported, and
    /// nothing is answered after it.
    void serve(service const& work) {
        own_ = std::this_thread::get_id();
        patience rest;
        bool serving = false;
        for (;;) {
            take_in();
            if (waiting_.empty()) {
                rest.wait();
                continue;
            }
            rest.renew();
            auto const next = std::move(waiting_.front());
            waiting_.pop_front();
            if (next.what == message::kind::end) return;
            if (next.what == message::kind::hello) {
                wanted_ = std::none_of(waiting_.begin(), waiting_.end(), is_stop);
                serving = guarded([&] { welcome(work, next.body); });
            } else if (next.what == message::kind::ask) {
                if (serving) serving = guarded([&] { reply(work, next); });
            } else if (!is_stop(next)) {
                throw std::logic_error("a message of a kind that nobody sends to a worker");
            }
        }
    }

private:
    using clock = std::chrono::steady_clock;

    [[nodiscard]] static bool is_stop(message const& f) { return f.what == message::kind::stop; }
    void send(message m) const { transport_->send(0, std::move(m)); }

    void welcome(service const& work, std::string_view about) {
        message m{message::kind::welcome};
        m.who = who_;
        for (auto& p : work.take_up(about).parts) m.who.parts.push_back(std::move(p));
        send(std::move(m));
    }
    void reply(service const& work, message const& asked) {
        double const begin = processor_seconds();
        message m{message::kind::answer, asked.number, work.answer(asked.body)};
        m.seconds = processor_seconds() - begin;
        m.cut_short = !wanted();
        send(std::move(m));
    }
    /// Of this thread, so that a rank that shares its processor does not look slow.
    [[nodiscard]] static double processor_seconds() {
        std::timespec now{};
        ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    }
    /// @returns  whether the service can go on
    template <class Work>
    [[nodiscard]] bool guarded(Work const& work) {
        try {
            work();
            return true;
        } catch (std::exception const& e) {
            send({message::kind::fault, 0, e.what()});
            return false;
        }
    }
    void take_in() const {
        while (auto letter = transport_->receive()) {
            waiting_.push_back(std::move(letter->says));
            if (is_stop(waiting_.back())) wanted_ = false; // at once, whatever waits before it
        }
    }

    transport* transport_;
    identity who_;
    std::thread::id own_;
    // What has been asked for so far.
    mutable std::atomic<bool> wanted_ = true;
    mutable clock::time_point next_look_{};
    mutable std::deque<message> waiting_;
};

} // namespace sivid::cluster

#endif
