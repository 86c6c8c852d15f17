// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_IMPL_DIAGNOSIS_CHECK_IPP
#define SIVID_VERIFIER_IMPL_DIAGNOSIS_CHECK_IPP

#include <sivid/verifier/diagnosis_check.hpp>

#include <sivid/diagnosis/gap/detail/confined_gap.hpp> // first: its definitions include the next

#include <sivid/approximate/fit/detail/counterexample.hpp>
#include <sivid/diagnosis/candidate/detail/describe_candidate.hpp>
#include <sivid/diagnosis/claim/detail/answer_hulls.hpp>
#include <sivid/diagnosis/claim/detail/claim_review.hpp>
#include <sivid/diagnosis/claim/detail/diagnosis_consistency.hpp>
#include <sivid/diagnosis/claim/detail/embedded_problem.hpp>
#include <sivid/diagnosis/claim/detail/place_report.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/diagnosis/diagnosis_run.hpp>
#include <sivid/diagnosis/gap/detail/coarse_steps.hpp>
#include <sivid/diagnosis/sensor/detail/sensor_discharge.hpp>
#include <sivid/diagnosis/verification.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/change/changed_formulas.hpp>
#include <sivid/model/named_effects.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/paving/inflation.hpp>
#include <sivid/paving/inflation/observer_refutation.hpp>
#include <sivid/paving/relation/detail/broken_relation.hpp>
#include <sivid/paving/relation/detail/untouched_relation.hpp>
#include <sivid/verifier/claim/detail/named_motion.hpp>
#include <sivid/verifier/claim/detail/stated_range.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace sivid {

namespace io_detail {

/// Shares of the gap follow from the inflations.
/// @param c  the answer; null: the closest cause is meant
[[nodiscard]] inline check_finding check_shrinks(diagnosis const& d, cause const* c) {
    using outcome = check_finding::outcome;
    using maybe = std::optional<interval>;
    finding_of_all all;
    auto const follows = [&](maybe const& stated, interval const& before, maybe const& after,
                             char const* which) {
        if (!stated) return;
        auto const again = after ? shrink(before, *after) : std::nullopt;
        // What reading rounded outward is the larger the smaller the gap.
        double const gap = before.lower() > 1 ? before.lower() - 1 : before.upper() - 1;
        double const slack = 1e-12 * (1 + 1 / std::max(1e-12, gap));
        auto const room = [slack](double end) { return slack * std::max(1.0, std::abs(end)); };
        bool const holds = again && !is_empty(*stated) &&
                           again->lower() >= stated->lower() - room(stated->lower()) &&
                           again->upper() <= stated->upper() + room(stated->upper());
        all.note(holds ? outcome::verified : outcome::refuted,
                 std::string{"the share of "} + which + " does not follow from the inflations");
    };
    if (c == nullptr && !d.causes.empty()) c = &d.causes.front();
    auto const held = c != nullptr ? c->holdout : std::nullopt;
    auto const before = held ? held->inflation_before : d.inflation;
    follows(d.shrink_fit, d.inflation, c != nullptr ? maybe{c->inflation} : std::nullopt,
            "the fit");
    follows(d.shrink_holdout, before, held ? maybe{held->inflation_after} : std::nullopt,
            "the held-out data");
    follows(d.shrink_over_fits, before, held ? held->over_fits_after : std::nullopt, "all fits");
    return all.finding("shrink", "follows from the inflations");
}

} // namespace io_detail

/// Proofs about the least factor by which bounds must grow until a parameter explains the data, by
/// the provers of the diagnosis.
class inflation_proof {
    using outcome = check_finding::outcome;

public:
    /// @param limit  of all that it does; outlives it
    inflation_proof(feasibility_test_options test, work_limit const& limit)
        : test_(limited(std::move(test), limit)), limit_(&limit) {}

    /// Whether a validated run of the witness proves that the factor is `most` at most.
    /// @param assumptions  receives what the run rests on; may be null
    [[nodiscard]] outcome at_most(identification_problem const& p, named_witness const& w,
                                  double most,
                                  std::vector<std::string>* assumptions = nullptr) const {
        auto const point = io_detail::point_of(p, w);
        if (!point) return outcome::refuted;
        auto const proved = verify_at(p, *point, test_);
        if (assumptions != nullptr) *assumptions = proved.assumptions;
        return proved.range.upper() <= most  ? outcome::verified
               : proved.range.lower() > most ? outcome::refuted
                                             : outcome::undecided;
    }

    /// Whether no parameter explains the data while all bounds are `least` times as wide, or less.
    /// @param share  of the time that is left
    [[nodiscard]] outcome at_least(identification_problem const& p, double least,
                                   double share) const {
        if (!(least > 0)) return outcome::verified;
        if (!p.model.has_memory() && !has_wide_starts(p)) {
            auto const found = bounds(p, 0.5 * share * limit_->seconds());
            if (!io_detail::below(found.lower(), least)) return outcome::verified;
            if (found.upper() <= clearly * least) return outcome::refuted;
        }
        return none_explains(bound_growth::of(p, {})(p, least - 1), share);
    }

