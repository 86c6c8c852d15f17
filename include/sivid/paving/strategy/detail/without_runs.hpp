// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_DETAIL_WITHOUT_RUNS_HPP
#define SIVID_PAVING_STRATEGY_DETAIL_WITHOUT_RUNS_HPP

/// @file
/// Contractors that integrate no trajectory: state equations between samples see many measurements
/// together, interval observers see states that no channel shows.

#include <sivid/model/problem.hpp>
#include <sivid/paving/observer/detail/observer_contraction.hpp>
#include <sivid/paving/relation/relation_contraction.hpp>
#include <sivid/paving/run/detail/lending_pool.hpp>
#include <sivid/paving/strategy/contractor.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace sivid::paving_detail {

/// Why neither is for a model.
inline std::string delays_in(identification_problem const& problem) {
    return problem.model.has_memory() ? "the model has delays" : "";
}

class equation_contractor : public contractor {
public:
    [[nodiscard]] std::string name() const override { return "state equations"; }
    [[nodiscard]] std::string obstacle(identification_problem const& problem) const override {
        return delays_in(problem);
    }
    [[nodiscard]] leftover operator()(inquiry& asked, work_limit const& limit,
                                      contraction_record&) const override {
        return {contract_by_relations(asked.problem(), {.keep_going = limit})};
    }
    /// Parts of what rests are excluded soon or not at all.
    [[nodiscard]] part_test for_parts(identification_problem const& problem,
                                      std::function<bool()> const& keep_going) const override {
        return relation_test(problem, {.keep_going = keep_going, .rounds = 1, .cells_per_gap = 2});
    }
};

class observer_contractor : public contractor {
public:
    [[nodiscard]] std::string name() const override { return "interval observers"; }
    [[nodiscard]] std::string obstacle(identification_problem const& problem) const override {
        return delays_in(problem);
    }
    [[nodiscard]] leftover operator()(inquiry& asked, work_limit const& limit,
                                      contraction_record&) const override {
        auto const& problem = asked.problem();
        return {observer_contraction(problem, {.keep_going = limit})(problem.prior)};
    }
    [[nodiscard]] part_test for_parts(identification_problem const& problem,
                                      std::function<bool()> const& keep_going) const override {
        auto const pool =
            std::make_shared<lending_pool<observer_contraction>>([&problem, keep_going] {
                return observer_contraction(problem, {.keep_going = keep_going, .rounds = 6});
            });
        return [pool](box const& x) -> assessment<> {
            auto rest = (*pool->borrow())(x);
            if (is_empty(rest)) return {.verdict = box_verdict::outside, .rest = x};
            return {.rest = std::move(rest)};
        };
    }
};

} // namespace sivid::paving_detail

#endif
