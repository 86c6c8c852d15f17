// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IDENTIFY_OPTIONS_HPP
#define SIVID_PAVING_IDENTIFY_OPTIONS_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/paving/contract/window_contraction.hpp>
#include <sivid/paving/identification_state.hpp>
#include <sivid/paving/inversion_options.hpp>
#include <sivid/paving/judge/feasibility_test_options.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

namespace sivid {

class feasibility_test;

/// How the prior is searched.
enum class algorithm {
    contracting, ///< contraction by linear programs, smear bisection, largest box first, witness
    /// Algorithm 1 of the report: bisection alone, no outlier allowed; first box in, first out, to
    /// an accuracy that is a share of the prior, whatever `search` says of these two.
    report_1,
    /// Algorithm 2 of the report, likewise; its threshold is a budget of outliers, see
    /// `outlier_rule::threshold`.
    report_2
};

struct identify_options {
    sivid::algorithm algorithm = sivid::algorithm::contracting;
    inversion_options search{.accuracy_of_hull = true, .proof_bytes = std::size_t{1} << 25};
    feasibility_test_options test;
    /// Stop when the hulls no longer shrink, by `search.hull_gain`, or 2 % where that is 0; the
    /// paving stays coarse.
    bool only_hulls = false;
    // What comes before the search, in the order in which it is tried. Each has the conditions that
    // stand beside it, and at most the share of the time that is left then; "early" means that
    // trajectories over what is left of the prior reach less than a quarter of the measurements.
    // Models with delays have none of the first three.

    /// Fixed shapes in place of constants within a function of one moving quantity: where runs end
    /// early; 0.9. Where they cut something off, nothing else is tried before the search.
    bool shapes = true;
    /// The state equations between samples (`contract_by_relations`) and interval observers, in
    /// turn: where runs end early; 0.15.
    bool equations = true;
    /// Windows of the records (`contract_by_windows`). After equations that cut something off,
    /// where runs still end early from known starts: one that begins with each record and grows as
    /// the prior shrinks (0.1), and if it leaves more than half, sixteen along each record, in
    /// states that the equations know (0.9). After slower inputs in vain: one that grows, where
    /// runs reach less than half of the measurements or parameters are five or more (0.7). Last,
    /// where starts are uncertain and runs end early: all along the records (0.8).
    bool windows = true;
    /// A search with slower inputs (`with_slower_inputs`, ten samples to a line): where an input
    /// has a thousand samples or more, runs end early, and with slower inputs a run at the fit
    /// tells at least a quarter of the measurements to half their bounds; 0.5 (windows of theirs,
    /// if `windows` are wanted: 0.6).
    bool slower_inputs = true;
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
    /// fit and the windows by which the test was prepared.
    std::function<inversion(feasibility_test&, box const& prior, inversion_options const&,
                            std::optional<approximate_fit> const&,
                            std::optional<window_contraction> const&)>
        invert_by = nullptr;
};

} // namespace sivid

#endif
