// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_ONLINE_DETAIL_ONLINE_REFINEMENT_HPP
#define SIVID_PAVING_ONLINE_DETAIL_ONLINE_REFINEMENT_HPP

#include <cstddef>

namespace sivid {

/// How far each update refines what is left.
struct online_refinement {
    double accuracy = 0.003;       ///< no side is split below this share of the hull
    double sufficient_ratio = 0.5; ///< stop when inside / not excluded reaches it
    double hull_gain = 0;          ///< as of `inversion_options`; 0.02 with hulls alone
    std::size_t boxes = 400;       ///< judged in one update
    std::size_t live = 64;         ///< no box is split while there are so many
    double seconds = 1; ///< of one update, its fit included; what was begun of a run is ended
};

} // namespace sivid

#endif
