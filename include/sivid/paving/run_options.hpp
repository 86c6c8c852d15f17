// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_OPTIONS_HPP
#define SIVID_PAVING_RUN_OPTIONS_HPP

#include <sivid/enclosure/options.hpp>
#include <sivid/measurement/record.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <memory>

namespace sivid {

class flow;
struct experiment;
class experiment_run;
struct run_options;

/// Makes the run of an experiment over boxes to come, which lie in `initial` and `prior`.
using run_maker = std::unique_ptr<experiment_run> (*)(flow const&, experiment const&, record const&,
                                                      box const& initial, box const& prior,
                                                      run_options const&);

/// How an experiment is run over a box of parameters and starts: coarser steps than those of
/// `enclosure_options`, for one of many.
struct run_options : enclosure_options {
    run_options()
        : enclosure_options{
              .order = 12, .tolerance = 1e-7, .relative_tolerance = 1e-4, .minimum_step = 1e-4} {}
    explicit run_options(enclosure_options const& steps) : enclosure_options(steps) {}

    carried_set set = carried_set::taylor_model;
    /// Of the Taylor models; 0: `suggested_degree`. (Points need none.)
    std::size_t degree = 0;
    /// Makes Taylor-model runs in place of those that follow the Taylor series: `runge_kutta_run`,
    /// which a Runge-Kutta `method` needs with Taylor models, or one of your own.
    run_maker make = nullptr;
    /// Leave an experiment when the part of every output that is lost to remainders is wider than
    /// this many times what is known of it and the measurement together.
    double hopeless = 3;
};

} // namespace sivid

#endif
