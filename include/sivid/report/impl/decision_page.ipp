// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_DECISION_PAGE_IPP
#define SIVID_REPORT_IMPL_DECISION_PAGE_IPP

#include <sivid/report/decision_page.hpp>

#include <sivid/decision/requirement.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/report/detail/stored_values.hpp>
#include <sivid/report/draw/charts.hpp>
#include <sivid/report/draw/paving_plot.hpp>
#include <sivid/report/draw/time_plot.hpp>
#include <sivid/report/identification_page.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>

namespace sivid::report {

namespace detail {

/// The tube in pieces for a drawing, each cell with its instants, and the simulated lines in it.
inline channel_series series_of(std::vector<double> const& times, predicted_tube const& tube,
                                decision_page_options const& o,
                                std::vector<std::vector<double>> simulated_line::*values,
                                std::size_t k) {
    channel_series c{.name = tube.name, .unit = tube.unit, .time_unit = tube.time_unit};
    for (std::size_t s = 1; s < tube.low.size(); s += 2) {
        range const value{std::min({tube.low[s - 1], tube.low[s], tube.low[s + 1]}),
                          std::max({tube.high[s - 1], tube.high[s], tube.high[s + 1]})};
        if (is_finite(value)) c.tube.push_back({times[s / 2], times[s / 2 + 1], value});
    }
    auto const add = [&](std::vector<point>& line, simulated_line const& l) {
        auto const& all = l.*values;
        for (std::size_t n = 0; n < std::min(all.size(), l.times.size()); ++n)
            if (k < all[n].size()) line.push_back({l.times[n], all[n][k]});
    };
    add(c.before, o.least_squares);
    add(c.after, o.single);
    return c;
}

inline std::vector<legend_entry> legend_of(std::vector<channel_series> const& all,
                                           decision_page_options const& o) {
    return time_plot_legend(all, {.tube = "all parameters and starts (proved)",
                                  .before = "least squares, not validated",
                                  .after = o.single_is});
}

/// What it took, behind the other key figures.
inline void add_effort(page& out, std::vector<card> cards, double seconds,
                       std::optional<std::uint64_t> parts, std::uint64_t integrations) {
    cards.push_back({"time", duration_text(seconds), ""});
    if (parts) cards.push_back({"parts", count_text(*parts), ""});
    cards.push_back({"integrations", count_text(integrations), "validated"});
    out.cards(cards);
}

/// What is proved of a robustness.
template <class Bounds>
std::string bounds_text(Bounds const& found) {
    range const r{found.low, found.high};
    return is_finite(r) ? outward_text(r) : "not bounded";
}

/// One value as it was given; a range outward.
inline std::string text_of(interval const& x) {
    return std::nextafter(x.lower(), HUGE_VAL) < x.upper() ? outward_text(x) : given_text(mid(x));
}

inline std::string named(std::vector<std::string> const& names, std::vector<double> const& x) {
    std::string text;
    for (std::size_t i = 0; i < std::min(x.size(), names.size()); ++i)
        text += (i == 0 ? "" : ", ") + names[i] + " = " + exact_text(x[i]);
    return text;
}

/// The states of a start that the scenario leaves open.
inline std::string start_of(prediction_problem const& p, std::vector<double> const& start) {
    std::vector<std::string> names;
    std::vector<double> values;
    for (std::size_t i = 0; i < start.size(); ++i) {
        auto const& side = p.initial[i];
        if (!(std::nextafter(side.lower(), HUGE_VAL) < side.upper())) continue; // one decimal
        names.push_back(p.model.about.states[i].name);
        values.push_back(start[i]);
    }
    return named(names, values);
}

inline void add_motions(page& out, prediction const& found, decision_page_options const& o) {
    std::vector<channel_series> all;
    for (std::size_t c = 0; c < found.channels.size(); ++c)
        all.push_back(series_of(found.times, found.channels[c], o, &simulated_line::channels, c));
    for (std::size_t i = 0; i < found.states.size(); ++i) {
        bool const shown =
            std::any_of(found.channels.begin(), found.channels.end(),
                        [&](auto const& c) { return c.name == found.states[i].name; });
        if (!shown)
            all.push_back(series_of(found.times, found.states[i], o, &simulated_line::states, i));
    }
    figure f{.legend = legend_of(all, o),
             .title = "The motion, for all parameters and starts.",
             .caption = std::string{"The band is proved: every motion of the model, for every "
                                    "parameter that the identification leaves and every start of "
                                    "the scenario, runs within it at every instant"} +
                        (found.complete ? "" : " at which there is one") +
                        ". The lines are simulated in floating point and prove nothing."};
    for (auto const& c : all) f.panels.push_back(draw_time_plot(c, {.title = c.name}));
    out.add(f);
}

/// The comparison's text, with a number where it has several sides: |x| < 1 has two.
inline std::string margin_title(std::vector<std::string> const& labels, std::size_t c) {
    if (c >= labels.size()) return "comparison";
    auto const place = labels.begin() + static_cast<std::ptrdiff_t>(c);
    auto const all = std::count(labels.begin(), labels.end(), *place);
    if (all == 1) return *place;
    return *place + " (" + std::to_string(1 + std::count(labels.begin(), place, *place)) + " of " +
           std::to_string(all) + ")";
}

/// The margins of all comparisons against zero.
inline void add_margins(page& out, requirement const& asked, prediction const& tubes,
                        decision_page_options const& o) {
    std::vector<channel_series> margins;
    for (std::size_t c = 0; c < tubes.further.size(); ++c) {
        auto m = series_of(tubes.times, tubes.further[c], o, &simulated_line::further, c);
        m.name = "margin";
        m.zero = m.margin = true;
        margins.push_back(std::move(m));
    }
    figure f{.legend = legend_of(margins, o),
             .title = "The margins of the comparisons, for all parameters and starts.",
             .caption = "A comparison holds where its margin is above 0, each of its margins if it "
                        "has several sides. The requirement's text says when it has to."};
    for (std::size_t c = 0; c < margins.size(); ++c)
        f.panels.push_back(draw_time_plot(margins[c], {.title = margin_title(asked.labels, c)}));
    out.section("The requirement against the tube").add(f);
}

/// The end of a page: the parameters that it speaks of, and what it rests on.
inline void add_basis(page& out, stored_prediction const& about, decision_page_options const& o,
                      std::vector<std::string> const& assumptions) {
    out.section("For which parameters");
    auto const around = about.problem.around();
    table t{.columns = columns("*quantity|#range")};
    for (std::size_t j = 0; j < around.size(); ++j)
        t.rows.push_back({formula_text(about.sides[j]), text_of(around[j])});
    t.caption = "The smallest ranges around the union of " + count_text(about.problem.sets.size()) +
                (about.in_products ? " boxes, in the products that the data fix."
                                   : " boxes of parameters.");
    out.add(t);
    if (!o.set.empty()) out.bullets(o.set);
    table starts{.columns = columns("*state|#start|unit")};
    auto const& states = about.problem.model.about.states;
    for (std::size_t i = 0; i < states.size(); ++i) {
        range const start = about.problem.initial[i];
        auto const low = given_text(start.lo);
        starts.rows.push_back({states[i].name,
                               low == given_text(start.hi) ? low : given_text(start),
                               unit_text(states[i].unit)});
    }
    out.add(starts);
    out.assumptions(assumptions);
    out.footer(o.footer);
}

inline std::string excluded_percent(subpaving const& paving) {
    using traits = interval_traits<interval>;
    auto const rest = traits::sub(traits::point(1.0), paving.outer_volume());
    return at_least_percent(std::clamp(rest.lower(), 0.0, 1.0));
}

/// The set of gains: pictures of pairs, or the ranges of a single one.
inline void add_gains(page& out, gain_set const& found) {
    out.section("The gains");
    auto const& paving = found.paving.paving;
    named_paving named{&paving, {}, {}, found.suggested.value_or(std::vector<double>{})};
    auto const hull = paving.outer_hull();
    for (std::size_t k = 0; k < found.names.size(); ++k) {
        named.sides.push_back({found.names[k], "", paving.prior()[k]});
        named.hull.push_back(hull[k]);
    }
    auto const pairs = projections(named, {}, 6);
    if (!pairs.empty()) {
        out.add(paving_figure(pairs, "Gains that meet the requirement.",
                              std::string{projection_rule} +
                                  " Proved means for every parameter that the identification "
                                  "leaves, every start, every instant.",
                              {"inside: proved for every parameter",
                               "outside: violated by a parameter that the data allow", "suggested",
                               "whole range"}));
        return;
    }
    table t{.columns = columns("#" + found.names[0] + "|~")};
    std::vector<paved_box const*> row;
    for (auto const& b : paving.boxes()) row.push_back(&b);
    std::sort(row.begin(), row.end(), [](paved_box const* a, paved_box const* b) {
        return a->set[0].lower() < b->set[0].lower();
    });
    for (std::size_t k = 0; k < row.size();) {
        auto const first = k;
        while (k < row.size() && row[k]->verdict == row[first]->verdict) ++k;
        range const r{row[first]->set[0].lower(), row[k - 1]->set[0].upper()};
        auto const says = row[first]->verdict == box_verdict::inside    ? "proved"
                          : row[first]->verdict == box_verdict::outside ? "violated"
                                                                        : "";
        // What is known holds within, what is not may reach further.
        auto const within = "[" + exact_text(r.lo) + ", " + exact_text(r.hi) + "]";
        t.rows.push_back(
            {*says != 0 ? inward_text(r, {.significant = 5}).value_or(within) : outward_text(r),
             *says != 0 ? says : "not decided"});
    }
    out.add(t);
}

inline std::string goal_texts(design_answer const& a) {
    if (a.goals.empty()) return a.first + " or " + a.second;
    auto const text = sivid::joined(a.goals, ", ", [](auto const& g) { return g.text; });
    return a.jointly ? "the volume in " + text : text;
}

/// The inputs of a manoeuvre over time.
inline void add_inputs(page& out, stored_prediction const& about, tried_manoeuvre const& m,
                       std::vector<varied_input> const& varied) {
    figure f{.title = "What to do.",
             .caption = "Straight lines between the samples of scenario.json; the promise is for "
                        "exactly these inputs."};
    for (auto const& u : varied) {
        auto const* const s = std::get_if<sampled_signal>(&m.inputs[u.index]);
        if (s == nullptr) continue;
        channel_series line{
            .name = u.name, .unit = u.unit, .time_unit = about.problem.model.about.time_unit};
        for (std::size_t k = 0; k < s->times().size(); ++k)
            line.after.push_back({s->times()[k], s->values()[k]});
        if (!line.after.empty() && line.after.back().x < about.problem.end)
            line.after.push_back({about.problem.end, s->values().back()});
        f.panels.push_back(draw_time_plot(line, {.title = u.name}));
    }
    table t{.columns = columns("setting|#value|unit")};
    for (std::size_t k = 0; k < m.about.size(); ++k)
        t.rows.push_back({m.about[k].name, given_text(m.settings[k]), unit_text(m.about[k].unit)});
    t.caption = "The shape \"" + m.name + "\". Rounded; design.json has them in full.";
    out.section("The experiment: " + m.name);
    out.add(f);
    out.add(t);
}

inline void add_promises(page& out, design_answer const& a, promise const& p) {
    if (a.goals.empty()) return; // the sentence says all
    table t{.columns = columns("*quantity|#width now|#at most afterwards|#share")};
    for (std::size_t g = 0; g < a.goals.size(); ++g) {
        auto const& w = p.goals[g];
        t.rows.push_back({a.goals[g].text, rounded_text(w.before, rounding::down),
                          "≤ " + rounded_text(w.after, rounding::up),
                          "≤ " + at_most_percent(w.factor())});
    }
    t.caption = "Whatever the truth among the parameters that the identification leaves, whatever "
                "the start and the errors within their bounds: all parameters that explain the new "
                "data together with the old ones lie so close (proved).";
    out.section("The promise").add(t);
}

inline void add_plan(page& out, stored_prediction const& about, design_answer const& a) {
    table t{.columns = columns("*channel|#error at most|unit")};
    auto const& channels = about.problem.model.about.channels;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        if (a.plan.errors[c] > 0)
            t.rows.push_back(
                {channels[c].name, given_text(a.plan.errors[c]), unit_text(channels[c].unit)});
    }
    t.caption = "Measured at " + count_text(a.plan.times.size()) + " instants, the last one at " +
                given_text(a.plan.times.back()) + unit_suffix(about.problem.model.about.time_unit) +
                ".";
    out.section("What is measured").add(t);
}

inline void add_tried(page& out, design_answer const& a) {
    table t{.columns =
                columns("shape|#estimate|#" +
                        std::string{a.goals.empty() ? "proof" : "proved share"} + "|limits")};
    for (auto const& m : a.found.tried)
        t.rows.push_back({m.name, rounded_text(m.estimate, rounding::nearest, {.significant = 2}),
                          !m.promised              ? "not asked"
                          : !a.goals.empty()       ? "≤ " + at_most_percent(m.factor())
                          : m.promised->told_apart ? "told apart"
                                                   : "not proved",
                          a.limits.empty() ? "none"
                          : m.limits       ? std::string{to_string(*m.limits)}
                                           : "not asked"});
    t.caption = std::string{"Each shape with its best settings. The estimate, of "} +
                (a.goals.empty() ? "the errors against those that would still tell, "
                                 : "the share that is left, ") +
                "treats outputs as linear about the middle: it chooses, and proves nothing. Shapes "
                "that cannot be run, or pass the limits in the middle, are left out.";
    out.section("What was tried").add(t);
}

/// What the equations hide, and what can be told.
inline std::string hidden_sentence(design_answer const& a) {
    std::string text = "The equations contain " + a.hidden +
                       " only together with other parameters, so that no input, no start and "
                       "no measurement tells it apart from them (proved)";
    if (!a.instead.empty()) text += ". What can be told: " + sivid::joined(a.instead);
    return text + ".";
}

/// What the data would lose without some of the measurements.
inline void add_worth(page& out, identification_problem const& about,
                      measurement_ranking const& found) {
    out.section("Which measurements matter");
    if (found.groups.empty()) {
        out.prose(found.explained == verdict::inconsistent
                      ? "No parameter explains all of the data: nothing can grow."
                      : "Nothing was compared.");
        return;
    }
    table t{.columns = columns("without|#measurements|what explains the rest grows")};
    std::vector<bar> bars;
    std::vector<std::string> idle;
    for (auto const& g : found.groups) {
        auto const name = group_text(about, g.what);
        t.rows.push_back({name, count_text(g.measurements), growth_text(g.growth)});
        if (g.changes_nothing()) {
            idle.push_back(name);
            continue;
        }
        using traits = interval_traits<interval>;
        auto const more = traits::mul(traits::sub(g.growth, traits::point(1)), traits::point(100));
        bars.push_back({.label = name, .value = {std::max(0.0, more.lower()), more.upper()}});
    }
    if (!idle.empty())
        out.prose("Nothing changes without any one of these, which follow from the others: " +
                  sivid::joined(idle, "; ") + ".");
    auto const sides = sivid::joined(found.coordinates);
    if (!bars.empty())
        out.add(
            figure{.panels = {draw_bar_chart(bars, {.title = "Growth without them",
                                                    .quantity = "what is added to the volume",
                                                    .unit = "%"})},
                   .title = "What is added to the set of parameters without a group of "
                            "measurements.",
                   .caption = "Volumes of " + sides +
                              ". Full up to what is proved to be added, hatched up to what may be.",
                   .layout = panel_layout::wide});
    out.add(t);
}

} // namespace detail

