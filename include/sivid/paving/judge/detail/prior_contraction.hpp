// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_DETAIL_PRIOR_CONTRACTION_HPP
#define SIVID_PAVING_JUDGE_DETAIL_PRIOR_CONTRACTION_HPP

/// @file
/// What `identify` does before it searches where runs over the prior end early, in this order:
/// shapes in place of constants; state equations and interval observers, then a window that grows
/// or windows that equations guide; slower inputs where a logger is faster than the motion; a
/// window that grows; windows all along the records where starts are not known.

#include <sivid/measurement/signal.hpp>
#include <sivid/model/change/detail/slower_inputs.hpp>
#include <sivid/model/structure/states_seen.hpp>
#include <sivid/paving/contract/window_contraction.hpp>
#include <sivid/paving/identify_options.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/judge/detail/equation_aided_test.hpp>
#include <sivid/paving/judge/detail/equation_guide.hpp>
#include <sivid/paving/judge/detail/shape_contraction.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

namespace sivid::paving_detail {

/// Whether trajectories over the prior end early, from starts that nobody knows.
inline bool starts_hinder(feasibility_test& test, identification_problem const& problem) {
    bool const known = std::all_of(
        problem.experiments.begin(), problem.experiments.end(),
        [](experiment const& e) { return normalised_unknowns(e.initial, {}).variables == 0; });
    return !known && test.reached(problem.prior) < 0.25;
}

/// The problem from the starts that windows have left.
/// @throws std::invalid_argument  when they are of another problem
inline identification_problem narrowed_by(window_contraction const& windows,
                                          identification_problem problem) {
    if (windows.rest.size() != problem.prior.size() ||
        windows.starts.size() != problem.experiments.size())
        throw std::invalid_argument("identification state: its windows are of another problem");
    for (std::size_t e = 0; e < problem.experiments.size() && !windows.empty(); ++e) {
        problem.experiments[e].initial = windows.starts[e];
    }
    problem.require_valid();
    return problem;
}

/// The time between two samples of the fastest input with a thousand of them or more; 0: none.
inline double sample_period(identification_problem const& problem) {
    double least = HUGE_VAL;
    for (auto const& e : problem.experiments) {
        double const end = e.end();
        for (auto const& s : e.inputs) {
            auto const* const u = std::get_if<sampled_signal>(&s);
            if (u == nullptr) continue;
            auto const& t = u->times();
            auto const knots = std::upper_bound(t.begin(), t.end(), end) -
                               std::upper_bound(t.begin(), t.end(), e.begin);
            if (knots < 1000) continue;
            least = std::min(least, (end - e.begin) / static_cast<double>(knots));
        }
    }
    return std::isfinite(least) ? least : 0;
}

/// The share of the measurements that a run at the fit tells to half their bounds.
inline double seen_sharply(feasibility_test& test, identification_problem const& problem,
                           box const& fitted, std::vector<box> const& starts) {
    auto const point = point_box(mid(fitted));
    std::size_t sharp = 0, all = 0;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const from =
            e < starts.size() ? starts[e] : point_box(mid(problem.experiments[e].initial));
        auto const answer = test.run(e, from, point);
        auto const values = output_ranges(*answer, point);
        for (std::size_t i = 0; i < values.size(); ++i) {
            sharp += width(values[i]) <= 0.5 * width(answer->bounds[i]) ? 1 : 0;
        }
        all += answer->measurements;
    }
    return static_cast<double>(sharp) / static_cast<double>(std::max<std::size_t>(all, 1));
}

