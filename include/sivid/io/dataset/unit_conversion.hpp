// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_UNIT_CONVERSION_HPP
#define SIVID_IO_DATASET_UNIT_CONVERSION_HPP

#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/model/unit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace sivid {

/// |x|.
[[nodiscard]] inline exact_decimal magnitude(exact_decimal const& x) {
    return x.is_negative() ? -x : x;
}

/// The least decimal of so many digits that is not below x.
[[nodiscard]] inline exact_decimal rounded_up(exact_decimal const& x, std::size_t digits) {
    return x.divided_by(1, digits).second;
}

/// A quantity in the model's unit: it lies in value +/- rounding. rounding is 0 where the value has
/// at most 30 digits and the conversion is a decimal one.
struct converted_reading {
    exact_decimal value, rounding;
};

/// From a reading to the model's unit:  reading * factor / divisor + offset.
/// The factor may be an interval, for what no decimal is (pi/180) or what nobody knows exactly.
struct unit_conversion {
    static constexpr std::size_t digits = 30; ///< kept of a value
    static constexpr std::size_t largest_divisor = 1'000'000'000;

    exact_decimal factor_lower = one(), factor_upper = one();
    std::size_t divisor = 1; ///< 1 to largest_divisor
    exact_decimal offset;

    /// From one unit to another, such as they are to each other. A factor with pi in it is an
    /// interval of 50 digits.
    /// @returns  nothing for factors that nobody needs: their divisor is beyond `largest_divisor`,
    ///           or they have more than eight powers of pi
    [[nodiscard]] static std::optional<unit_conversion> of(unit::ratio const& r) {
        static auto const half = *exact_decimal::parse("0.5");
        unit_conversion c;
        auto factor = *exact_decimal::parse("1e" + std::to_string(r.ten));
        for (int k = 0; k < r.two; ++k) factor = factor.times(2);
        for (int k = 0; k > r.two; --k) factor = factor.times(half);
        for (int k = 0; k < r.three; ++k) factor = factor.times(3);
        for (int k = 0; k > r.three; --k) {
            if (c.divisor > largest_divisor / 3) return std::nullopt;
            c.divisor *= 3;
        }
        c.factor_lower = c.factor_upper = factor;
        if (std::abs(r.pi) > 8) return std::nullopt;
        std::string const pi = "3.1415926535897932384626433832795028841971693993751",
                          part = "0.31830988618379067153776752674502872406891929148091";
        auto const lower = *exact_decimal::parse(r.pi > 0 ? pi : part); // cut off
        auto const upper = lower + *exact_decimal::parse(r.pi > 0 ? "1e-49" : "1e-50");
        for (int k = 0; k < std::abs(r.pi); ++k) {
            c.factor_lower = c.factor_lower.times(lower);
            c.factor_upper = c.factor_upper.times(upper);
        }
        return c;
    }

    [[nodiscard]] bool factor_is_exact() const { return factor_lower == factor_upper; }

    /// @returns nothing beyond the range of double
    /// @guarantee  for every factor of the interval the exact result lies in value +/- rounding
    [[nodiscard]] std::optional<converted_reading> operator()(exact_decimal const& reading) const {
        auto low = reading.times(factor_lower), high = reading.times(factor_upper);
        if (high < low) std::swap(low, high);
        if (divisor != 1) {
            low = low.divided_by(divisor, digits).first;
            high = high.divided_by(divisor, digits).second;
        }
        low = (low + offset).divided_by(1, digits).first;
        high = (high + offset).divided_by(1, digits).second;
        auto const a = nearest(low), b = nearest(high);
        if (!a || !b) return std::nullopt;
        // Below the smallest doubles exponents would grow without limit: zero stands for all that.
        if (std::abs(*a) < 1e-300 && std::abs(*b) < 1e-300 && !(low.is_zero() && high.is_zero()))
            return converted_reading{{}, smallest()};
        if (low == high) return converted_reading{low, {}};
        auto const middle = (low + high).divided_by(2, digits).first;
        auto const above = high - middle, below = middle - low;
        return converted_reading{middle, rounded_up(below < above ? above : below, 3)};
    }

    /// The same for a reading of which only bounds are known.
    /// @given  lower <= upper (trusted)
    [[nodiscard]] std::optional<converted_reading> operator()(exact_decimal const& lower,
                                                              exact_decimal const& upper) const {
        auto const a = (*this)(lower), b = (*this)(upper);
        if (!a || !b || lower == upper) return b ? a : b;
        auto low = a->value - a->rounding, high = a->value + a->rounding;
        if (b->value - b->rounding < low) low = b->value - b->rounding;
        if (high < b->value + b->rounding) high = b->value + b->rounding;
        auto const middle = (low + high).divided_by(2, digits).first;
        auto const above = high - middle, below = middle - low;
        return converted_reading{middle, rounded_up(below < above ? above : below, 3)};
    }

    /// An error bound of the reading, in the model's unit, rounded up to so many digits.
    /// @given  error > 0 (trusted)
    [[nodiscard]] exact_decimal bound(exact_decimal const& error, std::size_t kept = 15) const {
        auto const a = magnitude(factor_lower), b = magnitude(factor_upper);
        auto const result =
            rounded_up(error.times(a < b ? b : a).divided_by(divisor, digits).second, kept);
        return result < smallest() ? smallest() : result;
    }

    /// "reading * 5 / 1023 - 2.5", or "" when nothing is changed.
    [[nodiscard]] std::string text() const {
        if (factor_is_exact() && factor_lower == one() && divisor == 1 && offset.is_zero())
            return {};
        std::string result = "reading";
        if (!factor_is_exact())
            result += " * [" + factor_lower.text() + ", " + factor_upper.text() + "]";
        else if (!(factor_lower == one()))
            result += " * " + factor_lower.text();
        if (divisor != 1) result += " / " + std::to_string(divisor);
        if (!offset.is_zero())
            result += (offset.is_negative() ? " - " : " + ") + magnitude(offset).text();
        return result;
    }

private:
    static exact_decimal one() { return *exact_decimal::parse("1"); }
    static exact_decimal smallest() { return *exact_decimal::parse("1e-300"); }
};

} // namespace sivid

#endif // SIVID_IO_DATASET_UNIT_CONVERSION_HPP
