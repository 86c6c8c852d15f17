// SPDX-License-Identifier: MIT
// Random identification problems with a planted truth: bounds that hold but for at most q outliers.
#ifndef SIVID_TESTS_SUPPORT_PROBLEMS_HPP
#define SIVID_TESTS_SUPPORT_PROBLEMS_HPP

#include "support/models.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"

#include <sivid/model/problem.hpp>

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace support {

struct planted_problem {
    sivid::identification_problem problem;
    std::vector<double> truth;
    std::vector<std::vector<double>> starts;
    std::vector<std::set<std::size_t>> outliers; ///< by index in the order of time
    /// (experiment, parameters, start) -> outputs at its measurements, in the order of time
    std::function<extended_state(std::size_t, std::vector<double> const&,
                                 std::vector<double> const&)>
        simulate;

    /// How many measurements of an experiment are violated by more than `slack`.
    [[nodiscard]] std::size_t violated(std::size_t e, std::vector<double> const& p,
                                       std::vector<double> const& x0, double slack) const {
        auto const y = simulate(e, p, x0);
        auto const samples = sivid::sorted(problem.experiments[e].measurements);
        std::size_t n = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            bool const holds = samples[i].bound.lower() - slack <= y[i] &&
                               y[i] <= samples[i].bound.upper() + slack;
            n += holds ? 0 : 1;
        }
        return n;
    }
};

struct planting {
    std::size_t experiments = 1;
    std::size_t samples = 8;
    std::size_t outliers = 0; ///< per experiment, planted and allowed
    double noise = 0.02;      ///< half-width of the bounds
    double spread = 0;        ///< half-width of the initial boxes
    double horizon = 3;
    bool kinked = false; ///< the rate: its reference must not pass over them
};

/// What is planted: recorded for the library, on extended numbers for the reference.
using planted_rate = rate_for<sivid::expression, extended>;

/// The states are measured, each at random times.
/// @param prior  the truth is drawn from it; starts around `start`
planted_problem plant(draws& d, shape const& s, planted_rate const& rate, box const& prior,
                      std::vector<double> const& start, planting const& how);

/// One of several small models, by number.
inline constexpr std::size_t planted_models = 5;
planted_problem plant(draws& d, std::size_t model, planting const& how);

} // namespace support

#endif
