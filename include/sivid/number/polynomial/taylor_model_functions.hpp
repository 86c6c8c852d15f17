// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_TAYLOR_MODEL_FUNCTIONS_HPP
#define SIVID_NUMBER_POLYNOMIAL_TAYLOR_MODEL_FUNCTIONS_HPP

#include <sivid/number/polynomial/detail/bernstein.hpp>
#include <sivid/number/polynomial/detail/near_minimax.hpp>
#include <sivid/number/polynomial/univariate_taylor.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace sivid {

namespace number_detail {

/// Marks the lanes of which nothing is known.
template <class C, class Mask>
void forget(Mask const& lanes, taylor_model<C>& m) {
    using side_by_side = lane_traits<C>;
    if (!side_by_side::any(lanes)) return;
    for (std::size_t i = 0; i < m.terms(); ++i) {
        m.c(i) = side_by_side::select(lanes, C(0.0), m.c(i));
    }
    m.r() = side_by_side::select(lanes, C(std::numeric_limits<double>::infinity()), m.r());
    m.finish();
}

/// w = t w of polynomials without any bound: a guess, to be verified by its residual.
template <class C>
void multiply_approximately(taylor_model<C>& w, taylor_model<C> const& t, scratch<C>& memory) {
    auto const& s = t.shape();
    std::fill_n(memory.data(), s.terms, C(0.0));
    s.multiply(*s.space, memory.data(), t.c(), w.c(), 1);
    std::copy_n(memory.data(), s.terms, w.c());
}

/// Bounds by the norms where they decide on the sign, else by Bernstein; lanes with a centre of 0,
/// or of which nothing is known, need none.
template <class C>
value_bounds<C> bounds_for_sign(taylor_model<C> const& a) {
    using side_by_side = lane_traits<C>;
    auto const rough = rough_bounds(a);
    C const half = side_by_side::abs(a.c(0)) * 0.5;
    auto const decided = (rough.lower > half) | (rough.upper < -half);
    auto const askable = (half > C(0.0)) & (a.norm() < C(taylor_model<C>::largest));
    return side_by_side::all(decided | !askable) ? rough : bounds(a);
}

/// The polynomial part of s / s_0 - 1, up to rounding.
template <class C>
taylor_model<C> relative_deviation(taylor_model<C> const& s, C const& factor) {
    taylor_model<C> t(s.shape());
    for (std::size_t i = 1; i < s.terms(); ++i) t.c(i) = s.c(i) * factor;
    return t;
}

/// f(s) as a near-minimax polynomial of s, of the degree that leaves least unknown, or as its
/// range: in each of some lanes the least of these and `best`.
/// @param best    encloses f(s)
/// @param values  bounds of s in these lanes, whatever they are known from
template <class C, class Mask>
taylor_model<C> sharpest(univariate f, taylor_model<C> const& s, taylor_model<C> best,
                         Mask const& lanes, value_bounds<C> const& values) {
    using model = taylor_model<C>;
    using traits = interval_traits<interval>;
    using side_by_side = lane_traits<C>;
    C const none(std::numeric_limits<double>::infinity());
    C middle{}, half = none; // of the range of f
    scratch<interval> range(side_by_side::count);
    for (std::size_t l = 0; l < side_by_side::count; ++l) {
        if (!side_by_side::test(lanes, l)) continue;
        double const lower = side_by_side::get(values.lower, l);
        double const upper = side_by_side::get(values.upper, l);
        range[l] = lower <= upper ? traits::bounds(lower, upper) : traits::entire(); // NaN
        bool undefined = false;
        interval y;
        taylor_coefficients(f, range[l], 0, &y, undefined);
        if (undefined || !std::isfinite(mag(y))) continue;
        side_by_side::put(middle, l, mid(y));
        side_by_side::put(half, l, rad(y));
    }
    auto t = s;
    t.c(0) = 0.0;
    t.norms()[0] = 0.0;
    auto const degree =
        s.is_constant() ? 0 : std::min<std::size_t>(s.degree(), most_near_minimax_degree);
    for (auto d = degree; d > 0; --d) {
        scratch<C> coefficient(d + 1);
        std::fill_n(coefficient.data(), d + 1, C(0.0));
        C off = none;
        for (std::size_t l = 0; l < side_by_side::count; ++l) {
            if (!side_by_side::test(lanes, l)) continue;
            near_minimax const p(f, side_by_side::get(s.c(0), l), range[l], d);
            if (!std::isfinite(p.error())) continue;
            for (std::size_t k = 0; k <= d; ++k) side_by_side::put(coefficient[k], l, p[k]);
            side_by_side::put(off, l, p.error());
        }
        auto sum = model::constant(coefficient[d]);
        for (std::size_t k = d; k-- > 0;) sum = sum * t + model::constant(coefficient[k]);
        sum = widened(std::move(sum), off);
        best = select(sum.r() < best.r(), std::move(sum), best);
    }
    return select(half < best.r(), widened(model::constant(middle), half), best);
}

/// The same in lanes where that is less than what a Taylor polynomial leaves and a tenth of what
/// f(s) spans: over wide ranges of functions that saturate it is by far.
/// @param usual  encloses f(s)
/// @param good   the lanes where f is smooth
template <class C, class Mask>
taylor_model<C> sharper(univariate f, taylor_model<C> const& s, taylor_model<C> usual,
                        Mask const& good) {
    using side_by_side = lane_traits<C>;
    if (s.is_constant()) return usual;
    // The share of s that is lost is lost of f(s) in any case.
    auto const poor =
        good & (usual.r() * s.spread() > usual.spread() * (s.spread() * 0.1 + s.r() * 1.5));
    if (!side_by_side::any(poor)) return usual;
    return sharpest(f, s, std::move(usual), poor, bounds(s));
}

} // namespace number_detail

