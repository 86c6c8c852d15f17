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
    report_1,    ///< Algorithm 1 of the report: bisection alone, no outlier allowed
    report_2     ///< Algorithm 2 of the report; its threshold is a budget of outliers, see
                 ///< `outlier_rule::threshold`
};

struct identify_options {
    sivid::algorithm algorithm = sivid::algorithm::contracting;
    inversion_options search{.proof_bytes = std::size_t{1} << 25};
    feasibility_test_options test;
    /// Stop when the hulls no longer shrink; the paving stays coarse.
    bool only_hulls = false;
    /// Contract the prior first, unless slower inputs have done so. Where runs over it reach less
    /// than a quarter of the measurements, by the state equations (`contract_by_relations`), in at
    /// most 0.08 of the time. Where they reach less than half over what is left, or parameters are
    /// five or more, by a window of each record that begins with it and grows as the prior shrinks
    /// (`contract_by_windows`), in at most 0.7 of the time. Where they still reach less than a
    /// quarter and starts are not known exactly, by windows all along the records, in at most 0.8.
    bool windows = true;
    /// Search with slower inputs first (`with_slower_inputs`, ten samples to a line), in at most
    /// half of the time (windows of theirs: 0.6), where an input has a thousand samples or more,
    /// trajectories over the prior reach less than a quarter of the measurements, and with slower
    /// inputs a run at the fit tells at least a quarter of them to half their bounds.
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
