// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_CANDIDATE_DETAIL_DEEPEST_VALLEY_HPP
#define SIVID_APPROXIMATE_CANDIDATE_DETAIL_DEEPEST_VALLEY_HPP

#include <sivid/approximate/candidate/detail/soft_switch.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sivid {

/// Where several functions of one number each, evaluated side by side, are least as far as was
/// looked: where they are, and down the deepest valleys of a grid over [0, 1], ever closer.
/// @param at      numbers -> values, one for each function
/// @param from    where they are
/// @param places  steps of the grid
/// @param finest  step at which descents end; 1: none begins
/// @cost  places + 2 evaluations, 2 for each halving of a step; three times as many down to 16
/// times
///        the finest step
template <class At>
[[nodiscard]] std::vector<double> deepest_valley(At const& at, std::vector<double> from, int places,
                                                 double finest) {
    struct spot {
        double place, value;
    };
    constexpr std::size_t valleys = 2;
    auto const lower = [](spot const& a, spot const& b) { return a.value < b.value; };
    auto const count = from.size();
    auto const now = at(from);
    std::vector<std::vector<double>> along;
    for (int k = 0; k <= places; ++k)
        along.push_back(at(std::vector<double>(count, k / double(places))));
    std::vector<std::vector<spot>> spots(count);
    for (std::size_t s = 0; s < count; ++s) {
        for (std::size_t k = 0; k < along.size(); ++k) {
            double const here = along[k][s];
            bool const deep = (k == 0 || here <= along[k - 1][s]) &&
                              (k + 1 == along.size() || here <= along[k + 1][s]);
            if (deep) spots[s].push_back({static_cast<double>(k) / places, here});
        }
        std::stable_sort(spots[s].begin(), spots[s].end(), lower);
        spots[s].resize(std::min(spots[s].size(), valleys), spot{});
        spots[s].insert(spots[s].begin(), {from[s], now[s]});
    }
    auto const descend = [&](std::size_t rank, double by, double end) {
        auto const nth = [&](std::size_t s) -> spot& {
            return spots[s][std::min(rank, spots[s].size() - 1)];
        };
        for (; by > end; by /= 2) {
            for (double const way : {-by, by}) {
                auto probe = from;
                for (std::size_t s = 0; s < count; ++s) probe[s] = nth(s).place + way;
                auto const there = at(probe);
                for (std::size_t s = 0; s < count; ++s)
                    if (there[s] < nth(s).value) nth(s) = {probe[s], there[s]};
            }
        }
        return by;
    };
    double by = 0.5 / places;
    double const coarse = std::min(1.0, 16 * finest);
    for (std::size_t rank = 0; rank <= valleys; ++rank) {
        double const left = descend(rank, 0.5 / places, coarse);
        if (rank == valleys) by = left;
    }
    for (auto& own : spots) std::stable_sort(own.begin(), own.end(), lower);
    (void)descend(0, by, finest); // the best of each
    for (std::size_t s = 0; s < count; ++s) from[s] = spots[s].front().place;
    return from;
}

/// Where a switch is on, as shares of an experiment: below 0 at its start, above 1 never.
struct switch_window {
    double on, off;
};

/// Between which samples a switch is on where each gains so much by that: the window of the largest
/// sum.
/// @param gains   by sample, in order of time
/// @param shares  of the experiment at which the samples are
/// @param ends    which ends the window has; without one it begins at the start, or never ends
/// @cost  O(samples)
[[nodiscard]] inline switch_window best_window(std::vector<double> const& gains,
                                               std::vector<double> const& shares,
                                               episode_ends ends) {
    constexpr double start = -0.05, never = 1.05;
    double const begins_at = ends.begins ? never : start, ends_at = ends.ends ? start : never;
    switch_window best{begins_at, ends_at};
    double sum = 0, least = 0, most = 0, from = start; // least: of what stands before the window
    for (std::size_t k = 0; k <= gains.size(); ++k) {
        bool const last = k == gains.size();
        if (k > 0) sum += gains[k - 1];
        if (k > 0 && !last && !(shares[k] > shares[k - 1])) continue; // at one time
        double const here = k == 0 ? start : last ? never : 0.5 * (shares[k - 1] + shares[k]);
        if (ends.begins && sum < least) {
            least = sum;
            from = here;
        }
        if ((ends.ends || last) && sum - least > most) {
            most = sum - least;
            best = {from, ends.ends ? here : never};
        }
    }
    return best;
}

} // namespace sivid

#endif
