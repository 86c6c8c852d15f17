// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_WRAPPING_COUNTER_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_WRAPPING_COUNTER_HPP

#include <sivid/io/text/exact_decimal.hpp>

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace sivid {

/// The whole number that a decimal is, if it has at most 15 digits.
[[nodiscard]] inline std::optional<std::int64_t> whole_number(exact_decimal const& x) {
    auto const text = x.text(); // plain notation up to 17 digits
    std::int64_t value = 0;
    auto const [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc{} || end != text.data() + text.size() || text.size() > 16)
        return std::nullopt;
    return value;
}

/// Follows counts modulo 2^bits, such as an encoder's, beyond the ends of their range.
/// Rule: from one reading to the next the count has gone the shorter way. That is right as long as
/// it moves by less than half the range; more than a quarter is reported as doubtful, and exactly
/// half cannot be decided.
class wrapping_counter {
public:
    struct step {
        bool possible = false;  ///< false: outside the range of the counter, or exactly half of it
        bool wrapped = false;   ///< through an end of the range
        bool doubtful = false;  ///< by more than a quarter of the range
        std::int64_t count = 0; ///< followed beyond the ends
    };

    /// @given  1 < bits <= 48 (trusted)
    explicit wrapping_counter(unsigned bits) : range_{std::int64_t{1} << bits} {}

    /// The next reading, signed or not: -2^(bits-1) <= raw < 2^bits. One that is not possible
    /// changes nothing.
    step operator()(std::int64_t raw) {
        if (raw < -range_ / 2 || raw >= range_) return {};
        if (!started_) {
            started_ = true;
            last_ = raw;
            count_ = raw;
            return {true, false, false, count_};
        }
        auto way = (raw - last_) % range_;
        if (way < -range_ / 2) way += range_;
        if (way > range_ / 2) way -= range_;
        if (way == range_ / 2 || way == -range_ / 2) return {};
        step const result{true, way != raw - last_, way > range_ / 4 || way < -range_ / 4,
                          count_ + way};
        last_ = raw;
        count_ = result.count;
        return result;
    }

private:
    std::int64_t range_;
    bool started_ = false;
    std::int64_t last_ = 0, count_ = 0;
};

/// The time stamps of a log: how far it is from one to the next, also through the end of the
/// counter.
class time_stamps {
public:
    /// @param bits  of the counter; nothing: it never wraps
    /// @param longest  the longest usual step [s]
    /// @param tick  of the clock [s]
    /// @param clock  times of day in seconds, which begin anew at midnight
    time_stamps(std::optional<unsigned> bits, exact_decimal longest, exact_decimal tick,
                bool clock = false)
        : clock_{clock}, longest_{std::move(longest)}, tick_{std::move(tick)} {
        if (clock) range_ = exact_decimal::parse("86400");
        if (bits) range_ = exact_decimal::parse(std::to_string(std::uint64_t{1} << *bits));
    }

    /// Whether a counter can show this: whole and below 2^bits.
    [[nodiscard]] bool possible(exact_decimal const& a) const {
        if (!range_ || clock_) return true; // 24:00:00 is a time of day, too
        return !a.is_negative() && a < *range_ && whole_number(a).has_value();
    }
    /// From a to b, through the end of the counter where b is less than a; nothing: back.
    [[nodiscard]] std::optional<exact_decimal> forward(exact_decimal const& a,
                                                       exact_decimal const& b) const {
        auto const way = b - a;
        if (!way.is_negative()) return way;
        if (!range_) return std::nullopt;
        return way + *range_;
    }
    /// Whether b follows a by a usual step.
    [[nodiscard]] bool goes_on(exact_decimal const& a, exact_decimal const& b) const {
        auto const way = forward(a, b);
        return way && way->is_positive() && !(longest_ < way->times(tick_));
    }
    [[nodiscard]] bool wraps() const { return range_.has_value(); }
    /// What wraps, for messages.
    [[nodiscard]] char const* name() const { return clock_ ? "clock" : "counter"; }

private:
    bool clock_;
    std::optional<exact_decimal> range_;
    exact_decimal longest_, tick_;
};

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_WRAPPING_COUNTER_HPP
