// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SIMULATE_HPP
#define SIVID_ENCLOSURE_SIMULATE_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/flow.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace sivid {

namespace enclosure_detail {
class odeint_simulator;
}

/// States (and outputs) of a simulated trajectory at requested times. Not a proof.
struct approximate_trajectory {
    std::vector<double> times;
    std::vector<std::vector<double>> states;
    std::vector<std::vector<double>> outputs;
};

/// Simulates a flow in plain floating point by Boost.Odeint (Dormand-Prince 5, adaptive), restarted
/// at the knots of sampled inputs.
/// @param times      increasing, the first not before `from`
/// @param tolerance   absolute and relative, of one step
/// @param keep_going  asked before each step; may be empty
/// @throws boost::numeric::odeint::step_adjustment_error or no_progress_error when it gets stuck,
///         std::runtime_error when it was told to stop
class approximate_simulator {
public:
    /// @given  the flow outlives this
    explicit approximate_simulator(flow const& f);
    approximate_simulator(approximate_simulator&&) noexcept;
    approximate_simulator& operator=(approximate_simulator&&) noexcept;
    ~approximate_simulator();

    [[nodiscard]] approximate_trajectory operator()(std::vector<double> const& initial,
                                                    std::vector<double> const& parameters,
                                                    double from, std::vector<double> const& times,
                                                    double tolerance = 1e-9,
                                                    std::function<bool()> const& keep_going = {});

private:
    std::unique_ptr<enclosure_detail::odeint_simulator> work_;
};

} // namespace sivid

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_APPROXIMATE_SIMULATOR)
#include <sivid/enclosure/detail/odeint_simulator.hpp>
#endif

#endif
