// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_MAPPING_DETAIL_SOURCE_FORM_READER_HPP
#define SIVID_IMPORTING_MAPPING_DETAIL_SOURCE_FORM_READER_HPP

#include <sivid/importing/detail/import_mapping.hpp>
#include <sivid/io/dataset/mapping_entries.hpp>
#include <sivid/io/dataset/stated_unit.hpp>
#include <sivid/model/unit.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {
namespace mapping_entries {

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

/// A column, or {"formula": "65536*hi + lo", "columns": {"hi": "CH 1", "lo": 3}}.
inline void read_column(json_value const& entry, quantity_mapping& q) {
    if (entry.type() != json_value::kind::object) {
        q.columns = {column(entry)};
        return;
    }
    entry.allow_only({"formula", "columns"});
    auto const& text = entry.at("formula");
    q.formula.emplace(text.string(), [&](std::size_t position, std::string const& problem,
                                         std::string const& remedy) {
        text.fail(text_of("character ", std::to_string(position + 1), ": ", problem), remedy);
    });
    auto const& names = q.formula->names();
    auto const* stated = entry.find("columns");
    q.columns.clear();
    for (auto const& name : names) {
        auto const* of = stated != nullptr ? stated->find(name) : nullptr;
        q.columns.push_back(of != nullptr ? column(*of) : column_reference{name, 0, text.place()});
    }
    for (std::size_t i = 0; stated != nullptr && i < stated->members().size(); ++i)
        if (std::find(names.begin(), names.end(), stated->name_of(i)) == names.end())
            stated->members()[i].fail(text_of("the formula has no ", in_quotes(stated->name_of(i))),
                                      "leave it out");
}

/// Bits of a register, or of a counter that wraps.
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

} // namespace mapping_entries

/// "lines": "all", or {"column": ..., "is": text or texts}: which lines count.
/// @throws input_error
[[nodiscard]] inline line_choice read_line_choice(json_value const& entry) {
    using kind = json_value::kind;
    line_choice result;
    if (entry.type() == kind::string) {
        result.all = true;
        if (entry.string() != "all")
            entry.fail(text_of("found ", in_quotes(entry.string())),
                       "write \"all\" or {\"column\": ..., \"is\": ...}");
        return result;
    }
    entry.allow_only({"column", "is"});
    result.column = mapping_entries::column(entry.at("column"));
    auto const add = [&](json_value const& text) {
        result.is.push_back(text.type() == kind::number ? text.number().text() : text.string());
    };
    auto const& is = entry.at("is");
    if (is.type() != kind::array) {
        add(is);
        return result;
    }
    for (auto const& text : is.elements()) add(text);
    if (result.is.empty()) is.fail("no text", "state at least one");
    return result;
}

/// "same_time": of readings at one time that differ.
/// @throws input_error
[[nodiscard]] inline same_time read_same_time(json_value const& entry) {
    for (auto const& [word, meaning] : {std::pair{"refuse", same_time::refuse},
                                        {"first", same_time::first},
                                        {"last", same_time::last}})
        if (entry.string() == word) return meaning;
    entry.fail(text_of("found ", in_quotes(entry.string())), "write refuse, first or last");
}

/// What a log has beyond a table: fields, the longest gap, check sums, and what happens at breaks.
/// @throws input_error
inline void read_serial_form(json_value const& entry, source_form& form) {
    using namespace mapping_entries;
    for (auto const& f : entry.at("fields").elements()) {
        auto const& name = f.string();
        for (auto const& other : form.fields)
            if (other == name && name != "_")
                f.fail(text_of("the field ", in_quotes(name), " appears twice"), "rename one");
        form.fields.push_back(name);
    }
    if (form.fields.empty()) entry.at("fields").fail("no field", "name what a line holds");
    form.longest_gap = positive(entry.at("longest_gap"),
                                "state the longest usual time between two lines in seconds");
    if (auto const* sum = entry.find("check_sum"))
        form.check_sums = sum->is_second_of("none", "crc16");
    auto const policy = [&](char const* key, char const* other, break_policy meaning) {
        auto const* found = entry.find(key);
        if (found == nullptr || found->string() == "refuse") return break_policy::refuse;
        if (found->string() == "split") return break_policy::split;
        if (found->string() == other) return meaning;
        found->fail(text_of("found ", in_quotes(found->string())),
                    text_of("write refuse, split or ", other));
    };
    form.gap = policy("gap", "keep", break_policy::keep);
    form.restart = policy("restart", "drop", break_policy::drop);
}

