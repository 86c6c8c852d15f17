// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_IMPL_DIAGNOSE_IPP
#define SIVID_DIAGNOSIS_IMPL_DIAGNOSE_IPP

#include <sivid/diagnosis/diagnose.hpp>

#include <sivid/approximate/candidate/screening.hpp>
#include <sivid/approximate/place/detail/place_estimate.hpp>
#include <sivid/compiled.hpp>
#include <sivid/diagnosis/candidate/detail/candidate_order.hpp>
#include <sivid/diagnosis/candidate/detail/describe_candidate.hpp>
#include <sivid/diagnosis/candidate/detail/proposed_faults.hpp>
#include <sivid/diagnosis/claim/detail/answer_formulas.hpp>
#include <sivid/diagnosis/claim/detail/answer_hulls.hpp>
#include <sivid/diagnosis/claim/detail/candidate_verdicts.hpp>
#include <sivid/diagnosis/claim/detail/claim_review.hpp>
#include <sivid/diagnosis/claim/detail/diagnosis_consistency.hpp>
#include <sivid/diagnosis/claim/detail/opening_words.hpp>
#include <sivid/diagnosis/claim/detail/place_report.hpp>
#include <sivid/diagnosis/claim/detail/shared_bounds.hpp>
#include <sivid/diagnosis/diagnosis_run.hpp>
#include <sivid/diagnosis/gap/detail/confined_gap.hpp>
#include <sivid/diagnosis/gap/detail/gap_proof.hpp>
#include <sivid/diagnosis/gap/detail/part_inflation.hpp>
#include <sivid/diagnosis/manoeuvre.hpp>
#include <sivid/diagnosis/sensor/detail/sensor_discharge.hpp>
#include <sivid/diagnosis/verification.hpp>
#include <sivid/paving/relation/detail/broken_relation.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Diagnoses one campaign step by step.
class diagnostician {
public:
    diagnostician(identification_problem base, std::vector<effect> catalogue,
                  diagnosis_options options)
        : options_(std::move(options)),
          effort_(options_.seconds, options_.test, options_.progress, options_.strategy) {
        run_.base = std::move(base);
        run_.catalogue = std::move(catalogue);
        run_.base.require_valid_campaign();
        require_distinct(run_.base.model.about, run_.catalogue);
        options_.screening.progress = [this](std::string const& what) {
            return effort_.left() > kept_ && effort_.go_on("trying " + what);
        };
        options_.screening.go_on = [this] { return effort_.left() > kept_ && effort_.go_on(); };
        options_.screening.workers = options_.test.workers;
        options_.screening.seconds = std::numeric_limits<double>::infinity();
    }

    [[nodiscard]] diagnosis_run operator()() {
        auto& d = run_.result;
        d.time_unit = run_.base.model.about.time_unit;
        d.assumptions.push_back(input_assumption(run_.base.experiments));
        screening tried(run_.base, run_.catalogue, options_.screening);
        kept_ = (1 - options_.first_fit_share) * options_.seconds;
        tried.try_one({});
        run_.candidates = tried.candidates();
        if (!run_.candidates.empty()) look_first();
        if (d.gap != gap_verdict::none) {
            d.answer = answer_kind::open;
            d.tried = tried.counts();
            if (!run_.candidates.empty() && !effort_.stopped()) find_causes(tried);
        }
        discharge_sensors();
        share_bounds(run_);
        announce();
        answer_hulls(run_, effort_, options_)(); // last: they take what time there is
        settle_claims(run_);
        state_constants();
        state_change(run_);
        d.interrupted = effort_.stopped() || !d.tried.complete();
        d.seconds = effort_.seconds();
        d.by_clock = effort_.late();
        return std::move(run_);
    }

private:
    /// Whether there is a gap, and where: what is quickly known first.
    void look_first() {
        auto const base = run_.candidates.front();
        auto& bound = run_.base_bound;
        bound = verify_fit(base, effort_.test());
        know_gap();
        bool const explained = run_.result.gap == gap_verdict::none;
        if (!explained) {
            find_relations();
            announce();
            find_places();
            announce();
        }
        if (!base.problem.model.has_memory() && effort_.go_on("bounding the gap"))
            prove_gap(bound, base, effort_, options_.gap);
        know_gap();
        if (run_.result.gap == gap_verdict::undecided) see_reach();
        announce();
    }
    void know_gap() {
        auto& d = run_.result;
        d.inflation = run_.base_bound.range;
        if (auto const& w = run_.base_bound.witness)
            d.witness = named(run_.base, w->parameters, w->starts);
        d.gap = gap_of(d.inflation);
        if (d.gap != gap_verdict::none) return;
        // A better fit was found: nothing is missing, and what led to a proof does not hold.
        d.where.clear();
        d.relations.clear();
        run_.findings.clear();
        run_.places = {};
    }
    /// Why it could not be told whether there is a gap.
    void see_reach() {
        run_options const run = limited(effort_.test(), effort_.within(options_.reach_share));
        run_.result.reach = reach_of_runs(run_.base, run_.base.prior, run);
    }
    void find_relations() {
        if (!effort_.go_on("proving which equations cannot hold")) return;
        relation_options options;
        options.go_on = effort_.within(options_.relations_share);
        run_.findings = find_broken_relations(run_.base, options);
        for (auto const& f : run_.findings) run_.result.relations.push_back(reported(f));
    }
    void find_places() {
        if (!effort_.go_on("looking where the model departs from the data")) return;
        run_.places = estimate_places(run_.base, place_effort(), &run_.candidates.front().fit);
        run_.result.where = reported(run_.places, run_.findings);
    }
    [[nodiscard]] place_options place_effort() {
        place_options result;
        result.workers = effort_.test().workers;
        result.search.go_on = effort_.within(options_.places_share);
        return result;
    }
    void announce() {
        if (!options_.first_sentence || run_.candidates.empty()) return;
        auto text = opening_words(run_.result, run_.base, run_.candidates.front().fit);
        if (text != said_) options_.first_sentence(said_ = std::move(text));
    }

