// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CHANGE_DETAIL_SEEN_EFFECT_HPP
#define SIVID_MODEL_CHANGE_DETAIL_SEEN_EFFECT_HPP

#include <sivid/model/effect.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace sivid {

/// An effect that changes nothing, and shows what the model sees behind the inputs' edits of
/// others: states of which the rates are the inputs, then the constants, then the time, in the
/// order of the model.
/// @param beside  those that it is joined with; its name is none of theirs
/// @param order   it sees those of this order, and below
[[nodiscard]] inline effect seen_effect(model_description const& about,
                                        std::vector<effect> const& beside, int order) {
    effect seen;
    seen.name = "seen";
    seen.order = order;
    auto const taken = [&seen](auto const& item) { return item.name == seen.name; };
    while (std::any_of(beside.begin(), beside.end(), taken) ||
           std::any_of(about.inputs.begin(), about.inputs.end(), taken))
        seen.name += "'";
    seen.on_inputs = [about, name = seen.name](effect_scope& m) {
        auto const show = [&](std::string const& what, expression const& value) {
            (void)m.add_state(name + " " + what, "1", 1, expression(0));
            m.rate(name + " " + what) = value;
        };
        for (auto const& u : about.inputs) show("input " + u.name, m.input(u.name));
        for (auto const& c : about.constants) show("constant " + c.name, m.constant(c.name));
        show("time", m.time());
    };
    return seen;
}

} // namespace sivid

#endif
