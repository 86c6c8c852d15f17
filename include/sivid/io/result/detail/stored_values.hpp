// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RESULT_DETAIL_STORED_VALUES_HPP
#define SIVID_IO_RESULT_DETAIL_STORED_VALUES_HPP

#include <sivid/io/dataset/mapping_entries.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/number/interval.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

/// How results state their values: read by those who check them.
namespace sivid::io_detail {

/// A range, rounded outward; empty for null, without an end where that is null.
inline interval outward(json_value const& entry) {
    if (entry.type() == json_value::kind::null) return interval_traits<interval>::empty();
    auto const& ends = entry.elements();
    if (ends.size() != 2) entry.fail("not a pair of bounds", "write [lower, upper]");
    auto const end = [](json_value const& e, double none) {
        if (e.type() == json_value::kind::null)
            return none < 0 ? interval_traits<interval>::bounds(-HUGE_VAL, 0)
                            : interval_traits<interval>::bounds(0, HUGE_VAL);
        return *enclose(e.number());
    };
    auto const low = end(ends[0], -1), high = end(ends[1], 1);
    if (low.lower() > high.upper()) entry.fail("lower is above upper", "write [lower, upper]");
    return interval_traits<interval>::bounds(low.lower(), high.upper());
}

inline std::size_t count(json_value const& entry) {
    auto const x = entry.number();
    auto const value = x.whole();
    if (!value) entry.fail(x.text() + " is no count", "write a whole number from 0 to 1e18");
    return *value;
}
inline double nearest_number(json_value const& entry) { return *nearest(entry.number()); }

/// The members of an object by their names, as `of` reads each.
template <class Of>
auto by_name(json_value const& object, Of const& of) {
    std::map<std::string, std::remove_cvref_t<std::invoke_result_t<Of, json_value const&>>> all;
    for (std::size_t k = 0; k < object.members().size(); ++k)
        all[object.name_of(k)] = std::invoke(of, object.members()[k]);
    return all;
}

template <class Word>
Word one_of(json_value const& entry, std::initializer_list<Word> words) {
    for (auto const w : words)
        if (entry.string() == to_string(w)) return w;
    entry.fail(text_of("unknown word ", in_quotes(entry.string())), "see the format");
}

/// [lower, upper], the very doubles.
inline interval exact_ends(json_value const& side) {
    auto const [low, high] = mapping_entries::ends(side);
    return interval_traits<interval>::bounds(*nearest(low), *nearest(high));
}

inline std::vector<std::string> texts(json_value const& list) {
    std::vector<std::string> all;
    for (auto const& text : list.elements()) all.push_back(text.any_string());
    return all;
}

/// The text of each number and word of a value, and how many entries lists have, by place.
inline void spell_out(json_value const& value, std::map<std::string, std::string>& all) {
    using kind = json_value::kind;
    auto& text = all[value.place().pointer];
    auto const children = [&](std::vector<json_value> const& list) {
        text = std::to_string(list.size()) + " entries";
        for (auto const& child : list) spell_out(child, all);
    };
    switch (value.type()) {
    case kind::null:
        text = "null";
        break;
    case kind::boolean:
        text = value.boolean() ? "true" : "false";
        break;
    case kind::number:
        text = value.number().text();
        break;
    case kind::string:
        text = value.raw_string();
        break;
    case kind::array:
        children(value.elements());
        break;
    case kind::object:
        children(value.members());
        break;
    }
}

/// The members of a result that follow from its boxes, its witness and the problem.
inline std::map<std::string, std::string> what_follows(json_value const& root) {
    std::map<std::string, std::string> all;
    for (auto const* const name : {"problem", "time_unit", "verdict", "verdict_rests_on", "files",
                                   "parameters", "combinations", "volume", "rows", "products",
                                   "assumptions", "identifiability", "outputs"})
        if (auto const* const member = root.find(name)) spell_out(*member, all);
    return all;
}

} // namespace sivid::io_detail

#endif
