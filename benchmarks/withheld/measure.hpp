// SPDX-License-Identifier: MIT
// How far a model is from data, in units of the stated bounds.
#ifndef WITHHELD_MEASURE_HPP
#define WITHHELD_MEASURE_HPP

#include "campaign.hpp"

namespace withheld {

enum class part { fit, holdout };

/// At the true constants and starts: the largest |truth - model|/bound over the fit scenarios, for
/// a model with these effects.
double largest_deviation(campaign const& c, effect_values const& e, foreign_values const& f);

/// The most by which noise that grows with values and rates widens a bound of the fit scenarios, in
/// its own size.
double largest_growth(campaign const& c);

/// Whether the heading goes well beyond an angle below 0 in one of the fit scenarios.
bool heading_passes(campaign const& c, double angle);

/// At the true constants and starts: the factor by which all bounds must grow until the model with
/// these effects explains the written data, outliers beyond the budget excepted. The true inflation
/// of that model, a minimum, is at most this.
double inflation_at_truth(campaign const& c, bool with_effects, part which);

/// The (allowed + 1)-th largest of some misfits; they are reordered.
double inflation_of(std::vector<double>& misfits, std::size_t allowed);

} // namespace withheld

#endif