SIVID_DECL std::string answer_sentence(stored_prediction const& about, verification const& found) {
    range const r{found.found.low, found.found.high};
    switch (found.answer) {
    case requirement_answer::proved:
        return "It holds for every parameter that the identification leaves and every start of the "
               "scenario, at every instant" +
               std::string{is_finite(r) ? "; the robustness is within " + outward_text(r) : ""} +
               ".";
    case requirement_answer::refuted: {
        auto const& w = *found.witness;
        auto const start = detail::start_of(about.direct, w.start);
        return "Violated at " + detail::named(about.direct.choice.unknown, w.parameters) +
               ", which the data allow (proved by validated runs" +
               (about.feasible_with.empty() ? "" : "; " + about.feasible_with) + ")" +
               (start.empty() ? "" : ", from the start " + start) + ": its robustness is at most " +
               rounded_text(w.found.high, rounding::up) + ".";
    }
    case requirement_answer::open:
        break;
    }
    auto const& b = found.open.front();
    std::string text =
        "Neither proved nor refuted: " + count_text(found.open.size()) +
        (found.open.size() == 1 ? " box is open; " : " boxes are open; the largest ") + "is " +
        std::string{to_string(b.why)};
    if (b.why == open_reason::not_enclosed)
        text += " (motions are enclosed up to t = " + exact_text(b.reached) + " " +
                about.problem.model.about.time_unit + ")";
    text += ", at ";
    for (std::size_t j = 0; j < b.parameters.size(); ++j)
        text += (j > 0 ? ", " : "") + formula_text(about.sides[j]) + " in " +
                detail::text_of(b.parameters[j]);
    return text + ".";
}

