// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_RUN_REACH_HPP
#define SIVID_PAVING_RUN_RUN_REACH_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/run_options.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace sivid {

/// How far the trajectories over a box of parameters and all starts are carried through an
/// experiment, and what holds them back: for people, who can then change it. Not for proofs.
struct run_reach {
    /// A parameter, or the start of a state, with its share in the width of `state` at `until`.
    struct cause {
        bool start = false;
        std::size_t index = 0; ///< of the parameter, or of the state
        std::string name;
        double share = 0;
    };
    std::string scenario;
    std::string time_unit = "s";          ///< the model's
    double begin = 0, until = 0, end = 0; ///< in it; all states are bounded up to `until`
    std::string state, unit;              ///< the widest at `until`, against its limit
    double width = 0;                     ///< of that state, there
    std::vector<cause> causes;            ///< the largest first, at least a tenth each
    /// Of the measured outputs up to `until`, in error bounds: the most that parameters and starts
    /// move one, and the most that was lost to remainders.
    double moved = 0, lost = 0;
    /// At most half the range of each measured output up to `until`, in error bounds: what all
    /// parameters and starts together move it from the middle of its range. Infinite where an
    /// output was not enclosed, or was measured exactly.
    double spread = 0;
    std::size_t instants = 0; ///< that were looked at; long records are looked at in places
    std::size_t measured = 0; ///< instants with measurements
    bool interrupted = false; ///< time ended the run: `until` says nothing

    [[nodiscard]] bool complete() const { return !(until < end); }
};

/// One run through each experiment, over all of a box.
/// @param run  its `keep_going` ends the runs; what is missing then counts as not reached
/// @cost  one integration for each experiment
[[nodiscard]] SIVID_DECL std::vector<run_reach>
reach_of_runs(identification_problem const& problem, box const& parameters, run_options const& run);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/run/impl/run_reach.ipp>
#endif

#endif
