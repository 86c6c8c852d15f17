// SPDX-License-Identifier: MIT
// Systems on which every method of enclosure is tried: a rate on any scalar, boxes of initial
// states and parameters, a horizon.
#ifndef SIVID_TESTS_SUPPORT_SYSTEMS_HPP
#define SIVID_TESTS_SUPPORT_SYSTEMS_HPP

#include "support/models.hpp"
#include "support/power_series.hpp"
#include "support/rates.hpp"
#include "support/reference.hpp"
#include "support/variational_reference.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace support {

/// The scalars on which tests compute a right-hand side: recorded, for trajectories and their
/// derivatives, for formulas of Runge-Kutta, for Taylor coefficients.
using any_rate = rate_for<sivid::expression, extended, dual, mp, power_series<8>>;

struct dynamic_system {
    std::string name;
    shape sizes;
    any_rate rate;
    box initial;
    box parameters;
    double horizon = 1;
    std::vector<sivid::sampled_signal> inputs = {};

    [[nodiscard]] std::shared_ptr<sivid::flow const> flow() const {
        return flow_of(model_of(sizes, rate.on<sivid::expression>()),
                       {inputs.begin(), inputs.end()});
    }
};

using system_visit = std::function<void(dynamic_system const&)>;

/// Calls visit(system) for each smooth system.
void for_each_smooth_system(system_visit const& visit);
/// Calls visit(system) for systems with kinks and with sampled inputs.
void for_each_rough_system(system_visit const& visit);
/// Both.
void for_each_system(system_visit const& visit);

} // namespace support

#endif
