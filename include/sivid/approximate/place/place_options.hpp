// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_PLACE_OPTIONS_HPP
#define SIVID_APPROXIMATE_PLACE_PLACE_OPTIONS_HPP

#include <sivid/executor.hpp>

#include <cstddef>
#include <functional>
#include <map>
#include <string>

namespace sivid {

struct place_search_options {
    std::size_t most_sets = 80; ///< no new set is begun after so many
    double equal_score = 12;    ///< sets whose scores differ by less are equal alternatives
    double much_better = 30;    ///< by what a superset's score must be better to start from it
    /// Asked before and within every fit, by any thread; false ends the search with what was tried.
    /// May be empty.
    std::function<bool()> go_on{};
};

struct place_options {
    place_search_options search;
    /// Names of dynamic equations by their states, where they have other ones ("u" -> "surge").
    std::map<std::string, std::string> equation_names;
    executor workers{}; ///< simulate the experiments at once
};

} // namespace sivid

#endif
