// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAVING_PROJECTIONS_HPP
#define SIVID_REPORT_PAVING_PROJECTIONS_HPP

#include <sivid/compiled.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/report/paving_plot.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid::report {

/// A paving with what its sides are called.
struct named_paving {
    subpaving const* paving = nullptr;
    std::vector<axis> sides{};     ///< bounds: the prior
    std::vector<range> hull{};     ///< per side: what the data leave of it
    std::vector<double> witness{}; ///< a verified point; may be empty
};

/// The projection of a paving on its sides a and b.
[[nodiscard]] SIVID_ENTRY paving_projection projection(named_paving const& p, std::size_t a,
                                                       std::size_t b);

/// The projections worth a picture: on all pairs of sides when these are few, else of the four that
/// the data narrow most.
/// @param first  sides whose pairs come first
/// @param most   so many projections
[[nodiscard]] SIVID_ENTRY std::vector<paving_projection>
projections(named_paving const& p, std::vector<std::size_t> const& first, std::size_t most);

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_PAVING_PROJECTIONS)
SIVID_ENTRY paving_projection projection(named_paving const& p, std::size_t a, std::size_t b) {
    paving_projection out{.x = p.sides[a], .y = p.sides[b]};
    auto const side = [](box const& set, std::size_t j) {
        return range{lower(set[j]), upper(set[j])};
    };
    for (paved_box const& piece : p.paving->boxes()) {
        if (piece.verdict == box_verdict::outside) {
            continue;
        }
        out.boxes.push_back({side(piece.set, a), side(piece.set, b),
                             piece.verdict == box_verdict::inside      ? region::inside
                             : piece.verdict == box_verdict::undecided ? region::undecided
                                                                       : region::pending});
    }
    if (!p.witness.empty()) {
        out.witness = point{p.witness[a], p.witness[b]};
    }
    return out;
}

SIVID_ENTRY std::vector<paving_projection>
projections(named_paving const& p, std::vector<std::size_t> const& first, std::size_t most) {
    std::vector<std::size_t> order;
    for (std::size_t j = 0; j < p.sides.size(); ++j) {
        if (p.sides[j].bounds.lo < p.sides[j].bounds.hi) {
            order.push_back(j);
        }
    }
    auto const share = [&](std::size_t j) {
        return approximate_width(p.hull[j]) / approximate_width(p.sides[j].bounds);
    };
    if (order.size() > 4) {
        std::stable_sort(order.begin(), order.end(),
                         [&](auto a, auto b) { return share(a) < share(b); });
        order.resize(4);
    }
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t a = 0; a < order.size(); ++a) {
        for (std::size_t b = a + 1; b < order.size(); ++b) {
            pairs.emplace_back(order[a], order[b]);
        }
    }
    std::stable_partition(pairs.begin(), pairs.end(), [&](auto const& pair) {
        return std::count(first.begin(), first.end(), pair.first) +
                   std::count(first.begin(), first.end(), pair.second) ==
               2;
    });
    pairs.resize(std::min(pairs.size(), most));
    std::vector<paving_projection> out;
    for (auto const& [a, b] : pairs) {
        out.push_back(projection(p, a, b));
    }
    return out;
}
#endif

} // namespace sivid::report

#endif
