// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_MAPPING_ENTRIES_HPP
#define SIVID_IO_DATASET_MAPPING_ENTRIES_HPP

#include <sivid/io/dataset/model_names.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/number/text/joined.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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
/// @param what  it is, for messages
[[nodiscard]] inline std::pair<exact_decimal, exact_decimal> ends(json_value const& entry,
                                                                  std::string_view what = "range") {
    auto const& all = entry.elements();
    if (all.size() != 2)
        entry.fail(
            text_of("the ", what, " has ", std::to_string(all.size()), " numbers instead of 2"),
            "write [lower, upper]");
    std::pair const result{all[0].number(), all[1].number()};
    if (result.second < result.first)
        entry.fail(text_of("lower is above upper: the ", what, " [", result.first.text(), ", ",
                           result.second.text(), "] is empty"),
                   "write [lower, upper]");
    return result;
}

/// The same, of what is physically possible.
[[nodiscard]] inline stated_range range(json_value const& entry, std::string_view what = "range") {
    auto const [lower, upper] = ends(entry, what);
    auto const enclosure = enclose(lower, upper);
    if (!enclosure || mag(*enclosure) > farthest_range)
        entry.fail(
            text_of("the ", what, " [", lower.text(), ", ", upper.text(), "] reaches beyond 1e100"),
            "state what is physically possible");
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

/// A duration.
[[nodiscard]] inline exact_decimal duration(json_value const& entry) {
    auto const x = entry.number();
    if (!(*nearest(x) > 0)) entry.fail("the duration is not above 0", "state how long it lasts");
    return x;
}

/// The share of measurements that may violate their bounds.
[[nodiscard]] inline exact_decimal outlier_fraction(json_value const& entry) {
    auto const x = entry.number();
    if (x.is_negative() || !(x < *exact_decimal::parse("1")))
        entry.fail(text_of("the fraction ", x.text(), " is outside [0, 1)"),
                   "state the share of outliers, such as 0.05");
    return x;
}

/// The name of a scenario, which files bear.
[[nodiscard]] inline std::string file_name(json_value const& entry) {
    auto const& text = entry.string();
    if (text.find_first_of("/\\") != std::string::npos || text.front() == '.')
        entry.fail(text_of("the name ", in_quotes(text), " cannot be a file name"),
                   "use letters, digits, - and _");
    return text;
}

/// The index of a quantity of the model.
/// @param what  it is, for messages
[[nodiscard]] inline std::size_t index_of(std::vector<name_unit> const& list,
                                          std::string const& name, json_value const& entry,
                                          std::string_view what) {
    auto const index = sivid::index_of(list, name);
    if (!index)
        entry.fail(text_of("unknown ", what, " ", in_quotes(name)),
                   text_of("the model has: ", joined_names(list)));
    return *index;
}

/// Refuses a file of another format: it may have other keys.
inline void require_format(json_value const& root, std::string const& format) {
    auto const& own = root.at("format");
    if (own.string() != format)
        own.fail(text_of("unknown format ", in_quotes(own.string())),
                 "this version reads " + format);
}

} // namespace sivid::mapping_entries

#endif // SIVID_IO_DATASET_MAPPING_ENTRIES_HPP