/// "source": separators, missing readings, fields, and what happens where a log breaks.
/// @throws input_error
[[nodiscard]] inline source_form read_source_form(json_value const& entry) {
    using namespace mapping_entries;
    source_form form;
    auto const* kind = entry.find("kind");
    if (kind != nullptr && kind->string() == "matlab") {
        entry.allow_only({"kind", "same_time"});
        form.from = source_form::kind::matlab;
        if (auto const* s = entry.find("same_time")) form.doubled = read_same_time(*s);
        return form;
    }
    if (kind != nullptr && kind->string() != "csv" && kind->string() != "serial")
        kind->fail(text_of("found ", in_quotes(kind->string())), "write csv, serial or matlab");
    bool const serial = kind != nullptr && kind->string() == "serial";
    form.from = serial ? source_form::kind::serial : source_form::kind::csv;
    if (serial)
        entry.allow_only({"kind", "separator", "decimal", "missing", "fields", "longest_gap", "gap",
                          "restart", "check_sum", "lines", "same_time"});
    else
        entry.allow_only({"kind", "separator", "decimal", "missing", "skip_lines", "heading",
                          "skip_after_heading", "short_lines", "lines", "same_time"});
    if (auto const* s = entry.find("separator"))
        form.separator =
            character(*s, ",;\t |:", "write \",\", \";\", \"\\t\", \"|\", \":\" or \" \" (blanks)");
    if (auto const* d = entry.find("decimal"))
        form.decimal = character(*d, ".,", "write \".\" or \",\"");
    if (form.decimal == form.separator)
        entry.fail("the decimal mark is the separator",
                   "state a \"separator\" that differs from \"decimal\"");
    if (auto const* missing = entry.find("missing"))
        for (auto const& m : missing->elements()) form.missing.push_back(m.string());
    if (auto const* l = entry.find("lines")) form.lines = read_line_choice(*l);
    if (auto const* s = entry.find("same_time")) form.doubled = read_same_time(*s);
    if (!serial) {
        if (auto const* s = entry.find("short_lines"))
            form.short_lines = s->is_second_of("refuse", "missing");
        if (auto const* n = entry.find("skip_lines")) form.skip_lines = whole(*n, 0, 1'000'000);
        if (auto const* n = entry.find("skip_after_heading"))
            form.skip_after_heading = whole(*n, 0, 1'000'000);
        if (auto const* h = entry.find("heading")) form.heading = h->boolean();
        if (form.heading == false && form.skip_after_heading > 0)
            entry.at("skip_after_heading")
                .fail("there is no heading", "count these lines under \"skip_lines\"");
        return form;
    }
    read_serial_form(entry, form);
    return form;
}

