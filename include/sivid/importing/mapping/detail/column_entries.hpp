// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_MAPPING_DETAIL_COLUMN_ENTRIES_HPP
#define SIVID_IMPORTING_MAPPING_DETAIL_COLUMN_ENTRIES_HPP

#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/io/dataset/mapping_entries.hpp>

#include <cstddef>
#include <string>

/// Entries of a mapping that speak of tables: columns, counters, separators.
namespace sivid::mapping_entries {

/// A heading, or the number of a column from 1.
[[nodiscard]] inline column_reference column(json_value const& entry) {
    column_reference result;
    result.place = entry.place();
    if (entry.type() == json_value::kind::number)
        result.number = whole(entry, 1, 100'000);
    else
        result.heading = entry.string();
    return result;
}

/// Bits of a counter that wraps.
[[nodiscard]] inline unsigned counter_bits(json_value const& entry) {
    return static_cast<unsigned>(whole(entry, 8, 48));
}

/// A text of one character.
[[nodiscard]] inline char character(json_value const& entry, std::string const& allowed,
                                    char const* remedy) {
    auto const& text = entry.raw_string();
    if (text.size() != 1 || allowed.find(text.front()) == std::string::npos)
        entry.fail(text_of("found ", in_quotes(text)), remedy);
    return text.front();
}

} // namespace sivid::mapping_entries

#endif
