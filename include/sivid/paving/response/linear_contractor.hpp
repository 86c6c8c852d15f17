// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RESPONSE_LINEAR_CONTRACTOR_HPP
#define SIVID_PAVING_RESPONSE_LINEAR_CONTRACTOR_HPP

#include <sivid/paving/response/relaxed_intersection.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_clock.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// A measurement as a linear constraint on the deviations of an ensemble:
///   \f$ gradient \cdot r \in target \f$, where target = bound - rest.
struct linear_constraint {
    std::vector<double> gradient;
    interval target;
};

/// Removes from `r` what violates the constraint: for each j
///   \f$ r_j \leftarrow r_j \cap (target - \sum_{l \ne j} g_l r_l) / g_j \f$.
/// @returns false when nothing is left (then `r` is meaningless)
/// @cost  O(n), by prefix sums from both sides
[[nodiscard]] inline bool contract(box& r, linear_constraint const& c) {
    using traits = interval_traits<interval>;
    std::size_t const n = r.size();
    work_clock::count(4 * n, work_clock::interval);
    std::vector<interval> suffix(n + 1, traits::point(0.0));
    for (std::size_t j = n; j-- > 0;) {
        suffix[j] = traits::add(suffix[j + 1], traits::mul(traits::point(c.gradient[j]), r[j]));
    }
    if (traits::disjoint(suffix[0], c.target)) return false;
    interval prefix = traits::point(0.0);
    for (std::size_t j = 0; j < n; ++j) {
        double const g = c.gradient[j];
        if (g != 0 && !traits::is_point(r[j])) {
            auto const others = traits::add(prefix, suffix[j + 1]);
            bool undefined = false;
            auto const allowed =
                traits::div(traits::sub(c.target, others), traits::point(g), undefined);
            r[j] = traits::intersect(r[j], allowed);
            if (traits::is_empty(r[j])) return false;
        }
        prefix = traits::add(prefix, traits::mul(traits::point(g), r[j]));
    }
    return true;
}

/// Applies all constraints in turn until little changes.
[[nodiscard]] inline bool contract(box& r, std::vector<linear_constraint> const& constraints,
                                   int passes = 6) {
    for (int pass = 0; pass < passes; ++pass) {
        auto const before = r;
        for (auto const& c : constraints) {
            if (!contract(r, c)) return false;
        }
        bool moved = false;
        for (std::size_t j = 0; j < r.size(); ++j) {
            moved = moved || width(r[j]) < 0.98 * width(before[j]);
        }
        if (!moved) break;
    }
    return true;
}

/// The same when up to q of the constraints may be violated: each contracts on its own, and what q
/// + 1 of them exclude is excluded.
/// @guarantee  keeps every point that violates at most q constraints
[[nodiscard]] inline bool relaxed_contract(box& r,
                                           std::vector<linear_constraint> const& constraints,
                                           std::size_t q, int passes = 3) {
    if (q == 0) return contract(r, constraints);
    for (int pass = 0; pass < passes && constraints.size() > q; ++pass) {
        std::vector<std::vector<interval>> sides(r.size());
        std::size_t excluded = 0;
        for (auto const& constraint : constraints) {
            auto mine = r;
            if (contract(mine, constraint)) {
                for (std::size_t j = 0; j < r.size(); ++j) sides[j].push_back(mine[j]);
            } else {
                ++excluded;
            }
        }
        if (excluded > q) return false;
        auto const before = r;
        bool moved = false;
        for (std::size_t j = 0; j < r.size(); ++j) {
            r[j] = interval_traits<interval>::intersect(
                r[j], relaxed_intersection(sides[j], q - excluded));
            if (is_empty(r[j])) return false;
            moved = moved || width(r[j]) < 0.95 * width(before[j]);
        }
        if (!moved) break;
    }
    return true;
}

} // namespace sivid

#endif
