// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IDENTIFICATION_STATE_HPP
#define SIVID_PAVING_IDENTIFICATION_STATE_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/paving/search/search_state.hpp>
#include <sivid/paving/strategy/contractor.hpp>

#include <optional>
#include <string>

namespace sivid {

/// Everything that an interrupted identification needs to go on where it was. A witness is not in
/// it: the fit is verified again.
struct identification_state {
    std::optional<approximate_fit> guess;
    double seconds = 0;           ///< spent before the search
    double work = 0;              ///< the same of the budget, by the `work_clock`
    std::optional<leftover> left; ///< before the search; nothing: all of it
    contraction_journal journal{};
    search_state search;
    std::string problem = {}; ///< a digest of what is searched: nothing else goes on from here
};

} // namespace sivid

#endif
