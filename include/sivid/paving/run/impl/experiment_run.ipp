// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_IMPL_EXPERIMENT_RUN_IPP
#define SIVID_PAVING_RUN_IMPL_EXPERIMENT_RUN_IPP

#include <sivid/paving/run/experiment_run.hpp>

#include <sivid/compiled.hpp>
#include <sivid/paving/detail/program_parts.hpp>
#include <sivid/paving/run/detail/taylor_run.hpp>

#include <memory>
#include <stdexcept>
#include <utility>

namespace sivid {

SIVID_DECL std::unique_ptr<experiment_run> make_run(flow const& f, experiment const& e,
                                                    record const& samples, box const& initial,
                                                    box const& prior, run_options options) {
    using namespace paving_detail;
    auto const& program = parts_of_program();
    auto const unknowns = unknown_count(initial, prior);
    auto const degree = degree_for(options, unknowns);
    bool const by_taylor = options.set == carried_set::taylor_model;
    if (by_taylor && options.method)
        throw std::invalid_argument(
            "run_options: Taylor models follow the Taylor series, not the method '" +
            options.method->name +
            "'; sets of first order (carried_set::doubleton) take any method");
    if (!by_taylor && program.run_first_order == nullptr)
        throw std::invalid_argument("run_options: this program has no sets of first order: include "
                                    "<sivid/paving/complete.hpp>, or link to sivid::compiled");
    options = options_for(f, std::move(options));
    static_cast<enclosure_options&>(options) = steps_for(e, options);
    if (!by_taylor) return program.run_first_order(f, e, samples, options);
    auto const single = [&f, &e, &samples, options, unknowns, degree, &program] {
        return program.run_single(f, e, samples, options, unknowns, degree);
    };
    if (program.run_single == nullptr)
        return std::make_unique<taylor_run<lanes<8>>>(f, e, samples, options, unknowns, degree);
    // Points one by one: where nothing is unknown there are no boxes to fill the lanes.
    if (degree == 0) return single();
    return std::make_unique<taylor_run<lanes<8>>>(f, e, samples, options, unknowns, degree, single);
}

} // namespace sivid

#endif