SIVID_DECL std::vector<std::string> decision_assumptions(stored_prediction const& s) {
    std::vector<std::string> lines;
    lines.push_back("The identification's result is taken as it stands: what it excludes is "
                    "excluded. `check --all` proves that anew. A witness of a violation does not "
                    "rest on it.");
    for (auto const& a : s.assumptions) lines.push_back(a + ".");
    auto const& inputs = s.problem.inputs;
    bool const exact = std::none_of(inputs.begin(), inputs.end(), is_uncertain);
    lines.push_back(
        "The scenario's inputs " +
        std::string{exact ? "act exactly as stated" : "stay within their stated errors"} +
        ", and the model's equations hold in it.");
    if (!s.not_in_products.empty())
        lines.push_back("The products that the data fix do not tell this prediction (" +
                        s.not_in_products +
                        "): it is made in the parameters themselves, where "
                        "the result is drawn more coarsely.");
    return lines;
}

SIVID_DECL stored_page prediction_page(stored_prediction const& about, prediction const& found,
                                       decision_page_options const& o) {
    page out{{.kind = "Prediction",
              .title = o.scenario + ", from " + o.dataset,
              .lead = o.about.empty() ? "All motions that the identification leaves." : o.about}};
    out.banner(found.complete ? outcome::proved : outcome::undecided,
               found.complete ? "Proved for the whole scenario"
                              : "Proved up to t = " + exact_text(found.reached) + " " +
                                    about.problem.model.about.time_unit,
               found.complete
                   ? "Every motion runs within the tubes at every instant."
                   : "The enclosure ends before the scenario does, or has gaps: a smaller set of "
                     "parameters, more time (--budget) or a shorter scenario may help.");
    std::vector<card> cards;
    if (std::isfinite(found.excess))
        cards.push_back({"against what is reached", "≤ " + wider_text(found.excess),
                         "at the instants, by the parameters and starts themselves"});
    detail::add_effort(out, cards, found.seconds, found.parts, found.integrations);
    detail::add_motions(out, found, o);
    out.section("At the end");
    table t{.columns = columns("*quantity|#range|unit")};
    for (auto const& c : found.channels) {
        range const r{c.low.back(), c.high.back()};
        t.rows.push_back({c.name, is_finite(r) ? outward_text(r) : "not known", unit_text(c.unit)});
    }
    out.add(t);
    detail::add_basis(out, about, o, decision_assumptions(about));
    return detail::stored_as("prediction", "prediction", out, about, found, o);
}

