// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_IDENTIFICATION_CHECK_HPP
#define SIVID_VERIFIER_IDENTIFICATION_CHECK_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/result/same_problem.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/verifier/check_finding.hpp>

#include <functional>
#include <vector>

namespace sivid {

/// Checks a stored identification against its problem, from nothing but the model and the data, in
/// doubles; in 40 digits: `mp_identification_check.hpp`.
/// @given  `require_same_problem`; the problem has the outlier budgets of the result
/// @param tell  receives each finding as soon as it is there; may be empty
[[nodiscard]] SIVID_DECL std::vector<check_finding>
check_identification(identification_problem const& problem, stored_identification const& stored,
                     identification_check_options const& options,
                     std::function<void(check_finding const&)> const& tell = nullptr);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/verifier/impl/identification_check.ipp>
#endif

#endif // SIVID_VERIFIER_IDENTIFICATION_CHECK_HPP
