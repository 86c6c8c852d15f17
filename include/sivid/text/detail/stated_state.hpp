// SPDX-License-Identifier: MIT
#ifndef SIVID_TEXT_DETAIL_STATED_STATE_HPP
#define SIVID_TEXT_DETAIL_STATED_STATE_HPP

#include <sivid/io/dataset/unit_conversion.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/text/detail/formula_value.hpp>
#include <sivid/text/detail/toml_section.hpp>

#include <optional>
#include <string>
#include <utility>

namespace sivid::text_detail {

[[nodiscard]] inline unit unit_in(model_source const& source, toml_section::entry const& e,
                                  std::string const& text) {
    unit const u(text);
    if (!u.fault().empty())
        source.fail(e.value, "this is no unit: " + u.fault(),
                    "write one as in \"kg m^2/s\", \"1\" for none");
    return u;
}
/// The unit that a table states: its text and itself; nothing where there is none.
[[nodiscard]] inline std::optional<std::string> stated_unit(model_source const& source,
                                                            toml_section const& of) {
    auto const* e = of.find("unit");
    if (e == nullptr) return std::nullopt;
    auto const text = std::string(of.string_of(*e));
    (void)unit_in(source, *e, text);
    return text;
}

/// Decimals that a stated quantity lies between, in a unit.
[[nodiscard]] inline std::pair<exact_decimal, exact_decimal> bounds_in(model_source const& source,
                                                                       stated_quantity const& q,
                                                                       std::string const& to,
                                                                       std::string const& what) {
    auto const ratio = q.in ? q.in->in(unit(to)) : unit::ratio{};
    auto const c = ratio ? unit_conversion::of(*ratio) : std::nullopt;
    if (!c)
        source.fail(q.position,
                    what + " has the unit " + unit_words(unit(to)) + ", and this is in " +
                        unit_words(*q.in),
                    "write it in another unit");
    if (ratio->is_one()) return {q.lower, q.upper};
    auto const r = (*c)(q.lower, q.upper);
    if (!r) source.fail(q.position, "the number is beyond all doubles", "use another unit");
    return {r->value - r->rounding, r->value + r->rounding};
}

/// A stated quantity in a unit: its bounds rounded outward, and its middle.
[[nodiscard]] inline literal converted(model_source const& source, stated_quantity const& q,
                                       std::string const& to, std::string const& what) {
    static auto const half = *exact_decimal::parse("0.5");
    auto const [lower, upper] = bounds_in(source, q, to, what);
    auto const bounds = enclose(lower, upper);
    if (!bounds) source.fail(q.position, "the number is beyond all doubles", "use another unit");
    auto const middle = q.is_range ? std::nullopt : nearest((lower + upper).times(half));
    return {*bounds, middle.value_or(mid(*bounds))};
}

/// A line of a table of states: "8 m/s", or a table with range, unit and `more`.
/// @param more  a further key that it may have
[[nodiscard]] inline model_description::state stated_state(model_source const& source,
                                                           toml_section const& states,
                                                           toml_section::entry const& e,
                                                           char const* more) {
    model_description::state s;
    s.name = e.name;
    stated_quantity range;
    if (e.node->is_table()) {
        auto const of = states.within(e);
        of.allow({"unit", "range", more});
        auto const* r = of.find("range");
        if (r == nullptr)
            source.fail(e.value, "the state '" + e.name + "' has no range",
                        "say how large it is: range = 8 for |x| <= 8, or [0, 5]");
        range = of.quantity(*r);
        s.unit = stated_unit(source, of).value_or(range.in ? range.unit_text : "1");
    } else {
        range = states.quantity(e);
        s.unit = range.in ? range.unit_text : "1";
    }
    if (!range.is_range) range.lower = -magnitude(range.upper);
    if (!range.is_range) range.upper = magnitude(range.upper);
    auto const bounds = converted(source, range, s.unit, "the state '" + e.name + "'").enclosure;
    s.limit = {bounds.lower(), bounds.upper()};
    if (s.limit == 0.0)
        source.fail(range.position, "the range of the state '" + e.name + "' is 0 alone",
                    "say how large it is: range = 8 for |x| <= 8, or [0, 5]");
    return s;
}

} // namespace sivid::text_detail

#endif
