// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_DIAGNOSIS_EFFORT_HPP
#define SIVID_DIAGNOSIS_DIAGNOSIS_EFFORT_HPP

#include <sivid/paving/inflation.hpp>
#include <sivid/paving/inflation/observer_effort.hpp>
#include <sivid/paving/strategy/strategy.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <limits>
#include <mutex>
#include <string>
#include <utility>

namespace sivid {

/// What one step of a diagnosis may spend: boxes, and a share of the whole budget, which counts
/// work (`work_limit`). Both end it at the same place on any machine.
struct step_effort {
    std::size_t boxes = 0; ///< of parameters, each with all experiments
    double share = 0;      ///< of the budget of the whole diagnosis
};

/// The budget of a diagnosis and what asks whether it may go on.
class diagnosis_effort {
public:
    /// @param seconds   for everything
    /// @param test      how boxes are enclosed
    /// @param progress  called with what is being done; false ends the diagnosis; may be empty
    /// @param how       what is tried on a problem, beside searches
    diagnosis_effort(double seconds, feasibility_test_options test,
                     std::function<bool(std::string const&)> progress,
                     strategy how = default_strategy(search_kind::parts))
        : all_(seconds),
          progress_(std::move(progress)),
          strategy_(std::move(how)),
          limit_(seconds, test.keep_going),
          going_(std::numeric_limits<double>::infinity(), [this] { return limit_() && wanted(); }),
          test_(limited(std::move(test), going_)) {}
    diagnosis_effort(diagnosis_effort const&) = delete;
    diagnosis_effort& operator=(diagnosis_effort const&) = delete;

    /// Since it began [s].
    [[nodiscard]] double seconds() const { return clock_.spent(); }
    /// Of the budget.
    [[nodiscard]] double left() const { return limit_.left(); }
    [[nodiscard]] bool stopped() const { return stopped_; }
    /// Whether the time ended anything.
    [[nodiscard]] bool late() const { return limit_.late(); }
    /// With the limit of the diagnosis, so that no run outlasts it.
    [[nodiscard]] feasibility_test_options const& test() const { return test_; }

    /// Whether there is time for a step.
    bool go_on(std::string const& what) {
        {
            std::lock_guard const alone(asking_);
            doing_ = what;
            ask();
        }
        return go_on();
    }
    /// The same in the midst of it, from any thread and as often as one likes.
    bool go_on() {
        if (!stopped_ && !going_()) stopped_ = true;
        return !stopped_;
    }

    /// Seconds that a step may last from now on.
    [[nodiscard]] double seconds_of(step_effort const& e) const {
        return std::min(left(), e.share * all_);
    }
    /// Whether a step that begins now may go on, for this share of all time; from any thread.
    [[nodiscard]] work_limit within(double share) const {
        return work_limit(seconds_of({0, share}), going_);
    }
    /// A search for the inflation of a problem that spends no more.
    [[nodiscard]] inflation_options search(identification_problem const& p,
                                           step_effort const& e) const {
        inflation_options result;
        result.test = test_;
        result.seconds = seconds_of(e);
        result.boxes = e.boxes * (p.experiments.size() + 1);
        result.strategy = strategy_;
        return result;
    }
    /// A refutation by interval observers that spends no more.
    [[nodiscard]] observer_effort observers(step_effort const& e) {
        return {e.boxes, seconds_of(e), going_, false};
    }
    /// What such a search has spent, in boxes.
    [[nodiscard]] static std::size_t boxes_of(identification_problem const& p,
                                              inflation_bound const& found) {
        return (found.boxes + found.integrations) / (p.experiments.size() + 1) + 1;
    }

private:
    static constexpr double pause = 0.1; ///< between two questions whether to go on [s]

    void ask() {
        if (progress_ && !progress_(doing_)) stopped_ = true;
        asked_ = seconds();
    }
    [[nodiscard]] bool wanted() {
        if (!stopped_ && progress_ && seconds() - asked_ > pause) {
            std::unique_lock const alone(asking_, std::try_to_lock);
            if (alone.owns_lock() && seconds() - asked_ > pause) ask();
        }
        return !stopped_;
    }

    double all_;
    std::function<bool(std::string const&)> progress_;
    strategy strategy_;
    std::string doing_;
    std::mutex asking_;
    std::atomic<double> asked_ = 0; ///< when
    std::atomic<bool> stopped_ = false;
    stopwatch clock_;
    work_limit limit_;
    work_limit going_; ///< within it, as long as progress is wanted
    feasibility_test_options test_;
};

} // namespace sivid

#endif
