// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STEP_DETAIL_PERTURBATION_BOUND_HPP
#define SIVID_ENCLOSURE_STEP_DETAIL_PERTURBATION_BOUND_HPP

#include <sivid/number/pack/lanes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sivid {

namespace detail {

/// A time in pieces that are short against a matrix.
template <class C>
struct short_pieces {
    typename lane_traits<C>::mask known; ///< where the matrix and the time are not too large
    double count = 1;                    ///< a power of two
};
/// @param finely  h |M| is at most 1/finely in each of them, |M| the largest sum of a row
/// @param most    what h |M| may be in all
template <class C>
[[nodiscard]] short_pieces<C> pieces_of(std::vector<C> const& m, std::size_t n, C const& h,
                                        double finely, double most) {
    using side_by_side = lane_traits<C>;
    short_pieces<C> result{typename side_by_side::mask(true)};
    C norm{};
    for (std::size_t i = 0; i < n; ++i) {
        C row{};
        for (std::size_t j = 0; j < n; ++j) row += side_by_side::abs(m[i * n + j]);
        result.known = result.known & (row * h <= C(most));
        norm = side_by_side::max(row, norm);
    }
    double largest = 0;
    for (std::size_t l = 0; l < side_by_side::count; ++l) {
        if (side_by_side::test(result.known, l)) {
            largest = std::max(largest, side_by_side::get(norm * h, l));
        }
    }
    while (result.count < finely * largest) result.count *= 2;
    return result;
}

} // namespace detail

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
    // Covers the errors of a few thousand operations on each term.
    constexpr double slack = 1e-12;
    constexpr double tiny = 1e-290;
    constexpr std::size_t terms = 16;
    auto const n = begin.size();
    auto [known, pieces] = detail::pieces_of(m, n, h, 1, 4096);
    for (std::size_t i = 0; i < n; ++i) {
        C const from = begin[i], to = end[i];
        known = known & (from < C(1e300)) & (to < C(1e300));
    }
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

/// The same bound from a matrix A in the middle of the Jacobian: for \f$ d' = A d + v \f$ with
/// \f$ |v_i(s)| \le W_i(s) \f$, what the entries beside A do included in W,
///   \f$ |d(h)| \le \sum_k |e^{A (h - s_{k+1})}| c_k \f$
/// over pieces of length \f$ \tau \le 1/(16 \|A\|) \f$, where \f$ c_k \f$ bounds what piece k
/// brings. Signs cancel in the exponentials, so that what oscillates is not taken for growth.
/// @param a  A, n x n, row by row; any signs
/// @returns a bound of |d(h)|, infinite where A or W is not finite or h |A| is beyond 16. For a W
///          that does not vary it bounds |d| on all of [0, h].
/// @cost  O(max(1, h |A|) n^3)
template <class C>
[[nodiscard]] std::vector<C> bound_linear_perturbation(std::vector<C> const& a,
                                                       std::vector<C> const& begin,
                                                       std::vector<C> const& end, C const& h) {
    using side_by_side = lane_traits<C>;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double unit = std::numeric_limits<double>::epsilon();
    constexpr double up = 1 + 1e-12;
    auto const n = begin.size();
    auto const [known, pieces] = detail::pieces_of(a, n, h, 16, 16);
    C const step = h * (1 / pieces);
    auto metzler = a;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            if (i != j) metzler[i * n + j] = side_by_side::abs(a[i * n + j]);
        }
    }
    auto const multiply = [n](std::vector<C> const& x, std::vector<C> const& y) {
        std::vector<C> z(n * n);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 0; k < n; ++k) {
                for (std::size_t j = 0; j < n; ++j) z[i * n + j] += x[i * n + k] * y[k * n + j];
            }
        }
        return z;
    };
    // e^{A step} by ten terms, at a norm of at most 1/16, and its error as a norm of rows.
    std::vector<C> one(n * n);
    for (std::size_t i = 0; i < n; ++i) one[i * n + i] = 1.0;
    auto x = one;
    for (std::size_t k = 10; k >= 1; --k) { // Horner's rule
        x = multiply(a, x);
        C const factor = step * (1 / static_cast<double>(k));
        for (std::size_t i = 0; i < n * n; ++i) x[i] = one[i] + x[i] * factor;
    }
    double const error = 8 * (static_cast<double>(n) + 32) * unit;
    auto const norm_of = [n](std::vector<C> const& y) {
        C most{};
        for (std::size_t i = 0; i < n; ++i) {
            C row{};
            for (std::size_t j = 0; j < n; ++j) row += side_by_side::abs(y[i * n + j]);
            most = side_by_side::max(row, most);
        }
        return most * up;
    };
    C const size = norm_of(x) + error;
    std::vector<C> d(n), first(n), last(n);
    auto e = one; // e^{A (h - s)} for the pieces from the last one to the first
    C off{};      // of e, as a norm of rows
    for (double piece = pieces; piece-- > 0;) {
        for (std::size_t i = 0; i < n; ++i) {
            C const slope = end[i] - begin[i];
            double const slack = 1 + 8 * unit;
            first[i] = side_by_side::max(begin[i] + slope * (piece / pieces), C(0.0)) * slack +
                       (begin[i] + end[i]) * (4 * unit);
            last[i] = side_by_side::max(begin[i] + slope * ((piece + 1) / pieces), C(0.0)) * slack +
                      (begin[i] + end[i]) * (4 * unit);
        }
        auto const c = bound_perturbation(metzler, first, last, step);
        C most{};
        for (auto const& y : c) most = side_by_side::max(y, most);
        for (std::size_t i = 0; i < n; ++i) {
            C sum = off * most;
            for (std::size_t j = 0; j < n; ++j) sum += side_by_side::abs(e[i * n + j]) * c[j];
            d[i] += sum * up;
        }
        off = (off * size + norm_of(e) * error * 2) * up;
        e = multiply(e, x);
    }
    for (auto& y : d) y = side_by_side::select(known & (y * up < C(1e300)), y * up, C(infinity));
    return d;
}

} // namespace sivid

#endif
