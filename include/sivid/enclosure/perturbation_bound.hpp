// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_PERTURBATION_BOUND_HPP
#define SIVID_ENCLOSURE_PERTURBATION_BOUND_HPP

#include <sivid/number/lanes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sivid {

/// Bounds the distance d between a solution of x' = f(t, x) and one of x' = f(t, x) + w(t) with the
/// same start, where nothing is known of w but \f$ |w_i(s)| \le W_i(s) \f$: it may vary in any
/// measurable way. Componentwise
///   \f$ |d_i|' \le \sum_j M_{ij} |d_j| + W_i(s) \f$, \f$ d(0) = 0 \f$,
/// with \f$ M_{ii} \ge \sup \partial f_i/\partial x_i \f$ and \f$ M_{ij} \ge \sup |\partial
/// f_i/\partial x_j| \f$ where the two solutions are. Off the diagonal M is not negative, so the
/// solution of D' = M D + W bounds |d|. A stable diagonal is used, not its modulus.
///
/// D is summed as a Taylor series over pieces of length \f$ \le 1/\|M\| \f$; floating point in
/// whatever rounding mode, with a bound of its errors added to every piece.
/// @tparam C  `double`, or `lanes<W>`: W such problems side by side
/// @param m       M, n x n, row by row
/// @param begin   W(0), not negative
/// @param end     W(h); in between W is at most the straight line
/// @param h       up to a few units of its last place
/// @returns D(h); infinite where M or W is not finite or h |M| is beyond 4096
/// @cost  O(max(1, h |M|) n^2)
/// @ref   Walter, Differential and Integral Inequalities (1970), section 9; Kapela and Zgliczynski,
///        A Lohner-type algorithm for control systems and ordinary differential inclusions (2009)
template <class C>
[[nodiscard]] std::vector<C> bound_perturbation(std::vector<C> const& m,
                                                std::vector<C> const& begin,
                                                std::vector<C> const& end, C const& h) {
    using side_by_side = lane_traits<C>;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double most = 4096;
    // Covers the errors of a few thousand operations on each term.
    constexpr double slack = 1e-12;
    constexpr double tiny = 1e-290;
    constexpr std::size_t terms = 16;
    auto const n = begin.size();
    C norm{};
    auto known = typename side_by_side::mask(true);
    for (std::size_t i = 0; i < n; ++i) {
        C row{};
        for (std::size_t j = 0; j < n; ++j) row += side_by_side::abs(m[i * n + j]);
        known = known & (row * h <= C(most)) & (begin[i] < C(1e300)) & (end[i] < C(1e300));
        norm = side_by_side::max(row, norm);
    }
    double largest = 0;
    for (std::size_t l = 0; l < side_by_side::count; ++l) {
        if (side_by_side::test(known, l)) {
            largest = std::max(largest, side_by_side::get(norm * h, l));
        }
    }
    double pieces = 1;
    while (pieces < largest) pieces *= 2;
    C const step = h * (1 / pieces);
    auto const inverse = each_lane<C>([&](std::size_t l) { return 1 / side_by_side::get(h, l); });
    std::vector<C> d(n), mass(n), term(n), size(n), next(n), bigger(n);
    for (double piece = 0; piece < pieces; ++piece) {
        double const share = piece / pieces;
        for (std::size_t i = 0; i < n; ++i) {
            term[i] = d[i];
            size[i] = d[i];
            mass[i] = d[i];
        }
        C last{};
        for (std::size_t k = 1; k <= terms; ++k) {
            C const factor = step * (1 / static_cast<double>(k));
            last = C(0.0);
            for (std::size_t i = 0; i < n; ++i) {
                C sum{}, total{};
                if (k == 1) {
                    sum = begin[i] + (end[i] - begin[i]) * share;
                    total = begin[i] + end[i];
                } else if (k == 2) { // W' once more
                    sum = (end[i] - begin[i]) * inverse * step;
                    total = (begin[i] + end[i]) * inverse * step;
                }
                for (std::size_t j = 0; j < n; ++j) {
                    sum += m[i * n + j] * term[j];
                    total += side_by_side::abs(m[i * n + j]) * size[j];
                }
                next[i] = sum * factor;
                bigger[i] = total * factor;
                last = side_by_side::max(bigger[i], last);
            }
            term.swap(next);
            size.swap(bigger);
            for (std::size_t i = 0; i < n; ++i) {
                d[i] += term[i];
                mass[i] += size[i];
            }
        }
        // step |M| <= 1, so the other terms together are less than the last one.
        for (std::size_t i = 0; i < n; ++i) {
            d[i] = side_by_side::max(d[i], C(0.0)) + mass[i] * slack + last + tiny;
        }
    }
    for (auto& x : d) x = side_by_side::select(known & (x < C(1e300)), x, C(infinity));
    return d;
}

} // namespace sivid

#endif
