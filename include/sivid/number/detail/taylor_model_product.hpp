// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_DETAIL_TAYLOR_MODEL_PRODUCT_HPP
#define SIVID_NUMBER_DETAIL_TAYLOR_MODEL_PRODUCT_HPP

#include <sivid/number/coefficient_rows.hpp>
#include <sivid/number/detail/taylor_model_class.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace sivid {

/// The products of two polynomials' coefficients, added to those of a third.
template <std::size_t N, std::size_t D, class C>
class product_kernel {
    using table = monomials<N, D>;
    static constexpr std::size_t terms = table::count;

public:
    /// sum += factor * a * b
    static void accumulate(std::array<C, terms>& sum, std::array<C, terms> const& a,
                           std::array<C, terms> const& b, double factor = 1) {
        if constexpr (std::is_same_v<C, double>) {
            multiply([&](std::size_t k) -> double& { return sum[k]; },
                     [&](std::size_t k) { return a[k]; }, [&](std::size_t k) { return b[k]; },
                     factor, std::make_index_sequence<terms>{});
        } else {
            for (std::size_t p = 0; p < C::parts; ++p) {
                multiply(
                    [&, p ](std::size_t k) -> auto& { return sum[k].part(p); },
                    [&, p](std::size_t k) { return a[k].part(p); },
                    [&, p](std::size_t k) { return b[k].part(p); }, factor,
                    std::make_index_sequence<terms>{});
            }
        }
    }

private:
    /// Products up to so many are unrolled: the positions are constants of the instructions.
    static constexpr std::size_t unrolled = 500;

    template <class Sum, class A, class B, std::size_t... K>
    [[gnu::always_inline]] static inline void multiply(Sum const& sum, A const& a, B const& b,
                                                       double factor, std::index_sequence<K...>) {
        if constexpr (table::products > unrolled) {
            for (std::size_t k = 0; k < terms; ++k) {
                std::size_t p = table::data.sum[k];
                auto total = a(table::data.pairs[p].left) * b(table::data.pairs[p].right);
                for (++p; p < table::data.sum[k + 1]; ++p) {
                    total += a(table::data.pairs[p].left) * b(table::data.pairs[p].right);
                }
                sum(k) += factor * total;
            }
        } else {
            ((sum(K) +=
              factor *
              coefficient<table::data.sum[K]>(
                  a, b, std::make_index_sequence<table::data.sum[K + 1] - table::data.sum[K]>{})),
             ...);
        }
    }
    template <std::size_t First, class A, class B, std::size_t... P>
    [[gnu::always_inline]] static inline auto coefficient(A const& a, B const& b,
                                                          std::index_sequence<P...>) {
        return (... +
                (a(table::data.pairs[First + P].left) * b(table::data.pairs[First + P].right)));
    }
};

