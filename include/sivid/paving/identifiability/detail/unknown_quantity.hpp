// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IDENTIFIABILITY_DETAIL_UNKNOWN_QUANTITY_HPP
#define SIVID_PAVING_IDENTIFIABILITY_DETAIL_UNKNOWN_QUANTITY_HPP

#include <sivid/model/structure/symmetry.hpp>
#include <sivid/number/interval_traits.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sivid {

/// Something that the data are to determine: a parameter, or the start of a state in an experiment.
struct unknown_quantity {
    std::string name;                      ///< of the parameter, or "<state>(<experiment>)"
    std::size_t index = 0;                 ///< of the parameter or state
    std::optional<std::size_t> experiment; ///< of a start
    interval prior;

    /// Its prior does not touch 0, so that relative changes make sense.
    [[nodiscard]] bool relative() const { return !interval_traits<interval>::contains(prior, 0); }
};

/// A direction in the unknowns, one of an orthonormal system that the data tell apart.
struct sensitive_direction {
    /// Per unknown, in widths of its prior (of its logarithm where the prior does not touch 0); the
    /// largest is 1: the direction crosses that prior.
    std::vector<double> components;
    /// To first order, by how many half-widths of its bound a move along the direction changes the
    /// output that notices it most.
    double noticed = 0;
};

/// A motion of the unknowns that the outputs do not notice, or hardly.
struct free_motion {
    motion_kind kind = motion_kind::scaling;
    std::vector<int> weights; ///< one per unknown
    double noticed = 0;       ///< as for a direction, across the prior that is crossed first
    /// A theorem about the equations: no output of any experiment changes along it.
    bool proved = false;
};

} // namespace sivid

#endif