/// "time": column with unit and offset, or sample time, and the counter's bits.
/// @throws input_error
[[nodiscard]] inline time_mapping read_time_mapping(json_value const& entry, bool serial) {
    entry.allow_only({"column", "sample_time", "unit", "offset", "counter_bits"});
    time_mapping time;
    auto const* step = entry.find("sample_time");
    if (step == nullptr) {
        time.column = mapping_entries::column(entry.at("column"));
        (void)entry.at("unit"); // of a sample time both may be left out
        (void)entry.at("offset");
    } else {
        if (serial)
            step->fail("a log that may lose lines has no constant step",
                       "name the \"column\" of the time stamps");
        if (auto const* column = entry.find("column"))
            column->fail("a column and a sample time", "keep one of the two");
        time.sample_time = mapping_entries::positive(*step, "state the time from row to row");
    }
    if (auto const* unit = entry.find("unit")) {
        time.unit = unit->string();
        if (step == nullptr && (time.unit == "iso8601" || time.unit == "hh:mm:ss")) {
            time.form = time.unit == "iso8601" ? time_form::date : time_form::clock;
            time.unit = "s";
        }
        auto const ratio = sivid::unit(time.unit).in(sivid::unit("s"));
        if (auto const factor = ratio ? unit_conversion::of(*ratio) : std::nullopt;
            factor && factor->divisor == 1 && factor->factor_is_exact())
            time.to_seconds = *factor;
        else
            unit->fail(
                text_of("unknown unit ", in_quotes(time.unit)),
                "write s, ms, us, ns, min, h or d, or for a column of texts iso8601 or hh:mm:ss");
    }
    if (auto const* bits = entry.find("counter_bits")) {
        if (!serial) bits->fail("a counter in a table", "counters that wrap need a serial source");
        if (time.form != time_form::number)
            bits->fail("a counter of texts", "leave it out: a clock begins again at midnight");
        time.counter_bits = mapping_entries::counter_bits(*bits);
    }
    auto const* offset = entry.find("offset");
    if (offset == nullptr) return time; // of a sample time: the first row is at 0
    if (offset->type() == json_value::kind::string) {
        if (offset->string() != "first")
            offset->fail(text_of("found ", in_quotes(offset->string())),
                         "write \"first\" or a number in seconds");
        time.from_first = true;
    } else {
        time.offset = offset->number();
    }
    return time;
}

/// "bridge": the longest time without a sample of an input, or with a bound of what it does there.
/// @throws input_error
inline void read_bridge(json_value const& entry, quantity_mapping& q) {
    using namespace mapping_entries;
    constexpr auto remedy = "state the longest time from a reading to the next one in seconds";
    if (entry.type() == json_value::kind::number) {
        q.bridge = positive(entry, remedy);
        return;
    }
    entry.allow_only({"longest", "error"});
    q.bridge = positive(entry.at("longest"), remedy);
    q.bridge_error = positive(entry.at("error"), "state how far it may be from what stands there");
}

/// "error" of an input or a channel, and of an input what may be missing.
/// @throws input_error
inline void read_bound(json_value const& entry, bool input, quantity_mapping& q) {
    using namespace mapping_entries;
    auto const* error = entry.find("error");
    if (auto const* b = entry.find("bridge")) {
        if (!input) b->fail("a channel is measured where it has readings alone", "remove this key");
        read_bridge(*b, q);
        if (q.bridge_error && error == nullptr)
            b->fail("a bound of what is missing in an input that is exact elsewhere",
                    "state the \"error\" of its readings as well");
    }
    if (error == nullptr) {
        if (!input) (void)entry.at("error"); // says that it is missing
        if (!q.conversion.factor_is_exact())
            entry.fail("an exact input with an uncertain factor",
                       "state an \"error\"; the factor's share is added to it");
        if (q.period && !(q.period->first == q.period->second))
            entry.fail("an exact input with an uncertain period",
                       "state an \"error\"; the period's share is added to it");
        return;
    }
    q.error.place = error->place();
    if (error->type() == json_value::kind::object) {
        error->allow_only({"column"});
        q.error.from = bound_source::kind::column;
        q.error.column = column(error->at("column"));
    } else if (error->type() == json_value::kind::string) {
        if (error->string() != "propose")
            error->fail(text_of("found ", in_quotes(error->string())),
                        "write a number, {\"column\": ...} or \"propose\"");
        q.error.from = bound_source::kind::proposed;
    } else {
        q.error.from = bound_source::kind::number;
        q.error.number = positive(*error, "a bound of an instrument is positive");
    }
}

