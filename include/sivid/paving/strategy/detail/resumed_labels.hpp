// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_DETAIL_RESUMED_LABELS_HPP
#define SIVID_PAVING_STRATEGY_DETAIL_RESUMED_LABELS_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/identification_state.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/search/search_state.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// Compares what a state to resume from says of its boxes with proofs about their middles.
///   A digest shows that nobody altered a file by accident; whoever alters it computes another one.
///   A run at a point is cheap: it refutes most boxes that are said to be inside and are not, or to
///   be excluded and hold parameters that explain the data. It proves none of the others.
class resumed_labels {
public:
    /// @param posed   as it is searched
    /// @param starts  from which inside boxes were proved; may be empty
    resumed_labels(identification_problem const& posed, feasibility_test_options const& options,
                   std::vector<box> const& starts)
        : test_(posed, options) {
        if (!starts.empty()) test_.set_starts(starts);
    }

    /// A verified point must not have been excluded.
    /// @param point  of products: the doubles around it
    /// @throws std::invalid_argument
    static void require_left(search_state const& state, box const& point) {
        auto const holds = [&point](auto const& b) { return !is_empty(intersect(b.set, point)); };
        bool const left = std::ranges::any_of(state.waiting, holds) ||
                          std::ranges::any_of(state.paved, [&](paved_box const& b) {
                              return b.verdict != box_verdict::outside && holds(b);
                          });
        if (!left && state.outside_kept) refuse("it excludes parameters that explain the data");
    }

    /// The largest boxes first, inside and excluded ones in turn: those that `at_once` takes of
    /// each, then others as long as there is time.
    /// @throws std::invalid_argument
    void require_true(search_state const& state, work_limit const& limit) {
        std::vector<box> inside = of(state, box_verdict::inside);
        std::vector<box> outside = of(state, box_verdict::outside);
        auto const group = test_.at_once();
        for (std::size_t k = 0; k < std::max(inside.size(), outside.size()); k += group) {
            if (k > 0 && !limit()) return;
            compare(inside, k, group, box_verdict::outside,
                    "a box that is said to be inside holds parameters that do not explain the "
                    "data");
            compare(outside, k, group, box_verdict::inside,
                    "a box that is said to be excluded holds parameters that explain the data");
        }
    }

    [[noreturn]] static void refuse(std::string const& what) {
        throw std::invalid_argument("identify: the state to resume from was altered: " + what +
                                    "; restore it from a copy, or begin anew");
    }

private:
    [[nodiscard]] static std::vector<box> of(search_state const& state, box_verdict v) {
        std::vector<std::pair<double, box const*>> order;
        for (auto const& b : state.paved)
            if (b.verdict == v)
                order.emplace_back(-relative_volume(b.set, state.prior).upper(), &b.set);
        std::ranges::stable_sort(order, {}, [](auto const& entry) { return entry.first; });
        std::vector<box> result;
        for (auto const& [volume, set] : order) result.push_back(point_box(mid(*set)));
        return result;
    }
    void compare(std::vector<box> const& points, std::size_t from, std::size_t count,
                 box_verdict contrary, char const* words) {
        if (from >= points.size()) return;
        auto const begin = points.begin() + static_cast<std::ptrdiff_t>(from);
        auto const size = std::min(count, points.size() - from);
        for (auto const& said : test_.learn({begin, begin + static_cast<std::ptrdiff_t>(size)}))
            if (said.verdict == contrary && !test_.cancelled()) refuse(words);
    }

    feasibility_test test_;
};

/// Whether a box meets what is left.
inline bool is_left(subpaving const& paving, box const& x) {
    return std::any_of(paving.boxes().begin(), paving.boxes().end(), [&x](paved_box const& b) {
        return b.verdict != box_verdict::outside && !is_empty(intersect(b.set, x));
    });
}

/// A state to resume from must agree with the witness and with its own boxes' middles.
/// @param asked  knows what the state says is left, and its fit
/// @param limit  for runs at the middles
/// @throws std::invalid_argument
inline void require_true_state(identification_state const& state, inquiry const& asked,
                               feasibility_test_options const& test, bool witness,
                               box const& fitted, work_limit const& limit) {
    if (witness) {
        resumed_labels::require_left(state.search, fitted);
        if (state.left && is_empty(intersect(state.left->parameters, fitted)))
            resumed_labels::refuse("what it says is left excludes parameters that explain the "
                                   "data");
    }
    resumed_labels(asked.whole(), limited(test, limit), asked.proposed_starts())
        .require_true(state.search, limit);
}

/// A verified witness and the exclusion of its parameters contradict each other: one of them is no
/// proof, and nothing is told.
/// @param resumed  from a state, which may have been altered
/// @throws std::logic_error
inline void require_witness_left(identification const& found, bool resumed) {
    if (!found.witness) return;
    auto const at = point_box(found.witness->parameters);
    bool const left = contains(found.hull, found.witness->parameters) && is_left(found.paving, at);
    if (left &&
        (!found.products || is_left(found.products->paving, found.products->map.forward(at))))
        return;
    if (resumed) resumed_labels::refuse("it excludes parameters that explain the data");
    throw std::logic_error("identify: parameters that explain the data were excluded: a defect, "
                           "please report it");
}

} // namespace sivid::paving_detail

#endif
