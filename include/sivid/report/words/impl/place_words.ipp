// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_WORDS_IMPL_PLACE_WORDS_IPP
#define SIVID_REPORT_WORDS_IMPL_PLACE_WORDS_IPP

#include <sivid/report/words/detail/place_words.hpp>

#include <sivid/number/text/joined.hpp>

namespace sivid::report {

SIVID_DECL std::string capitalised(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') {
        text[0] = static_cast<char>(text[0] - 'a' + 'A');
    }
    return text;
}

SIVID_DECL std::string window_text(time_window const& w, std::string const& time_unit) {
    std::string const times =
        given_text(w.from) + " to " + given_text(w.to) + unit_suffix(time_unit);
    return !(w.from < w.to) ? w.scenario : w.scenario.empty() ? times : w.scenario + ", " + times;
}

SIVID_DECL std::string place_name(suspected_place const& p) {
    return p.kind == "equation" ? p.name + " equation"
           : p.kind.empty()     ? p.name
                                : p.kind + ' ' + p.name;
}

SIVID_DECL std::string missing_text(suspected_place const& p) {
    if (p.missing && !is_empty(*p.missing)) {
        return span_text(p.missing) + unit_suffix(p.unit) + " (proved)";
    }
    return p.estimate && std::isfinite(*p.estimate)
               ? estimate_text(*p.estimate) + unit_suffix(p.unit) + " (estimate)"
               : std::string{};
}

SIVID_DECL std::string law_text(std::string const& law) {
    std::string out;
    for (std::size_t i = 0; i < law.size(); ++i) {
        bool const beside =
            (i > 0 && law[i - 1] == '*') || (i + 1 < law.size() && law[i + 1] == '*');
        if (law[i] != ' ' || !beside) out += law[i];
    }
    return formula_text(out);
}

SIVID_DECL std::string place_clause(suspected_place const& p, std::string const& time_unit) {
    std::string const missing = missing_text(p);
    std::string const where = window_text(p.where, time_unit);
    std::string out = "the " + place_name(p) + (where.empty() ? "" : " (" + where + ")");
    out += !missing.empty() ? (p.kind == "equation" ? " lacks " : " is off by ") + missing
           : p.proved       ? " is broken (proved)"
                            : " is suspected (estimate)";
    out += p.law.empty() ? "" : ", in the shape of " + law_text(p.law) + " (estimate)";
    return p.regime.empty() ? out : out + ", where " + p.regime + " (estimate)";
}

SIVID_DECL std::string relation_words(broken_relation_report const& r,
                                      std::string const& time_unit) {
    constexpr std::size_t most = 4;
    std::string out = "The " + r.equation + " equation";
    out += r.sensors.empty()       ? ""
           : r.sensors.size() == 1 ? " and the sensor " + r.sensors[0]
                                   : " and the sensors " + enumeration(r.sensors);
    char const* const together = r.sensors.empty() ? "" : " together";
    out +=
        r.proved
            ? std::string{" cannot hold"} + together + ", whatever the parameters of the prior (" +
                  (r.assumptions.empty() ? "proved" : "proved if " + enumeration(r.assumptions)) +
                  ")."
        : r.sensors.empty() ? std::string{" seems not to hold (estimate)."}
                            : std::string{" seem not to hold together (estimate)."};
    std::vector<std::string> windows;
    for (std::size_t i = 0; i < std::min(most, r.windows.size()); ++i) {
        windows.push_back(window_text(r.windows[i], time_unit));
    }
    if (!windows.empty()) {
        out += " Shown by " + joined(windows, "; ");
        out += r.windows.size() > most ? " and " + count_text(r.windows.size() - most) + " more."
                                       : ".";
    }
    if (!r.proved && !r.assumptions.empty()) {
        out += " It rests on " + enumeration(r.assumptions) + ".";
    }
    return out;
}

SIVID_DECL std::string part_words(confined_gap const& c) {
    auto const where = enumeration(c.scenarios);
    return c.channel + (c.channel.empty() || where.empty() ? "" : " in ") + where;
}

namespace detail {

/// Of readings that are too coarse.
inline std::string step_clause(reading_steps const& s) {
    return "; its readings come in steps of " + rounded_text(s.size, rounding::nearest) +
           unit_suffix(s.unit) + ": bounds that are wider by " +
           (s.cut_off ? "a step" : "half a step") + " explain all data (proved)";
}

/// Nothing where bounds grow by a factor, and errors come one by one.
inline std::string growth_clause(confined_gap const& c) {
    std::string grows;
    if (c.grows) {
        auto const size = inflation_text(c.grows->coefficient);
        grows = c.grows->what == noise_growth::with::rate
                    ? "; likelier, they grow with how fast it changes, by " + size + " " +
                          c.grows->unit +
                          " times its rate (proved to explain): time stamps that are so far off "
                          "would show that"
                    : "; likelier, they grow with what it shows, by " + size +
                          " times its value (proved to explain)";
    }
    return c.correlated
               ? grows + "; its errors go together for " +
                     rounded_text(c.correlated->seconds, rounding::nearest) + " " +
                     c.correlated->unit + " or so (estimate), as those of something slow do"
               : grows;
}

} // namespace detail

SIVID_DECL std::string confined_clause(confined_gap const& c) {
    return "one parameter explains all data but those of " + part_words(c) +
           ", whose bounds must grow by a factor of " + inflation_text(c.factor) + " (proved)" +
           (c.steps ? detail::step_clause(*c.steps) : detail::growth_clause(c));
}

} // namespace sivid::report

#endif
