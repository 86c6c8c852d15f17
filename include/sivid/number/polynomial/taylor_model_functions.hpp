// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_TAYLOR_MODEL_FUNCTIONS_HPP
#define SIVID_NUMBER_POLYNOMIAL_TAYLOR_MODEL_FUNCTIONS_HPP

#include <sivid/number/elementary.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/polynomial/detail/bernstein.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace sivid {

/// Functions of one variable whose Taylor coefficients are known here.
enum class univariate { exp, log, sin, cos, tan, atan, tanh, sech_squared, reciprocal, sqrt };

namespace number_detail {

/// The recurrences of Taylor coefficients y[0 .. order] at x.
class coefficients_at {
public:
    coefficients_at(interval const& x, std::size_t order, interval* y, bool& undefined)
        : x_(x), order_(order), y_(y), undefined_(undefined) {}

    void exponential() {
        y_[0] = T::exp(x_);
        for (std::size_t k = 1; k <= order_; ++k) y_[k] = over(y_[k - 1], k);
    }
    void logarithm() { // (-1)^(k+1) / (k x^k)
        y_[0] = T::log(x_, undefined_);
        if (!(x_.lower() > 0)) undefined_ = true;
        interval power = T::point(-1.0);
        for (std::size_t k = 1; k <= order_; ++k) {
            power = T::neg(T::div(power, x_, undefined_));
            y_[k] = over(power, k);
        }
    }
    void sine(bool cosine) {
        y_[0] = cosine ? T::cos(x_) : T::sin(x_);
        if (order_ >= 1) y_[1] = cosine ? T::neg(T::sin(x_)) : T::cos(x_);
        for (std::size_t k = 2; k <= order_; ++k) y_[k] = T::neg(over(y_[k - 2], k * (k - 1)));
    }
    void tangent() { // y' = 1 + y^2
        y_[0] = T::tan(x_, undefined_);
        for (std::size_t k = 0; k < order_; ++k) {
            y_[k + 1] = over(k == 0 ? T::add(T::point(1.0), square(k)) : square(k), k + 1);
        }
    }
    void hyperbolic_tangent() { // y' = 1 - y^2; all but the value have the slope as a factor
        y_[0] = T::tanh(x_);
        for (std::size_t k = 0; k < order_; ++k) {
            y_[k + 1] = over(k == 0 ? tanh_slope(x_) : T::neg(square(k)), k + 1);
        }
    }
    void squared_secant() { // 1 - tanh^2; each square needs the tangents before it alone
        hyperbolic_tangent();
        for (std::size_t k = order_; k > 0; --k) y_[k] = T::neg(square(k));
        y_[0] = tanh_slope(x_);
    }
    void arc_tangent() { // y' (1 + x^2) = 1, with (1 + (x+s)^2) = w0 + 2 x s + s^2
        y_[0] = T::atan(x_);
        auto const w0 = T::add(T::point(1.0), T::sqr(x_));
        interval before = T::point(0.0), last = before; // y'_{k-2}, y'_{k-1}
        for (std::size_t k = 0; k < order_; ++k) { // z = y', z_k w0 = [k=0] - 2 x z_{k-1} - z_{k-2}
            interval sum = T::point(k == 0 ? 1.0 : 0.0);
            if (k >= 1) sum = T::sub(sum, T::mul(T::mul(number(2), x_), last));
            if (k >= 2) sum = T::sub(sum, before);
            before = last;
            last = T::div(sum, w0, undefined_);
            y_[k + 1] = over(last, k + 1);
        }
    }
    void reciprocal() { // (-1)^k / x^(k+1)
        y_[0] = T::div(T::point(1.0), x_, undefined_);
        for (std::size_t k = 1; k <= order_; ++k) y_[k] = T::neg(T::mul(y_[k - 1], y_[0]));
    }
    void square_root() { // y_k = y_{k-1} (3/2 - k) / (k x)
        y_[0] = T::sqrt(x_, undefined_);
        for (std::size_t k = 1; k <= order_; ++k) {
            auto const factor = T::point(1.5 - static_cast<double>(k));
            y_[k] = over(T::div(T::mul(y_[k - 1], factor), x_, undefined_), k);
        }
    }

private:
    using T = interval_traits<interval>;
    [[nodiscard]] static interval number(std::size_t k) { return T::point(static_cast<double>(k)); }
    [[nodiscard]] interval over(interval const& a, std::size_t k) const {
        return T::div(a, number(k), undefined_);
    }
    [[nodiscard]] interval square(std::size_t k) const { // coefficient k of y^2
        interval sum = T::point(0.0);
        for (std::size_t j = 0; j <= k; ++j) sum = T::add(sum, T::mul(y_[j], y_[k - j]));
        return k == 0 ? T::sqr(y_[0]) : sum;
    }

