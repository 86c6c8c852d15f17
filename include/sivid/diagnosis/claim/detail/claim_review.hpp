// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CLAIM_DETAIL_CLAIM_REVIEW_HPP
#define SIVID_DIAGNOSIS_CLAIM_DETAIL_CLAIM_REVIEW_HPP

#include <sivid/approximate/fit/detail/approximate_campaign.hpp>
#include <sivid/diagnosis/candidate/detail/describe_candidate.hpp>
#include <sivid/diagnosis/claim/detail/diagnosis_consistency.hpp>
#include <sivid/diagnosis/claim/detail/place_report.hpp>
#include <sivid/diagnosis/diagnosis_run.hpp>
#include <sivid/model/named_effects.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/paving/relation/detail/untouched_relation.hpp>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// The greatest difference of any two values within a time.
/// @given  as many values as times, which do not decrease
[[nodiscard]] inline double greatest_variation(std::vector<double> const& times,
                                               std::vector<double> const& values, double period) {
    double most = 0;
    std::deque<std::size_t> high, low; // of the window that ends at k, extremes first
    for (std::size_t k = 0; k < times.size(); ++k) {
        while (!high.empty() && values[high.back()] <= values[k]) high.pop_back();
        while (!low.empty() && values[low.back()] >= values[k]) low.pop_back();
        high.push_back(k);
        low.push_back(k);
        double const begin = times[k] - period * (1 + 1e-9);
        while (times[high.front()] < begin) high.pop_front();
        while (times[low.front()] < begin) low.pop_front();
        most = std::max(most, values[high.front()] - values[low.front()]);
    }
    return most;
}

/// Whether a candidate's own motion, simulated at its fit, is one that the assumptions of a
/// relation leave out: its rates vary more than declared.
///   In plain doubles: it can only take a proof back.
[[nodiscard]] inline bool breaks_assumptions(screened const& s, relation_finding const& f) {
    if (f.variations.empty() || s.fit.parameters.empty()) return false;
    approximate_campaign motion(s.problem);
    auto const z = motion.variables(s.fit.parameters, s.fit.starts);
    std::map<std::string, simulated_trace> seen;
    for (auto const& v : f.variations) {
        auto const [at, fresh] = seen.try_emplace(v.scenario);
        auto& trace = at->second;
        for (std::size_t e = 0; fresh && e < s.problem.experiments.size(); ++e) {
            if (s.problem.experiments[e].name != v.scenario) continue;
            if (!motion.trace(e, z, trace)) trace = {};
        }
        std::vector<double> rates;
        for (auto const& r : trace.rates) rates.push_back(r[v.state]);
        if (rates.size() != trace.times.size()) continue;
        if (greatest_variation(trace.times, rates, v.period) > v.variation) return true;
    }
    return false;
}