    /// What a search proves of the factor.
    [[nodiscard]] inflation_bound search(identification_problem const& p,
                                         approximate_fit const* guess, double seconds) const {
        inflation_options how;
        how.relative_width = 0.01;
        how.seconds = seconds;
        how.keep_going = *limit_;
        how.test = test_;
        return bound_inflation(p, guess, how);
    }
    [[nodiscard]] interval bounds(identification_problem const& p, double seconds) const {
        return search(p, nullptr, seconds).value;
    }

    /// Whether no parameter of the prior explains the data; refuted where one does with room to
    /// spare: what was rounded away is no contradiction.
    /// @cost  a fit, then a search until it is decided, or the time is up
    [[nodiscard]] outcome none_explains(identification_problem const& p, double share) const {
        double const seconds = share * limit_->seconds();
        bool const memory = p.model.has_memory();
        counterexample_options fits;
        fits.seconds = 0.2 * seconds;
        fits.keep_going = *limit_;
        fits.confirms = [&](approximate_fit const& f) {
            return verify_at(p, f, test_).range.upper() <= clearly;
        };
        if (find_explaining_point(p, {p.prior}, fits)) return outcome::refuted;
        if (memory || !(*limit_)()) return outcome::undecided; // no search over delays
        bool const wide = has_wide_starts(p);
        if (wide && by_observers(p, 0.4 * seconds)) return outcome::verified;
        inflation_options how;
        how.only_verdict = true;
        how.relative_width = 0;
        how.seconds = 0.5 * seconds;
        how.keep_going = *limit_;
        how.test = test_;
        auto const found = bound_inflation(p, nullptr, how).value;
        if (found.lower() > 1) return outcome::verified;
        if (found.upper() <= clearly) return outcome::refuted;
        return !wide && by_observers(p, 0.3 * seconds) ? outcome::verified : outcome::undecided;
    }

    [[nodiscard]] feasibility_test_options const& test() const { return test_; }

private:
    /// An inflation that is below 1 by more than roundings of decimals.
    static constexpr double clearly = 1 - 1e-6;

    [[nodiscard]] bool by_observers(identification_problem const& p, double seconds) const {
        observer_effort most;
        most.boxes = static_cast<std::size_t>(-1);
        most.seconds = seconds;
        most.go_on = *limit_;
        most.only_verdict = true;
        return inflation_refuted_by_observers(p, detail::infinity, most).lower > 1;
    }

    feasibility_test_options test_;
    work_limit const* limit_;
};

