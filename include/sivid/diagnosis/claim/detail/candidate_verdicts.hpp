// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CLAIM_DETAIL_CANDIDATE_VERDICTS_HPP
#define SIVID_DIAGNOSIS_CLAIM_DETAIL_CANDIDATE_VERDICTS_HPP

#include <sivid/diagnosis/candidate/detail/candidate_order.hpp>
#include <sivid/diagnosis/candidate/detail/describe_candidate.hpp>
#include <sivid/diagnosis/claim/detail/claim_review.hpp>
#include <sivid/diagnosis/diagnosis_run.hpp>
#include <sivid/diagnosis/gap/detail/gap_proof.hpp>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace sivid {

/// Proves what can be proved about the causes of a diagnosis: witnesses for what explains,
/// emptiness for what does not.
class candidate_verdicts {
public:
    /// @param run  its candidates, answer and causes (in the order given) are known
    candidate_verdicts(diagnosis_run& run, candidate_order const& order, diagnosis_effort& effort,
                       diagnosis_options const& options)
        : run_(&run), order_(&order), effort_(&effort), options_(&options) {}

    void operator()() {
        if (verify()) refute();
    }

    /// Witnesses of what seems to explain the data, and bounds of the answer.
    /// @returns false when it was stopped
    bool verify() { return verify_witnesses(); }
    /// The proofs that a candidate does not explain them; afterwards.
    void refute() {
        exclude_by_relations();
        exclude();
    }

private:
    [[nodiscard]] screened const& candidate_of(std::size_t k) const {
        return run_->candidates[order_->order()[k]];
    }

    /// @returns false when it was stopped
    bool verify_witnesses() {
        for (std::size_t k = 0; k < order_->order().size(); ++k) {
            if (!order_->of_interest(order_->order()[k])) continue;
            if (!effort_->go_on("verifying a witness")) return false;
            auto const& s = candidate_of(k);
            auto& c = run_->result.causes[k];
            auto proved = verify_fit(s, effort_->test());
            c.inflation = proved.range;
            c.assumptions.insert(c.assumptions.end(), proved.assumptions.begin(),
                                 proved.assumptions.end());
            if (proved.range.upper() <= 1) c.verdict = cause_verdict::explains;
            if (proved.witness) {
                c.witness = named(s.problem, proved.witness->parameters, proved.witness->starts);
            }
            if (order_->order()[k] == run_->answer) {
                run_->answer_bound = std::move(proved);
                sharpen_answer(s, c);
            }
        }
        return true;
    }

    /// The least inflation of the answer from below, and the box that its best parameters lie in.
    void sharpen_answer(screened const& s, cause& c) {
        auto& bound = run_->answer_bound;
        if (!s.problem.model.has_memory()) {
            tighten(bound, s, effort_->search(s.problem, options_->answer));
        }
        c.inflation = bound.range;
        if (bound.range.upper() <= 1) c.verdict = cause_verdict::explains;
        // The one that hold-out data are judged at, too.
        if (bound.witness) {
            c.witness = named(s.problem, bound.witness->parameters, bound.witness->starts);
        }
        run_->result.shrink_fit = shrink(run_->result.inflation, bound.range);
    }

    /// Candidates that leave a refuted relation as it is, by those that no candidate contradicts.
    void exclude_by_relations() {
        review_relations(*run_);
        for (auto const& f : run_->findings) {
            if (!f.proved) continue;
            for (auto& c : run_->result.causes) {
                auto const& kept = c.untouched;
                if (std::find(kept.begin(), kept.end(), f.name) == kept.end()) continue;
                if (c.verdict == cause_verdict::excluded) continue; // by a clearer relation
                c.verdict = cause_verdict::excluded;
                c.excluded_by = f.name;
                c.assumptions = f.assumptions;
            }
        }
    }

    /// Fewest effects first, within an effort for all of them; where observers split every
    /// parameter, fewest parameters first, and what is farthest from explaining.
    void exclude() {
        auto& causes = run_->result.causes;
        double const end = effort_->left() - effort_->seconds_of(options_->exclusions);
        std::size_t left = options_->exclusions.boxes;
        std::vector<std::size_t> open(causes.size());
        for (std::size_t k = 0; k < open.size(); ++k) open[k] = k;
        bool const observed = has_wide_starts(run_->base);
        std::stable_sort(open.begin(), open.end(), [&](std::size_t a, std::size_t b) {
            auto const size = [&](std::size_t k) {
                auto const& s = candidate_of(k);
                return std::tuple{causes[k].effects.size(), observed ? s.problem.prior.size() : 0,
                                  observed ? -s.fit.inflation : 0.0};
            };
            return size(a) < size(b);
        });
        for (auto const k : open) {
            auto const& s = candidate_of(k);
            auto& c = causes[k];
            if (c.verdict != cause_verdict::undecided) continue;
            if (s.problem.model.has_memory()) continue;
            // States of its own (a lag) are stiff near a time constant of 0, where runs take long
            // and exclude nothing.
            if (s.problem.model.rate.size() > run_->base.model.rate.size()) continue;
            if (s.figures.explains()) continue; // nothing to refute
            if (left == 0 || effort_->left() < end) return;
            if (!effort_->go_on("excluding " + c.effects.front())) return;
            auto each = options_->exclusion;
            each.boxes = std::min(each.boxes, left);
            auto search = effort_->search(s.problem, each);
            search.only_verdict = true;
            std::size_t spent = 0;
            double fewer = 0;
            bool const wide = has_wide_starts(s.problem);
            if (wide) {
                auto most = effort_->observers(each);
                most.only_verdict = true;
                auto const found = inflation_refuted_by_observers(s.problem, s.fit.inflation, most);
                fewer = found.lower;
                spent = found.boxes;
            } else {
                fewer = refuted_by_few(s, options_->gap.hardest, search, spent);
            }
            auto proved = interval_traits<interval>::bounds(fewer, detail::infinity);
            if (!(fewer > 1) && !wide) {
                auto const found = bound_inflation(s.problem, &s.fit, search);
                spent += diagnosis_effort::boxes_of(s.problem, found);
                proved = found.value;
                if (auto const& w = found.witness; w && proved.upper() < c.inflation.upper())
                    c.witness = named(s.problem, w->parameters, w->starts);
            }
            left -= std::min(left, spent);
            c.inflation = intersect(c.inflation, proved); // both contain it
            if (c.inflation.lower() > 1) c.verdict = cause_verdict::excluded;
        }
    }

    diagnosis_run* run_;
    candidate_order const* order_;
    diagnosis_effort* effort_;
    diagnosis_options const* options_;
};

} // namespace sivid

#endif
