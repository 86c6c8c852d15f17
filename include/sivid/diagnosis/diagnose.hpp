// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_DIAGNOSE_HPP
#define SIVID_DIAGNOSIS_DIAGNOSE_HPP

#include <sivid/diagnosis/describe_candidate.hpp>
#include <sivid/diagnosis/diagnosis_run.hpp>
#include <sivid/diagnosis/hardest_experiments.hpp>
#include <sivid/diagnosis/part_inflation.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/observer_refutation.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
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
        options_.screening.seconds = std::min(options_.screening.seconds, 0.7 * options_.seconds);
    }

    [[nodiscard]] diagnosis_run operator()() {
        auto& d = run_.result;
        d.assumptions.push_back(input_assumption(run_.base.experiments));
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
            measure_parts();
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

    [[nodiscard]] inflation_options effort(double seconds) const {
        inflation_options search;
        search.test = options_.test;
        search.seconds = std::min(left(), seconds);
        return search;
    }
    /// A validated run at the fit: nothing is known from below.
    [[nodiscard]] verified_inflation at_point(screened const& s) const {
        auto result = verify_at(s.problem, s.fit, options_.test);
        result.range = interval_traits<interval>::bounds(0, result.range.upper());
        return result;
    }
    /// Adds what a search proves to what is known.
    void tighten(verified_inflation& known, screened const& s,
                 inflation_options const& search) const {
        auto proved = bound_inflation(s.problem, &s.fit, search);
        double upper = proved.value.upper();
        if (proved.witness && starts_follow_parameters(s.problem)) {
            // The search lets added states start anywhere in their ranges.
            approximate_fit at;
            at.parameters = proved.witness->parameters;
            at.starts = proved.witness->starts;
            auto verified = verify_at(s.problem, at, options_.test);
            upper = verified.range.upper();
            proved.witness = std::move(verified.witness);
        }
        if (upper <= known.range.upper()) known.witness = std::move(proved.witness);
        upper = std::min(upper, known.range.upper());
        if (known.hull.size() == 0 && upper <= proved.value.upper()) known.hull = proved.hull;
        double const lower = std::max(proved.value.lower(), known.range.lower());
        known.range = interval_traits<interval>::bounds(std::min(lower, upper), upper);
    }

    /// Whether some parameter explains the data, and by how much the bounds are missed.
    void measure_gap(screening& tried) {
        auto& d = run_.result;
        tried.try_one({});
        if (tried.candidates().empty()) return;
        auto const& base = tried.candidates().front();
        auto& bound = run_.base_bound;
        bound = at_point(base);
        bool const enclosed = !diagnosis_detail::has_delays(base.problem.model);
        bool const wide = has_wide_starts(base.problem);
        if (enclosed && wide && is_open(bound))
            refute_by_observers(bound, base, 2 * options_.gap_seconds);
        if (enclosed && !(bound.range.lower() > 1)) {
            auto search = effort(bound.range.upper() <= 1 ? 0.3 : options_.gap_seconds);
            search.relative_width = 0.03;
            double const fewer = refuted_by_few(base, bound.range.upper(), 0.6 * search.seconds);
            auto const upper = bound.range.upper();
            bound.range = interval_traits<interval>::bounds(std::min(fewer, upper), upper);
            search.seconds = std::min(search.seconds, left());
            tighten(bound, base, search);
            if (!wide && is_open(bound) && go_on("bounding the states"))
                refute_by_observers(bound, base, options_.gap_seconds);
            if (is_open(bound) && go_on("deciding whether there is a gap")) {
                search = effort(2 * options_.gap_seconds);
                search.only_verdict = true;
                tighten(bound, base, search);
            }
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
        if (s.problem.experiments.size() <= 2 * options_.hardest || upper <= 1) return 0;
        inflation_options search;
        search.test = options_.test;
        search.seconds = std::min(left(), seconds);
        search.only_verdict = only_verdict;
        search.relative_width = 0.1;
        auto const few = hardest_experiments(s.problem, s.fit, options_.hardest);
        return bound_inflation(few, nullptr, search).value.lower();
    }

    [[nodiscard]] static bool is_open(verified_inflation const& known) {
        return !(known.range.lower() > 1) && known.range.upper() > 1;
    }
    /// Wide starts and long records, where no box of the search above is carried to the end.
    void refute_by_observers(verified_inflation& known, screened const& s, double seconds) const {
        auto const upper = known.range.upper();
        double const proved =
            inflation_refuted_by_observers(s.problem, upper, std::min(left(), seconds), [this] {
                return !options_.progress || options_.progress("bounding the states");
            });
        known.range = interval_traits<interval>::bounds(
            std::max(known.range.lower(), std::min(proved, upper)), upper);
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
            run_.result.where.push_back(described(p));
            prove(run_.result.where.back());
        }
        if (run_.result.where.empty()) return;
        for (auto const& set : run_.places.alternatives) {
            std::string text;
            for (auto const& name : set) text += (text.empty() ? "" : " and ") + name;
            run_.result.where.front().alternatives.push_back(text);
        }
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
        if (options_.first_sentence) options_.first_sentence(first_sentence_of(run_.result));
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
            d.effects = names_of(figures[chosen.best], run_.catalogue);
            d.answer = d.effects.empty() ? answer_kind::none : answer_kind::effects;
            for (auto const o : chosen.others) {
                d.indistinguishable.push_back(names_of(figures[o], run_.catalogue));
                others_.push_back(o);
            }
        }
        for (std::size_t i = 1; i < run_.candidates.size(); ++i) {
            order_.push_back(i);
            auto const& c = run_.candidates[i];
            if (c.silent && c.figures.effects.size() == 1) {
                d.unobservable.push_back(run_.catalogue[c.figures.effects.front()].name);
            }
        }
        std::stable_sort(order_.begin(), order_.end(),
                         [&](std::size_t a, std::size_t b) { return place_of(a) < place_of(b); });
        for (auto const i : order_)
            d.causes.push_back(cause_of(run_.candidates[i], run_.catalogue, run_.base.prior.size(),
                                        tried.measurements()));
    }
    /// The answer, then what cannot be told from it, then by inflation; last what only adds to an
    /// answer that explains.
    [[nodiscard]] double place_of(std::size_t i) const {
        if (i == run_.answer) return -3;
        for (std::size_t k = 0; k < others_.size(); ++k) {
            if (others_[k] == i) return -2 + 0.1 * static_cast<double>(k);
        }
        double const inflation = run_.candidates[i].figures.inflation;
        return adds_to_answer(i) ? 1e6 + inflation : std::min(inflation, 1e6);
    }
    [[nodiscard]] bool adds_to_answer(std::size_t i) const {
        auto const& answer = run_.candidates[run_.answer].figures;
        auto const& all = run_.candidates[i].figures.effects;
        return answer.explains() && i != run_.answer &&
               std::includes(all.begin(), all.end(), answer.effects.begin(), answer.effects.end());
    }
    /// Witnesses for what explains, proofs of emptiness for what does not.
    void verify_candidates() {
        auto& d = run_.result;
        for (std::size_t k = 0; k < order_.size(); ++k) {
            auto const& s = run_.candidates[order_[k]];
            auto& c = d.causes[k];
            bool const of_interest =
                place_of(order_[k]) < 0 || (s.figures.explains() && !adds_to_answer(order_[k]));
            if (of_interest) {
                if (!go_on("verifying a witness")) return;
                auto proved = at_point(s);
                c.inflation = proved.range;
                c.assumptions = proved.assumptions;
                if (proved.range.upper() <= 1) c.verdict = cause_verdict::explains;
                if (proved.witness)
                    c.witness =
                        named(s.problem, proved.witness->parameters, proved.witness->starts);
                if (order_[k] == run_.answer) {
                    run_.answer_bound = std::move(proved);
                    sharpen_answer(s, c);
                }
            }
        }
        double const begin = seconds();
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
            if (s.figures.explains()) continue; // nothing to refute
            double const spent = seconds() - begin;
            if (spent > options_.verify_seconds) return;
            if (!go_on("excluding " + c.effects.front())) return;
            auto search = effort(std::min(options_.verify_seconds - spent, options_.each_seconds));
            search.only_verdict = true;
            bool const wide = has_wide_starts(s.problem);
            if (wide) search.seconds *= 0.5; // each for observers and sets of trajectories
            double const fewer = wide ? inflation_refuted_by_observers(s.problem, 2, search.seconds)
                                      : refuted_by_few(s, s.fit.inflation, search.seconds, true);
            auto const proved = fewer > 1
                                    ? interval_traits<interval>::bounds(fewer, detail::infinity)
                                    : bound_inflation(s.problem, &s.fit, search).value;
            c.inflation = intersect(c.inflation, proved); // both contain it
            if (c.inflation.lower() > 1) c.verdict = cause_verdict::excluded;
        }
    }

    /// The least inflation of the answer from below, and the box that its best parameters lie in.
    void sharpen_answer(screened const& s, cause& c) {
        auto& d = run_.result;
        auto& bound = run_.answer_bound;
        if (!diagnosis_detail::has_delays(s.problem.model)) {
            tighten(bound, s, effort(std::min(1.5, options_.gap_seconds)));
        }
        c.inflation = bound.range;
        d.shrink_fit = shrink(d.inflation, bound.range);
        bound_parameters(s, c);
    }

    /// Hulls of the effect's parameters: every value that explains the data lies in them.
    void bound_parameters(screened const& s, cause& c) {
        if (!(c.inflation.upper() <= 1) || diagnosis_detail::has_delays(s.problem.model)) return;
        if (!go_on("bounding the effect's parameters")) return;
        identify_options options;
        options.only_hulls = true;
        options.test = options_.test;
        options.search.seconds = std::min(left(), options_.hull_seconds);
        auto const found = identify(s.problem, options);
        auto const own = run_.base.prior.size();
        for (std::size_t k = 0; k < c.parameters.size(); ++k) {
            c.parameters[k].hull = found.hull[own + k];
        }
    }

    /// The inflation of each scenario and each channel alone.
    void measure_parts() {
        if (diagnosis_detail::has_delays(run_.base.model)) return;
        auto const each = effort(0.4);
        double const begin = seconds();
        auto const next = [&](std::string const& name) {
            return seconds() - begin < options_.parts_seconds &&
                   go_on("measuring the gap of " + name);
        };
        run_.result.scenario_inflation = inflation_of_experiments(run_.base, each, next);
        run_.result.channel_inflation = inflation_of_channels(run_.base, each, next);
    }

    /// How much is left with the closest candidate, and where: the lead to what no effect has.
    void describe_remainder() {
        auto& d = run_.result;
        if (d.answer != answer_kind::unexplained || d.causes.empty()) return;
        auto const& nearest = run_.candidates[run_.answer];
        unexplained_remainder rest{
            names_of(nearest.figures, run_.catalogue), run_.answer_bound.range, {}};
        if (run_.answer == 0) {
            rest.inflation = d.inflation;
            rest.where = d.where;
        } else if (go_on("looking for what is left")) {
            run_.remaining_places = estimate_places(nearest.problem);
            for (auto const& p : run_.remaining_places.places) rest.where.push_back(described(p));
        }
        d.remainder = std::move(rest);
    }

    void propose() {
        auto& d = run_.result;
        if (others_.empty() || !go_on("looking for a manoeuvre that tells rivals apart")) return;
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
