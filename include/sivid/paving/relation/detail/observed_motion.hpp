// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_OBSERVED_MOTION_HPP
#define SIVID_PAVING_RELATION_DETAIL_OBSERVED_MOTION_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/differentiate.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/structure/state_sum.hpp>
#include <sivid/paving/relation/channel_tube.hpp>
#include <sivid/paving/relation/detail/model_variation.hpp>
#include <sivid/paving/relation/input_range.hpp>
#include <sivid/paving/relation/integrand_set.hpp>
#include <sivid/paving/relation/state_samples.hpp>
#include <sivid/paving/relation/time_cell.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// What one experiment says about the states at all times: tubes of the states that were measured,
/// and cells on a grid that contains all samples and knots of the inputs.
struct observed_motion {
    std::string name;
    std::vector<std::optional<channel_tube>> tubes; ///< one per state; none where unmeasured
    /// The same by the sensor alone, without the initial state: a constant error of the sensor then
    /// shifts the tube and does not bend it.
    std::vector<std::optional<channel_tube>> sensed;
    std::vector<rate_variation> variation; ///< if declared; of measured states
    std::vector<double> boundaries;        ///< of the cells
    std::vector<time_cell> cells;
    double begin = 0;
    box start; ///< holds all states at `begin`

    [[nodiscard]] std::size_t boundary_at(double t) const {
        return static_cast<std::size_t>(std::lower_bound(boundaries.begin(), boundaries.end(), t) -
                                        boundaries.begin());
    }
    /// Whether what the tube of a state says from a time on rests on where the state starts: tubes
    /// begin with the initial box, and run on from it to the state's next sample.
    [[nodiscard]] bool rests_on_start(std::size_t i, double from) const {
        if (!tubes[i]) return false;
        auto const& times = tubes[i]->times();
        return from <= times.front() || (times.size() > 1 && from < times[1]);
    }
    /// Encloses a state over [from, to]; the whole line where nothing is known.
    [[nodiscard]] interval state_over(std::size_t i, double from, double to) const {
        if (!tubes[i] || !tubes[i]->covers(from, to)) return interval_traits<interval>::entire();
        return tubes[i]->over(from, to);
    }
};

/// Puts the pairs first whose q most motions sense: of several q with one r that is the one to
/// take.
inline void put_sensed_first(std::vector<derivative_pair>& pairs,
                             std::vector<observed_motion> const& motions) {
    auto const count = [&](derivative_pair const& p) {
        return std::count_if(motions.begin(), motions.end(),
                             [&p](observed_motion const& m) { return m.sensed[p.q].has_value(); });
    };
    std::stable_sort(pairs.begin(), pairs.end(),
                     [&](auto const& a, auto const& b) { return count(a) > count(b); });
}

namespace paving_detail {

/// An input over a cell within one piece: samples run along a line, formulas count as still.
inline cell_line input_line(signal const& s, double from, double to) {
    using traits = interval_traits<interval>;
    auto const* sampled = std::get_if<sampled_signal>(&s);
    if (sampled == nullptr) return cell_line::still(input_over(s, from, to));
    auto const piece = sampled->piece(from);
    auto const first = sampled->value<interval>(piece, traits::point(from));
    auto const last = sampled->value<interval>(piece, traits::point(to));
    double const e = std::max(sampled->error_bound(piece, from), sampled->error_bound(piece, to));
    return cell_line::of(mid(first), mid(last),
                         traits::hull(traits::sub(first, traits::point(mid(first))),
                                      traits::sub(last, traits::point(mid(last)))),
                         e);
}

} // namespace paving_detail

/// What is known of a motion between samples.
struct motion_knowledge {
    std::vector<rate_variation> declared;     ///< of measured states
    std::vector<std::vector<double>> in_gaps; ///< what their rates vary by in each gap; or none
    std::vector<std::vector<interval>>
        curvatures{}; ///< where the rates of rates lie there; or none
    /// Samples of states that no channel shows, and of the others narrowed ones; or none.
    std::vector<std::optional<state_samples>> derived{};
    /// Encloses a state between two times: (state, from, to); may be empty.
    std::function<interval(std::size_t, double, double)> reach{};
};

