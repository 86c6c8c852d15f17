// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_CELL_MEANS_HPP
#define SIVID_PAVING_RELATION_DETAIL_CELL_MEANS_HPP

#include <sivid/model/graph/graph_range.hpp>
#include <sivid/paving/relation/integrand_set.hpp>
#include <sivid/paving/relation/time_cell.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// Means over one cell: of the function; with all r frozen at their centres. Slopes in r.
struct cell_means {
    interval whole, frozen;
    double swing = 0; ///< at most from some number
    std::vector<interval> slopes;
};
/// Encloses the mean over a cell of D v for a slope D(t) in `slope` and v(t) along the line.
[[nodiscard]] inline interval mean_product(interval const& slope, cell_line const& v) {
    using traits = interval_traits<interval>;
    auto const drift = traits::mul(traits::point(rad(slope)),
                                   traits::mul(traits::point(0.25), traits::point(v.drift)));
    auto const apart = traits::mul(traits::point(mag(slope)), traits::point(v.departure));
    double const off = traits::add(drift, apart).upper();
    return traits::add(traits::mul(slope, v.spread), traits::bounds(-off, off));
}

/// The range over a cell of what line k is of.
[[nodiscard]] inline interval const& leaf_over(leaf_ranges const& at, std::size_t k,
                                               std::size_t states, std::size_t inputs) {
    return k < states ? at.states[k] : k < states + inputs ? at.inputs[k - states] : at.time;
}
namespace paving_detail {

/// All states, inputs and the time at the middles of their lines.
[[nodiscard]] inline leaf_ranges centre_of(time_cell const& cell) {
    using traits = interval_traits<interval>;
    auto at = cell.at;
    auto const states = at.states.size();
    for (std::size_t k = 0; k < states; ++k) at.states[k] = traits::point(cell.lines[k].centre);
    for (std::size_t k = 0; k < at.inputs.size(); ++k)
        at.inputs[k] = traits::point(cell.lines[states + k].centre);
    at.time = traits::point(cell.lines.back().centre);
    return at;
}

/// Evaluations of all functions over one cell.
struct cell_ranges {
    graph_range natural; ///< of their slopes, too
    graph_range centred, frozen;
};

/// The means of function j over a cell that the ranges are of.
[[nodiscard]] inline cell_means mean_over(integrand_set const& set, std::size_t j,
                                          time_cell const& cell, cell_ranges const& ranges,
                                          std::vector<derivative_pair> const& pairs) {
    using traits = interval_traits<interval>;
    auto const f = set.functions[j];
    cell_means r;
    r.whole = ranges.natural.value(f);
    r.frozen = ranges.frozen.value(f);
    r.swing = width(r.whole);
    bool smooth = set.continuous[j] && !ranges.natural.undefined(f);
    auto mean = ranges.centred.value(f);
    auto moved = traits::point(0.0);
    auto mean_frozen = mean;
    for (std::size_t k = 0; k < cell.lines.size(); ++k) {
        if (!set.uses(j, k)) continue;
        auto const slope = set.slopes[j][k];
        auto const& range = ranges.natural.value(slope);
        smooth = smooth && !ranges.natural.undefined(slope) && is_bounded(range);
        if (!smooth) break;
        auto const shift = mean_product(range, cell.lines[k]);
        mean = traits::add(mean, shift);
        auto const& leaf = leaf_over(cell.at, k, cell.at.states.size(), cell.at.inputs.size());
        auto const off = traits::sub(leaf, traits::point(cell.lines[k].centre));
        moved = traits::add(moved, traits::mul(traits::point(mag(range)), traits::point(mag(off))));
        bool const held =
            std::any_of(pairs.begin(), pairs.end(), [k](auto const& pair) { return pair.r == k; });
        if (!held) mean_frozen = traits::add(mean_frozen, shift);
    }
    if (smooth) {
        // At the centre it is a number, or moves itself: slopes by constants do.
        moved = traits::add(moved, traits::point(width(ranges.centred.value(f))));
        r.swing = std::min(r.swing, moved.upper());
        r.whole = traits::intersect(r.whole, mean);
        r.frozen = traits::intersect(r.frozen, mean_frozen);
    } else {
        r.frozen = traits::entire();
    }
    for (auto const& pair : pairs) {
        r.slopes.push_back(ranges.natural.value(set.slopes[j][pair.r]));
    }
    return r;
}

} // namespace paving_detail

/// Means of functions over cells: [function][cell].
/// @param pairs  whose r are to be frozen
/// @cost  three evaluations of the graph for each cell
[[nodiscard]] inline std::vector<std::vector<cell_means>>
means_over(integrand_set const& set, std::vector<time_cell> const& cells,
           std::vector<derivative_pair> const& pairs) {
    std::vector<node_id> all = set.functions;
    for (auto const& row : set.slopes) all.insert(all.end(), row.begin(), row.end());
    paving_detail::cell_ranges ranges{
        {*set.g, all}, {*set.g, set.functions}, {*set.g, set.functions}};
    std::vector<std::vector<cell_means>> result(set.functions.size());
    for (auto const& cell : cells) {
        auto const centre = paving_detail::centre_of(cell);
        auto frozen = cell.at;
        for (auto const& pair : pairs) frozen.states[pair.r] = centre.states[pair.r];
        ranges.natural.evaluate(cell.at);
        ranges.centred.evaluate(centre);
        ranges.frozen.evaluate(frozen);
        for (std::size_t j = 0; j < result.size(); ++j) {
            result[j].push_back(paving_detail::mean_over(set, j, cell, ranges, pairs));
        }
    }
    return result;
}

} // namespace sivid

#endif
