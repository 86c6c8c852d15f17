// SPDX-License-Identifier: MIT
#include <sivid/verifier/proof/detail/plain_proof.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <vector>

using namespace sivid;

namespace {

/// x'' = -a sin x, the angle is measured.
struct pendulum {
    static constexpr auto name = "pendulum";
    static constexpr auto states = sivid::states({{"x", "rad", 10}, {"v", "rad/s", 10}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "rad"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"a", "1/s^2", 1_dec}});
    }();
    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 1> const& c, vec<T, 0> const&) const {
        return {x[1], -(c[0] * sin(x[0]))};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 2> const& x, vec<T, 1> const&, vec<T, 0> const&) const {
        return {x[0]};
    }
};

constexpr double bound = 0.02;
constexpr std::size_t samples = 30;

/// The angle at every half second, for a from (x, v), by small steps.
std::vector<double> swing(double a, double x, double v) {
    std::vector<double> seen;
    double const h = 1e-3;
    for (std::size_t k = 0; k < samples; ++k) {
        for (int step = 0; step < 500; ++step) { // of order four
            double const k1 = -a * std::sin(x), k2 = -a * std::sin(x + h / 2 * v);
            double const k3 = -a * std::sin(x + h / 2 * (v + h / 2 * k1));
            double const k4 = -a * std::sin(x + h * (v + h / 2 * k2));
            x += h * (v + h / 6 * (k1 + k2 + k3));
            v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
        seen.push_back(x);
    }
    return seen;
}

/// Fifteen seconds, a = 1 from (2.05, 0.03); the first `spoilt` samples are moved.
identification_problem swings(interval x, interval v, std::size_t spoilt = 0) {
    experiment run;
    run.name = "swings";
    run.initial = {x, v};
    auto const seen = swing(1, 2.05, 0.03);
    for (std::size_t k = 0; k < samples; ++k) {
        double const y = seen[k] + (k < spoilt ? 1 : 0);
        double const t = 0.5 * static_cast<double>(k + 1);
        run.measurements.push_back({t, 0, interval(y - bound, y + bound)});
    }
    run.outliers = spoilt;
    return {record_model<pendulum>(), {{"a"}, {}}, {interval(0.8, 1.2)}, {run}};
}

} // namespace

TEST_CASE("starts are found in long experiments, which cannot be followed from all starts") {
    for (std::size_t const spoilt : {0u, 2u}) {
        CAPTURE(spoilt);
        auto const problem = swings({1.8, 2.2}, {-0.1, 0.1}, spoilt);
        auto const& run = problem.experiments[0];
        box const truth{interval(0.9996, 1.0004)};
        proved_campaign<interval> seeking(problem, {}, {});
        auto const known = seeking.learn(truth);
        CHECK(known.all[0].outputs.size() < samples);
        REQUIRE(seeking.judge(known, truth) == run_finding::explained);
        CHECK(seeking.runs() <= 8);
        // The starts of the rule explain, by simulation.
        auto const& guide = known.guide[0];
        REQUIRE(subset(guide, run.initial));
        plain_start_rule<interval> const found(known.guided[0], run.measurements, guide, truth);
        auto const rule = found.search(spoilt, true);
        REQUIRE(rule);
        for (double const d : {-1.0, -0.3, 0.0, 0.6, 1.0}) {
            double start[2] = {};
            for (std::size_t i = 0; i < 2; ++i) {
                start[i] = mid(guide[i]) + rad(guide[i]) * (rule->middle[i] + d * rule->slope[i]);
                CHECK(contains(guide[i], start[i]));
            }
            auto const seen = swing(1 + 0.0004 * d, start[0], start[1]);
            std::size_t held = 0;
            for (std::size_t k = 0; k < samples; ++k) {
                held += contains(run.measurements[k].bound, seen[k]) ? 1 : 0;
            }
            CHECK(held >= samples - spoilt);
        }
        // The region beside it begins where this one ended.
        box const next{interval(1.0004, 1.0010)};
        auto const before = seeking.runs();
        CHECK(seeking.judge(seeking.learn(next), next) == run_finding::explained);
        CHECK(seeking.runs() <= before + 4);
    }
}

TEST_CASE("what no start in its box explains is not confirmed") {
    box const truth{interval(0.9996, 1.0004)};
    auto const judged = [](identification_problem const& problem, box const& region) {
        proved_campaign<interval> seeking(problem, {}, {});
        return seeking.judge(seeking.learn(region), region);
    };
    auto const problem = swings({1.8, 2.2}, {-0.1, 0.1});
    CHECK(judged(problem, box{interval(1.05, 1.051)}) != run_finding::explained);
    CHECK(judged(problem, box{interval(0.9996, 1.05)}) != run_finding::explained);
    CHECK(judged(problem, truth) == run_finding::explained);
    CHECK(judged(swings({1.8, 1.95}, {-0.1, 0.1}), truth) != run_finding::explained);
    CHECK(judged(swings({2.02, 2.2}, {-0.1, 0.1}), truth) == run_finding::explained);
    // One sample that is wrong is one too many.
    auto spoilt = swings({1.8, 2.2}, {-0.1, 0.1}, 1);
    CHECK(judged(spoilt, truth) == run_finding::explained);
    spoilt.experiments[0].outliers = 0;
    CHECK(judged(spoilt, truth) != run_finding::explained);
}

TEST_CASE("the chosen start proves existence where all starts do not") {
    auto const problem = plain_problem::make(0, 0, interval(1.5, 2.5));
    box const right{interval(0.495, 0.505)}, wrong{interval(0.8, 0.81)};
    proved_campaign<interval> without(problem, {}, {});
    CHECK(without.judge(without.learn(right, false), right) == run_finding::open);
    proved_campaign<interval> with(problem, {box{interval(2.0)}}, {});
    CHECK(with.judge(with.learn(right), right) == run_finding::explained);
    CHECK(with.runs() == 2);
    auto const known = with.learn(wrong);
    CHECK(known.refuted);
    CHECK(with.judge(known, wrong) == run_finding::refuted);
}

TEST_CASE("starts are found where none are given, and none are where there are none") {
    auto const problem = plain_problem::make(0, 0, interval(1.5, 2.5));
    box const right{interval(0.495, 0.505)};
    proved_campaign<interval> seeking(problem, {}, {});
    CHECK(seeking.judge(seeking.learn(right), right) == run_finding::explained);
    CHECK(seeking.runs() == 3); // all starts, one, those near the rule
    // The bounds allow x(0) e^(-a t) to differ by 0.05 from 2 e^(-t / 2): a = 0.53 with 2.04, not
    // with 2.
    auto const f = plain_problem::feasible();
    box const beyond{interval(f.upper() + 1e-3, f.upper() + 6e-3)};
    auto const known = seeking.learn(beyond);
    CHECK(seeking.judge(known, beyond) == run_finding::explained);
    CHECK(lower(known.guide[0][0]) > 2);
    auto const narrow = plain_problem::make(0, 0, interval(1.99, 2.0));
    proved_campaign<interval> strict(narrow, {}, {});
    CHECK(strict.judge(strict.learn(beyond), beyond) != run_finding::explained);
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
