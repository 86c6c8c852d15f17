// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DETAIL_DIAGNOSIS_TABLES_HPP
#define SIVID_REPORT_DETAIL_DIAGNOSIS_TABLES_HPP

#include <sivid/report/diagnosis_words.hpp>
#include <sivid/report/draw/charts.hpp>
#include <sivid/report/draw/time_plot.hpp>
#include <sivid/report/page.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Key figures, tables, figures and advice of a diagnosis's page; what has nothing to show is
/// empty.
namespace sivid::report {

/// What marks the values of constants mean.
inline constexpr std::string_view value_note =
    "\xE2\x9C\x93: of the witness, one point that is verified to explain the data; "
    "\xE2\x89\x88: of the best fit, an estimate. The proved range contains every value that "
    "explains the data; not narrowed: it is the prior itself.";

// The figures of a diagnosis's page; one without panels has nothing to show.

/// A value with its mark.
/// @param verified  as for `estimate_words`
inline std::string value_text(named_estimate const& e, bool verified) {
    if (!std::isfinite(e.value)) return "?";
    return verified ? rounded_text(e.value, rounding::nearest) + " \xE2\x9C\x93"
                    : estimate_text(e.value);
}

/// Candidates other than the model as it is.
inline std::size_t effects_tried(diagnosis_view const& v) {
    return static_cast<std::size_t>(std::count_if(
        v.causes.begin(), v.causes.end(), [](cause const& c) { return !c.effects.empty(); }));
}

inline std::vector<card> diagnosis_cards(diagnosis_view const& v) {
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
        out.push_back({"time", duration_text(v.seconds),
                       v.by_clock      ? "the clock ended it: a faster machine may say more"
                       : v.interrupted ? "stopped early"
                                       : ""});
    }
    return out;
}

