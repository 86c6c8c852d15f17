// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TAYLOR_MODEL_HPP
#define SIVID_NUMBER_TAYLOR_MODEL_HPP

#include <sivid/number/polynomial/detail/taylor_model_class.hpp>
#include <sivid/number/polynomial/detail/taylor_model_product.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace sivid {

template <class C>
[[nodiscard]] taylor_model<C> operator-(taylor_model<C> const& a) {
    taylor_model<C> result(a.shape(), typename taylor_model<C>::unset{});
    auto const& s = a.shape();
    product_detail::each_coefficient(
        s, [](auto& y, auto const& x) { y = -x; }, result.c(), a.c());
    std::copy_n(a.c() + s.radius, s.numbers - s.radius, result.c() + s.radius);
    return result;
}

namespace number_detail {
template <int Sign, class C>
void sum_into(taylor_model<C>& result, taylor_model<C> const& a, taylor_model<C> const& b) {
    using model = taylor_model<C>;
    auto const signed_by = [](C const& x) { return Sign > 0 ? x : -x; };
    C const mass = a.polynomial_norm() + b.polynomial_norm();
    C const radius = a.r() + b.r();
    auto const& s = common_shape(a.shape(), b.shape());
    if (&a.shape() == &b.shape()) {
        result.reshape(s); // the same, where it is one of the operands
        product_detail::each_coefficient(
            s, [](auto& z, auto const& x, auto const& y) { z = Sign > 0 ? x + y : x - y; },
            result.c(), a.c(), b.c());
        result.r() = (radius + mass * model::unit) * s.up;
        result.finish();
    } else { // nothing but the constant term, and its norm, changes
        C const c = a.c(0) + signed_by(b.c(0));
        if (b.is_number()) {
            result = a;
        } else {
            result = b;
            for (std::size_t i = 0; i < s.terms; ++i) result.c(i) = signed_by(result.c(i));
        }
        result.c(0) = c;
        result.norms()[0] = model::side_by_side::abs(c) * s.up;
        result.r() = (radius + mass * model::unit) * s.up;
    }
    result.give_up_when_huge(mass);
}
template <int Sign, class C>
taylor_model<C> sum(taylor_model<C> const& a, taylor_model<C> const& b) {
    taylor_model<C> result(common_shape(a.shape(), b.shape()), typename taylor_model<C>::unset{});
    sum_into<Sign>(result, a, b);
    return result;
}
} // namespace number_detail

template <class C>
[[nodiscard]] taylor_model<C> operator+(taylor_model<C> const& a, taylor_model<C> const& b) {
    return number_detail::sum<1>(a, b);
}
template <class C>
[[nodiscard]] taylor_model<C> operator-(taylor_model<C> const& a, taylor_model<C> const& b) {
    return number_detail::sum<-1>(a, b);
}
template <class C>
[[nodiscard]] taylor_model<C> operator*(taylor_model<C> const& a, taylor_model<C> const& b) {
    product_sum<C> sum;
    sum.add(a, b);
    return sum.result();
}

namespace number_detail {
template <class C>
void scale_into(taylor_model<C>& result, taylor_model<C> const& a, C const& m, C const& rho) {
    using model = taylor_model<C>;
    C const norm = a.polynomial_norm();
    C const size = model::side_by_side::abs(m);
    result.reshape(a.shape()); // the same, where it is a
    // norm * size first: the unit times a tiny factor would underflow.
    C const radius =
        (a.r() * (size + rho) + norm * rho + norm * size * model::unit) * a.shape().up +
        model::tiny;
    if (a.is_number()) {
        C const c = a.c(0) * m;
        C const bound = a.norms()[0] * size * a.shape().up +
                        model::side_by_side::min(a.norms()[0], C(model::tiny));
        result.c(0) = c;
        result.above() = C(0.0);
        result.norms()[0] = bound;
    } else {
        product_detail::each_coefficient(
            a.shape(), [&m](auto& y, auto const& x) { y = x * m; }, result.c(), a.c());
        result.finish_multiple(a, size);
    }
    result.r() = radius;
    result.give_up_when_huge(norm * (size + rho));
}
} // namespace number_detail

/// a times a number from \f$ [m - \rho, m + \rho] \f$.
template <class C>
[[nodiscard]] taylor_model<C> scaled(taylor_model<C> const& a, std::type_identity_t<C> const& m,
                                     std::type_identity_t<C> const& rho = C(0.0)) {
    taylor_model<C> result(a.shape(), typename taylor_model<C>::unset{});
    number_detail::scale_into(result, a, m, rho);
    return result;
}
template <class C>
[[nodiscard]] taylor_model<C> scaled(taylor_model<C> const& a, interval const& s) {
    return scaled(a, C(mid(s)), C(rad(s)));
}