/// Withdraws the relations of a run that a candidate contradicts: one that explains the data, by a
/// validated run or (this is enough to doubt) by its fit, and either leaves the relation as it is
/// or moves as the relation's assumptions do not allow. Says of every cause which of the relations
/// it leaves untouched.
/// @cost  a simulation of each candidate that explains
inline void review_relations(diagnosis_run& run) {
    auto& d = run.result;
    for (auto& c : d.causes) c.untouched.clear();
    std::vector<relation_finding> standing;
    for (auto const& f : run.findings) {
        std::string reason;
        for (auto const& s : run.candidates) {
            auto const names = names_of(s.figures, run.catalogue);
            auto const at = std::find_if(d.causes.begin(), d.causes.end(),
                                         [&](cause const& c) { return c.effects == names; });
            bool const keeps = keeps_relation(run.base.model, s.problem.model, f);
            if (at != d.causes.end() && keeps) at->untouched.push_back(f.name);
            bool const proved = at != d.causes.end() && at->verdict == cause_verdict::explains;
            if (!f.proved || !reason.empty() || (!proved && !s.figures.explains())) continue;
            auto who = names.empty() ? "the model as it is" : joined(names, " + ");
            who += proved ? " explains the data" : " seems to explain the data";
            if (keeps) {
                reason = who + " and leaves it as it is";
            } else if (proved && breaks_assumptions(s, f)) {
                reason = who + ", and there rates vary more than it assumes";
            }
        }
        if (reason.empty()) {
            standing.push_back(f);
            continue;
        }
        d.withdrawn.push_back({"relation " + f.name, reason});
        for (auto& c : d.causes) {
            if (c.excluded_by != f.name) continue;
            c.excluded_by.clear();
            c.assumptions.clear();
            c.verdict = cause_verdict::undecided;
            d.withdrawn.push_back(
                {"cause " + joined(c.effects, " + ") + " excluded", "by the relation " + f.name});
        }
    }
    if (standing.size() == run.findings.size()) return;
    auto const stands = [&standing](std::string const& name) {
        return std::any_of(standing.begin(), standing.end(),
                           [&name](auto const& f) { return f.name == name; });
    };
    for (auto& c : d.causes) std::erase_if(c.untouched, [&](auto const& n) { return !stands(n); });
    run.findings = std::move(standing);
    d.relations.clear();
    for (auto const& f : run.findings) d.relations.push_back(reported(f));
    d.where = reported(run.places, run.findings);
}

/// Takes back what is said of a cause: that it is excluded, by a relation or by its inflation.
inline void doubt_cause(cause& c) {
    bool const explains = c.inflation.upper() <= 1;
    c.verdict = explains && c.witness ? cause_verdict::explains : cause_verdict::undecided;
    if (!c.excluded_by.empty()) {
        c.excluded_by.clear();
        c.assumptions.clear();
        return;
    }
    double const most = explains ? c.inflation.upper() : unknown_inflation().upper();
    c.inflation = interval_traits<interval>::bounds(0, most);
}

/// Takes back an answer that is excluded, and excluded ones that were said to be like it.
inline void doubt_answer(diagnosis& d) {
    auto const excluded = [&d](auto const& effects) {
        return std::any_of(d.causes.begin(), d.causes.end(), [&effects](cause const& k) {
            return k.effects == effects && k.verdict == cause_verdict::excluded;
        });
    };
    std::erase_if(d.indistinguishable, excluded);
    if (d.answer != answer_kind::none && d.answer != answer_kind::effects) {
        answer_by_proof(d);
        return;
    }
    if (d.answer == answer_kind::effects && !excluded(d.effects)) return;
    d.effects.clear();
    d.answer = d.tried.complete() ? answer_kind::unexplained : answer_kind::open;
}

/// Withdraws what is in doubt, and what rests on it, until nothing contradicts anything; every
/// claim that was withdrawn stands in `d.withdrawn`.
inline void withdraw_contradictions(diagnosis& d,
                                    std::function<bool(std::string const&)> const& vanishes = {}) {
    using about = contradiction::about;
    for (int pass = 0; pass < 8; ++pass) {
        auto found = find_contradictions(d, vanishes);
        if (found.empty()) return;
        // From behind, so that indices stay.
        std::stable_sort(found.begin(), found.end(),
                         [](auto const& a, auto const& b) { return a.index > b.index; });
        std::size_t gone = d.relations.size();
        for (auto const& c : found) {
            d.withdrawn.push_back({c.claim, c.reason});
            switch (c.kind) {
            case about::gap:
                d.gap = gap_verdict::undecided;
                if (!(d.inflation.lower() <= d.inflation.upper()))
                    d.inflation = unknown_inflation();
                break;
            case about::relation:
                if (c.index >= gone) break;
                gone = c.index;
                d.relations.erase(d.relations.begin() + static_cast<std::ptrdiff_t>(c.index));
                break;
            case about::place:
                d.where[c.index].proved = false;
                d.where[c.index].missing.reset();
                d.where[c.index].assumptions.clear();
                break;
            case about::cause:
                doubt_cause(d.causes[c.index]);
                break;
            case about::hull:
                d.causes[c.index].parameters[c.member].hull.reset();
                break;
            case about::part:
                (c.index < d.scenario_inflation.size()
                     ? d.scenario_inflation[c.index]
                     : d.channel_inflation[c.index - d.scenario_inflation.size()])
                    .hull.reset();
                break;
            case about::confined:
                d.confined.erase(d.confined.begin() + static_cast<std::ptrdiff_t>(c.index));
                break;
            case about::shrink:
                d.shrink_fit.reset();
                break;
            case about::answer:
                doubt_answer(d);
                break;
            }
        }
    }
}