namespace io_detail {

/// The inflation of each scenario and channel alone.
/// @param most  what that of all data is proved to be at most: then that of a part is, too
[[nodiscard]] inline check_finding check_parts(identification_problem const& base,
                                               diagnosis const& d, double most,
                                               inflation_proof const& proof,
                                               work_limit const& limit) {
    using outcome = check_finding::outcome;
    finding_of_all all;
    std::size_t left = d.scenario_inflation.size() + d.channel_inflation.size();
    for (auto const* const list : {&d.scenario_inflation, &d.channel_inflation}) {
        for (auto const& stated : *list) {
            double const share = 0.5 / static_cast<double>(left--);
            auto const own = restricted_to(base, [&](std::size_t e, measurement const& m) {
                bool const scenario = list == &d.scenario_inflation;
                return stated.name == (scenario ? base.experiments[e].name
                                                : base.model.about.channels[m.channel].name);
            });
            bool const none = std::ranges::all_of(own.experiments, &experiment::constraint);
            if (none) all.note(outcome::refuted, "no such part of the data: " + stated.name);
            auto const hull = stated.hull.value_or(unknown_inflation());
            if (none || (hull.lower() <= 0 && std::isinf(hull.upper()))) continue;
            auto found = proof.bounds(own, share * limit.seconds());
            if (found.lower() <= most && most < found.upper())
                found = interval_traits<interval>::bounds(found.lower(), most);
            auto says = compared(found, hull);
            if (says == outcome::undecided && found.upper() <= hull.upper())
                says = proof.at_least(own, hull.lower(), share);
            all.note(says, "the inflation of " + stated.name + " alone is not proved again");
        }
    }
    return all.finding("parts of the data", "scenarios and channels alone");
}

/// A part of the data that alone stands against the model.
/// @param whole  a factor for all bounds that is proved not to be enough: then it is not for some
[[nodiscard]] inline check_finding check_confined(identification_problem const& base,
                                                  confined_gap const& c, double whole,
                                                  inflation_proof const& proof) {
    using outcome = check_finding::outcome;
    auto const what = "confined " + (c.channel.empty() ? joined(c.scenarios, ", ") : c.channel);
    data_part part;
    auto const& channels = base.model.about.channels;
    for (std::size_t y = 0; y < channels.size(); ++y)
        if (channels[y].name == c.channel) part.channel = y;
    for (auto const& name : c.scenarios) {
        auto const& list = base.experiments;
        auto const e = std::ranges::find(list, name, &experiment::name);
        if (e == list.end()) return {what, outcome::refuted, "no scenario " + name};
        part.experiments.push_back(static_cast<std::size_t>(e - list.begin()));
    }
    if (!c.channel.empty() && !part.channel)
        return {what, outcome::refuted, "no channel " + c.channel};
    finding_of_all all;
    auto const times = bound_growth::of(base, part);
    auto const grown = times(base, c.factor.upper() - 1);
    std::vector<std::string> needed;
    all.note(proof.at_most(grown, c.witness, 1, &needed),
             "the witness does not explain the data with bounds so wide");
    for (auto const& a : needed)
        if (std::ranges::find(c.assumptions, a) == c.assumptions.end())
            all.note(outcome::refuted, "'" + a + "' is not assumed");
    if (c.factor.lower() > 0 && below(whole, c.factor.lower()))
        all.note(proof.none_explains(times(base, c.factor.lower() - 1), 0.2),
                 "the lower end of the factor is not proved again");
    if (c.steps) {
        auto const again = part.channel ? coarse_steps(base, part, grown) : std::nullopt;
        bool const same = again && again->size == c.steps->size && again->unit == c.steps->unit &&
                          again->cut_off == c.steps->cut_off;
        all.note(same ? outcome::verified : outcome::undecided,
                 "the steps of its readings are others");
    }
    if (c.grows) all.note(outcome::undecided, "bounds that grow with the output: not proved again");
    return all.finding(what, "its factor, from both sides");
}

/// The problem with these effects; `why` says what is unknown about them otherwise.
[[nodiscard]] inline std::optional<identification_problem>
with_effects(identification_problem const& base, std::vector<effect> const& catalogue,
             std::vector<std::string> const& effects, std::vector<effect>& named,
             std::string& why) {
    try {
        named = effects_named(catalogue, effects, &base.model.about);
        return affected(base, named);
    } catch (std::invalid_argument const& e) {
        why = e.what();
        return std::nullopt;
    }
}

/// One check of a stored diagnosis.
class diagnosis_check_work {
    using outcome = check_finding::outcome;

public:
    diagnosis_check_work(identification_problem const& base, std::vector<effect> const& catalogue,
                         stored_diagnosis const& stored, diagnosis_check_options const& options)
        : base_(&base),
          catalogue_(&catalogue),
          stored_(&stored),
          d_(&stored.claims),
          held_out_(options.held_out),
          limit_(options.seconds, options.test.keep_going),
          test_(limited(options.test, limit_)),
          proof_(options.test, limit_) {}

    std::vector<check_finding> operator()(std::function<void(check_finding const&)> const& tell) {
        auto const add = [&](auto const& work) {
            stopwatch const clock;
            check_finding found = work();
            found.seconds = clock.spent();
            all_.push_back(std::move(found));
            if (tell) tell(all_.back());
        };
        add([&] { return problem(); });
        if (all_.back().found == outcome::refuted) return all_;
        add([&] { return agreement(); });
        add([&] { return assumptions(); });
        add([&] { return gap(); });
        add([&] { return relations(); });
        add([&] { return places(); });
        for (std::size_t k = 0; k < d_->causes.size(); ++k) add([&] { return cause_at(k); });
        add([&] { return hulls(); });
        add([&] { return check_parts(*base_, *d_, most(), proof_, limit_); });
        for (auto const& c : d_->confined)
            add([&] { return check_confined(*base_, c, whole_, proof_); });
        if (d_->remainder && !d_->remainder->disturbances.empty())
            add([&] { return disturbances(); });
        add([&] { return check_shrinks(*d_, answer()); });
        add([&] { return judged(); });
        all_.push_back(
            {"estimates", outcome::nothing,
             "fits, places that are not proved, laws, regimes, scores, what was tried, what cannot "
             "be observed, ends of priors, where a witness needs most, the next experiment, "
             "words"});
        if (tell) tell(all_.back());
        return all_;
    }

private:
    [[nodiscard]] static bool claims_upper(interval const& x) { return std::isfinite(x.upper()); }
    [[nodiscard]] static std::string name_of(std::vector<std::string> const& effects) {
        return effects.empty() ? "the model as it is" : joined(effects, " + ");
    }
    [[nodiscard]] static bool same_windows(std::vector<time_window> a, std::vector<time_window> b) {
        auto const key = [](time_window const& w) { return std::tuple{w.scenario, w.from, w.to}; };
        std::ranges::sort(a, {}, key);
        std::ranges::sort(b, {}, key);
        return std::ranges::equal(a, b, {}, key, key);
    }

