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
