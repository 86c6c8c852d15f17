// SPDX-License-Identifier: MIT
// Parts of the data that are said to stand alone against the model.
#ifndef WITHHELD_CONFINED_HPP
#define WITHHELD_CONFINED_HPP

#include "labels.hpp"
#include "recorded.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace withheld {

/// "v in S1+S3"
std::string confined_text(nlohmann::json const& part);

/// The recording with the bounds of a part so many times as wide.
recording loosened(recording data, nlohmann::json const& part, double factor);

/// The recording with bounds of a part that grow with what the fit that it names shows, or
/// with the rate of that, so many times. Nothing where that fit is not told.
std::optional<recording> grown(recording data, nlohmann::json const& part, double units);

/// Whether a part is where the truth lies: the channel whose bounds are too small, or experiments
/// in which the effect acts while it does not in others. Nothing for other truths.
std::optional<bool> is_confined_to(label const& truth, recording const& data,
                                   nlohmann::json const& part);

} // namespace withheld

#endif
