// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_OPTIONS_HPP
#define SIVID_PAVING_RUN_OPTIONS_HPP

#include <sivid/enclosure/options.hpp>

#include <cstddef>

namespace sivid {

/// How an experiment is run over a box of parameters and starts: coarser steps than those of
/// `enclosure_options`, for one of many. Where losses grow they decide: the hulls of an arm whose
/// torque is recorded are a third narrower with 1e-8 than with 1e-7, in the same time
/// (`benchmarks/paving/robots`).
struct run_options : enclosure_options {
    run_options()
        : enclosure_options{
              .order = 12, .tolerance = 1e-8, .relative_tolerance = 1e-4, .minimum_step = 1e-4} {}
    explicit run_options(enclosure_options const& steps) : enclosure_options(steps) {}

    carried_set set = carried_set::taylor_model;
    /// Of the Taylor models; 0: `suggested_degree`. (Points need none.)
    std::size_t degree = 0;
    /// Leave an experiment when the part of every output that is lost to remainders is wider than
    /// this many times what is known of it and the measurement together.
    double hopeless = 3;
};

} // namespace sivid

#endif