    [[nodiscard]] check_finding problem() const {
        std::string const what = "problem";
        if (stored_->source.problem.empty())
            return {what, outcome::undecided, "the diagnosis does not say which"};
        if (stored_->source.problem != problem_digest(*base_))
            return {what, outcome::refuted, "another one was diagnosed"};
        if (d_->time_unit != base_->model.about.time_unit)
            return {what, outcome::refuted, "another unit of time"};
        return {what, outcome::verified, "the one that was diagnosed, by SHA-256"};
    }

    [[nodiscard]] check_finding agreement() const {
        auto const found = find_contradictions(*d_, [this](std::string const& name) {
            auto const at = std::ranges::find(*catalogue_, name, &effect::name);
            return at != catalogue_->end() &&
                   std::ranges::all_of(at->parameters, [](auto const& p) {
                       return contains(p.prior(), nearest(p.neutral));
                   });
        });
        std::string const what = "claims agree";
        if (!found.empty())
            return {what, outcome::refuted, found.front().claim + ": " + found.front().reason};
        finding_of_all all;
        all.note(outcome::verified, "");
        bool const answered = d_->answer == answer_kind::effects;
        auto const at = std::ranges::find(d_->causes, d_->effects, &cause::effects);
        if (answered && at == d_->causes.end())
            all.note(outcome::refuted, "the answer is none of the causes");
        if (d_->answer == answer_kind::none && d_->gap != gap_verdict::none)
            all.note(outcome::refuted, "no effect is said to be needed, but a gap may be there");
        if (!answered && !d_->effects.empty())
            all.note(outcome::refuted, "an answer without effects names some");
        for (auto const& c : d_->causes)
            if (!c.excluded_by.empty() && c.verdict != cause_verdict::excluded)
                all.note(outcome::refuted, "a relation excludes what is not excluded");
        same_change(all);
        if (d_->remainder) {
            auto const& rest = *d_->remainder;
            auto const of = std::ranges::find(d_->causes, rest.effects, &cause::effects);
            auto const* range = rest.effects.empty() ? &d_->inflation : nullptr;
            if (range == nullptr && of != d_->causes.end()) range = &of->inflation;
            if (range == nullptr || range->lower() != rest.inflation.lower() ||
                range->upper() != rest.inflation.upper())
                all.note(outcome::refuted, "the remainder is that of no cause");
            if (std::ranges::any_of(rest.where,
                                    [](auto const& p) { return p.proved || p.missing; }))
                all.note(outcome::refuted, "a place of the remainder is an estimate");
        }
        if (d_->constants_verified) {
            auto const* w = answered && at != d_->causes.end() ? &at->witness : &d_->witness;
            bool const same = *w && std::ranges::all_of(d_->constants, [&](auto const& c) {
                auto const p = std::ranges::find((*w)->parameters, c.name, &named_estimate::name);
                return p != (*w)->parameters.end() && p->value == c.value;
            });
            if (!same) all.note(outcome::refuted, "the constants are not those of a witness");
            bool const explains = answered && at != d_->causes.end()
                                      ? at->verdict == cause_verdict::explains
                                      : d_->gap == gap_verdict::none;
            if (!explains)
                all.note(outcome::refuted, "the constants explain the data, the answer does not");
        }
        return all.finding(what, "none contradicts another");
    }
    /// Whether what a simulator is told is what the answer changes.
    void same_change(finding_of_all& all) const {
        changed_formulas again;
        std::vector<effect> named;
        std::string why;
        if (d_->answer == answer_kind::effects) {
            if (!with_effects(*base_, *catalogue_, d_->effects, named, why))
                return all.note(outcome::undecided, "the answer cannot be built again: " + why);
            again = formulas_of(base_->model, named);
        }
        bool const same = d_->change.lines == again.lines && d_->change.symbols == again.symbols;
        all.note(same ? outcome::verified : outcome::refuted,
                 "the formulas are not those of the answer");
    }

    /// What disturbances of single equations are needed: bounded anew, with as much work.
    [[nodiscard]] check_finding disturbances() const {
        finding_of_all all;
        auto const& states = base_->model.about.states;
        auto const within = [](std::vector<time_window> const& mine,
                               std::vector<time_window> const& stated) {
            return std::ranges::all_of(mine, [&](time_window const& m) {
                return std::ranges::any_of(stated, [&](time_window const& w) {
                    return m.scenario == w.scenario && w.from <= m.from && m.to <= w.to;
                });
            });
        };
        for (auto const& n : d_->remainder->disturbances) {
            auto const of = std::ranges::find_if(
                states, [&](auto const& s) { return s.equation_name() == n.equation; });
            if (of == states.end()) {
                all.note(outcome::refuted, "no equation " + n.equation);
                continue;
            }
            for (auto const& w : n.strongest) {
                auto const e = std::ranges::find(base_->experiments, w.scenario, &experiment::name);
                if (e == base_->experiments.end() || !(e->begin <= w.from && w.from <= w.to))
                    all.note(outcome::refuted, "a window of no scenario: " + w.scenario);
            }
            try {
                auto const found =
                    disturbance_needed(*base_, static_cast<std::size_t>(of - states.begin()),
                                       std::min(n.seconds, limit_.left()), test_);
                bool const apart = found.size.lower() > n.size.upper() ||
                                   found.size.upper() < n.size.lower() || found.unit != n.unit;
                // Stretches are of disturbances up to the upper size; files round that.
                bool const as_far = n.size.upper() <= found.size.upper() * (1 + 1e-9);
                bool const same =
                    n.size.lower() <= found.size.lower() && found.size.upper() <= n.size.upper() &&
                    (n.reached.empty() || (as_far && within(found.reached, n.reached)));
                all.note(apart  ? outcome::refuted
                         : same ? outcome::verified
                                : outcome::undecided,
                         "the disturbance of " + n.equation + " is not bounded as closely again");
            } catch (std::invalid_argument const& e) {
                all.note(outcome::refuted, e.what());
            }
        }
        return all.finding("disturbances", "those of single equations, from both sides");
    }

