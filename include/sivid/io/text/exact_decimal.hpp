// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_TEXT_EXACT_DECIMAL_HPP
#define SIVID_IO_TEXT_EXACT_DECIMAL_HPP

#include <sivid/compiled.hpp>
#include <sivid/number/decimal.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace sivid {

/// A number as a file states it: any count of digits, nothing rounded.
///   \f$ x = \pm d \cdot 10^e \f$, d an integer without leading or trailing zeros ("" is zero)
/// Sums and products are exact, so that 0.29 * 100 is 29 and 2.04 - 0.02 is 2.02.
class exact_decimal {
public:
    /// Exponents beyond this are far outside double and are refused, which also bounds all sizes.
    static constexpr long largest_exponent = 5000;
    static constexpr std::size_t most_digits = 5000;

    exact_decimal() = default;

    /// Reads a sign or none, digits with a point or none, and `e` with an exponent or none; no
    /// more.
    /// @returns nothing when malformed, or when digits or exponent pass the limits above
    [[nodiscard]] static std::optional<exact_decimal> parse(std::string_view text);

    /// The shortest decimal that reads back as `value` (zero for what is not finite).
    [[nodiscard]] static exact_decimal shortest(double value);

    /// The decimal that the finite `value` is: all of its digits, 767 at most.
    [[nodiscard]] static exact_decimal of(double value);

    /// `value` rounded to so many digits after the point.
    /// @given  a magnitude below 1e300 and places <= 300 (trusted)
    [[nodiscard]] static exact_decimal rounded(double value, int places);

    [[nodiscard]] bool is_zero() const { return digits_.empty(); }
    [[nodiscard]] bool is_positive() const { return !is_zero() && !negative_; }
    [[nodiscard]] bool is_negative() const { return negative_; }

    /// Whether the digits alone tell that |x| < 10^k: enough for a range to be obvious.
    [[nodiscard]] bool is_below_power_of_ten(long k) const {
        return static_cast<long>(digits_.size()) + exponent_ <= k;
    }

    [[nodiscard]] exact_decimal operator-() const {
        exact_decimal result = *this;
        if (!is_zero()) result.negative_ = !negative_;
        return result;
    }

    [[nodiscard]] friend exact_decimal operator+(exact_decimal const& a, exact_decimal const& b) {
        return sum(a, b);
    }
    [[nodiscard]] friend exact_decimal operator-(exact_decimal const& a, exact_decimal const& b) {
        return a + (-b);
    }

    /// x n. Named, because Boost's interval converts from everything and would
    /// make `*` ambiguous.
    [[nodiscard]] exact_decimal times(std::size_t n) const;

    /// x y, exactly.
    /// @cost  the product of the counts of digits
    [[nodiscard]] exact_decimal times(exact_decimal const& y) const;

    /// The tightest pair lower <= x / n <= upper of decimals with at most so many digits; both are
    /// the quotient where it has no more.
    /// @given  0 < n <= 1e18, digits > 0 (trusted)
    [[nodiscard]] std::pair<exact_decimal, exact_decimal> divided_by(std::size_t n,
                                                                     std::size_t digits) const;

    /// floor(x) for 0 <= x < 1e18.
    [[nodiscard]] std::size_t floor() const;

    /// The number where it is a whole one from 0 to what a count may be; else nothing.
    [[nodiscard]] std::optional<std::size_t> whole() const {
        if (is_zero()) return 0;
        if (negative_ || exponent_ < 0 || !is_below_power_of_ten(20)) return std::nullopt;
        auto const text = digits_ + std::string(static_cast<std::size_t>(exponent_), '0');
        std::size_t value = 0;
        auto const read = std::from_chars(text.data(), text.data() + text.size(), value);
        return read.ec == std::errc{} ? std::optional{value} : std::nullopt;
    }

    [[nodiscard]] friend bool operator==(exact_decimal const& a, exact_decimal const& b) = default;
    [[nodiscard]] friend bool operator<(exact_decimal const& a, exact_decimal const& b) {
        return (a - b).is_negative();
    }

    /// Plain notation where it is short ("0.0042", "-1250"), otherwise with an exponent.
    [[nodiscard]] std::string text() const;

    friend std::optional<interval> enclose(exact_decimal const& x);
    friend std::optional<double> nearest(exact_decimal const& x);

private:
    struct wholes;

    static exact_decimal sum(exact_decimal const& a, exact_decimal const& b);

    /// What a scan of `digits_` would find, had it the point and the exponent.
    [[nodiscard]] detail::number_text taken_apart() const;

    void normalise();

    bool negative_ = false;
    std::string digits_;
    long exponent_ = 0;
};

/// The tightest interval around a decimal; nothing when it is beyond the largest double.
[[nodiscard]] SIVID_DECL std::optional<interval> enclose(exact_decimal const& x);

/// The tightest interval around [lower, upper]; nothing when it is beyond the largest double.
/// @given  lower <= upper (trusted)
[[nodiscard]] SIVID_DECL std::optional<interval> enclose(exact_decimal const& lower,
                                                         exact_decimal const& upper);

/// The nearest double; nothing when it is beyond the largest one.
[[nodiscard]] SIVID_DECL std::optional<double> nearest(exact_decimal const& x);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/text/impl/exact_decimal.ipp>
#endif

#endif // SIVID_IO_TEXT_EXACT_DECIMAL_HPP
