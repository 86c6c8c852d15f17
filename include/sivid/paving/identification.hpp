// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IDENTIFICATION_HPP
#define SIVID_PAVING_IDENTIFICATION_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/model/structure/combination.hpp>
#include <sivid/paving/divisors.hpp>
#include <sivid/paving/outliers/fewest_outliers.hpp>
#include <sivid/paving/products/reduction.hpp>
#include <sivid/paving/run/run_reach.hpp>
#include <sivid/paving/run_options.hpp>
#include <sivid/paving/search/exclusion_proof.hpp>
#include <sivid/paving/strategy/contractor.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/paving/verdict.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sivid {

/// How the volumes of a paving were computed.
enum class volume_source {
    boxes,   ///< summed over its boxes
    preimage ///< proved for the preimage of a finer paving of products of the parameters
};

/// A parameter and one initial state per experiment that are proved to explain the data.
struct verified_witness {
    std::vector<double> parameters;
    std::vector<std::vector<double>> starts;
    /// Per experiment and measurement (in order of time): whether the witness violates it.
    std::vector<std::vector<bool>> violated;
};

/// A measurement that every feasible parameter violates.
struct forced_outlier {
    std::size_t experiment = 0;
    std::size_t measurement = 0; ///< index in the order of time
};

/// The paving of fewer parameters, products among them, in which a search ran.
struct product_paving {
    reduction map;
    subpaving paving; ///< of the prior of `map.problem()`
};

/// How far a search went and how far it might have gone: what its reason to stop follows from.
struct search_effort {
    double seconds = 0, most_seconds = 0; ///< of the budget, spent by the search when it stopped
    std::size_t boxes = 0, most_boxes = 0;
    std::optional<std::size_t> most_bytes; ///< nothing: as many as there are
    /// What it was to end at, as in `inversion_options`; nothing: not stated.
    std::optional<double> sufficient_ratio{}, hull_gain{};
};

/// What was found about a problem; everything in it is proved, `guess` excepted.
struct identification {
    explicit identification(box const& prior) : paving(prior), hull(prior) {}

    sivid::verdict verdict = sivid::verdict::undecided;
    stop_reason reason = stop_reason::decided;
    contraction_journal journal{}; ///< what was tried before the search, and why
    /// Over what is left, where little was excluded and the search has not decided all of it.
    std::vector<run_reach> reach;
    /// With them: what the equations divide by that is, or may be, zero somewhere.
    std::vector<divisor> divisors;
    std::optional<search_effort> effort; ///< nothing where measurements came one by one
    /// Of the prior: inside boxes are proved, what no other box covers is excluded by proof.
    subpaving paving;
    volume_source volumes = volume_source::boxes;
    std::optional<product_paving> products; ///< what `paving` was drawn from
    box hull; ///< contains every feasible parameter; empty sides when there is none
    std::optional<verified_witness> witness;
    std::vector<combination_hull> combinations;
    std::vector<std::size_t> entangled; ///< parameters known only through `combinations`
    std::vector<forced_outlier> forced;
    std::optional<fewest_outliers> fewest; ///< of `smallest_outlier_budget`, when it was asked for
    /// How what the search excluded can be proved, in `products` or else in the parameters; not
    /// needed for anything but checks.
    exclusion_proof proof;
    run_options run; ///< how experiments were enclosed
    std::vector<std::string> assumptions;
    std::optional<approximate_fit> guess; ///< the best fit found, not proved
    std::size_t boxes = 0;
    std::size_t integrations = 0;
    double seconds = 0;
    /// The time ended what its budget of counted work would have gone on with: on a faster machine,
    /// or one with less to do, the answer may say more.
    bool by_clock = false;

    /// Nothing was decided, more than half of the prior's volume is left, or a search could not help.
    [[nodiscard]] bool excludes_little() const {
        return verdict == sivid::verdict::undecided || paving.outer_volume().upper() > 0.5 ||
               reason == stop_reason::too_blurred;
    }
};

} // namespace sivid

#endif