    [[nodiscard]] check_finding assumptions() const {
        finding_of_all all;
        auto needed = *d_;
        needed.assumptions = {input_assumption(base_->experiments)};
        list_assumptions(needed);
        for (auto const& a : needed.assumptions) {
            bool const there = std::ranges::find(d_->assumptions, a) != d_->assumptions.end();
            all.note(there ? outcome::verified : outcome::refuted, "'" + a + "' is missing");
        }
        return all.finding("assumptions", "those of the problem and of every claim");
    }

    /// The upper end of an inflation, by its witness.
    /// @param assumptions  receives what the proof rests on
    [[nodiscard]] outcome upper_end(identification_problem const& p, interval const& stated,
                                    std::optional<named_witness> const& w,
                                    std::vector<std::string>& assumptions) const {
        if (!claims_upper(stated)) return outcome::nothing;
        return w ? proof_.at_most(p, *w, stated.upper(), &assumptions) : outcome::undecided;
    }
    /// Both ends of an inflation: the upper one as `upper_end` found it, the lower one by a search.
    void ends(identification_problem const& p, interval const& stated, outcome upper, double share,
              finding_of_all& all) const {
        all.note(upper, "the upper bound is not shown by its witness");
        if (stated.lower() > 0)
            all.note(proof_.at_least(p, stated.lower(), share),
                     "the lower bound is not proved within the budget, or not true");
    }

    [[nodiscard]] check_finding gap() {
        finding_of_all all;
        base_upper_ = upper_end(*base_, d_->inflation, d_->witness, base_assumptions_);
        ends(*base_, d_->inflation, base_upper_, 0.25, all);
        auto const words = std::string{to_string(d_->gap)};
        auto found = all.finding("gap", words + ", both bounds of its inflation");
        if (found.found == outcome::verified) whole_ = d_->inflation.lower();
        return found;
    }

    /// What the inflation of all data is proved to be at most.
    [[nodiscard]] double most() const {
        return base_upper_ == outcome::verified ? d_->inflation.upper() : detail::infinity;
    }

    /// Whether a witness is one of a poorer model: what is further sits where it has no effect.
    [[nodiscard]] static bool is_moved(identification_problem const& poorer, named_witness const& w,
                                       identification_problem const& p, named_witness const& own) {
        auto const how = embedded(poorer, p);
        auto const from = io_detail::point_of(poorer, w), at = io_detail::point_of(p, own);
        if (!how || !from || !at || from->starts != at->starts) return false;
        for (std::size_t j = 0; j < how->size(); ++j) {
            auto const& u = (*how)[j];
            if (at->parameters[j] != (u.same ? from->parameters[*u.same] : u.neutral)) return false;
        }
        return true;
    }
    /// Whether the upper end of a cause is that of the model as it is, or of another cause, by the
    /// same motion: a part of this problem, whose bounds hold for it, too (`embedded`). A run of
    /// this problem, written otherwise, would be rounded otherwise.
    /// @param assumptions  receives what the proof rests on: nothing that only this problem needs
    [[nodiscard]] bool carried(identification_problem const& p, cause const& c,
                               std::vector<std::string>& assumptions) const {
        if (!c.witness || !claims_upper(c.inflation)) return false;
        auto const follows = [&](identification_problem const& poorer, interval const& stated,
                                 std::optional<named_witness> const& w) {
            return w && stated.upper() <= c.inflation.upper() &&
                   is_moved(poorer, *w, p, *c.witness);
        };
        if (base_upper_ == outcome::verified && follows(*base_, d_->inflation, d_->witness)) {
            assumptions = base_assumptions_;
            return true;
        }
        for (auto const& other : d_->causes) {
            if (&other == &c || other.inflation.upper() != c.inflation.upper()) continue;
            std::vector<effect> named;
            std::string why;
            auto const q = with_effects(*base_, *catalogue_, other.effects, named, why);
            if (q && follows(*q, other.inflation, other.witness) &&
                proof_.at_most(*q, *other.witness, c.inflation.upper(), &assumptions) ==
                    outcome::verified)
                return true;
        }
        return false;
    }

