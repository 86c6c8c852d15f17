// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TAYLOR_MODEL_FUNCTIONS_HPP
#define SIVID_NUMBER_TAYLOR_MODEL_FUNCTIONS_HPP

#include <sivid/number/bernstein.hpp>
#include <sivid/number/taylor_model.hpp>
#include <sivid/number/univariate_taylor.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sivid {

namespace number_detail {

/// Marks the lanes of which nothing is known.
template <std::size_t N, std::size_t D, class C, class Mask>
void forget(Mask const& lanes, taylor_model<N, D, C>& m) {
    using side_by_side = lane_traits<C>;
    if (!side_by_side::any(lanes)) return;
    for (auto& c : m.c) c = side_by_side::select(lanes, C(0.0), c);
    m.r = side_by_side::select(lanes, C(std::numeric_limits<double>::infinity()), m.r);
    m.finish();
}

/// The product of two polynomials without any bound: a guess, to be verified by its residual.
template <std::size_t N, std::size_t D, class C>
taylor_model<N, D, C> approximate_product(taylor_model<N, D, C> const& a,
                                          taylor_model<N, D, C> const& b) {
    taylor_model<N, D, C> p;
    product_kernel<N, D, C>::accumulate(p.c, a.c, b.c);
    return p;
}

/// Bounds by the norms where they decide on the sign, else by Bernstein.
template <std::size_t N, std::size_t D, class C>
value_bounds<C> bounds_for_sign(taylor_model<N, D, C> const& a) {
    using side_by_side = lane_traits<C>;
    auto const rough = rough_bounds(a);
    C const half = side_by_side::abs(a.c[0]) * 0.5;
    return side_by_side::all((rough.lower > half) | (rough.upper < -half)) ? rough : bounds(a);
}

/// The polynomial part of s / s_0 - 1, up to rounding.
template <std::size_t N, std::size_t D, class C>
taylor_model<N, D, C> relative_deviation(taylor_model<N, D, C> const& s, C const& factor) {
    taylor_model<N, D, C> t;
    for (std::size_t i = 1; i < t.c.size(); ++i) t.c[i] = s.c[i] * factor;
    return t;
}

} // namespace number_detail

/// \f$ 1/s \f$, defined where the range of s does not touch 0.
///   A polynomial w close to 1/s is found by Horner's rule in \f$ s/s_0 - 1 \f$; its error is
///   proved from the residual: \f$ |1/s - w| \le \|1 - s w\| / \min |s| \f$.
/// @param undefined  gets the lanes where s may be 0
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> reciprocal(taylor_model<N, D, C> const& s,
                                               typename lane_traits<C>::mask& undefined) {
    using model = taylor_model<N, D, C>;
    using side_by_side = lane_traits<C>;
    using mask = typename side_by_side::mask;
    C const least = number_detail::bounds_for_sign(s).least();
    // What is not finite fails the comparisons.
    mask const apart = least > C(0.0);
    mask const finite = s.norm() < C(model::largest);
    mask const centred = side_by_side::abs(s.c[0]) > C(0.0);
    mask const good = apart & finite & centred;
    C const inverse = C(1.0) / side_by_side::select(good, s.c[0], C(1.0));
    auto const t = number_detail::relative_deviation(s, -inverse); // -(s/s0 - 1)
    auto w = model::constant(C(1.0));
    for (std::size_t k = 0; k < D; ++k) {
        w = number_detail::approximate_product(t, w);
        w.c[0] += C(1.0);
    }
    for (auto& c : w.c) c *= inverse;
    w.finish();
    auto const residual = model::constant(C(1.0)) - s * w;
    w.r = residual.norm() / least * model::up + model::tiny;
    w.give_up_when_huge(w.polynomial_norm());
    number_detail::forget(!good, w);
    undefined |= !good;
    return w;
}