/// What a search with slower inputs leaves of the prior, where that pays: see `identify_options`.
/// @param fitted  where they are tried, from `starts`
inline std::optional<window_contraction>
contract_by_slower_inputs(feasibility_test& exact, identification_problem const& posed,
                          box const& fitted, std::vector<box> const& starts,
                          identify_options const& options, work_limit const& limit) {
    stopwatch const clock;
    double const period = 10 * sample_period(posed);
    if (!(period > 0)) return std::nullopt;
    if (!(exact.reached(posed.prior) < 0.25)) return std::nullopt;
    auto slow = with_slower_inputs(posed, period);
    if (!slow) return std::nullopt;
    feasibility_test test(*slow, options.test);
    if (!limit() || seen_sharply(test, *slow, fitted, starts) < 0.25) return std::nullopt;
    double const most = 0.5 * limit.seconds();
    window_contraction result;
    result.rest = posed.prior;
    for (auto const& e : posed.experiments) result.starts.push_back(e.initial);
    if (options.windows && starts_hinder(test, *slow)) {
        // They are cheaper here than over the recorded inputs, and end by themselves.
        result = contract_by_windows(*slow, {.run = options.test,
                                             .seconds = 0.6 * limit.seconds(),
                                             .keep_going = limit,
                                             .workers = options.search.workers});
        *slow = narrowed_by(result, *std::move(slow));
    }
    feasibility_test further(*slow, options.test);
    auto search = options.search;
    search.hull_gain = 0.02;
    search.keep_outside = false;
    search.proof_bytes = 0;
    search.checkpoint = nullptr;
    search.resume = nullptr;
    search.seconds = most - clock.spent();
    if (!result.empty() && search.seconds > 0) {
        further.set_rest(result.rest);
        auto const found = invert(further, posed.prior, search);
        result.rest = intersect(result.rest, found.paving.outer_hull());
    }
    bool const shrunk = relative_volume(result.rest, posed.prior).upper() < 1;
    if (!shrunk && result.windows == 0) return std::nullopt;
    result.integrations = further.integrations();
    result.input_period = period;
    result.seconds = clock.spent();
    return result;
}

/// What equations and observers leave of the prior where runs over it reach less than a quarter of
/// the measurements; nothing where they reach more, or nothing is gained.
inline std::optional<window_contraction> contract_by_equations(feasibility_test& test,
                                                               identification_problem const& posed,
                                                               work_limit const& limit) {
    if (posed.model.has_memory() || !(test.reached(posed.prior) < 0.25)) return std::nullopt;
    work_limit const own(0.15 * limit.seconds(), limit);
    window_contraction result;
    auto found = contract_without_runs(posed, {.keep_going = own});
    if (!(relative_volume(found.rest, posed.prior).upper() < 1)) return std::nullopt;
    result.rest = std::move(found.rest);
    result.by_equations = found.by_equations;
    result.by_observers = found.by_observers;
    for (auto const& e : posed.experiments) result.starts.push_back(e.initial);
    result.seconds = own.spent();
    return result;
}

/// What one window of each experiment, from its begin, leaves where runs over the prior reach less
/// than half of the measurements, or where there are so many parameters that halving them is slow;
/// nothing where neither is so, or nothing is gained.
/// @param share  of the time, at most
inline std::optional<window_contraction>
contract_by_growing_windows(feasibility_test& test, identification_problem const& posed,
                            identify_options const& options, work_limit const& limit,
                            double share = 0.7) {
    constexpr std::size_t many = 5;
    if (posed.prior.size() < many && !(test.reached(posed.prior) < 0.5)) return std::nullopt;
    auto found = contract_by_windows(posed, {.run = options.test,
                                             .seconds = share * limit.seconds(),
                                             .keep_going = limit,
                                             .workers = options.search.workers,
                                             .chained = 1});
    if (!(relative_volume(found.rest, posed.prior).upper() < 1)) return std::nullopt;
    return found;
}

