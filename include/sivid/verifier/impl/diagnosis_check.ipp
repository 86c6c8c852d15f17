// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_IMPL_DIAGNOSIS_CHECK_IPP
#define SIVID_VERIFIER_IMPL_DIAGNOSIS_CHECK_IPP

#include <sivid/verifier/diagnosis_check.hpp>

#include <sivid/diagnosis/claim/detail/diagnosis_consistency.hpp>
#include <sivid/diagnosis/claim/detail/embedded_problem.hpp>
#include <sivid/diagnosis/claim/detail/place_report.hpp>
#include <sivid/diagnosis/diagnosis_run.hpp>
#include <sivid/diagnosis/sensor/detail/sensor_discharge.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/paving/relation/detail/broken_relation.hpp>
#include <sivid/paving/relation/detail/untouched_relation.hpp>
#include <sivid/verifier/claim/detail/data_parts_check.hpp>
#include <sivid/verifier/claim/detail/effect_hulls_check.hpp>
#include <sivid/verifier/claim/detail/finding_of_all.hpp>
#include <sivid/verifier/claim/detail/inflation_proof.hpp>
#include <sivid/verifier/claim/detail/shrink_check.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace sivid {

namespace io_detail {

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
          proof_(options.test, limit_),
          hulls_(base, catalogue, *d_, proof_, limit_) {}

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
        add([&] { return hulls_(answer()); });
        add([&] { return check_parts(*base_, *d_, most(), proof_, limit_); });
        for (auto const& c : d_->confined)
            add([&] { return check_confined(*base_, c, whole_, proof_); });
        add([&] { return check_shrinks(*d_, answer()); });
        add([&] { return judged(); });
        all_.push_back(
            {"estimates", outcome::nothing,
             "fits, places that are not proved, laws, scores, what cannot be observed, words"});
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
        if (!d_->time_unit.empty() && d_->time_unit != base_->model.about.time_unit)
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
        if (d_->remainder) {
            auto const& rest = *d_->remainder;
            auto const of = std::ranges::find(d_->causes, rest.effects, &cause::effects);
            auto const* range = rest.effects.empty() ? &d_->inflation : nullptr;
            if (range == nullptr && of != d_->causes.end()) range = &of->inflation;
            if (range == nullptr || range->lower() != rest.inflation.lower() ||
                range->upper() != rest.inflation.upper())
                all.note(outcome::refuted, "the remainder is that of no cause");
        }
        if (d_->constants_verified) {
            auto const* w = answered && at != d_->causes.end() ? &at->witness : &d_->witness;
            bool const same = *w && std::ranges::all_of(d_->constants, [&](auto const& c) {
                auto const p = std::ranges::find((*w)->parameters, c.name, &named_estimate::name);
                return p != (*w)->parameters.end() && p->value == c.value;
            });
            if (!same) all.note(outcome::refuted, "the constants are not those of a witness");
            if (answered && at != d_->causes.end() && at->verdict != cause_verdict::explains)
                all.note(outcome::refuted, "the constants explain the data, the answer does not");
        }
        return all.finding(what, "none contradicts another");
    }

    [[nodiscard]] check_finding assumptions() const {
        finding_of_all all;
        auto const need = [&](std::vector<std::string> const& more) {
            for (auto const& a : more) {
                bool const there = std::ranges::find(d_->assumptions, a) != d_->assumptions.end();
                all.note(there ? outcome::verified : outcome::refuted, "'" + a + "' is missing");
            }
        };
        need({input_assumption(base_->experiments)});
        for (auto const& r : d_->relations)
            if (r.proved) need(r.assumptions);
        for (auto const& p : d_->where)
            if (p.proved) need(p.assumptions);
        for (auto const& c : d_->causes)
            if (c.verdict != cause_verdict::undecided || c.witness) need(c.assumptions);
        for (auto const& c : d_->confined) need(c.assumptions);
        return all.finding("assumptions", "those of the problem and of every claim");
    }

    /// The upper end of an inflation, by its witness.
    /// @param assumptions  receives what the proof rests on
    [[nodiscard]] outcome upper_end(identification_problem const& p, interval const& stated,
                                    std::optional<named_witness> const& w, double share,
                                    std::vector<std::string>& assumptions) const {
        if (!claims_upper(stated)) return outcome::nothing;
        return w ? proof_.at_most(p, *w, stated.upper(), &assumptions)
                 : proof_.found_at_most(p, stated.upper(), share);
    }
    /// Both ends of an inflation: the upper one as `upper_end` found it, the lower one by a search.
    void ends(identification_problem const& p, interval const& stated, outcome upper, bool witness,
              double share, finding_of_all& all) const {
        all.note(upper, witness ? "the witness does not show the upper bound"
                                : "no witness is stated, and none found that shows the upper "
                                  "bound");
        if (stated.lower() > 0)
            all.note(proof_.at_least(p, stated.lower(), share),
                     "the lower bound is not proved within the budget, or not true");
    }

    [[nodiscard]] check_finding gap() {
        finding_of_all all;
        base_upper_ = upper_end(*base_, d_->inflation, d_->witness, 0.25, base_assumptions_);
        ends(*base_, d_->inflation, base_upper_, d_->witness.has_value(), 0.25, all);
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
        auto const from = point_of(poorer, w), at = point_of(p, own);
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
            auto const words = "relation " + r.equation + " is not proved again as stated";
            if (!r.proved) continue;
            auto const* f = broken(r.equation);
            if (f == nullptr) {
                all.note(outcome::undecided, words);
                continue;
            }
            auto const again = reported(*f);
            bool const same = again.sensors == r.sensors && again.assumptions == r.assumptions &&
                              again.definition == r.definition &&
                              same_windows(again.windows, r.windows);
            all.note(same ? outcome::verified : outcome::undecided, words);
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
            auto const words = "place " + p.name + " is not proved again as stated";
            auto const* f = broken(p.name);
            if (f == nullptr || p.kind != "equation") {
                all.note(outcome::undecided, words);
                continue;
            }
            if (!discharge)
                discharge.emplace(*base_, sensor_fault_ranges{}, relation_options{}, limit_);
            auto const place = (*discharge)(*f);
            if (!place || place->assumptions != p.assumptions) {
                all.note(outcome::undecided, words);
            } else if (!p.missing) {
                all.note(outcome::verified, "");
            } else if (!place->missing) {
                all.note(outcome::undecided, words);
            } else {
                auto const& m = *place->missing;
                auto const close = [](double a, double b) { return std::abs(a - b) <= 1e-9; };
                bool const there = m.window.scenario == p.where.scenario &&
                                   close(m.window.from, p.where.from) &&
                                   close(m.window.to, p.where.to) && m.unit == p.unit;
                all.note(there ? compared(m.value, *p.missing) : outcome::undecided, words);
            }
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
        auto const upper = carried(*p, c, of_run)
                               ? outcome::verified
                               : upper_end(*p, c.inflation, c.witness, share, of_run);
        ends(*p, c.inflation, upper, c.witness.has_value(), share, all);
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

    /// The answer by the held-out data, judged once more.
    [[nodiscard]] check_finding judged() const {
        std::string const what = "held-out data";
        bool const stated =
            std::ranges::any_of(d_->causes, [](cause const& c) { return c.holdout.has_value(); });
        if (!stated) return {what, outcome::nothing, ""};
        auto const* const c = answer();
        if (c == nullptr || !c->holdout || c != &d_->causes.front())
            return {what, outcome::undecided, "of a cause that is not the answer"};
        if (held_out_ == nullptr || held_out_->empty())
            return {what, outcome::refuted, "the data set has none"};
        diagnosis_run run;
        std::string why;
        auto const p = with_effects(*base_, *catalogue_, c->effects, run.catalogue, why);
        if (!p || !c->witness || !d_->witness) return {what, outcome::undecided, "no witness"};
        auto const base = point_of(*base_, *d_->witness), own = point_of(*p, *c->witness);
        if (!base || !own) return {what, outcome::undecided, "no witness"};
        run.base = *base_;
        candidate answered;
        for (std::size_t k = 0; k < run.catalogue.size(); ++k) answered.effects.push_back(k);
        run.candidates = {{{}, *base_, *base}, {answered, *p, *own}};
        run.answer = 1;
        run.base_bound = {
            d_->inflation, verified_witness{base->parameters, base->starts, {}}, {}, {}};
        // Which hold those that do as well; all, where the search found one that does better.
        auto const about = proof_.search(*base_, &*base, 0.2 * limit_.seconds());
        run.base_bound.hull =
            below(about.value.upper(), d_->inflation.upper()) ? base_->prior : about.hull;
        run.answer_bound = {
            c->inflation, verified_witness{own->parameters, own->starts, {}}, {}, {}};
        run.answer_hull = hulls_.found();
        run.result.causes = {*c};
        run.result.causes.front().holdout.reset();
        judge_by_holdout(run, *held_out_, limit_.seconds(), proof_.test(), 4000);
        auto const& again = run.result.causes.front().holdout;
        if (!again) return {what, outcome::undecided, "not judged again"};
        finding_of_all all;
        auto const same = [&](interval const& found, interval const& said, char const* which) {
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
    inflation_proof proof_;
    effect_hulls_check hulls_;
    outcome base_upper_ = outcome::nothing;       ///< of the upper end of the gap's inflation
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
