// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_POLYNOMIAL_DETAIL_NEAR_MINIMAX_HPP
#define SIVID_NUMBER_POLYNOMIAL_DETAIL_NEAR_MINIMAX_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/polynomial/univariate_taylor.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

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

#endif