SIVID_DECL stored_page verification_page(stored_prediction const& about, requirement const& asked,
                                         verification const& found, prediction const& tubes,
                                         decision_page_options const& o) {
    page out{
        {.kind = "Verification", .title = asked.text, .lead = o.scenario + ", from " + o.dataset}};
    bool const proved = found.answer == requirement_answer::proved;
    bool const refuted = found.answer == requirement_answer::refuted;
    out.banner(proved    ? outcome::proved
               : refuted ? outcome::refuted
                         : outcome::undecided,
               proved    ? "Proved"
               : refuted ? "Refuted"
                         : "Open",
               answer_sentence(about, found));
    card const robustness{
        "robustness",
        refuted ? "≤ " + rounded_text(found.witness->found.high, rounding::up)
                : detail::bounds_text(found.found),
        std::string{refuted ? "of the motion that violates it" : "of all motions"} +
            "; above 0 the requirement holds"};
    detail::add_effort(out, {robustness}, found.seconds, found.parts, found.integrations);
    detail::add_margins(out, asked, tubes, o);
    if (!found.open.empty()) {
        table t;
        for (auto const& side : about.sides)
            t.columns.push_back({formula_text(side), column_kind::number});
        t.columns.push_back({"robustness", column_kind::number});
        t.columns.push_back({"why", column_kind::note});
        for (std::size_t k = 0; k < std::min<std::size_t>(found.open.size(), 40); ++k) {
            auto const& b = found.open[k];
            std::vector<std::string> row;
            for (auto const& side : b.parameters) row.push_back(detail::text_of(side));
            row.push_back(detail::bounds_text(b.found));
            row.push_back(std::string{to_string(b.why)});
            t.rows.push_back(std::move(row));
        }
        if (found.open.size() > 40)
            t.caption = "The largest 40 of " + count_text(found.open.size()) + ".";
        out.section("Where it is open").add(t);
    }
    out.section("The motion");
    detail::add_motions(out, tubes, o);
    detail::add_basis(out, about, o, decision_assumptions(about));
    return detail::stored_as("verification", "verification", out, about, asked, found, tubes, o);
}

