// SPDX-License-Identifier: MIT
#include <sivid/io/problem_from_dataset.hpp>

#include "io/small_identification.hpp"
#include "support/catch.hpp"
#include "support/models.hpp"

using namespace sivid;

namespace {

exact_decimal dec(char const* text) { return exact_decimal::parse(text).value(); }

stated_range range(char const* low, char const* high) {
    return {dec(low), dec(high), *enclose(dec(low), dec(high))};
}

/// Two scenarios of io_support::two_rates: the second is held out.
dataset two_scenarios() {
    dataset data;
    data.id = "small";
    data.model = "two rates";
    data.parameters.push_back({1, "b", "1", range("0.1", "0.9")});
    data.fixed.push_back({0, dec("1.1"), *enclose(dec("1.1"))});
    data.max_outlier_fraction = dec("0.29");
    for (auto const role : {scenario_role::fit, scenario_role::holdout}) {
        scenario s;
        s.name = role == scenario_role::fit ? "F" : "H";
        s.role = role;
        s.duration = 100;
        s.initial.push_back({range("1.9", "2.1").enclosure, range("1.9", "2.1")});
        for (int k = 1; k <= 100; ++k) {
            s.measurements.push_back({1.0 * k, 0, interval(0.0, 2.0)});
            s.stated.push_back({dec("1"), dec("1")});
        }
        data.scenarios.push_back(s);
    }
    return data;
}

} // namespace

TEST_CASE("a problem holds the fit scenarios, priors, fixed constants and outlier budgets") {
    auto const problem =
        problem_from_dataset(two_scenarios(), record_model<io_support::two_rates>());
    CHECK_NOTHROW(problem.require_valid());
    CHECK(problem.choice.unknown == std::vector<std::string>{"b"});
    CHECK(problem.prior[0].lower() <= 0.1);
    CHECK(problem.prior[0].upper() >= 0.9);
    CHECK(contains(problem.choice.fixed.at("a"), 1.1));
    REQUIRE(problem.experiments.size() == 1);
    auto const& e = problem.experiments[0];
    CHECK(e.name == "F");
    CHECK(e.begin == 0);
    CHECK(e.measurements.size() == 100);
    CHECK(e.outliers == 29); // 0.29 * 100 exactly, though the double 0.29 is below
    CHECK(contains(e.initial[0], 1.9));
}

TEST_CASE("a budget of the caller replaces the data set's own") {
    auto const problem =
        problem_from_dataset(two_scenarios(), record_model<io_support::two_rates>(), 3);
    CHECK(problem.experiments[0].outliers == 3);
}

TEST_CASE("data of another model are refused") {
    auto data = two_scenarios();
    data.model = "hovercraft";
    CHECK_THROWS_WITH(problem_from_dataset(data, record_model<io_support::two_rates>()),
                      ContainsSubstring("hovercraft"));
    data = two_scenarios();
    data.scenarios[0].initial.clear();
    CHECK_THROWS_WITH(problem_from_dataset(data, record_model<io_support::two_rates>()),
                      ContainsSubstring("scenario 'F'"));
}

TEST_CASE("input errors become bounds of the signals, and what proofs assume says so") {
    auto data = two_scenarios();
    auto const model =
        support::model_of({1, 2, 1}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{u[0] - p[0] * p[1] * x[0]};
        });
    data.model = model.about.name;
    data.parameters[0].name = "p1";
    for (auto& s : data.scenarios) {
        s.initial.resize(model.about.states.size());
        s.inputs = {{sampled_signal({0, 1}, {1, 2}, interpolation::hold), {}, {}}};
    }
    auto problem = problem_from_dataset(data, model);
    CHECK_FALSE(any_uncertain(problem.experiments[0].inputs));
    CHECK(input_assumption(problem.experiments) == "inputs exact");
    data.scenarios[0].inputs[0].bridged = {{0, 1}};
    data.scenarios[0].inputs[0].missing = 4;
    CHECK(input_assumption(problem_from_dataset(data, model).experiments) ==
          "inputs exact; input " + model.about.inputs[0].name +
              ": held over 4 missing samples, longest gap 1 s");
    data.scenarios[0].inputs[0].bridged.clear();
    data.scenarios[0].inputs[0].error = {0.1, 0.25};
    problem = problem_from_dataset(data, model);
    auto const& u = std::get<sampled_signal>(problem.experiments[0].inputs[0]);
    CHECK(u.errors() == std::vector{0.1, 0.25});
    CHECK(u.kind() == interpolation::hold);
    CHECK(u.values() == std::vector{1.0, 2.0});
    CHECK(input_assumption(problem.experiments) == "inputs within their stated errors");
}
