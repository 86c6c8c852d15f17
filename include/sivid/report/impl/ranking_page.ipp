// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_RANKING_PAGE_IPP
#define SIVID_REPORT_IMPL_RANKING_PAGE_IPP

#include <sivid/report/ranking_page.hpp>

#include <sivid/compiled.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/report/draw/bar_chart.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/table.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace sivid::report {

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

namespace detail {

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
    table t{.columns = {{"without", column_kind::text},
                        {"measurements", column_kind::number},
                        {"what explains the rest grows", column_kind::text}}};
    std::vector<bar> bars;
    std::string idle;
    for (auto const& g : found.groups) {
        auto const name = group_text(about, g.what);
        t.rows.push_back({name, count_text(g.measurements), growth_text(g.growth)});
        if (g.changes_nothing()) {
            idle += (idle.empty() ? "" : "; ") + name;
            continue;
        }
        using traits = interval_traits<interval>;
        auto const more = traits::mul(traits::sub(g.growth, traits::point(1)), traits::point(100));
        bars.push_back({.label = name, .value = {std::max(0.0, more.lower()), more.upper()}});
    }
    if (!idle.empty())
        out.prose("Nothing changes without any one of these, which follow from the others: " +
                  idle + ".");
    auto const sides = sivid::joined(found.coordinates);
    if (!bars.empty())
        out.add(
            figure{.panels = {draw_bar_chart(bars, {.width = 900,
                                                    .title = "Growth without them",
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

SIVID_DECL page ranking_page(identification_problem const& about, ranking const& found,
                             decision_page_options const& o,
                             measurement_ranking const* measurements) {
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
    table t{.columns = {{"experiment", column_kind::text},
                        {"channel", column_kind::symbol},
                        {"parameter", column_kind::symbol},
                        {"effect", column_kind::number},
                        {"place", column_kind::text}}};
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
        f.panels.push_back(draw_bar_chart(bars, {.width = 900,
                                                 .title = channel + ", " + experiment,
                                                 .quantity = "effect",
                                                 .unit = "error bounds",
                                                 .threshold = 1,
                                                 .threshold_label = "1"}));
    }
    out.add(f);
    t.caption = "Place: among the parameters; one number where the bounds certify it.";
    out.add(t);
    if (measurements != nullptr) detail::add_worth(out, about, *measurements);
    out.section("Over what");
    table prior{.columns = {{"parameter", column_kind::symbol}, {"prior", column_kind::number}}};
    for (std::size_t j = 0; j < about.prior.size(); ++j)
        prior.rows.push_back({about.choice.unknown[j],
                              outward_text({about.prior[j].lower(), about.prior[j].upper()})});
    out.add(prior);
    out.assumptions(
        {input_assumption(about.experiments) + ".",
         "Effects: at the instants of the measurements, against half the width of their "
         "bounds; what was measured does not enter."});
    out.footer(o.footer);
    return out;
}

} // namespace sivid::report

#endif
