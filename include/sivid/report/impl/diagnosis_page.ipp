// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_DIAGNOSIS_PAGE_IPP
#define SIVID_REPORT_IMPL_DIAGNOSIS_PAGE_IPP

#include <sivid/report/diagnosis_page.hpp>

#include <sivid/number/text/joined.hpp>
#include <sivid/report/detail/diagnosis_tables.hpp>
#include <sivid/report/diagnosis_words.hpp>
#include <sivid/report/identification_page.hpp>
#include <sivid/report/identification_report.hpp>
#include <sivid/version.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace sivid::report {

namespace detail {

inline void add_places(page& out, diagnosis_view const& v) {
    if (v.where.empty() && v.relations.empty() && v.confined.empty() &&
        v.scenario_inflation.empty() && v.channel_inflation.empty())
        return;
    out.section("Where model and robot disagree").add(places_table(v));
    out.subsection("What cannot hold together");
    constexpr std::size_t most = 12;
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < std::min(most, v.relations.size()); ++i)
        lines.push_back(relation_words(v.relations[i], v.time_unit));
    if (v.relations.size() > most)
        lines.push_back(count_text(v.relations.size() - most) + " more are in the result file.");
    out.bullets(lines);
    std::vector<std::string> alone;
    for (auto const& c : v.confined) alone.push_back(capitalised(confined_clause(c)));
    out.subsection("Which measurements stand alone").sentences(alone);
    out.subsection("Scenario by scenario, channel by channel").add(gap_shares_table(v));
}

inline void add_candidates(page& out, diagnosis_view const& v) {
    if (v.causes.empty()) return;
    out.section("Which effect it is").add(candidate_figure(v));
    out.subsection("Parameters of the foremost candidates").add(causes_table(v));
    if (!v.unobservable.empty()) {
        out.prose("These channels and scenarios never show " + enumeration(v.unobservable, " or ") +
                  ": nothing is said about " + (v.unobservable.size() == 1 ? "it." : "them."));
    }
}

inline void add_remainder(page& out, diagnosis_view const& v) {
    if (!v.remainder) return;
    out.section("What stays unexplained");
    out.prose(capitalised(remainder_clause(v)) + ".");
    std::vector<std::string> places;
    for (suspected_place const& p : v.remainder->where)
        places.push_back(capitalised(place_clause(p, v.time_unit)));
    if (!v.remainder->effects.empty()) out.sentences(places);
    auto rungs = ladder_clauses(v);
    for (auto& words : rungs) words = capitalised(words) + ".";
    out.sentences(rungs);
    if (auto all = disturbance_clauses(v); !all.empty()) {
        out.prose("How large an unknown function of time beside one equation would have to be:");
        for (auto& words : all) words = capitalised(words) + ".";
        out.sentences(all);
    }
    for (figure const& f :
         missing_rate_figures(v.plots.remaining_rates, "with " + names_of(v.remainder->effects))) {
        out.add(f);
    }
}

inline void add_motions(page& out, diagnosis_view const& v, bool holdout) {
    std::vector<channel_series> all;
    for (compared_scenario const& s : v.plots.scenarios) {
        if (s.holdout == holdout) all.insert(all.end(), s.channels.begin(), s.channels.end());
    }
    auto legend = time_plot_legend( // once, for all that follow
        all, {.tube = "predicted tube " + after_words(v),
              .after = "model " + after_words(v) + ", best fit (estimate)"});
    for (compared_scenario const& s : v.plots.scenarios) {
        if (s.holdout != holdout || s.channels.empty()) continue;
        figure f = motion_figure(s);
        f.legend = std::exchange(legend, {});
        out.subsection("Scenario " + s.name);
        out.add(f);
    }
}

