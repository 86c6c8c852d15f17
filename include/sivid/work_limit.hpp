// SPDX-License-Identifier: MIT
#ifndef SIVID_WORK_LIMIT_HPP
#define SIVID_WORK_LIMIT_HPP

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <utility>

namespace sivid {

/// Tells how long something takes, by a clock that nobody sets. Copies have the same begin.
class stopwatch {
    using clock = std::chrono::steady_clock;

public:
    /// Time since it was made [s].
    [[nodiscard]] double spent() const {
        return std::chrono::duration<double>(clock::now() - begin_).count();
    }

private:
    clock::time_point begin_ = clock::now();
};

/// How long work may go on: until a time, and as long as somebody does not say stop. Copies share
/// one end; a copy is what all the options called `keep_going` take, for any thread.
///   work_limit const limit(options.seconds, options.keep_going);
///   options.test.keep_going = limit;
class work_limit {
    using clock = std::chrono::steady_clock;

public:
    /// @param seconds  from now; NaN and what is below 0 count as 0
    /// @param keep_going  asked besides; once false it stays so (trusted). May be empty.
    explicit work_limit(double seconds, std::function<bool()> keep_going = nullptr)
        : shared_(std::make_shared<state>()) {
        shared_->keep_going = std::move(keep_going);
        shared_->end = after(seconds);
    }

    [[nodiscard]] bool operator()() const {
        return clock::now().time_since_epoch().count() < shared_->end && !refused();
    }
    /// Time that is left; 0 when there is none, or somebody said stop.
    [[nodiscard]] double seconds() const {
        if (!(*this)()) return 0;
        clock::duration const rest{shared_->end - clock::now().time_since_epoch().count()};
        return std::max(0.0, std::chrono::duration<double>(rest).count());
    }
    /// Time since the limit was made [s].
    [[nodiscard]] double spent() const { return watch_.spent(); }
    /// For what completes the work: at least so much from now on. Who said stop before is obeyed by
    /// allowing no more than that, and is not asked again.
    /// @given  nobody works by this limit meanwhile
    void allow(double seconds) {
        if (refused()) {
            shared_->said = true;
            shared_->end = after(seconds);
        } else {
            shared_->end = std::max<clock::rep>(shared_->end, after(seconds));
        }
    }

private:
    struct state {
        std::function<bool()> keep_going;
        std::atomic<clock::rep> end{0};
        std::atomic<bool> said{false}; ///< stop, and that was heard
    };
    [[nodiscard]] bool refused() const {
        return !shared_->said && shared_->keep_going && !shared_->keep_going();
    }
    [[nodiscard]] static clock::rep after(double seconds) {
        constexpr double longest = 1e9; // 30 years: the clock counts nanoseconds
        auto const span =
            std::chrono::duration<double>(seconds > 0 ? std::min(seconds, longest) : 0.0);
        return (clock::now() + std::chrono::duration_cast<clock::duration>(span))
            .time_since_epoch()
            .count();
    }

    std::shared_ptr<state> shared_;
    stopwatch watch_;
};

} // namespace sivid

#endif
