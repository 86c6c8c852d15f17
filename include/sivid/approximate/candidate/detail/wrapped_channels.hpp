// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_CANDIDATE_DETAIL_WRAPPED_CHANNELS_HPP
#define SIVID_APPROXIMATE_CANDIDATE_DETAIL_WRAPPED_CHANNELS_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>

#include <vector>

namespace sivid {

/// A catalogue, and an effect (`sensor_wrap`) for each channel whose readings wrap and that none of
/// it wraps: what leaps so is in the data, whatever else may be wrong. There is none where turns
/// cannot be counted (`affected`).
[[nodiscard]] SIVID_DECL std::vector<effect>
with_wrapped_channels(identification_problem const& problem, std::vector<effect> catalogue);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/approximate/candidate/impl/wrapped_channels.ipp>
#endif

#endif