    interval const& x_;
    std::size_t order_;
    interval* y_;
    bool& undefined_;
};

} // namespace number_detail

/// Encloses \f$ f^{(k)}(x)/k! \f$ for k = 0 .. order at every x in the interval.
/// @param y          gets the order + 1 enclosures
/// @param undefined  set where f is not defined (or not smooth) on all of x
/// @ref  recurrences as in Griewank and Walther 2008, table 13.2
inline void taylor_coefficients(univariate f, interval const& x, std::size_t order, interval* y,
                                bool& undefined) {
    number_detail::coefficients_at at(x, order, y, undefined);
    switch (f) {
    case univariate::exp:
        return at.exponential();
    case univariate::log:
        return at.logarithm();
    case univariate::sin:
        return at.sine(false);
    case univariate::cos:
        return at.sine(true);
    case univariate::tan:
        return at.tangent();
    case univariate::atan:
        return at.arc_tangent();
    case univariate::tanh:
        return at.hyperbolic_tangent();
    case univariate::sech_squared:
        return at.squared_secant();
    case univariate::reciprocal:
        return at.reciprocal();
    case univariate::sqrt:
        return at.square_root();
    }
}

} // namespace sivid

namespace sivid {

/// Polynomials of at most this degree take the place of functions.
inline constexpr std::size_t most_near_minimax_degree = 8;

/// A polynomial close to a function on all of an interval, with a proved bound of what it is off.
///   It interpolates f at Chebyshev's nodes, so its error is about \f$ 2^{-D} \f$ of that of a
///   Taylor polynomial, and less where the Taylor series hardly converges. It is computed in
///   doubles and only a proposal; on each of some pieces of the interval, with middle c and radius
///   r, \f[ |f(x) - p(x)| \le \sum_{k \le D} |f^{[k]}(c) - p^{[k]}(c)| r^k + |f^{[D+1]}(piece)|
///   r^{D+1} \f] with Taylor coefficients in interval arithmetic.
/// @ref  L. N. Trefethen, Approximation Theory and Approximation Practice (2013), chapter 4
class near_minimax {
    using traits = interval_traits<interval>;

public:
    /// @param about   p is a polynomial in x - about
    /// @param degree  at most `most_near_minimax_degree`
    /// @cost  Taylor coefficients at up to 62 places, most often at less than ten
    near_minimax(univariate f, double about, interval const& range, std::size_t degree)
        : degree_(std::min(degree, most_near_minimax_degree)) {
        bool const bounded = std::isfinite(range.lower()) && std::isfinite(range.upper());
        if (!bounded || !interpolate(f, about, range)) return;
        std::array<piece, most_pieces> all;
        all[0] = look(f, about, range);
        double seen = all[0].seen;
        for (std::size_t count = 1;; ++count) {
            auto const worst =
                std::max_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count),
                                 [](piece const& a, piece const& b) { return a.error < b.error; });
            error_ = worst->error;
            if (count == most_pieces || error_ <= 1.5 * seen) return;
            double const middle = mid(worst->x);
            all[count] = look(f, about, interval(middle, worst->x.upper()));
            *worst = look(f, about, interval(worst->x.lower(), middle));
            seen = std::max({seen, worst->seen, all[count].seen});
        }
    }

    [[nodiscard]] std::size_t degree() const { return degree_; }
    /// Coefficient k.
    [[nodiscard]] double operator[](std::size_t k) const { return p_[k]; }
    /// |f - p| is nowhere more; infinite where f is not smooth, or not finite, on all of the range,
    /// or the range is a point.
    [[nodiscard]] double error() const { return error_; }

