// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_GAP_VERIFIED_INFLATION_HPP
#define SIVID_DIAGNOSIS_GAP_VERIFIED_INFLATION_HPP

#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/diagnosis_effort.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sivid {

/// What was proved about one problem, perhaps one whose model has delays.
struct verified_inflation {
    inflation_range range = unknown_inflation();
    std::optional<verified_witness> witness; ///< attains range.upper(), if finite
    std::vector<std::string> assumptions;
    box hull; ///< contains every parameter of inflation <= range.upper(); empty if not known
};

/// How the inflation of a candidate is bounded.
struct gap_options {
    step_effort bound{150, 0.3};     ///< for both bounds ...
    std::size_t further_boxes = 250; ///< ... see `inflation_options::further_boxes`
    step_effort no_gap{4, 0.02};     ///< where there is none: for the lower bound
    double relative_width = 0.03;    ///< of the bounds that are wanted
    /// For interval observers; twice as much where starts are wide.
    step_effort observers{3000, 0.07};
    /// Where more than twice as many experiments are at hand, so many of the hardest are tried
    /// first for a refutation.
    std::size_t hardest = 4;
};

} // namespace sivid

#endif
