// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_DESCRIBE_IPP
#define SIVID_APP_IMPL_DESCRIBE_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/names.hpp>
#include <sivid/app/program.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/describe.hpp>
#include <sivid/model/to_dot.hpp>

#include <iostream>
#include <vector>

namespace sivid::app {

SIVID_DECL int run(robot const& r, describe_command const& c) {
    if (c.unknown.empty()) {
        std::cout << (c.dot ? to_dot(r.model) : describe(r.model));
        return done;
    }
    for (auto const& name : c.unknown)
        require_known(name, names_in(r.model.about.constants), "constant");
    // Sampled inputs stay inputs, whatever their values.
    sampled_signal const samples({0, 1}, {0, 0}, interpolation::linear);
    auto const bound =
        bind(r.model, {c.unknown, {}}, std::vector<signal>(r.model.about.inputs.size(), samples));
    std::cout << (c.dot ? to_dot(bound) : describe(bound));
    return done;
}

} // namespace sivid::app

#endif
