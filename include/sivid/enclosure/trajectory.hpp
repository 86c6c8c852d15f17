// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TRAJECTORY_HPP
#define SIVID_ENCLOSURE_TRAJECTORY_HPP

#include <sivid/enclosure/detail/required_boxes.hpp>
#include <sivid/enclosure/step/detail/stepper.hpp>
#include <sivid/number/guard.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

namespace sivid {

/// Encloses all trajectories of a flow from a box of initial states and a box of parameters, step
/// by step. Steps end at the knots of sampled inputs.
template <class I>
class trajectory {
    using traits = interval_traits<I>;

public:
    trajectory(flow const& f, enclosure_options const& options)
        : flow_(&f), options_(options), stepper_(f, options) {}
    trajectory(trajectory const&) = delete;
    trajectory& operator=(trajectory const&) = delete;

    /// @given  boxes of the flow's sizes, not empty, bounded (checked)
    void begin(double time, basic_box<I> const& initial, basic_box<I> const& parameters) {
        require_sound_environment();
        enclosure_detail::require_boxes("trajectory", *flow_, initial, parameters);
        ensemble_.emplace(initial, parameters);
        stepper_.set_ensemble(*ensemble_);
        set_ = doubleton<I>::start(time, initial, flow_->parameters());
        failure_.reset();
        steps_ = 0;
    }

    /// One proved step, at most to `limit`.
    /// @returns false when none could be proved: see `failure()`; what came before stays proved.
    [[nodiscard]] bool step(double limit) {
        if (failure_) return false;
        if (!(limit > set_.time))
            throw std::invalid_argument("trajectory: a step must go forward, not from " +
                                        nearest_text(set_.time) + " to " + nearest_text(limit));
        enclosure_failure why;
        if (steps_ >= options_.maximum_steps) {
            why.reason = failure_reason::step_limit;
            return fail(why);
        }
        if (options_.cancelled()) {
            why.reason = failure_reason::cancelled;
            return fail(why);
        }
        if (!useful(set_.hull, why)) return fail(why);
        auto next = stepper_.prove(set_, std::min(limit, flow_->next_knot(set_.time)), why);
        if (!next) {
            failure_ = why;
            return false;
        }
        last_ = std::move(*next);
        set_ = stepper_.finish(last_);
        ++steps_;
        return true;
    }

    [[nodiscard]] double time() const { return set_.time; }
    [[nodiscard]] doubleton<I> const& set() const { return set_; }
    [[nodiscard]] tube_step<I> const& last() const { return last_; }
    [[nodiscard]] std::optional<enclosure_failure> const& failure() const { return failure_; }
    [[nodiscard]] sivid::ensemble<I> const& ensemble() const { return *ensemble_; }
    [[nodiscard]] std::size_t steps() const { return steps_; }
    [[nodiscard]] flow const& equations() const { return *flow_; }

private:
    [[nodiscard]] bool fail(enclosure_failure& why) {
        complete(why, set_, *ensemble_);
        failure_ = why;
        return false;
    }
    [[nodiscard]] bool useful(basic_box<I> const& x, enclosure_failure& why) const {
        for (std::size_t i = 0; i < x.size(); ++i) {
            double const limit = options_.widest * flow_->model().about.states[i].limit;
            if (traits::width(x[i]) <= limit) continue;
            why.component = i;
            why.reason = failure_reason::too_wide;
            return false;
        }
        return true;
    }

    flow const* flow_;
    enclosure_options options_;
    stepper<I> stepper_;
    std::optional<sivid::ensemble<I>> ensemble_;
    doubleton<I> set_;
    tube_step<I> last_;
    std::optional<enclosure_failure> failure_;
    std::size_t steps_ = 0;
};

} // namespace sivid

#endif
