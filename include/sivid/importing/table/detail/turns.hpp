// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_TURNS_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_TURNS_HPP

#include <sivid/io/input_error.hpp>
#include <sivid/io/text/exact_decimal.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Follows readings modulo a period, such as a heading between -180 and 180 degrees, beyond the
/// ends of their range: the first one stands, from one to the next it has gone the shorter way.
/// That is right as long as it moves by less than half a period; more than a quarter is reported as
/// doubtful, and half of it, but for roundings, cannot be decided.
class wrapped_reading {
public:
    struct step {
        bool possible = false; ///< false: half a period from the one before, or far too large
        bool wrapped = false;  ///< through an end of the range
        bool doubtful = false; ///< by more than a quarter of a period
        /// With all turns since the first reading, for every period of the interval.
        exact_decimal lower, upper;
    };

    /// @given  0 < lower <= upper, finite as doubles (trusted)
    wrapped_reading(exact_decimal lower, exact_decimal upper)
        : lower_(std::move(lower)),
          upper_(std::move(upper)),
          period_((*nearest(lower_) + *nearest(upper_)) / 2) {}

    /// The next reading. One that is not possible changes nothing.
    /// @given  a reading within the range of double (trusted)
    step operator()(exact_decimal const& raw) {
        constexpr double most_turns = 1e15, most_periods = 1e6, margin = 1e-9;
        double const now = *nearest(raw); // good to far less than the margin, see most_periods
        double const way = started_ ? now - last_ : 0;
        double const turns = turns_ - std::round(way / period_);
        double const moved = std::abs(std::remainder(way, period_)) / period_;
        if (!(std::abs(turns) < most_turns) || !(std::abs(now) < most_periods * period_) ||
            !(moved < 0.5 - margin))
            return {};
        step result{true, turns != turns_, moved > 0.25, raw, raw};
        if (turns != 0) {
            auto const count = static_cast<std::size_t>(std::abs(turns));
            auto const least = lower_.times(count), most = upper_.times(count);
            result.lower = turns > 0 ? raw + least : raw - most;
            result.upper = turns > 0 ? raw + most : raw - least;
        }
        started_ = true;
        last_ = now;
        turns_ = turns;
        return result;
    }

private:
    exact_decimal lower_, upper_;
    double period_;
    bool started_ = false;
    double last_ = 0, turns_ = 0;
};

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

