// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_IMPL_DIAGNOSIS_FIGURES_IPP
#define SIVID_REPORT_PAGE_IMPL_DIAGNOSIS_FIGURES_IPP

#include <sivid/report/page/detail/diagnosis_figures.hpp>

namespace sivid::report {

SIVID_DECL figure misfit_figure(diagnosis_view const& v) {
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
        heat_map_options o{.width = 540, .title = {}, .largest = largest, .key = f.panels.empty()};
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

SIVID_DECL std::vector<figure> missing_rate_figures(std::vector<missing_rate_series> const& rates,
                                                    std::string const& still) {
    std::vector<figure> out;
    std::vector<std::string> equations;
    for (missing_rate_series const& s : rates) {
        if (std::find(equations.begin(), equations.end(), s.equation) == equations.end()) {
            equations.push_back(s.equation);
        }
    }
    for (std::string const& e : equations) {
        std::vector<missing_rate_series> all;
        range values;
        for (missing_rate_series const& s : rates) {
            if (s.equation == e) {
                all.push_back(s);
                values = hull(values, detail::rate_range(s));
            }
        }
        figure f{.legend = missing_rate_legend(all),
                 .title = "Missing in the " + e + " equation" +
                          (still.empty() ? "." : ", " + still + "."),
                 .caption = "The curve is an estimate. A box spans a window and the proved bounds "
                            "of the mean over it; one that does not touch zero proves that "
                            "something is missing there."};
        for (missing_rate_series const& s : all) {
            f.panels.push_back(draw_missing_rate(s, {.title = s.scenario}, values));
        }
        out.push_back(std::move(f));
    }
    return out;
}

SIVID_DECL figure motion_figure(compared_scenario const& s) {
    range time;
    bool both = false;
    for (comparison_series const& c : s.channels) {
        both = both || !c.after.empty();
        time = hull(time, detail::time_range(detail::plain_series(c)));
    }
    figure f{.title = "Scenario " + s.name + (both ? ", before and after." : "."),
             .caption =
                 s.holdout
                     ? "Held-out data: neither the effect nor the parameters were chosen by them."
                     : ""};
    for (comparison_series const& c : s.channels) {
        f.panels.push_back(draw_comparison_plot(c, {.title = c.name, .time = time}));
    }
    return f;
}

SIVID_DECL figure candidate_figure(diagnosis_view const& v, std::size_t most) {
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

} // namespace sivid::report

#endif
