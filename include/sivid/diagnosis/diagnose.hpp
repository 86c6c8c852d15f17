// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_DIAGNOSE_HPP
#define SIVID_DIAGNOSIS_DIAGNOSE_HPP

#include <sivid/diagnosis/broken_relation.hpp>
#include <sivid/diagnosis/candidate.hpp>
#include <sivid/diagnosis/diagnosis_run.hpp>
#include <sivid/diagnosis/hardest_experiments.hpp>
#include <sivid/diagnosis/manoeuvre.hpp>
#include <sivid/diagnosis/place_estimate.hpp>
#include <sivid/diagnosis/screening.hpp>
#include <sivid/diagnosis/verification.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Diagnoses one campaign step by step.
class diagnostician {
public:
    diagnostician(identification_problem base, std::vector<effect> catalogue,
                  diagnosis_options options)
        : options_(std::move(options)) {
        run_.base = std::move(base);
        run_.catalogue = std::move(catalogue);
        run_.base.require_valid();
        options_.screening.progress = [this](std::string const& what) {
            return go_on("trying " + what);
        };
        options_.screening.seconds = std::min(options_.screening.seconds, options_.seconds);
    }

    [[nodiscard]] diagnosis_run operator()() {
        auto& d = run_.result;
        d.assumptions.push_back("inputs exact");
        screening tried(run_.base, run_.catalogue, options_.screening);
        measure_gap(tried);
        if (d.gap != gap_verdict::none && !stopped_) {
            find_relations();
            find_places();
            announce();
            tried.run();
            run_.candidates = tried.candidates();
            decide(tried);
            verify_candidates();
            describe_remainder();
            propose();
        } else {
            run_.candidates = tried.candidates();
        }
        d.interrupted = stopped_;
        d.seconds = seconds();
        return std::move(run_);
    }

private:
    using clock = std::chrono::steady_clock;

    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(clock::now() - begin_).count();
    }
    [[nodiscard]] double left() const { return std::max(0.0, options_.seconds - seconds()); }
    bool go_on(std::string const& what) {
        if (seconds() > options_.seconds || (options_.progress && !options_.progress(what))) {
            stopped_ = true;
        }
        return !stopped_;
    }

    /// Whether some parameter explains the data, and by how much the bounds are missed.
    void measure_gap(screening& tried) {
        auto& d = run_.result;
        tried.try_one({});
        if (tried.candidates().empty()) return;
        auto const& base = tried.candidates().front();
        auto& bound = run_.base_bound;
        bound = verify_at(base.problem, base.fit);
        if (!diagnosis_detail::has_delays(base.problem.model)) {
            inflation_options search;
            search.test = options_.test;
            search.seconds =
                std::min(left(), bound.range.upper() <= 1 ? 0.3 : options_.gap_seconds);
            search.relative_width = 0.03;
            double const fewer = refuted_by_few(base, bound.range.upper(), 0.6 * search.seconds);
            search.seconds = std::min(search.seconds, left());
            auto const proved = bound_inflation(base.problem, &base.fit, search);
            // Both contain the inflation, or bound it from above.
            double const upper = std::min(proved.value.upper(), bound.range.upper());
            if (proved.value.upper() <= bound.range.upper()) bound.witness = proved.witness;
            bound.hull = proved.hull;
            bound.range = interval_traits<interval>::bounds(
                std::min(std::max(proved.value.lower(), fewer), upper), upper);
        } else {
            bound.range = interval_traits<interval>::bounds(0, bound.range.upper());
        }
        d.inflation = bound.range;
        d.gap = d.inflation.upper() <= 1  ? gap_verdict::none
                : d.inflation.lower() > 1 ? gap_verdict::certified
                                          : gap_verdict::undecided;
    }

    /// A lower bound of the inflation from the experiments that are missed by most; 0 when there
    /// are no more than these.
    [[nodiscard]] double refuted_by_few(screened const& s, double upper, double seconds,
                                        bool only_verdict = false) const {
        if (s.problem.experiments.size() <= options_.hardest || upper <= 1) return 0;
        inflation_options search;
        search.test = options_.test;
        search.seconds = std::min(left(), seconds);
        search.only_verdict = only_verdict;
        search.relative_width = 0.1;
        auto const few = hardest_experiments(s.problem, s.fit, options_.hardest);
        return bound_inflation(few, nullptr, search).value.lower();
    }

    void find_relations() {
        if (!go_on("proving which equations cannot hold")) return;
        run_.findings = find_broken_relations(run_.base);
        for (auto const& f : run_.findings) {
            broken_relation_report r{f.name, f.channels, f.proved, f.assumptions, {}};
            for (auto const& w : f.windows) r.windows.push_back({w.scenario, w.from, w.to});
            run_.result.relations.push_back(std::move(r));
        }
    }

    void find_places() {
        if (!go_on("looking where the model departs from the data")) return;
        run_.places = estimate_places(run_.base);
        for (auto const& p : run_.places.places) {
            run_.result.where.push_back(suspected(p));
            prove(run_.result.where.back());
        }
        if (run_.result.where.empty()) return;
        for (auto const& set : run_.places.alternatives) {
            std::string text;
            for (auto const& name : set) text += (text.empty() ? "" : " and ") + name;
            run_.result.where.front().alternatives.push_back(text);
        }
    }
    [[nodiscard]] static suspected_place suspected(estimated_place const& p) {
        suspected_place s;
        s.kind = p.kind == place_kind::sensor  ? "sensor"
                 : p.kind == place_kind::input ? "input"
                                               : "equation";
        s.name = p.name;
        s.where = {p.scenario, p.from, p.to};
        s.estimate = p.missing;
        s.unit = p.unit;
        s.law = p.law;
        s.regime = p.regime;
        return s;
    }
    /// A place whose relation is proved broken gets the proof's window and missing rate.
    void prove(suspected_place& s) const {
        for (auto const& f : run_.findings) {
            bool const concerns = s.kind == "equation" && f.name == s.name;
            if (!concerns) continue;
            s.proved = f.proved;
            if (!f.missing) return;
            s.missing = f.missing->value;
            s.where = {f.missing->window.scenario, f.missing->window.from, f.missing->window.to};
        }
    }
    /// The first sentence, early: whether there is a gap, and where.
    void announce() {
        if (!options_.first_sentence) return;
        auto const& d = run_.result;
        std::string text = d.gap == gap_verdict::certified
                               ? "a gap is proved"
                               : "no parameter was found that explains the data";
        for (std::size_t k = 0; k < d.where.size(); ++k) {
            text += (k == 0 ? ": " : ", ") + d.where[k].kind + " " + d.where[k].name;
        }
        options_.first_sentence(text);
    }

    [[nodiscard]] std::vector<std::string> names_of(candidate const& c) const {
        std::vector<std::string> names;
        for (auto const e : c.effects) names.push_back(run_.catalogue[e].name);
        return names;
    }

    void decide(screening const& tried) {
        auto& d = run_.result;
        auto const figures = tried.figures();
        auto const chosen = choose(figures, tried.measurements(), options_.choice);
        if (!chosen.explained) {
            d.answer = answer_kind::unexplained;
            run_.answer = closest_candidate(figures);
        } else {
            run_.answer = chosen.best;
            d.effects = names_of(figures[chosen.best]);
            d.answer = d.effects.empty() ? answer_kind::none : answer_kind::effects;
            for (auto const o : chosen.others) {
                d.indistinguishable.push_back(names_of(figures[o]));
                others_.push_back(o);
            }
        }
        for (std::size_t i = 1; i < run_.candidates.size(); ++i) order_.push_back(i);
        std::stable_sort(order_.begin(), order_.end(),
                         [&](std::size_t a, std::size_t b) { return place_of(a) < place_of(b); });
        for (auto const i : order_) d.causes.push_back(cause_of(run_.candidates[i]));
    }
    /// The answer, then what cannot be told from it, then explaining ones, then by inflation.
    [[nodiscard]] double place_of(std::size_t i) const {
        if (i == run_.answer) return -3;
        for (std::size_t k = 0; k < others_.size(); ++k) {
            if (others_[k] == i) return -2 + 0.1 * static_cast<double>(k);
        }
        return run_.candidates[i].figures.inflation;
    }
    [[nodiscard]] cause cause_of(screened const& s) const {
        cause c;
        c.effects = names_of(s.figures);
        c.fitted_inflation = s.figures.inflation;
        c.score = s.figures.score(measurements());
        auto const& about = s.problem.model.about;
        for (std::size_t j = run_.base.prior.size(); j < s.fit.parameters.size(); ++j) {
            auto const& name = s.problem.choice.unknown[j];
            c.parameters.push_back(
                {name, about.constants[index_of(about.constants, name, "constant")].unit,
                 s.fit.parameters[j], std::nullopt});
        }
        return c;
    }
    [[nodiscard]] std::size_t measurements() const {
        std::size_t n = 0;
        for (auto const& e : run_.base.experiments) n += e.measurements.size();
        return n;
    }
    [[nodiscard]] named_witness named(screened const& s, verified_witness const& w) const {
        named_witness result;
        auto const& about = s.problem.model.about;
        for (std::size_t j = 0; j < w.parameters.size(); ++j) {
            auto const& name = s.problem.choice.unknown[j];
            result.parameters.push_back(
                {name, about.constants[index_of(about.constants, name, "constant")].unit,
                 w.parameters[j], std::nullopt});
        }
        for (std::size_t e = 0; e < w.starts.size(); ++e) {
            named_witness::start start{s.problem.experiments[e].name, {}};
            for (std::size_t i = 0; i < w.starts[e].size(); ++i) {
                start.states.push_back(
                    {about.states[i].name, about.states[i].unit, w.starts[e][i], std::nullopt});
            }
            result.starts.push_back(std::move(start));
        }
        return result;
    }

    /// Witnesses for what explains, proofs of emptiness for what does not.
    void verify_candidates() {
        auto& d = run_.result;
        double const begin = seconds();
        for (std::size_t k = 0; k < order_.size(); ++k) {
            auto const& s = run_.candidates[order_[k]];
            auto& c = d.causes[k];
            bool const of_interest = s.figures.explains() || order_[k] == run_.answer;
            if (of_interest) {
                if (!go_on("verifying a witness")) return;
                auto proved = verify_at(s.problem, s.fit);
                c.inflation = interval_traits<interval>::bounds(0, proved.range.upper());
                c.assumptions = proved.assumptions;
                if (proved.range.upper() <= 1) c.verdict = cause_verdict::explains;
                if (proved.witness) c.witness = named(s, *proved.witness);
                if (order_[k] == run_.answer) {
                    run_.answer_bound = std::move(proved);
                    sharpen_answer(s, c);
                }
            }
        }
        std::vector<std::size_t> open(order_.size());
        for (std::size_t k = 0; k < open.size(); ++k) open[k] = k;
        std::stable_sort(open.begin(), open.end(), [&](std::size_t a, std::size_t b) {
            return d.causes[a].effects.size() < d.causes[b].effects.size();
        });
        for (auto const k : open) {
            auto const& s = run_.candidates[order_[k]];
            auto& c = d.causes[k];
            if (c.verdict == cause_verdict::explains) continue;
            if (diagnosis_detail::has_delays(s.problem.model)) continue;
            double const spent = seconds() - begin;
            if (spent > options_.verify_seconds) return;
            if (!go_on("excluding " + c.effects.front())) return;
            inflation_options search;
            search.test = options_.test;
            search.only_verdict = true;
            search.seconds =
                std::min({left(), options_.verify_seconds - spent, options_.each_seconds});
            double const fewer = refuted_by_few(s, s.fit.inflation, search.seconds, true);
            if (fewer > 1) {
                c.inflation = interval_traits<interval>::bounds(fewer, detail::infinity);
            } else {
                c.inflation = bound_inflation(s.problem, &s.fit, search).value;
            }
            if (c.inflation.lower() > 1) c.verdict = cause_verdict::excluded;
        }
    }

    /// The least inflation of the answer from below, and the box that its best parameters lie in.
    void sharpen_answer(screened const& s, cause& c) {
        auto& d = run_.result;
        auto& bound = run_.answer_bound;
        if (!diagnosis_detail::has_delays(s.problem.model)) {
            inflation_options search;
            search.test = options_.test;
            search.seconds = std::min(left(), options_.gap_seconds);
            auto const proved = bound_inflation(s.problem, &s.fit, search);
            double const upper = std::min(proved.value.upper(), bound.range.upper());
            bound.range =
                interval_traits<interval>::bounds(std::min(proved.value.lower(), upper), upper);
            bound.hull = proved.hull;
        } else {
            bound.range = interval_traits<interval>::bounds(0, bound.range.upper());
        }
        c.inflation = bound.range;
        d.shrink_fit = shrink(d.inflation, bound.range);
    }

    /// How much is left with the closest candidate, and where: the lead to what no effect has.
    void describe_remainder() {
        auto& d = run_.result;
        if (d.answer != answer_kind::unexplained || d.causes.empty()) return;
        auto const& nearest = run_.candidates[run_.answer];
        unexplained_remainder rest{names_of(nearest.figures), run_.answer_bound.range, {}};
        if (run_.answer == 0) {
            rest.inflation = d.inflation;
            rest.where = d.where;
        } else if (go_on("looking for what is left")) {
            run_.remaining_places = estimate_places(nearest.problem);
            for (auto const& p : run_.remaining_places.places) rest.where.push_back(suspected(p));
        }
        d.remainder = std::move(rest);
    }

    void propose() {
        auto& d = run_.result;
        if (others_.empty() || !go_on("looking for a manoeuvre that tells candidates apart")) {
            return;
        }
        std::vector<screened const*> rivals{&run_.candidates[run_.answer]};
        for (auto const o : others_) rivals.push_back(&run_.candidates[o]);
        std::vector<double> errors(run_.base.model.about.channels.size(), 0.0);
        double period = 0.1;
        for (auto const& e : run_.base.experiments) {
            for (auto const& m : e.measurements) errors[m.channel] = rad(m.bound);
            if (!e.measurements.empty()) period = e.measurements.front().time - e.begin;
        }
        d.next = propose_experiment(std::move(rivals), options_.menu, std::move(errors),
                                    period > 0 ? period : 0.1);
    }

    diagnosis_options options_;
    diagnosis_run run_;
    std::vector<std::size_t> order_;  ///< of the causes: indices of candidates
    std::vector<std::size_t> others_; ///< that the data cannot tell from the answer
    bool stopped_ = false;
    clock::time_point begin_ = clock::now();
};

/// Says whether a model explains a campaign; if not, by how much it misses, and which effects of a
/// catalogue explain what is missing.
/// @guarantee  see `diagnosis`
[[nodiscard]] inline diagnosis_run diagnose(identification_problem problem,
                                            std::vector<effect> catalogue,
                                            diagnosis_options options = {}) {
    return diagnostician(std::move(problem), std::move(catalogue), std::move(options))();
}

} // namespace sivid

#endif
