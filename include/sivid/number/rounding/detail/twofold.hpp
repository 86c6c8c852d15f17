// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ROUNDING_DETAIL_TWOFOLD_HPP
#define SIVID_NUMBER_ROUNDING_DETAIL_TWOFOLD_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/rounding.hpp>

#include <cmath>
#include <limits>

namespace sivid {

namespace detail {

struct sum_and_error {
    double sum, error;
};

/// a + b as a sum and what it was rounded by. In every rounding mode: the larger of both is
/// subtracted from the sum exactly (rounding.hpp), so the error is itself rounded at most once;
/// |error| <= u |sum| (1 + 2u).
[[gnu::always_inline]] inline sum_and_error two_sum(double a, double b) noexcept {
    a = opaque(a); // rounded products: nothing may be contracted into the differences
    b = opaque(b);
    double const s = opaque(a + b);
    bool const ordered = (bits(a) & ~sign_bit) >= (bits(b) & ~sign_bit);
    double const big = ordered ? a : b, small = ordered ? b : a;
    return {s, small - opaque(s - big)};
}

/// The same for a b. The error is rounded at most once, and is 0 for products below 1e-288, which
/// are rounded by less than 1e-303.
/// @given  |a|, |b|, |a b| below 2^1020
[[gnu::always_inline]] inline sum_and_error two_product(double a, double b) noexcept {
    a = opaque(a);
    b = opaque(b);
    double const p = opaque(a * b);
#if SIVID_FUSED
    double const error = fused(a, b, -p);
#elif SIVID_EMBEDDED_ROUNDING
    double const error = _mm_cvtsd_f64(
        _mm_fmsub_round_sd(_mm_set_sd(a), _mm_set_sd(b), _mm_set_sd(p), _MM_FROUND_CUR_DIRECTION));
#elif SIVID_MACHINE_X86_64
    double const error =
        _mm_cvtsd_f64(product_residual(_mm_set_sd(a), _mm_set_sd(b), _mm_set_sd(p)));
#else
    double const error = product_residual(a, b, p);
#endif
    return {p, std::abs(p) >= 1e-288 ? error : 0.0};
}

} // namespace detail

/// A real number known to about 31 digits: within `radius()` of the exact sum `head() + tail()`.
///   The tail is at most \f$ u(1+4u) \f$ times the head, \f$ u = 2^{-52} \f$. Rounding errors of
///   the second order are in the radius, by bounds that hold in every rounding mode
///   (`docs/theory/taylor_models.md`, section 1.4). A radius that is not finite means that nothing
///   is known.
/// @guarantee  a result contains the operation's value for all numbers within the operands
/// @cost  about 30 operations a sum or product
/// @ref   Dekker 1971; Boldo, Graillat and Muller 2017 (sums in other rounding modes)
class twofold {
public:
    static constexpr double unit = std::numeric_limits<double>::epsilon();
    /// More than all underflow errors of one operation.
    static constexpr double tiny = 1e-290;

    twofold() = default;
    explicit twofold(double x) : head_(x) { give_up_when_huge(); }
    /// Everything within `radius` of head + tail.
    twofold(double head, double tail, double radius)
        : twofold(renormalised(head, tail, radius, 2)) {}
    explicit twofold(interval const& x)
        : head_(mid(x)), radius_(is_empty(x) ? std::numeric_limits<double>::infinity() : rad(x)) {
        give_up_when_huge();
    }

    [[nodiscard]] double head() const { return head_; }
    [[nodiscard]] double tail() const { return tail_; }
    [[nodiscard]] double radius() const { return radius_; }
    /// Upper bound of all absolute values.
    [[nodiscard]] double size() const { return (middle() + radius_) * up; }
    /// Lower bound of all absolute values, 0 if there is none.
    [[nodiscard]] double least() const {
        double const x = std::abs(head_) * (1 - 8 * unit) - std::abs(tail_) - radius_ * up;
        return x > 0 ? x : 0.0;
    }
    [[nodiscard]] interval bounds() const {
        using traits = interval_traits<interval>;
        if (!std::isfinite(radius_)) return traits::entire();
        return traits::add(traits::add(traits::point(head_), traits::point(tail_)),
                           traits::bounds(-radius_, radius_));
    }

