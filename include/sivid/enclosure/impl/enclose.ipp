// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_IMPL_ENCLOSE_IPP
#define SIVID_ENCLOSURE_IMPL_ENCLOSE_IPP

#include <sivid/enclosure/enclose.hpp>

#include <sivid/enclosure/observation.hpp>
#include <sivid/enclosure/suggested_degree.hpp>
#include <sivid/enclosure/taylor/parametric_flow.hpp>
#include <sivid/enclosure/taylor/parametric_runge_kutta.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

namespace enclosure_detail {

/// A family by Taylor models. Sets are kept on the way. What is said of a time between them is a
/// short run of its own from the one before, which ends there: as tight as at the ends of steps.
/// @tparam Run  `parametric_flow<>` or `parametric_runge_kutta<>`
template <class Run>
class taylor_motion final : public motion_between_spans {
    using set_type = typename Run::set_type;

public:
    taylor_motion(std::shared_ptr<flow const> f, box initial, box parameters, double from,
                  enclosure_options const& options)
        : flow_(std::move(f)),
          initial_(std::move(initial)),
          parameters_(std::move(parameters)),
          from_(from),
          options_(options) {}

    [[nodiscard]] static enclosed_motion run(std::shared_ptr<flow const> f, box const& initial,
                                             box const& parameters, double from, double to,
                                             enclosure_options const& options) {
        auto const motion = std::make_shared<taylor_motion>(f, initial, parameters, from,
                                                            for_span(options, to - from));
        auto run = motion->begin();
        while (run->time() < to) {
            motion->keep(run->set());
            double const before = run->time();
            if (!run->step(to)) break;
            motion->spans_.push_back({before, run->time(), run->swept()});
        }
        motion->last_ = run->set();
        return {motion, motion->spans_, run->time(), run->failure()};
    }

    [[nodiscard]] box at(double t) const override {
        auto const& set = kept_before(t);
        if (!(set.time < t)) return states_at(t, &set);
        auto const run = run_to(t);
        return states_at(t, run ? &run->set() : nullptr);
    }
    [[nodiscard]] box observe_at(double t) const override {
        ensemble<interval> const family(initial_, parameters_);
        observer<interval> look(*flow_);
        look.set_ensemble(family);
        auto const run = run_to(t);
        auto seen = look.over(t, interval(t), states_at(t, run ? &run->set() : nullptr));
        if (!run) return seen;
        auto const outputs = run->outputs(); // as functions of the unknowns
        for (std::size_t y = 0; y < seen.size(); ++y) {
            if (std::isfinite(outputs[y].norm())) seen[y] = intersect(seen[y], range(outputs[y]));
        }
        return seen;
    }
    [[nodiscard]] box over(double from, double to) const override {
        auto const& whole = swept_at(to);
        auto const run = run_to(from);
        if (!run) return whole;
        auto result = run->set().hull();
        while (run->time() < to) {
            if (!run->step(to)) return whole;
            result = hull(result, run->swept());
        }
        return intersect(result, whole);
    }

private:
    /// Sets that are kept at most; when there are more, every second one is left out.
    static constexpr std::size_t most_kept = 64;

    /// The set before the next step, where it is one to be kept.
    void keep(set_type const& set) {
        if (spans_.size() % every_ != 0) return;
        if (kept_.size() == most_kept) {
            for (std::size_t k = 1; 2 * k < most_kept; ++k) kept_[k] = std::move(kept_[2 * k]);
            kept_.resize(most_kept / 2);
            every_ *= 2;
        }
        kept_.push_back(set);
    }
    /// @param set  the set at time t; null where no run ends there
    [[nodiscard]] box states_at(double t, set_type const* set) const {
        if (spans_.empty()) return set->hull();
        return set ? intersect(set->hull(), swept_at(t)) : swept_at(t);
    }
    [[nodiscard]] std::unique_ptr<Run> begin() const {
        auto const unknowns = normalised_unknowns(initial_, parameters_).variables;
        auto run = std::make_unique<Run>(*flow_, options_, unknowns, suggested_degree(unknowns));
        run->begin(from_, initial_, parameters_);
        return run;
    }
    /// A run at time t; nothing where no other steps than those that were made are proved.
    [[nodiscard]] std::unique_ptr<Run> run_to(double t) const {
        auto run = begin();
        run->resume(kept_before(t));
        while (run->time() < t) {
            if (!run->step(t)) return nullptr;
        }
        return run;
    }
    /// The last set that is kept, at t or before.
    [[nodiscard]] set_type const& kept_before(double t) const {
        if (!(t >= from_ && t <= last_.time))
            throw std::out_of_range("enclosed_motion: time " + nearest_text(t) +
                                    " outside the proved span from " + nearest_text(from_) +
                                    " to " + nearest_text(last_.time));
        if (t == last_.time) return last_;
        auto const next =
            std::upper_bound(spans_.begin(), spans_.end(), t,
                             [](double time, swept_span const& s) { return time < s.to; });
        return kept_[static_cast<std::size_t>(next - spans_.begin()) / every_];
    }
    [[nodiscard]] box const& swept_at(double t) const {
        return std::lower_bound(spans_.begin(), spans_.end(), t,
                                [](swept_span const& s, double time) { return s.to < time; })
            ->states;
    }

    std::shared_ptr<flow const> flow_;
    box initial_, parameters_;
    double from_;
    enclosure_options options_;
    std::vector<swept_span> spans_;
    /// Steps from one set that is kept to the next: a copy takes less than a tenth of a step.
    std::size_t every_ = 4;
    std::vector<set_type> kept_;
    set_type last_;
};

} // namespace enclosure_detail

SIVID_DECL enclosed_motion enclose(std::shared_ptr<flow const> f, box const& initial,
                                   box const& parameters, double from, double to, carried_set set,
                                   enclosure_options const& options) {
    using namespace enclosure_detail;
    if (set == carried_set::doubleton) {
        return {std::move(f), initial, parameters, from, to, options};
    }
    if (!(from <= to))
        throw std::invalid_argument("enclose: the end, " + nearest_text(to) +
                                    ", lies before the begin, " + nearest_text(from));
    if (options.method) {
        return taylor_motion<parametric_runge_kutta<>>::run(std::move(f), initial, parameters, from,
                                                            to, options);
    }
    return taylor_motion<parametric_flow<>>::run(std::move(f), initial, parameters, from, to,
                                                 options);
}

SIVID_DECL enclosed_motion enclose(recorded_model const& model, parameter_choice const& choice,
                                   box const& initial, box const& parameters, double from,
                                   double to, carried_set set, enclosure_options const& options,
                                   std::vector<signal> const& inputs) {
    return enclose(std::make_shared<flow const>(model, choice, inputs), initial, parameters, from,
                   to, set, for_method(options));
}

} // namespace sivid

#endif
