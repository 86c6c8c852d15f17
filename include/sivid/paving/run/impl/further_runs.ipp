// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_IMPL_FURTHER_RUNS_IPP
#define SIVID_PAVING_RUN_IMPL_FURTHER_RUNS_IPP

#include <sivid/paving/run/further_runs.hpp>

#include <sivid/compiled.hpp>
#include <sivid/paving/run/detail/doubleton_run.hpp>
#include <sivid/paving/run/detail/taylor_run.hpp>

#include <cstddef>
#include <memory>
#include <utility>

namespace sivid {

namespace paving_detail {

SIVID_DECL std::unique_ptr<experiment_run> run_single(flow const& f, experiment const& e,
                                                      record const& samples,
                                                      run_options const& options,
                                                      std::size_t unknowns, std::size_t degree) {
    return std::make_unique<taylor_run<double>>(f, e, samples, options, unknowns, degree);
}

SIVID_DECL std::unique_ptr<experiment_run> run_first_order(flow const& f, experiment const& e,
                                                           record const& samples,
                                                           run_options const& options) {
    return std::make_unique<doubleton_run>(f, e, samples, options);
}

} // namespace paving_detail

SIVID_DECL std::unique_ptr<experiment_run> make_scalar_run(flow const& f, experiment const& e,
                                                           record const& samples,
                                                           box const& initial, box const& prior,
                                                           run_options options) {
    using namespace paving_detail;
    options = options_for(f, std::move(options));
    static_cast<enclosure_options&>(options) = steps_for(e, options);
    auto const unknowns = unknown_count(initial, prior);
    return run_single(f, e, samples, options, unknowns, degree_for(options, unknowns));
}

} // namespace sivid

#endif
