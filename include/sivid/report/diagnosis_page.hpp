// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DIAGNOSIS_PAGE_HPP
#define SIVID_REPORT_DIAGNOSIS_PAGE_HPP

#include <sivid/report/candidate_chart.hpp>
#include <sivid/report/comparison_plot.hpp>
#include <sivid/report/diagnosis_tables.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/diagnosis_words.hpp>
#include <sivid/report/heat_map.hpp>
#include <sivid/report/missing_rate_plot.hpp>
#include <sivid/report/page.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

namespace detail {

inline void add_places(page& out, diagnosis_view const& v) {
    if (v.places.empty() && v.relations.empty() && v.scenario_gaps.empty() &&
        v.channel_gaps.empty()) {
        return;
    }
    out.section("Where model and robot part");
    out.add(places_table(v));
    if (!v.relations.empty()) {
        out.subsection("What cannot hold together");
        constexpr std::size_t most = 12;
        std::vector<std::string> lines;
        for (std::size_t i = 0; i < std::min(most, v.relations.size()); ++i) {
            lines.push_back(relation_words(v.relations[i]));
        }
        if (v.relations.size() > most) {
            lines.push_back(count_text(v.relations.size() - most) +
                            " more are in the result file.");
        }
        out.bullets(lines);
    }
    if (!v.scenario_gaps.empty() || !v.channel_gaps.empty()) {
        out.subsection("Scenario by scenario, channel by channel");
        out.add(gap_shares_table(v));
    }
}

/// One pair of maps for each scenario, all with the same colours.
inline void add_misfits(page& out, diagnosis_view const& v) {
    struct pair {
        std::string name;
        heat_map before, after;
    };
    std::vector<pair> maps;
    double largest = 0;
    for (compared_scenario const& s : v.scenarios) {
        pair p{s.name + (s.holdout ? " (hold-out)" : ""), misfit_map(s.channels, false),
               misfit_map(s.channels, true)};
        largest = std::max({largest, largest_value(p.before), largest_value(p.after)});
        if (!p.before.times.empty() || !p.after.times.empty()) maps.push_back(std::move(p));
    }
    if (maps.empty()) return;
    out.subsection("How far each channel misses its bounds");
    figure f{.panels = {},
             .title = "Misfit over time.",
             .caption = "Largest |residual| / bound of the best fit (estimate) in each time span: "
                        "blue is within the bounds, orange with a cross beyond, hatched without a "
                        "sample. Suspected outliers are left out. All maps share one colour scale.",
             .layout = panel_layout::pair};
    for (pair const& p : maps) {
        heat_map_options o{.width = 540, .title = {}, .largest = largest, .key = f.panels.empty()};
        if (!p.before.times.empty()) {
            o.title = p.name + ": model as it is";
            f.panels.push_back(draw_heat_map(p.before, o));
        }
        if (!p.after.times.empty()) {
            o.title = p.name + ": with the effect";
            f.panels.push_back(draw_heat_map(p.after, o));
        }
    }
    out.add(f);
}

inline void add_missing_rates(page& out, diagnosis_view const& v) {
    if (v.missing_rates.empty()) return;
    out.section("What is missing, over time");
    std::vector<std::string> equations;
    for (missing_rate_series const& s : v.missing_rates) {
        if (std::find(equations.begin(), equations.end(), s.equation) == equations.end()) {
            equations.push_back(s.equation);
        }
    }
    for (std::string const& e : equations) {
        std::vector<missing_rate_series> all;
        range values;
        for (missing_rate_series const& s : v.missing_rates) {
            if (s.equation == e) {
                all.push_back(s);
                values = hull(values, rate_range(s));
            }
        }
        figure f{.panels = {},
                 .legend = missing_rate_legend(all),
                 .title = "Missing in the " + e + " equation.",
                 .caption = "The curve is an estimate. A box spans a window and the proved bounds "
                            "of the mean over it; one that does not touch zero proves that "
                            "something is missing there."};
        for (missing_rate_series const& s : all) {
            f.panels.push_back(draw_missing_rate(s, {.title = s.scenario}, values));
        }
        out.add(f);
    }
}

inline void add_candidates(page& out, diagnosis_view const& v) {
    if (v.candidates.empty()) return;
    constexpr std::size_t most = 25;
    out.section("Which effect it is");
    auto const shown = foremost(v, most);
    std::vector<candidate_bar> bars;
    for (candidate_view const* c : shown) {
        bars.push_back(
            {names_of(c->effects), c->state, c->inflation, c->fitted, c == answer_of(v)});
    }
    out.add(
        figure{.panels = {draw_candidate_chart(bars)},
               .legend = candidate_legend(bars),
               .title = "What is left of the gap with each candidate.",
               .caption = std::string{"Best first; the answer is set off. \xE2\x9C\x93 proved to "
                                      "explain all data, \xE2\x9C\x95 proved not to for any value "
                                      "in the prior, ? open. \xE2\x89\x88 marks an estimate."} +
                          (shown.size() < v.candidates.size()
                               ? " Shown are " + count_text(shown.size()) + " of " +
                                     count_text(v.candidates.size()) + " candidates."
                               : ""),
               .layout = panel_layout::wide});
    table const t = causes_table(v);
    if (!t.rows.empty()) out.subsection("Parameters of the foremost candidates");
    out.add(t);
    if (!v.unobservable.empty()) {
        out.prose("These channels and scenarios never show " + enumeration(v.unobservable, " or ") +
                  ": nothing is said about " + (v.unobservable.size() == 1 ? "it." : "them."));
    }
}

inline void add_motions(page& out, diagnosis_view const& v, bool holdout) {
    std::vector<comparison_series> all;
    for (compared_scenario const& s : v.scenarios) {
        if (s.holdout == holdout) all.insert(all.end(), s.channels.begin(), s.channels.end());
    }
    auto legend = comparison_legend(all); // for the first figure, in the words of all
    for (compared_scenario const& s : v.scenarios) {
        if (s.holdout != holdout || s.channels.empty()) continue;
        range time;
        for (comparison_series const& c : s.channels)
            time = hull(time, time_range(plain_series(c)));
        figure f{.panels = {},
                 .legend = std::exchange(legend, {}),
                 .title = "Scenario " + s.name + ", before and after.",
                 .caption =
                     holdout ? "These data chose nothing: neither effect nor parameters." : ""};
        for (comparison_series const& c : s.channels) {
            f.panels.push_back(draw_comparison_plot(c, {.title = c.name, .time = time}));
        }
        out.subsection("Scenario " + s.name);
        out.add(f);
    }
}

inline void add_comparison(page& out, diagnosis_view const& v) {
    auto const any = [&](bool holdout) {
        return std::any_of(v.scenarios.begin(), v.scenarios.end(), [&](compared_scenario const& s) {
            return s.holdout == holdout && !s.channels.empty();
        });
    };
    candidate_view const* const c = answer_of(v);
    table const t =
        c != nullptr && c->holdout ? holdout_table(*c->holdout, v.shrink_holdout) : table{};
    if (any(true) || !t.rows.empty()) {
        out.section("On data that chose nothing");
        out.add(t);
        add_motions(out, v, true);
    }
    if (any(false)) {
        out.section("On the data used for fitting");
        if (!is_empty(v.shrink_fit)) {
            out.prose(capitalised(shrink_clause(v.shrink_fit, "these data")) + ".");
        }
        add_motions(out, v, false);
    }
}

inline void add_basis(page& out, diagnosis_view const& v) {
    std::string const next = next_words(v);
    if (!next.empty()) {
        out.section("What to measure next");
        out.prose(next);
    }
    out.section("What this rests on");
    out.assumptions(v.assumptions);
    candidate_view const* const c = answer_of(v);
    if (c != nullptr) {
        out.assumptions(c->assumptions, "Further, for " + names_of(c->effects));
        if (c->witness) {
            out.subsection("The witness");
            out.prose("One point that was verified by validated integration: " +
                      values_text(c->witness->parameters) + ".");
            std::vector<std::string> starts;
            for (witness_view::start const& s : c->witness->initial) {
                starts.push_back("Scenario " + s.scenario + " starts at " + values_text(s.state) +
                                 ".");
            }
            out.bullets(starts);
        }
    }
    out.subsection("How to read it");
    out.prose(
        "\xE2\x9C\x93 proved: a theorem under the assumptions stated, by validated computation "
        "over all parameters of the prior. \xE2\x89\x88 estimate: the best that a search "
        "found; likely, not certain.");
    out.prose((v.seconds > 0 ? "The run took " + duration_text(v.seconds) + ". " : std::string{}) +
              (v.command.empty() ? "" : "Command: " + v.command + ". ") +
              (v.machine.empty() ? "" : "Machine: " + v.machine + "."));
}

} // namespace detail

/// The whole page of a diagnosis. Sections without content are left out.
[[nodiscard]] inline page diagnosis_page(diagnosis_view const& v) {
    page out{{.kind = "Diagnosis of the gap between model and robot",
              .title = v.dataset,
              .lead = v.model.empty()
                          ? ""
                          : "Where the model \xE2\x80\x9C" + v.model +
                                "\xE2\x80\x9D and the robot part, which effect it is, and how far "
                                "the gap shrinks once it is added."}};
    out.banner(banner_outcome(v), headline(v), banner_sentence(v));
    out.cards(diagnosis_cards(v));
    auto warnings = v.warnings;
    if (v.interrupted) {
        warnings.insert(warnings.begin(),
                        "The run was stopped early. What is called proved stands; "
                        "the rest may be incomplete.");
    }
    out.warnings(warnings);
    out.add(summary_table(v));
    detail::add_places(out, v);
    detail::add_misfits(out, v);
    detail::add_missing_rates(out, v);
    detail::add_candidates(out, v);
    detail::add_comparison(out, v);
    detail::add_basis(out, v);
    out.footer({v.version, v.date});
    return out;
}

} // namespace sivid::report

#endif
