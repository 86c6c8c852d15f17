// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_IDENTIFIABILITY_CHECK_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_IDENTIFIABILITY_CHECK_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identifiability.hpp>
#include <sivid/verifier/claim/check_finding.hpp>

#include <functional>

namespace sivid {

/// What of it is called proved.
[[nodiscard]] SIVID_DECL stored_identification::identifiability_claims
claims_of(identifiability const& found);

/// Ranks, motions and formulas that a result calls proved, computed anew from the equations.
/// @param keep_going  once false, what is not computed by then is not decided
[[nodiscard]] SIVID_DECL check_finding
check_identifiability(identification_problem const& problem, stored_identification const& stored,
                      std::function<bool()> const& keep_going = nullptr);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/verifier/claim/impl/identifiability_check.ipp>
#endif

#endif
