// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TEXT_NEAREST_NAME_HPP
#define SIVID_NUMBER_TEXT_NEAREST_NAME_HPP

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

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

/// The known name that an unknown one most likely stands for: at most a third of its letters, or
/// one, are wrong. Empty where there is none, and for words longer than names are.
/// @cost  O(length^2) for each known name
[[nodiscard]] inline std::string nearest_name(std::string_view wanted,
                                              std::vector<std::string> const& known) {
    constexpr std::size_t longest = 60;
    std::string best;
    if (wanted.size() > longest) return best;
    auto least = std::max<std::size_t>(1, wanted.size() / 3) + 1;
    for (auto const& name : known) {
        if (name.size() > longest) continue;
        auto const apart = letters_apart(wanted, name);
        if (apart >= least) continue;
        least = apart;
        best = name;
    }
    return best;
}

} // namespace sivid

#endif
