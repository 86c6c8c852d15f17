// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_HOLD_OUT_DETAIL_HOLDOUT_RESULTS_HPP
#define SIVID_DIAGNOSIS_HOLD_OUT_DETAIL_HOLDOUT_RESULTS_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/diagnosis/diagnosis.hpp>

#include <limits>
#include <optional>
#include <vector>

namespace sivid {

/// How a fitted candidate does on hold-out data.
struct holdout_judgement {
    inflation_range at_witness = unknown_inflation(); ///< of the fit's witness
    /// Over all parameters that explain the fit data; where none is known to, over those whose fit
    /// inflation is at most the proved upper bound.
    std::optional<inflation_range> over_fits;
    std::vector<double> rmse; ///< per channel; NaN: not measured
    double covered = std::numeric_limits<double>::quiet_NaN();
    double width = std::numeric_limits<double>::quiet_NaN();
    approximate_fit run; ///< residuals of the motion at the witness
};

} // namespace sivid

#endif
