// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_DIAGNOSIS_PAGE_IPP
#define SIVID_REPORT_IMPL_DIAGNOSIS_PAGE_IPP

// Included at the end of report/diagnosis_page.hpp.

#include <sivid/report/diagnosis_page.hpp>

#include <sivid/compiled.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/diagnosis_words.hpp>
#include <sivid/report/page.hpp>
#include <sivid/report/page/detail/advice.hpp>
#include <sivid/report/page/detail/diagnosis_figures.hpp>
#include <sivid/report/page/detail/diagnosis_tables.hpp>
#include <sivid/report/page/detail/identification_parameters.hpp>
#include <sivid/report/words/detail/tried_words.hpp>
#include <sivid/version.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

namespace detail {

inline void add_places(page& out, diagnosis_view const& v) {
    if (v.where.empty() && v.relations.empty() && v.confined.empty() &&
        v.scenario_inflation.empty() && v.channel_inflation.empty()) {
        return;
    }
    out.section("Where model and robot disagree");
    out.add(places_table(v));
    if (!v.relations.empty()) {
        out.subsection("What cannot hold together");
        constexpr std::size_t most = 12;
        std::vector<std::string> lines;
        for (std::size_t i = 0; i < std::min(most, v.relations.size()); ++i) {
            lines.push_back(relation_words(v.relations[i], v.time_unit));
        }
        if (v.relations.size() > most) {
            lines.push_back(count_text(v.relations.size() - most) +
                            " more are in the result file.");
        }
        out.bullets(lines);
    }
    if (!v.confined.empty()) {
        out.subsection("Which measurements stand alone");
        std::vector<std::string> lines;
        for (auto const& c : v.confined) lines.push_back(capitalised(confined_clause(c)) + ".");
        out.bullets(lines);
    }
    if (!v.scenario_inflation.empty() || !v.channel_inflation.empty()) {
        out.subsection("Scenario by scenario, channel by channel");
        out.add(gap_shares_table(v));
    }
}

inline void add_candidates(page& out, diagnosis_view const& v) {
    if (v.causes.empty()) return;
    out.section("Which effect it is");
    out.add(candidate_figure(v));
    table const t = causes_table(v);
    if (!t.rows.empty()) out.subsection("Parameters of the foremost candidates");
    out.add(t);
    if (!v.unobservable.empty()) {
        out.prose("These channels and scenarios never show " + enumeration(v.unobservable, " or ") +
                  ": nothing is said about " + (v.unobservable.size() == 1 ? "it." : "them."));
    }
}

inline void add_constants(page& out, diagnosis_view const& v) {
    table const t = constants_table(v);
    if (t.rows.empty()) return;
    cause const* const c = answer_of(v);
    out.section("All constants of the model" +
                (c != nullptr ? " with " + names_of(c->effects) : std::string{}));
    out.add(t);
    if (v.journal.empty()) return;
    out.subsection("What was tried to bound them");
    out.add(tried_table(tried_words(v.journal)));
}

inline void add_remainder(page& out, diagnosis_view const& v) {
    if (!v.remainder) return;
    out.section("What stays unexplained");
    out.prose(capitalised(remainder_clause(v)) + ".");
    std::vector<std::string> lines;
    for (suspected_place const& p : v.remainder->where) {
        lines.push_back(capitalised(place_clause(p, v.time_unit)) + ".");
    }
    if (!v.remainder->effects.empty()) out.bullets(lines);
    for (figure const& f :
         missing_rate_figures(v.plots.remaining_rates, "with " + names_of(v.remainder->effects))) {
        out.add(f);
    }
}

inline void add_motions(page& out, diagnosis_view const& v, bool holdout) {
    std::vector<comparison_series> all;
    for (compared_scenario const& s : v.plots.scenarios) {
        if (s.holdout == holdout) all.insert(all.end(), s.channels.begin(), s.channels.end());
    }
    auto legend = comparison_legend(all, after_words(v)); // once, for all that follow
    for (compared_scenario const& s : v.plots.scenarios) {
        if (s.holdout != holdout || s.channels.empty()) continue;
        figure f = motion_figure(s);
        f.legend = std::exchange(legend, {});
        out.subsection("Scenario " + s.name);
        out.add(f);
    }
}

inline void add_comparison(page& out, diagnosis_view const& v) {
    auto const any = [&](bool holdout) {
        return std::any_of(v.plots.scenarios.begin(), v.plots.scenarios.end(),
                           [&](compared_scenario const& s) {
                               return s.holdout == holdout && !s.channels.empty();
                           });
    };
    cause const* const c = answer_of(v);
    table const t = c != nullptr && c->holdout ? holdout_table(v, *c->holdout) : table{};
    if (any(true) || !t.rows.empty()) {
        out.section("On the held-out data");
        out.add(t);
        table const rivals = holdout_candidates_table(v);
        if (!rivals.rows.empty()) out.subsection("Candidates side by side");
        out.add(rivals);
        add_motions(out, v, true);
    }
    if (any(false)) {
        out.section("On the data used for fitting");
        if (v.answer == answer_kind::effects && says_shrink(v.shrink_fit)) {
            out.prose(capitalised(shrink_clause(v.shrink_fit, "these data")) + ".");
        }
        add_motions(out, v, false);
    }
}

inline void add_basis(page& out, diagnosis_view const& v) {
    out.section("What this rests on");
    out.assumptions(v.assumptions);
    cause const* const c = answer_of(v);
    if (c != nullptr) {
        out.assumptions(c->assumptions, "Further, for " + names_of(c->effects));
        if (c->witness) add_witness(out, *c->witness);
    }
    out.subsection("How to read it");
    out.prose(
        "\xE2\x9C\x93 proved: a theorem under the assumptions stated, by validated computation "
        "over all parameters of the prior. \xE2\x89\x88 estimate: the best that a search "
        "found; likely, not certain. Gap removed: 1 \xE2\x88\x92 (after \xE2\x88\x92 1) / "
        "(before \xE2\x88\x92 1), of the factors by which the bounds must grow.");
    out.prose((v.seconds > 0 ? "The run took " + duration_text(v.seconds) + ". " : std::string{}) +
              (v.about.command.empty() ? "" : "Command: " + v.about.command + ". ") +
              (v.about.machine.empty() ? "" : "Machine: " + v.about.machine + "."));
}

} // namespace detail

