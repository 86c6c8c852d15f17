// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_DETAIL_PLACE_ESTIMATE_HPP
#define SIVID_APPROXIMATE_PLACE_DETAIL_PLACE_ESTIMATE_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/approximate/place/estimated_place.hpp>
#include <sivid/approximate/place/place_options.hpp>
#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>

namespace sivid {

/// Where does the model depart from the data, and how? Nothing is reported when some parameters
/// explain all of it.
/// @param base  the best fit of the problem where it is known already
/// @cost  some tens of fits, each of them some ten simulations with sensitivities
[[nodiscard]] SIVID_DECL place_estimate estimate_places(identification_problem const& problem,
                                                        place_options options = {},
                                                        approximate_fit const* base = nullptr);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/approximate/place/impl/place_estimate.ipp>
#endif

#endif
