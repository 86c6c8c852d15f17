// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IDENTIFICATION_PAGE_HPP
#define SIVID_REPORT_IDENTIFICATION_PAGE_HPP

#include <sivid/number/text/joined.hpp>
#include <sivid/paving/strategy/contractor.hpp>
#include <sivid/report/draw/charts.hpp>
#include <sivid/report/draw/paving_plot.hpp>
#include <sivid/report/identification_view.hpp>
#include <sivid/report/page.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// The page of an identification. Its sentences say no more than the view's proven ranges do.
namespace sivid::report {

/// "Sv = 0.22 m^2, L = 0.3 m"
/// The values are exact: a witness can be checked again from the text.
inline std::string values_text(std::vector<named_estimate> const& all) {
    return joined(all, ", ", [](named_estimate const& v) {
        return v.name + " = " + given_text(v.value) + unit_suffix(v.unit);
    });
}

/// What is left of the prior's range, between the ends of the hull, too, as a share of its width;
/// rounded up; NaN when there is no such number.
inline double share_of_prior(parameter_view const& p) {
    if (!is_finite(p.prior) || is_empty(p.hull) || !(p.prior.hi > p.prior.lo)) return std::nan("");
    double const share = (p.hull.hi - p.hull.lo) / (p.prior.hi - p.prior.lo);
    return std::clamp(share * (1 + 1e-15) - p.excluded_between, 0.0, 1.0);
}

/// How much of a parameter's prior is excluded where its hull does not show it: between its ends,
/// or only together with other parameters. Empty where the hull shows it, "nothing excluded" only
/// where nothing is.
inline std::string exclusion_note(identification_view const& v, parameter_view const& p) {
    if (is_empty(p.hull)) return {};
    if (p.excluded_between > 0)
        return "at least " + at_least_percent(p.excluded_between) +
               " of the prior's range is excluded in between";
    if (p.hull.lo > p.prior.lo || p.hull.hi < p.prior.hi) return {};
    if (v.excluded > 0)
        return "no value excluded by itself; with the other parameters at least " +
               at_least_percent(v.excluded) + " of the prior's volume";
    return "nothing excluded";
}

/// True when the proof left (nearly) all of the parameter's prior.
inline bool is_unresolved(parameter_view const& p) { return share_of_prior(p) > 0.99; }

inline std::string headline(identification_view const& v) {
    switch (v.verdict) {
    case outcome::proved:
        return "Proved: the model can explain the data";
    case outcome::refuted:
        return "Proved: the model cannot explain the data";
    default:
        return "Not decided";
    }
}

inline std::string verdict_sentence(identification_view const& v) {
    if (!v.sentence.empty()) return v.sentence;
    switch (v.verdict) {
    case outcome::proved:
        return "A parameter vector that explains the data exists, and all that do are enclosed "
               "below.";
    case outcome::refuted:
        return "No parameter vector of the prior explains the data.";
    default:
        return "Neither was a parameter vector proved to explain the data, nor was the whole prior "
               "excluded.";
    }
}

/// How many outliers the data need; both numbers are proved.
inline std::string fewest_outliers_sentence(std::uint64_t least, std::uint64_t most) {
    if (most == 0) return "No outlier is needed to explain the data.";
    auto const number = [](std::uint64_t n) {
        return count_text(n) + (n == 1 ? " measurement" : " measurements");
    };
    if (least == most) {
        return "Every parameter vector of the prior violates at least " + number(least) +
               ", and some violates no more: so many outliers are needed, and suffice.";
    }
    return (least == 0 ? std::string{"It is open whether outliers are needed"}
                       : "Every parameter vector of the prior violates at least " + number(least)) +
           "; " + number(most) + " as outliers suffice.";
}

/// The measurements that a verdict is about.
inline std::string measurements_meant(std::vector<scenario_view> const& scenarios) {
    std::size_t budget = 0, samples = 0;
    for (scenario_view const& s : scenarios) {
        budget += s.outlier_budget;
        samples += s.measurements;
    }
    if (samples == 0) return "the data";
    if (budget == 0) return "all " + count_text(samples) + " measurements";
    return "the " + count_text(samples) + " measurements but for the outliers allowed (" +
           count_text(budget) + " in all)";
}

/// Whether a parameter vector explains the data, and which.
inline std::vector<std::string> existence_statements(identification_view const& v) {
    std::string const which = measurements_meant(v.scenarios);
    if (v.verdict == outcome::refuted)
        return {"No parameter vector in the prior has a motion that meets " + which +
                ": every part of the prior was excluded by a proof."};
    if (v.verdict != outcome::proved)
        return {"It is open whether a parameter vector in the prior has a motion that meets " +
                which + "."};
    std::string const at =
        v.witness && !v.witness->parameters.empty()
            ? " The one that was checked is " + values_text(v.witness->parameters) + "."
            : "";
    std::vector<std::string> out{"There is a parameter vector in the prior whose motion meets " +
                                 which + "." + at};
    if (!v.inside_box.empty()) {
        out.push_back("So does every one with " + v.inside_box +
                      ": it is the largest box of parameters that was proved to.");
    }
    return out;
}

inline std::string volume_statement(identification_view const& v) {
    std::string text =
        v.volume_outer.hi >= 1
            ? "Nothing (or nearly nothing) of the prior's volume could be excluded."
            : "At most " + at_most_percent(v.volume_outer.hi) +
                  " of the prior's volume can explain the data; all the rest is excluded "
                  "by proof.";
    if (is_finite(v.volume_inner) && v.volume_inner.lo > 0) {
        text += " At least " + at_least_percent(v.volume_inner.lo) +
                " of it is proved to explain the data.";
    }
    return text;
}

/// Where the parameter vectors lie that explain the data.
inline std::vector<std::string> range_statements(identification_view const& v) {
    std::vector<std::string> out;
    std::string hulls;
    std::string unresolved;
    for (parameter_view const& p : v.parameters) {
        std::string const text =
            p.name + " in " + outward_text_within(p.hull, p.prior) + unit_suffix(p.unit);
        std::string& list = is_unresolved(p) ? unresolved : hulls;
        list += (list.empty() ? "" : ", ") + (is_unresolved(p) ? p.name : text);
        if (p.excluded_between > 0) list += " (" + exclusion_note(v, p) + ")";
    }
    if (!hulls.empty()) {
        out.push_back("Every parameter vector that explains the data has " + hulls + ".");
    }
    for (combination_view const& c : v.combinations) {
        bool const all = !is_empty(c.prior) && c.hull.lo <= c.prior.lo && c.hull.hi >= c.prior.hi;
        out.push_back((all ? "Both ends of its range over the prior are left of "
                           : "Every parameter vector that explains the data has ") +
                      formula_text(c.formula) + " in " + outward_text(c.hull) +
                      unit_suffix(c.unit) + "." + (c.note.empty() ? "" : " " + c.note));
    }
    if (!unresolved.empty()) {
        out.push_back("For " + unresolved +
                      " taken alone, nothing (or nearly nothing) of the prior could be excluded.");
    }
    if (is_finite(v.volume_outer)) out.push_back(volume_statement(v));
    return out;
}

/// Calls f with the scenario, the channel and the sample of each measurement that is marked.
void for_marked(identification_view const& v, auto const& f) {
    for (scenario_view const& s : v.scenarios)
        for (channel_series const& c : s.channels)
            for (measured_sample const& m : c.measured)
                if (m.state != sample_state::regular) f(s, c, m);
}

/// What was proved, sentence by sentence.
inline std::vector<std::string> plain_statements(identification_view const& v) {
    auto out = existence_statements(v);
    if (v.verdict != outcome::refuted) {
        auto const ranges = range_statements(v);
        out.insert(out.end(), ranges.begin(), ranges.end());
    }
    std::size_t forced = 0;
    for_marked(v, [&](auto const&, auto const&, measured_sample const& m) {
        forced += m.state == sample_state::forced_outlier ? 1 : 0;
    });
    if (forced > 0) {
        out.push_back(std::string{forced == 1 ? "One measurement is"
                                              : count_text(forced) + " measurements are"} +
                      " proved to be outliers: no parameter vector that explains the data meets " +
                      (forced == 1 ? "it." : "them."));
    }
    out.insert(out.end(), v.proved.begin(), v.proved.end());
    return out;
}

/// A journal, line by line.
[[nodiscard]] inline table tried_table(contraction_journal const& journal) {
    table result{.columns = columns("*contractor|outcome|~why it was tried, or not|~effort"),
                 .caption = "In this order; the shares are those of the volume that each was "
                            "given."};
    for (auto const& r : journal) {
        std::string outcome{to_string(r.how)}, effort;
        if (r.asked()) {
            if (r.left < 1) outcome += ": at most " + at_most_percent(r.left) + " left";
            effort = duration_text(r.seconds);
            if (r.integrations > 0) effort += ", " + count_text(r.integrations) + " integrations";
            for (auto const& [name, value] : r.figures)
                if (value > 0) effort += ", " + name + " " + given_text(value);
        }
        result.rows.push_back({r.by, outcome, r.why, effort});
    }
    return result;
}

namespace detail {

inline void add_parameters(page& out, identification_view const& v) {
    if (v.parameters.empty()) return;
    out.section("Parameters");
    std::vector<interval_row> rows;
    table t{
        .columns = columns(
            "*parameter|unit|#prior|#hull (proved)|#left of the prior|#witness, about|~meaning"),
        .caption = "The hull contains every value that can explain the data; its ends are "
                   "rounded outward. What is left of the prior is at most the share of its "
                   "range that is given: values between the ends may be excluded, too."};
    for (parameter_view const& p : v.parameters) {
        interval_row row{p.name, p.unit, p.prior, p.hull};
        if (v.witness) {
            for (named_estimate const& w : v.witness->parameters) {
                if (w.name == p.name) row.witness = w.value;
            }
        }
        double const share = share_of_prior(p);
        t.rows.push_back(
            {p.name, unit_text(p.unit), given_text(p.prior), outward_text_within(p.hull, p.prior),
             std::isnan(share) ? "\xE2\x80\x93" : "≤ " + at_most_percent(share),
             row.witness
                 ? rounded_text(*row.witness, rounding::nearest, {.significant = 6, .shift = 0})
                 : std::string{},
             p.meaning});
        rows.push_back(std::move(row));
    }
    std::vector<legend_entry> legend{{symbol::prior, "prior"},
                                     {symbol::hull, "hull: all that can explain the data"}};
    if (v.witness) legend.push_back({symbol::witness, "witness"});
    out.add(figure{.panels = {draw_interval_chart(rows)},
                   .legend = legend,
                   .title = "What the data leave of the prior.",
                   .caption = "Each row has its own scale, from one end of the prior to the other.",
                   .layout = panel_layout::wide});
    out.add(t);
    out.subsection("Combinations that the data fix");
    table c{.columns = columns("*combination|unit|#over the prior|#hull (proved)|~remark")};
    for (combination_view const& k : v.combinations) {
        c.rows.push_back({formula_text(k.formula), unit_text(k.unit),
                          is_empty(k.prior) ? "" : outward_text(k.prior), outward_text(k.hull),
                          k.note});
    }
    out.add(c);
}

/// The projections, each with a closer look where one is worth it.
[[nodiscard]] inline figure paving_figure(std::vector<paving_projection> const& pavings,
                                          std::string title, std::string caption,
                                          paving_words const& words = {}) {
    // The zoom stands beside or below its whole view in the same order, so panels go in pairs.
    figure f{.legend = paving_plot_legend(pavings, words),
             .title = std::move(title),
             .caption = std::move(caption),
             .layout = panel_layout::pair,
             .data = paving_attributes(pavings, 3000, words)};
    for (paving_projection const& p : pavings) {
        std::string const name = p.y.label + " against " + p.x.label;
        f.panels.push_back(draw_paving_plot(p, name + ": " + words.whole));
        if (auto const closer = zoom_window(p))
            f.panels.push_back(draw_paving_plot(p, name + ": closer", closer));
    }
    return f;
}

inline void add_pavings(page& out, identification_view const& v) {
    if (v.pavings.empty()) return;
    out.section("The set of parameters that explain the data");
    bool const anything =
        std::any_of(v.pavings.begin(), v.pavings.end(), [](paving_projection const& p) {
            return std::any_of(p.boxes.begin(), p.boxes.end(),
                               [](projected_box const& b) { return b.verdict != region::outside; });
        });
    if (!anything) {
        out.prose("It is empty: every box of the paving was proved outside.");
        return;
    }
    if (!v.product_pavings.empty()) {
        out.add(paving_figure(
            v.product_pavings, "In the coordinates that the data fix.",
            std::string{"The search ran here, where a product of parameters counts as one: all "
                        "parameters whose products lie in an inside box are proved to explain the "
                        "data, all others than those of the boxes drawn are excluded. "}
                .append(projection_rule)));
    }
    out.add(paving_figure(v.pavings, "Projections of the paving of the parameters.",
                          std::string{projection_rule} +
                              " Regions are drawn with a hairline around them so that slivers can "
                              "be seen: the better region may look larger than it is by that much, "
                              "the outside never does."));
}

/// "The witness": its parameters and starts, exactly.
inline void add_witness(page& out, named_witness const& w) {
    out.subsection("The witness");
    out.prose("One point that was verified by validated integration: " + values_text(w.parameters) +
              ".");
    std::vector<std::string> starts;
    for (named_witness::start const& s : w.starts)
        starts.push_back("Scenario " + s.scenario + " starts at " + values_text(s.states) + ".");
    out.bullets(starts);
}

inline std::string sentence(std::string const& text) {
    return text.empty() ? text : text + (text.back() == '.' ? " " : ". ");
}

inline void add_key_figures(page& out, identification_view const& v) {
    std::vector<card> cards;
    if (v.verdict == outcome::refuted) {
        cards.push_back({"can explain the data", "nothing", "all of the prior is excluded"});
    } else if (is_finite(v.volume_outer)) {
        cards.push_back({"can explain the data", "≤ " + at_most_percent(v.volume_outer.hi),
                         "of the prior's volume (outer)"});
    }
    if (is_finite(v.volume_inner) && v.volume_inner.lo > 0) {
        cards.push_back({"proved to explain it", "≥ " + at_least_percent(v.volume_inner.lo),
                         "of the prior's volume (inner)"});
    }
    cards.push_back({"time", duration_text(v.statistics.seconds), v.statistics.stop_reason});
    if (v.statistics.boxes > 0) { // else nobody counted
        cards.push_back({"boxes", count_text(v.statistics.boxes), ""});
        cards.push_back({"integrations", count_text(v.statistics.integrations), "validated"});
    }
    std::size_t const scenarios = v.scenarios.size();
    std::size_t measurements = 0;
    for (scenario_view const& s : v.scenarios) measurements += s.measurements;
    if (scenarios > 0) {
        cards.push_back(
            {"measurements", count_text(measurements),
             "in " + count_text(scenarios) + (scenarios == 1 ? " scenario" : " scenarios")});
    }
    out.cards(cards);
}

inline void add_scenario(page& out, identification_view const& v, scenario_view const& s) {
    if (v.scenarios.size() > 1) out.subsection(s.name);
    std::string const tube = v.tube_meaning.empty() ? "" : "Enclosure: " + sentence(v.tube_meaning);
    std::string const reference =
        v.reference_meaning.empty() ? "" : "Reference line: " + sentence(v.reference_meaning);
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
        out.add(figure{.panels = {draw_plane_plot(*s.plane)},
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
    table found{.columns = columns("*scenario|*channel|#time [" + unit_text(v.time_unit) +
                                   "]|~what is known")};
    constexpr std::size_t most = 100;
    std::size_t marked = 0;
    for_marked(v, [&](scenario_view const& s, channel_series const& c, measured_sample const& m) {
        if (++marked > most) return;
        found.rows.push_back({s.name, c.name, given_text(m.time),
                              m.state == sample_state::forced_outlier
                                  ? "proved: violated by every parameter that explains the data"
                                  : "suspected: violated by the witness; not proved"});
    });
    if (marked == 0 && budget == 0) return;
    if (marked > most)
        found.caption = "The first " + count_text(most) + " of " + count_text(marked) + ".";
    out.section("Outliers");
    table allowed{.columns = columns("*scenario|#measurements|#outliers allowed")};
    for (scenario_view const& s : v.scenarios) {
        allowed.rows.push_back({s.name, count_text(s.measurements), count_text(s.outlier_budget)});
    }
    out.add(allowed);
    out.add(found);
}

inline void add_computation(page& out, identification_view const& v) {
    out.section("How it was computed");
    out.prose("The run took " + duration_text(v.statistics.seconds) + " for " +
              count_text(v.statistics.boxes) + " boxes and " +
              count_text(v.statistics.integrations) + " validated integrations. " +
              (v.statistics.stop_reason.empty()
                   ? ""
                   : "Why it stopped: " + sentence(v.statistics.stop_reason)));
    table t{.columns = columns("volume relative to the prior|#proved within")};
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
    out.subsection("Against other ways to solve it");
    table c{.columns =
                columns("*method|#time|#boxes|#integrations|#inner volume|#outer volume|~remark"),
            .caption = v.comparison_note};
    for (comparison_row const& r : v.comparison) {
        if (r.chosen) c.chosen_row = c.rows.size();
        c.rows.push_back(
            {r.name, r.seconds ? duration_text(*r.seconds) : "",
             r.boxes ? count_text(*r.boxes) : "", r.integrations ? count_text(*r.integrations) : "",
             percent_interval(r.inner_volume), percent_interval(r.outer_volume), r.note});
    }
    out.add(c);
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

/// The whole page of an identification. Sections without content are left out.
[[nodiscard]] inline page identification_page(identification_view const& v) {
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
    out.subsection("Why little is excluded").sentences(v.statistics.why);
    detail::add_pavings(out, v);
    detail::add_identifiability(out, v);
    out.section("Measurements and model");
    for (scenario_view const& s : v.scenarios) detail::add_scenario(out, v, s);
    detail::add_outliers(out, v);
    detail::add_computation(out, v);
    if (v.witness) detail::add_witness(out, *v.witness);
    out.footer(v.footer);
    return out;
}

} // namespace sivid::report

#endif
