// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_BERNSTEIN_HPP
#define SIVID_NUMBER_BERNSTEIN_HPP

#include <sivid/number/taylor_model.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

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
template <std::size_t N, std::size_t D>
[[nodiscard]] interval range(taylor_model<N, D> const& a) {
    using traits = interval_traits<interval>;
    using model = taylor_model<N, D>;
    constexpr std::size_t side = D + 1;
    constexpr std::size_t count = [] {
        std::size_t n = 1;
        for (std::size_t v = 0; v < N && n <= 20000; ++v) n *= side;
        return n;
    }();
    auto const rough = rough_range(a);
    if (count > 4096 || !std::isfinite(a.norm())) return rough;
    std::vector<double> tensor(count, 0.0);
    auto const& t = model::basis::data;
    for (std::size_t i = 0; i < model::terms; ++i) {
        std::size_t place = 0;
        for (std::size_t v = 0; v < N; ++v) place = place * side + t.exponents[i][v];
        tensor[place] = a.c[i];
    }
    auto const& m = number_detail::bernstein_of_power<D>;
    std::size_t stride = 1;
    std::array<double, side> line{};
    for (std::size_t v = 0; v < N; ++v, stride *= side) {
        for (std::size_t base = 0; base < count; ++base) {
            if ((base / stride) % side != 0) continue;
            for (std::size_t k = 0; k < side; ++k) {
                line[k] = 0;
                for (std::size_t e = 0; e < side; ++e) {
                    line[k] += tensor[base + e * stride] * m[e][k];
                }
            }
            for (std::size_t k = 0; k < side; ++k) tensor[base + k * stride] = line[k];
        }
    }
    double const lo = *std::min_element(tensor.begin(), tensor.end());
    double const hi = *std::max_element(tensor.begin(), tensor.end());
    // A line's values are bounded by the sum of |coefficients| along it, since |m| <= 1; so are
    // their errors, times (side + 2) units. Summed along the other lines that is the norm, in each
    // stage.
    double const rounding =
        static_cast<double>(N * (2 * side + 8)) * model::unit * a.polynomial_norm();
    auto const w = (rounding + a.r) * model::up + model::tiny;
    auto const tight = traits::add(traits::bounds(lo, hi), traits::bounds(-w, w));
    return traits::intersect(tight, rough);
}

} // namespace sivid

#endif