/// What windows all along the records leave, with slower inputs where there are any, in states that
/// equations know; nothing where nothing is gained. For what equations have told something of while
/// runs over what they left end early all the same, such as an arm with dry friction.
inline std::optional<window_contraction>
contract_by_guided_windows(identification_problem const& posed, identify_options const& options,
                           work_limit const& limit) {
    auto seen = posed;
    seen.model = with_states_seen(posed.model, "recorded state ");
    double const period = 10 * sample_period(posed);
    auto const slow = period > 0 ? with_slower_inputs(seen, period) : std::nullopt;
    auto const& carried = slow ? *slow : posed;
    equation_guide const guide(posed, carried, limit);
    auto found = contract_by_windows(carried, {.run = options.test,
                                               .seconds = 0.9 * limit.seconds(),
                                               .keep_going = limit,
                                               .workers = options.search.workers,
                                               .windows = 16,
                                               .equations = std::cref(guide)});
    if (!(relative_volume(found.rest, posed.prior).upper() < 1)) return std::nullopt;
    if (slow) found.input_period = period;
    return found;
}

/// What can be left of the prior, and of starts, by means that are quicker than the search; nothing
/// where the search does as well.
/// @param test    of `posed`
/// @param fitted  parameters that explain the data best, or the prior
/// @param starts  of each experiment, with them; or none
inline std::optional<window_contraction>
contract_prior(feasibility_test& test, identification_problem const& posed, box const& fitted,
               std::vector<box> const& starts, identify_options const& options,
               work_limit const& limit) {
    std::optional<window_contraction> result;
    auto hindered = posed;
    std::optional<feasibility_test> after;
    auto const go_on_with = [&](window_contraction found) {
        result = result ? joined(*result, std::move(found)) : std::move(found);
        if (result->empty()) return false;
        hindered = narrowed_by(*result, std::move(hindered));
        hindered.prior = result->rest;
        if (after) result->integrations += after->integrations();
        after.emplace(hindered, options.test);
        return true;
    };
    auto const asked = [&]() -> feasibility_test& { return after ? *after : test; };
    bool again = false, slowed = false;
    if (options.shapes && limit() && test.reached(posed.prior) < 0.25) {
        if (auto found = contract_by_shapes(posed, options, limit)) {
            (void)go_on_with(*std::move(found));
            return result;
        }
    }
    if (options.windows && limit())
        again = starts_hinder(test, posed); // of which the equations tell nothing
    if (options.equations && limit()) {
        if (auto found = contract_by_equations(test, posed, limit)) {
            if (!go_on_with(*std::move(found))) return result;
            if (options.windows && !again && asked().reached(hindered.prior) < 0.25) {
                // A window that grows is quick where it is of use.
                auto more = contract_by_growing_windows(asked(), hindered, options, limit, 0.1);
                bool const of_use =
                    more && relative_volume(more->rest, hindered.prior).upper() < 0.5;
                if (!of_use) more = contract_by_guided_windows(hindered, options, limit);
                if (more && (!go_on_with(*std::move(more)) || !of_use)) return result;
            }
        }
    }
    if (options.slower_inputs && limit()) {
        if (auto found =
                contract_by_slower_inputs(asked(), hindered, fitted, starts, options, limit)) {
            slowed = true;
            again = found->windows > 0; // those of use go on with the recorded inputs
            if (!go_on_with(*std::move(found))) return result;
        }
    }
    // Starts that nobody knows are better served by windows all along, once equations have begun.
    if (!slowed && !(again && after) && options.windows && limit()) {
        if (auto found = contract_by_growing_windows(asked(), hindered, options, limit)) {
            if (!go_on_with(*std::move(found))) return result;
            again = false;
        }
    }
    if (options.windows && limit() && (again || starts_hinder(asked(), hindered))) {
        auto found = contract_by_windows(hindered, {.run = options.test,
                                                    .seconds = 0.8 * limit.seconds(),
                                                    .keep_going = limit,
                                                    .workers = options.search.workers});
        result = result ? joined(*result, std::move(found)) : std::move(found);
    }
    if (after) result->integrations += after->integrations();
    return result;
}

} // namespace sivid::paving_detail

#endif
