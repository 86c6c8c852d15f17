// SPDX-License-Identifier: MIT
// Constants on the command line: Ff=0.5 or Ff=0.3:0.7.
#ifndef EXAMPLES_CONSOLE_PARAMETER_RANGES_HPP
#define EXAMPLES_CONSOLE_PARAMETER_RANGES_HPP

#include <sivid/enclosure/normalised_unknowns.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/exact_decimal.hpp>

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace console {

/// "name=value" or "name=lower:upper", in decimals, read outward.
/// @throws std::invalid_argument
inline std::map<std::string, sivid::interval> ranges_from(std::vector<std::string> const& list,
                                                          std::string const& what) {
    std::map<std::string, sivid::interval> result;
    for (auto const& text : list) {
        auto const equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            throw std::invalid_argument(what + ": write name=value or name=lower:upper, not " +
                                        sivid::in_quotes(text));
        auto const name = text.substr(0, equals);
        auto const colon = text.find(':', equals);
        auto const number = [&](std::string const& digits) {
            auto const value = sivid::exact_decimal::parse(digits);
            if (!value || !sivid::enclose(*value))
                throw std::invalid_argument(what + " " + name + ": " + sivid::in_quotes(digits) +
                                            " is not a decimal number");
            return *value;
        };
        auto const low = number(text.substr(
            equals + 1, colon == std::string::npos ? std::string::npos : colon - equals - 1));
        auto const high = colon == std::string::npos ? low : number(text.substr(colon + 1));
        if (high < low) throw std::invalid_argument(what + " " + name + ": lower is above upper");
        if (!result.emplace(name, *sivid::enclose(low, high)).second)
            throw std::invalid_argument(what + " " + name + " is given twice");
    }
    return result;
}

/// Whether a range is no more than the rounding of a decimal.
[[nodiscard]] inline bool is_one_value(sivid::interval const& x) {
    return width(x) <= sivid::normalised_unknowns::negligible * mag(x);
}
/// @throws std::invalid_argument
[[nodiscard]] inline double one_value(std::string const& what, sivid::interval const& range) {
    if (!is_one_value(range)) throw std::invalid_argument(what + ": one number is needed");
    return range.upper();
}

} // namespace console

#endif
