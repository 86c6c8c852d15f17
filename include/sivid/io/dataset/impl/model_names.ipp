// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_IMPL_MODEL_NAMES_IPP
#define SIVID_IO_DATASET_IMPL_MODEL_NAMES_IPP

#include <sivid/io/dataset/model_names.hpp>

namespace sivid {

SIVID_DECL model_names names_of(model_description const& model) {
    model_names names;
    names.name = model.name;
    names.time_unit = model.time_unit;
    for (auto const& c : model.constants) names.constants.push_back({c.name, c.unit});
    for (auto const& i : model.inputs) names.inputs.push_back({i.name, i.unit});
    for (auto const& c : model.channels) names.channels.push_back({c.name, c.unit});
    for (auto const& s : model.states) {
        names.states.push_back({s.name, s.unit});
        names.state_ranges.push_back(s.limit.range());
    }
    return names;
}

} // namespace sivid

#endif
