// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DETAIL_STORED_FIELDS_HPP
#define SIVID_REPORT_DETAIL_STORED_FIELDS_HPP

#include <sivid/report/decision_page.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/identification_view.hpp>

#include <concepts>
#include <cstddef>

namespace sivid::report::detail {

template <class T, class... Ts>
inline constexpr bool one_of = (std::same_as<T, Ts> || ...);

/// How many members a type has whose values stand one after the other; 0: it is no such type. A
/// wrong number does not compile.
template <class T>
inline constexpr std::size_t fields_of =
    one_of<T, range, point, plane_box, named_witness, named_witness::start, tried_candidates::count,
           changed_formulas, named_combination::part, withdrawn_claim, decisive_place, design_goal,
           planned_measurements, model_description::item, state_range, literal, paved_box>
        ? 2
    : one_of<T, axis, tube_piece, pose, projected_box, diagnosis_plot_data, compared_scenario,
             missing_rate, time_window, error_correlation, reading_steps, tried_candidates,
             constant_at_end, unexplained_remainder, promised_width, channel_effects,
             dependence_structure>
        ? 3
    : one_of<T, measured_sample, paving_projection, run_reach::cause,
             named_combination, next_experiment, simulated_line, violating_motion,
             experiment_design, manoeuvre_setting, exact_measurements, combination,
             measurement_worth, measurement_group, model_description::state,
             model_description::constant>
        ? 4
    : one_of<T, combination_view, scenario_view, statistics_view, named_estimate, predicted_tube,
             open_box, varied_input, bridged_input>
        ? 5
    : one_of<T, parameter_view, broken_relation_report, noise_growth, promise, model_description>
        ? 6
    : one_of<T, plane_series, contraction_record, truth, tried_manoeuvre, ranking,
             measurement_ranking>
        ? 7
    : one_of<T, comparison_row, diagnosis_report_options, confined_gap> ? 8
    : one_of<T, decision_page_options, verification, parameter_effect>  ? 9
    : one_of<T, prediction>                                             ? 10
    : one_of<T, suspected_place, holdout_figures>                       ? 11
    : one_of<T, design_answer>                                          ? 12
    : one_of<T, cause>                                                  ? 13
    : one_of<T, channel_series>                                         ? 14
    : one_of<T, run_reach>                                              ? 15
    : one_of<T, identification_view>                                    ? 27
    : one_of<T, diagnosis>                                              ? 32
                                                                        : 0;

// clang-format off
/// Calls f with all members.
template <std::size_t N>
void with_fields(auto& x, auto const& f) {
    if constexpr (N == 2) { auto& [a, b] = x; f(a, b); }
    else if constexpr (N == 3) { auto& [a, b, c] = x; f(a, b, c); }
    else if constexpr (N == 4) { auto& [a, b, c, d] = x; f(a, b, c, d); }
    else if constexpr (N == 5) { auto& [a, b, c, d, e] = x; f(a, b, c, d, e); }
    else if constexpr (N == 6) { auto& [a, b, c, d, e, f_] = x; f(a, b, c, d, e, f_); }
    else if constexpr (N == 7) { auto& [a, b, c, d, e, f_, g] = x; f(a, b, c, d, e, f_, g); }
    else if constexpr (N == 8) { auto& [a, b, c, d, e, f_, g, h] = x; f(a, b, c, d, e, f_, g, h); }
    else if constexpr (N == 9) { auto& [a, b, c, d, e, f_, g, h, i] = x; f(a, b, c, d, e, f_, g, h, i); }
    else if constexpr (N == 10) { auto& [a, b, c, d, e, f_, g, h, i, j] = x; f(a, b, c, d, e, f_, g, h, i, j); }
    else if constexpr (N == 11) { auto& [a, b, c, d, e, f_, g, h, i, j, k] = x; f(a, b, c, d, e, f_, g, h, i, j, k); }
    else if constexpr (N == 12) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l] = x; f(a, b, c, d, e, f_, g, h, i, j, k, l);
    }
    else if constexpr (N == 13) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l, m] = x; f(a, b, c, d, e, f_, g, h, i, j, k, l, m);
    }
    else if constexpr (N == 14) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l, m, n] = x; f(a, b, c, d, e, f_, g, h, i, j, k, l, m, n);
    }
    else if constexpr (N == 15) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o] = x; f(a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o);
    }
    else if constexpr (N == 27) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x_, y, z, aa] = x;
        f(a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x_, y, z, aa);
    }
    else if constexpr (N == 32) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x_, y, z, aa, ab, ac,
          ad, ae, af] = x;
        f(a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x_, y, z, aa, ab, ac, ad,
          ae, af);
    }
    else static_assert(N == 0, "with_fields: add this number of members");
}
// clang-format on

} // namespace sivid::report::detail

#endif
