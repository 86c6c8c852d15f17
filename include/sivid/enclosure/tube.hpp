// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TUBE_HPP
#define SIVID_ENCLOSURE_TUBE_HPP

#include <sivid/enclosure/observation.hpp>
#include <sivid/enclosure/trajectory.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// Proven enclosures of all trajectories of an ensemble over a span of time. Only proved steps
/// enter.
template <class I>
class tube {
    using traits = interval_traits<I>;

public:
    tube(std::shared_ptr<flow const> f, enclosure_options const& options, sivid::ensemble<I> e,
         doubleton<I> start)
        : flow_(std::move(f)),
          ensemble_(std::make_unique<sivid::ensemble<I>>(std::move(e))),
          stepper_(std::make_unique<stepper<I>>(*flow_, options)),
          end_(std::move(start)) {
        stepper_->set_ensemble(*ensemble_);
    }

    /// @given  the step and the set at its end come from the same flow and ensemble (trusted)
    void append(tube_step<I> step, doubleton<I> end) {
        steps_.push_back(std::move(step));
        end_ = std::move(end);
    }
    void stop(enclosure_failure why) { failure_ = why; }

    [[nodiscard]] double begin_time() const {
        return steps_.empty() ? end_.time : steps_.front().from;
    }
    /// Everything up to this time is proved.
    [[nodiscard]] double end_time() const { return end_.time; }
    [[nodiscard]] bool complete() const { return !failure_; }
    [[nodiscard]] std::optional<enclosure_failure> const& failure() const { return failure_; }
    [[nodiscard]] std::vector<tube_step<I>> const& steps() const { return steps_; }
    [[nodiscard]] doubleton<I> const& end() const { return end_; }
    [[nodiscard]] flow const& equations() const { return *flow_; }

    /// The carried set at time t, as tight as at the steps' ends.
    /// @throws std::out_of_range outside [begin_time, end_time]
    /// @cost  that of one step when t lies inside a step
    [[nodiscard]] doubleton<I> set_at(double t) const {
        if (t == end_.time) return end_;
        auto const& step = step_at(t);
        return t == step.from ? step.start : stepper_->advance(step, t);
    }
    /// A box that contains all states at time t.
    [[nodiscard]] basic_box<I> at(double t) const { return set_at(t).hull; }

    /// A box that contains all states at all times in [from, to]: of whole steps what they swept,
    /// of a part of a step what steps of its own sweep.
    /// @throws std::out_of_range outside [begin_time, end_time]
    /// @cost  that of one step for each end that lies inside a step
    [[nodiscard]] basic_box<I> over(double from, double to) const {
        if (!(from <= to))
            throw std::invalid_argument("tube: a span must not end before it begins: from " +
                                        nearest_text(from) + " to " + nearest_text(to));
        if (from == to) return at(from);
        basic_box<I> result = hull(at(from), at(to));
        for (auto const& step : steps_) {
            if (step.to <= from || step.from >= to) continue;
            bool const whole = step.from >= from && step.to <= to;
            result = hull(result,
                          whole ? step.swept
                                : swept_in(step, std::max(from, step.from), std::min(to, step.to)));
        }
        return result;
    }

    [[nodiscard]] sivid::ensemble<I> const& ensemble() const { return *ensemble_; }

    /// Encloses the channels at time t.
    [[nodiscard]] basic_box<I> observe_at(double t) const {
        observer<I> look(*flow_);
        look.set_ensemble(*ensemble_);
        auto const seen = look(set_at(t));
        basic_box<I> result(seen.size());
        for (std::size_t y = 0; y < seen.size(); ++y) {
            result[y] = seen[y].defined ? seen[y].value : traits::entire();
        }
        return result;
    }

private:
    /// What is swept from one time of a step to another, by short steps from the set at the first;
    /// where such are not proved, by all of it.
    [[nodiscard]] basic_box<I> swept_in(tube_step<I> const& step, double from, double to) const {
        auto set = from == step.from ? step.start : stepper_->advance(step, from);
        basic_box<I> result = set.hull;
        stepper_->set_ensemble(*ensemble_); // what was asked before has no say in the next steps
        while (set.time < to) {
            enclosure_failure why;
            auto const part = stepper_->prove(set, to, why);
            if (!part) return step.swept;
            result = hull(result, part->swept);
            set = stepper_->finish(*part);
        }
        return intersect(result, step.swept);
    }
    /// The step with from < t <= to, or the first one at the begin.
    /// @throws std::out_of_range outside [begin_time, end_time], and without a step
    [[nodiscard]] tube_step<I> const& step_at(double t) const {
        if (steps_.empty() || !(t >= begin_time() && t <= end_time())) {
            throw std::out_of_range("tube: time " + nearest_text(t) + " outside the proved span" +
                                    (steps_.empty() ? ", which has no step"
                                                    : " from " + nearest_text(begin_time()) +
                                                          " to " + nearest_text(end_time())));
        }
        return *std::lower_bound(steps_.begin(), steps_.end(), t,
                                 [](tube_step<I> const& s, double time) { return s.to < time; });
    }

    std::shared_ptr<flow const> flow_;
    std::unique_ptr<sivid::ensemble<I>> ensemble_;
    std::unique_ptr<stepper<I>> stepper_;
    std::vector<tube_step<I>> steps_;
    doubleton<I> end_;
    std::optional<enclosure_failure> failure_;
};

/// Encloses x' = f(t, x, p, u) from the box `initial` at time `from` to time `to`, in steps
/// relative to that span (`for_span`).
/// @param parameters  a box for the unknown constants
/// @param from, to    in the unit of time of the model
/// @returns a tube over [from, to], or over the shorter span that was proved, with its failure
/// @throws std::invalid_argument  for boxes of other sizes, empty or unbounded, or a span that
///   ends before it begins
/// @guarantee  every trajectory from the box of starts, for every parameter in its box and inputs
///   within their error bounds, lies in what the tube says of any time of its span
/// @cost  a step: a Taylor series of order `options.order` (or the method), one of its derivatives,
///   and products of n x n matrices
template <class I = interval>
[[nodiscard]] tube<I> integrate(std::shared_ptr<flow const> f, basic_box<I> const& initial,
                                basic_box<I> const& parameters, double from, double to,
                                enclosure_options const& options = {}) {
    if (!(from <= to))
        throw std::invalid_argument("integrate: the end, " + nearest_text(to) +
                                    ", lies before the begin, " + nearest_text(from));
    auto const how = for_span(options, to - from);
    trajectory<I> run(*f, how);
    run.begin(from, initial, parameters);
    tube<I> result(f, how, run.ensemble(), run.set());
    while (run.time() < to) {
        if (!run.step(to)) {
            result.stop(*run.failure());
            break;
        }
        result.append(run.last(), run.set());
    }
    return result;
}

#ifdef SIVID_COMPILED_ALIKE // the whole of first-order integration, compiled once
extern template tube<interval> integrate(std::shared_ptr<flow const>, box const&, box const&,
                                         double, double, enclosure_options const&);
#endif

} // namespace sivid

#endif
