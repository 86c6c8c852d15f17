// SPDX-License-Identifier: MIT
// Failures are values: what was proved stays, and a sentence says what to do.
#include <sivid/enclosure/failure.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/sampling.hpp"

#include <sivid/enclosure/tube.hpp>

#include <cmath>
#include <set>
#include <string>

using namespace sivid;
using support::between;

TEST_CASE("each reason and advice has its own words") {
    std::set<std::string> words;
    for (auto r : {failure_reason::minimum_step, failure_reason::undefined,
                   failure_reason::too_wide, failure_reason::step_limit, failure_reason::not_finite,
                   failure_reason::unsolved_stages}) {
        words.insert(std::string(to_string(r)));
    }
    for (auto a : {advice::smaller_box, advice::higher_order, advice::more_steps,
                   advice::check_model, advice::shorter_steps}) {
        words.insert(std::string(to_string(a)));
    }
    CHECK(words.size() == 11);
    CHECK(words.count("") == 0);
    enclosure_failure const f{failure_reason::too_wide, 1.5, 2, advice::smaller_box};
    CHECK_THAT(f.message("psi"), ContainsSubstring("1.5") && ContainsSubstring("psi") &&
                                     ContainsSubstring("too wide") && ContainsSubstring("split"));
}

TEST_CASE("a solution that blows up is enclosed up to the time that can be proved") {
    auto const f = support::flow_of(
        support::model_of({1, 0, 0, 1e6}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{sqr(x[0])};
        }));
    auto const tube = integrate<interval>(f, box{interval(1.0)}, box{}, 0, 2);
    REQUIRE_FALSE(tube.complete());
    CHECK(tube.end_time() < 1); // x = 1/(1 - t)
    CHECK(tube.end_time() > 0.9);
    CHECK(tube.failure()->time == tube.end_time());
    CHECK(tube.failure()->component == 0);
    for (double const share : {0.1, 0.5, 0.9, 1.0}) {
        double const t = share * tube.end_time();
        CHECK(support::encloses_reference(tube.at(t)[0], 1 / (1 - support::extended(t)), 1e-9));
    }
    CHECK_THROWS_AS(tube.at(1), std::out_of_range);
}

TEST_CASE("the end of a domain stops the enclosure, not the program") {
    auto const root = support::flow_of(
        support::model_of({1, 0}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{-sqrt(x[0])};
        }));
    auto const tube = integrate<interval>(root, box{interval(1.0)}, box{}, 0, 3); // 0 at t = 2
    REQUIRE_FALSE(tube.complete());
    CHECK(tube.end_time() < 2);
    CHECK(tube.end_time() > 1.5);
    auto const pole = support::flow_of(
        support::model_of({1, 0}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{1 / x[0]};
        }));
    auto const across = integrate<interval>(pole, box{between(-1, 1)}, box{}, 0, 1);
    REQUIRE_FALSE(across.complete());
    CHECK(across.failure()->reason == failure_reason::undefined);
    CHECK(across.end_time() == 0);
    CHECK_FALSE(across.failure()->message("x").empty());
    auto const never = support::flow_of(
        support::model_of({1, 0}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{log(x[0])};
        }));
    auto const nowhere = integrate<interval>(never, box{interval(-1.0)}, box{}, 0, 1);
    CHECK(nowhere.failure()->reason == failure_reason::undefined);
    // Undefined for a parameter alone, and for a time.
    auto const constant = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{sqrt(p[0]) * x[0]};
        }));
    CHECK(integrate<interval>(constant, box{interval(1.0)}, box{between(-1, 1)}, 0, 1)
              .failure()
              ->reason == failure_reason::undefined);
    auto const timed = support::flow_of(
        support::model_of({1, 0}, [](auto const& t, auto const& x, auto const&, auto const&) {
            return std::vector{sqrt(1 - t) + 0 * x[0]};
        }));
    CHECK(integrate<interval>(timed, box{interval(1.0)}, box{}, 0, 2).end_time() <= 1);
}

TEST_CASE("limits of steps and widths are kept") {
    auto const f = support::flow_of(
        support::model_of({1, 0, 0, 2}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{x[0]};
        }));
    enclosure_options few;
    few.maximum_steps = 3;
    few.maximum_step = 0.01;
    auto const tube = integrate<interval>(f, box{interval(1.0)}, box{}, 0, 1, few);
    REQUIRE(tube.failure());
    CHECK(tube.failure()->reason == failure_reason::step_limit);
    CHECK(tube.failure()->help == advice::more_steps);
    CHECK(tube.steps().size() == 3);
    auto const wide = integrate<interval>(f, box{between(-1, 1)}, box{}, 0, 5);
    REQUIRE(wide.failure());
    CHECK(wide.failure()->reason == failure_reason::too_wide);
    CHECK(wide.end_time() > 0.5);
    CHECK(width(wide.at(wide.end_time())) > 4); // twice its own range
}

TEST_CASE("a step that cannot be proved says so") {
    // A vector field too rough for the shortest step.
    auto const f = support::flow_of(support::model_of(
        {1, 0, 0, 1e300}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{1e6 * exp(x[0])};
        }));
    enclosure_options o;
    o.minimum_step = 1e-3;
    auto const tube = integrate<interval>(f, box{between(0, 1)}, box{}, 0, 1, o);
    REQUIRE(tube.failure());
    CHECK(tube.failure()->reason == failure_reason::minimum_step);
    CHECK(tube.end_time() == 0);
}
