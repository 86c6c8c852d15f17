// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_MAPPING_DETAIL_WINDOW_MAPPING_READER_HPP
#define SIVID_IMPORTING_MAPPING_DETAIL_WINDOW_MAPPING_READER_HPP

#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/importing/mapping/detail/source_form_reader.hpp>
#include <sivid/io/dataset/mapping_entries.hpp>
#include <sivid/io/dataset/stated_unit.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Whether a start is left to the import: "propose", the only word that it may be.
[[nodiscard]] inline bool proposes_start(json_value const& entry) {
    if (entry.type() != json_value::kind::string) return false;
    if (entry.string() != "propose")
        entry.fail(text_of("found ", in_quotes(entry.string())),
                   "write \"propose\" or a range [lower, upper]");
    return true;
}

/// The start of a state as a channel of its name shows it.
[[nodiscard]] inline mapped_start proposed_start(std::string const& name, json_value const& entry) {
    mapped_start start;
    start.name = start.channel = name;
    start.from = mapped_start::kind::value;
    start.bounded = false;
    start.place = entry.place();
    return start;
}

[[nodiscard]] inline mapped_start read_start(std::string const& name, json_value const& entry) {
    using kind = mapped_start::kind;
    auto start = proposed_start(name, entry);
    bool const object = entry.type() == json_value::kind::object;
    if (object && entry.find("range") != nullptr) {
        entry.allow_only({"range", "unit"});
        start.from = kind::stated;
        start.bounded = true;
        start.range = mapping_entries::range(entry.at("range"));
        if (auto const* unit = entry.find("unit")) {
            (void)read_unit(*unit);
            start.unit = unit->any_string();
        }
    } else if (object) {
        bool const rate = entry.find("rate_of") != nullptr;
        bool const jerk = rate && entry.find("acceleration") == nullptr;
        if (rate) entry.allow_only({"rate_of", jerk ? "jerk" : "acceleration", "within"});
        if (!rate) entry.allow_only({"channel", "rate"});
        start.from = rate ? kind::rate : kind::value;
        start.degree = jerk ? 2 : 1;
        start.channel = entry.at(rate ? "rate_of" : "channel").string();
        if (auto const* within = entry.find("within"))
            start.within = mapping_entries::positive(*within, "state it in seconds");
        if (auto const* bound = entry.find(!rate ? "rate" : jerk ? "jerk" : "acceleration")) {
            start.bounded = true;
            start.range = mapping_entries::symmetric_range(*bound);
        }
    } else if (!proposes_start(entry)) {
        start.from = kind::stated;
        start.bounded = true;
        start.range = mapping_entries::range(entry);
    }
    return start;
}

/// "initial": "propose", or for each state a range, {"range": ..., "unit": ...}, "propose",
/// {"channel": ...} or {"rate_of": ...}.
/// @param channels  those of the scenario; "propose" alone means a state for each
/// @throws input_error
[[nodiscard]] inline std::vector<mapped_start>
read_starts(json_value const& list, std::vector<quantity_mapping> const& channels) {
    using kind = mapped_start::kind;
    std::vector<mapped_start> result;
    if (proposes_start(list)) {
        for (auto const& q : channels) result.push_back(proposed_start(q.name, list));
        return result;
    }
    for (std::size_t i = 0; i < list.members().size(); ++i) {
        auto const& entry = list.members()[i];
        auto start = read_start(mapping_entries::name(entry, list.name_of(i)), entry);
        if (start.from != kind::stated &&
            std::none_of(channels.begin(), channels.end(),
                         [&](auto const& q) { return q.name == start.channel; }))
            entry.fail(text_of("no channel ", in_quotes(start.channel), " is mapped that shows ",
                               start.from == kind::rate ? "what " : "", in_quotes(start.name),
                               start.from == kind::rate ? " is the rate of" : ""),
                       "state its box [lower, upper]; for the rate of what a channel shows write "
                       "{\"rate_of\": CHANNEL, \"acceleration\": its largest change a second}");
        result.push_back(std::move(start));
    }
    return result;
}

/// "windows": length, every, first, count, holdout, the rows they are cut of, and the starts.
/// @throws input_error
[[nodiscard]] inline window_mapping
read_window_mapping(json_value const& entry, std::vector<quantity_mapping> const& channels) {
    constexpr std::size_t most = 100'000;
    entry.allow_only({"length", "every", "first", "count", "holdout", "initial", "while"});
    window_mapping w;
    w.place = entry.place();
    w.length = mapping_entries::positive(entry.at("length"), "state it in seconds");
    w.every = w.length;
    if (auto const* every = entry.find("every")) {
        w.every = mapping_entries::positive(*every, "state it in seconds");
        if (w.every < w.length)
            every->fail("windows that overlap would count their common measurements twice",
                        "state at least the length");
    }
    if (auto const* first = entry.find("first")) {
        w.first = first->number();
        if (w.first.is_negative()) first->fail("before t = 0", "state 0 or later, in seconds");
    }
    if (auto const* count = entry.find("count")) w.most = mapping_entries::whole(*count, 1, most);
    if (auto const* holdout = entry.find("holdout")) {
        if (holdout->type() == json_value::kind::array)
            for (auto const& number : holdout->elements())
                w.holdout.push_back(mapping_entries::whole(number, 1, most));
        else
            w.holdout_every = mapping_entries::whole(*holdout, 2, most);
    }
    if (auto const* rows = entry.find("while")) {
        rows->allow_only({"column", "within"});
        auto const within = mapping_entries::range(rows->at("within"));
        w.rows = {mapping_entries::column(rows->at("column")), {within.lower, within.upper}};
    }
    if (auto const* initial = entry.find("initial")) w.initial = read_starts(*initial, channels);
    return w;
}

} // namespace sivid

#endif // SIVID_IMPORTING_MAPPING_DETAIL_WINDOW_MAPPING_READER_HPP
