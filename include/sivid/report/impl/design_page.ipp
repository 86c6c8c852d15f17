// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_DESIGN_PAGE_IPP
#define SIVID_REPORT_IMPL_DESIGN_PAGE_IPP

#include <sivid/report/design_page.hpp>

#include <sivid/compiled.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/report/identification_words.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/page/detail/decision_figures.hpp>
#include <sivid/report/table.hpp>

#include <cctype>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid::report {

namespace detail {

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
        motion_series line;
        line.tube.name = u.name;
        line.tube.unit = u.unit;
        line.tube.time_unit = about.problem.model.about.time_unit;
        double last = 0;
        for (std::size_t k = 0; k < s->times().size(); ++k) {
            line.single.push_back({s->times()[k], s->values()[k]});
            last = s->times()[k];
        }
        if (last < about.problem.end)
            line.single.push_back({about.problem.end, s->values().back()});
        f.panels.push_back(draw_motion_plot(line, {.title = u.name}));
    }
    table t{.columns = {{"setting"}, {"value", column_kind::number}, {"unit"}}};
    for (std::size_t k = 0; k < m.about.size(); ++k)
        t.rows.push_back({m.about[k].name, given_text(m.settings[k]), unit_text(m.about[k].unit)});
    t.caption = "The shape \"" + m.name + "\". Rounded; design.json has them in full.";
    out.section("The experiment: " + m.name);
    out.add(f);
    out.add(t);
}

inline void add_promises(page& out, design_answer const& a, promise const& p) {
    if (a.goals.empty()) return; // the sentence says all
    table t{.columns = {{"quantity", column_kind::symbol},
                        {"width now", column_kind::number},
                        {"at most afterwards", column_kind::number},
                        {"share", column_kind::number}}};
    for (std::size_t g = 0; g < a.goals.size(); ++g) {
        auto const& w = p.goals[g];
        t.rows.push_back({a.goals[g].text, rounded_text(w.before, rounding::down),
                          "\xE2\x89\xA4 " + rounded_text(w.after, rounding::up),
                          "\xE2\x89\xA4 " + at_most_percent(w.factor())});
    }
    t.caption = "Whatever the truth among the parameters that the identification leaves, whatever "
                "the start and the errors within their bounds: all parameters that explain the new "
                "data together with the old ones lie so close (proved).";
    out.section("The promise");
    out.add(t);
}

inline void add_plan(page& out, stored_prediction const& about, design_answer const& a) {
    table t{.columns = {{"channel", column_kind::symbol},
                        {"error at most", column_kind::number},
                        {"unit"}}};
    auto const& channels = about.problem.model.about.channels;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        if (a.plan.errors[c] > 0)
            t.rows.push_back(
                {channels[c].name, given_text(a.plan.errors[c]), unit_text(channels[c].unit)});
    }
    t.caption = "Measured at " + count_text(a.plan.times.size()) + " instants, the last one at " +
                given_text(a.plan.times.back()) + unit_suffix(about.problem.model.about.time_unit) +
                ".";
    out.section("What is measured");
    out.add(t);
}

inline void add_tried(page& out, design_answer const& a) {
    table t{.columns = {{"shape"},
                        {"estimate", column_kind::number},
                        {a.goals.empty() ? "proof" : "proved share", column_kind::number},
                        {"limits"}}};
    for (auto const& m : a.found.tried)
        t.rows.push_back({m.name, rounded_text(m.estimate, rounding::nearest, {.significant = 2}),
                          !m.promised              ? "not asked"
                          : !a.goals.empty()       ? "\xE2\x89\xA4 " + at_most_percent(m.factor())
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
    out.section("What was tried");
    out.add(t);
}

/// What the equations hide, and what can be told.
inline std::string hidden_sentence(design_answer const& a) {
    std::string text = "The equations contain " + a.hidden +
                       " only together with other parameters, so that no input, no start and "
                       "no measurement tells it apart from them (proved)";
    if (!a.instead.empty()) text += ". What can be told: " + sivid::joined(a.instead);
    return text + ".";
}

} // namespace detail

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

SIVID_DECL page design_page(stored_prediction const& about, design_answer const& a,
                            prediction const* tubes, decision_page_options const& o) {
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
            cards.push_back({"left", "\xE2\x89\xA4 " + at_most_percent(best->factor()),
                             a.goals.size() == 1 ? "of the width" : "of the volume"});
        cards.push_back({"settings looked at", count_text(a.found.simulated), ""});
        cards.push_back({"time", duration_text(a.found.seconds), ""});
        out.cards(cards);
    }
    if (best != nullptr && (a.met() || !a.goals.empty())) {
        detail::add_promises(out, a, *best->promised);
        detail::add_inputs(out, about, *best, a.varied);
        detail::add_plan(out, about, a);
        if (tubes != nullptr) detail::add_motions(out, *tubes, o);
    }
    if (!a.found.tried.empty()) detail::add_tried(out, a);
    auto assumptions = decision_assumptions(about);
    if (!hidden)
        assumptions.push_back("The errors of the new measurements stay within the bounds that are "
                              "stated here.");
    detail::add_basis(out, about, o, assumptions);
    return out;
}

} // namespace sivid::report

#endif
