// SPDX-License-Identifier: MIT
#include <sivid/paving/plain_campaign.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("the chosen start proves existence where all starts do not") {
    auto const problem = plain_problem::make(0, 0, interval(1.5, 2.5));
    box const right{interval(0.495, 0.505)}, wrong{interval(0.8, 0.81)};
    plain_campaign<interval> without(problem, {}, {});
    CHECK(without.judge(without.learn(right, false), right) == run_finding::open);
    plain_campaign<interval> with(problem, {box{interval(2.0)}}, {});
    CHECK(with.judge(with.learn(right), right) == run_finding::explained);
    CHECK(with.runs() == 2);
    auto const known = with.learn(wrong);
    CHECK(known.refuted);
    CHECK(with.judge(known, wrong) == run_finding::refuted);
}

TEST_CASE("starts are found where none are given, and none are where there are none") {
    auto const problem = plain_problem::make(0, 0, interval(1.5, 2.5));
    box const right{interval(0.495, 0.505)};
    plain_campaign<interval> seeking(problem, {}, {});
    CHECK(seeking.judge(seeking.learn(right), right) == run_finding::explained);
    CHECK(seeking.runs() == 2);
    // The bounds allow x(0) e^(-a t) to differ by 0.05 from 2 e^(-t / 2): a = 0.53 with 2.04, not
    // with 2.
    auto const f = plain_problem::feasible();
    box const beyond{interval(f.upper() + 1e-3, f.upper() + 6e-3)};
    auto const known = seeking.learn(beyond);
    CHECK(seeking.judge(known, beyond) == run_finding::explained);
    CHECK(lower(known.guide[0][0]) > 2);
    auto const narrow = plain_problem::make(0, 0, interval(1.99, 2.0));
    plain_campaign<interval> strict(narrow, {}, {});
    CHECK(strict.judge(strict.learn(beyond), beyond) != run_finding::explained);
}

TEST_CASE("every experiment counts") {
    auto problem = plain_problem::make();
    problem.experiments.push_back(plain_problem::make(3).experiments[0]);
    box const truth{interval(0.499, 0.501)};
    plain_campaign<interval> both(problem, {}, {});
    CHECK(both.judge(both.learn(truth), truth) == run_finding::refuted);
    problem.experiments[1].outliers = 3;
    plain_campaign<interval> spared(problem, {}, {});
    auto const known = spared.learn(truth);
    CHECK(spared.judge(known, truth) == run_finding::explained);
    CHECK(spared.spread(known, truth, 0) > 0);
}
