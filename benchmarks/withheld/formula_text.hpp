// SPDX-License-Identifier: MIT
// Laws and requirements as the programs that are checked read them, evaluated once more by code
// that shares nothing with them.
#ifndef WITHHELD_FORMULA_TEXT_HPP
#define WITHHELD_FORMULA_TEXT_HPP

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace withheld {

/// The value of a name. @throws std::invalid_argument when there is none
using name_value = std::function<double(std::string const&)>;

/// + - * / ^ with whole exponents, abs sqrt exp sin cos min max clamp, during(from, to) of the time
/// t; comparisons are margins, positive where they hold: a < b is b - a, x in [a, b] and chains are
/// the least of theirs, "and" is the least, "or" the greatest.
/// @throws std::invalid_argument for anything else
double value_of(std::string_view formula, name_value const& value);

/// "W = 3 * a; delta = b" as the commanded inputs and their formulas.
std::map<std::string, std::string> commands_in(std::string_view law);

} // namespace withheld

#endif
