// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TAYLOR_MODEL_HPP
#define SIVID_NUMBER_TAYLOR_MODEL_HPP

#include <sivid/number/detail/taylor_model_class.hpp>
#include <sivid/number/detail/taylor_model_product.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace sivid {

// Models are handed over by reference throughout: g++ 12 at -O1 takes the stack copy of a large
// argument for unchanged after another call.

template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> operator-(taylor_model<N, D, C> const& a) {
    auto result = a;
    for (auto& c : result.c) c = -c;
    return result;
}

namespace number_detail {
template <int Sign, std::size_t N, std::size_t D, class C>
taylor_model<N, D, C> sum(taylor_model<N, D, C> const& a, taylor_model<N, D, C> const& b) {
    using model = taylor_model<N, D, C>;
    model result{typename model::unset{}};
    for (std::size_t i = 0; i < model::terms; ++i) {
        result.c[i] = Sign > 0 ? a.c[i] + b.c[i] : a.c[i] - b.c[i];
    }
    C const mass = a.polynomial_norm() + b.polynomial_norm();
    result.r = (a.r + b.r + mass * model::unit) * model::up;
    result.finish();
    result.give_up_when_huge(mass);
    return result;
}
} // namespace number_detail

template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> operator+(taylor_model<N, D, C> const& a,
                                              taylor_model<N, D, C> const& b) {
    return number_detail::sum<1>(a, b);
}
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> operator-(taylor_model<N, D, C> const& a,
                                              taylor_model<N, D, C> const& b) {
    return number_detail::sum<-1>(a, b);
}
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> operator*(taylor_model<N, D, C> const& a,
                                              taylor_model<N, D, C> const& b) {
    product_sum<N, D, C> sum;
    sum.add(a, b);
    return sum.result();
}

/// a times a number from \f$ [m - \rho, m + \rho] \f$.
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> scaled(taylor_model<N, D, C> const& a,
                                           std::type_identity_t<C> const& m,
                                           std::type_identity_t<C> const& rho = C(0.0)) {
    using model = taylor_model<N, D, C>;
    C const norm = a.polynomial_norm();
    C const size = model::side_by_side::abs(m);
    model result{typename model::unset{}};
    for (std::size_t i = 0; i < model::terms; ++i) result.c[i] = a.c[i] * m;
    // norm * size first: the unit times a tiny factor would underflow.
    result.r =
        (a.r * (size + rho) + norm * rho + norm * size * model::unit) * model::up + model::tiny;
    result.finish_multiple(a, size);
    result.give_up_when_huge(norm * (size + rho));
    return result;
}
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> scaled(taylor_model<N, D, C> const& a, interval const& s) {
    return scaled(a, C(mid(s)), C(rad(s)));
}

/// The same function with an interval \f$ [-w, w] \f$ added.
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> widened(taylor_model<N, D, C> const& a,
                                            std::type_identity_t<C> const& w) {
    auto result = a;
    result.r = (a.r + w) * taylor_model<N, D, C>::up;
    result.give_up_when_huge(C(0.0));
    return result;
}

/// Lower and upper bounds, in each lane. Not finite where nothing is known.
template <class C>
struct value_bounds {
    C lower, upper;
    /// The least absolute value between them, 0 where they have different signs.
    [[nodiscard]] C least() const {
        using side_by_side = lane_traits<C>;
        return side_by_side::max(side_by_side::max(lower, -upper), C(0.0));
    }
};

/// Bounds by the norms alone: cheap, and wide when terms of high degree cancel.
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] value_bounds<C> rough_bounds(taylor_model<N, D, C> const& a) {
    using model = taylor_model<N, D, C>;
    C const w = (a.spread() + a.r) * model::up;
    // Two subtractions, each off by less than two units of |c_0| + w.
    C const out = w + (model::side_by_side::abs(a.c[0]) + w) * (8 * model::unit) + model::tiny;
    return {a.c[0] - out, a.c[0] + out};
}
template <std::size_t N, std::size_t D>
[[nodiscard]] interval rough_range(taylor_model<N, D> const& a) {
    auto const b = rough_bounds(a);
    if (!std::isfinite(b.lower) || !std::isfinite(b.upper))
        return interval_traits<interval>::entire();
    return interval(b.lower, b.upper);
}

