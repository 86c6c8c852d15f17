// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_IMPL_DEFAULT_STRATEGY_IPP
#define SIVID_PAVING_STRATEGY_IMPL_DEFAULT_STRATEGY_IPP

#include <sivid/paving/strategy/detail/usual_strategy.hpp>

#include <sivid/paving/invert.hpp>
#include <sivid/paving/strategy/detail/by_groups.hpp>
#include <sivid/paving/strategy/detail/by_parts.hpp>
#include <sivid/paving/strategy/detail/by_shapes.hpp>
#include <sivid/paving/strategy/detail/by_slower_inputs.hpp>
#include <sivid/paving/strategy/detail/by_windows.hpp>
#include <sivid/paving/strategy/detail/without_runs.hpp>
#include <sivid/paving/strategy/inquiry.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>

namespace sivid {

namespace paving_detail {

using promise = strategy::promise;

/// Whether runs end early, and how early.
inline promise reaches_less(inquiry& asked, double share) {
    double const reach = asked.reach();
    auto const percent = [](double x) { return std::to_string(static_cast<int>(100 * x)) + " %"; };
    return {reach < share, "runs over what is left reach " + percent(reach) +
                               " of the measurements, " + (reach < share ? "" : "not ") +
                               "less than " + percent(share)};
}
inline bool equations_gained(inquiry& asked) {
    return asked.gained("state equations") || asked.gained("interval observers");
}

/// After equations from known starts: a window that grows is quick where it is of use.
inline promise try_growing(inquiry& asked, double early) {
    if (!equations_gained(asked)) return {false, "equations have not gained"};
    if (!asked.starts_known()) return {false, "starts are uncertain"};
    return reaches_less(asked, early);
}
/// Half of the volume is what one halving of the search leaves.
inline promise try_guided(inquiry& asked) {
    if (!equations_gained(asked)) return {false, "equations have not gained"};
    auto const& last = asked.journal().back();
    if (!last.asked() || last.by != growing_window().name())
        return {false, "no growing window was tried after equations"};
    return {!(last.left < 0.5),
            last.left < 0.5 ? "a growing window was of use" : "a growing window was of no use"};
}
/// Halving many sides is slow: five parameters are thirty-two halves.
inline promise grow(inquiry& asked, double early, std::size_t many) {
    if (asked.gained("slower inputs")) return {false, "slower inputs gained"};
    if (!asked.starts_known() && equations_gained(asked))
        return {false, "windows all along serve uncertain starts better"};
    if (asked.problem().prior.size() >= many)
        return {true, std::to_string(many) + " parameters or more"};
    return reaches_less(asked, early);
}
/// Uncertain starts are not narrowed by halving parameters.
/// @param one  equations are asked only where runs end early
inline promise go_all_along(inquiry& asked, double early, bool one) {
    if (asked.starts_known()) return {false, "starts are known"};
    auto const& journal = asked.journal();
    for (auto const& r : journal) {
        if (r.by == "slower inputs" && r.asked() && r.figure("windows") > 0)
            return {true, "windows with slower inputs were tried"};
    }
    if (one && equations_gained(asked) && !asked.gained("slower inputs"))
        return {true, "equations have gained, starts are uncertain"};
    return reaches_less(asked, early);
}

/// Where a search by runs excludes next to nothing in a quarter of the time until now. Where it
/// works it is quicker than contractors of parts.
inline promise try_parts(inquiry& asked, double early) {
    auto whole = reaches_less(asked, early);
    if (!whole.worth) return whole;
    auto trial = asked.search();
    trial.seconds = 0.25 * asked.limit().spent();
    trial.keep_going = asked.limit();
    trial.checkpoint = nullptr;
    trial.resume = nullptr;
    trial.progress = nullptr;
    auto const found = invert(asked.test(), asked.problem().prior, trial);
    bool const works = found.paving.outer_volume().upper() < 0.9;
    return {!works, works ? "a short search by runs excludes boxes"
                          : "a short search by runs excludes next to nothing"};
}

/// Who, the share of the time that is left, when, and whether the search follows a gain. Shares are
/// upper limits: each ends by itself when it rests.
SIVID_DECL strategy usual_strategy(search_kind of) {
    bool const one = of == search_kind::one;
    // Runs that reach a quarter of the measurements refute boxes as fast as anything else does.
    double const early = 0.25;
    // Parts are searched with equations at hand: they pay as soon as any run ends early.
    double const equations_below = one ? early : 1;
    // A search of parts needs the rest of its time for them.
    double const pace = one ? 1 : 0.3;
    auto const early_runs = [=](inquiry& asked) { return reaches_less(asked, early); };
    auto const shapes = std::make_shared<by_shapes>();
    auto const equations = std::make_shared<equation_contractor>();
    auto const observers = std::make_shared<observer_contractor>();
    auto const growing = std::make_shared<growing_window>();
    auto const guided = std::make_shared<guided_windows>();
    auto const slower = std::make_shared<by_slower_inputs>();
    auto const along = std::make_shared<windows_all_along>();
    strategy how{{
        // The search cannot take curves apart, and what shapes leave is small.
        {{shapes}, 0.9 * pace, early_runs, true},
        // Seconds at most; the longest are records of thousands of samples.
        {{equations, observers},
         0.25,
         [=](inquiry& asked) { return reaches_less(asked, equations_below); }},
        // A try: it ends within a tenth of the time where it is of use.
        {{growing}, 0.1 * pace, [=](inquiry& asked) { return try_growing(asked, early); }},
        {{guided}, 0.9 * pace, try_guided, true},
        // The rest is for the recorded inputs: arm at 1 kHz from an uncertain start (robots).
        {{slower}, 0.7 * pace, early_runs},
        // Both leave time for a search of what is left.
        {{growing},
         0.7 * pace,
         [=](inquiry& asked) { return grow(asked, one ? 0.5 : early, one ? 5 : 1000); }},
        {{along}, 0.8 * pace, [=](inquiry& asked) { return go_all_along(asked, early, one); }},
    }};
    // All of these, where outliers are allowed.
    how.steps.push_back({{std::make_shared<by_groups>(how)}, 0.8 * pace, early_runs});
    // Altitude of a quadrotor (robots).
    auto const quick = how.without(shapes->name());
    if (one)
        how.steps.push_back({{std::make_shared<by_parts>(quick)}, 0.5, [=](inquiry& asked) {
                                 return try_parts(asked, early);
                             }});
    return how;
}

} // namespace paving_detail

} // namespace sivid

#endif
