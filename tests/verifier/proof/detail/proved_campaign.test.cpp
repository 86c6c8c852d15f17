// SPDX-License-Identifier: MIT
#include <sivid/verifier/proof/detail/plain_proof.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("the chosen start proves existence where all starts do not") {
    auto const problem = plain_problem::make(0, 0, interval(1.5, 2.5));
    box const right{interval(0.495, 0.505)}, wrong{interval(0.8, 0.81)};
    proved_campaign<interval> without(problem, {}, {});
    CHECK(without.judge(without.learn(right), right) == run_finding::open);
    proved_campaign<interval> with(problem, {box{interval(2.0)}}, {});
    CHECK(with.judge(with.learn(right), right) == run_finding::explained);
    CHECK(with.runs() == 2);
    auto const known = with.learn(wrong);
    CHECK(known.refuted);
    CHECK(with.judge(known, wrong) == run_finding::refuted);
}

TEST_CASE("every experiment counts") {
    auto problem = plain_problem::make();
    problem.experiments.push_back(plain_problem::make(3).experiments[0]);
    box const truth{interval(0.499, 0.501)};
    proved_campaign<interval> both(problem, {}, {});
    CHECK(both.judge(both.learn(truth), truth) == run_finding::refuted);
    problem.experiments[1].outliers = 3;
    proved_campaign<interval> spared(problem, {}, {});
    auto const known = spared.learn(truth);
    CHECK(spared.judge(known, truth) == run_finding::explained);
    CHECK(spared.spread(known, truth, 0) > 0);
}
