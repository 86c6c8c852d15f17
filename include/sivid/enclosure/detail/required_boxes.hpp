// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_DETAIL_REQUIRED_BOXES_HPP
#define SIVID_ENCLOSURE_DETAIL_REQUIRED_BOXES_HPP

#include <sivid/enclosure/flow.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/space/box.hpp>

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace sivid::enclosure_detail {

/// Boxes in which trajectories of a flow may begin: of its sizes, not empty, bounded.
/// @param who  asks, for the message
/// @throws std::invalid_argument  that names the model, its sizes and those given, or the side
template <class I>
void require_boxes(std::string const& who, flow const& f, basic_box<I> const& initial,
                   basic_box<I> const& parameters) {
    auto const& m = f.model();
    auto const fail = [&](std::string const& what) {
        throw std::invalid_argument(who + ": the model '" + m.about.name + "' " + what);
    };
    auto const count = [](std::size_t n, char const* what) {
        return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
    };
    if (initial.size() != f.states() || parameters.size() != f.parameters())
        fail("has " + count(f.states(), "state") + " and " +
             count(f.parameters(), "unknown parameter") + ", but boxes of " +
             count(initial.size(), "side") + " and " + count(parameters.size(), "side") +
             " were given");
    auto const bounded = [&](basic_box<I> const& x, auto const& name) {
        for (std::size_t i = 0; i < x.size(); ++i)
            if (!std::isfinite(interval_traits<I>::mag(x[i])))
                fail("cannot start: the range of " + name(i) + " is empty or unbounded");
    };
    bounded(initial, [&](std::size_t i) { return "the state '" + m.about.states[i].name + "'"; });
    bounded(parameters, [&](std::size_t j) {
        return "the parameter '" + m.about.constants[m.parameters[j]].name + "'";
    });
}

} // namespace sivid::enclosure_detail

#endif