    /// Which effects, and what of that can be proved: all candidates before anything that only
    /// tells more of the answer.
    void find_causes(screening& tried) {
        auto& d = run_.result;
        auto order = try_candidates(tried, options_.verdict_share);
        bool going = candidate_verdicts(run_, order, effort_, options_).verify();
        bool const proved = answer_by_proof(d);
        if (!proved && going && !d.tried.complete()) { // what is left is for the next ones
            order =
                try_candidates(tried, 0.2 * options_.verdict_share + options_.confinement.share);
            going = candidate_verdicts(run_, order, effort_, options_).verify();
            (void)answer_by_proof(d);
        }
        bool const alone = going && unanswered(d.answer);
        for (auto const further :
             {&diagnostician::try_confined, &diagnostician::try_faults, &diagnostician::try_law,
              &diagnostician::try_episodes, &diagnostician::try_threes, &diagnostician::try_laws}) {
            if (!going || !unanswered(d.answer) || !(this->*further)(tried)) continue;
            order = try_candidates(tried, 0.2 * options_.verdict_share);
            going = candidate_verdicts(run_, order, effort_, options_).verify();
            (void)answer_by_proof(d);
        }
        if (going) candidate_verdicts(run_, order, effort_, options_).refute();
        describe_remainder();
        propose(order);
        if (!alone) confine();
        measure_parts();
    }

