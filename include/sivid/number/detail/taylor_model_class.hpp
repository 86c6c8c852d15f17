// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_DETAIL_TAYLOR_MODEL_CLASS_HPP
#define SIVID_NUMBER_DETAIL_TAYLOR_MODEL_CLASS_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/lanes.hpp>
#include <sivid/number/monomials.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace sivid {

/// A function on \f$ [-1,1]^N \f$ enclosed by a polynomial of total degree D and a radius:
///   \f$ f(q) \in \sum_{|\alpha| \le D} c_\alpha q^\alpha + [-r, r] \f$ for all q.
/// Coefficients are doubles; every rounding and truncation error is in the radius. The arithmetic
/// needs no rounding mode: error bounds hold for any mode (unit 2^-52) and for fused operations.
/// A radius that is not finite means that nothing is known.
/// @tparam C  `double`, or `lanes<W>`: W such functions side by side
/// @ref  Makino and Berz, Int. J. Pure Appl. Math. 4 (2003); rounding bounds: Higham 2002, chapter
/// 3
template <std::size_t N, std::size_t D, class C = double>
struct taylor_model {
    using scalar = C;
    using side_by_side = lane_traits<C>;
    using basis = monomials<N, D>;
    static constexpr std::size_t variables = N;
    static constexpr std::size_t degree = D;
    static constexpr std::size_t terms = basis::count;
    /// Twice the unit roundoff: an error bound of one operation in any rounding mode.
    static constexpr double unit = std::numeric_limits<double>::epsilon();
    /// Makes a computed sum of at most `terms` + a few dozen non-negative numbers an upper bound.
    static constexpr double up = 1 + (4 * static_cast<double>(terms + D * D) + 64) * unit;
    /// More than all underflow errors of one operation.
    static constexpr double tiny = 1e-290;

    std::array<C, terms> c;
    C r;
    std::array<C, D + 1> norms; ///< upper bounds of \f$ \sum_{|\alpha|=k} |c_\alpha| \f$
    C above;                    ///< upper bound of the norms 1 .. D together

    /// The function 0.
    taylor_model() : c{}, r{}, norms{}, above{} {}
    /// For a result that is written at once.
    struct unset {};
    explicit taylor_model(unset) {}

    /// Values beyond this are given up: near the overflow, what happens depends on the rounding
    /// mode.
    static constexpr double largest = 1e300;

    /// Forgets everything when an operation on values of size `mass` may have overflowed.
    void give_up_when_huge(C const& mass) {
        r = side_by_side::select((mass < largest) & (r < largest), r,
                                 std::numeric_limits<double>::infinity());
    }

    /// Recomputes the norms; to be called after `c` was written.
    void finish() { finish(std::make_index_sequence<D + 1>{}); }
    /// The norms of a multiple, from those of what was multiplied: each coefficient that is not 0
    /// is rounded once, in the subnormal range by less than itself.
    void finish_multiple(taylor_model const& a, C const& size) {
        auto const multiple = [&size](C const& norm) {
            return norm * size * up + side_by_side::min(norm, C(tiny));
        };
        for (std::size_t k = 0; k <= D; ++k) norms[k] = multiple(a.norms[k]);
        above = multiple(a.above);
    }
    /// Bound of the polynomial without its constant term.
    [[nodiscard]] C spread() const { return above; }
    /// Bound of the polynomial.
    [[nodiscard]] C polynomial_norm() const { return (norms[0] + above) * up; }
    /// Bound of everything: \f$ |f(q)| \f$.
    [[nodiscard]] C norm() const { return (polynomial_norm() + r) * up; }

    [[nodiscard]] static taylor_model constant(C const& v) {
        taylor_model result;
        result.c[0] = v;
        result.norms[0] = side_by_side::abs(v);
        result.give_up_when_huge(result.norms[0]);
        return result;
    }
    [[nodiscard]] static taylor_model constant(interval const& v) {
        auto result = constant(C(mid(v)));
        result.r = is_empty(v) ? std::numeric_limits<double>::infinity() : rad(v);
        return result;
    }
    /// No variable has an influence, in any lane.
    [[nodiscard]] bool is_constant() const { return side_by_side::all(above == C(0.0)); }
    /// centre + slope * q_v
    [[nodiscard]] static taylor_model variable(std::size_t v, C const& centre, C const& slope) {
        static_assert(D >= 1);
        auto result = constant(centre);
        result.c[basis::data.variable[v]] = slope;
        result.finish();
        return result;
    }

private:
    /// Sum of so many absolute values, as a tree: the additions do not wait for each other.
    template <std::size_t First, std::size_t Count>
    [[nodiscard, gnu::always_inline]] C sizes() const {
        if constexpr (Count == 1) {
            return side_by_side::abs(c[First]);
        } else if constexpr (Count <= 16) {
            return sizes<First, Count / 2>() + sizes<First + Count / 2, Count - Count / 2>();
        } else {
            constexpr std::size_t chains = 4, rest = Count % chains, end = First + Count - rest;
            std::array<C, chains> sum{};
            for (std::size_t i = First; i < end; i += chains) {
                for (std::size_t j = 0; j < chains; ++j) sum[j] += side_by_side::abs(c[i + j]);
            }
            for (std::size_t j = 0; j < rest; ++j) sum[j] += side_by_side::abs(c[end + j]);
            return (sum[0] + sum[1]) + (sum[2] + sum[3]);
        }
    }
    template <std::size_t... K>
    [[gnu::always_inline]] void finish(std::index_sequence<K...>) {
        constexpr auto const& first = basis::data.first;
        ((norms[K] = sizes<first[K], first[K + 1] - first[K]>() * up), ...);
        C sum{};
        for (std::size_t k = 1; k <= D; ++k) sum += norms[k];
        above = sum * up;
    }
};

} // namespace sivid

#endif
