// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_IMPL_ENCLOSE_IPP
#define SIVID_ENCLOSURE_IMPL_ENCLOSE_IPP

#include <sivid/enclosure/enclose.hpp>

#include <sivid/enclosure/observation.hpp>
#include <sivid/enclosure/suggested_degree.hpp>
#include <sivid/enclosure/taylor/parametric_flow.hpp>
#include <sivid/enclosure/taylor/parametric_runge_kutta.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

namespace enclosure_detail {

/// A family by Taylor models. What it says of a time between steps is a run of its own, which ends
/// a step there: as tight as at the ends of steps, at the cost of integrating so far.
/// @tparam Run  `parametric_flow<>` or `parametric_runge_kutta<>`
template <class Run>
class taylor_motion final : public motion_between_spans {
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
        auto const motion = std::make_shared<taylor_motion>(f, initial, parameters, from, options);
        auto run = motion->begin();
        while (run->time() < to) {
            double const before = run->time();
            if (!run->step(to)) break;
            motion->spans_.push_back({before, run->time(), run->swept()});
        }
        motion->end_ = run->time();
        return {motion, motion->spans_, run->time(), run->failure()};
    }

    [[nodiscard]] box at(double t) const override {
        if (!(t >= from_ && t <= end_))
            throw std::out_of_range("enclosed_motion: time outside the proved span");
        auto run = begin();
        while (run->time() < t) {
            if (!run->step(t)) return swept_at(t); // proved by other steps
        }
        auto const own = run->set().hull();
        return t == from_ ? own : intersect(own, swept_at(t));
    }
    [[nodiscard]] box observe_at(double t) const override {
        ensemble<interval> const family(initial_, parameters_);
        observer<interval> look(*flow_);
        look.set_ensemble(family);
        return look.over(t, interval(t), at(t));
    }

private:
    [[nodiscard]] std::unique_ptr<Run> begin() const {
        auto const unknowns = normalised_unknowns(initial_, parameters_).variables;
        auto run = std::make_unique<Run>(*flow_, options_, unknowns, suggested_degree(unknowns));
        run->begin(from_, initial_, parameters_);
        return run;
    }
    [[nodiscard]] box swept_at(double t) const {
        auto const span = std::find_if(spans_.begin(), spans_.end(),
                                       [t](swept_span const& s) { return t <= s.to; });
        return span->states;
    }

    std::shared_ptr<flow const> flow_;
    box initial_, parameters_;
    double from_, end_ = 0;
    enclosure_options options_;
    std::vector<swept_span> spans_;
};

} // namespace enclosure_detail

SIVID_DECL enclosed_motion enclose(std::shared_ptr<flow const> f, box const& initial,
                                   box const& parameters, double from, double to, carried_set set,
                                   enclosure_options const& options) {
    using namespace enclosure_detail;
    if (set == carried_set::doubleton) {
        return {std::move(f), initial, parameters, from, to, options};
    }
    if (!(from <= to)) throw std::invalid_argument("enclose: the end lies before the begin");
    if (options.method) {
        return taylor_motion<parametric_runge_kutta<>>::run(std::move(f), initial, parameters, from,
                                                            to, options);
    }
    return taylor_motion<parametric_flow<>>::run(std::move(f), initial, parameters, from, to,
                                                 options);
}

} // namespace sivid

#endif