    /// Relations are refuted anew, place by place of the same windows.
    [[nodiscard]] check_finding relations() {
        finding_of_all all;
        bool const any =
            !d_->relations.empty() || std::ranges::any_of(d_->where, &suspected_place::proved);
        if (any) {
            relation_options how;
            how.go_on = limit_;
            broken_ = find_broken_relations(*base_, how);
        }
        for (auto const& r : d_->relations) {
            if (!r.proved) continue;
            auto const* f = broken(r.equation);
            auto const again = f != nullptr ? reported(*f) : broken_relation_report{};
            bool const same =
                again.proved && again.sensors == r.sensors && again.assumptions == r.assumptions &&
                again.definition == r.definition && same_windows(again.windows, r.windows);
            all.note(same ? outcome::verified : outcome::undecided,
                     "relation " + r.equation + " is not proved again as stated");
        }
        return all.finding("relations", std::to_string(d_->relations.size()) + " refuted anew");
    }
    [[nodiscard]] relation_finding const* broken(std::string const& equation) const {
        auto const at = std::ranges::find(broken_, equation, &relation_finding::name);
        return at == broken_.end() ? nullptr : &*at;
    }

    [[nodiscard]] check_finding places() {
        finding_of_all all;
        std::optional<sensor_discharge> discharge;
        for (auto const& p : d_->where) {
            if (!p.proved) continue;
            suspected_place again;
            auto const* f = broken(p.name);
            if (f != nullptr && p.kind == "equation") {
                if (!discharge)
                    discharge.emplace(*base_, sensor_fault_ranges{}, relation_options{}, limit_);
                auto found = *f;
                found.place = (*discharge)(found);
                estimated_place where;
                where.kind = place_kind::equation;
                where.name = p.name;
                if (found.place && found.place->missing) where.unit = found.place->missing->unit;
                again = reported(where, {found});
            }
            bool const same = again.proved && again.assumptions == p.assumptions;
            bool const there =
                again.missing && again.unit == p.unit && same_windows({again.where}, {p.where});
            all.note(!same || (p.missing && !there) ? outcome::undecided
                     : p.missing                    ? compared(*again.missing, *p.missing)
                                                    : outcome::verified,
                     "place " + p.name + " is not proved again as stated");
        }
        return all.finding("places", "no sensor of theirs can be wrong instead");
    }

    [[nodiscard]] check_finding cause_at(std::size_t k) const {
        auto const& c = d_->causes[k];
        finding_of_all all;
        std::string why;
        std::vector<effect> named;
        auto const p = with_effects(*base_, *catalogue_, c.effects, named, why);
        bool const nothing = c.verdict == cause_verdict::undecided && !claims_upper(c.inflation) &&
                             !(c.inflation.lower() > 0) && c.untouched.empty();
        std::string const what = "cause " + name_of(c.effects);
        if (!p) return {what, outcome::undecided, "it cannot be built again: " + why};
        if (nothing) return {what, outcome::nothing, ""};
        auto const needed = wrap_assumptions(named);
        auto const assumed = [&c](std::string const& a) {
            return std::ranges::find(c.assumptions, a) != c.assumptions.end();
        };
        double const share = 1.0 / static_cast<double>(d_->causes.size() - k + 2);
        bool const by_relation = c.verdict == cause_verdict::excluded && !c.excluded_by.empty();
        std::vector<std::string> of_run;
        auto const upper = carried(*p, c, of_run) ? outcome::verified
                                                  : upper_end(*p, c.inflation, c.witness, of_run);
        ends(*p, c.inflation, upper, share, all);
        if (c.verdict == cause_verdict::explains && !c.witness)
            all.note(outcome::undecided, "it explains the data, but no witness is stated");
        for (auto const& equation : c.untouched) {
            auto const* f = broken(equation);
            bool const kept = f != nullptr && keeps_relation(base_->model, p->model, *f);
            all.note(kept           ? outcome::verified
                     : f == nullptr ? outcome::undecided
                                    : outcome::refuted,
                     "it changes the equation of " + equation);
        }
        if (by_relation) {
            auto const* f = broken(c.excluded_by);
            bool const kept = f != nullptr && keeps_relation(base_->model, p->model, *f);
            bool const stated = f != nullptr && std::ranges::all_of(f->assumptions, assumed);
            all.note(!kept && f != nullptr ? outcome::refuted
                     : stated              ? outcome::verified
                                           : outcome::undecided,
                     "the relation " + c.excluded_by + " does not exclude it as stated");
        } else {
            for (auto const& a : needed)
                if (!assumed(a)) all.note(outcome::refuted, "'" + a + "' is not assumed");
            for (auto const& a : of_run) // a bound that was carried over may do without
                if (!assumed(a)) all.note(outcome::undecided, "'" + a + "' is not assumed");
        }
        return all.finding(what, std::string{to_string(c.verdict)} +
                                     (by_relation ? " by " + c.excluded_by : ""));
    }

