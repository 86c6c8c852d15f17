// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_IDENTIFICATION_PAGE_IPP
#define SIVID_REPORT_IMPL_IDENTIFICATION_PAGE_IPP

// Included at the end of report/identification_page.hpp.

#include <sivid/report/identification_page.hpp>

#include <sivid/compiled.hpp>
#include <sivid/report/identification_view.hpp>
#include <sivid/report/identification_words.hpp>
#include <sivid/report/page/detail/identification_parameters.hpp>
#include <sivid/report/words/detail/tried_words.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

namespace detail {

inline std::string sentence(std::string const& text) {
    return text.empty() ? text : text + (text.back() == '.' ? " " : ". ");
}

inline void add_key_figures(page& out, identification_view const& v) {
    std::vector<card> cards;
    if (v.verdict == outcome::refuted) {
        cards.push_back({"can explain the data", "nothing", "all of the prior is excluded"});
    } else if (is_finite(v.volume_outer)) {
        cards.push_back({"can explain the data",
                         std::string{"\xE2\x89\xA4 "} + at_most_percent(v.volume_outer.hi),
                         "of the prior's volume (outer)"});
    }
    if (is_finite(v.volume_inner) && v.volume_inner.lo > 0) {
        cards.push_back({"proved to explain it",
                         std::string{"\xE2\x89\xA5 "} + at_least_percent(v.volume_inner.lo),
                         "of the prior's volume (inner)"});
    }
    cards.push_back({"time", duration_text(v.statistics.seconds), v.statistics.stop_reason});
    if (v.statistics.boxes > 0) { // else nobody counted
        cards.push_back({"boxes", count_text(v.statistics.boxes), ""});
        cards.push_back({"integrations", count_text(v.statistics.integrations), "validated"});
    }
    std::size_t measurements = 0, fit = 0;
    for (scenario_view const& s : v.scenarios) {
        measurements += s.role == "fit" ? s.measurements : 0;
        fit += s.role == "fit" ? 1 : 0;
    }
    if (fit > 0) {
        cards.push_back(
            {"measurements", count_text(measurements),
             std::string{"in "} + count_text(fit) + (fit == 1 ? " scenario" : " scenarios")});
    }
    out.cards(cards);
}

inline void add_scenario(page& out, identification_view const& v, scenario_view const& s) {
    if (v.scenarios.size() > 1 || s.role != "fit") {
        out.subsection(s.name + (s.role == "fit" ? "" : " (" + s.role + ")"));
    }
    std::string const tube =
        v.tube_meaning.empty() ? "" : std::string{"Enclosure: "} + sentence(v.tube_meaning);
    std::string const reference = v.reference_meaning.empty() ? ""
                                                              : std::string{"Reference line: "} +
                                                                    sentence(v.reference_meaning);
    range time;
    bool residuals = false, tubes = false;
    for (channel_series const& c : s.channels) {
        tubes = tubes || !c.tube.empty();
        time = hull(time, time_range(c));
        residuals =
            residuals || std::any_of(c.measured.begin(), c.measured.end(),
                                     [](measured_sample const& m) { return has_residual(m); });
    }
    std::string const which = "scenario " + s.name;
    figure measured{.legend = time_plot_legend(s.channels),
                    .title = (tubes ? "Measurements and proven enclosure, " : "Measurements, ") +
                             which + ".",
                    .caption = "Every bar is a measured interval" +
                               std::string{tubes ? "; the band contains the model's output at "
                                                   "every instant, not only at the samples. "
                                                 : ". "} +
                               tube + reference};
    figure against{.title = "The enclosure within each measured interval, " + which + ".",
                   .caption = "Zero is the middle of the measured interval, +1 and \xE2\x88\x92"
                              "1 its ends. An enclosure between the lines meets its measurement "
                              "for certain; one wholly beyond misses it for certain."};
    for (channel_series const& c : s.channels) {
        measured.panels.push_back(draw_time_plot(c, {.title = c.name, .time = time}));
        if (residuals) {
            against.panels.push_back(
                draw_residual_plot(c, {.height = 200, .title = c.name, .time = time}));
        }
    }
    out.add(measured);
    if (s.plane) {
        out.add(figure{.panels = {draw_plane_plot(*s.plane, {.width = 1000, .height = 330})},
                       .legend = plane_plot_legend(*s.plane),
                       .title = "The motion seen from above, " + which + ".",
                       .caption = "Equal scales on both axes. " + tube + reference,
                       .layout = panel_layout::wide});
    }
    out.add(against);
}

inline void add_outliers(page& out, identification_view const& v) {
    std::size_t budget = 0;
    for (scenario_view const& s : v.scenarios) budget += s.outlier_budget;
    if (v.outliers.empty() && budget == 0) return;
    out.section("Outliers");
    table allowed{.columns = {{"scenario", column_kind::symbol},
                              {"measurements", column_kind::number},
                              {"outliers allowed", column_kind::number}}};
    for (scenario_view const& s : v.scenarios) {
        allowed.rows.push_back({s.name, count_text(s.measurements), count_text(s.outlier_budget)});
    }
    out.add(allowed);
    table found{.columns = {{"scenario", column_kind::symbol},
                            {"channel", column_kind::symbol},
                            {"time [" + unit_text(v.time_unit) + "]", column_kind::number},
                            {"what is known", column_kind::note}}};
    constexpr std::size_t most = 100;
    for (outlier_view const& o : v.outliers) {
        if (found.rows.size() < most) {
            found.rows.push_back({o.scenario, o.channel, given_text(o.time),
                                  o.proved
                                      ? "proved: violated by every parameter that explains the data"
                                      : "suspected: violated by the witness; not proved"});
        }
    }
    found.caption = v.outliers.size() > most ? std::string{"The first "} + count_text(most) +
                                                   " of " + count_text(v.outliers.size()) + "."
                                             : "";
    out.add(found);
}

inline void add_computation(page& out, identification_view const& v) {
    out.section("How it was computed");
    out.prose(std::string{"The run took "} + duration_text(v.statistics.seconds) + " for " +
              count_text(v.statistics.boxes) + " boxes and " +
              count_text(v.statistics.integrations) + " validated integrations. " +
              (v.statistics.stop_reason.empty()
                   ? ""
                   : std::string{"Why it stopped: "} + sentence(v.statistics.stop_reason)));
    table t{.columns = {{"volume relative to the prior"}, {"proved within", column_kind::number}}};
    if (!is_empty(v.volume_inner)) {
        t.rows.push_back({"inner: proved to explain the data", percent_interval(v.volume_inner)});
    }
    if (!is_empty(v.volume_outer)) {
        t.rows.push_back({"outer: not excluded (inside, undecided and pending)",
                          percent_interval(v.volume_outer)});
    }
    out.add(t);
    if (!v.tried.empty()) {
        out.subsection("What was tried");
        out.add(tried_table(v.tried));
    }
    if (!v.comparison.empty()) {
        out.subsection("Against other ways to solve it");
        table c{.columns = {{"method", column_kind::symbol},
                            {"time", column_kind::number},
                            {"boxes", column_kind::number},
                            {"integrations", column_kind::number},
                            {"inner volume", column_kind::number},
                            {"outer volume", column_kind::number},
                            {"remark", column_kind::note}},
                .caption = v.comparison_note};
        for (comparison_row const& r : v.comparison) {
            if (r.chosen) c.chosen_row = c.rows.size();
            c.rows.push_back({r.name, r.seconds ? duration_text(*r.seconds) : "",
                              r.boxes ? count_text(*r.boxes) : "",
                              r.integrations ? count_text(*r.integrations) : "",
                              percent_interval(r.inner_volume), percent_interval(r.outer_volume),
                              r.note});
        }
        out.add(c);
    }
}

inline void add_why_little(page& out, identification_view const& v) {
    if (v.statistics.why.empty()) return;
    out.subsection("Why little is excluded");
    std::vector<std::string> lines;
    for (auto const& words : v.statistics.why) lines.push_back(words + ".");
    out.bullets(lines);
}

inline void add_identifiability(page& out, identification_view const& v) {
    if (v.identifiability.empty()) return;
    out.section("What such data can tell");
    out.prose(std::string{"Which unknowns the measured outputs determine, and which only in "
                          "combination, whatever the measured values"} +
              (v.identifiability_at.empty() ? "" : ", " + v.identifiability_at) +
              ". Ranks are proved; what is free is proved where it says \xE2\x80\x9C"
              "by the equations\xE2\x80\x9D, all else is computed in floating point.");
    out.bullets(v.identifiability);
}

} // namespace detail