/// Puts an instrument before all other places: the one whose fault is the answer, or, where no
/// effect is, the channel that alone stands against the model: what is wrong elsewhere shows in
/// others, too. Of several such channels one whose noise grows, whose errors go together or whose
/// readings are too coarse, unless no place was found at all.
inline void suspect_instrument(diagnosis& d) {
    if (d.gap == gap_verdict::none) return;
    std::vector<std::string> suspects;
    suspected_place s;
    s.kind = "sensor";
    if (d.answer == answer_kind::effects) {
        if (d.effects.size() == 1 && names_sensor_fault(d.effects.front()))
            suspects = faulty_channels(d.effects.front());
    } else {
        auto const of_channel = [](auto const& c) { return !c.channel.empty(); };
        auto const told = [](auto const& c) { return c.grows || c.correlated || c.steps; };
        auto const begin = d.confined.begin(), end = d.confined.end();
        bool const one = std::count_if(begin, end, of_channel) == 1;
        auto alone = std::find_if(begin, end, told);
        if (alone == end && (one || d.where.empty())) alone = std::find_if(begin, end, of_channel);
        if (alone == end) return;
        suspects = {alone->channel};
        if (alone->scenarios.size() == 1) s.where.scenario = alone->scenarios.front();
    }
    if (suspects.empty()) return;
    auto const known = std::find_if(d.where.begin(), d.where.end(), [&](auto const& w) {
        return w.kind == s.kind &&
               std::find(suspects.begin(), suspects.end(), w.name) != suspects.end();
    });
    s.name = suspects.front();
    if (known == d.where.end()) {
        d.where.insert(d.where.begin(), std::move(s));
        return;
    }
    std::rotate(d.where.begin(), known, known + 1);
    if (d.answer != answer_kind::effects) return;
    d.where.front().law.clear(); // what it looked like before it was known
    d.where.front().estimate.reset();
}

/// Adds every assumption that a shown proof rests on to the list of all.
inline void list_assumptions(diagnosis& d) {
    auto const add = [&d](std::vector<std::string> const& more) {
        for (auto const& a : more) {
            if (std::find(d.assumptions.begin(), d.assumptions.end(), a) == d.assumptions.end()) {
                d.assumptions.push_back(a);
            }
        }
    };
    for (auto const& r : d.relations) {
        if (r.proved) add(r.assumptions);
    }
    for (auto const& p : d.where) {
        if (p.proved) add(p.assumptions);
    }
    for (auto const& c : d.causes) {
        if (c.verdict != cause_verdict::undecided || c.witness) add(c.assumptions);
    }
    for (auto const& c : d.confined) add(c.assumptions);
}

/// The last step of a diagnosis: what contradicts is withdrawn, and every assumption is listed.
inline void settle_claims(diagnosis_run& run) {
    review_relations(run);
    withdraw_contradictions(run.result, [&run](std::string const& name) {
        auto const at = std::find_if(run.catalogue.begin(), run.catalogue.end(),
                                     [&name](effect const& e) { return e.name == name; });
        if (at == run.catalogue.end() || at->may_leave_traces()) return false;
        return std::all_of(at->parameters.begin(), at->parameters.end(),
                           [](auto const& p) { return contains(p.prior(), nearest(p.neutral)); });
    });
    suspect_instrument(run.result);
    list_assumptions(run.result);
}

} // namespace sivid

#endif
