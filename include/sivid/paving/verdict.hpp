// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_VERDICT_HPP
#define SIVID_PAVING_VERDICT_HPP

#include <string_view>

namespace sivid {

/// What is known of a box of parameters.
enum class box_verdict {
    inside,    ///< proved: every point belongs to the set
    outside,   ///< proved: no point belongs to it
    undecided, ///< tested, and small enough to be left
    pending    ///< still to be tested or split when the work stopped
};

/// What is known of a whole identification problem.
enum class verdict {
    consistent,   ///< proved: some parameter explains the data
    inconsistent, ///< proved: none in the prior does
    undecided
};

/// Why a search ended.
enum class stop_reason {
    decided,          ///< every box is proved inside or outside
    accuracy_reached, ///< what is undecided is smaller than asked for
    inside_share,     ///< so much of what is not excluded is proved inside as was asked for
    hulls_rest,       ///< the hull of what is left shrinks no more
    too_blurred,      ///< boxes as small as asked for, all over what is left, decide nothing
    time_budget,
    box_budget,
    memory_budget,
    cancelled
};

/// Whether a search came to an end by itself: with a larger budget it would have found the same.
[[nodiscard]] constexpr bool is_complete(stop_reason r) {
    return r == stop_reason::decided || r == stop_reason::accuracy_reached ||
           r == stop_reason::inside_share || r == stop_reason::hulls_rest ||
           r == stop_reason::too_blurred;
}

[[nodiscard]] constexpr std::string_view to_string(box_verdict v) {
    switch (v) {
    case box_verdict::inside:
        return "inside";
    case box_verdict::outside:
        return "outside";
    case box_verdict::undecided:
        return "undecided";
    case box_verdict::pending:
        return "pending";
    }
    return "";
}
[[nodiscard]] constexpr std::string_view to_string(verdict v) {
    switch (v) {
    case verdict::consistent:
        return "consistent";
    case verdict::inconsistent:
        return "inconsistent";
    case verdict::undecided:
        return "undecided";
    }
    return "";
}
[[nodiscard]] constexpr std::string_view to_string(stop_reason r) {
    switch (r) {
    case stop_reason::decided:
        return "every box decided";
    case stop_reason::accuracy_reached:
        return "accuracy reached";
    case stop_reason::inside_share:
        return "enough of what is left is proved inside";
    case stop_reason::hulls_rest:
        return "hulls shrink no more";
    case stop_reason::too_blurred:
        return "boxes as small as asked for, tried all over what is left, decide nothing";
    case stop_reason::time_budget:
        return "time budget spent";
    case stop_reason::box_budget:
        return "box budget spent";
    case stop_reason::memory_budget:
        return "memory budget spent";
    case stop_reason::cancelled:
        return "cancelled";
    }
    return "";
}

/// What a verdict rests on: the strongest of what a result shows for it.
enum class verdict_grounds {
    witness,        ///< a verified point
    inside_boxes,   ///< points proved inside, of the prior or of products
    excluded_boxes, ///< all of the prior is proved outside
    nothing
};

[[nodiscard]] constexpr verdict_grounds grounds_for(bool witness, bool inside, bool anything_left) {
    return witness         ? verdict_grounds::witness
           : inside        ? verdict_grounds::inside_boxes
           : anything_left ? verdict_grounds::nothing
                           : verdict_grounds::excluded_boxes;
}
[[nodiscard]] constexpr std::string_view to_string(verdict_grounds g) {
    switch (g) {
    case verdict_grounds::witness:
        return "witness";
    case verdict_grounds::inside_boxes:
        return "inside boxes";
    case verdict_grounds::excluded_boxes:
        return "excluded boxes";
    case verdict_grounds::nothing:
        return "nothing";
    }
    return "";
}

} // namespace sivid

#endif
