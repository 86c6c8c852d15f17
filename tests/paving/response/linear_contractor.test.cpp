// SPDX-License-Identifier: MIT
#include <sivid/paving/response/linear_contractor.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/power_series.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"

#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::mp;

namespace {

bool holds(linear_constraint const& c, std::vector<double> const& r) {
    mp sum = 0;
    for (std::size_t j = 0; j < r.size(); ++j) sum += mp(c.gradient[j]) * mp(r[j]);
    return mp(c.target.lower()) <= sum && sum <= mp(c.target.upper());
}
struct draw {
    box r;
    std::vector<linear_constraint> constraints;
};
draw random_problem(draws& d) {
    draw result{box(1 + d.below(4)), std::vector<linear_constraint>(1 + d.below(6))};
    for (std::size_t j = 0; j < result.r.size(); ++j) result.r[j] = d.interval(-1, 1, 1);
    for (auto& c : result.constraints) {
        for (std::size_t j = 0; j < result.r.size(); ++j) {
            c.gradient.push_back(d.below(4) == 0 ? 0 : d.uniform(-2, 2));
        }
        c.target = d.interval(-1.5, 1.5, 0.6);
        if (d.below(8) == 0) c.target = between(c.target.lower(), HUGE_VAL);
    }
    return result;
}

} // namespace

TEST_CASE("contraction keeps every point that satisfies all constraints") {
    draws d(311);
    int kept = 0;
    int contracted = 0;
    for (int round = 0; round < 3000; ++round) {
        auto problem = random_problem(d);
        auto const before = problem.r;
        std::vector<std::vector<double>> feasible;
        for (int k = 0; k < 30; ++k) {
            auto const x = d.in(before);
            bool good = true;
            for (auto const& c : problem.constraints) good = good && holds(c, x);
            if (good) feasible.push_back(x);
        }
        bool const left = contract(problem.r, problem.constraints);
        if (!feasible.empty()) CHECK(left);
        if (!left) continue;
        CHECK(subset(problem.r, before));
        contracted += width(problem.r) < 0.9 * width(before) ? 1 : 0;
        for (auto const& x : feasible) {
            ++kept;
            CHECK(contains(problem.r, x));
        }
    }
    CHECK(kept > 1000);
    CHECK(contracted > 200);
}

TEST_CASE("a contraction of one constraint is as sharp as its bounds allow") {
    box r{between(-1, 1), between(-1, 1)};
    REQUIRE(contract(r, linear_constraint{{2, 0}, between(1, 4)}));
    CHECK(r[0].lower() == 0.5);
    CHECK(r[0].upper() == 1);
    CHECK(r[1].lower() == -1);
    r = box{between(-1, 1), between(-1, 1)};
    REQUIRE(contract(r, linear_constraint{{1, 1}, between(1.5, 9)}));
    CHECK(r[0].lower() == 0.5);
    CHECK(r[1].lower() == 0.5);
    r = box{between(-1, 1), between(-1, 1)};
    CHECK_FALSE(contract(r, linear_constraint{{1, 1}, between(2.5, 3)}));
    r = box{between(-1, 1)};
    CHECK_FALSE(contract(r, linear_constraint{{0}, between(1, 2)}));
    CHECK_FALSE(contract(r, linear_constraint{{1}, interval_traits<interval>::empty()}));
}

TEST_CASE("relaxed contraction keeps every point that violates at most q constraints") {
    draws d(312);
    int kept = 0;
    int refuted = 0;
    for (int round = 0; round < support::swept(1000, 3000); ++round) {
        auto problem = random_problem(d);
        auto const q = d.below(problem.constraints.size() + 1);
        auto const before = problem.r;
        std::vector<std::vector<double>> feasible;
        for (int k = 0; k < 30; ++k) {
            auto const x = d.in(before);
            std::size_t broken = 0;
            for (auto const& c : problem.constraints) broken += holds(c, x) ? 0 : 1;
            if (broken <= q) feasible.push_back(x);
        }
        bool const left = relaxed_contract(problem.r, problem.constraints, q);
        if (!feasible.empty()) CHECK(left);
        refuted += left ? 0 : 1;
        if (!left) continue;
        for (auto const& x : feasible) {
            ++kept;
            CHECK(contains(problem.r, x));
        }
    }
    CHECK(kept > 5000);
    CHECK(refuted > support::swept(30, 100));
}
