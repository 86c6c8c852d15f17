// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_DETAIL_LP_CONTRACTOR_HPP
#define SIVID_PAVING_CONTRACT_DETAIL_LP_CONTRACTOR_HPP

#include <sivid/paving/contract/detail/cut_program.hpp>
#include <sivid/paving/contract/detail/misfit_block.hpp>
#include <sivid/paving/contract/detail/weighted_certificate.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// Contracts a box of parameters by all measurements of all experiments together: for each side
/// linear programs propose weights, and the weighted sum of the measurements proves how far the
/// side can be cut off. The starts are unknowns of the programs too, so a cut holds whatever they
/// are.
///   With Q outliers left to the experiments in all, Q + 1 groups of measurements that share none
///   prove a cut each; one of the groups contains no outlier, so the weakest cut holds.
/// @guarantee  removes no parameter that is feasible for some starts
/// @cost  2 n (Q + 1) linear programs and certificates; nothing is integrated
class lp_contractor {
    using traits = interval_traits<interval>;

public:
    /// More groups than this are not tried: experiments with outliers are then left out.
    static constexpr std::size_t most_groups = 8;

    /// @param known  of a box around `part`; only outputs that were reached count
    /// @param part   contracted
    /// @param proof  takes the cuts with their weights
    /// @returns false when nothing is left (`part` is meaningless then)
    [[nodiscard]] bool operator()(response_list const& known, box& part,
                                  exclusion_proof* proof = nullptr) {
        known_ = &known;
        failing_.clear();
        shared_unknowns const unknowns(known, part);
        blocks_.clear();
        scales_.clear();
        allowance_.clear();
        std::size_t allowed = 0;
        for (std::size_t s = 0; s < known.size(); ++s) {
            linearise(s, part, unknowns);
            allowed += allowance_[s];
        }
        if (allowed >= most_groups) {
            for (std::size_t s = 0; s < known.size(); ++s) {
                if (allowance_[s] > 0) blocks_[s] = {};
            }
            allowed = 0;
        }
        auto const whole = part;
        auto const note = [&](proof_step::kind what, std::size_t j, bool upwards, groups why) {
            if (proof == nullptr) return;
            auto const& side = part[j];
            proof->push_back({what, j, upwards, upwards ? side.upper() : side.lower(),
                              with_failing(std::move(why))});
        };
        for (std::size_t j = 0; j < part.size(); ++j) {
            if (!(rad(whole[j]) > 0)) continue;
            groups why;
            for (bool const upwards : {true, false}) {
                double const reach = least_reach(unknowns, j, upwards, allowed, why);
                if (!(reach >= -1)) {
                    note(proof_step::kind::empty, j, upwards, std::move(why));
                    return false;
                }
                if (!(reach < 1)) continue;
                auto const end = at(whole[j], upwards ? reach : -reach);
                auto const most = upwards ? end.upper() : part[j].upper();
                auto const least = upwards ? part[j].lower() : end.lower();
                if (!(least <= most)) {
                    note(proof_step::kind::empty, j, upwards, {});
                    return false;
                }
                auto const former = part[j];
                part[j] = traits::intersect(former, traits::bounds(least, most));
                if (is_empty(part[j])) {
                    note(proof_step::kind::empty, j, upwards, {});
                    return false;
                }
                part[j] = rounded_within(box{part[j]}, box{former})[0];
                if (former.lower() < part[j].lower() || part[j].upper() < former.upper()) {
                    note(proof_step::kind::cut, j, upwards, std::move(why));
                }
            }
        }
        return true;
    }

private:
    using groups = proof_step::groups;
    static constexpr double nowhere = -std::numeric_limits<double>::infinity();

    /// Encloses mid + rad * d.
    [[nodiscard]] static interval at(interval const& side, double d) {
        return traits::add(traits::point(mid(side)),
                           traits::mul(traits::point(rad(side)), traits::point(d)));
    }

    /// The constraints of an experiment over the part, and how many outliers it has left for them.
    void linearise(std::size_t s, box const& part, shared_unknowns const& unknowns) {
        auto const& r = *(*known_)[s];
        auto const local = expand(r, part);
        auto const ranges = output_ranges(r, local);
        std::size_t failed = 0;
        auto misfits = misfits_of(r, local, unknowns.places[s], 1, [&](std::size_t y) {
            bool const fails = disjoint(ranges[y], r.bounds[y]);
            failed += fails ? 1 : 0;
            if (fails && r.allowed > 0) {
                bool const above = ranges[y].lower() > r.bounds[y].upper();
                failing_.push_back({s, y, above ? 1.0 : -1.0});
            }
            return !subset(ranges[y], r.bounds[y]) && !(fails && r.allowed > 0);
        });
        // Measurements that certainly fail have used up a part of the budget.
        allowance_.push_back(r.allowed - std::min(r.allowed, failed));
        scales_.push_back(std::move(misfits.scale));
        blocks_.push_back(std::move(misfits.functions));
    }

    /// What the weakest of `allowed` + 1 groups proves; `nowhere` when all prove that nothing is
    /// left.
    /// @param why  the weights of the groups
    [[nodiscard]] double least_reach(shared_unknowns const& unknowns, std::size_t j, bool upwards,
                                     std::size_t allowed, groups& why) const {
        double reach = nowhere;
        why.clear();
        auto left = blocks_;
        for (std::size_t group = 0; group <= allowed && reach < 1; ++group) {
            auto const cut = cut_program(unknowns.count, left)(j, upwards);
            if (cut.weights.empty()) return 1;
            std::vector<measurement_weight> measured;
            for (auto const& w : cut.weights) {
                measured.push_back({w.block, w.function, w.value * scales_[w.block][w.function]});
                if (allowance_[w.block] > 0) {
                    left[w.block].margin[w.function] = std::numeric_limits<double>::infinity();
                }
            }
            why.push_back(std::move(measured));
            bool const none = cut.empty && certified_empty(*known_, unknowns, why.back());
            if (none) continue;
            if (cut.empty) return 1;
            reach = std::max(reach, certified_reach(*known_, unknowns, why.back(), j, upwards));
        }
        return reach;
    }

    /// Measurements that certainly fail are groups of their own, which use up their experiment's
    /// outliers.
    [[nodiscard]] groups with_failing(groups why) const {
        std::vector<bool> used(known_->size(), false);
        for (auto const& group : why) {
            for (auto const& w : group) used[w.experiment] = true;
        }
        for (auto const& w : failing_) {
            if (used[w.experiment]) why.push_back({w});
        }
        return why;
    }

    response_list const* known_ = nullptr;
    std::vector<minimax_block> blocks_; ///< in units of e
    std::vector<std::vector<double>> scales_;
    std::vector<std::size_t> allowance_;
    std::vector<measurement_weight> failing_;
};

} // namespace sivid

#endif