    /// Effects that act in some experiments only: in those that stand alone against the model, or
    /// in all but those that do so against a model with one effect.
    /// @returns  whether there are some to be tried
    [[nodiscard]] bool try_confined(screening& tried) {
        confine();
        auto const before = tried.candidates().size();
        kept_ = 0.2 * options_.verdict_share * options_.seconds;
        for (auto const& c : run_.result.confined) {
            if (!c.scenarios.empty() && can_stand_in_a_name(c.scenarios))
                tried.try_within(c.scenarios);
        }
        constexpr std::size_t most = 2;
        confinement_options options;
        options.channels = false;
        options.go_on = options_.screening.go_on;
        for (auto const k : closest_singles(run_.candidates, run_.catalogue, most)) {
            auto const& s = run_.candidates[k];
            for (auto const& part : find_unexplained_parts(s.problem, s.fit, options)) {
                std::vector<std::string> others;
                for (std::size_t e = 0; e < run_.base.experiments.size(); ++e) {
                    auto const& in = part.experiments;
                    if (std::find(in.begin(), in.end(), e) == in.end())
                        others.push_back(run_.base.experiments[e].name);
                }
                if (can_stand_in_a_name(others)) tried.try_within(others, {s.figures.effects});
            }
        }
        return tried.candidates().size() > before;
    }
    /// Faults of instruments that may be the cause, which the catalogue has not.
    [[nodiscard]] bool try_faults(screening& tried) {
        if (!run_.result.tried.complete()) return false;
        keep_but(options_.terms_share);
        auto faults = proposed_faults(run_.base, run_.places, run_.result.confined);
        return !faults.empty() && tried.try_further(std::move(faults), false);
    }
    /// Effects that begin or end midway; where one instrument may be the cause, an end is a guess.
    /// @returns  whether some explain the data
    [[nodiscard]] bool try_episodes(screening& tried) {
        std::vector<std::string> names;
        for (auto const& e : run_.base.experiments) names.push_back(e.name);
        if (!run_.result.tried.complete() || !can_stand_in_a_name(names)) return false;
        auto const before = tried.candidates().size();
        kept_ = 0.4 * options_.verdict_share * options_.seconds; // when they begin, too
        tried.try_episodes(lacks_more());
        return tried.candidates().size() > before;
    }
    /// Whether all of the plan was tried in vain, and neither bounds that are too small nor one
    /// instrument may be the cause. Some experiments may stand alone: others need not show it.
    [[nodiscard]] bool lacks_more() const {
        auto const of_channel = [](confined_gap const& c) { return !c.channel.empty(); };
        return run_.result.tried.complete() && !one_sensor_explains(run_.places) &&
               std::ranges::none_of(run_.result.confined, of_channel);
    }
    [[nodiscard]] bool try_threes(screening& tried) {
        if (!lacks_more()) return false;
        kept_ = 0.2 * options_.verdict_share * options_.seconds;
        bool const explains = tried.try_threes();
        run_.result.tried = tried.counts();
        return explains;
    }
    /// What no effect of the catalogue is, in a fifth of the time at most: one law, which says less
    /// than effects that begin midway or three at once, and after these two.
    [[nodiscard]] bool try_law(screening& tried) { return try_terms(tried, false); }
    [[nodiscard]] bool try_laws(screening& tried) { return try_terms(tried, true); }
    [[nodiscard]] bool try_terms(screening& tried, bool two) {
        if (!lacks_more()) return false;
        keep_but(options_.terms_share);
        return tried.try_further(proposed_terms(run_.places), two);
    }
    /// What follows may take this share of all time at most, and leaves some for verdicts.
    void keep_but(double share) {
        kept_ = std::max(0.2 * options_.verdict_share * options_.seconds,
                         effort_.left() - effort_.seconds_of({0, share}));
    }

    /// Which measurements alone stand against the model.
    void confine() {
        if (!effort_.go_on("looking which measurements stand alone")) return;
        confinement_options options;
        options.go_on = effort_.within(options_.confinement.share);
        options.lower = effort_.search(run_.base, options_.confinement);
        options.lower.keep_going = options.go_on;
        run_.result.confined = find_confined_gaps(run_.base, run_.candidates.front().fit,
                                                  run_.result.inflation, options);
    }

    /// Tries what is left of the plan and decides what the answer is by then.
    /// @param share  of all time that is kept
    [[nodiscard]] candidate_order try_candidates(screening& tried, double share) {
        kept_ = share * options_.seconds;
        tried.run();
        run_.candidates = tried.candidates();
        run_.catalogue = tried.catalogue();
        auto& d = run_.result;
        d.tried = tried.counts();
        auto const figures = tried.figures();
        candidate_order order(figures, tried.measurements(), options_.choice);
        run_.answer = order.answer();
        run_.answer_bound = {};
        run_.answer_hull = {};
        d.shrink_fit.reset();
        d.combinations.clear();
        d.effects.clear();
        if (order.explained()) {
            d.effects = names_of(figures[order.answer()], run_.catalogue);
            d.answer = d.effects.empty() ? answer_kind::none : answer_kind::effects;
        } else {
            d.answer = d.tried.complete() ? answer_kind::unexplained : answer_kind::open;
        }
        d.indistinguishable.clear();
        for (auto const o : order.others()) {
            d.indistinguishable.push_back(names_of(figures[o], run_.catalogue));
        }
        d.unobservable.clear();
        for (auto const& c : run_.candidates) {
            if (!c.silent || c.figures.effects.size() != 1) continue;
            d.unobservable.push_back(run_.catalogue[c.figures.effects.front()].name);
        }
        d.causes.clear();
        for (auto const i : order.order()) {
            d.causes.push_back(cause_of(run_.candidates[i], run_.catalogue, run_.base.prior.size(),
                                        tried.measurements()));
        }
        return order;
    }

