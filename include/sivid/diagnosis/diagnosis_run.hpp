// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_DIAGNOSIS_RUN_HPP
#define SIVID_DIAGNOSIS_DIAGNOSIS_RUN_HPP

#include <sivid/approximate/candidate/candidate.hpp>
#include <sivid/approximate/candidate/screened.hpp>
#include <sivid/approximate/place/estimated_place.hpp>
#include <sivid/compiled.hpp>
#include <sivid/diagnosis/candidate/detail/explained_hull.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/diagnosis_effort.hpp>
#include <sivid/diagnosis/gap/verified_inflation.hpp>
#include <sivid/diagnosis/hold_out/detail/holdout_results.hpp>
#include <sivid/diagnosis/holdout.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/manoeuvre.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/judge/feasibility_test_options.hpp>
#include <sivid/paving/relation/relation_finding.hpp>
#include <sivid/paving/strategy/strategy.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sivid {

struct diagnosis_options {
    double seconds = 60;              ///< for everything; what is not finished then stays undecided
    gap_options gap{};                ///< the certified inflation of the model
    step_effort answer{10, 0.04};     ///< the certified inflation of the answer
    step_effort exclusion{12, 0.03};  ///< one candidate that seems excluded ...
    step_effort exclusions{36, 0.08}; ///< ... and all of them
    step_effort part{2, 0.01};        ///< the inflation of one scenario or channel ...
    double parts_share = 0.05;        ///< ... and of all of them, see `step_effort::share`
    step_effort confinement{12, 0.06}; ///< which measurements stand alone; boxes: for each of them
    double first_fit_share = 0.4;      ///< of the model itself
    double reach_share = 0.02;         ///< why it is not known whether there is a gap
    double relations_share = 0.1;      ///< which equations cannot hold
    double verdict_share = 0.15;       ///< kept from the candidates for the proofs about them
    double discharge_share = 0.15;     ///< whether a sensor, not its equation, may be wrong
    double places_share = 0.25; ///< where the model, and then where the closest candidate departs
    double terms_share = 0.2;   ///< what no effect of the catalogue is
    step_effort hulls{4000, 0.45}; ///< the hulls of the answer's parameters, last
    /// What is tried on each part before it is searched for these hulls, and while.
    sivid::strategy strategy = default_strategy(search_kind::parts);
    std::size_t remaining_sets = 30; ///< of places that the closest candidate may have wrong
    screening_options screening{};   ///< but for its time: it gets all that the others leave
    choice_options choice{};
    /// How boxes of parameters are enclosed. Its workers run candidates and scenarios at once; the
    /// result is that of one thread, but for what a limit of time cuts off.
    feasibility_test_options test{};
    std::vector<manoeuvre> menu{}; ///< from which the next experiment is proposed
    /// Called with what is being done, by one thread at a time; false ends with what is known so
    /// far.
    std::function<bool(std::string const&)> progress{};
    /// Called with what is known of whether there is a gap, and where: first before anything that
    /// takes long, then as often as more is known.
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
    /// Of every parameter of the answer that explains the data; no sides: not known.
    explained_hull answer_hull;
    std::vector<relation_finding> findings; ///< the broken relations
    place_estimate places;
    place_estimate remaining_places; ///< of the closest candidate, when none explains the data
    std::optional<holdout_judgement> holdout_before, holdout_after;
};

/// Judges the model and the answer of a diagnosis by hold-out data and adds the figures: the only
/// place where such data are read, after everything is chosen.
/// Where the model itself is the closest candidate, it alone is judged.
/// @param seconds, boxes  what all of it may spend, see `step_effort`
/// @throws std::invalid_argument  for hold-out experiments that do not fit the model
/// @guarantee  inflations are proved bounds for the hold-out data; misfits of the fits are no more
///   than measured. Nothing else of the diagnosis changes
/// @cost  a search for the inflation of each of the two, at most `seconds`
SIVID_DECL void judge_by_holdout(diagnosis_run& run, holdout const& data, double seconds = 6,
                                 feasibility_test_options const& test = {},
                                 std::size_t boxes = 120);

/// Where no effect explains the data: how large an unknown function of time beside an equation must
/// be for the model as it is to do so. Each equation that constants or inputs act on is disturbed
/// alone; those of the suspected places first. Nothing is done for other answers, delays, outliers.
/// @param seconds  of work (`work_limit`), for all
/// @guarantee  as of `least_disturbance`; nothing else of the diagnosis changes
SIVID_DECL void bound_disturbances(diagnosis_run& run, double seconds = 10,
                                   feasibility_test_options const& test = {});
/// The same of one equation, as it is stored.
[[nodiscard]] SIVID_DECL needed_disturbance
disturbance_needed(identification_problem const& base, std::size_t equation, double seconds,
                   feasibility_test_options const& test);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/impl/diagnosis_run.ipp>
#endif

#endif
