// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IDENTIFY_HPP
#define SIVID_PAVING_IDENTIFY_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/identify_options.hpp>

namespace sivid {

/// Finds the parameters in the prior that can explain the data: those for which, in every
/// experiment, some start in its box and inputs within their error bounds give outputs of which at
/// most `outliers` leave their measured bounds.
/// @param problem  times, states and parameters in the units of its model
/// @returns  verdict, hulls, paving, identifiable combinations, a witness; `reason` says what ended
///           the search. A budget that ends is no error
/// @throws std::invalid_argument  for a problem that does not fit together (`require_valid` names
///         what), or a state to resume from of another problem or altered (a proof shows)
/// @throws std::logic_error       where a verified witness lies in no box that is left: a proof is
///         wrong
/// @throws unsound_environment    where interval arithmetic would prove nothing (`guard.hpp`)
/// @guarantee  `consistent`: a parameter and starts exist; `inconsistent`: none in the whole prior;
///             `hull`, `paving`, `combinations` contain every feasible parameter; inside boxes are
///             feasible throughout. All under the listed assumptions.
/// @cost  dominated by the integrations: boxes times experiments
[[nodiscard]] SIVID_DECL identification identify(identification_problem const& problem,
                                                 identify_options options = {});

/// The options of the report's Algorithm 2, and of Algorithm 1 where no experiment has outliers:
/// bisection alone, first box in, first out, to an accuracy that is a share of the prior.
[[nodiscard]] inline identify_options by_bisection(identify_options options) {
    options.test.contract = false;
    options.search.order = search_order::first_in;
    options.search.accuracy_of_hull = false;
    return options;
}

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/impl/identify.ipp>
#endif

#endif
