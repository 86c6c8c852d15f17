// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_STEPPING_HPP
#define SIVID_APPROXIMATE_SIMULATE_STEPPING_HPP

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace sivid {

/// What is integrated: states, and behind them their derivatives (`sensitive_rate`).
class simulation_state : public Eigen::VectorXd {
public:
    using Eigen::VectorXd::VectorXd;
    simulation_state() = default;
    template <class Derived>
    simulation_state(Eigen::MatrixBase<Derived> const& x) : Eigen::VectorXd(x) {}
    template <class Derived>
    simulation_state& operator=(Eigen::MatrixBase<Derived> const& x) {
        Eigen::VectorXd::operator=(x);
        return *this;
    }
};

/// What a step may miss a state by: accuracy (absolute + relative |x|).
struct step_tolerance {
    std::vector<double> absolute; ///< per state; what stands behind them is not controlled
    double relative = 1e-6;
    double accuracy = 1;
    double shortest = 0; ///< steps that short are taken whatever they miss, if it is finite
};

/// Evaluates dx at (x, t).
class rate_function {
public:
    virtual void operator()(simulation_state const& x, simulation_state& dx, double t) = 0;

protected:
    ~rate_function() = default;
};

enum class step_outcome {
    too_long,  ///< nothing has changed but the length that is suggested
    taken,     ///< time and length are the next ones
    with_rate, ///< and the rate at the new point is known
};

/// How a simulation steps. Which method does it is chosen when a simulator is made: any explicit
/// stepper of Boost.Odeint (`odeint_stepping.hpp`).
class stepping {
public:
    virtual ~stepping() = default;
    /// Tries a step of length h from (x, t), where the rate is dx.
    [[nodiscard]] virtual step_outcome step(rate_function& rate, simulation_state const& x,
                                            simulation_state const& dx, double& t,
                                            simulation_state& to, simulation_state& rate_there,
                                            double& h) = 0;
    /// Forgets what former steps left.
    virtual void restart() {}

    step_tolerance tolerance;
};

/// Makes the steps of one simulator.
using stepping_maker = std::unique_ptr<stepping> (*)();

} // namespace sivid

#endif
