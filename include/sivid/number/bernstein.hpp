// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_BERNSTEIN_HPP
#define SIVID_NUMBER_BERNSTEIN_HPP

#include <sivid/number/taylor_model.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace sivid {

namespace number_detail {

/// m[e][k]: coefficient k of \f$ q^e = (2 s - 1)^e \f$, s in [0,1], in the Bernstein basis of
/// degree D. It is the mean of the products of e of D numbers, k of which are 1 and the others -1
/// (the blossom at the corners), so a ratio of small integers of size at most 1.
template <std::size_t D>
inline constexpr auto bernstein_of_power = [] {
    std::array<std::array<double, D + 1>, D + 1> m{};
    for (std::size_t e = 0; e <= D; ++e) {
        for (std::size_t k = 0; k <= D; ++k) {
            double sum = 0;
            for (std::size_t j = 0; j <= e; ++j) {
                if (j > k || e - j > D - k) continue;
                auto const ways = static_cast<double>(binomial(k, j) * binomial(D - k, e - j));
                sum += (e - j) % 2 == 0 ? ways : -ways;
            }
            m[e][k] = sum / static_cast<double>(binomial(D, e));
        }
    }
    return m;
}();

} // namespace number_detail

/// Bounds a Taylor model over \f$ [-1,1]^N \f$ by the Bernstein coefficients of its polynomial,
/// which are exact at the corners; falls back to the norms when there would be too many of them.
/// @cost  O((D+1)^N N D)
/// @ref   Garloff 1986: Bernstein polynomials enclose the range
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] value_bounds<C> bounds(taylor_model<N, D, C> const& a) {
    using model = taylor_model<N, D, C>;
    using side_by_side = lane_traits<C>;
    constexpr std::size_t side = D + 1;
    constexpr std::size_t count = [] {
        std::size_t n = 1;
        for (std::size_t v = 0; v < N && n <= 20000; ++v) n *= side;
        return n;
    }();
    auto const rough = rough_bounds(a);
    if constexpr (count > 4096 || D < 2) {
        return rough;
    } else {
        if (a.is_constant()) return rough;
        std::array<C, count> tensor{};
        auto const& t = model::basis::data;
        for (std::size_t i = 0; i < model::terms; ++i) {
            std::size_t place = 0;
            for (std::size_t v = 0; v < N; ++v) place = place * side + t.exponents[i][v];
            tensor[place] = a.c[i];
        }
        auto const& m = number_detail::bernstein_of_power<D>;
        std::size_t stride = 1;
        std::array<C, side> line{};
        for (std::size_t v = 0; v < N; ++v, stride *= side) {
            for (std::size_t base = 0; base < count; ++base) {
                if ((base / stride) % side != 0) continue;
                for (std::size_t e = 0; e < side; ++e) line[e] = tensor[base + e * stride];
                for (std::size_t k = 0; k < side; ++k) {
                    C sum = line[0] * m[0][k];
                    for (std::size_t e = 1; e < side; ++e) sum += line[e] * m[e][k];
                    tensor[base + k * stride] = sum;
                }
            }
        }
        C lo = tensor[0];
        C hi = tensor[0];
        for (std::size_t k = 1; k < count; ++k) {
            lo = side_by_side::min(lo, tensor[k]);
            hi = side_by_side::max(hi, tensor[k]);
        }
        // A line's values are bounded by the sum of |coefficients| along it, since |m| <= 1; so
        // are their errors, times (side + 2) units. Summed along the other lines that is the norm,
        // in each stage; the last two operations below add less than four units of it.
        constexpr double stages = static_cast<double>(N * (2 * side + 8)) + 8;
        C const norm = a.polynomial_norm();
        C const out = (norm * (stages * model::unit) + a.r) * model::up +
                      (norm + a.r) * (4 * model::unit) + model::tiny;
        // Where nothing is known of the polynomial the rough bounds say so.
        auto const known = norm < C(model::largest);
        return {side_by_side::select(known, side_by_side::max(lo - out, rough.lower), rough.lower),
                side_by_side::select(known, side_by_side::min(hi + out, rough.upper), rough.upper)};
    }
}

/// The same as an interval.
template <std::size_t N, std::size_t D>
[[nodiscard]] interval range(taylor_model<N, D> const& a) {
    auto const b = bounds(a);
    if (!std::isfinite(b.lower) || !std::isfinite(b.upper))
        return interval_traits<interval>::entire();
    return interval(b.lower, b.upper);
}

} // namespace sivid

#endif
