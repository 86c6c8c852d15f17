// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SERIES_DETAIL_POWER_SUM_HPP
#define SIVID_ENCLOSURE_SERIES_DETAIL_POWER_SUM_HPP

#include <sivid/number/taylor_model.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sivid {

/// \f$ \sum_{k=0}^{K} h^k a_k \f$ for the length h of a step that is known up to one unit.
///   The powers are off by less than 2k units, a product by one more. Summed from the highest order
///   down, term k stands in k partial sums, each of which is rounded once; the last addition errs
///   by a unit of everything.
/// @param coefficient  k -> \f$ a_k \f$
template <class C, class Coefficient>
[[nodiscard]] taylor_model<C> at_time(model_shape<C> const& shape, Coefficient const& coefficient,
                                      std::size_t K, C const& h) {
    using Model = taylor_model<C>;
    using side_by_side = lane_traits<C>;
    Model sum(shape);
    C radius{}, mass{};
    C const size = side_by_side::abs(h) * (1 + 4 * Model::unit);
    number_detail::scratch<C> powers(K + 1), bounds(K + 1);
    powers[0] = bounds[0] = C(1.0);
    for (std::size_t k = 1; k <= K; ++k) powers[k] = powers[k - 1] * h;
    for (std::size_t k = 1; k <= K; ++k) bounds[k] = bounds[k - 1] * size; // of |h|^k
    for (std::size_t k = K; k > 0; --k) {
        auto const& a = coefficient(k);
        C const power = powers[k];
        product_detail::each_coefficient(
            a.shape(), [power](auto& y, auto const& x) { y += power * x; }, sum.c(), a.c());
        C const norm = a.polynomial_norm() * bounds[k];
        mass += norm;
        radius += a.r() * bounds[k] + norm * (static_cast<double>(3 * k + 1) * Model::unit);
    }
    auto const& first = coefficient(0);
    product_detail::each_coefficient(
        first.shape(), [](auto& y, auto const& x) { y += x; }, sum.c(), first.c());
    C const all = mass + first.polynomial_norm();
    sum.r() = (radius + first.r() + all * Model::unit) *
                  (shape.up + 8 * static_cast<double>(K + 4) * Model::unit) +
              Model::tiny;
    sum.finish();
    sum.give_up_when_huge(all);
    return sum;
}

/// Turns \f$ \sum_{k=0}^{K} s^k a_k(q) \f$ into functions of q and \f$ \tau \in [-1,1] \f$, where
/// \f$ s = h (1 + \tau)/2 \f$; the last variable is \f$ \tau \f$. Terms beyond the degree go into
/// the radius.
template <class C>
class polynomials_in_time {
public:
    using model = taylor_model<C>;

    /// @param wide  one variable more than `narrow`, and any degree
    polynomials_in_time(model_shape<C> const& narrow, model_shape<C> const& wide)
        : narrow_(&narrow), wide_(&wide) {
        for (std::size_t j = 0; j <= wide.degree; ++j) {
            image_.push_back(number_detail::image_of(*narrow.space, *wide.space, j).data());
        }
    }

    /// @param coefficient  k -> \f$ a_k \f$
    template <class Coefficient>
    [[nodiscard]] model operator()(Coefficient const& coefficient, std::size_t K,
                                   C const& h) const {
        using side_by_side = lane_traits<C>;
        std::size_t const E = wide_->degree;
        model sum(*wide_);
        C radius{}, mass{};
        C power = C(1.0);                                                    // (h/2)^k
        C const size = side_by_side::abs(h) * (0.5 * (1 + 4 * model::unit)); // bounds |h/2|
        C bound = C(1.0);
        number_detail::scratch<double> binomials(E + 1);
        for (std::size_t k = 0; k <= K; ++k) {
            auto const& a = coefficient(k);
            double total = 1; // 2^k
            for (std::size_t i = 0; i < k; ++i) total *= 2;
            double ways = 1;
            for (std::size_t j = 0; j <= E && j <= k; ++j) {
                binomials[j] = ways;
                ways = ways * static_cast<double>(k - j) / static_cast<double>(j + 1);
            }
            for (std::size_t d = 0; d <= std::min(a.degree(), E); ++d) { // of degree d in q
                double kept = 0;
                for (std::size_t j = 0; j <= E - d && j <= k; ++j) {
                    kept += binomials[j];
                    C const factor = power * binomials[j];
                    for (std::size_t m = narrow_->first[d]; m < narrow_->first[d + 1]; ++m) {
                        sum.c(image_[j][m]) += factor * a.c(m);
                    }
                }
                radius += a.norms()[d] * (bound * (total - kept));
            }
            for (std::size_t d = E + 1; d <= a.degree(); ++d) {
                radius += a.norms()[d] * (bound * total);
            }
            radius += a.r() * (bound * total);
            mass += a.polynomial_norm() * (bound * total);
            power *= h * 0.5;
            bound *= size;
        }
        // Powers of h err by 2k + 1 units, the sums by one for each of their terms.
        double const terms = static_cast<double>((K + 1) * (E + 1) + 3 * K + 8);
        double const up = std::max(wide_->up, narrow_->up);
        sum.r() =
            (radius + mass * (terms * model::unit)) * (up + 8 * terms * model::unit) + model::tiny;
        sum.finish();
        sum.give_up_when_huge(mass);
        return sum;
    }

private:
    model_shape<C> const *narrow_, *wide_;
    std::vector<std::uint32_t const*> image_; ///< [j][m]: where monomial m of q times tau^j stands
};

} // namespace sivid

#endif
