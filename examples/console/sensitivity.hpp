// SPDX-License-Identifier: MIT
// How the verdict of a diagnosis hangs on a bound that was chosen: the inflation is the factor by
// which the bound would have to grow, so that every model has its own threshold.
#ifndef EXAMPLES_CONSOLE_SENSITIVITY_HPP
#define EXAMPLES_CONSOLE_SENSITIVITY_HPP

#include "diagnosis_output.hpp"

#include <sivid/report/page.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace console {

/// The bound that a program states for its measurements.
struct stated_bound {
    double value = 1; ///< in `unit`
    std::string unit;
};

namespace detail {

/// A model with its inflation: proved range, and that of the best fit.
struct threshold {
    std::vector<std::string> effects;
    sivid::interval proved;
    double fitted = 0;
};

/// The model as it is, then the candidates by the number of their effects and by fit.
inline std::vector<threshold> thresholds(sivid::diagnosis_run const& run) {
    std::vector<threshold> all{
        {{}, run.result.inflation, run.candidates.front().figures.inflation}};
    for (auto const& c : run.result.causes) {
        if (!c.effects.empty()) all.push_back({c.effects, c.inflation, c.fitted_inflation});
    }
    std::stable_sort(all.begin() + 1, all.end(), [](auto const& a, auto const& b) {
        return a.effects.size() != b.effects.size() ? a.effects.size() < b.effects.size()
                                                    : a.fitted < b.fitted;
    });
    return all;
}

inline std::string scaled(double factor, stated_bound const& bound,
                          sivid::report::rounding how = sivid::report::rounding::nearest) {
    if (!std::isfinite(factor) || !(factor > 0)) return "-";
    return sivid::report::rounded_text(factor * bound.value, how);
}

} // namespace detail

/// Two tables: which model is the answer for which bound, and each model's thresholds.
inline void add_sensitivity(sivid::report::page& page, sivid::diagnosis_run const& run,
                            stated_bound const& bound, std::string const& meaning) {
    namespace report = sivid::report;
    if (run.candidates.empty()) return;
    auto const all = detail::thresholds(run);
    page.section("How the verdict depends on the bound");
    page.prose(meaning + " An inflation is the factor by which the bound would have to grow until "
                         "a model explains the data, so that each model has its own threshold.");

    report::table curve{.columns = {{"bound [" + bound.unit + "]", report::column_kind::text},
                                    {"factor", report::column_kind::text},
                                    {"fewest effects that explain", report::column_kind::symbol},
                                    {"witness", report::column_kind::text}},
                        .rows = {},
                        .caption = "The answer as the bound changes, by the best fits found; "
                                   "verified: proved from that bound on."};
    double above = HUGE_VAL;
    for (auto const& t : all) {
        if (!(t.fitted < above)) continue;
        bool const top = !std::isfinite(above);
        curve.rows.push_back(
            {top ? "from " + detail::scaled(t.fitted, bound)
                 : detail::scaled(t.fitted, bound) + " to " + detail::scaled(above, bound),
             "from " + report::rounded_text(t.fitted, report::rounding::nearest),
             model_words(t.effects),
             std::isfinite(t.proved.upper())
                 ? "verified from " + detail::scaled(t.proved.upper(), bound, report::rounding::up)
                 : std::string{"-"}});
        above = t.fitted;
    }
    curve.rows.push_back({"below " + detail::scaled(above, bound),
                          "below " + report::rounded_text(above, report::rounding::nearest),
                          "unexplained", "-"});
    page.add(curve);

    report::table each{
        .columns = {{"model", report::column_kind::symbol},
                    {"refuted below [" + bound.unit + "]", report::column_kind::number},
                    {"explains from [" + bound.unit + "]", report::column_kind::number},
                    {"best fit [" + bound.unit + "]", report::column_kind::number}},
        .rows = {},
        .caption = "Refuted below and explains from: proved thresholds of the "
                   "bound, - where nothing is proved; best fit: estimate. The "
                   "foremost candidates."};
    std::size_t pairs = 0;
    std::size_t more = 0;
    for (auto const& t : all) {
        if (t.effects.size() == 2 && ++pairs > 4) continue;
        if (t.effects.size() > 2 && ++more > 3) continue;
        each.rows.push_back({model_words(t.effects),
                             detail::scaled(t.proved.lower(), bound, report::rounding::down),
                             detail::scaled(t.proved.upper(), bound, report::rounding::up),
                             detail::scaled(t.fitted, bound)});
    }
    page.add(each);
}

} // namespace console

#endif