    [[nodiscard]] cause const* answer() const {
        if (d_->answer != answer_kind::effects) return nullptr;
        auto const at = std::ranges::find(d_->causes, d_->effects, &cause::effects);
        return at == d_->causes.end() ? nullptr : &*at;
    }

    /// The run behind a diagnosis as far as its witnesses tell: the model as it is, and the answer.
    [[nodiscard]] std::optional<diagnosis_run> rebuilt(cause const& c) const {
        diagnosis_run run;
        std::string why;
        auto const p = with_effects(*base_, *catalogue_, c.effects, run.catalogue, why);
        auto const own = p && c.witness ? point_of(*p, *c.witness) : std::nullopt;
        if (!own) return std::nullopt;
        auto const base = d_->witness ? point_of(*base_, *d_->witness) : std::nullopt;
        candidate answered;
        for (std::size_t k = 0; k < run.catalogue.size(); ++k) answered.effects.push_back(k);
        run.base = *base_;
        run.candidates = {{{}, *base_, base.value_or(approximate_fit{})}, {answered, *p, *own}};
        run.answer = 1;
        run.result.causes = {c};
        return run;
    }

    /// Hulls of the answer, its combinations and times: by the step that found them, or what lies
    /// outside is excluded anew.
    [[nodiscard]] check_finding hulls() {
        finding_of_all all;
        auto const stated = [](std::vector<named_estimate> const& list) {
            return std::ranges::any_of(list, [](auto const& e) { return e.hull.has_value(); });
        };
        auto const claims = [&](cause const& c) {
            return stated(c.parameters) || !c.onsets.empty() || !c.ends.empty();
        };
        auto const* const c = answer();
        for (auto const& other : d_->causes)
            if (&other != c && claims(other))
                all.note(outcome::undecided, "hulls of a cause that is not the answer");
        bool const some =
            (c != nullptr && claims(*c)) || stated(d_->constants) || !d_->combinations.empty();
        if (some && c != nullptr) answered_ = rebuilt(*c);
        if (some && !answered_)
            all.note(outcome::undecided, "hulls of no answer, or of another one");
        if (!answered_) return all.finding("hulls", "");
        auto& again = answered_->result.causes.front();
        again.onsets.clear();
        again.ends.clear();
        diagnosis_options how;
        how.hulls = {40000, 1};
        diagnosis_effort effort(0.4 * limit_.seconds(), test_, {});
        answer_hulls(*answered_, effort, how)();
        for (auto const* const list : {&c->parameters, &d_->constants})
            for (auto const& e : *list)
                if (e.hull) side(e, all);
        combinations(all);
        for (auto const& [said, found] :
             {std::pair{&c->onsets, &again.onsets}, std::pair{&c->ends, &again.ends}})
            for (auto const& t : *said) {
                auto const at = std::ranges::find(*found, t.name, &named_estimate::name);
                bool const there = at != found->end() && t.hull && at->hull &&
                                   within_stated(*at->hull, *t.hull) && at->value == t.value &&
                                   is_stated(t.prior, at->prior);
                all.note(there ? outcome::verified : outcome::undecided,
                         "when it acts in " + t.name + " is not proved again");
            }
        return all.finding("hulls", "all that lies outside is excluded anew");
    }
    /// Whether a prior is stated as it is: a wider one would be said to be excluded.
    [[nodiscard]] static bool is_stated(std::optional<interval> const& said,
                                        std::optional<interval> const& is) {
        return !said || (is && within_stated(*said, *is));
    }
    /// A hull is no more than an enclosure: only a proof that some lie outside refutes it.
    void side(named_estimate const& e, finding_of_all& all) const {
        auto const& p = answered_->candidates[1].problem;
        auto const& found = answered_->answer_hull.parameters;
        auto const j = std::ranges::find(p.choice.unknown, e.name) - p.choice.unknown.begin();
        auto const at = static_cast<std::size_t>(j);
        if (at >= p.choice.unknown.size())
            return all.note(outcome::refuted, "a hull of no parameter: " + e.name);
        if (!is_stated(e.prior, p.prior[at]))
            return all.note(outcome::refuted, "the prior of " + e.name + " is another one");
        bool const within = at < found.size() && within_stated(found[at], *e.hull);
        all.note(within ? outcome::verified : outside(p, at, *e.hull),
                 "values of " + e.name + " beyond its hull are not excluded");
    }
    void combinations(finding_of_all& all) const {
        if (d_->combinations.empty()) return;
        auto const again = told_combinations(answered_->candidates[1].problem, d_->constants,
                                             answered_->answer_hull);
        for (auto const& k : d_->combinations) {
            auto const at =
                std::ranges::find(again, k.about.name, [](auto const& t) { return t.about.name; });
            bool const found = at != again.end() && k.about.hull && at->about.hull &&
                               at->about.unit == k.about.unit && at->is_sum == k.is_sum &&
                               std::ranges::equal(at->parts, k.parts) &&
                               at->about.value == k.about.value &&
                               is_stated(k.about.prior, at->about.prior) &&
                               within_stated(*at->about.hull, *k.about.hull);
            all.note(found ? outcome::verified : outcome::undecided,
                     "the range of " + k.about.name + " is not proved again");
        }
    }
    /// Whether nothing beyond a range of parameter j explains the data.
    [[nodiscard]] outcome outside(identification_problem const& p, std::size_t j,
                                  interval const& range) const {
        auto result = outcome::verified;
        auto const& whole = p.prior[j];
        for (auto const& beyond :
             {std::pair{whole.lower(), std::min(range.lower(), whole.upper())},
              std::pair{std::max(range.upper(), whole.lower()), whole.upper()}}) {
            if (!(beyond.first < beyond.second)) continue;
            auto slab = p;
            slab.prior[j] = interval_traits<interval>::bounds(beyond.first, beyond.second);
            auto const says = proof_.none_explains(slab, 0.1);
            if (says == outcome::refuted) return says;
            if (says == outcome::undecided) result = says;
        }
        return result;
    }

