// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_MAPPING_ENTRIES_HPP
#define SIVID_IO_DATASET_MAPPING_ENTRIES_HPP

#include <sivid/io/dataset_value.hpp>
#include <sivid/io/text/json_document.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

/// The small entries of a mapping or a data set: names, ranges, counts. Each either gives what
/// it says or throws input_error with the entry's pointer.
namespace sivid::mapping_entries {

/// A name that can head a column of a table and be part of a file name.
[[nodiscard]] inline std::string name(json_value const& entry, std::string const& text) {
    auto const plain = [](char c) {
        auto const byte = static_cast<unsigned char>(c);
        return (byte >= '0' && byte <= '9') || (byte >= 'A' && byte <= 'Z') ||
               (byte >= 'a' && byte <= 'z') || byte == '_' || byte == '-' || byte == '.' ||
               byte >= 0x80;
    };
    if (text.empty() || text.size() > 100 || text.front() == '.' || text == "t" ||
        !std::all_of(text.begin(), text.end(), plain))
        entry.fail(text_of("the name ", in_quotes(text), " cannot stand in a table"),
                   "use letters, digits, - and _, at most 100, and not just t");
    return text;
}

/// [lower, upper] with lower <= upper.
[[nodiscard]] inline stated_range range(json_value const& entry) {
    auto const& ends = entry.elements();
    if (ends.size() != 2) entry.fail("not two numbers", "write [lower, upper]");
    auto const lower = ends[0].number(), upper = ends[1].number();
    if (upper < lower) entry.fail("lower is above upper", "write [lower, upper]");
    auto const enclosure = enclose(lower, upper);
    if (!enclosure || mag(*enclosure) > farthest_range)
        entry.fail("the range reaches beyond 1e100", "state what is physically possible");
    return {lower, upper, *enclosure};
}

/// [lower, upper], or for one number m >= 0 [-m, m].
[[nodiscard]] inline stated_range symmetric_range(json_value const& entry) {
    if (entry.type() != json_value::kind::number) return range(entry);
    auto const most = entry.number();
    auto const enclosure = most.is_negative() ? std::nullopt : enclose(-most, most);
    if (!enclosure || mag(*enclosure) > farthest_range)
        entry.fail("no number from 0 to 1e100", "write the largest magnitude, or [lower, upper]");
    return {-most, most, *enclosure};
}

/// A whole number from `least` to `most`.
[[nodiscard]] inline std::size_t whole(json_value const& entry, std::size_t least,
                                       std::size_t most) {
    auto const x = entry.number();
    auto const n = x.whole();
    if (!n || *n < least || most < *n)
        entry.fail(text_of(x.text(), " is no whole number from ", std::to_string(least), " to ",
                           std::to_string(most)),
                   "correct it");
    return *n;
}

/// A decimal above 0.
[[nodiscard]] inline exact_decimal positive(json_value const& entry, char const* remedy) {
    auto const x = entry.number();
    if (!x.is_positive() || !(*nearest(x) > 0)) entry.fail("not above 0", remedy);
    return x;
}

} // namespace sivid::mapping_entries

#endif // SIVID_IO_DATASET_MAPPING_ENTRIES_HPP
