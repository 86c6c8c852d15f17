// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_INVERSION_OPTIONS_HPP
#define SIVID_PAVING_INVERSION_OPTIONS_HPP

#include <sivid/executor.hpp>
#include <sivid/paving/search/exclusion_proof.hpp>
#include <sivid/paving/search/frontier.hpp>
#include <sivid/paving/search/search_state.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/paving/verdict.hpp>

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>

namespace sivid {

/// The state of a running search.
struct paving_progress {
    double seconds = 0;
    std::size_t tested = 0;  ///< boxes tested
    std::size_t pending = 0; ///< boxes that wait
    double inner = 0;        ///< relative volume proved inside (approximately, for display)
    double outer = 1;        ///< relative volume not proved outside
};

struct inversion_options {
    /// A box is left undecided when no side is wider than this fraction of the prior's side.
    double accuracy = 1e-3;
    /// `accuracy` is a fraction of the hull of all that is not proved outside in the end, instead.
    bool accuracy_of_hull = false;
    /// Stop when no side of that hull has shrunk by more than this fraction while the boxes tested
    /// doubled, twice in a row (0: never), and each of its faces is touched by a box that the test
    /// saw sharply. `stop_reason::hulls_rest`.
    double hull_gain = 0;
    /// A hull of at most this share of the prior's volume rests whether or not its faces are seen
    /// sharply: uncertain starts may blur all that is seen.
    double small_hull = 0;
    /// Stop when the inner volume reaches this fraction of the outer one (1: never), whatever the
    /// accuracy. `stop_reason::inside_share`.
    double sufficient_ratio = 0.5;
    /// Of one core of the machine of the prices: see `work_limit`. The time ends it as well.
    double seconds = 60;
    /// Boxes tested; a step that was begun is ended, and one that learns may test `batches` full
    /// sets.
    std::size_t boxes = 10'000'000;
    /// Bytes for waiting and paved boxes and for what was learnt about them: what they hold,
    /// without the allocator's share and the spare room of growing lists (at most as much again for
    /// boxes).
    std::size_t memory = std::numeric_limits<std::size_t>::max();
    search_order order = search_order::largest_first;
    /// Whether proved outside boxes are kept in the result (for pictures).
    bool keep_outside = true;
    /// Called after each test; false stops the search with what is proved until then.
    std::function<bool(paving_progress const&)> progress = nullptr;
    /// The same question between two tests and, where the test can be interrupted
    /// (`interruptible_set_test`), during one; by any thread. Once it is false it stays so.
    std::function<bool()> keep_going = nullptr;

    /// A test that learns about several boxes at once gets up to so many full sets of boxes at a
    /// time, which different threads can work on. It is part of what the result depends on; how
    /// many threads there are is not.
    std::size_t batches = 1;
    /// Judges and learns for tests that allow it (concurrent_set_test).
    executor workers{};

    /// Bytes for what the test says of how its exclusions are proved: it is kept up to there and
    /// ends up in `inversion::proof`, beside `memory`.
    std::size_t proof_bytes = 0;

    /// Called with the state every `checkpoint_seconds`, between two tests, and when a budget or a
    /// cancellation ends the search. Never takes more than a tenth of the time.
    std::function<void(search_state const&)> checkpoint = nullptr;
    double checkpoint_seconds = 10;
    /// Goes on from here. The time of the earlier runs counts; the budgets may have changed, the
    /// test, the prior and the other options must be the same.
    std::shared_ptr<search_state const> resume = nullptr;
};

struct inversion {
    subpaving paving;
    stop_reason reason = stop_reason::decided;
    std::size_t tested = 0;
    std::size_t cost = 0;       ///< sum over the tests, in their unit
    double seconds = 0;         ///< of all runs
    double work = 0;            ///< the same of the budget, by the `work_clock`
    bool by_clock = false;      ///< the time ended it: see `work_limit`
    exclusion_proof proof = {}; ///< where it was asked for
};

} // namespace sivid

#endif
