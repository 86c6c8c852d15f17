// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DIAGNOSIS_WORDS_HPP
#define SIVID_REPORT_DIAGNOSIS_WORDS_HPP

#include <sivid/model/named_effects.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/draw/charts.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/page.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The sentences of a diagnosis's page. What is proved is called so; all else is called an
/// estimate.
namespace sivid::report {

// A sign stays with its word where lines end.
inline constexpr std::string_view proved_mark = "\xE2\x9C\x93\xC2\xA0proved";
inline constexpr std::string_view estimate_mark = "\xE2\x89\x88\xC2\xA0"
                                                  "estimate";

/// "S4, 1.2 to 2 s", with the model's unit of time
inline std::string window_text(time_window const& w, std::string const& time_unit) {
    std::string const times =
        given_text(w.from) + " to " + given_text(w.to) + unit_suffix(time_unit);
    return !(w.from < w.to) ? w.scenario : w.scenario.empty() ? times : w.scenario + ", " + times;
}

/// "yaw equation", "sensor r", "input delta"
inline std::string place_name(suspected_place const& p) {
    return p.kind == "equation" ? p.name + " equation"
           : p.kind.empty()     ? p.name
                                : p.kind + ' ' + p.name;
}

/// "-0.42 to -0.18 rad/s^2, proved"
inline std::string missing_text(suspected_place const& p) {
    if (p.missing && !is_empty(*p.missing)) {
        return span_text(p.missing) + unit_suffix(p.unit) + " (proved)";
    }
    return p.estimate && std::isfinite(*p.estimate)
               ? estimate_text(*p.estimate) + unit_suffix(p.unit) + " (estimate)"
               : std::string{};
}

/// The formula of a law for a reader.
inline std::string law_text(std::string const& law) {
    std::string out;
    for (std::size_t i = 0; i < law.size(); ++i) {
        bool const beside =
            (i > 0 && law[i - 1] == '*') || (i + 1 < law.size() && law[i + 1] == '*');
        if (law[i] != ' ' || !beside) out += law[i];
    }
    return formula_text(out);
}

/// Where and how: "the yaw equation in S4, 1.2 to 2 s, lacks -0.42 to -0.18 rad/s^2 (proved)".
inline std::string place_clause(suspected_place const& p, std::string const& time_unit) {
    std::string const missing = missing_text(p);
    std::string const where = window_text(p.where, time_unit);
    std::string out = "the " + place_name(p) + (where.empty() ? "" : " (" + where + ")");
    out += !missing.empty() ? (p.kind == "equation" ? " lacks " : " is off by ") + missing
           : p.proved       ? " is broken (proved)"
                            : " is suspected (estimate)";
    out += p.law.empty() ? "" : ", in the shape of " + law_text(p.law) + " (estimate)";
    return p.regime.empty() ? out : out + ", where " + p.regime + " (estimate)";
}

/// One broken relation in plain words.
inline std::string relation_words(broken_relation_report const& r, std::string const& time_unit) {
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
    if (!r.windows.empty()) {
        auto const shown = std::span{r.windows}.first(std::min(most, r.windows.size()));
        out += " Shown by " +
               joined(shown, "; ", [&](auto const& w) { return window_text(w, time_unit); });
        out += r.windows.size() > most ? " and " + count_text(r.windows.size() - most) + " more."
                                       : ".";
    }
    if (!r.proved && !r.assumptions.empty()) {
        out += " It rests on " + enumeration(r.assumptions) + ".";
    }
    return out;
}

/// "v in S3": the measurements of a part.
inline std::string part_words(confined_gap const& c) {
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

/// "one parameter explains all data but those of v, whose bounds must grow by a factor of 1.61 to
/// 1.66 (proved)"
inline std::string confined_clause(confined_gap const& c) {
    return "one parameter explains all data but those of " + part_words(c) +
           ", whose bounds must grow by a factor of " + inflation_text(c.factor) + " (proved)" +
           (c.steps ? detail::step_clause(*c.steps) : detail::growth_clause(c));
}

namespace detail {
/// Where an effect acts, if not everywhere and always: " in S1, S2" of "payload@S1+S2", " from a
/// time on" of "payload@S1>=0.69563+S2".
/// @param name  loses it
inline std::string take_where(std::string& name) {
    auto const at = name.find('@');
    if (at == std::string::npos) return "";
    auto where = name.substr(at + 1);
    name.resize(at);
    bool const begins = where.find(">=") != std::string::npos;
    if (where.find('<') != std::string::npos) return begins ? " for a time" : " until a time";
    if (begins) return " from a time on";
    std::string out = " in ";
    for (char const c : where) out += c == '+' ? std::string(", ") : std::string(1, c);
    return out;
}
} // namespace detail

/// An effect's name, with where it acts if not everywhere and always: "payload in S1, S2" of
/// "payload@S1+S2", "payload from a time on" of "payload@S1>=0.69563+S2".
inline std::string name_of(std::string effect) {
    auto const where = detail::take_where(effect);
    return effect + where;
}

/// "rudder_lag + wind"; without effects "the model as it is".
inline std::string names_of(std::vector<std::string> const& effects) {
    return effects.empty() ? "the model as it is" : joined(effects, " + ", name_of);
}

/// In words where there are any: "a first-order lag of the rudder and a steady wind".
inline std::string words_of(diagnosis_view const& v, std::vector<std::string> const& effects) {
    std::vector<std::string> words;
    for (std::string const& e : effects) {
        auto name = e;
        auto const where = detail::take_where(name);
        auto const known = v.about.meanings.find(name);
        bool const said = known != v.about.meanings.end() && !known->second.empty();
        words.push_back((said ? known->second : name) + where);
    }
    return enumeration(words);
}

/// "98 to 100 %"; an upper end above 100 is impossible, a missing lower one is said.
inline std::string shrink_text(range const& share) {
    if (is_empty(share)) return "";
    // Three digits, but no finer than a tenth of a percent.
    auto const text = [](double x, rounding way) {
        if (std::fabs(x) >= 0.1) return rounded_text(x, way, {.significant = 3, .shift = 2});
        auto d = round_decimal(x, -3, way);
        d.exponent += 2;
        auto const digits = plain_text(d);
        bool const whole = digits.size() > 2 && digits.substr(digits.size() - 2) == ".0";
        return whole ? digits.substr(0, digits.size() - 2) : digits;
    };
    std::string const high = text(share.hi, rounding::up);
    if (!std::isfinite(share.lo)) return "at most " + high + "\xC2\xA0%";
    std::string const low = text(share.lo, rounding::down);
    return (low == high ? low : low + " to " + high) + "\xC2\xA0%";
}

/// Whether what is proved of a number is less than what was allowed.
inline bool is_narrowed(named_estimate const& e) {
    range const hull = e.hull, prior = e.prior;
    if (!is_finite(hull)) return false;
    return !is_finite(prior) || hull.hi - hull.lo < 0.999 * (prior.hi - prior.lo);
}

/// Proved bounds of a number, outward, but not beyond what was allowed: "0.16 to 0.18"; "not
/// narrowed" where they are the prior; empty where nothing is known.
inline std::string hull_text(named_estimate const& e) {
    range const hull = e.hull, prior = e.prior;
    if (is_empty(hull)) return "";
    if (!is_narrowed(e)) return "not narrowed";
    bool const known = !is_empty(prior);
    std::string const low =
        known && hull.lo <= prior.lo ? given_text(prior.lo) : rounded_text(hull.lo, rounding::down);
    std::string const high =
        known && hull.hi >= prior.hi ? given_text(prior.hi) : rounded_text(hull.hi, rounding::up);
    return low == high ? low : low + " to " + high;
}

/// "8 of 36 candidates tried, no pair"; empty when none was planned.
inline std::string tried_text(tried_candidates const& t) {
    std::size_t const planned = t.planned(), tried = t.tried();
    if (planned == 0) return "";
    std::string out = tried == 0 ? "none of the " + count_text(planned) + " candidates was tried"
                      : tried >= planned
                          ? "all " + count_text(planned) + " candidates tried"
                          : count_text(tried) + " of " + count_text(planned) + " candidates tried";
    if (tried == 0 || tried >= planned) return out;
    if (t.pairs.planned > 0 && t.pairs.tried == 0) return out + ", no pair";
    return t.pairs.tried < t.pairs.planned ? out + ", " + count_text(t.pairs.tried) + " of the " +
                                                 count_text(t.pairs.planned) + " pairs"
                                           : out;
}

/// "k sits at the upper end of its prior [1, 2] (with wind): widen it"
inline std::string end_words(constant_at_end const& e) {
    return e.constant.name + " = " + rounded_text(e.constant.value, rounding::nearest) +
           unit_suffix(e.constant.unit) + " sits at the " + std::string{to_string(e.end)} +
           " end of its prior " + given_text(e.constant.prior) + " (" +
           (e.effects.empty() ? std::string{} : "with ") + names_of(e.effects) +
           "): widen it if it may lie beyond";
}

/// "tau = 0.169 s (0.16 to 0.18, proved)"
/// @param verified  the value is that of a witness that explains the data
inline std::string estimate_words(named_estimate const& e, bool verified) {
    std::string const name =
        e.name.substr(e.name.rfind('.') == std::string::npos ? 0 : e.name.rfind('.') + 1);
    std::string out = name;
    out += std::isfinite(e.value)
               ? " = " + rounded_text(e.value, rounding::nearest) + unit_suffix(e.unit)
               : "";
    if (is_narrowed(e)) return out + " (" + hull_text(e) + ", proved)";
    std::string const known = verified ? "verified" : "estimate";
    return out + " (" + known + (is_finite(range{e.hull}) ? "; prior not narrowed)" : ")");
}

/// What is drawn beside the model as it is: "with rudder_lag".
inline std::string after_words(diagnosis_view const& v) {
    return v.answer == answer_kind::effects && !v.effects.empty()
               ? "with " + names_of(v.effects)
               : std::string{"with the closest candidate"};
}

/// The inflation of the best fit of the model as it is; 0 when there is none.
inline double base_fitted(diagnosis_view const& v) {
    cause const* const base = find_candidate(v, {});
    return is_fitted(v.about.base_fitted) || base == nullptr ? v.about.base_fitted
                                                             : base->fitted_inflation;
}

/// The factor in the words of a sentence: "3.1 to 3.2 times the measurement bounds (proved)".
inline std::string gap_clause(diagnosis_view const& v) {
    double const fitted = base_fitted(v);
    std::string const estimate =
        is_fitted(fitted) ? ", " + estimate_text(fitted) + " in the best fit found (estimate)" : "";
    switch (v.gap) {
    case gap_verdict::certified:
        return says_something(v.inflation)
                   ? "The model and the robot disagree by " + inflation_text(v.inflation) +
                         " times the measurement bounds (proved)" +
                         (std::isfinite(v.inflation.upper()) ? "" : estimate)
                   : "No parameter of the prior explains the data (proved)" + estimate;
    case gap_verdict::none:
        return "No gap: a parameter of the prior explains all data of the fit (proved" +
               std::string{is_finite(range{v.inflation}) && v.inflation.upper() > 0
                               ? "; " + inflation_text(v.inflation) +
                                     " of the measurement bounds are needed"
                               : ""} +
               ")";
    default:
        return "It is open whether the model explains the data: " +
               (says_something(v.inflation) || !estimate.empty()
                    ? "until it does, the bounds must grow by a factor of " +
                          (says_something(v.inflation)
                               ? inflation_text(v.inflation) + " (proved)" + estimate
                               : estimate.substr(2))
                    : "nothing is known of it yet");
    }
}

/// How the answer stands: "explains all data (proved)".
inline std::string answer_verdict(diagnosis_view const& v) {
    cause const* const c = answer_of(v);
    bool const many = v.effects.size() > 1;
    std::string const explain = many ? "together explain" : "explains";
    if (c != nullptr && c->verdict == cause_verdict::explains) {
        return explain + " all data (proved)";
    }
    if (c != nullptr && c->verdict == cause_verdict::excluded) {
        return std::string{many ? "come" : "comes"} +
               " closest of what was tried, but cannot explain all data (proved)";
    }
    if (c != nullptr && is_fitted(c->fitted_inflation) && c->fitted_inflation <= 1) {
        return explain + " all data in the best fit found (estimate)";
    }
    return std::string{many ? "are" : "is"} + " the likeliest of what was tried (estimate)";
}

/// "a first-order lag of the rudder, tau = 0.169 s (0.16 to 0.18, proved), explains all data"
inline std::string answer_clause(diagnosis_view const& v) {
    cause const* const c = answer_of(v);
    std::vector<std::string> numbers;
    if (c != nullptr) {
        for (auto const& e : parameters_of(*c))
            numbers.push_back(estimate_words(e.number, e.verified));
        for (named_combination const& k : v.combinations)
            if (k.of_effects) numbers.push_back(estimate_words(k.about, v.constants_verified));
    }
    return words_of(v, v.effects) + (numbers.empty() ? " " : ", " + enumeration(numbers) + ", ") +
           answer_verdict(v);
}

/// What else it may be, and what would tell; empty when nothing is.
inline std::string alternatives_clause(diagnosis_view const& v) {
    std::vector<std::string> others;
    for (auto const& o : v.indistinguishable) {
        cause const* const c = find_candidate(v, o);
        bool const proved = c != nullptr && c->verdict == cause_verdict::explains;
        others.push_back(words_of(v, o) + (proved ? " (which explains as well, proved)" : ""));
    }
    if (others.empty()) return "";
    return "the data cannot tell it from " + enumeration(others, " or from ") +
           (v.next ? "; the manoeuvre \xE2\x80\x9C" + v.next->manoeuvre + "\xE2\x80\x9D would"
                   : "");
}

/// False for a range that says nothing: no lower bound, and an upper one of all of the gap.
inline bool says_shrink(range const& share) {
    return !is_empty(share) && (std::isfinite(share.lo) || share.hi < 1);
}

inline std::string shrink_clause(range const& share, std::string_view data) {
    if (!says_shrink(share)) return "";
    std::string const on = "on " + std::string{data} + " it ";
    if (share.hi <= 0) return on + "does not shrink the gap (proved)";
    return on + "removes " + shrink_text(share) + " of the gap (proved)";
}

/// Whether what is removed on held-out data is bounded for every parameter that explains the
/// others.
inline bool says_shrink_over_fits(diagnosis_view const& v) {
    return v.shrink_over_fits && v.shrink_over_fits->lower() > 0;
}

/// The same of held-out data: for every parameter that explains the others where that is known,
/// else at the witness.
inline std::string holdout_clause(diagnosis_view const& v) {
    if (!says_shrink_over_fits(v)) return shrink_clause(v.shrink_holdout, "the held-out data");
    return "on the held-out data it removes " + shrink_text(v.shrink_over_fits) +
           " of the gap, for every parameter that explains the other data (proved)";
}

/// "with overflow an unexplained remainder of 3.1 to 3.2 times the measurement bounds is left
/// (proved)"; empty when nothing is said of one.
inline std::string remainder_clause(diagnosis_view const& v) {
    if (!v.remainder) return "";
    unexplained_remainder const& r = *v.remainder;
    std::string out = (r.effects.empty() ? "" : "with " + names_of(r.effects) + ", the closest, ") +
                      "an unexplained remainder of ";
    bool const proved = says_something(r.inflation);
    if (proved)
        out += inflation_text(r.inflation) + " times the measurement bounds is left (proved";
    cause const* const c = find_candidate(v, r.effects);
    double const best = c != nullptr ? c->fitted_inflation : 0;
    bool const fitted = is_fitted(best) &&
                        !(proved && r.inflation.lower() > 1 && std::isfinite(r.inflation.upper()));
    if (fitted) {
        out += std::string{proved ? "; " : ""} + estimate_text(best) +
               (proved ? " in the best fit found, estimate"
                       : " times the measurement bounds is left in the best fit found (estimate");
    }
    return proved || fitted ? out + ")" : out + "unknown size is left";
}

/// "within 0.80 to 0.91 m/s^2 of unknown disturbance of v the model as it is explains everything
/// (proved); it is reached somewhere in S1 from 3 to 4 s (proved), where speed is large (estimate)"
inline std::string disturbance_clause(needed_disturbance const& n, std::string const& time_unit) {
    auto const in = [&](std::vector<time_window> const& all) {
        return joined(all, "; ", [&](auto const& w) { return window_text(w, time_unit); });
    };
    bool const bounded = std::isfinite(n.size.upper());
    std::string out = bounded
                          ? "within " + span_text(n.size) + " " + unit_text(n.unit) +
                                " of unknown disturbance of " + n.equation +
                                " the model as it is explains everything (proved)"
                          : "a disturbance of " + n.equation + " that explains everything needs " +
                                span_text(n.size) + " " + unit_text(n.unit) + " (proved)";
    if (!n.reached.empty())
        out += "; it is reached somewhere in " + in(n.reached) + " (proved" +
               (n.reached.size() > 1 ? ", of one of these)" : ")");
    if (!n.strongest.empty())
        out += "; a witness needs it in " + in(n.strongest) + " (others may not)";
    if (!n.regime.empty()) out += ", where " + n.regime + " (estimate)";
    return out;
}
/// Such clauses of the remainder.
inline std::vector<std::string> disturbance_clauses(diagnosis const& d) {
    std::vector<std::string> all;
    if (d.remainder)
        for (auto const& n : d.remainder->disturbances)
            all.push_back(disturbance_clause(n, d.time_unit));
    return all;
}

/// With which factor on all bounds each model explains the data, and below which it is refuted, one
/// model a clause: the model as it is, then those that explain with smaller ones, fewest effects
/// first. Proved; empty where something explains them with the stated bounds.
inline std::vector<std::string> ladder_clauses(diagnosis const& d) {
    constexpr std::size_t most = 6;
    std::vector<std::string> all;
    if (!d.remainder) return all;
    auto const add = [&](std::string const& name, inflation_range const& r) {
        bool const explains = std::isfinite(r.upper()), refuted = r.lower() > 0;
        if (!explains && !refuted) return;
        all.push_back(name +
                      (explains
                           ? " explains the data from " + rounded_text(r.upper(), rounding::up) +
                                 " times the stated bounds on"
                           : std::string{}) +
                      (explains && refuted ? ", and" : "") +
                      (refuted ? " is refuted below " + rounded_text(r.lower(), rounding::down) +
                                     " times" + (explains ? "" : " the stated bounds")
                               : std::string{}) +
                      " (proved)");
    };
    add("as it is the model", d.inflation);
    std::vector<cause const*> rungs;
    for (auto const& c : d.causes)
        if (!c.effects.empty() && std::isfinite(c.inflation.upper())) rungs.push_back(&c);
    std::stable_sort(rungs.begin(), rungs.end(), [](auto const* a, auto const* b) {
        return std::pair{a->effects.size(), a->inflation.upper()} <
               std::pair{b->effects.size(), b->inflation.upper()};
    });
    double least = d.inflation.upper();
    for (auto const* c : rungs) {
        if (!(c->inflation.upper() < least) || all.size() == most) continue;
        least = c->inflation.upper();
        add("with " + names_of(c->effects) + " it", c->inflation);
    }
    return all;
}

/// What was tried in vain, and what comes closest by now; of an answer that is open.
inline std::string open_clause(diagnosis_view const& v) {
    std::string const tried = tried_text(v.tried);
    cause const* closest = nullptr;
    for (cause const& c : v.causes) {
        // Best first: the closest, or with fewer effects nearly so.
        if (closest == nullptr && !c.effects.empty() && is_fitted(c.fitted_inflation)) closest = &c;
    }
    return "whether an effect explains the data is open" + (tried.empty() ? "" : ": " + tried) +
           (closest == nullptr
                ? ""
                : ", " + names_of(closest->effects) + " comes closest by now with " +
                      estimate_text(closest->fitted_inflation) + " times the bounds (estimate)") +
           "; a larger --budget tries the rest";
}

inline std::string headline(diagnosis_view const& v) {
    std::string const gap = v.gap == gap_verdict::none        ? "No gap (proved)"
                            : v.gap == gap_verdict::certified ? "Gap (proved)"
                                                              : "Gap not decided";
    std::string const rest = v.confined.empty() ? ""
                                                : "; all but " + part_words(v.confined.front()) +
                                                      " is explained (proved)";
    if (v.answer == answer_kind::unexplained) return gap + "; no candidate explains it" + rest;
    if (v.answer == answer_kind::open) {
        std::string const tried = tried_text(v.tried);
        return gap + "; open" + (tried.empty() ? "" : ": " + tried) + rest;
    }
    if (v.answer == answer_kind::none || v.effects.empty()) return gap;
    cause const* const c = answer_of(v);
    std::string const how =
        c != nullptr && c->verdict == cause_verdict::explains ? " (proved)" : " (estimate)";
    std::string const verb = v.effects.size() > 1 ? " explain the data" : " explains the data";
    std::size_t const n = v.indistinguishable.size();
    // Names of a catalogue are the reader's own; those of faults that it has not are code.
    bool const faults = std::all_of(v.effects.begin(), v.effects.end(), names_sensor_fault);
    return gap + "; " + (faults ? words_of(v, v.effects) : names_of(v.effects)) +
           (c != nullptr && c->verdict == cause_verdict::excluded ? " comes closest" : verb + how) +
           (n == 0   ? ""
            : n == 1 ? ", but so may another"
                     : ", but so may " + count_text(n) + " others");
}

/// The sign of the banner: proved and the only answer, or something is open, or nothing explains.
inline outcome banner_outcome(diagnosis_view const& v) {
    if (v.answer == answer_kind::unexplained && v.gap == gap_verdict::certified)
        return outcome::refuted;
    cause const* const c = answer_of(v);
    bool const explained = c != nullptr && c->verdict == cause_verdict::explains &&
                           v.indistinguishable.empty() && v.gap != gap_verdict::undecided;
    bool const needless = v.answer == answer_kind::none && v.gap == gap_verdict::none;
    return explained || needless ? outcome::proved : outcome::undecided;
}

/// Candidates other than the model as it is that are proved not to explain the data.
inline std::size_t effects_excluded(diagnosis_view const& v) {
    return static_cast<std::size_t>(std::count_if(v.causes.begin(), v.causes.end(), [](auto& c) {
        return !c.effects.empty() && c.verdict == cause_verdict::excluded;
    }));
}

/// The whole answer in one sentence.
inline std::string banner_sentence(diagnosis_view const& v) {
    std::vector<std::string> parts{gap_clause(v)};
    if (v.answer == answer_kind::effects && !v.effects.empty()) {
        parts.push_back(answer_clause(v));
        parts.push_back(alternatives_clause(v));
        parts.push_back(holdout_clause(v));
    } else if (v.answer == answer_kind::open) {
        parts.push_back(open_clause(v));
        if (!v.confined.empty()) parts.push_back(confined_clause(v.confined.front()));
        if (!v.where.empty()) parts.push_back(place_clause(v.where.front(), v.time_unit));
    } else if (v.answer == answer_kind::unexplained) {
        std::size_t const excluded = effects_excluded(v);
        std::string const tried = tried_text(v.tried);
        parts.push_back("no candidate was found that explains it" +
                        (tried.empty() ? "" : " (" + tried + ")") +
                        (excluded > 0 ? ", " + count_text(excluded) + " are excluded (proved)"
                                      : std::string{}));
        if (!v.confined.empty()) parts.push_back(confined_clause(v.confined.front()));
        parts.push_back(remainder_clause(v));
        if (!v.where.empty()) parts.push_back(place_clause(v.where.front(), v.time_unit));
        if (auto const all = disturbance_clauses(v); !all.empty()) parts.push_back(all.front());
    } else if (v.gap != gap_verdict::none && !v.where.empty()) {
        parts.push_back(place_clause(v.where.front(), v.time_unit));
    }
    std::erase(parts, "");
    return joined(parts, "; ") + ".";
}

/// What to measure next, in one sentence; empty when nothing is proposed.
inline std::string next_words(diagnosis_view const& v) {
    if (!v.next) return "";
    next_experiment const& n = *v.next;
    std::string out =
        n.recorded ? "Record \xE2\x80\x9C" + n.manoeuvre + "\xE2\x80\x9D again with finer bounds"
                   : "Drive the manoeuvre \xE2\x80\x9C" + n.manoeuvre + "\xE2\x80\x9D";
    auto const settings = joined(n.settings, ", ", [](named_estimate const& s) {
        return s.name + " = " + rounded_text(s.value, rounding::nearest) + unit_suffix(s.unit);
    });
    out += settings.empty() ? "" : " with " + settings;
    return out + (std::isfinite(n.separation) && n.separation > 0
                      ? ": it sets the explanations apart by " + estimate_text(n.separation) +
                            " measurement bounds (prediction, not proved)."
                      : ".");
}

} // namespace sivid::report

#endif
