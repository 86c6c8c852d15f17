// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_DETAIL_POWER_SUM_HPP
#define SIVID_ENCLOSURE_DETAIL_POWER_SUM_HPP

#include <sivid/number/taylor_model.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace sivid {

/// \f$ \sum_{k=0}^{K} h^k a_k \f$ for the length h of a step that is known up to one unit.
///   The powers are off by less than 2k units, a product by one more. Summed from the highest order
///   down, term k stands in k partial sums, each of which is rounded once; the last addition errs
///   by a unit of everything.
/// @param coefficient  k -> \f$ a_k \f$
template <class Model, class Coefficient, class C>
[[nodiscard]] Model at_time(Coefficient const& coefficient, std::size_t K, C const& h) {
    using side_by_side = lane_traits<C>;
    Model sum;
    C radius{}, mass{};
    C const size = side_by_side::abs(h) * (1 + 4 * Model::unit);
    std::vector<C> powers(K + 1, C(1.0));
    for (std::size_t k = 1; k <= K; ++k) powers[k] = powers[k - 1] * h;
    std::vector<C> bounds(K + 1, C(1.0)); // of |h|^k
    for (std::size_t k = 1; k <= K; ++k) bounds[k] = bounds[k - 1] * size;
    for (std::size_t k = K; k > 0; --k) {
        auto const& a = coefficient(k);
        for (std::size_t m = 0; m < Model::terms; ++m) sum.c[m] += powers[k] * a.c[m];
        C const norm = a.polynomial_norm() * bounds[k];
        mass += norm;
        radius += a.r * bounds[k] + norm * (static_cast<double>(3 * k + 1) * Model::unit);
    }
    auto const& first = coefficient(0);
    for (std::size_t m = 0; m < Model::terms; ++m) sum.c[m] += first.c[m];
    C const all = mass + first.polynomial_norm();
    sum.r = (radius + first.r + all * Model::unit) *
                (Model::up + 8 * static_cast<double>(K + 4) * Model::unit) +
            Model::tiny;
    sum.finish();
    sum.give_up_when_huge(all);
    return sum;
}

/// \f$ \sum_{k=0}^{K} s^k a_k(q) \f$ as a function of q and \f$ \tau \in [-1,1] \f$, where
/// \f$ s = h (1 + \tau)/2 \f$; the last variable is \f$ \tau \f$. Terms beyond degree E go into the
/// radius.
template <std::size_t E, std::size_t N, std::size_t D, class C, class Coefficient>
[[nodiscard]] taylor_model<N + 1, E, C> polynomial_in_time_of(Coefficient const& coefficient,
                                                              std::size_t K, C const& h) {
    using model = taylor_model<N, D, C>;
    using result_type = taylor_model<N + 1, E, C>;
    using side_by_side = lane_traits<C>;
    // image[m][j]: where monomial m of q times tau^j stands.
    static constexpr auto image = [] {
        auto const& narrow = monomials<N, D>::data;
        auto const& wide = monomials<N + 1, E>::data;
        std::array<std::array<std::size_t, E + 1>, model::terms> map{};
        for (std::size_t m = 0; m < model::terms; ++m) {
            for (std::size_t j = 0; j <= E; ++j) {
                map[m][j] = result_type::terms;
                if (narrow.degree[m] + j > E) continue;
                for (std::size_t k = 0; k < result_type::terms; ++k) {
                    bool same = wide.exponents[k][N] == j;
                    for (std::size_t v = 0; v < N && same; ++v) {
                        same = wide.exponents[k][v] == narrow.exponents[m][v];
                    }
                    if (same) map[m][j] = k;
                }
            }
        }
        return map;
    }();
    result_type sum;
    C radius{}, mass{};
    C power = C(1.0);                                                    // (h/2)^k
    C const size = side_by_side::abs(h) * (0.5 * (1 + 4 * model::unit)); // bounds |h/2|
    C bound = C(1.0);
    std::array<double, E + 1> binomials{};
    for (std::size_t k = 0; k <= K; ++k) {
        auto const& a = coefficient(k);
        double rest = 1; // 2^k less the binomials that stay
        for (std::size_t i = 0; i < k; ++i) rest *= 2;
        double ways = 1;
        for (std::size_t j = 0; j <= E && j <= k; ++j) {
            binomials[j] = ways;
            ways = ways * static_cast<double>(k - j) / static_cast<double>(j + 1);
        }
        double const total = rest;
        for (std::size_t d = 0; d <= std::min(D, E); ++d) { // monomials of degree d in q
            double kept = 0;
            for (std::size_t j = 0; j <= E - d && j <= k; ++j) {
                kept += binomials[j];
                C const factor = power * binomials[j];
                for (std::size_t m = monomials<N, D>::data.first[d];
                     m < monomials<N, D>::data.first[d + 1]; ++m) {
                    sum.c[image[m][j]] += factor * a.c[m];
                }
            }
            radius += a.norms[d] * (bound * (total - kept));
        }
        for (std::size_t d = E + 1; d <= D; ++d) radius += a.norms[d] * (bound * total);
        radius += a.r * (bound * total);
        mass += a.polynomial_norm() * (bound * total);
        power *= h * 0.5;
        bound *= size;
    }
    // Powers of h err by 2k + 1 units, the sums by one for each of their terms.
    double const terms = static_cast<double>((K + 1) * (E + 1) + 3 * K + 8);
    sum.r = (radius + mass * (terms * model::unit)) * (result_type::up + 8 * terms * model::unit) +
            result_type::tiny;
    sum.finish();
    sum.give_up_when_huge(mass);
    return sum;
}

} // namespace sivid

#endif
