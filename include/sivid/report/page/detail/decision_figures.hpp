// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_PAGE_DETAIL_DECISION_FIGURES_HPP
#define SIVID_REPORT_PAGE_DETAIL_DECISION_FIGURES_HPP

#include <sivid/decision/prediction.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/io/result/stored_prediction.hpp>
#include <sivid/report/draw/detail/motion_plot.hpp>
#include <sivid/report/identification_words.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/page.hpp>
#include <sivid/report/page/decision_page_options.hpp>
#include <sivid/report/table.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

namespace detail {

/// The tube in pieces for a drawing: each cell with its instants.
inline motion_series series_of(std::vector<double> const& times, predicted_tube const& tube) {
    motion_series m;
    m.tube.name = tube.name;
    m.tube.unit = tube.unit;
    m.tube.time_unit = tube.time_unit;
    for (std::size_t s = 1; s < tube.low.size(); s += 2) {
        range const value{std::min({tube.low[s - 1], tube.low[s], tube.low[s + 1]}),
                          std::max({tube.high[s - 1], tube.high[s], tube.high[s + 1]})};
        if (is_finite(value)) m.tube.tube.push_back({times[s / 2], times[s / 2 + 1], value});
    }
    return m;
}

inline std::vector<point> line_of(simulated_line const& l,
                                  std::vector<std::vector<double>> const& values, std::size_t k) {
    std::vector<point> line;
    for (std::size_t n = 0; n < values.size() && n < l.times.size(); ++n) {
        if (k < values[n].size()) line.push_back({l.times[n], values[n][k]});
    }
    return line;
}

/// One value as it was given; a range outward.
inline std::string text_of(interval const& x) {
    return std::nextafter(x.lower(), HUGE_VAL) < x.upper() ? outward_text(x) : given_text(mid(x));
}

inline std::string named(std::vector<std::string> const& names, std::vector<double> const& x) {
    std::string text;
    for (std::size_t i = 0; i < x.size() && i < names.size(); ++i)
        text += (text.empty() ? "" : ", ") + names[i] + " = " + exact_text(x[i]);
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

/// A tube with the simulated lines of its values in it.
inline motion_series series_with_lines(std::vector<double> const& times, predicted_tube const& tube,
                                       decision_page_options const& o,
                                       std::vector<std::vector<double>> simulated_line::*values,
                                       std::size_t k) {
    auto m = series_of(times, tube);
    m.tube.reference = line_of(o.least_squares, o.least_squares.*values, k);
    m.single = line_of(o.single, o.single.*values, k);
    return m;
}

inline void add_motions(page& out, prediction const& found, decision_page_options const& o) {
    std::vector<motion_series> all;
    for (std::size_t c = 0; c < found.channels.size(); ++c) {
        all.push_back(
            series_with_lines(found.times, found.channels[c], o, &simulated_line::channels, c));
    }
    for (std::size_t i = 0; i < found.states.size(); ++i) {
        bool const shown =
            std::any_of(found.channels.begin(), found.channels.end(),
                        [&](auto const& c) { return c.name == found.states[i].name; });
        if (shown) continue;
        all.push_back(
            series_with_lines(found.times, found.states[i], o, &simulated_line::states, i));
    }
    figure f{.legend = motion_plot_legend(all, o.single_is),
             .title = "The motion, for all parameters and starts.",
             .caption = std::string{"The band is proved: every motion of the model, for every "
                                    "parameter that the identification leaves and every start of "
                                    "the scenario, runs within it at every instant"} +
                        (found.complete ? "" : " at which there is one") +
                        ". The lines are simulated in floating point and prove nothing."};
    for (auto const& m : all) f.panels.push_back(draw_motion_plot(m, {.title = m.tube.name}));
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
    std::vector<motion_series> margins;
    for (std::size_t c = 0; c < tubes.further.size(); ++c) {
        auto m = series_with_lines(tubes.times, tubes.further[c], o, &simulated_line::further, c);
        m.tube.name = "margin";
        m.zero = true;
        margins.push_back(std::move(m));
    }
    figure f{.legend = motion_plot_legend(margins, o.single_is),
             .title = "The margins of the comparisons, for all parameters and starts.",
             .caption = "A comparison holds where its margin is above 0, each of its margins if it "
                        "has several sides. The requirement's text says when it has to."};
    for (std::size_t c = 0; c < margins.size(); ++c)
        f.panels.push_back(draw_motion_plot(margins[c], {.title = margin_title(asked.labels, c)}));
    out.section("The requirement against the tube");
    out.add(f);
}

/// The end of a page: the parameters that it speaks of, and what it rests on.
inline void add_basis(page& out, stored_prediction const& about, decision_page_options const& o,
                      std::vector<std::string> const& assumptions) {
    out.section("For which parameters");
    auto const around = about.problem.around();
    table t{.columns = {{"quantity", column_kind::symbol}, {"range", column_kind::number}}};
    for (std::size_t j = 0; j < around.size(); ++j)
        t.rows.push_back({formula_text(about.sides[j]), text_of(around[j])});
    t.caption = "The smallest ranges around the union of " + count_text(about.problem.sets.size()) +
                (about.in_products ? " boxes, in the products that the data fix."
                                   : " boxes of parameters.");
    out.add(t);
    if (!o.set.empty()) out.bullets(o.set);
    table starts{
        .columns = {{"state", column_kind::symbol}, {"start", column_kind::number}, {"unit"}}};
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

} // namespace detail

} // namespace sivid::report

#endif
