// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_DIAGNOSIS_REPORT_IPP
#define SIVID_REPORT_IMPL_DIAGNOSIS_REPORT_IPP

#include <sivid/report/diagnosis_report.hpp>

#include <sivid/report/detail/reach_words.hpp>
#include <sivid/report/draw/candidate_chart.hpp>

#include <utility>

namespace sivid::report {

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
