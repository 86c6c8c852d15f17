// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_NUMBER_RANGE_HPP
#define SIVID_APP_DETAIL_NUMBER_RANGE_HPP

#include <CLI/CLI.hpp>

#include <sstream>
#include <string>

namespace sivid::app {

/// Checks that an option is a number from `least` to `most`; unlike CLI11's own range it refuses
/// nan.
inline CLI::Validator number_between(double least, double most) {
    std::ostringstream range;
    range << least << " to " << most;
    return {[least, most, words = range.str()](std::string const& text) {
                double value = 0;
                bool const fits =
                    CLI::detail::lexical_cast(text, value) && least <= value && value <= most;
                return fits ? std::string{} : text + " is not a number from " + words;
            },
            range.str(), "number_between"};
}

/// For the name of a folder that need not be given: an empty one is none.
inline CLI::Validator folder_name() {
    return {[](std::string const& text) {
                return text.empty() ? std::string{"--out is empty: give a folder for the results"}
                                    : std::string{};
            },
            "", "folder_name"};
}

} // namespace sivid::app

#endif
