// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_RUN_PARTS_HPP
#define SIVID_PAVING_RUN_RUN_PARTS_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/flow.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/paving/run_options.hpp>
#include <sivid/space/box.hpp>

#include <memory>
#include <vector>

namespace sivid {

/// Parts of one record side by side, each from its own begin and box of starts, over one box of
/// parameters: by Taylor models in lanes.
/// @param f  under the inputs of the record, whatever the parts say
/// @param options  its smallest step is taken as it is: the caller knows the inputs
/// @returns  for each part what `experiment_run` returns
/// @cost  one integration in lanes for eight parts; a single part in scalars
[[nodiscard]] SIVID_DECL std::vector<std::shared_ptr<response const>>
run_parts(flow const& f, std::vector<experiment> const& parts, box const& parameters,
          run_options options);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/run/impl/run_parts.ipp>
#endif

#endif
