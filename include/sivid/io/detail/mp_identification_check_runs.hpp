// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DETAIL_MP_IDENTIFICATION_CHECK_RUNS_HPP
#define SIVID_IO_DETAIL_MP_IDENTIFICATION_CHECK_RUNS_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/detail/identification_check_work.hpp>
#include <sivid/number/mp_functions.hpp>

#include <functional>
#include <vector>

namespace sivid {

#if !defined(SIVID_COMPILED_MPFI) || defined(SIVID_COMPILE_CHECK_BY_PROVEN_FUNCTIONS)
SIVID_MPFI_ENTRY std::vector<check_finding>
check_by_proven_functions(identification_problem const& problem,
                          stored_identification const& stored,
                          identification_check_options const& options,
                          std::function<void(check_finding const&)> const& tell) {
    return io_detail::identification_check_work<mp_interval, proven_interval>(problem, stored,
                                                                              options)(tell);
}
#endif

#if !defined(SIVID_COMPILED_MPFI) || defined(SIVID_COMPILE_CHECK_IN_MULTIPRECISION)
SIVID_MPFI_ENTRY std::vector<check_finding>
check_in_multiprecision(identification_problem const& problem, stored_identification const& stored,
                        identification_check_options const& options,
                        std::function<void(check_finding const&)> const& tell) {
    return io_detail::identification_check_work<mp_interval, mp_interval>(problem, stored,
                                                                          options)(tell);
}
#endif

} // namespace sivid

#endif
