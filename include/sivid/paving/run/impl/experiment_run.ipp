// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_IMPL_EXPERIMENT_RUN_IPP
#define SIVID_PAVING_RUN_IMPL_EXPERIMENT_RUN_IPP

#include <sivid/paving/run/experiment_run.hpp>

#include <sivid/compiled.hpp>
#include <sivid/enclosure/suggested_degree.hpp>
#include <sivid/measurement/record.hpp>
#include <sivid/paving/run/detail/doubleton_run.hpp>
#include <sivid/paving/run/detail/taylor_continuation.hpp>
#include <sivid/paving/run/detail/taylor_run.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

SIVID_DECL std::unique_ptr<experiment_run> make_run(flow const& f, experiment const& e,
                                                    record const& samples, box const& initial,
                                                    box const& prior, run_options options) {
    using namespace paving_detail;
    auto const unknowns = unknown_count(initial, prior);
    auto const degree = degree_for(options, unknowns);
    // Points one by one: where nothing is unknown there are no boxes to fill the lanes.
    if (options.set == carried_set::taylor_model && !options.method && degree == 0)
        return make_scalar_run(f, e, samples, initial, prior, options);
    options = options_for(f, std::move(options));
    static_cast<enclosure_options&>(options) = steps_for(e, options);
    if (options.set == carried_set::taylor_model) {
        if (options.method)
            throw std::invalid_argument(
                "run_options: Taylor models follow the Taylor series, not the method '" +
                options.method->name +
                "'; sets of first order (carried_set::doubleton) take any method");
        return std::make_unique<taylor_run<lanes<8>>>(f, e, samples, options, unknowns, degree);
    }
    return std::make_unique<doubleton_run>(f, e, samples, options);
}

SIVID_DECL std::unique_ptr<experiment_run> make_scalar_run(flow const& f, experiment const& e,
                                                           record const& samples,
                                                           box const& initial, box const& prior,
                                                           run_options options) {
    using namespace paving_detail;
    options = options_for(f, std::move(options));
    static_cast<enclosure_options&>(options) = steps_for(e, options);
    auto const unknowns = unknown_count(initial, prior);
    return std::make_unique<taylor_run<double>>(f, e, samples, options, unknowns,
                                                degree_for(options, unknowns));
}

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

SIVID_DECL std::vector<std::shared_ptr<response const>>
run_parts(flow const& f, std::vector<experiment> const& parts, box const& parameters,
          run_options options) {
    using namespace paving_detail;
    options = options_for(f, std::move(options));
    std::vector<record> samples;
    std::vector<lane_task> families;
    std::size_t unknowns = 0;
    for (auto const& part : parts) {
        unknowns = std::max(unknowns, unknown_count(part.initial, parameters));
        samples.push_back(sorted(part.measurements));
    }
    for (std::size_t k = 0; k < parts.size(); ++k) {
        families.push_back({&parts[k], &samples[k], &parts[k].initial, &parameters});
    }
    if (families.empty()) return {};
    auto const degree = degree_for(options, unknowns);
    if (families.size() == 1) return taylor_lanes<double>(f, options, unknowns, degree)(families);
    return taylor_lanes<lanes<8>>(f, options, unknowns, degree)(families);
}

} // namespace sivid

#endif
