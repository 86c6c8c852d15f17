// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_PROOF_DETAIL_PROVED_CAMPAIGN_HPP
#define SIVID_VERIFIER_PROOF_DETAIL_PROVED_CAMPAIGN_HPP

#include <sivid/paving/run/plain_run.hpp>
#include <sivid/verifier/proof/detail/plain_start_rule.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// All experiments of a problem by plain runs: what they say of regions and of their parts.
/// @tparam I  the interval type of the runs
template <class I>
class proved_campaign {
public:
    /// @param starts  where existence is to be proved from, a box per experiment; may be empty (all
    /// starts of the experiment then)
    proved_campaign(identification_problem const& problem, std::vector<box> starts,
                    enclosure_options const& options)
        : problem_(&problem), starts_(std::move(starts)) {
        for (auto const& e : problem.experiments) {
            runs_.push_back(
                std::make_unique<plain_run<I>>(problem.model, problem.choice, e, options));
            recorded_.emplace_back();
            if (!any_uncertain(e.inputs)) continue;
            auto exact = e;
            exact.inputs = nominal(e.inputs);
            recorded_.back() =
                std::make_unique<plain_run<I>>(problem.model, problem.choice, exact, options);
        }
    }

    /// What the experiments say of a region: of all of them, or of those up to one that refutes it.
    struct knowledge {
        /// For all starts and inputs, for the chosen starts and the recorded inputs.
        std::vector<plain_outputs<I>> all, chosen;
        /// For starts near a rule that seems to explain the region, and the recorded inputs; empty
        /// where there is none or none is needed.
        std::vector<plain_outputs<I>> guided;
        std::vector<box> guide; ///< those starts
        bool refuted = false;   ///< the whole region is
    };

    [[nodiscard]] std::size_t runs() const { return count_; }

    /// Runs experiments over the region until one refutes it.
    /// @param seek  look for starts that explain the region
    /// @cost  one validated run per experiment, two where starts are chosen, up to `shots` and one
    ///   more where they are sought
    [[nodiscard]] knowledge learn(box const& region, bool seek = true) {
        knowledge known;
        for (std::size_t e = 0; e < runs_.size() && !known.refuted; ++e) {
            auto const& own = problem_->experiments[e];
            ++count_;
            known.all.push_back((*runs_[e])(own.initial, region));
            known.chosen.emplace_back();
            known.guided.emplace_back();
            known.guide.emplace_back();
            auto const says = decide(known.all[e], runs_[e]->samples(), region, own.outliers);
            known.refuted = says == run_finding::refuted;
            if (known.refuted) continue;
            bool explained = says == run_finding::explained;
            auto& exactly = *(recorded_[e] ? recorded_[e] : runs_[e]);
            if (has_chosen(e)) {
                ++count_;
                auto const& starts = e < starts_.size() ? starts_[e] : own.initial;
                known.chosen[e] = exactly(starts, region);
                explained = explained || decide(known.chosen[e], runs_[e]->samples(), region,
                                                own.outliers) == run_finding::explained;
            }
            if (!seek || explained || !has_choice(own.initial)) continue;
            auto starts = shoot(e, exactly, region);
            if (!starts) continue;
            ++count_;
            known.guided[e] = exactly(*starts, region);
            known.guide[e] = std::move(*starts);
        }
        return known;
    }

    /// Decides a part of the region that is known.
    /// @guarantee  explained: for each parameter of the part there are starts and inputs for which
    /// every experiment holds; refuted: for no parameter of it
    [[nodiscard]] run_finding judge(knowledge const& known, box const& part) const {
        if (known.refuted) return run_finding::refuted;
        bool explained = true;
        for (std::size_t e = 0; e < known.all.size(); ++e) {
            auto const q = problem_->experiments[e].outliers;
            auto const& samples = runs_[e]->samples();
            auto const says = decide(known.all[e], samples, part, q);
            if (says == run_finding::refuted) return says;
            bool const holds = says == run_finding::explained ||
                               (has_chosen(e) && decide(known.chosen[e], samples, part, q) ==
                                                     run_finding::explained) ||
                               is_guided(known, e, part);
            explained = explained && holds;
        }
        return explained ? run_finding::explained : run_finding::open;
    }

