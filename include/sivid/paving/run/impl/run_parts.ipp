// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_IMPL_RUN_PARTS_IPP
#define SIVID_PAVING_RUN_IMPL_RUN_PARTS_IPP

#include <sivid/paving/run/run_parts.hpp>

#include <sivid/compiled.hpp>
#include <sivid/measurement/record.hpp>
#include <sivid/paving/run/detail/taylor_run.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

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