/// \f$ 1/s \f$, defined where the range of s does not touch 0.
///   A polynomial w close to 1/s is found by Horner's rule in \f$ s/s_0 - 1 \f$; its error is
///   proved from the residual: \f$ |1/s - w| \le \|1 - s w\| / \min |s| \f$.
/// @param undefined  gets the lanes where s may be 0
template <class C>
[[nodiscard]] taylor_model<C> reciprocal(taylor_model<C> const& s,
                                         typename lane_traits<C>::mask& undefined) {
    using model = taylor_model<C>;
    using side_by_side = lane_traits<C>;
    using mask = typename side_by_side::mask;
    C const least = number_detail::bounds_for_sign(s).least();
    // What is not finite fails the comparisons.
    mask const apart = least > C(0.0);
    mask const finite = s.norm() < C(model::largest);
    mask const centred = side_by_side::abs(s.c(0)) > C(0.0);
    mask const good = apart & finite & centred;
    C const inverse = C(1.0) / side_by_side::select(good, s.c(0), C(1.0));
    model w(s.shape());
    w.c(0) = 1.0;
    if (s.degree() > 0) {
        auto const t = number_detail::relative_deviation(s, -inverse); // -(s/s0 - 1)
        number_detail::scratch<C> memory(s.terms());
        for (std::size_t k = 0; k < s.degree(); ++k) {
            number_detail::multiply_approximately(w, t, memory);
            w.c(0) += C(1.0);
        }
    }
    for (std::size_t i = 0; i < w.terms(); ++i) w.c(i) *= inverse;
    w.finish();
    auto const residual = model::constant(C(1.0)) - s * w;
    w.r() = residual.norm() / least * w.shape().up + model::tiny;
    w.give_up_when_huge(w.polynomial_norm());
    number_detail::forget(!good, w);
    undefined |= !good;
    return w;
}

/// \f$ \sqrt{s} \f$, defined where the range of s is positive.
///   A polynomial w is found by the binomial series; \f$ |\sqrt s - w| \le \|s - w^2\| /
///   (\sqrt{\min s} + \min w) \f$ where that is positive; else the range is the answer.
/// @param undefined  gets the lanes where s may be 0 or negative
template <class C>
[[nodiscard]] taylor_model<C> sqrt(taylor_model<C> const& s,
                                   typename lane_traits<C>::mask& undefined) {
    using model = taylor_model<C>;
    using side_by_side = lane_traits<C>;
    using mask = typename side_by_side::mask;
    auto const values = number_detail::bounds_for_sign(s);
    mask const positive = values.lower > C(0.0);
    mask const finite = s.norm() < C(model::largest);
    mask const centred = s.c(0) > C(0.0);
    mask const good = positive & finite & centred;
    C const centre = side_by_side::select(good, s.c(0), C(1.0));
    C const root =
        each_lane<C>([&](std::size_t l) { return std::sqrt(side_by_side::get(centre, l)); });
    // sqrt(s0) (1 + t)^(1/2), t = s/s0 - 1, by Horner with binomial coefficients
    model w(s.shape());
    w.c(0) = 1.0;
    if (s.degree() > 0) {
        auto const t = number_detail::relative_deviation(s, C(1.0) / centre);
        number_detail::scratch<C> memory(s.terms());
        for (std::size_t k = s.degree(); k > 0; --k) {
            double const ratio = (1.5 - static_cast<double>(k)) / static_cast<double>(k);
            number_detail::multiply_approximately(w, t, memory);
            for (std::size_t i = 0; i < w.terms(); ++i) w.c(i) *= ratio;
            w.c(0) += C(1.0);
        }
    }
    for (std::size_t i = 0; i < w.terms(); ++i) w.c(i) *= root;
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
    w.r() =
        residual.norm() / side_by_side::select(sharp, below, C(1.0)) * w.shape().up + model::tiny;
    if (!side_by_side::all(sharp | !good)) { // the range is all that is known
        for (std::size_t l = 0; l < side_by_side::count; ++l) {
            double const lo = side_by_side::get(values.lower, l);
            double const hi = side_by_side::get(values.upper, l);
            if (side_by_side::test(sharp, l) || !side_by_side::test(good, l)) continue;
            auto const y = traits::sqrt(traits::bounds(lo, hi), ignored);
            for (std::size_t i = 0; i < w.terms(); ++i) side_by_side::put(w.c(i), l, 0.0);
            side_by_side::put(w.c(0), l, mid(y));
            side_by_side::put(w.r(), l, rad(y));
        }
        w.finish();
    }
    number_detail::forget(!good, w);
    undefined |= !good;
    return w;
}

