// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_BOUND_INFLUENCE_HPP
#define SIVID_PAVING_BOUND_INFLUENCE_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identify_options.hpp>
#include <sivid/paving/verdict.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace sivid {

/// What other error bounds would leave of the prior.
struct bound_influence {
    std::optional<std::size_t> channel{}; ///< whose bounds; none: those of all channels
    double scale = 1;                     ///< so many times as wide as stated, about their middles
    verdict found = verdict::undecided;
    bool ended = true; ///< the search ended by itself; else more time may leave less
    box hull{};        ///< of the parameters; empty sides: none explains such data
};

/// What `identify` leaves with the stated bounds, with those of all channels scaled, and with those
/// of one channel after the other: which bound decides how wide the ranges are.
/// @param scales  each above 0, such as {0.5, 2}
/// @param options `search.seconds` and `search.boxes` are those of all searches together
/// @returns  the stated bounds first, then all channels, then each (where more than one is
///           measured), each with every scale
/// @throws std::invalid_argument  for an invalid problem, or a scale that is not above 0
/// @guarantee  each hull contains every parameter that would explain its data
/// @cost  that of 1 + scales * (1 + channels) searches
[[nodiscard]] SIVID_DECL std::vector<bound_influence>
influence_of_bounds(identification_problem const& problem, std::vector<double> const& scales,
                    identify_options options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/impl/bound_influence.ipp>
#endif

#endif
