// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_IMPL_DIAGNOSIS_TABLES_IPP
#define SIVID_REPORT_PAGE_IMPL_DIAGNOSIS_TABLES_IPP

#include <sivid/report/page/detail/diagnosis_tables.hpp>

namespace sivid::report {

/// Candidates other than the model as it is.
inline std::size_t effects_tried(diagnosis_view const& v) {
    return static_cast<std::size_t>(std::count_if(
        v.causes.begin(), v.causes.end(), [](cause const& c) { return !c.effects.empty(); }));
}

SIVID_DECL std::vector<card> diagnosis_cards(diagnosis_view const& v) {
    std::vector<card> out;
    if (says_something(v.inflation)) {
        out.push_back({"bounds must grow by", inflation_text(v.inflation) + " \xC3\x97",
                       v.gap == gap_verdict::certified ? "\xE2\x9C\x93 proved: there is a gap"
                       : v.gap == gap_verdict::none    ? "\xE2\x9C\x93 proved: there is no gap"
                                                       : "\xE2\x9C\x93 proved; a gap is open"});
    } else if (is_fitted(base_fitted(v))) {
        out.push_back({"bounds must grow by", estimate_text(base_fitted(v)) + " \xC3\x97",
                       "\xE2\x89\x88 estimate, best fit"});
    }
    if (!v.where.empty()) {
        suspected_place const& p = v.where.front();
        std::string const where = window_text(p.where, v.time_unit);
        out.push_back({"where", place_name(p),
                       std::string{p.proved ? proved_mark : estimate_mark} +
                           (where.empty() ? "" : ": " + where)});
    }
    if (v.answer == answer_kind::effects && !v.effects.empty()) {
        cause const* const c = answer_of(v);
        std::string numbers;
        auto const shown = c != nullptr ? parameters_of(*c) : std::vector<shown_estimate>{};
        for (std::size_t i = 0; i < std::min<std::size_t>(2, shown.size()); ++i) {
            numbers +=
                (numbers.empty() ? "" : ", ") + estimate_words(shown[i].number, shown[i].verified);
        }
        for (named_combination const& k : v.combinations)
            if (k.of_effects) numbers += ", " + estimate_words(k.about, v.constants_verified);
        bool const proved = c != nullptr && c->verdict == cause_verdict::explains;
        out.push_back(
            {proved ? "effect (\xE2\x9C\x93 proved to explain)" : "effect (\xE2\x89\x88 likeliest)",
             names_of(v.effects), numbers});
    } else if (v.answer == answer_kind::unexplained) {
        out.push_back({"effect", "none found", tried_text(v.tried)});
    } else if (v.answer == answer_kind::open) {
        out.push_back({"effect", "open", tried_text(v.tried)});
    }
    if (v.answer != answer_kind::effects) {
        // There is no effect that would remove anything.
    } else if (says_shrink_over_fits(v)) {
        out.push_back({"gap removed, held-out data", shrink_text(v.shrink_over_fits),
                       "\xE2\x9C\x93 proved for all that fits"});
    } else if (says_shrink(v.shrink_holdout)) {
        out.push_back({"gap removed, held-out data", shrink_text(v.shrink_holdout),
                       "\xE2\x9C\x93 proved at the witness"});
    } else if (says_shrink(v.shrink_fit)) {
        out.push_back({"gap removed, fit data", shrink_text(v.shrink_fit), "\xE2\x9C\x93 proved"});
    }
    if (v.seconds > 0) {
        out.push_back({"time", duration_text(v.seconds), v.interrupted ? "stopped early" : ""});
    }
    return out;
}

SIVID_DECL table summary_table(diagnosis_view const& v) {
    table t{.columns = {{"in short", column_kind::symbol}, {"answer"}}};
    auto const add = [&](char const* question, std::string const& text) {
        if (!text.empty()) {
            t.rows.push_back({question, capitalised(text) + (text.back() == '.' ? "" : ".")});
        }
    };
    add("Gap", gap_clause(v));
    if (!v.where.empty()) add("Where", place_clause(v.where.front(), v.time_unit));
    bool const answered = v.answer == answer_kind::effects && !v.effects.empty();
    if (!v.confined.empty() && !answered) add("Data", confined_clause(v.confined.front()));
    std::size_t const tried = effects_tried(v);
    std::size_t excluded = 0;
    for (cause const& c : v.causes) {
        excluded += !c.effects.empty() && c.verdict == cause_verdict::excluded ? 1 : 0;
    }
    std::string const all = tried_text(v.tried);
    std::size_t const planned = v.tried.planned();
    bool const beyond = planned > 0 && tried > planned;
    std::string const count =
        tried == 0
            ? ""
            : "; " + count_text(excluded) + " of the " + count_text(tried) + " candidates tried" +
                  (beyond ? ", those beyond the plan among them," : "") + " are excluded (proved)";
    if (answered) {
        add("Effect", answer_clause(v) + count + (v.interrupted && !all.empty() ? "; " + all : ""));
    } else if (v.answer == answer_kind::unexplained) {
        add("Effect", "no candidate was found that explains the data" +
                          (all.empty() ? "" : " (" + all + ")") + "; nothing is forced to fit" +
                          count);
    } else if (v.answer == answer_kind::open) {
        add("Effect", open_clause(v) + count);
    }
    add("Or else", alternatives_clause(v));
    if (v.answer == answer_kind::effects) {
        std::string const fit = shrink_clause(v.shrink_fit, "the data used for fitting");
        std::string const holdout = holdout_clause(v);
        add("Shrink", fit + (fit.empty() || holdout.empty() ? "" : "; ") + holdout);
    }
    add("Next", next_words(v));
    return t;
}

SIVID_DECL table places_table(diagnosis_view const& v, std::size_t most) {
    table t{.columns = {{"place", column_kind::symbol},
                        {"scenario"},
                        {"window [" + unit_text(v.time_unit) + "]"},
                        {"missing"},
                        {"its shape (estimate)"},
                        {"known by"},
                        {"explains as much", column_kind::note}}};
    for (suspected_place const& p : v.where) {
        if (t.rows.size() == most) break;
        std::string const span = p.where.from < p.where.to
                                     ? given_text(p.where.from) + " to " + given_text(p.where.to)
                                     : "";
        std::string shape = law_text(p.law);
        shape += p.regime.empty() ? "" : (shape.empty() ? "where " : ", where ") + p.regime;
        t.rows.push_back({place_name(p), p.where.scenario, span, missing_text(p), shape,
                          std::string{p.proved ? proved_mark : estimate_mark},
                          enumeration(p.alternatives, " or ")});
    }
    if (v.where.size() > most) {
        t.caption = "The first " + count_text(most) + " of " + count_text(v.where.size()) + ".";
    }
    return t;
}

SIVID_DECL table gap_shares_table(diagnosis_view const& v) {
    table t{.columns = {{"scenario or channel", column_kind::symbol},
                        {"proved", column_kind::number},
                        {"best fit (estimate)", column_kind::number}},
            .caption = "The factor by which the bounds of this scenario or channel must grow."};
    auto const add = [&](std::string const& kind, named_estimate const& s) {
        t.rows.push_back({kind + s.name, says_something(s.hull) ? inflation_text(s.hull) : "",
                          is_fitted(s.value) ? estimate_text(s.value) : ""});
    };
    for (named_estimate const& s : v.scenario_inflation) add("scenario ", s);
    for (named_estimate const& s : v.channel_inflation) add("channel ", s);
    return t;
}

SIVID_DECL std::string kept_together(std::string const& text) {
    std::string out;
    for (char const c : text) out += c == ' ' ? std::string{"\xC2\xA0"} : std::string(1, c);
    return out;
}

SIVID_DECL table causes_table(diagnosis_view const& v, std::size_t most) {
    table t{.columns = {{"candidate"},
                        {"verdict"},
                        {"parameter"},
                        {"value", column_kind::number},
                        {"proved range", column_kind::number},
                        {"prior", column_kind::number},
                        {"unit"}}};
    auto const answer = answer_of(v);
    for (cause const* c : foremost(v, most)) {
        bool first = true;
        for (auto const& [e, verified] : parameters_of(*c)) {
            if (c == answer && first) t.chosen_row = t.rows.size();
            t.rows.push_back({first ? names_of(c->effects) : "",
                              first ? kept_together(std::string{state_sign(c->verdict)} + ' ' +
                                                    std::string{state_words(c->verdict)})
                                    : "",
                              e.name, value_text(e, verified), hull_text(e),
                              e.prior ? given_text(e.prior) : "",
                              kept_together(unit_text(e.unit))});
            first = false;
        }
    }
    t.caption = t.rows.empty() ? "" : std::string{value_note};
    return t;
}

SIVID_DECL std::string value_text(named_estimate const& e, bool verified) {
    if (!std::isfinite(e.value)) return "?";
    return verified ? rounded_text(e.value, rounding::nearest) + " \xE2\x9C\x93"
                    : estimate_text(e.value);
}

SIVID_DECL table constants_table(diagnosis_view const& v) {
    table t{.columns = {{"constant", column_kind::symbol},
                        {"value", column_kind::number},
                        {"proved range", column_kind::number},
                        {"prior", column_kind::number},
                        {"unit"},
                        {"to be noted", column_kind::note}}};
    for (named_estimate const& e : v.constants) {
        auto const end =
            std::find_if(v.at_ends.begin(), v.at_ends.end(), [&](constant_at_end const& a) {
                return a.constant.name == e.name && a.constant.value == e.value;
            });
        t.rows.push_back({e.name, value_text(e, v.constants_verified), hull_text(e),
                          e.prior ? given_text(e.prior) : "", kept_together(unit_text(e.unit)),
                          end == v.at_ends.end() ? ""
                                                 : "at the " + std::string{to_string(end->end)} +
                                                       " end of its prior: widen it"});
    }
    for (named_combination const& k : v.combinations) {
        named_estimate const& e = k.about;
        t.rows.push_back({e.name, value_text(e, v.constants_verified), hull_text(e),
                          given_text(e.prior), kept_together(unit_text(e.unit)),
                          "the data tell this better than its parts"});
    }
    t.caption = t.rows.empty() ? "" : std::string{value_note};
    return t;
}

namespace detail {

/// A share of samples, in percent, rounded down: 99.96 is not all of them.
inline std::string counted_share(double share) {
    double const above = std::nextafter(share, HUGE_VAL); // of the quotient of two counts
    return rounded_text(above, rounding::down, {.significant = 3, .shift = 2}) + "\xC2\xA0%";
}

/// A tube without width was not computed.
inline bool has_tube(holdout_figures const& h) { return h.width_before > 0 || h.width_after > 0; }

} // namespace detail

SIVID_DECL table holdout_table(diagnosis_view const& v, holdout_figures const& h) {
    table t{.columns = {{"measure", column_kind::symbol},
                        {"model as it is", column_kind::number},
                        {"with the effect", column_kind::number},
                        {"known by"}}};
    auto const inflation = [](range const& r) {
        return says_something(r) ? inflation_text(r) : std::string{"not bounded"};
    };
    std::string const proved{proved_mark}, estimate{estimate_mark};
    if (says_something(h.inflation_before) || says_something(h.inflation_after)) {
        t.rows.push_back({"bounds must grow by", inflation(h.inflation_before),
                          inflation(h.inflation_after), proved});
    }
    if (says_something(h.over_fits_before) || says_something(h.over_fits_after)) {
        t.rows.push_back({"the same, for every parameter that fits", inflation(h.over_fits_before),
                          inflation(h.over_fits_after), proved});
    }
    if (says_shrink(v.shrink_holdout))
        t.rows.push_back({"gap removed", "", shrink_text(v.shrink_holdout), proved});
    auto const add = [&](std::string const& name, double before, double after, auto const& text) {
        auto const number = [&](double x) { return std::isfinite(x) ? text(x) : std::string{"?"}; };
        if (std::isfinite(before) || std::isfinite(after))
            t.rows.push_back({name, number(before), number(after), estimate});
    };
    auto const upward = [](double x) { return rounded_text(x, rounding::up); };
    auto const unit_of = [&](std::string const& name) {
        for (compared_scenario const& s : v.plots.scenarios)
            for (comparison_series const& c : s.channels)
                if (c.name == name) return c.unit;
        return std::string{};
    };
    auto const at = [](std::vector<double> const& all, std::size_t i) {
        return i < all.size() ? all[i] : std::nan("");
    };
    for (std::size_t i = 0; i < h.channels.size(); ++i) {
        add("RMSE of " + h.channels[i], at(h.rmse_before, i), at(h.rmse_after, i), [&](double x) {
            return rounded_text(x, rounding::nearest) + unit_suffix(unit_of(h.channels[i]));
        });
    }
    if (detail::has_tube(h)) {
        add("samples in the predicted tube", h.covered_before, h.covered_after,
            detail::counted_share);
        add("width of that tube, in bounds", h.width_before, h.width_after, upward);
    }
    return t;
}

SIVID_DECL table holdout_candidates_table(diagnosis_view const& v, std::size_t most) {
    table t{.columns = {{"candidate"},
                        {"bounds must grow by (proved)", column_kind::number},
                        {"samples in its tube (estimate)", column_kind::number},
                        {"width of the tube, in bounds (estimate)", column_kind::number}},
            .caption = "A wide tube covers much and says little."};
    for (cause const* c : foremost(v, v.causes.size())) {
        if (!c->holdout || t.rows.size() == most) continue;
        holdout_figures const& h = *c->holdout;
        if (c == answer_of(v)) t.chosen_row = t.rows.size();
        t.rows.push_back(
            {names_of(c->effects),
             says_something(h.inflation_after) ? inflation_text(h.inflation_after) : "not bounded",
             detail::has_tube(h) ? detail::counted_share(h.covered_after) : "",
             detail::has_tube(h) ? rounded_text(h.width_after, rounding::up) : ""});
    }
    return t.rows.size() > 1 ? t : table{};
}

} // namespace sivid::report

#endif
