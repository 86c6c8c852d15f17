// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_PARAMETER_RANGES_HPP
#define SIVID_APP_DETAIL_PARAMETER_RANGES_HPP

#include <sivid/app/program.hpp>
#include <sivid/enclosure/normalised_unknowns.hpp>
#include <sivid/io/text/exact_decimal.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sivid::app {

namespace detail {

/// "name=value" as a pair.
inline std::pair<std::string, std::string> assignment(std::string const& text,
                                                      std::string const& what) {
    auto const equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw bad_request(what + ": write name=value, not " + in_quotes(text));
    return {text.substr(0, equals), text.substr(equals + 1)};
}

} // namespace detail

/// "name=value" or "name=lower:upper" on the command line, in decimals, read outward.
/// @throws bad_request
inline std::map<std::string, interval> ranges_from(std::vector<std::string> const& list,
                                                   std::string const& what) {
    std::map<std::string, interval> result;
    for (auto const& text : list) {
        auto const equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            throw bad_request(what + ": write name=value or name=lower:upper, not " +
                              in_quotes(text));
        auto const name = text.substr(0, equals);
        auto const colon = text.find(':', equals);
        auto const number = [&](std::string const& digits) {
            return decimal_of(digits, what + " " + name);
        };
        auto const low = number(text.substr(
            equals + 1, colon == std::string::npos ? std::string::npos : colon - equals - 1));
        auto const high = colon == std::string::npos ? low : number(text.substr(colon + 1));
        if (high < low) throw bad_request(what + " " + name + ": lower is above upper");
        if (!result.emplace(name, *enclose(low, high)).second)
            throw bad_request(what + " " + name + " is given twice");
    }
    return result;
}

/// Whether a range is no more than the rounding of a decimal.
[[nodiscard]] inline bool is_one_value(interval const& x) {
    return width(x) <= normalised_unknowns::negligible * mag(x);
}
/// @throws bad_request
[[nodiscard]] inline double one_value(std::string const& what, interval const& range) {
    if (!is_one_value(range)) throw bad_request(what + ": one number is needed");
    return range.upper();
}

} // namespace sivid::app

#endif
