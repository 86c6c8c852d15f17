// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_TURNS_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_TURNS_HPP

#include <sivid/io/input_error.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// Readings that wrap, such as a course through north: what an import may believe of them.
namespace sivid {

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