SIVID_DECL std::string gain_sentence(gain_set const& found) {
    auto const& paving = found.paving.paving;
    std::string const why{to_string(found.paving.reason)};
    if (found.none_exists())
        return "Every gain in the ranges violates the requirement for some parameter that the data "
               "allow: no law of this form meets it for all.";
    auto const excluded = detail::excluded_percent(paving);
    if (!found.some_proved())
        return "No gain is proved, and not all are excluded (" + why + "): at least " + excluded +
               " of the ranges are." +
               (found.unknown ? " Of some gains nothing is known, since what the requirement is "
                                "provided for is not kept, such as the slew limit."
                              : "") +
               (found.against.empty() ? " No parameter is known that violates it." : "");
    std::string text = "Proved for every parameter that the identification leaves and every start "
                       "of the scenario, at every instant: ";
    if (found.suggested) text += detail::named(found.names, *found.suggested);
    for (std::size_t k = 0; k < found.tolerance.size(); ++k)
        text += (k == 0 ? ", all around with " : ", ") + found.names[k] + " in " +
                inward_text(found.tolerance[k]).value_or("no range of a few digits");
    double const inner = paving.inner_volume().lower();
    if (inner > 0)
        text += (found.suggested ? ", at least " : "at least ") + at_least_percent(inner) +
                " of the ranges";
    if (paving.outer_volume().upper() < 1) text += "; at least " + excluded + " are excluded";
    return text + ".";
}

