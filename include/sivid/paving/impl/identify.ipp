// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IMPL_IDENTIFY_IPP
#define SIVID_PAVING_IMPL_IDENTIFY_IPP

#include <sivid/paving/identify.hpp>

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/model/problem_text.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/paving/contract/window_contraction.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/identify_options.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/judge/detail/core_box.hpp>
#include <sivid/paving/judge/detail/posed_search.hpp>
#include <sivid/paving/judge/detail/prior_contraction.hpp>
#include <sivid/paving/judge/detail/resumed_labels.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/judge/witness.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/detail/drawing.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Measurements that fail for every parameter that is left.
inline std::vector<forced_outlier>
find_forced(feasibility_test& test, identification_problem const& problem, box const& hull) {
    std::vector<forced_outlier> forced;
    for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
        if (problem.experiments[s].outliers == 0) continue;
        auto const answer = test.run(s, problem.experiments[s].initial, hull);
        auto const values = output_ranges(*answer, hull);
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (disjoint(values[i], answer->bounds[i])) forced.push_back({s, i});
        }
    }
    return forced;
}

/// Fits and verifies. A fit that ends by a few percent outside of the bounds may have stopped short
/// of its minimum: it goes on from there.
inline void find_witness(feasibility_test& test, identification_problem const& working,
                         work_limit const& limit, identification& result) {
    constexpr double nearly = 1.05;
    approximate_fitter fit(working, limit);
    auto guess = fit();
    for (bool const sharpened : {false, true}) {
        if (guess.parameters.empty()) return;
        bool const better = !result.guess || guess.inflation < result.guess->inflation;
        if (sharpened && !better) return;
        result.witness = verify_witness(test, working, guess.parameters, guess.starts);
        result.guess = guess;
        if (result.witness || !(guess.inflation < nearly) || !limit()) return;
        guess = fit({guess.parameters, guess.starts});
    }
}

/// Whether a box meets what is left.
inline bool is_left(subpaving const& paving, box const& x) {
    return std::any_of(paving.boxes().begin(), paving.boxes().end(), [&x](paved_box const& b) {
        return b.verdict != box_verdict::outside && !is_empty(intersect(b.set, x));
    });
}

/// A state to resume from must agree with the witness and with its own boxes' middles.
/// @param fitted  the guess, in the sides that are searched
/// @param limit   for runs at the middles
/// @throws std::invalid_argument
inline void require_true_state(identification_state const& state,
                               identification_problem const& posed,
                               feasibility_test_options const& test, identification const& known,
                               box const& fitted, work_limit const& limit) {
    if (known.witness) {
        resumed_labels::require_left(state.search, fitted);
        if (state.windows && is_empty(intersect(state.windows->rest, fitted)))
            resumed_labels::refuse("its windows exclude parameters that explain the data");
    }
    auto const starts = known.guess ? starts_of(*known.guess, posed) : std::vector<box>{};
    resumed_labels(posed, limited(test, limit), starts).require_true(state.search, limit);
}

/// A verified witness and the exclusion of its parameters contradict each other: one of them is no
/// proof, and nothing is told.
/// @param resumed  from a state, which may have been altered
/// @throws std::logic_error
inline void require_witness_left(identification const& found, bool resumed) {
    if (!found.witness) return;
    auto const at = point_box(found.witness->parameters);
    bool const left = contains(found.hull, found.witness->parameters) && is_left(found.paving, at);
    if (left &&
        (!found.products || is_left(found.products->paving, found.products->map.forward(at))))
        return;
    if (resumed) resumed_labels::refuse("it excludes parameters that explain the data");
    throw std::logic_error("identify: parameters that explain the data were excluded: a defect, "
                           "please report it");
}

} // namespace paving_detail

