// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_DIAGNOSIS_EFFORT_HPP
#define SIVID_DIAGNOSIS_DIAGNOSIS_EFFORT_HPP

#include <sivid/paving/inflation.hpp>
#include <sivid/paving/inflation/observer_effort.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

namespace sivid {

/// What one step of a diagnosis may spend. The boxes end it on a machine that keeps up, at the same
/// place whatever its speed and load; the share of all time ends it on any other.
struct step_effort {
    std::size_t boxes = 0; ///< of parameters, each with all experiments
    double share = 0;      ///< of the time for the whole diagnosis
};

/// The clock of a diagnosis and what asks whether it may go on.
class diagnosis_effort {
public:
    /// @param seconds   for everything
    /// @param test      how boxes are enclosed
    /// @param progress  called with what is being done; false ends the diagnosis; may be empty
    diagnosis_effort(double seconds, feasibility_test_options test,
                     std::function<bool(std::string const&)> progress)
        : all_(seconds), test_(std::move(test)), progress_(std::move(progress)) {
        auto const asked = test_.keep_going;
        test_ = limited(std::move(test_), [this, asked] { return (!asked || asked()) && go_on(); });
    }
    diagnosis_effort(diagnosis_effort const&) = delete;
    diagnosis_effort& operator=(diagnosis_effort const&) = delete;

    [[nodiscard]] double seconds() const { return clock_.spent(); }
    [[nodiscard]] double left() const { return std::max(0.0, all_ - seconds()); }
    [[nodiscard]] bool stopped() const { return stopped_; }
    /// With the clock of the diagnosis, so that no run outlasts it.
    [[nodiscard]] feasibility_test_options const& test() const { return test_; }

    /// Whether there is time for a step.
    bool go_on(std::string const& what) {
        std::lock_guard const alone(asking_);
        doing_ = what;
        ask();
        return !stopped_;
    }
    /// The same in the midst of it, from any thread and as often as one likes.
    bool go_on() {
        if (stopped_) return false;
        if (left() <= 0) {
            stopped_ = true;
        } else if (progress_ && seconds() - asked_ > pause) {
            std::unique_lock const alone(asking_, std::try_to_lock);
            if (alone.owns_lock() && seconds() - asked_ > pause) ask();
        }
        return !stopped_;
    }

    /// Seconds that a step may last from now on.
    [[nodiscard]] double seconds_of(step_effort const& e) const {
        return std::min(left(), e.share * all_);
    }
    /// Whether a step that begins now may go on, for this share of all time; from any thread.
    [[nodiscard]] std::function<bool()> within(double share) {
        double const end = left() - seconds_of({0, share});
        return [this, end] { return left() >= end && go_on(); };
    }
    /// A search for the inflation of a problem that spends no more.
    [[nodiscard]] inflation_options search(identification_problem const& p,
                                           step_effort const& e) const {
        inflation_options result;
        result.test = test_;
        result.seconds = seconds_of(e);
        result.boxes = e.boxes * (p.experiments.size() + 1);
        return result;
    }
    /// A refutation by interval observers that spends no more.
    [[nodiscard]] observer_effort observers(step_effort const& e) {
        return {e.boxes, seconds_of(e), [this] { return go_on(); }, false};
    }
    /// What such a search has spent, in boxes.
    [[nodiscard]] static std::size_t boxes_of(identification_problem const& p,
                                              inflation_bound const& found) {
        return (found.boxes + found.integrations) / (p.experiments.size() + 1) + 1;
    }

private:
    static constexpr double pause = 0.1; ///< between two questions whether to go on [s]

    void ask() {
        if (left() <= 0 || (progress_ && !progress_(doing_))) stopped_ = true;
        asked_ = seconds();
    }

    double all_;
    feasibility_test_options test_;
    std::function<bool(std::string const&)> progress_;
    std::string doing_;
    std::mutex asking_;
    std::atomic<double> asked_ = 0; ///< when
    std::atomic<bool> stopped_ = false;
    stopwatch clock_;
};

} // namespace sivid

#endif
