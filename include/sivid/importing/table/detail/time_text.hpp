// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_TIME_TEXT_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_TIME_TEXT_HPP

#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/importing/table/detail/recorded_text.hpp>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace sivid {

/// Takes a text apart from its begin.
struct text_cursor {
    std::string_view rest;

    /// The next digits, from `least` to `most` of them; nothing: there are fewer.
    std::optional<int> digits(std::size_t least, std::size_t most) {
        auto const count = std::min(rest.find_first_not_of("0123456789"), rest.size());
        auto const used = std::min(count, most);
        if (used < least) return std::nullopt;
        int value = 0;
        std::from_chars(rest.data(), rest.data() + used, value);
        rest.remove_prefix(used);
        return value;
    }
    /// Whether one of these characters is next; it is passed.
    bool any(std::string_view wanted) {
        if (rest.empty() || wanted.find(rest.front()) == std::string_view::npos) return false;
        rest.remove_prefix(1);
        return true;
    }
};

/// h:mm:ss, with a fraction or none, in seconds since midnight; 24:00:00 is the end of a day. Leap
/// seconds are no times of day.
[[nodiscard]] inline std::optional<exact_decimal> read_clock(text_cursor& at, std::size_t hours) {
    auto const h = at.digits(hours, 2);
    if (!h || !at.any(":")) return std::nullopt;
    auto const m = at.digits(2, 2);
    if (!m || !at.any(":")) return std::nullopt;
    auto const s = at.digits(2, 2);
    if (!s || *h > 24 || *m > 59 || *s > 59) return std::nullopt;
    auto result = *exact_decimal::parse(std::to_string(3600 * *h + 60 * *m + *s));
    if (at.any(".,")) {
        auto const count = std::min(at.rest.find_first_not_of("0123456789"), at.rest.size());
        auto const part = exact_decimal::parse("0." + std::string{at.rest.substr(0, count)});
        if (count == 0 || count > 30 || !part) return std::nullopt;
        result = result + *part;
        at.rest.remove_prefix(count);
    }
    if (*h == 24 && !(result == *exact_decimal::parse("86400"))) return std::nullopt;
    return result;
}

/// A date with a time of day.
struct date_text {
    exact_decimal seconds;     ///< since 1970-01-01, UTC where the offset is stated
    std::optional<int> offset; ///< from UTC [min]; nothing: not stated
};

/// yyyy-mm-ddThh:mm:ss (or a blank for T), a fraction or none, and Z, +hh:mm, +hhmm, +hh or
/// nothing: ISO 8601, exactly.
[[nodiscard]] inline std::optional<date_text> read_date(std::string_view text) {
    text_cursor at{text};
    auto const year = at.digits(4, 4);
    if (!year || !at.any("-")) return std::nullopt;
    auto const month = at.digits(2, 2);
    if (!month || !at.any("-")) return std::nullopt;
    auto const day = at.digits(2, 2);
    if (!day || !at.any("Tt ")) return std::nullopt;
    std::chrono::year_month_day const date{std::chrono::year{*year},
                                           std::chrono::month{static_cast<unsigned>(*month)},
                                           std::chrono::day{static_cast<unsigned>(*day)}};
    auto const clock = read_clock(at, 2);
    if (!date.ok() || !clock) return std::nullopt;
    date_text result;
    if (at.any("Zz")) {
        result.offset = 0;
    } else if (!at.rest.empty()) {
        int const sign = at.rest.front() == '-' ? -1 : 1;
        if (!at.any("+-")) return std::nullopt;
        auto const h = at.digits(2, 2);
        bool const colon = at.any(":");
        auto const m = at.rest.empty() && !colon ? std::optional{0} : at.digits(2, 2);
        if (!h || !m || *h > 23 || *m > 59) return std::nullopt;
        result.offset = sign * (60 * *h + *m);
    }
    if (!at.rest.empty()) return std::nullopt;
    std::int64_t const days = std::chrono::sys_days{date}.time_since_epoch().count();
    auto const begin = 86400 * days - 60 * std::int64_t{result.offset.value_or(0)};
    result.seconds = *exact_decimal::parse(std::to_string(begin)) + *clock;
    return result;
}

/// h:mm:ss alone.
[[nodiscard]] inline std::optional<exact_decimal> read_time_of_day(std::string_view text) {
    text_cursor at{text};
    auto const result = read_clock(at, 1);
    return at.rest.empty() ? result : std::nullopt;
}

/// Whether a text begins as a date does, numbers between two marks, in whatever order.
[[nodiscard]] inline bool begins_as_date(std::string_view text) {
    text_cursor at{text};
    return at.digits(1, 4) && at.any("./-") && at.digits(1, 2) && at.any("./-") && at.digits(1, 4);
}

/// Reads the time stamps of one column, in the form that the mapping states.
class stamp_reader {
public:
    stamp_reader(time_mapping const& time, char decimal) : form_{time.form}, decimal_{decimal} {}

    /// What is wrong with a text, and what to do.
    struct complaint {
        std::string problem, remedy;
    };

    /// A number in the unit of the mapping, otherwise seconds; nothing: it is no such time.
    [[nodiscard]] std::optional<exact_decimal> operator()(std::string_view cell) const {
        if (form_ == time_form::number) return parse_reading(cell, decimal_);
        if (form_ == time_form::clock) return read_time_of_day(cell);
        auto const date = read_date(cell);
        return date && date->offset ? std::optional{date->seconds} : std::nullopt;
    }

    /// Dates keep one offset from UTC: another one is a clock that was set anew.
    [[nodiscard]] std::optional<complaint> other_offset(std::string_view cell) {
        if (form_ != time_form::date) return std::nullopt;
        auto const date = read_date(cell);
        if (!date || !date->offset) return std::nullopt;
        if (!offset_) offset_ = date->offset;
        if (*offset_ == *date->offset) return std::nullopt;
        return complaint{
            text_of(in_quotes(cell), " has another offset from UTC than the times before"),
            "write all times with one offset, such as Z"};
    }

    /// Why a text is no time of this form; nothing: nobody knows.
    [[nodiscard]] std::optional<complaint> about(std::string_view cell) const {
        auto const unit = [&](time_form wanted, char const* name) {
            return form_ == wanted ? std::string{}
                                   : text_of("state \"unit\": \"", name, "\" for the time");
        };
        auto const found = in_quotes(cell);
        auto const iso = unit(time_form::date, "iso8601");
        if (cell.find(":60") != std::string_view::npos &&
            cell.find("59:60") != std::string_view::npos)
            return complaint{found + " is a leap second: seconds of a day do not count it",
                             "leave the line out"};
        if (auto const date = read_date(cell))
            return date->offset ? complaint{found + " is a date", iso}
                                : complaint{found + " is a date without an offset from UTC",
                                            text_of("write Z or the offset behind each, such as "
                                                    "2026-11-29T12:00:00+01:00",
                                                    iso.empty() ? "" : ", and ", iso)};
        if (read_time_of_day(cell))
            return complaint{found + " is a time of day", unit(time_form::clock, "hh:mm:ss")};
        if (begins_as_date(cell))
            return complaint{found + (cell.find_first_of("./-") == 4
                                          ? " is no complete date of ISO 8601"
                                          : " is a date, and nobody knows the order of day, month "
                                            "and year"),
                             text_of("write it as ISO 8601 does, 2026-11-29T12:00:00Z",
                                     iso.empty() ? "" : ", and ", iso)};
        return std::nullopt;
    }

private:
    time_form form_;
    char decimal_;
    std::optional<int> offset_; ///< of the first date
};

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_TIME_TEXT_HPP