namespace paving_detail {

/// Adds the tubes of the states that are measured, or derived, and the times of their samples.
/// @returns the least spacing of the measured ones
inline double add_tubes(observed_motion& result, experiment const& e,
                        std::vector<std::optional<std::size_t>> const& channels,
                        motion_knowledge const& known) {
    double spacing = HUGE_VAL;
    for (std::size_t i = 0; i < result.tubes.size(); ++i) {
        bool const derived = i < known.derived.size() && known.derived[i];
        if (!channels[i] && !derived) continue;
        auto const s = derived ? *known.derived[i] : state_samples::of(e, i, *channels[i]);
        auto const variations = known.in_gaps.empty()
                                    ? channel_tube::in_gaps(known.declared[i], s.times)
                                    : known.in_gaps[i];
        auto const curvatures =
            known.curvatures.empty() ? std::vector<interval>{} : known.curvatures[i];
        result.tubes[i] = channel_tube::of_gaps(s.times, s.bounds, variations, curvatures);
        result.boundaries.insert(result.boundaries.end(), s.times.begin(), s.times.end());
        if (!channels[i]) continue;
        auto const alone = state_samples::sensed(e, *channels[i]);
        auto const skipped = static_cast<std::ptrdiff_t>(s.times.size() - alone.times.size());
        if (!alone.times.empty()) {
            result.sensed[i] = channel_tube::of_gaps(
                alone.times, alone.bounds, {variations.begin() + skipped, variations.end()});
        }
        if (s.times.size() > 1) spacing = std::min(spacing, s.spacing());
    }
    return spacing;
}

/// What is known over one cell.
inline time_cell cell_over(observed_motion const& motion, box const& prior, experiment const& e,
                           motion_knowledge const& known, double from, double to) {
    using traits = interval_traits<interval>;
    auto const n = motion.tubes.size();
    time_cell cell{from, to, {traits::bounds(from, to), box(n), prior, box(e.inputs.size())}, {}};
    for (std::size_t i = 0; i < n; ++i) {
        auto const seen = motion.state_over(i, from, to);
        auto const reach = known.reach ? traits::intersect(seen, known.reach(i, from, to)) : seen;
        auto& state = cell.at.states[i];
        state = is_empty(reach) ? seen : reach;
        if (!is_bounded(seen) || width(state) < 0.5 * width(seen)) {
            cell.lines.push_back(cell_line::still(state));
            continue;
        }
        auto const& tube = *motion.tubes[i];
        double const first = mid(tube.over(from, from));
        double const last = mid(tube.over(to, to));
        auto const [beside, departure] = tube.beside_line(from, to, first, last);
        cell.lines.push_back(cell_line::of(first, last, beside, departure));
        // Slopes are taken between the line's middle and where the state is.
        state = traits::hull(state, traits::point(cell.lines.back().centre));
    }
    for (std::size_t u = 0; u < e.inputs.size(); ++u) {
        cell.at.inputs[u] = input_over(e.inputs[u], from, to);
        cell.lines.push_back(input_line(e.inputs[u], from, to));
    }
    cell.lines.push_back(cell_line::of(from, to, interval(0.0)));
    return cell;
}

} // namespace paving_detail

/// The tubes and cells of one experiment.
/// @param cells_per_gap  cells between two samples
/// @guarantee  every motion that keeps the bounds of `e` and is like what is known lies in the
/// cells
[[nodiscard]] inline observed_motion
observe_motion(bound_model const& model, box const& prior, experiment const& e,
               std::vector<std::optional<std::size_t>> const& channels,
               motion_knowledge const& known, std::size_t cells_per_gap) {
    observed_motion result;
    result.name = e.name;
    result.variation = known.declared;
    result.begin = e.begin;
    result.start = e.initial;
    result.tubes.resize(model.state_count());
    result.sensed.resize(model.state_count());
    double const spacing = paving_detail::add_tubes(result, e, channels, known);
    double end = e.begin;
    for (double const t : result.boundaries) end = std::max(end, t);
    if (!(end > e.begin)) return result;
    add_knots(result.boundaries, e.inputs, e.begin, end);
    result.boundaries =
        refined_times(std::move(result.boundaries), spacing / static_cast<double>(cells_per_gap));
    for (std::size_t c = 0; c + 1 < result.boundaries.size(); ++c) {
        result.cells.push_back(paving_detail::cell_over(
            result, prior, e, known, result.boundaries[c], result.boundaries[c + 1]));
    }
    return result;
}

/// The same by what the model proves of its own motions over the prior.
/// @param sums  of states of the model (`find_state_sums`)
[[nodiscard]] inline observed_motion
proved_motion(bound_model const& model, box const& prior, experiment const& e,
              std::vector<std::optional<std::size_t>> const& channels, std::size_t cells_per_gap,
              std::vector<state_sum> const& sums) {
    model_variation by_model(model, prior, e, channels, false, sums);
    auto const reach = by_model.enclose();
    auto const over = [&](std::size_t i, double from, double to) {
        return by_model.cells().over(reach, i, from, to);
    };
    return observe_motion(model, prior, e, channels,
                          {{},
                           by_model.of_gaps(reach.over),
                           by_model.curvatures(reach.over),
                           by_model.cells().samples(),
                           over},
                          cells_per_gap);
}

/// By what a state damps itself, \f$ -\partial f_i/\partial x_i \f$, at the middle of the prior and
/// of the tubes: the median over all cells, at least 0 [1/time]. Weights that grow by it are
/// numbers along each motion. It proves nothing and need not.
/// @param model  to whose graph the derivative is added
[[nodiscard]] inline double damping_of(bound_model& model, std::size_t state,
                                       std::vector<observed_motion> const& motions) {
    auto const own = model.g.leaf(operation::state, state);
    auto const slope = differentiate(model.g, {model.rate[state]}, {own})[0][0];
    graph_range range(model.g, {slope});
    std::vector<double> all;
    double longest = 1e-100;
    for (auto const& m : motions) {
        for (auto const& c : m.cells) {
            auto at = c.at;
            for (auto* x : {&at.states, &at.constants}) {
                for (std::size_t k = 0; k < x->size(); ++k) (*x)[k] = interval(mid((*x)[k]));
            }
            range.evaluate(at);
            auto const& value = range.value(slope);
            if (!range.undefined(slope) && is_bounded(value)) all.push_back(-mid(value));
        }
        if (!m.cells.empty()) longest = std::max(longest, m.cells.back().to - m.cells[0].from);
    }
    if (all.empty()) return 0;
    auto const middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return std::clamp(*middle, 0.0, 300 / longest);
}

} // namespace sivid

#endif