SIVID_DECL stored_page control_page(stored_prediction const& about, requirement const& asked,
                                    gain_set const& found, std::optional<verification> const& proof,
                                    std::optional<prediction> const& tubes,
                                    decision_page_options const& o) {
    page out{{.kind = "Control law",
              .title = o.law,
              .lead = asked.text + ". " + o.scenario + ", from " + o.dataset}};
    out.banner(found.some_proved()   ? outcome::proved
               : found.none_exists() ? outcome::refuted
                                     : outcome::undecided,
               found.some_proved()   ? "Gains are proved"
               : found.none_exists() ? "No gain will do"
                                     : "No gain is proved",
               gain_sentence(found));
    std::vector<card> cards;
    auto const& paving = found.paving.paving;
    cards.push_back(
        {"proved", at_least_percent(paving.inner_volume().lower()), "of the ranges of the gains"});
    cards.push_back({"excluded", detail::excluded_percent(paving),
                     "each violates it for a parameter that the data allow"});
    if (proof)
        cards.push_back({"robustness", "≥ " + rounded_text(proof->found.low, rounding::down),
                         "of the suggested gains"});
    detail::add_effort(out, cards, found.seconds, {}, found.integrations);
    detail::add_gains(out, found);
    if (found.suggested && proof) {
        out.section("With " + detail::named(found.names, *found.suggested));
        out.prose(answer_sentence(about, *proof));
        if (tubes) {
            detail::add_margins(out, asked, *tubes, o);
            detail::add_motions(out, *tubes, o);
        }
    }
    if (!found.against.empty()) {
        out.section("What excludes gains");
        table t;
        for (auto const& name : about.direct.choice.unknown)
            t.columns.push_back({name, column_kind::number});
        t.columns.push_back({"robustness", column_kind::number});
        for (auto const& w : found.against) {
            std::vector<std::string> row;
            for (double const x : w.parameters) row.push_back(rounded_text(x, rounding::nearest));
            row.push_back("≤ " + rounded_text(w.found.high, rounding::up));
            t.rows.push_back(std::move(row));
        }
        t.caption = "Parameters that the data allow (proved by validated runs), each with a gain "
                    "under which it violates the requirement. Every excluded box of gains "
                    "violates it for one of them. Rounded; control.json has them in full.";
        out.add(t);
    }
    detail::add_basis(out, about, o, decision_assumptions(about));
    return detail::stored_as("control", "control", out, about, asked, found, proof, tubes, o);
}

SIVID_DECL std::string design_headline(design_answer const& a) {
    auto const goals = detail::goal_texts(a);
    if (a.impossible) return "no experiment tells " + a.hidden;
    if (a.goals.empty())
        return (a.met() ? "an experiment that tells " : "no proved experiment that tells ") +
               a.first + " from " + a.second + (a.met() ? " is found" : "");
    if (a.met()) return "an experiment for " + goals + " is found";
    if (a.found.best() == nullptr) return "no experiment for " + goals + " is proved";
    return "an experiment for " + goals + " is found, which promises less than was asked";
}