/// The answer point by point, for the reader in a hurry.
inline table summary_table(diagnosis_view const& v) {
    table t{.columns = columns("*in short|answer")};
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
    std::string const all = tried_text(v.tried);
    std::size_t const planned = v.tried.planned();
    bool const beyond = planned > 0 && tried > planned;
    std::string const count = tried == 0
                                  ? ""
                                  : "; " + count_text(effects_excluded(v)) + " of the " +
                                        count_text(tried) + " candidates tried" +
                                        (beyond ? ", those beyond the plan among them," : "") +
                                        " are excluded (proved)";
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

inline table places_table(diagnosis_view const& v, std::size_t most = 20) {
    table t{.columns = columns("*place|scenario|window [" + unit_text(v.time_unit) +
                               "]|missing|its shape (estimate)|known by|~explains as much")};
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

inline table gap_shares_table(diagnosis_view const& v) {
    table t{.columns = columns("*scenario or channel|#proved|#best fit (estimate)"),
            .caption = "The factor by which the bounds of this scenario or channel must grow."};
    auto const add = [&](std::string const& kind, named_estimate const& s) {
        t.rows.push_back({kind + s.name, says_something(s.hull) ? inflation_text(s.hull) : "",
                          is_fitted(s.value) ? estimate_text(s.value) : ""});
    };
    for (named_estimate const& s : v.scenario_inflation) add("scenario ", s);
    for (named_estimate const& s : v.channel_inflation) add("channel ", s);
    return t;
}

/// The text with spaces that do not break.
inline std::string kept_together(std::string const& text) {
    std::string out;
    for (char const c : text) out += c == ' ' ? std::string{"\xC2\xA0"} : std::string(1, c);
    return out;
}

/// Parameters of the foremost candidates.
inline table causes_table(diagnosis_view const& v, std::size_t most = 12) {
    table t{.columns = columns("candidate|verdict|parameter|#value|#proved range|#prior|unit")};
    auto const answer = answer_of(v);
    for (cause const* c : foremost(v, most)) {
        auto const look = look_of(c->verdict);
        bool first = true;
        for (auto const& [e, verified] : parameters_of(*c)) {
            if (c == answer && first) t.chosen_row = t.rows.size();
            t.rows.push_back(
                {first ? names_of(c->effects) : "",
                 first ? kept_together(std::string{look.sign} + ' ' + std::string{look.words}) : "",
                 e.name, value_text(e, verified), hull_text(e), e.prior ? given_text(e.prior) : "",
                 kept_together(unit_text(e.unit))});
            first = false;
        }
    }
    t.caption = t.rows.empty() ? "" : std::string{value_note};
    return t;
}

/// Every constant of the model of the answer, its own and those of the effects.
inline table constants_table(diagnosis_view const& v) {
    table t{.columns = columns("*constant|#value|#proved range|#prior|unit|~to be noted")};
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

/// How well the hold-out data are met, before and after.
inline table holdout_table(diagnosis_view const& v, holdout_figures const& h) {
    table t{.columns = columns("*measure|#model as it is|#with the effect|known by")};
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
            for (channel_series const& c : s.channels)
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

/// Candidates side by side on the hold-out data; only when there are several.
inline table holdout_candidates_table(diagnosis_view const& v, std::size_t most = 8) {
    table t{.columns = columns("candidate|#bounds must grow by (proved)|#samples in its tube "
                               "(estimate)|#width of the tube, in bounds (estimate)"),
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

/// One pair of maps for each scenario, all with the same colours.
inline figure misfit_figure(diagnosis_view const& v) {
    struct pair {
        std::string name;
        heat_map before, after;
    };
    std::vector<pair> maps;
    double largest = 0;
    for (compared_scenario const& s : v.plots.scenarios) {
        pair p{s.name + (s.holdout ? " (held out)" : ""), misfit_map(s.channels, false),
               misfit_map(s.channels, true)};
        largest = std::max({largest, largest_value(p.before), largest_value(p.after)});
        if (!p.before.times.empty() || !p.after.times.empty()) maps.push_back(std::move(p));
    }
    figure f{.title = "Misfit over time.",
             .caption = "Largest |residual| / bound of the best fit (estimate) in each time span: "
                        "blue is within the bounds, orange with a cross beyond, hatched without a "
                        "sample. Suspected outliers are left out. All maps share one colour scale.",
             .layout = panel_layout::pair};
    constexpr std::size_t longest = 44; // beside the name, in the width of a panel
    auto after = after_words(v);
    if (after.size() > longest) after = "with these effects";
    for (pair const& p : maps) {
        heat_map_options o{.title = {}, .largest = largest, .key = f.panels.empty()};
        if (!p.before.times.empty()) {
            o.title = p.name + ": model as it is";
            f.panels.push_back(draw_heat_map(p.before, o));
        }
        if (!p.after.times.empty()) {
            o.title = p.name + ": " + after;
            f.panels.push_back(draw_heat_map(p.after, o));
        }
    }
    return f;
}

/// One figure for each equation, with a panel for each scenario, all on one scale.
/// @param still  how the title goes on, "with rudder_lag"
inline std::vector<figure> missing_rate_figures(std::vector<missing_rate> const& rates,
                                                std::string const& still = {}) {
    std::map<std::string, std::size_t> place; // of each equation's figure
    std::vector<std::vector<channel_series>> all;
    std::vector<std::vector<std::string>> scenarios;
    std::vector<figure> out;
    for (missing_rate const& m : rates) {
        auto const [at, is_new] = place.emplace(m.equation, all.size());
        if (is_new) {
            all.emplace_back(), scenarios.emplace_back();
            out.push_back({.title = "Missing in the " + m.equation + " equation" +
                                    (still.empty() ? "." : ", " + still + "."),
                           .caption = "The curve is an estimate. A box spans a window and the "
                                      "proved bounds of the mean over it; one that does not touch "
                                      "zero proves that something is missing there."});
        }
        auto& own = all[at->second].emplace_back(m.rate);
        own.name = "missing in " + m.equation;
        own.zero = true;
        scenarios[at->second].push_back(m.scenario);
    }
    for (std::size_t k = 0; k < out.size(); ++k) {
        range values;
        for (auto const& c : all[k]) values = hull(values, value_range(c));
        out[k].legend = time_plot_legend(all[k]);
        for (std::size_t i = 0; i < all[k].size(); ++i)
            out[k].panels.push_back(
                draw_time_plot(all[k][i], {.title = scenarios[k][i], .values = values}));
    }
    return out;
}

/// The channels of one scenario with both models' lines.
inline figure motion_figure(compared_scenario const& s) {
    range time;
    bool both = false;
    for (channel_series const& c : s.channels) {
        both = both || !c.after.empty();
        time = hull(time, time_range(c));
    }
    figure f{.title = "Scenario " + s.name + (both ? ", before and after." : "."),
             .caption =
                 s.holdout
                     ? "Held-out data: neither the effect nor the parameters were chosen by them."
                     : ""};
    for (channel_series const& c : s.channels) {
        f.panels.push_back(draw_time_plot(c, {.title = c.name, .time = time}));
    }
    return f;
}

/// What is left of the gap with each of the foremost candidates.
inline figure candidate_figure(diagnosis_view const& v, std::size_t most = 25) {
    auto const shown = foremost(v, most);
    std::vector<candidate_bar> bars;
    for (cause const* c : shown) {
        bars.push_back({names_of(c->effects), c->verdict, c->inflation, c->fitted_inflation,
                        c == answer_of(v)});
    }
    if (bars.empty()) return {};
    return {.panels = {draw_candidate_chart(bars)},
            .legend = candidate_legend(bars),
            .title = "What is left of the gap with each candidate.",
            .caption = std::string{"Best first; the answer is set off. \xE2\x9C\x93 proved to "
                                   "explain all data, \xE2\x9C\x95 proved not to for any value in "
                                   "the prior, ? open. \xE2\x89\x88 marks an estimate. A bar also "
                                   "says what other error bounds would change. With all bounds "
                                   "times a factor below its solid end the candidate is refuted; "
                                   "times one above its hatched end it explains the data. Both "
                                   "are proved."} +
                       (shown.size() < v.causes.size()
                            ? " Shown are " + count_text(shown.size()) + " of " +
                                  count_text(v.causes.size()) + " candidates."
                            : ""),
            .layout = panel_layout::wide};
}

namespace detail {

/// The largest of some misfits.
struct largest_misfit {
    channel_series const* channel = nullptr;
    double time = 0, bounds = 0; ///< how many error bounds

    void look_at(channel_series const& c, std::vector<point> const& misfits) {
        for (auto const& [t, m] : misfits) {
            if (std::isfinite(m) && m > bounds) channel = &c, time = t, bounds = m;
        }
    }
    /// In the unit of its channel.
    [[nodiscard]] double size() const {
        for (auto const& s : channel->measured)
            if (s.time == time) return bounds * (s.value.hi - s.value.lo) / 2;
        return std::nan("");
    }
};

/// What is wrong with measurements that alone stand against the model.
inline std::string instrument_advice(confined_gap const& c) {
    auto const part = part_words(c);
    auto const stated = "state error bounds of " + part;
    if (c.steps)
        return stated + " that are wider by " + (c.steps->cut_off ? "a" : "half a") +
               " step of its readings, or read it more finely";
    if (c.grows && c.grows->what == noise_growth::with::rate)
        return "look at the time stamps of " + part + ", or " + stated +
               " that grow with how fast it changes";
    if (c.grows) return "calibrate " + part + ", or " + stated + " that grow with what it shows";
    if (!c.channel.empty())
        return "look at the instrument of " + part + ", or " + stated + " that are " +
               inflation_text(c.factor) + " times as wide";
    return "look at what was different in " + part + ": all else is explained without it";
}

/// Candidates that explain the data without the answer being a part of them.
inline std::vector<std::string> other_explanations(diagnosis_view const& v) {
    std::vector<std::string> names;
    for (cause const& c : v.causes) {
        bool const explains = c.verdict == cause_verdict::explains ||
                              (c.verdict == cause_verdict::undecided &&
                               is_fitted(c.fitted_inflation) && c.fitted_inflation <= 1);
        bool const more = std::all_of(v.effects.begin(), v.effects.end(), [&c](auto const& e) {
            return std::find(c.effects.begin(), c.effects.end(), e) != c.effects.end();
        });
        if (explains && !more && !c.effects.empty()) names.push_back(names_of(c.effects));
    }
    return names;
}

} // namespace detail

/// The parameters of the answer by the symbols of its formulas, with what is proved of them.
inline table change_table(diagnosis_view const& v) {
    table t{.columns = columns("*symbol|#value|#proved range|unit|~of")};
    cause const* const c = answer_of(v);
    if (c == nullptr) return t;
    for (auto const& [e, verified] : parameters_of(*c)) {
        auto const symbol = v.change.symbols.find(e.name);
        if (symbol == v.change.symbols.end()) continue;
        auto const dot = e.name.rfind('.');
        t.rows.push_back({symbol->second, value_text(e, verified), hull_text(e),
                          kept_together(unit_text(e.unit)), name_of(e.name.substr(0, dot))});
    }
    return t;
}

/// What the model as it is misses most in each scenario, and what the answer leaves there; of best
/// fits.
inline table cost_table(diagnosis_view const& v) {
    table t{.columns = columns("*scenario|most off|#at [" + unit_text(v.time_unit) +
                               "]|#by|#in error bounds|#with it, at most"),
            .caption =
                "Of best fits (estimates). With it: the largest misfit of any channel there, "
                "in error bounds."};
    for (compared_scenario const& s : v.plots.scenarios) {
        detail::largest_misfit before, after;
        for (channel_series const& c : s.channels) {
            before.look_at(c, c.misfit_before);
            after.look_at(c, c.misfit_after);
        }
        if (before.channel == nullptr) continue;
        auto const number = [](double x) { return rounded_text(x, rounding::nearest); };
        t.rows.push_back(
            {s.name + (s.holdout ? " (held out)" : ""), before.channel->name,
             given_text(before.time), number(before.size()) + unit_suffix(before.channel->unit),
             number(before.bounds), after.channel == nullptr ? "" : number(after.bounds)});
    }
    return t;
}

/// What to do where no effect is the answer, or beside it; each a sentence.
inline std::vector<std::string> advice_lines(diagnosis_view const& v) {
    std::vector<std::string> lines;
    auto const add = [&lines](std::string const& text) {
        if (!text.empty()) lines.push_back(capitalised(text) + (text.back() == '.' ? "" : "."));
    };
    bool const answered = v.answer == answer_kind::effects && !v.effects.empty();
    if (v.gap == gap_verdict::none)
        add("nothing has to be added: the model explains all data of the fit");
    if (v.answer == answer_kind::open)
        add("give it more time: a larger --budget tries the candidates that are left");
    if (!answered)
        for (auto const& c : v.confined) add(detail::instrument_advice(c));
    if (v.answer == answer_kind::unexplained) {
        auto const& places =
            v.remainder && !v.remainder->where.empty() ? v.remainder->where : v.where;
        if (v.confined.empty() && !places.empty())
            add("look for an effect of your own in " +
                std::string(places.front().kind == "equation" ? "the " : "") +
                place_name(places.front()) +
                (places.front().where.scenario.empty()
                     ? ""
                     : " (" + window_text(places.front().where, v.time_unit) + ")") +
                ": nothing that was tried explains what is missing there");
        if (v.confined.empty() && places.empty())
            add("nothing that was tried explains the data, and no place stands out: look at error "
                "bounds and priors, or measure more channels");
    }
    for (constant_at_end const& e : v.at_ends) add(end_words(e));
    constexpr std::size_t most = 3;
    auto others = detail::other_explanations(v);
    if (answered && others.empty() && v.indistinguishable.empty()) {
        add("no other candidate was found to explain all data" +
            (v.tried.complete()
                 ? std::string{", so no experiment has to tell explanations apart"}
                 : " (" + tried_text(v.tried) + "): a larger --budget tries the rest"));
    } else if (answered && !v.indistinguishable.empty()) {
        if (!v.next) add(alternatives_clause(v));
    } else if (answered) {
        auto const many = others.size();
        others.resize(std::min(many, most));
        add("other candidates explain all data in a best fit, too, but far less well on the whole "
            "(estimate): " +
            enumeration(others, many > most ? ", " : " and ") +
            (many > most ? " and " + count_text(many - most) + " more" : ""));
    }
    add(next_words(v));
    return lines;
}

/// "What to do now": what to add to a simulator, what it costs to leave it out, what to look at or
/// to measure next.
inline void add_advice(page& out, diagnosis_view const& v) {
    auto const lines = advice_lines(v);
    out.section("What to do now");
    if (!v.change.lines.empty()) {
        out.subsection("Add to the simulator");
        out.prose(
            "In this order: what is remembered, inputs and constants, rates (x' is that of x), "
            "sensors. Lines of one kind take effect together: on the right stands what was "
            "there before.");
        std::vector<std::string> formulas;
        for (auto const& f : v.change.lines) formulas.push_back(formula_text(f));
        out.bullets(formulas);
        out.add(change_table(v));
        if (!v.constants.empty())
            out.prose("The model's own constants go with it: take those of the table "
                      "\xE2\x80\x9C"
                      "All constants\xE2\x80\x9D.");
        out.subsection("What it costs to leave it out").add(cost_table(v));
        out.subsection("What to look at and to measure");
    }
    out.bullets(lines);
}

} // namespace sivid::report

#endif