    /// The answer by the held-out data, judged once more.
    [[nodiscard]] check_finding judged() {
        std::string const what = "held-out data";
        bool const stated =
            std::ranges::any_of(d_->causes, [](cause const& c) { return c.holdout.has_value(); });
        if (!stated) return {what, outcome::nothing, ""};
        auto const* const c = answer();
        if (c == nullptr || !c->holdout || c != &d_->causes.front())
            return {what, outcome::undecided, "of a cause that is not the answer"};
        if (held_out_ == nullptr || held_out_->empty())
            return {what, outcome::refuted, "the data set has none"};
        if (!answered_) answered_ = rebuilt(*c);
        if (!answered_ || answered_->candidates[0].fit.parameters.empty())
            return {what, outcome::undecided, "no witness"};
        auto& run = *answered_;
        auto const &base = run.candidates[0].fit, &own = run.candidates[1].fit;
        run.base_bound = {
            d_->inflation, verified_witness{base.parameters, base.starts, {}}, {}, {}};
        // Which hold those that do as well; all, where the search found one that does better.
        auto const about = proof_.search(*base_, &base, 0.2 * limit_.seconds());
        run.base_bound.hull =
            below(about.value.upper(), d_->inflation.upper()) ? base_->prior : about.hull;
        run.answer_bound = {c->inflation, verified_witness{own.parameters, own.starts, {}}, {}, {}};
        run.result.causes = {*c};
        run.result.causes.front().holdout.reset();
        judge_by_holdout(run, *held_out_, limit_.seconds(), proof_.test(), 4000);
        auto const& again = run.result.causes.front().holdout;
        if (!again) return {what, outcome::undecided, "not judged again"};
        finding_of_all all;
        for (auto const& a : run.result.assumptions)
            if (std::ranges::find(d_->assumptions, a) == d_->assumptions.end())
                all.note(outcome::refuted, "'" + a + "' is missing");
        auto const same = [&](inflation_range const& found, inflation_range const& said,
                              char const* which) {
            all.note(compared(found, said), std::string{"the inflation "} + which);
        };
        same(again->inflation_before, c->holdout->inflation_before, "before, at the witness");
        same(again->inflation_after, c->holdout->inflation_after, "after, at the witness");
        auto const over = [&](auto const& found, auto const& said, char const* which) {
            if (said) same(found.value_or(unknown_inflation()), *said, which);
        };
        over(again->over_fits_before, c->holdout->over_fits_before, "before, over all fits");
        over(again->over_fits_after, c->holdout->over_fits_after, "after, over all fits");
        return all.finding(what, "inflations, judged once more");
    }

    identification_problem const* base_;
    std::vector<effect> const* catalogue_;
    stored_diagnosis const* stored_;
    diagnosis const* d_;
    holdout const* held_out_;
    work_limit limit_;
    feasibility_test_options test_;
    inflation_proof proof_;
    std::optional<diagnosis_run> answered_; ///< behind the answer, with its hulls as found anew
    outcome base_upper_ = outcome::nothing; ///< of the upper end of the gap's inflation
    std::vector<std::string> base_assumptions_{}; ///< on which it rests
    double whole_ = 0; ///< the inflation of all data is proved to be this at least
    std::vector<relation_finding> broken_;
    std::vector<check_finding> all_;
};

} // namespace io_detail

SIVID_DECL std::vector<check_finding>
check_diagnosis(identification_problem const& base, std::vector<effect> const& catalogue,
                stored_diagnosis const& stored, diagnosis_check_options const& options,
                std::function<void(check_finding const&)> const& tell) {
    return io_detail::diagnosis_check_work(base, catalogue, stored, options)(tell);
}

} // namespace sivid

#endif