SIVID_DECL std::string design_sentence(design_answer const& a) {
    if (a.impossible)
        return detail::hidden_sentence(a) + " Whatever is measured, it keeps more than " +
               given_text(100 * a.target) + " % of the width that it has now (proved).";
    if (!a.hidden.empty()) {
        auto plain = a;
        plain.hidden.clear();
        return design_sentence(plain) + " " + detail::hidden_sentence(a) +
               " Data narrow it no further than the others are known.";
    }
    auto const* const best = a.found.best();
    if (best == nullptr)
        return a.found.tried.empty()
                   ? "No shape in these limits could be followed within them in the middle of the "
                     "parameters: give wider limits, a shorter scenario, or more time."
                   : "No shape whose limits are kept for all parameters has a proved promise: give "
                     "wider limits or more time.";
    if (a.goals.empty())
        return a.met() ? "Whatever the truth among the parameters of both and whatever the errors "
                         "are, its data refute all of " +
                             a.first + " or all of " + a.second + " (proved)."
                       : "No shape in these limits is proved to: give wider limits, a longer "
                         "experiment, smaller errors, or more time.";
    std::string text;
    for (std::size_t g = 0; g < a.goals.size(); ++g) {
        auto const& w = best->promised->goals[g];
        text += (g == 0 ? "Whatever the truth and the errors are, all that explains the data will "
                          "differ in "
                        : ", in ") +
                a.goals[g].text + " by at most " + rounded_text(w.after, rounding::up) + ", " +
                at_most_percent(w.factor()) + " of the " + rounded_text(w.before, rounding::down) +
                " of now";
    }
    if (a.jointly)
        text += "; the box of these has at most " + at_most_percent(best->factor()) +
                " of the volume of now";
    return text + " (proved).";
}

SIVID_DECL stored_page design_page(stored_prediction const& about, design_answer const& a,
                                   std::optional<prediction> const& tubes,
                                   decision_page_options const& o) {
    page out{{.kind = "Design of an experiment",
              .title = detail::goal_texts(a),
              .lead = o.scenario + ", from " + o.dataset +
                      (a.limits.empty() ? std::string{} : ", within " + a.limits)}};
    bool const hidden = a.impossible;
    auto headline = design_headline(a);
    headline.front() = static_cast<char>(std::toupper(headline.front()));
    out.banner(hidden    ? outcome::refuted
               : a.met() ? outcome::proved
                         : outcome::undecided,
               headline, design_sentence(a));
    auto const* const best = a.found.best();
    if (!hidden) {
        std::vector<card> cards;
        if (best != nullptr && !a.goals.empty())
            cards.push_back({"left", "≤ " + at_most_percent(best->factor()),
                             a.goals.size() == 1 ? "of the width" : "of the volume"});
        cards.push_back({"settings looked at", count_text(a.found.simulated), ""});
        cards.push_back({"time", duration_text(a.found.seconds), ""});
        out.cards(cards);
    }
    if (best != nullptr && (a.met() || !a.goals.empty())) {
        detail::add_promises(out, a, *best->promised);
        detail::add_inputs(out, about, *best, a.varied);
        detail::add_plan(out, about, a);
        if (tubes) detail::add_motions(out, *tubes, o);
    }
    if (!a.found.tried.empty()) detail::add_tried(out, a);
    auto assumptions = decision_assumptions(about);
    if (!hidden)
        assumptions.push_back("The errors of the new measurements stay within the bounds that are "
                              "stated here.");
    detail::add_basis(out, about, o, assumptions);
    return detail::stored_as("design", "design", out, about, a, tubes, o);
}

SIVID_DECL std::string effect_text(parameter_effect const& e) {
    if (e.high == 0) return "0";
    if (e.high < 0.01) return "< 0.01";
    if (!std::isfinite(e.high)) return "from " + rounded_text(e.low, rounding::down);
    double const more = 5e-4 * e.high; // so that close bounds read well
    return outward_text({std::max(0.0, e.low - more), e.high + more}, {.significant = 2});
}

SIVID_DECL std::vector<std::string> ranking_sentences(identification_problem const& about,
                                                      ranking const& found) {
    std::vector<std::string> lines;
    auto const& names = about.choice.unknown;
    for (std::size_t j = 0; j < names.size(); ++j) {
        auto const most = found.overall(j);
        if (!found.acts(j)) {
            lines.push_back(names[j] +
                            " cannot matter: no equation carries it to a measured channel.");
        } else if (most.upper() < 1 && !found.moves_exact(j)) {
            lines.push_back(names[j] + " alone moves no measurement by more than " +
                            rounded_text(most.upper(), rounding::up) + " error bounds.");
        }
    }
    for (auto const& m : found.exact)
        lines.push_back(about.model.about.channels[m.channel].name + " of " +
                        about.experiments[m.experiment].name + ": " + count_text(m.count) +
                        (m.count == 1 ? " measurement does" : " measurements do") +
                        " not count, as the bounds have no width.");
    auto const& products = found.combinations;
    if (!products.entangled.empty()) {
        std::string text;
        for (auto const j : products.entangled) {
            if (found.moves_exact(j) || !(found.overall(j).upper() < 1))
                text += (text.empty() ? "" : ", ") + names[j];
        }
        if (text.empty()) return lines;
        text += " matter in combination only: no measurement tells them apart beyond ";
        auto const formula = [](auto const& c) { return c.formula; };
        lines.push_back(text + sivid::joined(products.combinations, ", ", formula) + ".");
    }
    return lines;
}

