// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_IMPL_SCALAR_RUN_IPP
#define SIVID_PAVING_RUN_IMPL_SCALAR_RUN_IPP

#include <sivid/paving/run/detail/scalar_run.hpp>

#include <sivid/compiled.hpp>
#include <sivid/paving/run/detail/taylor_run.hpp>

#include <memory>
#include <utility>

namespace sivid {

SIVID_DECL std::unique_ptr<experiment_run> make_scalar_run(flow const& f, experiment const& e,
                                                           record const& samples,
                                                           box const& initial, box const& prior,
                                                           run_options options) {
    using namespace paving_detail;
    options.enclosure = steps_for(e, std::move(options.enclosure));
    if (f.uncertain()) options.hopeless = 1e300;
    auto const unknowns = unknown_count(initial, prior);
    return std::make_unique<taylor_run<double>>(f, e, samples, options, unknowns,
                                                degree_for(options, unknowns));
}

} // namespace sivid

#endif
