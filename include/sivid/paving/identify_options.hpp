// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IDENTIFY_OPTIONS_HPP
#define SIVID_PAVING_IDENTIFY_OPTIONS_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/paving/identification_state.hpp>
#include <sivid/paving/inversion_options.hpp>
#include <sivid/paving/judge/feasibility_test_options.hpp>
#include <sivid/paving/strategy/strategy.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

namespace sivid {

class feasibility_test;

struct identify_options {
    inversion_options search{.accuracy_of_hull = true, .proof_bytes = std::size_t{1} << 25};
    /// Without `test.contract` the search is the report's: no fit, no products, no strategy.
    feasibility_test_options test;
    /// Stop when the hulls no longer shrink, by `search.hull_gain`, or 2 % where that is 0; the
    /// paving stays coarse.
    bool only_hulls = false;
    /// What is tried before the search; `result.journal` says what came of it. {}: nothing. Further
    /// contractors, your own among them, are further steps.
    sivid::strategy strategy = default_strategy();
    /// Boxes tested to draw the paving of the prior, when the search ran in products of parameters.
    std::size_t drawn_boxes = 1500;
    /// What may be added to `search.seconds`, at most, to complete a result: the box about the
    /// witness, the drawing of the prior, the measurements that fail in every case; and as much
    /// again to see why little was excluded.
    double completing_seconds = 0.3;
    /// Called with the state every `search.checkpoint_seconds` of the search and when a budget ends
    /// it (in place of `search.checkpoint`).
    std::function<void(identification_state const&)> checkpoint = nullptr;
    /// Goes on from here (in place of `search.resume`): for the same problem, by its digest, and
    /// options but for budgets and threads. The result is the one of an uninterrupted run, bit for
    /// bit, on the same program and kind of processor; proved it is on any.
    std::shared_ptr<identification_state const> resume = nullptr;
    /// Searches in place of `invert`, with the same result: on many machines, say. It is told the
    /// fit and what was left before it, by which the test was prepared.
    std::function<inversion(feasibility_test&, box const& prior, inversion_options const&,
                            std::optional<approximate_fit> const&, std::optional<leftover> const&)>
        invert_by = nullptr;
};

} // namespace sivid

#endif
