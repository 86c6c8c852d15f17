// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_OPTIONS_HPP
#define SIVID_PAVING_RUN_OPTIONS_HPP

#include <sivid/enclosure/options.hpp>

namespace sivid {

/// Which sets are carried along the trajectories.
enum class carried_set {
    taylor_model, ///< polynomials in the unknowns: tight over wide boxes
    doubleton     ///< first order: Lohner's sets, the readable reference
};

/// How an experiment is run over a box of parameters and starts.
struct run_options {
    enclosure_options enclosure{
        .order = 12, .tolerance = 1e-7, .relative_tolerance = 1e-4, .minimum_step = 1e-3};
    carried_set set = carried_set::taylor_model;
    /// Leave an experiment when the part of every output that is lost to remainders is wider than
    /// this many times what is known of it and the measurement together.
    double hopeless = 3;
};

} // namespace sivid

#endif
