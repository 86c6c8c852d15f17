// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DETAIL_STORED_FIELDS_HPP
#define SIVID_REPORT_DETAIL_STORED_FIELDS_HPP

#include <sivid/report/decision_page.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/identification_view.hpp>

#include <cstddef>

namespace sivid::report::detail {

/// How many members a type has whose values stand one after the other; 0: it is no such type. A
/// wrong number does not compile.
template <class T>
inline constexpr std::size_t fields_of = 0;
// clang-format off

// Of drawings.
template <> inline constexpr std::size_t fields_of<range> = 2;
template <> inline constexpr std::size_t fields_of<point> = 2;
template <> inline constexpr std::size_t fields_of<axis> = 3;
template <> inline constexpr std::size_t fields_of<measured_sample> = 4;
template <> inline constexpr std::size_t fields_of<tube_piece> = 3;
template <> inline constexpr std::size_t fields_of<channel_series> = 14;
template <> inline constexpr std::size_t fields_of<plane_box> = 2;
template <> inline constexpr std::size_t fields_of<pose> = 3;
template <> inline constexpr std::size_t fields_of<plane_series> = 7;
template <> inline constexpr std::size_t fields_of<projected_box> = 3;
template <> inline constexpr std::size_t fields_of<paving_projection> = 4;

// Of identifications.
template <> inline constexpr std::size_t fields_of<parameter_view> = 6;
template <> inline constexpr std::size_t fields_of<combination_view> = 5;
template <> inline constexpr std::size_t fields_of<outlier_view> = 4;
template <> inline constexpr std::size_t fields_of<scenario_view> = 5;
template <> inline constexpr std::size_t fields_of<statistics_view> = 5;
template <> inline constexpr std::size_t fields_of<tried_view> = 4;
template <> inline constexpr std::size_t fields_of<comparison_row> = 8;
template <> inline constexpr std::size_t fields_of<identification_view> = 31;

// Of diagnoses.
template <> inline constexpr std::size_t fields_of<diagnosis> = 31;
template <> inline constexpr std::size_t fields_of<diagnosis_report_options> = 8;
template <> inline constexpr std::size_t fields_of<diagnosis_plot_data> = 3;
template <> inline constexpr std::size_t fields_of<compared_scenario> = 3;
template <> inline constexpr std::size_t fields_of<missing_rate> = 3;
template <> inline constexpr std::size_t fields_of<named_estimate> = 5;
template <> inline constexpr std::size_t fields_of<named_witness> = 2;
template <> inline constexpr std::size_t fields_of<named_witness::start> = 2;
template <> inline constexpr std::size_t fields_of<time_window> = 3;
template <> inline constexpr std::size_t fields_of<broken_relation_report> = 6;
template <> inline constexpr std::size_t fields_of<suspected_place> = 11;
template <> inline constexpr std::size_t fields_of<confined_gap> = 8;
template <> inline constexpr std::size_t fields_of<noise_growth> = 6;
template <> inline constexpr std::size_t fields_of<error_correlation> = 3;
template <> inline constexpr std::size_t fields_of<reading_steps> = 3;
template <> inline constexpr std::size_t fields_of<run_reach> = 15;
template <> inline constexpr std::size_t fields_of<run_reach::cause> = 4;
template <> inline constexpr std::size_t fields_of<contraction_record> = 7;
template <> inline constexpr std::size_t fields_of<cause> = 13;
template <> inline constexpr std::size_t fields_of<holdout_figures> = 11;
template <> inline constexpr std::size_t fields_of<tried_candidates> = 3;
template <> inline constexpr std::size_t fields_of<tried_candidates::count> = 2;
template <> inline constexpr std::size_t fields_of<changed_formulas> = 2;
template <> inline constexpr std::size_t fields_of<named_combination> = 4;
template <> inline constexpr std::size_t fields_of<named_combination::part> = 2;
template <> inline constexpr std::size_t fields_of<constant_at_end> = 3;
template <> inline constexpr std::size_t fields_of<unexplained_remainder> = 3;
template <> inline constexpr std::size_t fields_of<next_experiment> = 4;
template <> inline constexpr std::size_t fields_of<withdrawn_claim> = 2;

// Of decisions.
template <> inline constexpr std::size_t fields_of<decision_page_options> = 9;
template <> inline constexpr std::size_t fields_of<simulated_line> = 4;
template <> inline constexpr std::size_t fields_of<prediction> = 10;
template <> inline constexpr std::size_t fields_of<predicted_tube> = 5;
template <> inline constexpr std::size_t fields_of<verification> = 9;
template <> inline constexpr std::size_t fields_of<truth> = 7;
template <> inline constexpr std::size_t fields_of<decisive_place> = 2;
template <> inline constexpr std::size_t fields_of<violating_motion> = 4;
template <> inline constexpr std::size_t fields_of<open_box> = 5;
template <> inline constexpr std::size_t fields_of<design_answer> = 12;
template <> inline constexpr std::size_t fields_of<design_goal> = 2;
template <> inline constexpr std::size_t fields_of<planned_measurements> = 2;
template <> inline constexpr std::size_t fields_of<varied_input> = 5;
template <> inline constexpr std::size_t fields_of<experiment_design> = 4;
template <> inline constexpr std::size_t fields_of<tried_manoeuvre> = 7;
template <> inline constexpr std::size_t fields_of<manoeuvre_setting> = 4;
template <> inline constexpr std::size_t fields_of<promise> = 6;
template <> inline constexpr std::size_t fields_of<promised_width> = 3;
template <> inline constexpr std::size_t fields_of<ranking> = 7;
template <> inline constexpr std::size_t fields_of<channel_effects> = 3;
template <> inline constexpr std::size_t fields_of<parameter_effect> = 9;
template <> inline constexpr std::size_t fields_of<exact_measurements> = 4;
template <> inline constexpr std::size_t fields_of<dependence_structure> = 3;
template <> inline constexpr std::size_t fields_of<combination> = 4;
template <> inline constexpr std::size_t fields_of<measurement_ranking> = 7;
template <> inline constexpr std::size_t fields_of<measurement_worth> = 4;
template <> inline constexpr std::size_t fields_of<measurement_group> = 4;
template <> inline constexpr std::size_t fields_of<bridged_input> = 5;

// Of models.
template <> inline constexpr std::size_t fields_of<model_description> = 6;
template <> inline constexpr std::size_t fields_of<model_description::state> = 4;
template <> inline constexpr std::size_t fields_of<model_description::item> = 2;
template <> inline constexpr std::size_t fields_of<model_description::constant> = 4;
template <> inline constexpr std::size_t fields_of<state_range> = 2;
template <> inline constexpr std::size_t fields_of<literal> = 2;
template <> inline constexpr std::size_t fields_of<paved_box> = 2;

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
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l] = x;
        f(a, b, c, d, e, f_, g, h, i, j, k, l);
    }
    else if constexpr (N == 13) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l, m] = x;
        f(a, b, c, d, e, f_, g, h, i, j, k, l, m);
    }
    else if constexpr (N == 14) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l, m, n] = x;
        f(a, b, c, d, e, f_, g, h, i, j, k, l, m, n);
    }
    else if constexpr (N == 15) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o] = x;
        f(a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o);
    }
    else if constexpr (N == 31) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x_, y, z, aa, ab, ac,
          ad, ae] = x;
        f(a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x_, y, z, aa, ab, ac, ad,
          ae);
    }
    else static_assert(N == 0, "with_fields: add this number of members");
}
// clang-format on

} // namespace sivid::report::detail

#endif