SIVID_DECL page identification_page(identification_view const& v) {
    page out{{.kind = "Validated identification",
              .title = v.dataset,
              .lead = v.model.empty() ? ""
                                      : "Which parameters of the model \xE2\x80\x9C" + v.model +
                                            "\xE2\x80\x9D can explain this campaign, with proof."}};
    out.banner(v.verdict, headline(v), verdict_sentence(v));
    detail::add_key_figures(out, v);
    out.warnings(v.warnings);
    out.section("What was proved, in plain words");
    out.plain_words(plain_statements(v));
    out.assumptions(v.assumptions);
    detail::add_parameters(out, v);
    detail::add_why_little(out, v);
    detail::add_pavings(out, v);
    detail::add_identifiability(out, v);
    bool const drawn =
        std::any_of(v.scenarios.begin(), v.scenarios.end(),
                    [](scenario_view const& s) { return !s.channels.empty() || s.plane; });
    if (drawn) {
        out.section("Measurements and model");
        for (scenario_view const& s : v.scenarios) {
            if (!s.channels.empty() || s.plane) detail::add_scenario(out, v, s);
        }
    }
    detail::add_outliers(out, v);
    detail::add_computation(out, v);
    if (v.witness) detail::add_witness(out, *v.witness);
    out.footer({v.version, v.date, v.machine, v.command});
    return out;
}

} // namespace sivid::report

#endif