/// Sums of products of Taylor models, with one rounding bound for the whole sum.
template <std::size_t N, std::size_t D, class C = double>
class product_sum {
    using model = taylor_model<N, D, C>;

public:
    /// Adds factor * a * b, the factor a small integer.
    [[gnu::noinline]] void add(model const& a, model const& b, double factor = 1) {
        if (a.is_constant()) return add_multiple(b, a, factor);
        if (b.is_constant()) return add_multiple(a, b, factor);
        double const size = std::abs(factor);
        product_kernel<N, D, C>::accumulate(c_, a.c, b.c, factor);
        // What the product has beyond degree D, and the radii times everything.
        C beyond{};
        for (std::size_t k = 1; k <= D; ++k) {
            C high{};
            for (std::size_t l = D + 1 - k; l <= D; ++l) high += b.norms[l];
            beyond += a.norms[k] * high;
        }
        C const pa = a.polynomial_norm();
        C const pb = b.polynomial_norm();
        radius_ += (beyond + a.r * (pb + b.r) + b.r * pa) * size;
        C const mass = pa * pb * size;
        mass_ += mass;
        own_ += mass * (static_cast<double>(monomials<N, D>::data.longest_sum) + rounds(factor));
        additions_ += 1;
    }
    /// Adds factor * a.
    void add(model const& a, double factor = 1) {
        for (std::size_t i = 0; i < model::terms; ++i) c_[i] += a.c[i] * factor;
        radius_ += a.r * std::abs(factor);
        C const mass = a.polynomial_norm() * std::abs(factor);
        mass_ += mass;
        own_ += mass * rounds(factor);
        additions_ += 1;
    }
    /// Adds factor * \f$ \sum_{j=from}^{to} w_j a_j b_{k-j} \f$ of two series that are kept in
    /// rows, the factor a small integer.
    void add_convolution(
        coefficient_rows<N, D> const& left, std::size_t a, coefficient_rows<N, D> const& right,
        std::size_t b, std::size_t k, std::size_t from, std::size_t to, double factor = 1,
        convolution_weight weight = convolution_weight::one) requires(std::is_same_v<C, double>) {
        using rows = coefficient_rows<N, D>;
        bool const fresh = blocks_ == 0;
        blocks_ += static_cast<double>(to / rows::at_once - from / rows::at_once + 1);
        convolution_kernel<N, D>::add(side_by_side_.data(), fresh, left.begin(a), left.pitch(),
                                      right.begin(b), right.pitch(), k, from, to, factor, weight);
    }
    [[nodiscard]] model result() const {
        model m{typename model::unset{}};
        result_into(m);
        return m;
    }
    void result_into(model& m) const {
        m.c = c_;
        C radius = radius_;
        C mass = mass_;
        C own = own_;
        double joined = additions_;
        double operations = additions_;
        if constexpr (std::is_same_v<C, double>) {
            if (blocks_ > 0) {
                using rows = coefficient_rows<N, D>;
                std::array<double, rows::sums> total;
                convolution_kernel<N, D>::add_up(side_by_side_.data(), total.data());
                for (std::size_t i = 0; i < model::terms; ++i) m.c[i] += total[i];
                radius += total[model::terms];
                mass += total[model::terms + 1];
                // A term is weighted, multiplied, stands in the partial sum that is added to at
                // most `longest_sum` times a block, the first time to 0, and in three more where
                // the partial sums join.
                own += total[model::terms + 1] *
                       (blocks_ * static_cast<double>(monomials<N, D>::data.longest_sum) + 4);
                joined += 1;
                operations += 1 + blocks_ * static_cast<double>(monomials<N, D>::data.longest_sum +
                                                                2 * D + 4);
            }
        }
        // Each operation errs by a unit of its result: within a product by a unit of its own mass,
        // where its sum joins the total by a unit of the total mass; the first one joins 0.
        C const rounding = (own + mass * std::max(joined - 1, 0.0)) * model::unit;
        m.r = (radius + rounding) * (model::up + 8 * operations * model::unit) + model::tiny;
        m.finish();
        m.give_up_when_huge(mass);
    }

private:
    /// How often multiplying by it rounds.
    static double rounds(double factor) { return std::abs(factor) == 1 ? 0 : 1; }
    /// The same for a factor that does not depend on the variables.
    void add_multiple(model const& a, model const& number, double factor) {
        C const times = number.c[0] * factor;
        for (std::size_t i = 0; i < model::terms; ++i) c_[i] += a.c[i] * times;
        C const norm = a.polynomial_norm();
        double const size = std::abs(factor);
        radius_ += (number.r * (norm + a.r) + a.r * number.norms[0]) * size;
        C const mass = norm * number.norms[0] * size;
        mass_ += mass;
        own_ += mass * (1 + rounds(factor));
        additions_ += 1;
    }

    std::array<C, model::terms> c_{};
    C radius_{};
    C mass_{};
    C own_{};
    double additions_ = 0;
    double blocks_ = 0; ///< vectors of products that were added to the partial sums
    struct nothing {};
    /// Eight partial sums of each coefficient, of what convolutions lose, and of their size.
    alignas(64) std::conditional_t<
        std::is_same_v<C, double>,
        std::array<double, coefficient_rows<N, D>::sums * coefficient_rows<N, D>::at_once>,
        nothing> side_by_side_;
};

} // namespace sivid

#endif
