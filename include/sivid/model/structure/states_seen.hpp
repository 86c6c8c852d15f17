// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_STRUCTURE_STATES_SEEN_HPP
#define SIVID_MODEL_STRUCTURE_STATES_SEEN_HPP

#include <sivid/model/model.hpp>

#include <cstddef>
#include <string>

namespace sivid {

/// The same model with a further channel for every state, "state NAME", in their order.
/// @param what  instead of "state "
[[nodiscard]] inline recorded_model with_states_seen(recorded_model model,
                                                     std::string const& what = "state ") {
    for (std::size_t i = 0; i < model.about.states.size(); ++i) {
        auto const& state = model.about.states[i];
        model.about.channels.push_back({what + state.name, state.unit});
        model.observe.push_back(model.g.leaf(operation::state, i));
    }
    return model;
}

} // namespace sivid

#endif