private:
    static constexpr std::size_t most_pieces = 16;
    struct piece {
        interval x;
        double error = std::numeric_limits<double>::infinity(); ///< a bound on all of it
        double seen = 0;                                        ///< about the error at the middle
    };

    /// @returns  false where f is not defined at the nodes
    bool interpolate(univariate f, double about, interval const& range) {
        auto const n = degree_ + 1;
        double const middle = mid(range), radius = rad(range);
        if (!(radius > 0)) return false;
        std::array<double, most_near_minimax_degree + 1> values{}, in_unit{};
        auto const angle = [n](std::size_t i) {
            return 3.141592653589793 * (2 * static_cast<double>(i) + 1) /
                   (2 * static_cast<double>(n));
        };
        for (std::size_t i = 0; i < n; ++i) {
            bool undefined = false;
            interval y;
            double const x = middle + radius * std::cos(angle(i));
            taylor_coefficients(f, traits::point(x), 0, &y, undefined);
            values[i] = mid(y);
            if (undefined || !std::isfinite(values[i])) return false;
        }
        // Chebyshev coefficients, summed as polynomials in u = (x - middle) / radius.
        std::array<double, most_near_minimax_degree + 1> last{}, now{};
        now[0] = 1;
        for (std::size_t j = 0; j < n; ++j) {
            double sum = 0;
            for (std::size_t i = 0; i < n; ++i) {
                sum += values[i] * std::cos(static_cast<double>(j) * angle(i));
            }
            sum *= (j == 0 ? 1.0 : 2.0) / static_cast<double>(n);
            for (std::size_t k = 0; k <= j; ++k) in_unit[k] += sum * now[k];
            auto next = now; // T_{j+1} = 2 u T_j - T_{j-1}, with T_1 = u T_0
            for (std::size_t k = 0; k < n; ++k) {
                next[k] = (k > 0 ? (j == 0 ? 1.0 : 2.0) * now[k - 1] : 0.0) - last[k];
            }
            last = now;
            now = next;
        }
        double scale = 1;
        for (std::size_t k = 0; k < n; ++k, scale /= radius) p_[k] = in_unit[k] * scale;
        shift(
            p_, about - middle, [](double a, double b) { return a + b; },
            [](double a, double b) { return a * b; });
        return std::all_of(p_.begin(), p_.begin() + static_cast<std::ptrdiff_t>(n),
                           [](double c) { return std::isfinite(c); });
    }
    /// The coefficients about a place that is `by` further on.
    template <class Coefficients, class Number, class Add, class Multiply>
    void shift(Coefficients& c, Number const& by, Add const& add, Multiply const& multiply) const {
        for (std::size_t i = 0; i < degree_; ++i) {
            for (std::size_t k = degree_; k-- > i;) c[k] = add(c[k], multiply(by, c[k + 1]));
        }
    }
    [[nodiscard]] piece look(univariate f, double about, interval const& x) const {
        auto const centre = traits::point(mid(x));
        auto const r =
            traits::point(std::max(traits::sub(traits::point(x.upper()), centre).upper(),
                                   traits::sub(centre, traits::point(x.lower())).upper()));
        std::array<interval, most_near_minimax_degree + 2> here, all;
        std::array<interval, most_near_minimax_degree + 1> p;
        bool undefined = false;
        taylor_coefficients(f, centre, degree_, here.data(), undefined);
        taylor_coefficients(f, x, degree_ + 1, all.data(), undefined);
        if (undefined) return {x};
        for (std::size_t k = 0; k <= degree_; ++k) p[k] = traits::point(p_[k]);
        shift(p, traits::sub(centre, traits::point(about)), traits::add, traits::mul);
        auto sum = traits::point(mag(all[degree_ + 1]));
        double off = 0;
        for (std::size_t k = degree_ + 1; k-- > 0;) {
            off = mag(traits::sub(here[k], p[k]));
            sum = traits::add(traits::mul(sum, r), traits::point(off));
        }
        if (!(sum.upper() < std::numeric_limits<double>::infinity())) return {x};
        return {x, sum.upper(), off};
    }

    std::size_t degree_;
    std::array<double, most_near_minimax_degree + 1> p_{};
    double error_ = std::numeric_limits<double>::infinity();
};

} // namespace sivid

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

namespace number_detail {
/// 1/k!, rounded up.
[[nodiscard]] inline double inverse_factorial_above(std::size_t k) {
    double result = 1;
    for (std::size_t j = 2; j <= k; ++j) result /= static_cast<double>(j);
    return result * (1 + static_cast<double>(k + 3) * std::numeric_limits<double>::epsilon());
}
} // namespace number_detail

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
            if (bounded) {
                side_by_side::put(last, l, number_detail::inverse_factorial_above(D + 1));
            } else {
                auto const whole = interval(side_by_side::get(values.lower, l),
                                            side_by_side::get(values.upper, l));
                taylor_coefficients(f, whole, D + 1, y.data(), cut);
                side_by_side::put(last, l, mag(y[D + 1]));
            }
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
