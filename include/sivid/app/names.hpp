// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_NAMES_HPP
#define SIVID_APP_NAMES_HPP

#include <sivid/app/program.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/number/text/joined.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::app {

/// How many letters have to be put in, left out, replaced or interchanged with their neighbour to
/// make one word of another.
[[nodiscard]] inline std::size_t letters_apart(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = std::min(now[j], before[j - 2] + 1);
        }
        before = std::exchange(last, now);
    }
    return last.back();
}

/// The known name that an unknown one most likely stands for: at most a third of its letters are
/// wrong. Empty where there is none.
[[nodiscard]] inline std::string nearest_name(std::string_view wanted,
                                              std::vector<std::string> const& known) {
    std::string best;
    auto least = std::max<std::size_t>(1, wanted.size() / 3) + 1;
    for (auto const& name : known) {
        auto const apart = letters_apart(wanted, name);
        if (apart >= least) continue;
        least = apart;
        best = name;
    }
    return best;
}

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
