// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_RUNGE_KUTTA_RUN_HPP
#define SIVID_PAVING_RUN_RUNGE_KUTTA_RUN_HPP

/// @file
/// Identification by Taylor-model sets whose centre follows a Runge-Kutta method. Expensive to
/// compile, and nowhere narrower than the Taylor series (docs/runge_kutta.md): not part of
/// sivid::compiled, no other header includes it.

#include <sivid/enclosure/suggested_degree.hpp>
#include <sivid/enclosure/taylor/parametric_runge_kutta.hpp>
#include <sivid/paving/run/experiment_run.hpp>
// What builds on it.
#include <sivid/paving/run/detail/taylor_run.hpp>

#include <memory>

namespace sivid {

/// A `run_maker`: `options.test.make = runge_kutta_run` with a `method` in the enclosure's
/// options. Of the degree that `suggested_degree` says.
/// Smooth models only: kinks are not crossed, the outputs end there.
/// @throws std::invalid_argument  without a method
[[nodiscard]] inline std::unique_ptr<experiment_run>
runge_kutta_run(flow const& f, experiment const& e, record const& samples, box const& initial,
                box const& prior, run_options const& options) {
    using namespace paving_detail;
    auto const unknowns = unknown_count(initial, prior);
    return std::make_unique<taylor_run<double, parametric_runge_kutta<>>>(
        f, e, samples, options, unknowns, suggested_degree(unknowns));
}

} // namespace sivid

#endif