    [[nodiscard]] twofold operator-() const {
        twofold result = *this;
        result.head_ = -head_;
        result.tail_ = -tail_;
        return result;
    }
    friend twofold operator+(twofold const& a, twofold const& b) {
        auto const s = detail::two_sum(a.head_, b.head_);
        return renormalised(s.sum, s.error + (a.tail_ + b.tail_), a.radius_ + b.radius_, 8,
                            std::abs(a.head_) + std::abs(b.head_));
    }
    friend twofold operator-(twofold const& a, twofold const& b) { return a + -b; }
    friend twofold operator*(twofold const& a, twofold const& b) {
        auto const p = detail::two_product(a.head_, b.head_);
        double const size = b.middle();
        return renormalised(p.sum, p.error + (a.head_ * b.tail_ + a.tail_ * b.head_),
                            a.radius_ * (size + b.radius_) + b.radius_ * a.middle(), 12,
                            std::abs(p.sum));
    }
    /// @param undefined  set where 0 may be among the divisors
    friend twofold quotient(twofold const& a, twofold const& b, bool& undefined) {
        double const least = b.least();
        if (!(least > 0)) {
            undefined = true;
            return unknown();
        }
        // Any q will do: a / b - q = (a - b q) / b.
        twofold q(a.head_ / b.head_);
        auto const two =
            detail::two_sum(q.head_, (twofold(a.head_, a.tail_, 0) - b * q).head_ / b.head_);
        q.head_ = two.sum;
        q.tail_ = two.error;
        q.radius_ = (a - b * q).size() / least * up + tiny;
        q.give_up_when_huge();
        return q;
    }
    friend twofold sqrt(twofold const& a, bool& undefined) {
        double const first = std::sqrt(a.head_);
        if (!(a.head_ > 0) || !(a.least() > 0) || !std::isfinite(first)) {
            return twofold(interval_traits<interval>::sqrt(a.bounds(), undefined));
        }
        // Likewise: sqrt(a) - y = (a - y^2) / (sqrt(a) + y).
        twofold y(first);
        auto const two = detail::two_sum(first, (a - y * y).head_ / (2 * first));
        y.head_ = two.sum;
        y.tail_ = two.error;
        double const least = y.least();
        if (!(two.sum > 0) || !(least > 0)) return unknown();
        y.radius_ = (a - y * y).size() / least * up + tiny;
        y.give_up_when_huge();
        return y;
    }

private:
    /// Makes computed sums of a few non-negative numbers upper bounds.
    static constexpr double up = 1 + 64 * unit;
    /// Beyond this, what an overflow looks like depends on the rounding mode.
    static constexpr double largest = 1e300;

    [[nodiscard]] double middle() const { return (std::abs(head_) + std::abs(tail_)) * up; }
    static twofold unknown() {
        twofold result;
        result.radius_ = std::numeric_limits<double>::infinity();
        return result;
    }
    /// head + tail as a pair, with `errors` squares of the unit of `mass` added to the radius.
    static twofold renormalised(double head, double tail, double radius, double errors,
                                double mass) {
        auto const two = detail::two_sum(head, tail);
        twofold result;
        result.head_ = two.sum;
        result.tail_ = two.error;
        result.radius_ = (radius + errors * (unit * unit) * mass) * up + tiny;
        result.give_up_when_huge();
        return result;
    }
    static twofold renormalised(double head, double tail, double radius, double errors) {
        return renormalised(head, tail, radius, errors, std::abs(head) + std::abs(tail));
    }
    void give_up_when_huge() {
        // NaN is not below anything either.
        if (!(middle() < largest) || !(radius_ < largest)) *this = unknown();
    }

    double head_ = 0, tail_ = 0, radius_ = 0;
};

twofold quotient(twofold const& a, twofold const& b, bool& undefined);
twofold sqrt(twofold const& a, bool& undefined);

} // namespace sivid

#endif
