// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_MAPPING_DETAIL_CLOCK_MAPPING_READER_HPP
#define SIVID_IMPORTING_MAPPING_DETAIL_CLOCK_MAPPING_READER_HPP

#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/importing/mapping/detail/source_form_reader.hpp>
#include <sivid/io/dataset/mapping_entries.hpp>

#include <optional>
#include <utility>

namespace sivid {

/// "clock" of a further file: offset and drift, numbers or ranges, and the signal that both files
/// recorded.
/// @param there  receives that signal as the first file has it
/// @throws input_error
[[nodiscard]] inline clock_mapping read_clock_mapping(json_value const& entry,
                                                      std::optional<quantity_mapping>& there) {
    entry.allow_only({"offset", "drift", "same"});
    clock_mapping clock;
    clock.place = entry.place();
    auto const ends = [](json_value const& x) {
        if (x.type() == json_value::kind::number) return std::pair{x.number(), x.number()};
        auto const r = mapping_entries::range(x);
        return std::pair{r.lower, r.upper};
    };
    clock.offset = ends(entry.at("offset"));
    if (auto const* drift = entry.find("drift")) clock.drift = ends(*drift);
    auto const* same = entry.find("same");
    if (same == nullptr) return clock;
    bool const slow = same->find("rate") != nullptr;
    same->allow_only({"here", "there", slow ? "rate" : "level"});
    auto const recorded = [&](char const* key) {
        auto const& of = same->at(key);
        auto q = read_quantity_mapping(of, key, false);
        if (q.error.from == bound_source::kind::proposed || !q.slope.is_zero())
            of.fail("no bound of its error", "state \"error\" as a number, without \"time_error\"");
        return q;
    };
    clock.here = recorded("here");
    there = recorded("there");
    if (slow)
        clock.rate = mapping_entries::positive(same->at("rate"),
                                               "state by how much it changes a second at most");
    else
        clock.level = same->at("level").number();
    return clock;
}

} // namespace sivid

#endif
