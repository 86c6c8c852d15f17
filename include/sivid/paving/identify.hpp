// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IDENTIFY_HPP
#define SIVID_PAVING_IDENTIFY_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/identify_options.hpp>

namespace sivid {

/// Finds the parameters in the prior that can explain the data.
/// @guarantee  `consistent`: a parameter and starts exist; `inconsistent`: none in the whole prior;
///             `hull`, `paving`, `combinations` contain every feasible parameter; inside boxes are
///             feasible throughout. All under the listed assumptions.
/// @cost  dominated by the integrations: boxes times experiments
[[nodiscard]] SIVID_DECL identification identify(identification_problem const& problem,
                                                 identify_options options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/impl/identify.ipp>
#endif

#endif
