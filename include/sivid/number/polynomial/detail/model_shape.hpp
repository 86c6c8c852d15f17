// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_DETAIL_MODEL_SHAPE_HPP
#define SIVID_NUMBER_POLYNOMIAL_DETAIL_MODEL_SHAPE_HPP

#include <sivid/compiled.hpp>
#include <sivid/number/pack/lanes.hpp>
#include <sivid/number/polynomial/detail/product_kernels.hpp>
#include <sivid/number/polynomial/monomial_space.hpp>

#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>

namespace sivid {
inline namespace SIVID_PACK_TARGET {

/// The size of Taylor models with coefficients C, and the functions that are compiled for it.
/// Models of the same size point to the same shape; there is one for each pair (N, D).
template <class C>
struct model_shape {
    monomial_space const* space;
    std::size_t variables, degree, terms;
    std::size_t radius;       ///< where the numbers behind the coefficients begin
    std::size_t numbers;      ///< that a model takes in memory
    std::size_t lines;        ///< cache lines that they take
    std::size_t const* first; ///< first[k] .. first[k + 1]: the monomials of degree k
    double longest_sum;       ///< most products in one coefficient
    double product_work;      ///< of a product, for the `work_clock`
    /// Makes a computed sum of at most `terms` + a few dozen non-negative numbers an upper bound.
    double up;
    product_detail::product_function<C> multiply;
    product_detail::norms_function<C> norms;
    /// Of series of single models alone (C = double).
    product_detail::convolution_function convolve;
    product_detail::column_function add_columns;
    model_shape<double> const* one; ///< that of the models in its lanes; null for single ones

    [[nodiscard]] static model_shape const& of(std::size_t variables, std::size_t degree) {
        // A number is one, whatever it does not depend on.
        if (degree == 0 || variables == 0) variables = degree = 0;
        static std::mutex guard;
        static std::map<std::pair<std::size_t, std::size_t>, std::unique_ptr<model_shape const>>
            made;
        std::scoped_lock const lock(guard);
        auto& place = made[{variables, degree}];
        if (!place) place.reset(new model_shape(make(variables, degree)));
        return *place;
    }
    /// That of numbers: no variable.
    [[nodiscard]] static model_shape const& number() {
        static model_shape const& one = of(0, 0);
        return one;
    }

    /// Of one of the functions that lie side by side.
    [[nodiscard]] model_shape<double> const& single() const {
        if constexpr (std::is_same_v<C, double>) {
            return *this;
        } else {
            return *one;
        }
    }

private:
    static model_shape<double> const* single_shape(std::size_t variables, std::size_t degree) {
        if constexpr (std::is_same_v<C, double>) {
            return nullptr;
        } else {
            return &model_shape<double>::of(variables, degree);
        }
    }
    static model_shape make(std::size_t variables, std::size_t degree);
};

namespace product_detail {

/// Of a product of Taylor models for the `work_clock`: its pairs of coefficients, and what it takes
/// beside.
[[nodiscard]] inline double work_of_product(std::size_t variables, std::size_t degree, bool lanes) {
    double pairs = 1;
    for (std::size_t k = 1; k <= degree; ++k)
        pairs *= static_cast<double>(2 * variables + k) / static_cast<double>(k);
    return 4 + pairs / (lanes ? 1.2 : 8);
}

} // namespace product_detail

template <class C>
model_shape<C> model_shape<C>::make(std::size_t variables, std::size_t degree) {
    auto const& s = monomial_space::of(variables, degree);
    constexpr bool single = std::is_same_v<C, double>;
    // Whole vectors of single coefficients: zeros behind the last one.
    constexpr std::size_t group = single ? 8 : 1;
    std::size_t const padded = s.terms() == 1 ? 1 : (s.terms() + group - 1) / group * group;
    auto const count = static_cast<double>(s.terms() + degree * degree);
    return {&s,
            variables,
            degree,
            s.terms(),
            padded,
            padded + degree + 3,
            ((padded + degree + 3) * sizeof(C) + 63) / 64,
            s.firsts(),
            static_cast<double>(s.longest_sum()),
            product_detail::work_of_product(variables, degree, !single),
            1 + (4 * count + 64) * std::numeric_limits<double>::epsilon(),
            product_detail::product_for<C>(variables, degree),
            product_detail::norms_for<C>(variables, degree),
            single ? product_detail::convolution_for(variables, degree) : nullptr,
            single ? product_detail::columns_for(variables, degree) : nullptr,
            single_shape(variables, degree)};
}

#ifdef SIVID_COMPILED_ALIKE // every kernel comes with it
extern template model_shape<double> model_shape<double>::make(std::size_t, std::size_t);
extern template model_shape<lanes<8>> model_shape<lanes<8>>::make(std::size_t, std::size_t);
#endif

namespace product_detail {
[[gnu::always_inline]] inline stored_vector& vector_at(double* p, std::size_t i) {
    return reinterpret_cast<stored_vector*>(p)[i];
}
[[gnu::always_inline]] inline stored_vector const& vector_at(double const* p, std::size_t i) {
    return reinterpret_cast<stored_vector const*>(p)[i];
}

/// f(out, in...) for all coefficients of models of one size, a vector of them at a time. f has to
/// leave 0 where all operands are 0.
template <class C, class F, class... In>
[[gnu::always_inline]] inline void each_coefficient(model_shape<C> const& s, F const& f, C* out,
                                                    In const*... in) {
    if constexpr (std::is_same_v<C, double>) {
        if (s.terms > 1) {
            std::size_t const vectors = s.radius / per_vector;
            for (std::size_t i = 0; i < vectors; ++i) {
                vector value = vector_at(out, i);
                f(value, vector(vector_at(in, i))...);
                vector_at(out, i) = value;
            }
            return;
        }
    }
    for (std::size_t i = 0; i < s.terms; ++i) f(out[i], in[i]...);
}
/// f(out, in) for the numbers behind the coefficients: the radius, the norms 1 .. D together, the
/// norms 0 .. D; a vector of them at a time.
template <class C, class F>
[[gnu::always_inline]] inline void each_bound(model_shape<C> const& s, F const& f, C* out,
                                              C const* in) {
    if constexpr (std::is_same_v<C, double>) {
        if (s.terms > 1) {
            auto* const y = reinterpret_cast<stored_vector*>(out + s.radius);
            auto const* const x = reinterpret_cast<stored_vector const*>(in + s.radius);
            for (std::size_t i = 0; i * per_vector < s.degree + 3; ++i) {
                vector value{};
                f(value, vector(x[i]));
                y[i] = value;
            }
            return;
        }
    }
    for (std::size_t i = s.radius; i < s.numbers; ++i) f(out[i], in[i]);
}
} // namespace product_detail

} // namespace SIVID_PACK_TARGET
} // namespace sivid

#endif
