// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/relation_windows.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

using namespace diagnosis_support;

namespace {

identification_problem pendulum_problem(draws& d, std::vector<std::size_t> const& shown,
                                        std::size_t experiments = 2) {
    identification_problem problem{pendulum(),
                                   {support::all_constants(3), {}},
                                   box{between(1, 10), between(0, 1), between(0.5, 2)},
                                   {}};
    for (std::size_t e = 0; e < experiments; ++e) {
        std::vector<sampled_signal> const inputs{sine_input(2, d.uniform(1, 3), 3)};
        auto const truth = simulate(problem.model, {5, 0.5, 1}, inputs, {d.uniform(-1, 1), 0}, 3);
        problem.experiments.push_back(
            measured(d, support::numbered('S', e), truth, inputs, shown, 0.02, noise::uniform));
    }
    return problem;
}

} // namespace

TEST_CASE("equations with all their sensors can be examined, by parts if a pair helps") {
    draws d(23);
    auto const problem = pendulum_problem(d, {0, 1});
    relation_windows windows(problem, {});
    CHECK(windows.obstacle(0).empty());
    CHECK(windows.obstacle(1).empty());
    CHECK(windows.ways(0) == std::vector{window_way::direct}); // x0 = int x1 says nothing new
    CHECK(windows.ways(1) == std::vector{window_way::direct, window_way::by_parts});
    CHECK(windows.rate_unit(1) == "1/s");
    auto const direct = windows.all(1, window_way::direct);
    auto const parts = windows.all(1, window_way::by_parts);
    REQUIRE(direct.size() == parts.size());
    CHECK(direct.size() > 500);
    bool sharper = false;
    for (std::size_t k = 0; k < direct.size(); ++k) {
        CHECK(contains(missing_rate_in(windows.row(1), direct[k]), 0));
        CHECK(contains(missing_rate_in(windows.row(1), parts[k]), 0));
        for (std::size_t j = 0; j < direct[k].a.size(); ++j) {
            CHECK(subset(parts[k].a[j], direct[k].a[j]));
            sharper = sharper || width(parts[k].a[j]) < 0.7 * width(direct[k].a[j]);
        }
        double const length = direct[k].to - direct[k].from;
        CHECK(length >= 0.3 - 1e-6);
    }
    CHECK(sharper);
}

TEST_CASE("too many windows are thinned out") {
    draws d(24);
    auto const problem = pendulum_problem(d, {0, 1});
    relation_options options;
    options.most_windows = 100;
    relation_windows windows(problem, options);
    auto const count = windows.all(1, window_way::direct).size();
    CHECK(count <= 100);
    CHECK(count > 50);
}

TEST_CASE("sensors and assumptions are named") {
    draws d(25);
    auto problem = pendulum_problem(d, {0, 1});
    relation_options options;
    options.rate_variation = {{"x1", 7.5}};
    relation_windows windows(problem, options);
    REQUIRE(windows.obstacle(1).empty());
    relation_finding direct;
    windows.describe(1, window_way::direct, {{1, 0.1}}, direct);
    CHECK(direct.channels == std::vector<std::string>{"y0", "y1"});
    REQUIRE(direct.assumptions.size() == 3);
    CHECK_THAT(direct.assumptions[0], StartsWith("x0' varies within 0.1 s by at most"));
    CHECK(direct.assumptions[1] == "x1' varies within 0.1 s by at most 7.5 1/s in S1");
    CHECK(direct.assumptions[2] == "inputs exact");
    relation_finding parts;
    windows.describe(1, window_way::by_parts, {{0, 1.0}, {1, 0.0}}, parts);
    CHECK(parts.assumptions.front() == "x0' = x1");
    CHECK(parts.assumptions.back() == "initial states in their boxes");
}

TEST_CASE("a rate that was not measured is examined through its integral") {
    draws d(26);
    auto const problem = pendulum_problem(d, {0});
    relation_windows windows(problem, {});
    CHECK(windows.obstacle(0) == "no measurement shows x1");
    CHECK(windows.obstacle(1).empty());
    CHECK(windows.ways(1) == std::vector{window_way::weak});
    CHECK_FALSE(windows.all(1, window_way::weak).empty());
    relation_finding f;
    windows.describe(1, window_way::weak, {{0, 0.1}}, f);
    CHECK(f.channels == std::vector<std::string>{"y0"});
    CHECK(f.assumptions.front() == "x0' = x1");
}

TEST_CASE("what stands in the way is said") {
    draws d(27);
    SECTION("no sensor") {
        auto const problem = pendulum_problem(d, {1});
        relation_windows windows(problem, {});
        CHECK(windows.obstacle(0) == "no measurement shows x0");
        CHECK(windows.obstacle(1) == "no measurement shows x0");
    }
    SECTION("outliers everywhere") {
        auto problem = pendulum_problem(d, {0, 1});
        problem.experiments[0].outliers = 1;
        relation_windows one(problem, {});
        CHECK(one.obstacle(1).empty());
        for (auto const& w : one.all(1, window_way::direct))
            CHECK(one.motion(w.motion).name == "S1");
        problem.experiments[1].outliers = 2;
        relation_windows none(problem, {});
        CHECK_THAT(none.obstacle(1), ContainsSubstring("outlier"));
    }
    SECTION("delays") {
        auto problem = pendulum_problem(d, {0, 1});
        problem.model.input_memory.push_back({0, 0});
        relation_windows windows(problem, {});
        CHECK(windows.obstacle(0) == "the model has delays, plays or rate limits");
    }
    SECTION("a coefficient without bounds") {
        identification_problem problem{
            support::model_of({1, 1, 0}, [](auto const&, auto const& x, auto const& p,
                                            auto const&) { return std::vector{x[0] / p[0]}; }),
            {{"p0"}, {}},
            box{between(-1, 1)},
            {}};
        experiment e;
        e.name = "S";
        e.initial = box{between(1, 1)};
        e.measurements = {{1.0, 0, between(0, 1)}};
        problem.experiments.push_back(e);
        relation_windows windows(problem, {});
        CHECK_THAT(windows.obstacle(0), ContainsSubstring("unbounded"));
    }
    SECTION("an invalid problem") {
        auto problem = pendulum_problem(d, {0, 1});
        problem.prior = box{between(0, 1)};
        CHECK_THROWS_AS(relation_windows(problem, {}), std::invalid_argument);
    }
}