namespace import_detail {

/// The middle one of the values above 0; 0 where there is none.
[[nodiscard]] inline double usual(std::vector<double> values) {
    std::erase_if(values, [](double v) { return !(v > 0); });
    if (values.empty()) return 0;
    auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace import_detail

/// Readings that are averages over a leap: a recorder that filters 359 and 1 degrees stores 180.
/// The readings around them go through the end of the range by a short way, and these lie on the
/// long one, off both ends by more than four usual steps.
/// @param period  of the readings, above 0
[[nodiscard]] inline std::vector<bool> smeared_leaps(std::vector<double> const& readings,
                                                     double period) {
    constexpr std::size_t longest =
        3; // samples of one leap; a filter over more is no average of two
    constexpr double steps = 4;
    std::vector<bool> result(readings.size(), false);
    std::vector<double> ways;
    for (std::size_t i = 1; i < readings.size(); ++i)
        ways.push_back(std::abs(std::remainder(readings[i] - readings[i - 1], period)));
    double const usual = import_detail::usual(ways);
    for (std::size_t i = 0; i + 2 < readings.size(); ++i) {
        for (std::size_t n = 1; n <= longest && i + n + 1 < readings.size(); ++n) {
            double const a = readings[i], c = readings[i + n + 1];
            double const way = std::remainder(c - a, period);
            bool const leaps = std::abs(c - a) > period / 2;
            if (!leaps || std::abs(way) > std::min(period / 8, steps * usual * double(n + 1)))
                continue;
            bool all = true;
            for (std::size_t k = i + 1; k <= i + n; ++k)
                all =
                    all && readings[k] > std::min(a, c) && readings[k] < std::max(a, c) &&
                    std::min(std::abs(readings[k] - a), std::abs(readings[k] - c)) > steps * usual;
            if (!all) continue;
            for (std::size_t k = i + 1; k <= i + n; ++k) result[k] = true;
            break;
        }
    }
    return result;
}

/// Before which readings a gap is so long that, at the largest rate between usual ones, half a
/// period could have been passed: whole turns may be lost there.
/// @param readings  followed beyond the ends of their range
[[nodiscard]] inline std::vector<std::size_t> doubtful_turns(std::vector<double> const& times,
                                                             std::vector<double> const& readings,
                                                             double period) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
    double const usual = 1.5 * import_detail::usual(steps);
    double rate = 0;
    for (std::size_t i = 1; i < times.size(); ++i)
        if (steps[i - 1] > 0 && steps[i - 1] <= usual)
            rate = std::max(rate, std::abs(readings[i] - readings[i - 1]) / steps[i - 1]);
    std::vector<std::size_t> result;
    for (std::size_t i = 1; i < times.size(); ++i)
        if (steps[i - 1] > usual && rate * steps[i - 1] >= period / 2) result.push_back(i);
    return result;
}

/// Whether the readings around a jump move as they do through it, taken modulo the period.
[[nodiscard]] inline bool goes_on(std::vector<double> const& readings, std::size_t to,
                                  double period) {
    double const way = std::remainder(readings[to] - readings[to - 1], period);
    return (to >= 2 && (readings[to - 1] - readings[to - 2]) * way > 0) ||
           (to + 1 < readings.size() && (readings[to + 1] - readings[to]) * way > 0);
}

/// A period that nobody stated, though readings jump by nearly that much and no further.
struct suspected_wrap {
    std::string words, entry; ///< its size, and what to state in a mapping
    std::size_t at = 0;       ///< the first reading after a jump
};

/// @returns  nothing where the readings do not look so
[[nodiscard]] inline std::optional<suspected_wrap>
suspected_period(std::vector<double> const& readings) {
    struct possible_wrap {
        double period;
        std::string words, entry;
        bool counter = false;
    };
    std::vector<possible_wrap> all{
        {360, "360", "\"period\": 360"},
        {6.283185307179586, "2 pi", "\"period\": [6.283185307179586, 6.283185307179587]"}};
    for (int const bits : {8, 10, 12, 13, 14, 16, 20, 24, 32})
        all.push_back({std::ldexp(1.0, bits), text_of("2^", std::to_string(bits)),
                       text_of("\"counter_bits\": ", std::to_string(bits)), true});
    if (readings.empty()) return std::nullopt;
    auto const [low, high] = std::minmax_element(readings.begin(), readings.end());
    for (auto const& c : all) {
        auto const leaps = [&](std::size_t from, std::size_t to) {
            double const by = std::abs(readings[to] - readings[from]);
            return by > 0.9 * c.period && by <= c.period;
        };
        std::size_t jumps = 0, others = 0, at = 0;
        for (std::size_t i = 1; i < readings.size(); ++i) {
            bool const plain = leaps(i - 1, i);
            // over two samples, the one between an average of both ends
            bool const smeared =
                !plain && i >= 2 && leaps(i - 2, i) &&
                (readings[i] - readings[i - 1]) * (readings[i - 1] - readings[i - 2]) > 0;
            if ((plain || smeared) && jumps++ == 0) at = i;
            if (c.counter && plain && !goes_on(readings, i, c.period)) ++others; // a switch
            if (smeared && others > 0)
                --others; // the way to the one between
            else if (!plain && std::abs(readings[i] - readings[i - 1]) > 0.25 * c.period)
                ++others;
        }
        if (jumps == 0 || others > 0 || *high - *low > c.period) continue;
        return suspected_wrap{c.words, c.entry, at};
    }
    return std::nullopt;
}

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_TURNS_HPP
