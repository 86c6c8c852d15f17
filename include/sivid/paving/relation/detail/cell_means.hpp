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
/// Means of functions over cells: [function][cell].
/// @param pairs  whose r are to be frozen
/// @cost  three evaluations of the graph for each cell
[[nodiscard]] inline std::vector<std::vector<cell_means>>
means_over(integrand_set const& set, std::vector<time_cell> const& cells,
           std::vector<derivative_pair> const& pairs) {
    using traits = interval_traits<interval>;
    auto const count = set.functions.size();
    std::vector<node_id> all = set.functions;
    for (auto const& row : set.slopes) all.insert(all.end(), row.begin(), row.end());
    graph_range natural(*set.g, all);
    graph_range centred(*set.g, set.functions);
    graph_range frozen(*set.g, set.functions);
    std::vector<std::vector<cell_means>> result(count);
    for (auto const& cell : cells) {
        natural.evaluate(cell.at);
        auto at_centre = cell.at;
        auto const states = cell.at.states.size();
        auto const inputs = cell.at.inputs.size();
        for (std::size_t k = 0; k < states; ++k) {
            at_centre.states[k] = traits::point(cell.lines[k].centre);
        }
        for (std::size_t k = 0; k < inputs; ++k) {
            at_centre.inputs[k] = traits::point(cell.lines[states + k].centre);
        }
        at_centre.time = traits::point(cell.lines.back().centre);
        auto at_frozen = cell.at;
        for (auto const& pair : pairs) at_frozen.states[pair.r] = at_centre.states[pair.r];
        centred.evaluate(at_centre);
        frozen.evaluate(at_frozen);
        for (std::size_t j = 0; j < count; ++j) {
            auto const f = set.functions[j];
            cell_means r;
            r.whole = natural.value(f);
            r.frozen = frozen.value(f);
            bool smooth = set.continuous[j] && !natural.undefined(f);
            r.swing = width(r.whole);
            auto mean = centred.value(f);
            auto moved = traits::point(0.0);
            auto mean_frozen = mean;
            for (std::size_t k = 0; k < cell.lines.size(); ++k) {
                if (!set.uses(j, k)) continue;
                auto const slope = set.slopes[j][k];
                auto const& range = natural.value(slope);
                smooth = smooth && !natural.undefined(slope) && is_bounded(range);
                if (!smooth) break;
                auto const shift = mean_product(range, cell.lines[k]);
                mean = traits::add(mean, shift);
                auto const off = traits::sub(leaf_over(cell.at, k, states, inputs),
                                             traits::point(cell.lines[k].centre));
                moved = traits::add(
                    moved, traits::mul(traits::point(mag(range)), traits::point(mag(off))));
                bool const held = std::any_of(pairs.begin(), pairs.end(),
                                              [k](auto const& pair) { return pair.r == k; });
                if (!held) mean_frozen = traits::add(mean_frozen, shift);
            }
            if (smooth) {
                // At the centre it is a number, or moves itself: slopes by constants do.
                moved = traits::add(moved, traits::point(width(centred.value(f))));
                r.swing = std::min(r.swing, moved.upper());
                r.whole = traits::intersect(r.whole, mean);
                r.frozen = traits::intersect(r.frozen, mean_frozen);
            } else {
                r.frozen = traits::entire();
            }
            for (auto const& pair : pairs) {
                r.slopes.push_back(natural.value(set.slopes[j][pair.r]));
            }
            result[j].push_back(std::move(r));
        }
    }
    return result;
}

} // namespace sivid

#endif