SIVID_DECL identification identify(identification_problem const& problem,
                                   identify_options options) {
    problem.require_valid();
    // Every phase ends in time, and soon when told to: integrations and simulations ask.
    double const earlier =
        options.resume ? options.resume->seconds + options.resume->search.seconds : 0;
    work_limit limit(options.search.seconds - earlier, options.search.keep_going);
    // Of the budget, whatever a state says that was spent.
    double const for_labels = 0.05 * options.search.seconds;
    auto const label_test = options.test;
    options.test = limited(std::move(options.test), limit);
    auto const working = paving_detail::as_searched(problem, options.algorithm);
    std::string asked_for; // only states know it
    if (options.resume || options.checkpoint) asked_for = sha256(problem_text(working));
    if (options.resume && options.resume->problem != asked_for)
        throw std::invalid_argument("identify: the state to resume from is of another problem: "
                                    "other data, another model or prior, or other budgets of "
                                    "outliers; resume with what it was begun with, or begin anew");
    options.test = paving_detail::as_searched(std::move(options.test), options.algorithm);
    options.search = paving_detail::as_searched(options.search, options);
    auto const structure = dependence_of(working);
    paving_detail::posed_search searched(working, structure, options);
    auto const& map = searched.map();
    auto const& posed = searched.posed();
    std::optional<feasibility_test> in_parameters;
    if (map) in_parameters.emplace(working, options.test);
    auto& test = map ? *in_parameters : searched.unhindered();
    identification result(problem.prior);
    result.assumptions.push_back(input_assumption(problem.experiments));
    std::vector<box> starts;
    if (options.algorithm == algorithm::contracting) {
        if (!options.resume) {
            paving_detail::find_witness(test, working, limit, result);
        } else if (options.resume->guess && !options.resume->guess->parameters.empty()) {
            auto const& guess = *options.resume->guess;
            result.witness = verify_witness(test, working, guess.parameters, guess.starts);
            result.guess = guess;
        }
        if (result.guess) starts = paving_detail::starts_of(*result.guess, working);
    }
    auto const fitted = !result.guess ? posed.prior
                        : map         ? map->forward(point_box(result.guess->parameters))
                                      : point_box(result.guess->parameters);
    auto windows = options.resume ? options.resume->windows : std::nullopt;
    auto& unhindered = searched.unhindered();
    auto const before = unhindered.integrations();
    if (!options.resume && options.algorithm == algorithm::contracting && limit()) {
        windows = paving_detail::contract_prior(unhindered, posed, fitted, starts, options, limit);
    }
    auto const asking = unhindered.integrations() - before; // the search finds what was answered
    searched.prepare(result.guess, windows);
    auto const& asked = searched.asked();
    auto& searching = searched.test();
    if (windows) {
        result.windows =
            window_effort{windows->windows,
                          windows->longest,
                          windows->seconds,
                          std::min(1.0, relative_volume(windows->rest, posed.prior).upper()),
                          windows->input_period,
                          windows->by_equations,
                          windows->by_observers};
    }
    if (options.resume)
        paving_detail::require_true_state(
            *options.resume, posed, paving_detail::as_searched(label_test, options.algorithm),
            result, fitted, work_limit(for_labels, options.search.keep_going));
    double const spent = limit.spent() + (options.resume ? options.resume->seconds : 0);
    options.search.seconds = std::max(0.0, options.search.seconds - spent);
    auto search = options.search;
    if (map) search.keep_outside = true; // what is drawn is told from them
    search.checkpoint = nullptr;
    // A fit that was cut short is not what an uninterrupted run would go on from.
    bool const prepared = options.resume || limit();
    if (options.checkpoint && prepared) {
        search.checkpoint = [&](search_state const& now) {
            options.checkpoint({result.guess, spent, windows, now, asked_for});
        };
    }
    search.resume = nullptr;
    if (options.resume) search.resume = {options.resume, &options.resume->search};
    auto const integrated = searching.integrations();
    auto found = options.invert_by
                     ? options.invert_by(searching, posed.prior, search, result.guess, windows)
                     : invert(searching, posed.prior, search);
    // Not what was integrated but what the result stands on: resuming repeats some.
    result.integrations = found.cost + integrated - searching.integrations();
    if (windows) found.paving = within(found.paving, windows->rest); // boxes that still wait, too
    auto const left = found.paving.outer_hull();
    limit.allow(options.completing_seconds);
    if (result.witness && !options.only_hulls && found.reason != stop_reason::cancelled &&
        found.paving.count(box_verdict::inside) == 0) {
        auto const point = map ? mid(map->forward(point_box(result.witness->parameters)))
                               : result.witness->parameters;
        if (contains(left, point)) {
            if (auto const core = core_about(searching, left, point)) {
                found.paving = with_inside(found.paving, *core);
            }
        }
    }
    result.reason = found.reason;
    result.proof = std::move(found.proof);
    result.run = options.test;
    result.run.keep_going = nullptr; // it is this call's
    result.boxes = found.tested;
    result.effort = search_effort{found.seconds,
                                  std::min(search.seconds, 1e300),
                                  found.tested,
                                  search.boxes,
                                  {},
                                  search.sufficient_ratio,
                                  search.hull_gain};
    if (search.memory < std::numeric_limits<std::size_t>::max()) {
        result.effort->most_bytes = search.memory;
    }
    if (map) {
        options.search.seconds = limit.seconds();
        options.search.keep_going = limit;
        paving_detail::draw(result, *map, found.paving, problem.prior, options.search,
                            options.drawn_boxes);
    } else {
        result.paving = std::move(found.paving);
        result.hull = left;
    }
    result.verdict = result.witness ? verdict::consistent : proved_verdict(result.paving);
    if (result.paving.has_outer()) {
        result.entangled = structure.entangled;
        result.combinations =
            paving_detail::hulls_of(structure, map ? &left : nullptr, result.paving.boxes());
        result.forced = paving_detail::find_forced(searching, asked, left);
    }
    if (result.excludes_little() && result.reason != stop_reason::decided &&
        result.reason != stop_reason::cancelled) {
        limit.allow(options.completing_seconds); // the box about the witness may have taken all
        run_options run = options.test;
        run.keep_going = limit;
        result.reach = reach_of_runs(asked, left, run);
        result.divisors = divisors_of(problem, {.keep_going = limit});
        std::erase_if(result.divisors, [](divisor const& d) { return d.zeros == zeros::none; });
        for (auto& r : result.reach) {
            for (auto& c : r.causes) {
                if (!map || c.start) continue;
                auto const& side = map->sides()[c.index];
                c.name =
                    side.product ? side.product->formula : problem.choice.unknown[side.parameter];
            }
        }
    }
    paving_detail::require_witness_left(result, options.resume != nullptr);
    result.integrations += searched.integrations() - asking;
    if (in_parameters) result.integrations += in_parameters->integrations();
    if (windows) result.integrations += windows->windows + windows->integrations;
    result.seconds = limit.spent();
    if (options.resume) result.seconds += options.resume->seconds + options.resume->search.seconds;
    return result;
}

} // namespace sivid

#endif
