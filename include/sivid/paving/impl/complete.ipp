// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IMPL_COMPLETE_IPP
#define SIVID_PAVING_IMPL_COMPLETE_IPP

#include <sivid/paving/detail/program_parts.hpp>
#include <sivid/paving/judge/detail/fitted_witness.hpp>
#include <sivid/paving/run/further_runs.hpp>
#include <sivid/paving/strategy/detail/usual_strategy.hpp>

namespace sivid::paving_detail {

[[nodiscard]] inline program_parts all_parts() {
    return {&usual_strategy, &find_witness, &run_single, &run_first_order};
}

#ifdef SIVID_COMPILED
program_parts const& parts_of_program() {
    static program_parts const all = all_parts();
    return all;
}
#else
inline bool const is_complete = (known_parts = all_parts(), true);
#endif

} // namespace sivid::paving_detail

#endif
