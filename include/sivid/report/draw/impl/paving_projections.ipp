// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_IMPL_PAVING_PROJECTIONS_IPP
#define SIVID_REPORT_DRAW_IMPL_PAVING_PROJECTIONS_IPP

#include <sivid/report/draw/detail/paving_projections.hpp>

namespace sivid::report {

SIVID_DECL paving_projection projection(named_paving const& p, std::size_t a, std::size_t b) {
    paving_projection out{.x = p.sides[a], .y = p.sides[b]};
    auto const side = [](box const& set, std::size_t j) {
        return range{lower(set[j]), upper(set[j])};
    };
    for (paved_box const& piece : p.paving->boxes()) {
        if (piece.verdict == box_verdict::outside) continue;
        out.boxes.push_back({side(piece.set, a), side(piece.set, b),
                             piece.verdict == box_verdict::inside      ? region::inside
                             : piece.verdict == box_verdict::undecided ? region::undecided
                                                                       : region::pending});
    }
    if (!p.witness.empty()) out.witness = point{p.witness[a], p.witness[b]};
    return out;
}

SIVID_DECL std::vector<paving_projection>
projections(named_paving const& p, std::vector<std::size_t> const& first, std::size_t most) {
    std::vector<std::size_t> order;
    for (std::size_t j = 0; j < p.sides.size(); ++j) {
        if (p.sides[j].bounds.lo < p.sides[j].bounds.hi) order.push_back(j);
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
        for (std::size_t b = a + 1; b < order.size(); ++b) pairs.emplace_back(order[a], order[b]);
    }
    std::stable_partition(pairs.begin(), pairs.end(), [&](auto const& pair) {
        return std::count(first.begin(), first.end(), pair.first) +
                   std::count(first.begin(), first.end(), pair.second) ==
               2;
    });
    pairs.resize(std::min(pairs.size(), most));
    std::vector<paving_projection> out;
    for (auto const& [a, b] : pairs) out.push_back(projection(p, a, b));
    return out;
}

} // namespace sivid::report

#endif
