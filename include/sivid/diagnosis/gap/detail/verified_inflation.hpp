// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_GAP_DETAIL_VERIFIED_INFLATION_HPP
#define SIVID_DIAGNOSIS_GAP_DETAIL_VERIFIED_INFLATION_HPP

#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/space/box.hpp>

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

} // namespace sivid

#endif
