// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_OBSERVER_IMPL_OBSERVER_CONTRACTION_IPP
#define SIVID_PAVING_OBSERVER_IMPL_OBSERVER_CONTRACTION_IPP

#include <sivid/paving/observer/detail/observer_contraction.hpp>

#include <sivid/number/interval.hpp>
#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace sivid {

SIVID_DECL box observer_contraction::operator()(box x) {
    using traits = interval_traits<interval>;
    constexpr double refuted_at = 1; // the bounds as they are
    std::function<bool()> const go_on = [this] {
        return !options_.keep_going || options_.keep_going();
    };
    struct end {
        std::size_t side;
        bool lower;
        double share; ///< of the side: the slab that is tried next
    };
    std::vector<end> open;
    for (std::size_t j = 0; j < x.size(); ++j) {
        for (bool const lower : {true, false}) open.push_back({j, lower, 0.25});
    }
    for (std::size_t round = 0; round < options_.rounds && !open.empty(); ++round) {
        std::vector<end> next;
        for (std::size_t from = 0; from < open.size(); from += observer_bank::width) {
            std::vector<end> asked;
            std::vector<box> slabs;
            std::vector<double> inner; // where each slab ends within the box
            auto const to = std::min(from + observer_bank::width, open.size());
            for (std::size_t k = from; k < to; ++k) {
                auto const& e = open[k];
                auto const side = x[e.side];
                double const thick = e.share * width(side);
                double const at = !(e.share < 0.5) ? mid(side)
                                  : e.lower        ? side.lower() + thick
                                                   : side.upper() - thick;
                if (!is_bounded(side) || !(side.lower() < at && at < side.upper())) continue;
                asked.push_back(e);
                inner.push_back(at);
                slabs.push_back(x);
                slabs.back()[e.side] =
                    e.lower ? traits::bounds(side.lower(), at) : traits::bounds(at, side.upper());
            }
            if (slabs.empty()) continue;
            if (!go_on()) return x;
            auto const found = observers_(slabs, refuted_at, go_on);
            for (std::size_t k = 0; k < slabs.size(); ++k) {
                auto e = asked[k];
                if (found.refuted[k]) {
                    auto const side = x[e.side];
                    double const low = e.lower ? std::max(side.lower(), inner[k]) : side.lower();
                    double const high = e.lower ? side.upper() : std::min(side.upper(), inner[k]);
                    if (!(low < high)) // both halves are refuted
                        return empty_box(x.size());
                    x[e.side] = traits::bounds(low, high);
                    e.share = std::min(0.5, 2 * e.share);
                } else {
                    e.share /= 4;
                }
                if (e.share >= options_.least) next.push_back(e);
            }
        }
        open = std::move(next);
    }
    return x;
}

} // namespace sivid

#endif
