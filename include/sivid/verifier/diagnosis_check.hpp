// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_DIAGNOSIS_CHECK_HPP
#define SIVID_VERIFIER_DIAGNOSIS_CHECK_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/holdout.hpp>
#include <sivid/io/diagnosis_reader.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/judge/feasibility_test_options.hpp>
#include <sivid/verifier/check_finding.hpp>

#include <functional>
#include <vector>

namespace sivid {

struct diagnosis_check_options {
    double seconds = 60;             ///< for everything; what is not proved by then is not decided
    feasibility_test_options test{}; ///< how boxes are enclosed; its `keep_going` ends the check
    holdout const* held_out = nullptr; ///< the data by which the diagnosis was judged, if any
};

/// Proves a stored diagnosis anew, from nothing but the model, the catalogue and the data, by the
/// provers of the diagnosis: witnesses by validated runs, what is excluded by searches, relations
/// over their windows. Estimates are no claims and are not checked: a finding says which.
/// @param base       the problem of the model as it is
/// @param catalogue  from which the effects of the diagnosis are
/// @param tell       receives each finding as soon as it is there; may be empty
/// @guarantee  a claim that is called verified was proved; one that is called refuted contradicts
///             what was proved, the data or the rest of the diagnosis
/// @cost  about what the proofs of the diagnosis took, at most the budget
[[nodiscard]] SIVID_DECL std::vector<check_finding>
check_diagnosis(identification_problem const& base, std::vector<effect> const& catalogue,
                stored_diagnosis const& stored, diagnosis_check_options const& options = {},
                std::function<void(check_finding const&)> const& tell = nullptr);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/verifier/impl/diagnosis_check.ipp>
#endif

#endif
