// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_NAMES_HPP
#define SIVID_APP_NAMES_HPP

#include <sivid/app/program.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/nearest_name.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::app {

/// ", did you mean 'wind'?", or nothing.
[[nodiscard]] inline std::string suggestion(std::string_view wanted,
                                            std::vector<std::string> const& known) {
    auto const name = nearest_name(wanted, known);
    return name.empty() ? std::string{} : ", did you mean " + in_quotes(name) + "?";
}

/// @throws bad_request  where a name is none of those that exist
inline void require_known(std::string const& wanted, std::vector<std::string> const& known,
                          std::string const& kind) {
    if (std::find(known.begin(), known.end(), wanted) != known.end()) return;
    throw bad_request("unknown " + kind + " " + in_quotes(wanted) + suggestion(wanted, known) +
                      "; there are: " + joined(known, ", "));
}

/// The names of things that have one.
template <class List>
[[nodiscard]] std::vector<std::string> names_in(List const& list) {
    std::vector<std::string> names;
    for (auto const& x : list) names.emplace_back(x.name);
    return names;
}

} // namespace sivid::app

#endif