/// \f$ \sqrt{s} \f$, defined where the range of s is positive.
///   A polynomial w is found by the binomial series; \f$ |\sqrt s - w| \le \|s - w^2\| /
///   (\sqrt{\min s} + \min w) \f$ where that is positive; else the range is the answer.
/// @param undefined  gets the lanes where s may be 0 or negative
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> sqrt(taylor_model<N, D, C> const& s,
                                         typename lane_traits<C>::mask& undefined) {
    using model = taylor_model<N, D, C>;
    using side_by_side = lane_traits<C>;
    using mask = typename side_by_side::mask;
    auto const values = number_detail::bounds_for_sign(s);
    mask const positive = values.lower > C(0.0);
    mask const finite = s.norm() < C(model::largest);
    mask const centred = s.c[0] > C(0.0);
    mask const good = positive & finite & centred;
    C const centre = side_by_side::select(good, s.c[0], C(1.0));
    C const root =
        each_lane<C>([&](std::size_t l) { return std::sqrt(side_by_side::get(centre, l)); });
    // sqrt(s0) (1 + t)^(1/2), t = s/s0 - 1, by Horner with binomial coefficients
    auto const t = number_detail::relative_deviation(s, C(1.0) / centre);
    auto w = model::constant(C(1.0));
    for (std::size_t k = D; k > 0; --k) {
        double const ratio = (1.5 - static_cast<double>(k)) / static_cast<double>(k);
        w = number_detail::approximate_product(t, w);
        for (auto& c : w.c) c *= ratio;
        w.c[0] += C(1.0);
    }
    for (auto& c : w.c) c *= root;
    w.finish();
    auto const residual = s - w * w;
    bool ignored = false;
    using traits = interval_traits<interval>;
    C const smallest = each_lane<C>([&](std::size_t l) {
        double const x = side_by_side::get(values.lower, l);
        return x > 0 ? traits::sqrt(traits::point(x), ignored).lower() : 0.0;
    });
    C const below = (smallest + rough_bounds(w).lower) * (1 - 4 * model::unit); // <= sqrt(s) + w
    auto const sharp = below > C(0.0);
    w.r = residual.norm() / side_by_side::select(sharp, below, C(1.0)) * model::up + model::tiny;
    if (!side_by_side::all(sharp | !good)) { // the range is all that is known
        for (std::size_t l = 0; l < side_by_side::count; ++l) {
            double const lo = side_by_side::get(values.lower, l);
            double const hi = side_by_side::get(values.upper, l);
            if (side_by_side::test(sharp, l) || !side_by_side::test(good, l)) continue;
            auto const y = traits::sqrt(traits::bounds(lo, hi), ignored);
            for (auto& c : w.c) side_by_side::put(c, l, 0.0);
            side_by_side::put(w.c[0], l, mid(y));
            side_by_side::put(w.r, l, rad(y));
        }
        w.finish();
    }
    number_detail::forget(!good, w);
    undefined |= !good;
    return w;
}

/// An elementary function by its Taylor polynomial about the centre of s and Lagrange's remainder:
///   \f$ f(s) \in \sum_{k \le D} f^{[k]}(s_0) \tilde s^k + f^{[D+1]}(range) \tilde s^{D+1} \f$.
/// @param undefined  gets the lanes where f is not smooth on all of s
template <std::size_t N, std::size_t D, class C>
[[nodiscard]] taylor_model<N, D, C> apply(univariate f, taylor_model<N, D, C> const& s,
                                          typename lane_traits<C>::mask& undefined) {
    using model = taylor_model<N, D, C>;
    using traits = interval_traits<interval>;
    using side_by_side = lane_traits<C>;
    auto t = s;
    t.c[0] = 0.0;
    t.finish();
    C const size = t.norm();
    auto good = s.norm() < C(model::largest);
    bool const simple = s.is_constant();
    // Enclosures of the coefficients, lane by lane; the last one on the whole range.
    std::array<C, D + 1> centre{}, radius{};
    C last{};
    bool const bounded = f == univariate::sin || f == univariate::cos;
    auto const values = bounded || simple ? rough_bounds(s) : bounds(s);
    for (std::size_t l = 0; l < side_by_side::count; ++l) {
        if (!side_by_side::test(good, l)) continue;
        bool cut = false;
        auto const keep = [&](std::size_t k, interval const& y) {
            side_by_side::put(centre[k], l, mid(y));
            side_by_side::put(radius[k], l, rad(y));
        };
        auto const whole =
            interval(side_by_side::get(values.lower, l), side_by_side::get(values.upper, l));
        if (simple) {
            double const r = side_by_side::get(s.r, l);
            auto const x =
                traits::add(traits::point(side_by_side::get(s.c[0], l)), traits::bounds(-r, r));
            keep(0, taylor_coefficients<0>(f, x, cut)[0]);
        } else {
            auto const at_centre =
                taylor_coefficients<D>(f, traits::point(side_by_side::get(s.c[0], l)), cut);
            for (std::size_t k = 0; k <= D; ++k) keep(k, at_centre[k]);
            double top = number_detail::inverse_factorial<D + 1>;
            if (!bounded) top = mag(taylor_coefficients<D + 1>(f, whole, cut)[D + 1]);
            side_by_side::put(last, l, top);
        }
        if (cut) good = good & !side_by_side::only(l);
    }
    auto result = widened(model::constant(centre[simple ? 0 : D]), radius[simple ? 0 : D]);
    if (!simple) {
        for (std::size_t k = D; k-- > 0;) {
            result = result * t + widened(model::constant(centre[k]), radius[k]);
        }
        // The derivative first: a power of a tiny size alone could underflow.
        C rest = last;
        for (std::size_t k = 0; k <= D; ++k) rest *= size * model::up;
        result = widened(result, rest * model::up + model::tiny);
    }
    number_detail::forget(!good, result);
    undefined |= !good;
    return result;
}

} // namespace sivid

#endif