SIVID_DECL page diagnosis_page(diagnosis_view const& v) {
    page out{
        {.kind = "Diagnosis of the gap between model and robot",
         .title = v.about.dataset,
         .lead = v.about.model.empty()
                     ? ""
                     : "Where the model \xE2\x80\x9C" + v.about.model +
                           "\xE2\x80\x9D and the robot disagree, which effect it is, and how far "
                           "the gap shrinks once it is added."}};
    out.banner(banner_outcome(v), headline(v), banner_sentence(v));
    out.cards(diagnosis_cards(v));
    auto warnings = v.about.warnings;
    if (v.interrupted) {
        warnings.insert(warnings.begin(),
                        "The run was stopped early. What is called proved stands; "
                        "the rest may be incomplete.");
    }
    for (constant_at_end const& e : v.at_ends) warnings.push_back(end_words(e) + ".");
    out.warnings(warnings);
    out.add(summary_table(v));
    if (!v.why.empty()) {
        out.prose("Why it is not proved whether some parameter explains the data:");
        std::vector<std::string> lines;
        for (auto const& words : v.why) lines.push_back(words + ".");
        out.bullets(lines);
    }
    detail::add_places(out, v);
    figure const misfits = misfit_figure(v);
    if (!misfits.panels.empty()) out.subsection("How far each channel misses its bounds");
    out.add(misfits);
    auto const missing = missing_rate_figures(v.plots.missing_rates);
    if (!missing.empty()) out.section("What is missing, over time");
    for (figure const& f : missing) out.add(f);
    detail::add_candidates(out, v);
    detail::add_constants(out, v);
    detail::add_remainder(out, v);
    detail::add_comparison(out, v);
    add_advice(out, v);
    detail::add_basis(out, v);
    out.footer({"sivid " + std::string{version}, v.about.date});
    return out;
}

} // namespace sivid::report

#endif
