// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_MP_IDENTIFICATION_CHECK_HPP
#define SIVID_VERIFIER_MP_IDENTIFICATION_CHECK_HPP

/// @file
/// `check_identification` in the interval types of MPFI; needs mpfi, mpfr and gmp at link time.
/// CMake: sivid::compiled_mpfi has both functions compiled.

#include <sivid/verifier/identification_check.hpp>

#include <functional>
#include <vector>

namespace sivid {

/// The witness in 40 digits, the boxes in doubles with elementary functions in 40 digits.
/// @returns, @given  as of `check_identification`
[[nodiscard]] SIVID_MPFI_DECL std::vector<check_finding>
check_by_proven_functions(identification_problem const& problem,
                          stored_identification const& stored,
                          identification_check_options const& options,
                          std::function<void(check_finding const&)> const& tell = nullptr);

/// All of it in 40 digits.
/// @returns, @given  as of `check_identification`
[[nodiscard]] SIVID_MPFI_DECL std::vector<check_finding>
check_in_multiprecision(identification_problem const& problem, stored_identification const& stored,
                        identification_check_options const& options,
                        std::function<void(check_finding const&)> const& tell = nullptr);

} // namespace sivid

#ifndef SIVID_COMPILED_MPFI
#include <sivid/verifier/impl/check_by_proven_functions.ipp>
#include <sivid/verifier/impl/check_in_multiprecision.ipp>
#endif

#endif
