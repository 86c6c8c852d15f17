// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_FILL_DETAIL_DIAGNOSIS_PLOT_DATA_HPP
#define SIVID_REPORT_FILL_DETAIL_DIAGNOSIS_PLOT_DATA_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/report/draw/channel_series.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

/// One channel of one scenario. Any list may be shorter or empty: what is missing is not drawn.
struct channel_data {
    std::string name{};
    std::string unit{};
    std::vector<double> times{};  ///< of the measurements
    std::vector<double> values{}; ///< measured
    std::vector<double> bounds{}; ///< |true - measured| is at most this
    std::vector<double> base{};   ///< outputs of the model's best fit at `times`
    std::vector<double> after{};  ///< outputs of the fit with the effect at `times`
    std::vector<bool> outliers{}; ///< suspected
    std::vector<double> base_line{}, after_line{}; ///< at the scenario's `line_times`
    std::vector<tube_piece> tube{};                ///< predicted with the effect
};

struct scenario_data {
    std::string name{};
    bool holdout = false;
    std::vector<double> line_times{}; ///< finer than the samples; empty: lines join the samples
    std::vector<channel_data> channels{};
};

/// The missing rate of one equation in one scenario.
struct missing_rate_data {
    std::string equation{};
    std::string scenario{};
    std::string unit{};
    std::vector<double> times{};
    std::vector<double> values{};      ///< estimate
    std::vector<double> uncertainty{}; ///< half width of its band, estimate
    struct window {
        double from = 0, to = 0;
        interval missing{}; ///< proved bounds of the mean
    };
    std::vector<window> windows{};
};

/// What the page draws beside the diagnosis.
struct diagnosis_plot_data {
    std::vector<scenario_data> scenarios{};
    std::vector<missing_rate_data> missing_rates{};
    std::vector<missing_rate_data> remaining_rates{}; ///< with the closest candidate
};

namespace detail {

/// Marks the q largest misfits beyond their bounds; none without an outlier budget.
SIVID_DECL std::vector<bool> suspects(std::vector<double> const& residuals, std::size_t n,
                                      std::size_t q);

} // namespace detail

/// The measurements of every experiment with the outputs of two fits to them, at the samples. A fit
/// without residuals is not drawn. Suspected outliers are the largest misfits of the second fit (of
/// the first when there is no second), as many as the budget allows.
/// @pre  both fits are of problems with these measurements, with whatever effects
[[nodiscard]] SIVID_DECL std::vector<scenario_data>
compared_scenarios(identification_problem const& problem, approximate_fit const& base,
                   approximate_fit const& after = {}, bool holdout = false);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/fill/impl/diagnosis_plot_data.ipp>
#endif

#endif
