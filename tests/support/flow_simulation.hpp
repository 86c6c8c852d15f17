// SPDX-License-Identifier: MIT
// Simulated trajectories of a flow, for comparisons with what encloses it.
#ifndef SIVID_TESTS_SUPPORT_FLOW_SIMULATION_HPP
#define SIVID_TESTS_SUPPORT_FLOW_SIMULATION_HPP

#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/enclosure/flow.hpp>

#include <memory>
#include <vector>

namespace support {

class flow_simulation {
public:
    explicit flow_simulation(sivid::flow const& f)
        : model_(std::make_shared<sivid::approximate_model const>(f.model())),
          inputs_(f.inputs()) {}

    [[nodiscard]] sivid::approximate_trajectory
    operator()(std::vector<double> const& initial, std::vector<double> const& parameters,
               double from, std::vector<double> const& times, double tolerance = 1e-9) const {
        return sivid::simulate(model_, inputs_, initial, parameters, from, times, {tolerance});
    }

private:
    std::shared_ptr<sivid::approximate_model const> model_;
    std::vector<sivid::signal> inputs_;
};

} // namespace support

#endif
