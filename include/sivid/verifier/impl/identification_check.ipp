// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_IMPL_IDENTIFICATION_CHECK_IPP
#define SIVID_VERIFIER_IMPL_IDENTIFICATION_CHECK_IPP

#include <sivid/verifier/claim/detail/identification_check_work.hpp>
#include <sivid/verifier/identification_check.hpp>

namespace sivid {

SIVID_DECL std::vector<check_finding>
check_identification(identification_problem const& problem, stored_identification const& stored,
                     identification_check_options const& options,
                     std::function<void(check_finding const&)> const& tell) {
    return io_detail::identification_check_work<interval, interval>(problem, stored, options)(tell);
}

} // namespace sivid

#endif
