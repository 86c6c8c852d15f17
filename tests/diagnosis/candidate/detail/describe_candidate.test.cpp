// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate/detail/describe_candidate.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("a candidate is described with names and units") {
    auto const catalogue = small_campaign::catalogue();
    screened s;
    s.figures = {{0, 2}, 3, 0.75, 100};
    s.problem = affected(small_campaign::problem(), {catalogue[0], catalogue[2]});
    s.fit.parameters = {1.0, 0.3, 0.1};
    auto const c = cause_of(s, catalogue, 1, 160);
    CHECK(c.effects == std::vector<std::string>{"quadratic", "scale"});
    CHECK(c.verdict == cause_verdict::undecided);
    CHECK(c.fitted_inflation == 0.75);
    CHECK(c.score > 300);
    REQUIRE(c.parameters.size() == 2); // the model's own ones are left out
    CHECK(c.parameters[0].name == "quadratic.k");
    CHECK(c.parameters[0].unit == "1/m");
    CHECK(c.parameters[1].value == 0.1);

    auto const w = named(s.problem, s.fit.parameters, {{0, 0.5}, {1, 2}});
    REQUIRE(w.parameters.size() == 3);
    CHECK(w.parameters[0].name == "k");
    REQUIRE(w.starts.size() == 2);
    CHECK(w.starts[1].scenario == "E2");
    CHECK(w.starts[1].states[1].name == "v");
    CHECK(w.starts[1].states[1].value == 2);
}

TEST_CASE("products that are told better than their factors are named by short names") {
    auto const catalogue = small_campaign::catalogue();
    auto const p = affected(small_campaign::problem(), {catalogue[0]});
    explained_hull hulls{box{interval(0.5, 2.0), interval(0.25, 1.0)}};
    combination const ratio{{-1, 2}, "quadratic.k^2/k", "1/m^2"};
    hulls.add({ratio, interval(0.2, 0.3)});
    hulls.add({{{1, 1}, "k*quadratic.k", "1/m"}, interval(0.125, 1.9)}); // as good as its factors
    auto const told = told_combinations(p, named_parameters(p, {1.0, 0.5}), hulls);
    REQUIRE(told.size() == 1);
    CHECK(told[0].about.name == "k^2/k");
    CHECK(told[0].about.unit == "1/m^2");
    CHECK(told[0].about.value == 0.25);
    REQUIRE(told[0].about.hull);
    CHECK(told[0].about.hull->lower() == 0.2);
    CHECK(told[0].about.hull->upper() == 0.3);
    REQUIRE(told[0].parts.size() == 2);
    CHECK(told[0].parts[1].name == "quadratic.k");
    CHECK(told[0].parts[1].number == 2);
    CHECK(told[0].of_effects);
    CHECK_FALSE(told[0].is_sum);

    hulls.products = {{{{0, 0}, "", "1", {1, -1}}, interval(0.4, 0.6)}};
    auto const sums = told_combinations(p, named_parameters(p, {1.0, 0.5}), hulls);
    REQUIRE(sums.size() == 1);
    CHECK(sums[0].about.name == "k - k");
    CHECK(sums[0].about.value == 0.5);
    CHECK(sums[0].is_sum);
    CHECK(sums[0].parts[1].number == -1);

    auto at_end = named_parameters(p, {1.0, 0.5});
    at_end[0].value = at_end[0].prior->upper();
    std::vector<constant_at_end> ends;
    add_constants_at_ends({}, at_end, ends, sums); // its value could be another
    CHECK(ends.empty());
    add_constants_at_ends({}, at_end, ends, told);
    CHECK(ends.size() == 1);
}
