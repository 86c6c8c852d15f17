// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_RANKING_DETAIL_OTHERS_LEAVE_HPP
#define SIVID_DECISION_RANKING_DETAIL_OTHERS_LEAVE_HPP

#include <sivid/decision/ranking/measurement_group.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/response/local_response.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace sivid::decision_detail {

/// Tests boxes against what a group of measurements excludes and the others leave.
///   outside: infeasible for the others, or every start meets the whole group; inside: explained by
///   the others, and no start meets the group with the outliers that its experiment allows.
class others_leave {
public:
    static constexpr bool concurrent = true;

    /// What the others know, and the responses of the group's measurements alone.
    struct knowledge {
        std::shared_ptr<feasibility_test::knowledge const> others;
        response_list group;
    };

    /// @param problem  kept by reference
    others_leave(identification_problem const& problem, measurement_group const& group,
                 feasibility_test_options const& options, std::vector<box> starts)
        : problem_(&problem),
          sharp_enough_(options.sharp_enough),
          without_(without(problem, group)),
          others_(without_, options) {
        if (!starts.empty()) others_.set_starts(std::move(starts));
        for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
            auto const samples = sorted(problem.experiments[e].measurements);
            auto& mine = members_.emplace_back();
            for (std::size_t k = 0; k < samples.size(); ++k)
                if (group.holds(e, samples[k])) mine.push_back({k, samples[k].bound});
        }
    }
    others_leave(others_leave const&) = delete;
    others_leave& operator=(others_leave const&) = delete;

    /// The others leave nothing outside of this (trusted).
    void set_rest(box rest) { others_.set_rest(std::move(rest)); }

    /// The problem in which a group's measurements may read anything.
    [[nodiscard]] static identification_problem without(identification_problem problem,
                                                        measurement_group const& group) {
        for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
            for (auto& m : problem.experiments[e].measurements)
                if (group.holds(e, m)) m.bound = interval_traits<interval>::entire();
        }
        return problem;
    }

    [[nodiscard]] assessment<knowledge> judge(box const& x,
                                              std::shared_ptr<knowledge const> const& known) const {
        auto found = others_.judge(x, known ? known->others : nullptr);
        if (!known) return plain(std::move(found));
        auto [result, share] = compared(std::move(found), *known);
        result.blind =
            result.verdict == box_verdict::undecided && (result.blind || share > sharp_enough_);
        if (!result.blind) result.knowledge = known;
        return std::move(result);
    }
    [[nodiscard]] std::vector<assessment<knowledge>> learn(std::vector<box> const& boxes) {
        std::vector<assessment<knowledge>> results;
        for (auto& found : others_.learn(boxes)) {
            if (!found.knowledge) {
                results.push_back(plain(std::move(found)));
                continue;
            }
            auto known = std::make_shared<knowledge>();
            known->others = found.knowledge;
            for (std::size_t e = 0; e < members_.size(); ++e)
                known->group.push_back(of_members(e, *known->others->all_starts[e]));
            results.push_back(compared(std::move(found), *known).first);
            results.back().knowledge = std::move(known);
        }
        return results;
    }
    [[nodiscard]] std::size_t at_once() const { return others_.at_once(); }
    [[nodiscard]] bool cancelled() const { return others_.cancelled(); }
    [[nodiscard]] std::size_t integrations() const { return others_.integrations(); }
    [[nodiscard]] static std::size_t bytes(knowledge const& known) {
        auto sum = sizeof(knowledge) + feasibility_test::bytes(*known.others);
        for (auto const& r : known.group) sum += r->bytes();
        return sum;
    }

private:
    struct member {
        std::size_t place; ///< among the measurements, in the order of time
        interval bound;
    };

    /// The measurements of the group that a response has reached, with their own bounds.
    [[nodiscard]] std::shared_ptr<response const> of_members(std::size_t e,
                                                             response const& all) const {
        auto result = std::make_shared<response>(response{all.unknowns,
                                                          all.table,
                                                          {},
                                                          {},
                                                          {},
                                                          {},
                                                          members_[e].size(),
                                                          problem_->experiments[e].outliers});
        for (auto const& m : members_[e]) {
            if (m.place >= all.outputs()) break;
            result->radius.push_back(all.radius[m.place]);
            if (!all.lasting.empty()) result->lasting.push_back(all.lasting[m.place]);
            result->bounds.push_back(m.bound);
        }
        for (std::size_t row = 0; row < all.table->size(); ++row) {
            for (std::size_t k = 0; k < result->outputs(); ++k)
                result->coefficients.push_back(
                    all.coefficients[row * all.outputs() + members_[e][k].place]);
        }
        return result;
    }

    /// What the others say.
    [[nodiscard]] static assessment<knowledge>
    plain(assessment<feasibility_test::knowledge> found) {
        assessment<knowledge> result{.verdict = found.verdict, .rest = std::move(found.rest)};
        result.smear = std::move(found.smear);
        result.blind = found.blind;
        result.cost = found.cost;
        return result;
    }
    /// What the others say, against what the group does; and the largest share of one of its
    /// outputs' width that does not shrink with the box.
    [[nodiscard]] std::pair<assessment<knowledge>, double>
    compared(assessment<feasibility_test::knowledge> found, knowledge const& known) const {
        auto result = plain(std::move(found));
        if (result.verdict == box_verdict::outside) return {std::move(result), 0};
        result.smear.resize(result.rest.size(), 0.0);
        bool met = true, missed = false;
        double share = 0;
        for (std::size_t e = 0; e < members_.size(); ++e) {
            auto const& group = *known.group[e];
            auto part = result.rest;
            auto const says = assess(group, part);
            met = met && says.held == group.measurements;
            missed = missed || says.refuted;
            for (std::size_t j = 0; j < part.size(); ++j) result.smear[j] += says.smear[j];
            share = std::max(share, group.outputs() < group.measurements ? detail::infinity
                                                                         : says.sharpness);
        }
        result.verdict = met                                               ? box_verdict::outside
                         : missed && result.verdict == box_verdict::inside ? box_verdict::inside
                                                                           : box_verdict::undecided;
        return {std::move(result), share};
    }

    identification_problem const* problem_;
    double sharp_enough_;
    identification_problem without_;
    feasibility_test others_;
    std::vector<std::vector<member>> members_; ///< by experiment
};

} // namespace sivid::decision_detail

#endif
