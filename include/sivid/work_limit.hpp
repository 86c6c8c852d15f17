// SPDX-License-Identifier: MIT
#ifndef SIVID_WORK_LIMIT_HPP
#define SIVID_WORK_LIMIT_HPP

#include <sivid/work_clock.hpp>

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

/// How long work may go on: as long as its budget of counted work lasts (`work_clock`), and nobody
/// says stop. Copies share one end; a copy is what all the options called `keep_going` take, for
/// any thread.
///   work_limit const limit(options.seconds, options.keep_going);
///   options.test.keep_going = limit;
/// The time is a last guard. It ends a limit that stands alone at its seconds: on a machine less
/// than half as fast as the one of the prices, or one that has other work, `late()` says so. A
/// limit within another, which has it as its `keep_going`, counts; the time ends it where nothing
/// is counted (a test of one's own, say), at ten times its seconds and one more.
class work_limit {
    using clock = std::chrono::steady_clock;

public:
    /// @param seconds  from now; NaN and what is below 0 count as 0
    /// @param keep_going  asked besides; once false it stays so (trusted). May be empty.
    explicit work_limit(double seconds, std::function<bool()> keep_going = nullptr)
        : shared_(std::make_shared<state>()) {
        shared_->keep_going = std::move(keep_going);
        shared_->outer = shared_->keep_going.target<work_limit>();
        extend(seconds);
    }

    [[nodiscard]] bool operator()() const { return !over() && !refused(); }
    /// Whether its budget is used up, whatever others say.
    [[nodiscard]] bool over() const { return !(work_clock::now() < shared_->end && in_time()); }
    /// What is left of the budget; 0 when that is nothing, or somebody said stop.
    [[nodiscard]] double seconds() const { return (*this)() ? left() : 0.0; }
    /// The same, whatever others say.
    [[nodiscard]] double left() const {
        return over() ? 0.0 : std::max(0.0, shared_->end - work_clock::now());
    }
    /// What was spent of it, by this thread.
    [[nodiscard]] double spent() const { return watch_.spent(); }
    /// Whether it was the time that ended it, or the limit that it is within: elsewhere more might
    /// have been found.
    [[nodiscard]] bool late() const {
        return shared_->late || (shared_->outer != nullptr && shared_->outer->late());
    }
    /// For what completes the work: at least so much from now on. Who said stop before is obeyed by
    /// allowing no more than that, and is not asked again.
    /// @given  nobody works by this limit meanwhile
    void allow(double seconds) {
        if (refused()) {
            shared_->said = true;
            shared_->end = shared_->latest = 0;
        }
        extend(seconds);
    }

private:
    struct state {
        std::function<bool()> keep_going;
        work_limit const* outer = nullptr; ///< within `keep_going`
        std::atomic<double> end{0};        ///< by the work clock
        std::atomic<double> latest{0};     ///< by the clock [s]
        std::atomic<bool> said{false};     ///< stop, and that was heard
        std::atomic<bool> late{false};
    };
    [[nodiscard]] bool refused() const {
        return !shared_->said && shared_->keep_going && !shared_->keep_going();
    }
    [[nodiscard]] bool in_time() const {
        if (time() < shared_->latest) return true;
        shared_->late = true;
        return false;
    }
    void extend(double seconds) {
        constexpr double longest = 1e9; // 30 years
        double const more = seconds > 0 ? std::min(seconds, longest) : 0.0;
        shared_->end = std::max<double>(shared_->end, work_clock::now() + more);
        bool const within = shared_->outer != nullptr && !shared_->said;
        shared_->latest =
            std::max<double>(shared_->latest, time() + (within ? 10 * more + 1 : more));
    }
    [[nodiscard]] static double time() {
        return std::chrono::duration<double>(clock::now().time_since_epoch()).count();
    }

    std::shared_ptr<state> shared_;
    work_watch watch_;
};

} // namespace sivid

#endif
