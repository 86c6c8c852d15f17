// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_IMPL_CHECK_BY_PROVEN_FUNCTIONS_IPP
#define SIVID_VERIFIER_IMPL_CHECK_BY_PROVEN_FUNCTIONS_IPP

#include <sivid/number/mp_interval.hpp>
#include <sivid/verifier/claim/detail/identification_check_work.hpp>
#include <sivid/verifier/mp_identification_check.hpp>

#include <functional>
#include <vector>

namespace sivid {

SIVID_MPFI_DECL std::vector<check_finding>
check_by_proven_functions(identification_problem const& problem,
                          stored_identification const& stored,
                          identification_check_options const& options,
                          std::function<void(check_finding const&)> const& tell) {
    return io_detail::identification_check_work<mp_interval, proven_interval>(problem, stored,
                                                                              options)(tell);
}

} // namespace sivid

#endif
