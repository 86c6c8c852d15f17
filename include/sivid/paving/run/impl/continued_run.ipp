// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_IMPL_CONTINUED_RUN_IPP
#define SIVID_PAVING_RUN_IMPL_CONTINUED_RUN_IPP

#include <sivid/paving/run/continued_run.hpp>

#include <sivid/compiled.hpp>
#include <sivid/enclosure/suggested_degree.hpp>
#include <sivid/paving/run/detail/doubleton_continuation.hpp>
#include <sivid/paving/run/detail/taylor_continuation.hpp>

#include <memory>

namespace sivid {

SIVID_DECL std::unique_ptr<continued_run> make_continued_run(flow const& f, experiment const& e,
                                                             box const& prior,
                                                             run_options const& options) {
    using namespace paving_detail;
    auto const unknowns = unknown_count(e.initial, prior);
    auto const how = steps_for(e, options);
    if (options.set == carried_set::taylor_model) {
        return std::make_unique<taylor_continuation>(f, e.begin, how, unknowns,
                                                     suggested_degree(unknowns));
    }
    return std::make_unique<doubleton_continuation>(f, e.begin, how);
}

} // namespace sivid

#endif