SIVID_DECL std::string group_text(identification_problem const& about,
                                  measurement_group const& group) {
    std::string what, when;
    if (group.channel) what = about.model.about.channels[*group.channel].name;
    if (group.experiment)
        what += (what.empty() ? "" : " of ") + about.experiments[*group.experiment].name;
    auto const second = [](double t) { return exact_text(t); }; // measurements may be close by
    auto const& unit = about.model.about.time_unit;
    bool const from = std::isfinite(group.from), to = std::isfinite(group.to);
    if (from && to)
        when = second(group.from) + " to " + second(group.to) + " " + unit;
    else if (from || to)
        when = from ? "from " + second(group.from) + " " + unit + " on"
                    : "before " + second(group.to) + " " + unit;
    if (what.empty()) return from && to ? when : "all " + when;
    return what + (when.empty() ? "" : ", " + when);
}

SIVID_DECL std::string growth_text(interval const& growth) {
    if (growth.upper() == 1) return "nothing changes";
    auto const low = rounded_text(growth.lower(), rounding::down);
    if (!std::isfinite(growth.upper()))
        return growth.lower() > 1 ? "at least " + low + " times" : "not bounded";
    auto const high = rounded_text(growth.upper(), rounding::up);
    return growth.lower() > 1 ? low + " to " + high + " times" : "at most " + high + " times";
}

SIVID_DECL stored_page ranking_page(identification_problem const& about, ranking const& found,
                                    decision_page_options const& o,
                                    std::optional<measurement_ranking> const& measurements) {
    page out{{.kind = "Ranking",
              .title = o.scenario.empty() ? o.dataset : o.scenario,
              .lead = "How far can each parameter alone move the measurements?"}};
    out.banner(found.complete ? outcome::proved : outcome::undecided,
               found.complete ? "Proved from both sides" : "Proved, some bounds still apart",
               "Over the whole prior: all values of the other parameters, all starts.");
    out.cards({{"time", duration_text(found.seconds), ""},
               {"parts", count_text(found.parts), "of the prior"},
               {"integrations", count_text(found.integrations), "validated"}});
    if (auto const lines = ranking_sentences(about, found); !lines.empty()) out.bullets(lines);
    out.section("Effects");
    figure f{.title = "The largest effects, in error bounds.",
             .caption = "Full up to what a pair of validated runs reaches, hatched up to what is "
                        "proved never to be passed. Below 1 a parameter moves no measurement of "
                        "the channel by its error bound.",
             .layout = panel_layout::wide};
    table t{.columns = columns("experiment|*channel|*parameter|#effect|place")};
    for (auto const& c : found.channels) {
        auto const& experiment = about.experiments[c.experiment].name;
        auto const& channel = about.model.about.channels[c.channel].name;
        std::vector<bar> bars;
        for (auto const j : c.order()) {
            auto const& e = c.effects[j];
            auto const& name = about.choice.unknown[j];
            if (e.high > 0) bars.push_back({.label = name, .value = {e.low, e.high}});
            auto const place = c.place_of(j);
            auto text = std::to_string(place.best);
            if (place.worst > place.best) text += " to " + std::to_string(place.worst);
            t.rows.push_back({experiment, channel, name, effect_text(e), text});
        }
        if (bars.empty()) continue;
        f.panels.push_back(draw_bar_chart(bars, {.title = channel + ", " + experiment,
                                                 .quantity = "effect",
                                                 .unit = "error bounds",
                                                 .threshold = 1,
                                                 .threshold_label = "1"}));
    }
    out.add(f);
    t.caption = "Place: among the parameters; one number where the bounds certify it.";
    out.add(t);
    if (measurements) detail::add_worth(out, about, *measurements);
    out.section("Over what");
    table prior{.columns = columns("*parameter|#prior")};
    for (std::size_t j = 0; j < about.prior.size(); ++j)
        prior.rows.push_back({about.choice.unknown[j],
                              outward_text({about.prior[j].lower(), about.prior[j].upper()})});
    out.add(prior);
    out.assumptions(
        {input_assumption(about.experiments) + ".",
         "Effects: at the instants of the measurements, against half the width of their "
         "bounds; what was measured does not enter."});
    out.footer(o.footer);
    return detail::stored_as("ranking", "ranking", out, about, found, o, measurements);
}

} // namespace sivid::report

#endif
