// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_DIAGNOSIS_WORDS_IPP
#define SIVID_REPORT_IMPL_DIAGNOSIS_WORDS_IPP

#include <sivid/report/diagnosis_words.hpp>

#include <sivid/compiled.hpp>
#include <sivid/model/named_effects.hpp>
#include <sivid/number/text/joined.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sivid::report {

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

SIVID_DECL std::string name_of(std::string effect) {
    auto const where = detail::take_where(effect);
    return effect + where;
}

SIVID_DECL std::string names_of(std::vector<std::string> const& effects) {
    return effects.empty() ? "the model as it is" : joined(effects, " + ", name_of);
}

SIVID_DECL std::string words_of(diagnosis_view const& v, std::vector<std::string> const& effects) {
    std::vector<std::string> words;
    for (std::string const& e : effects) {
        auto name = e;
        auto const where = detail::take_where(name);
        auto const known = v.meanings.find(name);
        bool const said = known != v.meanings.end() && !known->second.empty();
        words.push_back((said ? known->second : name) + where);
    }
    return enumeration(words);
}

SIVID_DECL std::string shrink_text(range const& share) {
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

SIVID_DECL bool is_narrowed(estimate_view const& e) {
    if (is_empty(e.hull) || !is_finite(e.hull)) return false;
    if (is_empty(e.prior) || !is_finite(e.prior)) return true;
    return e.hull.hi - e.hull.lo < 0.999 * (e.prior.hi - e.prior.lo);
}

SIVID_DECL std::string hull_text(estimate_view const& e) {
    if (is_empty(e.hull)) return "";
    if (!is_narrowed(e)) return "not narrowed";
    bool const known = !is_empty(e.prior);
    std::string const low = known && e.hull.lo <= e.prior.lo
                                ? given_text(e.prior.lo)
                                : rounded_text(e.hull.lo, rounding::down);
    std::string const high = known && e.hull.hi >= e.prior.hi
                                 ? given_text(e.prior.hi)
                                 : rounded_text(e.hull.hi, rounding::up);
    return low == high ? low : low + " to " + high;
}

SIVID_DECL bool tried_all(diagnosis_view const& v) {
    return v.singles.tried + v.pairs.tried + v.larger.tried >=
           v.singles.planned + v.pairs.planned + v.larger.planned;
}

SIVID_DECL std::string tried_text(diagnosis_view const& v) {
    std::size_t const planned = v.singles.planned + v.pairs.planned + v.larger.planned;
    if (planned == 0) return "";
    std::size_t const tried = v.singles.tried + v.pairs.tried + v.larger.tried;
    std::string out = tried == 0 ? "none of the " + count_text(planned) + " candidates was tried"
                      : tried >= planned
                          ? "all " + count_text(planned) + " candidates tried"
                          : count_text(tried) + " of " + count_text(planned) + " candidates tried";
    if (tried == 0 || tried >= planned) return out;
    if (v.pairs.planned > 0 && v.pairs.tried == 0) return out + ", no pair";
    return v.pairs.tried < v.pairs.planned ? out + ", " + count_text(v.pairs.tried) + " of the " +
                                                 count_text(v.pairs.planned) + " pairs"
                                           : out;
}

SIVID_DECL std::string end_words(end_view const& e) {
    return e.constant.name + " = " + rounded_text(e.constant.value, rounding::nearest) +
           unit_suffix(e.constant.unit) + " sits at the " + (e.upper ? "upper" : "lower") +
           " end of its prior " + given_text(e.constant.prior) + " (" +
           (e.effects.empty() ? std::string{} : "with ") + names_of(e.effects) +
           "): widen it if it may lie beyond";
}

SIVID_DECL std::string estimate_words(estimate_view const& e) {
    std::string const name =
        e.name.substr(e.name.rfind('.') == std::string::npos ? 0 : e.name.rfind('.') + 1);
    std::string out = name;
    out += std::isfinite(e.value)
               ? " = " + rounded_text(e.value, rounding::nearest) + unit_suffix(e.unit)
               : "";
    if (is_narrowed(e)) return out + " (" + hull_text(e) + ", proved)";
    std::string const known = e.verified ? "verified" : "estimate";
    return out + " (" + known + (is_finite(e.hull) ? "; prior not narrowed)" : ")");
}

SIVID_DECL std::string after_words(diagnosis_view const& v) {
    return !v.after.empty() ? v.after
           : v.answer == answer_state::effects && !v.effects.empty()
               ? "with " + names_of(v.effects)
               : std::string{"with the closest candidate"};
}

SIVID_DECL double base_fitted(diagnosis_view const& v) {
    candidate_view const* const base = find_candidate(v, {});
    return is_fitted(v.fitted) || base == nullptr ? v.fitted : base->fitted;
}

SIVID_DECL std::string gap_clause(diagnosis_view const& v) {
    double const fitted = base_fitted(v);
    std::string const estimate =
        is_fitted(fitted) ? ", " + estimate_text(fitted) + " in the best fit found (estimate)" : "";
    switch (v.gap) {
    case gap_state::present:
        return says_something(v.inflation)
                   ? "The model and the robot disagree by " + inflation_text(v.inflation) +
                         " times the measurement bounds (proved" +
                         (std::isfinite(v.inflation.hi) ? ")"
                          : estimate.empty()            ? ")"
                                                        : ")" + estimate)
                   : "No parameter of the prior explains the data (proved" + std::string{")"} +
                         estimate;
    case gap_state::absent:
        return "No gap: a parameter of the prior explains all data of the fit (proved" +
               std::string{is_finite(v.inflation) && v.inflation.hi > 0
                               ? "; " + inflation_text(v.inflation) +
                                     " of the measurement bounds are needed"
                               : ""} +
               ")";
    default:
        return "It is open whether the model explains the data: " +
               (says_something(v.inflation)
                    ? "until it does, the bounds must grow by a factor of " +
                          inflation_text(v.inflation) + " (proved)" + estimate
                : !estimate.empty()
                    ? "until it does, the bounds must grow by a factor of " +
                          estimate_text(fitted) + " in the best fit found (estimate)"
                    : std::string{"nothing is known of it yet"});
    }
}

SIVID_DECL std::string answer_verdict(diagnosis_view const& v) {
    candidate_view const* const c = answer_of(v);
    bool const many = v.effects.size() > 1;
    std::string const explain = many ? "together explain" : "explains";
    if (c != nullptr && c->state == candidate_state::explains) {
        return explain + " all data (proved)";
    }
    if (c != nullptr && c->state == candidate_state::excluded) {
        return std::string{many ? "come" : "comes"} +
               " closest of what was tried, but cannot explain all data (proved)";
    }
    if (c != nullptr && is_fitted(c->fitted) && c->fitted <= 1) {
        return explain + " all data in the best fit found (estimate)";
    }
    return std::string{many ? "are" : "is"} + " the likeliest of what was tried (estimate)";
}

SIVID_DECL std::string answer_clause(diagnosis_view const& v) {
    candidate_view const* const c = answer_of(v);
    std::vector<std::string> numbers;
    if (c != nullptr) {
        for (estimate_view const& e : c->parameters) numbers.push_back(estimate_words(e));
        for (combination_estimate const& k : v.combinations)
            if (k.of_effects) numbers.push_back(estimate_words(k.product));
    }
    return words_of(v, v.effects) + (numbers.empty() ? " " : ", " + enumeration(numbers) + ", ") +
           answer_verdict(v);
}

SIVID_DECL std::string alternatives_clause(diagnosis_view const& v) {
    std::vector<std::string> others;
    for (auto const& o : v.indistinguishable) {
        candidate_view const* const c = find_candidate(v, o);
        bool const proved = c != nullptr && c->state == candidate_state::explains;
        others.push_back(words_of(v, o) + (proved ? " (which explains as well, proved)" : ""));
    }
    if (others.empty()) return "";
    return "the data cannot tell it from " + enumeration(others, " or from ") +
           (v.next ? "; the manoeuvre \xE2\x80\x9C" + v.next->manoeuvre + "\xE2\x80\x9D would"
                   : "");
}

SIVID_DECL bool says_shrink(range const& share) {
    return !is_empty(share) && (std::isfinite(share.lo) || share.hi < 1);
}

SIVID_DECL std::string shrink_clause(range const& share, std::string_view data) {
    if (!says_shrink(share)) return "";
    std::string const on = "on " + std::string{data} + " it ";
    if (share.hi <= 0) return on + "does not shrink the gap (proved)";
    return on + "removes " + shrink_text(share) + " of the gap (proved)";
}

SIVID_DECL bool says_shrink_over_fits(diagnosis_view const& v) {
    return !is_empty(v.shrink_over_fits) && v.shrink_over_fits.lo > 0;
}

SIVID_DECL std::string holdout_clause(diagnosis_view const& v) {
    if (!says_shrink_over_fits(v)) return shrink_clause(v.shrink_holdout, "the held-out data");
    return "on the held-out data it removes " + shrink_text(v.shrink_over_fits) +
           " of the gap, for every parameter that explains the other data (proved)";
}

SIVID_DECL std::string remainder_clause(diagnosis_view const& v) {
    if (!v.remainder) return "";
    remainder_view const& r = *v.remainder;
    std::string out = (r.effects.empty() ? "" : "with " + names_of(r.effects) + ", the closest, ") +
                      "an unexplained remainder of ";
    bool const proved = says_something(r.inflation);
    if (proved)
        out += inflation_text(r.inflation) + " times the measurement bounds is left (proved";
    bool const fitted =
        is_fitted(r.fitted) && !(proved && r.inflation.lo > 1 && std::isfinite(r.inflation.hi));
    if (fitted) {
        out += std::string{proved ? "; " : ""} + estimate_text(r.fitted) +
               (proved ? " in the best fit found, estimate"
                       : " times the measurement bounds is left in the best fit found (estimate");
    }
    return proved || fitted ? out + ")" : out + "unknown size is left";
}

SIVID_DECL std::string open_clause(diagnosis_view const& v) {
    std::string const tried = tried_text(v);
    candidate_view const* closest = nullptr;
    for (candidate_view const& c : v.candidates) {
        // Best first: the closest, or with fewer effects nearly so.
        if (closest == nullptr && !c.effects.empty() && is_fitted(c.fitted)) closest = &c;
    }
    return "whether an effect explains the data is open" + (tried.empty() ? "" : ": " + tried) +
           (closest == nullptr
                ? ""
                : ", " + names_of(closest->effects) + " comes closest by now with " +
                      estimate_text(closest->fitted) + " times the bounds (estimate)") +
           "; a larger --budget tries the rest";
}

SIVID_DECL std::string headline(diagnosis_view const& v) {
    std::string const gap = v.gap == gap_state::absent    ? "No gap (proved)"
                            : v.gap == gap_state::present ? "Gap (proved)"
                                                          : "Gap not decided";
    std::string const rest = v.confined.empty() ? ""
                                                : "; all but " + part_words(v.confined.front()) +
                                                      " is explained (proved)";
    if (v.answer == answer_state::unexplained) return gap + "; no candidate explains it" + rest;
    if (v.answer == answer_state::open) {
        std::string const tried = tried_text(v);
        return gap + "; open" + (tried.empty() ? "" : ": " + tried) + rest;
    }
    if (v.answer == answer_state::nothing || v.effects.empty()) return gap;
    candidate_view const* const c = answer_of(v);
    std::string const how =
        c != nullptr && c->state == candidate_state::explains ? " (proved)" : " (estimate)";
    std::string const verb = v.effects.size() > 1 ? " explain the data" : " explains the data";
    std::size_t const n = v.indistinguishable.size();
    // Names of a catalogue are the reader's own; those of faults that it has not are code.
    bool const faults = std::all_of(v.effects.begin(), v.effects.end(), names_sensor_fault);
    return gap + "; " + (faults ? words_of(v, v.effects) : names_of(v.effects)) +
           (c != nullptr && c->state == candidate_state::excluded ? " comes closest" : verb + how) +
           (n == 0   ? ""
            : n == 1 ? ", but so may another"
                     : ", but so may " + count_text(n) + " others");
}

SIVID_DECL outcome banner_outcome(diagnosis_view const& v) {
    if (v.answer == answer_state::unexplained) {
        return v.gap == gap_state::present ? outcome::refuted : outcome::undecided;
    }
    if (v.answer == answer_state::open) return outcome::undecided;
    if (v.gap == gap_state::open) return outcome::undecided;
    if (v.answer == answer_state::nothing) {
        return v.gap == gap_state::absent ? outcome::proved : outcome::undecided;
    }
    candidate_view const* const c = answer_of(v);
    bool const proved = c != nullptr && c->state == candidate_state::explains;
    return proved && v.indistinguishable.empty() ? outcome::proved : outcome::undecided;
}

SIVID_DECL std::string banner_sentence(diagnosis_view const& v) {
    std::vector<std::string> parts{gap_clause(v)};
    if (v.answer == answer_state::effects && !v.effects.empty()) {
        parts.push_back(answer_clause(v));
        parts.push_back(alternatives_clause(v));
        parts.push_back(holdout_clause(v));
    } else if (v.answer == answer_state::open) {
        parts.push_back(open_clause(v));
        if (!v.confined.empty()) parts.push_back(confined_clause(v.confined.front()));
        if (!v.places.empty()) parts.push_back(place_clause(v.places.front()));
    } else if (v.answer == answer_state::unexplained) {
        auto const excluded =
            std::count_if(v.candidates.begin(), v.candidates.end(), [](candidate_view const& c) {
                return !c.effects.empty() && c.state == candidate_state::excluded;
            });
        std::string const tried = tried_text(v);
        parts.push_back(
            "no candidate was found that explains it" + (tried.empty() ? "" : " (" + tried + ")") +
            (excluded > 0
                 ? ", " + count_text(static_cast<std::size_t>(excluded)) + " are excluded (proved)"
                 : std::string{}));
        if (!v.confined.empty()) parts.push_back(confined_clause(v.confined.front()));
        parts.push_back(remainder_clause(v));
        if (!v.places.empty()) parts.push_back(place_clause(v.places.front()));
    } else if (v.gap != gap_state::absent && !v.places.empty()) {
        parts.push_back(place_clause(v.places.front()));
    }
    if (!v.absorbed.empty()) {
        parts.push_back("the priors are wide enough to take up " + words_of(v, v.absorbed));
    }
    std::string out;
    for (std::string const& p : parts) out += p.empty() ? "" : (out.empty() ? "" : "; ") + p;
    return out + ".";
}

SIVID_DECL std::string next_words(diagnosis_view const& v) {
    if (!v.next) return "";
    next_experiment_view const& n = *v.next;
    std::string out =
        n.recorded ? "Record \xE2\x80\x9C" + n.manoeuvre + "\xE2\x80\x9D again with finer bounds"
                   : "Drive the manoeuvre \xE2\x80\x9C" + n.manoeuvre + "\xE2\x80\x9D";
    std::string settings;
    for (named_value const& s : n.settings) {
        settings += (settings.empty() ? "" : ", ") + s.name + " = " +
                    rounded_text(s.value, rounding::nearest) + unit_suffix(s.unit);
    }
    out += settings.empty() ? "" : " with " + settings;
    return out + (std::isfinite(n.separation) && n.separation > 0
                      ? ": it sets the explanations apart by " + estimate_text(n.separation) +
                            " measurement bounds (prediction, not proved)."
                      : ".");
}

} // namespace sivid::report

#endif