inline void add_comparison(page& out, diagnosis_view const& v) {
    cause const* const c = answer_of(v);
    out.section("On the held-out data");
    if (c != nullptr && c->holdout) out.add(holdout_table(v, *c->holdout));
    out.subsection("Candidates side by side").add(holdout_candidates_table(v));
    add_motions(out, v, true);
    bool const any = std::any_of(v.plots.scenarios.begin(), v.plots.scenarios.end(),
                                 [](auto const& s) { return !s.holdout && !s.channels.empty(); });
    out.section("On the data used for fitting");
    if (any && v.answer == answer_kind::effects && says_shrink(v.shrink_fit))
        out.prose(capitalised(shrink_clause(v.shrink_fit, "these data")) + ".");
    add_motions(out, v, false);
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

/// Marks the q largest misfits beyond their bounds; none without an outlier budget.
inline std::vector<bool> suspects(std::vector<double> const& residuals, std::size_t n,
                                  std::size_t q) {
    std::vector<std::size_t> beyond;
    for (std::size_t i = 0; i < std::min(n, residuals.size()); ++i) {
        if (std::fabs(residuals[i]) > 1) beyond.push_back(i);
    }
    std::stable_sort(beyond.begin(), beyond.end(), [&](std::size_t a, std::size_t b) {
        return std::fabs(residuals[a]) > std::fabs(residuals[b]);
    });
    beyond.resize(std::min(beyond.size(), q));
    std::vector<bool> out(n, false);
    for (std::size_t const i : beyond) out[i] = true;
    return out;
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
        out.sentences(v.why);
    }
    detail::add_places(out, v);
    out.subsection("How far each channel misses its bounds").add(misfit_figure(v));
    out.section("What is missing, over time");
    for (figure const& f : missing_rate_figures(v.plots.missing_rates)) out.add(f);
    detail::add_candidates(out, v);
    cause const* const c = answer_of(v);
    out.section("All constants of the model" +
                (c != nullptr ? " with " + names_of(c->effects) : std::string{}));
    out.add(constants_table(v));
    if (!v.journal.empty()) {
        out.subsection("What was tried to bound them");
        out.add(tried_table(v.journal));
    }
    detail::add_remainder(out, v);
    detail::add_comparison(out, v);
    add_advice(out, v);
    detail::add_basis(out, v);
    out.footer({"sivid " + std::string{version}, v.about.date});
    return out;
}

SIVID_DECL std::vector<compared_scenario> compared_scenarios(identification_problem const& problem,
                                                             approximate_fit const& base,
                                                             approximate_fit const& after,
                                                             bool holdout) {
    auto const& about = problem.model.about;
    std::vector<double> const nothing;
    std::vector<compared_scenario> out;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const& experiment = problem.experiments[e];
        auto const samples = sorted(experiment.measurements);
        auto const& before = e < base.residuals.size() ? base.residuals[e] : nothing;
        auto const& then = e < after.residuals.size() ? after.residuals[e] : nothing;
        auto const suspect =
            detail::suspects(then.empty() ? before : then, samples.size(), experiment.outliers);
        compared_scenario s{.name = experiment.name, .holdout = holdout};
        for (std::size_t c = 0; c < about.channels.size(); ++c) {
            channel_series d{.name = about.channels[c].name,
                             .unit = about.channels[c].unit,
                             .time_unit = about.time_unit};
            for (std::size_t i = 0; i < samples.size(); ++i) {
                if (samples[i].channel != c) continue;
                double const t = samples[i].time;
                d.measured.push_back(
                    {.time = t,
                     .value = samples[i].bound,
                     .state = suspect[i] ? sample_state::suspect : sample_state::regular});
                auto const add = [&](std::vector<double> const& residuals, std::vector<point>& line,
                                     std::vector<point>& misfits) {
                    if (i >= residuals.size()) return;
                    line.push_back(
                        {t, mid(samples[i].bound) + rad(samples[i].bound) * residuals[i]});
                    if (!suspect[i]) misfits.push_back({t, std::fabs(residuals[i])});
                };
                add(before, d.before, d.misfit_before);
                add(then, d.after, d.misfit_after);
            }
            if (!d.measured.empty()) s.channels.push_back(std::move(d));
        }
        out.push_back(std::move(s));
    }
    return out;
}

SIVID_DECL void describe(std::vector<effect> const& catalogue, diagnosis_report_options& options) {
    for (effect const& e : catalogue) {
        options.meanings.emplace(e.name, e.about);
        auto const wide = widened(e);
        options.meanings.emplace(wide.name, wide.about);
    }
}

SIVID_DECL diagnosis_view view_of(diagnosis const& d, diagnosis_plot_data plots,
                                  diagnosis_report_options options) {
    diagnosis_view v{d, std::move(options), std::move(plots), reach_words(d.reach)};
    if (!v.causes.empty() && find_candidate(v, {}) == nullptr) {
        cause base; // what the others are measured by
        base.verdict = v.gap == gap_verdict::certified ? cause_verdict::excluded
                       : v.gap == gap_verdict::none    ? cause_verdict::explains
                                                       : cause_verdict::undecided;
        base.inflation = v.inflation;
        v.causes.push_back(std::move(base));
    }
    for (cause& c : v.causes) {
        if (c.effects.empty() && !is_fitted(c.fitted_inflation))
            c.fitted_inflation = v.about.base_fitted;
    }
    return v;
}

} // namespace sivid::report

#endif
