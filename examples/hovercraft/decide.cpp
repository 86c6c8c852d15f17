// SPDX-License-Identifier: MIT
// predict, verify and control: what a stored identification says of a scenario.
#include "commands.hpp"
#include "console/design_command.hpp"
#include "effects.hpp"
#include "scenario.hpp"

namespace hovercraft_example {

namespace {

sivid::scenario_description find_one(sivid::recorded_model const& model, std::string const& name) {
    auto const names = sivid::names_of(model.about);
    auto const found = find_scenarios(name, names);
    if (found.size() != 1) throw std::invalid_argument("--scenario: name one scenario, such as S2");
    return found.front();
}

} // namespace

int run_decision(console::decision what, hovercraft const& craft,
                 console::decision_command const& c) {
    auto const find = [&craft](std::string const& name) {
        return find_one(sivid::record_model(craft), name);
    };
    return console::run_decision(what, sivid::record_model(craft), catalogue(), c, find);
}

} // namespace hovercraft_example
