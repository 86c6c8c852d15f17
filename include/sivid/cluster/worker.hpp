// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_WORKER_HPP
#define SIVID_CLUSTER_WORKER_HPP

#include <sivid/cluster/frame.hpp>
#include <sivid/cluster/identity.hpp>
#include <sivid/cluster/transport.hpp>
#include <sivid/cluster/wire.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <deque>
#include <exception>
#include <functional>
#include <optional>
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
    /// @throws wire_error  for a message that cannot be read
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
            if (next.what == frame::kind::end) return;
            if (next.what == frame::kind::hello) {
                wanted_ = std::none_of(waiting_.begin(), waiting_.end(), is_stop);
                serving = guarded([&] { welcome(work, next.body); });
            } else if (next.what == frame::kind::ask) {
                if (serving) serving = guarded([&] { reply(work, next); });
            } else if (!is_stop(next)) {
                throw wire_error("a damaged message: of a kind that nobody sends to a worker");
            }
        }
    }

private:
    using clock = std::chrono::steady_clock;

    [[nodiscard]] static bool is_stop(frame const& f) { return f.what == frame::kind::stop; }
    void send(frame const& f) const { transport_->send(0, to_bytes(f)); }

    void welcome(service const& work, std::string_view told) {
        wire_reader in(told);
        auto const about = in.text();
        in.finish();
        auto all = who_;
        for (auto& p : work.take_up(about).parts) all.parts.push_back(std::move(p));
        wire_writer out;
        put(out, all);
        send({frame::kind::welcome, 0, out.take()});
    }
    void reply(service const& work, frame const& asked) {
        double const begin = processor_seconds();
        auto const says = work.answer(asked.body);
        wire_writer out;
        out.put(processor_seconds() - begin).put(!wanted()).put(std::string_view{says});
        send({frame::kind::answer, asked.number, out.take()});
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
            send({frame::kind::fault, 0, e.what()});
            return false;
        }
    }
    void take_in() const {
        while (auto letter = transport_->receive()) {
            waiting_.push_back(frame_of(letter->bytes));
            if (is_stop(waiting_.back())) wanted_ = false; // at once, whatever waits before it
        }
    }

    transport* transport_;
    identity who_;
    std::thread::id own_;
    // What has been asked for so far.
    mutable std::atomic<bool> wanted_ = true;
    mutable clock::time_point next_look_{};
    mutable std::deque<frame> waiting_;
};

} // namespace sivid::cluster

#endif
