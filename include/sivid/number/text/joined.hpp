// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TEXT_JOINED_HPP
#define SIVID_NUMBER_TEXT_JOINED_HPP

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

/// "a, b, c": the texts of a list one after the other, a separator between any two.
/// @param text  of an entry: a function of it or a member; the entry itself by default
template <class List, class Text = std::identity>
[[nodiscard]] std::string joined(List const& list, std::string_view separator = ", ",
                                 Text const& text = {}) {
    std::string all;
    bool first = true;
    for (auto const& entry : list) {
        if (!first) all += separator;
        all += std::invoke(text, entry);
        first = false;
    }
    return all;
}

/// The same of the entries' names.
template <class List>
[[nodiscard]] std::string joined_names(List const& list, std::string_view separator = ", ") {
    return joined(list, separator, [](auto const& entry) { return entry.name; });
}

/// "a, b and c"
[[nodiscard]] inline std::string enumeration(std::vector<std::string> const& all,
                                             std::string_view last = " and ") {
    std::string out;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i > 0) out += i + 1 == all.size() ? last : ", ";
        out += all[i];
    }
    return out;
}

} // namespace sivid

#endif