/// An elementary function by its Taylor polynomial about the centre of s and Lagrange's remainder:
///   \f$ f(s) \in \sum_{k \le D} f^{[k]}(s_0) \tilde s^k + f^{[D+1]}(range) \tilde s^{D+1} \f$;
///   over wide ranges by `near_minimax`.
/// @param undefined  gets the lanes where f is not smooth on all of s
template <class C>
[[nodiscard]] taylor_model<C> apply(univariate f, taylor_model<C> const& s,
                                    typename lane_traits<C>::mask& undefined) {
    using model = taylor_model<C>;
    using traits = interval_traits<interval>;
    using side_by_side = lane_traits<C>;
    std::size_t const D = s.degree();
    C const size = (s.above() + s.r()) * (s.shape().up * (1 + 4 * model::unit));
    auto good = s.norm() < C(model::largest);
    bool const simple = s.is_constant();
    // Enclosures of the coefficients, lane by lane; the last one on the whole range.
    number_detail::scratch<C> centre(D + 1), radius(D + 1);
    number_detail::scratch<interval> y(D + 2);
    C last{};
    bool const bounded = f == univariate::sin || f == univariate::cos;
    auto const values = bounded || simple ? rough_bounds(s) : bounds(s);
    for (std::size_t l = 0; l < side_by_side::count; ++l) {
        if (!side_by_side::test(good, l)) continue;
        bool cut = false;
        auto const keep = [&](std::size_t k) {
            side_by_side::put(centre[k], l, mid(y[k]));
            side_by_side::put(radius[k], l, rad(y[k]));
        };
        if (simple) {
            double const r = side_by_side::get(s.r(), l);
            auto const x =
                traits::add(traits::point(side_by_side::get(s.c(0), l)), traits::bounds(-r, r));
            taylor_coefficients(f, x, 0, y.data(), cut);
            keep(0);
        } else {
            taylor_coefficients(f, traits::point(side_by_side::get(s.c(0), l)), D, y.data(), cut);
            for (std::size_t k = 0; k <= D; ++k) keep(k);
            double top = 1;
            if (bounded) {
                for (std::size_t k = 2; k <= D + 1; ++k) top /= static_cast<double>(k);
                top *= 1 + static_cast<double>(D + 4) * model::unit;
            } else {
                auto const whole = interval(side_by_side::get(values.lower, l),
                                            side_by_side::get(values.upper, l));
                taylor_coefficients(f, whole, D + 1, y.data(), cut);
                top = mag(y[D + 1]);
            }
            side_by_side::put(last, l, top);
        }
        if (cut) good = good & !side_by_side::only(l);
    }
    auto result = widened(model::constant(centre[simple ? 0 : D]), radius[simple ? 0 : D]);
    if (!simple) {
        auto t = s;
        t.c(0) = 0.0;
        t.norms()[0] = 0.0;
        for (std::size_t k = D; k-- > 0;) {
            result = result * t + widened(model::constant(centre[k]), radius[k]);
        }
        // The derivative first: a power of a tiny size alone could underflow.
        C rest = last;
        for (std::size_t k = 0; k <= D; ++k) rest *= size * s.shape().up;
        result = widened(std::move(result), rest * s.shape().up + model::tiny);
        result = number_detail::sharper(f, s, std::move(result), good);
    }
    number_detail::forget(!good, result);
    undefined |= !good;
    return result;
}

/// f(s) in lanes where s is known to lie between bounds that do not follow from its polynomial: of
/// a square, an absolute value or an exponential a polynomial may fall below 0, its values do not.
/// @param usual      what is said of f(s) in the other lanes
/// @param undefined  gets the lanes, of these, where f is not defined between the bounds
template <class C>
[[nodiscard]] taylor_model<C>
apply_between(univariate f, taylor_model<C> const& s, value_bounds<C> const& known,
              typename lane_traits<C>::mask const& lanes, taylor_model<C> usual,
              typename lane_traits<C>::mask& undefined) {
    C const none(std::numeric_limits<double>::infinity());
    number_detail::forget(lanes, usual);
    auto result = number_detail::sharpest(f, s, std::move(usual), lanes, known);
    undefined |= lanes & !(result.r() < none);
    return result;
}

} // namespace sivid

#endif
