// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_DIAGNOSIS_RUN_HPP
#define SIVID_DIAGNOSIS_DIAGNOSIS_RUN_HPP

#include <sivid/diagnosis/broken_relation.hpp>
#include <sivid/diagnosis/candidate.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/holdout_judgement.hpp>
#include <sivid/diagnosis/manoeuvre.hpp>
#include <sivid/diagnosis/place_estimate.hpp>
#include <sivid/diagnosis/screening.hpp>
#include <sivid/diagnosis/verification.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

struct diagnosis_options {
    double seconds = 60;       ///< for everything; what is not finished then stays undecided
    double gap_seconds = 4;    ///< for the certified inflation
    double verify_seconds = 3; ///< for the verdicts on candidates
    double each_seconds = 0.5; ///< of these, for one candidate that seems excluded
    /// Where more than twice as many experiments are at hand, so many of the hardest are tried
    /// first for a refutation.
    std::size_t hardest = 4;
    double hull_seconds = 1;  ///< for the hulls of the answer's parameters
    double parts_seconds = 2; ///< for the inflation of single scenarios and channels
    screening_options screening{};
    choice_options choice{};
    data_test_options test{};      ///< how boxes of parameters are enclosed
    std::vector<manoeuvre> menu{}; ///< from which the next experiment is proposed
    /// Called with what is being done; false ends with what is known so far.
    std::function<bool(std::string const&)> progress{};
    /// Called once it is known whether there is a gap, and where.
    std::function<void(std::string const&)> first_sentence{};
};

/// A diagnosis with the fits behind it, for pictures and for judging by hold-out data.
struct diagnosis_run {
    diagnosis result;
    identification_problem base;
    std::vector<effect> catalogue;
    std::vector<screened> candidates; ///< the model itself first
    std::size_t answer = 0;           ///< index of the candidate that is the answer
    verified_inflation base_bound, answer_bound;
    std::vector<relation_finding> findings; ///< the broken relations
    place_estimate places;
    place_estimate remaining_places; ///< of the closest candidate, when none explains the data
    std::optional<holdout_judgement> holdout_before, holdout_after;
};

/// Judges the model and the answer of a diagnosis by hold-out data and adds the figures: the only
/// place where such data are read, after everything is chosen.
inline void judge_by_holdout(diagnosis_run& run, holdout const& data, double seconds = 4,
                             data_test_options const& test = {}) {
    if (data.empty() || run.candidates.empty()) return;
    auto const& base = run.candidates.front();
    auto const before = judge_by_holdout(
        base, run.base_bound, data.judged_by(base, run.base, run.catalogue), seconds / 2, test);
    run.holdout_before = before;
    if (run.result.causes.empty()) return;
    auto const& answer = run.candidates[run.answer];
    auto const after =
        judge_by_holdout(answer, run.answer_bound, data.judged_by(answer, run.base, run.catalogue),
                         seconds / 2, test);
    run.holdout_after = after;
    holdout_figures figures;
    figures.inflation_before = before.at_witness;
    figures.inflation_after = after.at_witness;
    figures.over_fits_before = before.over_fits;
    figures.over_fits_after = after.over_fits;
    for (auto const& c : run.base.model.about.channels) figures.channels.push_back(c.name);
    figures.rmse_before = before.rmse;
    figures.rmse_after = after.rmse;
    figures.covered_before = before.covered;
    figures.covered_after = after.covered;
    figures.width_before = before.width;
    figures.width_after = after.width;
    run.result.shrink_holdout = shrink(figures.inflation_before, figures.inflation_after);
    run.result.causes.front().holdout = std::move(figures);
}

} // namespace sivid

#endif