    /// How far side j of a part spreads an output, in widths of its measurement; a preference only.
    [[nodiscard]] double spread(knowledge const& known, box const& part, std::size_t j) const {
        double most = 0;
        for (std::size_t e = 0; e < known.all.size(); ++e) {
            auto const& samples = runs_[e]->samples();
            for (std::size_t k = 0; k < known.all[e].outputs.size(); ++k) {
                auto const& g = known.all[e].outputs[k].gradient;
                double const slope = std::abs(g[g.size() - part.size() + j]);
                double const room = std::max(width(samples[k].bound), 1e-300);
                most = std::max(most, slope * (part[j].upper() - part[j].lower()) / room);
            }
        }
        return most;
    }

private:
    /// Linearisations by which starts are sought, and how far the last may move a start, in
    /// half-widths of its box.
    static constexpr int shots = 6;
    static constexpr double close = 1.0 / 64;
    /// Reach of the starts in a shot, in half-widths of their boxes.
    static constexpr double near = 0x1p-20;

    [[nodiscard]] static bool has_choice(box const& initial) {
        return std::any_of(initial.begin(), initial.end(), [](interval const& side) {
            return !plain_start_rule<I>::is_decimal(side);
        });
    }

    /// Starts around a rule that seems to explain the region, by shooting: all starts of a long
    /// experiment are too many for sets of first order, so the outputs are linearised about single
    /// starts, each about the one that is best by the last linearisation. A guess: what is returned
    /// is for a run to judge.
    [[nodiscard]] std::optional<box> shoot(std::size_t e, plain_run<I>& exactly,
                                           box const& region) {
        auto const& own = problem_->experiments[e];
        aims_.resize(runs_.size());
        auto& aim = aims_[e];
        if (aim.empty()) aim = mid(e < starts_.size() ? starts_[e] : own.initial);
        std::optional<box> result;
        for (int shot = 0; shot < shots; ++shot) {
            auto at = own.initial;
            for (std::size_t i = 0; i < at.size(); ++i) {
                if (plain_start_rule<I>::is_decimal(at[i])) continue;
                double const reach = near * rad(at[i]);
                at[i] = intersect(at[i], interval(aim[i] - reach, aim[i] + reach));
            }
            if (is_empty(at)) break;
            ++count_;
            auto const known = exactly(at, region);
            plain_start_rule<I> const forms(known, exactly.samples(), at, region, own.initial);
            auto rule = forms.search(own.outliers, false);
            bool const explains = rule.has_value();
            for (double bounds = 4; !rule && bounds < 1e4; bounds *= 4) {
                rule = forms.search(own.outliers, false, bounds); // the best that there is
            }
            result.reset();
            if (!rule) break;
            auto const next = forms.middle(*rule);
            double moved = 0;
            for (std::size_t i = 0; i < at.size(); ++i) {
                if (plain_start_rule<I>::is_decimal(at[i])) continue;
                moved = std::max(moved, std::abs(next[i] - aim[i]) / rad(own.initial[i]));
            }
            if (explains) result = forms.around(*rule, own.initial);
            aim = next;
            if (moved <= close) break;
        }
        if (result && is_empty(*result)) result.reset();
        if (!result) aim.clear();
        return result;
    }

    /// Whether starts near those that seemed to explain the region do explain the part.
    [[nodiscard]] bool is_guided(knowledge const& known, std::size_t e, box const& part) const {
        if (known.guide[e].size() == 0) return false;
        auto const q = problem_->experiments[e].outliers;
        plain_start_rule<I> const starts(known.guided[e], runs_[e]->samples(), known.guide[e],
                                         part);
        auto const rule = starts.search(q, true);
        return rule && starts.proves(*rule, q);
    }
    [[nodiscard]] bool has_chosen(std::size_t e) const {
        return recorded_[e] ||
               (e < starts_.size() && !subset(problem_->experiments[e].initial, starts_[e]));
    }

    identification_problem const* problem_;
    std::vector<box> starts_;
    std::vector<std::vector<double>> aims_; ///< where the last search for starts ended
    std::vector<std::unique_ptr<plain_run<I>>> runs_;
    std::vector<std::unique_ptr<plain_run<I>>> recorded_; ///< where inputs have error bounds
    std::size_t count_ = 0;
};

} // namespace sivid

#endif