/// One of the functions that lie side by side.
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D> lane_of(taylor_model<N, D, C> const& a, std::size_t lane) {
    using side_by_side = lane_traits<C>;
    taylor_model<N, D> result;
    for (std::size_t i = 0; i < a.c.size(); ++i) result.c[i] = side_by_side::get(a.c[i], lane);
    for (std::size_t k = 0; k <= D; ++k) result.norms[k] = side_by_side::get(a.norms[k], lane);
    result.above = side_by_side::get(a.above, lane);
    result.r = side_by_side::get(a.r, lane);
    return result;
}
/// a where the mask is set, else b.
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> select(typename lane_traits<C>::mask const& m,
                                           taylor_model<N, D, C> const& a,
                                           taylor_model<N, D, C> const& b) {
    using side_by_side = lane_traits<C>;
    if (side_by_side::all(m)) return a;
    taylor_model<N, D, C> result;
    for (std::size_t i = 0; i < a.c.size(); ++i) {
        result.c[i] = side_by_side::select(m, a.c[i], b.c[i]);
    }
    for (std::size_t k = 0; k <= D; ++k) {
        result.norms[k] = side_by_side::select(m, a.norms[k], b.norms[k]);
    }
    result.above = side_by_side::select(m, a.above, b.above);
    result.r = side_by_side::select(m, a.r, b.r);
    return result;
}

/// Re-expresses a model in other variables and degree: variable v becomes variable v of M >= N;
/// terms beyond degree E go into the radius.
template <std::size_t M, std::size_t E, std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<M, E, C> converted(taylor_model<N, D, C> const& a) {
    static_assert(M >= N);
    using target = monomials<M, E>;
    static constexpr auto image = [] {
        std::array<std::size_t, monomials<N, D>::count> map{};
        for (std::size_t i = 0; i < map.size(); ++i) {
            map[i] = target::count;
            if (monomials<N, D>::data.degree[i] > E) continue;
            for (std::size_t k = 0; k < target::count; ++k) {
                bool same = target::data.degree[k] == monomials<N, D>::data.degree[i];
                for (std::size_t v = 0; v < N && same; ++v) {
                    same = target::data.exponents[k][v] == monomials<N, D>::data.exponents[i][v];
                }
                if (same) map[i] = k;
            }
        }
        return map;
    }();
    taylor_model<M, E, C> result;
    for (std::size_t i = 0; i < image.size(); ++i) {
        if (image[i] < target::count) result.c[image[i]] = a.c[i];
    }
    C cut{};
    for (std::size_t k = E + 1; k <= D; ++k) cut += a.norms[k];
    result.r = (a.r + cut) * taylor_model<N, D, C>::up;
    result.finish();
    return result;
}

/// Forgets the last variable: for each q, all values over \f$ [-1,1] \f$ of that variable.
template <std::size_t N, std::size_t E, std::size_t D, class C>
[[nodiscard]] taylor_model<N, E, C> without_last_variable(taylor_model<N + 1, D, C> const& a) {
    using model = taylor_model<N, D, C>;
    using side_by_side = lane_traits<C>;
    // Where each monomial with the last variable absent stands among those of N variables.
    static constexpr auto place = [] {
        auto const& wide = monomials<N + 1, D>::data;
        std::array<std::size_t, monomials<N + 1, D>::count> map{};
        for (std::size_t k = 0; k < map.size(); ++k) {
            map[k] = model::terms;
            if (wide.exponents[k][N] != 0) continue;
            for (std::size_t i = 0; i < model::terms; ++i) {
                bool same = true;
                for (std::size_t v = 0; v < N && same; ++v) {
                    same = wide.exponents[k][v] == model::basis::data.exponents[i][v];
                }
                if (same) map[k] = i;
            }
        }
        return map;
    }();
    model small;
    C moved{};
    for (std::size_t k = 0; k < place.size(); ++k) {
        if (place[k] < model::terms) {
            small.c[place[k]] = a.c[k];
        } else {
            moved += side_by_side::abs(a.c[k]);
        }
    }
    small.r = (a.r + moved * a.up) * a.up;
    small.finish();
    return converted<N, E>(small);
}

} // namespace sivid

#endif