/// "time_error" and "model_error" of a channel.
/// @throws input_error
inline void read_further_errors(json_value const& entry, bool input, quantity_mapping& q) {
    using namespace mapping_entries;
    for (auto const* key : {"time_error", "model_error"})
        if (auto const* e = entry.find(key); e != nullptr && input)
            e->fail("an input is within its \"error\" at every time", "put it into \"error\"");
    if (auto const* m = entry.find("model_error"))
        q.model_error = positive(*m, "state how far off the model may be, in the channel's unit");
    auto const* e = entry.find("time_error");
    if (e == nullptr) return;
    e->allow_only({"within", "rate", "acceleration"});
    if (auto const* within = e->find("within")) // a further file's clock may say it
        q.clock = positive(*within, "state how far off a time may be, in seconds");
    q.curved = e->find("rate") == nullptr;
    if (!q.curved && e->find("acceleration") != nullptr)
        e->fail("\"rate\" and \"acceleration\"", "state one of them");
    q.slope = positive(e->at(q.curved ? "acceleration" : "rate"), "state the largest one");
    if (q.curved && q.error.from == bound_source::kind::proposed)
        e->fail("slopes are bounded by readings whose bound is not known yet",
                "state \"rate\", or \"error\" as a number");
}

/// An entry of "inputs" or "channels".
/// @throws input_error
[[nodiscard]] inline quantity_mapping read_quantity_mapping(json_value const& entry,
                                                            std::string const& name, bool input) {
    using namespace mapping_entries;
    entry.allow_only({"column", "unit", "factor", "divisor", "offset", "counter_bits",
                      "signed_bits", "period", "range", "error", "bridge", "time_error",
                      "model_error"});
    quantity_mapping q;
    q.place = entry.place();
    q.name = mapping_entries::name(entry, name);
    read_column(entry.at("column"), q);
    if (auto const* unit = entry.find("unit")) {
        q.unit = unit->any_string();
        (void)read_unit(*unit);
    }
    if (auto const* factor = entry.find("factor")) {
        if (factor->type() == json_value::kind::array) {
            auto const r = range(*factor);
            q.conversion.factor_lower = r.lower;
            q.conversion.factor_upper = r.upper;
        } else {
            q.conversion.factor_lower = q.conversion.factor_upper = factor->number();
        }
        if (!q.conversion.factor_lower.is_positive() && !q.conversion.factor_upper.is_negative())
            factor->fail("the factor may be 0", "a reading times 0 says nothing");
    }
    if (auto const* d = entry.find("divisor"))
        q.conversion.divisor = whole(*d, 1, unit_conversion::largest_divisor);
    if (auto const* o = entry.find("offset")) q.conversion.offset = o->number();
    if (auto const* b = entry.find("counter_bits"))
        q.counter_bits = mapping_entries::counter_bits(*b);
    if (auto const* b = entry.find("signed_bits")) {
        if (q.counter_bits) b->fail("a counter wraps, whatever its sign", "keep \"counter_bits\"");
        q.signed_bits = mapping_entries::counter_bits(*b);
    }
    if (auto const* p = entry.find("period")) {
        if (q.counter_bits)
            p->fail("a counter wraps by its bits", "state \"counter_bits\" or \"period\"");
        if (p->type() == json_value::kind::array) {
            auto const r = range(*p);
            q.period.emplace(r.lower, r.upper);
        } else {
            q.period.emplace(p->number(), p->number());
        }
        if (!q.period->first.is_positive() || !enclose(q.period->second))
            p->fail("the period is not above 0 and finite", "state it in the unit of the readings");
    }
    if (auto const* r = entry.find("range")) {
        auto const ends = range(*r);
        q.range.emplace(ends.lower, ends.upper);
    }
    read_bound(entry, input, q);
    read_further_errors(entry, input, q);
    return q;
}

} // namespace sivid

#endif // SIVID_IMPORTING_MAPPING_DETAIL_SOURCE_FORM_READER_HPP