/// The same function with an interval \f$ [-w, w] \f$ added.
template <class C>
[[nodiscard]] taylor_model<C> widened(taylor_model<C> a, std::type_identity_t<C> const& w) {
    a.r() = (a.r() + w) * a.shape().up;
    a.give_up_when_huge(C(0.0));
    return a;
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
template <class C>
[[nodiscard]] value_bounds<C> rough_bounds(taylor_model<C> const& a) {
    using model = taylor_model<C>;
    C const w = (a.spread() + a.r()) * a.shape().up;
    // Two subtractions, each off by less than two units of |c_0| + w.
    C const out = w + (model::side_by_side::abs(a.c(0)) + w) * (8 * model::unit) + model::tiny;
    return {a.c(0) - out, a.c(0) + out};
}
[[nodiscard]] inline interval rough_range(taylor_model<double> const& a) {
    auto const b = rough_bounds(a);
    if (!std::isfinite(b.lower) || !std::isfinite(b.upper))
        return interval_traits<interval>::entire();
    return interval(b.lower, b.upper);
}

/// One of the functions that lie side by side.
template <class C>
[[nodiscard]] taylor_model<double> lane_of(taylor_model<C> const& a, std::size_t lane) {
    auto const& s = a.shape().single();
    taylor_model<double> result(s);
    for (std::size_t i = 0; i < s.terms; ++i) result.c(i) = lane_traits<C>::get(a.c(i), lane);
    for (std::size_t i = 0; i < s.numbers - s.radius; ++i) {
        result.c(s.radius + i) = lane_traits<C>::get(a.c(a.shape().radius + i), lane);
    }
    return result;
}

/// a in so many variables: what is not there is 0.
template <class C>
[[nodiscard]] taylor_model<C> in_shape(taylor_model<C> const& a, model_shape<C> const& s) {
    if (&a.shape() == &s) return a;
    taylor_model<C> result(s);
    result.c(0) = a.c(0);
    result.r() = a.r();
    result.norms()[0] = a.norms()[0];
    if (a.is_number()) return result;
    throw std::logic_error("taylor_model: two sizes in one operation");
}

/// a where the mask is set, else b.
template <class C>
[[nodiscard]] taylor_model<C> select(typename lane_traits<C>::mask const& m,
                                     taylor_model<C> const& a, taylor_model<C> const& b) {
    using side_by_side = lane_traits<C>;
    if (side_by_side::all(m)) return a;
    if (!side_by_side::any(m)) return b;
    if (&a.shape() != &b.shape()) {
        auto const& s = a.is_number() ? b.shape() : a.shape();
        return select(m, in_shape(a, s), in_shape(b, s));
    }
    taylor_model<C> result(a.shape(), typename taylor_model<C>::unset{});
    for (std::size_t i = 0; i < a.shape().numbers; ++i) {
        result.c(i) = side_by_side::select(m, a.c(i), b.c(i));
    }
    return result;
}

template <class C>
[[nodiscard]] taylor_model<C> select(typename lane_traits<C>::mask const& m, taylor_model<C>&& a,
                                     taylor_model<C> const& b) {
    if (lane_traits<C>::all(m)) return std::move(a);
    return select(m, std::as_const(a), b);
}

namespace number_detail {
/// Where each monomial of one space stands in another when it is multiplied by a power of that
/// one's last variable; `wide.terms()` where its degree is too high.
/// @given  power > 0 only where `wide` has more variables
[[nodiscard]] inline std::vector<std::uint32_t> const&
image_of(monomial_space const& narrow, monomial_space const& wide, std::size_t power) {
    using key = std::tuple<monomial_space const*, monomial_space const*, std::size_t>;
    static std::mutex guard;
    static std::map<key, std::unique_ptr<std::vector<std::uint32_t>>> made;
    std::scoped_lock const lock(guard);
    auto& image = made[{&narrow, &wide, power}];
    if (image) return *image;
    image = std::make_unique<std::vector<std::uint32_t>>();
    for (std::size_t m = 0; m < narrow.terms(); ++m) {
        auto const* const e = narrow.exponents(m);
        image->push_back(static_cast<std::uint32_t>(wide.find([&](std::size_t v) -> std::size_t {
            std::size_t const own = v < narrow.variables() ? e[v] : 0;
            return v + 1 == wide.variables() ? own + power : own;
        })));
    }
    return *image;
}
} // namespace number_detail

/// Re-expresses a model in other variables and degree: variable v becomes variable v of at least as
/// many; terms beyond the degree go into the radius.
template <class C>
[[nodiscard]] taylor_model<C> converted(taylor_model<C> const& a, model_shape<C> const& s) {
    if (a.is_number()) return a;
    if (s.variables < a.shape().variables) {
        throw std::logic_error("taylor_model: converted to fewer variables");
    }
    taylor_model<C> result(s);
    if (s.variables == a.shape().variables) {
        std::copy_n(a.c(), std::min(s.terms, a.terms()), result.c());
    } else {
        auto const& image = number_detail::image_of(a.space(), *s.space, 0);
        for (std::size_t i = 0; i < a.terms(); ++i) {
            if (image[i] < s.terms) result.c(image[i]) = a.c(i);
        }
    }
    C cut{};
    for (std::size_t k = s.degree + 1; k <= a.degree(); ++k) cut += a.norms()[k];
    result.r() = (a.r() + cut) * a.shape().up;
    result.finish();
    return result;
}

/// Forgets the last variable: for each q, all values over \f$ [-1,1] \f$ of that variable.
/// @param s  one variable less, and any degree
template <class C>
[[nodiscard]] taylor_model<C> without_last_variable(taylor_model<C> const& a,
                                                    model_shape<C> const& s) {
    using side_by_side = lane_traits<C>;
    if (a.is_number()) return a;
    auto const& small = model_shape<C>::of(s.variables, a.degree());
    auto const& image = number_detail::image_of(*small.space, a.space(), 0);
    taylor_model<C> result(small);
    for (std::size_t i = 0; i < small.terms; ++i) result.c(i) = a.c(image[i]);
    // Where the last variable is absent stands in the image, in rising order.
    C moved{};
    std::size_t next = 0;
    for (std::size_t k = 0; k < a.terms(); ++k) {
        if (next < small.terms && image[next] == k) {
            ++next;
        } else {
            moved += side_by_side::abs(a.c(k));
        }
    }
    result.r() = (a.r() + moved * a.shape().up) * a.shape().up;
    result.finish();
    return converted(result, s);
}

} // namespace sivid

#endif