    /// Every constant of the model that is the answer, and which sit at the end of their prior.
    void state_constants() {
        auto& d = run_.result;
        if (run_.candidates.empty()) return;
        auto const& s = run_.candidates[run_.answer];
        auto const& bound = run_.answer == 0 ? run_.base_bound : run_.answer_bound;
        d.constants = named_parameters(s.problem, bound.witness ? bound.witness->parameters
                                                                : s.fit.parameters);
        d.constants_verified = bound.witness && bound.range.upper() <= 1;
        auto const& hulls = run_.answer_hull;
        for (std::size_t j = 0; j < std::min(d.constants.size(), hulls.parameters.size()); ++j) {
            d.constants[j].hull = hulls.parameters[j];
        }
        d.combinations = told_combinations(s.problem, d.constants, hulls);
        add_constants_at_ends(names_of(s.figures, run_.catalogue), d.constants, d.at_ends,
                              d.combinations);
        // A term may stand for a constant that may not go where it should.
        bool const terms = std::any_of(d.effects.begin(), d.effects.end(), names_missing_term);
        if (d.constants_verified && !terms) return;
        auto const& base = run_.candidates.front();
        add_constants_at_ends({}, named_parameters(base.problem, base.fit.parameters), d.at_ends);
    }

    /// Proves of places that no sensor of their relation can be what is wrong instead.
    void discharge_sensors() {
        auto& d = run_.result;
        if (d.gap == gap_verdict::none || run_.findings.empty()) return;
        if (run_.places.places.empty() || instruments_explain(run_.places)) return;
        if (!effort_.go_on("looking whether a sensor may be wrong instead")) return;
        sensor_discharge discharged(run_.base, {}, {}, effort_.within(options_.discharge_share));
        for (auto& f : run_.findings) {
            if (is_about_equation(f, run_.places.places)) f.place = discharged(f);
        }
        d.where = reported(run_.places, run_.findings);
    }

    /// The inflation of each scenario and each channel alone.
    void measure_parts() {
        if (run_.base.model.has_memory()) return;
        auto const each = effort_.search(run_.base, options_.part);
        auto const& whole = run_.base_bound.range;
        double const end = effort_.left() - effort_.seconds_of({0, options_.parts_share});
        auto const next = [&](std::string const& name) {
            return effort_.left() >= end && effort_.go_on("measuring the gap of " + name);
        };
        run_.result.scenario_inflation = inflation_of_experiments(run_.base, whole, each, next);
        run_.result.channel_inflation = inflation_of_channels(run_.base, whole, each, next);
    }

    /// How much is left with the closest candidate, and where: the lead to what no effect has.
    void describe_remainder() {
        auto& d = run_.result;
        if (d.answer != answer_kind::unexplained || d.causes.empty()) return;
        auto const& nearest = run_.candidates[run_.answer];
        unexplained_remainder rest{
            names_of(nearest.figures, run_.catalogue), run_.answer_bound.range, {}};
        auto options = place_effort();
        if (run_.answer == 0) {
            rest.inflation = d.inflation;
            rest.where = d.where;
        } else if (same_inputs(nearest) && effort_.go_on("looking for what is left")) {
            options.search.most_sets = options_.remaining_sets;
            run_.remaining_places =
                estimate_places(nearest.problem, std::move(options), &nearest.fit);
            for (auto const& p : run_.remaining_places.places) rest.where.push_back(reported(p));
        }
        d.remainder = std::move(rest);
    }

    /// Whether no effect of a candidate has a switch.
    [[nodiscard]] bool same_inputs(screened const& s) const {
        return s.problem.model.about.inputs.size() == run_.base.model.about.inputs.size();
    }

    void propose(candidate_order const& order) {
        if (order.others().empty() ||
            !effort_.go_on("looking for a manoeuvre that tells rivals apart"))
            return;
        std::vector<screened const*> rivals{&run_.candidates[run_.answer]};
        for (auto const o : order.others()) rivals.push_back(&run_.candidates[o]);
        // Whether a switch were on in another manoeuvre nobody knows.
        if (!std::ranges::all_of(rivals, [this](auto const* s) { return same_inputs(*s); })) return;
        run_.result.next = propose_experiment(std::move(rivals), options_.menu, run_.base,
                                              [this] { return effort_.go_on(); });
    }

    diagnosis_options options_;
    diagnosis_effort effort_;
    diagnosis_run run_;
    std::string said_;
    double kept_ = 0; ///< what trying candidates leaves of the time [s]
};

SIVID_DECL diagnosis_run diagnose(identification_problem problem, std::vector<effect> catalogue,
                                  diagnosis_options options) {
    return diagnostician(std::move(problem), std::move(catalogue), std::move(options))();
}

} // namespace sivid

#endif
