// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_SEARCH_SEARCH_BUDGET_HPP
#define SIVID_PAVING_SEARCH_SEARCH_BUDGET_HPP

#include <sivid/paving/verdict.hpp>
#include <sivid/work_limit.hpp>

#include <cstddef>
#include <optional>

namespace sivid {

/// Which budget of a search over boxes is used up, if one is. It means the same for every search:
/// what is proved until then stands, and what still waits stays undecided.
/// @tparam Options  with `boxes` and `memory` [bytes]
/// @param limit  of the time
/// @param held  bytes of boxes and of what was learnt about them: what they hold, without the
///              allocator's share and the spare room of growing lists
template <class Options>
[[nodiscard]] std::optional<stop_reason> used_up(Options const& most, work_limit const& limit,
                                                 std::size_t tested, std::size_t held) {
    if (limit.over()) return stop_reason::time_budget;
    if (tested >= most.boxes) return stop_reason::box_budget;
    if (held > most.memory) return stop_reason::memory_budget;
    return std::nullopt;
}

} // namespace sivid

#endif
