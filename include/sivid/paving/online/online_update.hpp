// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_ONLINE_ONLINE_UPDATE_HPP
#define SIVID_PAVING_ONLINE_ONLINE_UPDATE_HPP

#include <sivid/measurement/record.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/judge/feasibility_test_options.hpp>
#include <sivid/paving/online/detail/online_refinement.hpp>
#include <sivid/paving/strategy/strategy.hpp>
#include <sivid/paving/verdict.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

/// A measurement of one of the experiments.
struct online_sample {
    std::size_t experiment = 0;
    measurement what;
};

struct online_options {
    online_refinement refinement;
    feasibility_test_options test;
    /// Refine until the hulls rest, not until much is proved inside.
    bool only_hulls = false;
    /// As of `identify_options`; for `result` only.
    std::size_t drawn_boxes = 1500;
    /// Asked where runs over what is left end early, each time that half as much was measured
    /// again.
    sivid::strategy strategy = default_strategy();
};

/// What is known after an update, without the paving; all of it is proved.
struct online_update {
    double seconds = 0;      ///< the update took
    std::size_t samples = 0; ///< in all
    sivid::verdict verdict = sivid::verdict::undecided;
    box hull; ///< of the prior; empty sides when nothing is left
    std::vector<combination_hull> combinations;
    std::size_t live = 0;         ///< boxes that are not excluded, of the products of parameters
    std::size_t regions = 0;      ///< of which trajectories are carried on
    std::size_t judged = 0;       ///< boxes, in this update
    std::size_t integrations = 0; ///< begun in this update: from the start, not carried on
};

} // namespace sivid

#endif
