// SPDX-License-Identifier: MIT
#include "commands.hpp"

#include "console/program.hpp"

#include <sivid/measurement/signal.hpp>
#include <sivid/model/describe.hpp>
#include <sivid/model/to_dot.hpp>

#include <iostream>

namespace sivid {
template recorded_model record_model(hovercraft const&);
} // namespace sivid

namespace hovercraft_example {

int run(describe_command const& c) {
    auto const model = sivid::record_model(c.craft);
    if (c.unknown.empty()) {
        std::cout << (c.dot ? sivid::to_dot(model) : sivid::describe(model));
        return console::done;
    }
    // Sampled inputs stay inputs, whatever their values.
    sivid::sampled_signal const samples({0, 1}, {0, 0}, sivid::interpolation::linear);
    auto const bound = sivid::bind(model, {c.unknown, {}},
                                   std::vector<sivid::signal>(model.about.inputs.size(), samples));
    std::cout << (c.dot ? sivid::to_dot(bound) : sivid::describe(bound));
    return console::done;
}

} // namespace hovercraft_example
