// SPDX-License-Identifier: MIT
// Failures are values: what was proved stays, and a sentence says what to do.
#include <sivid/enclosure/failure.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/parametric_sets.hpp"
#include "support/random.hpp"
#include "support/sampling.hpp"

#include <sivid/enclosure/methods.hpp>
#include <sivid/enclosure/taylor/parametric_flow.hpp>
#include <sivid/enclosure/tube.hpp>

#include <cmath>
#include <functional>
#include <set>
#include <string>

using namespace sivid;
using support::between;

namespace {

struct engine {
    std::string name;
    std::function<std::optional<enclosure_failure>(flow const&, box const&, box const&, double)>
        run;
};

template <class Run>
engine engine_of(std::string name, enclosure_options const& o) {
    return {std::move(name), [o](flow const& f, box const& x, box const& p, double end) {
                Run run(f, o);
                run.begin(0, x, p);
                while (run.time() < end && run.step(end)) {
                }
                auto const why = run.failure();
                if (why) CHECK(why->time == run.time());
                return why;
            }};
}

std::vector<engine> engines() {
    enclosure_options o;
    o.order = 6;
    o.tolerance = 1e-7;
    o.minimum_step = 1e-4;
    using tube = trajectory<interval>;
    using models = support::sized_flow<2, 2>;
    std::vector<engine> all{engine_of<tube>("doubletons", o),
                            engine_of<models>("Taylor models", o)};
    o.method = rk4();
    all.push_back(engine_of<tube>("doubletons, RK4", o));
    o.method = radau_iia5();
    all.push_back(engine_of<tube>("doubletons, Radau IIA", o));
    return all;
}

} // namespace

TEST_CASE("each reason and advice has its own words") {
    std::set<std::string> words;
    for (auto r : {failure_reason::minimum_step, failure_reason::undefined,
                   failure_reason::too_wide, failure_reason::step_limit, failure_reason::not_finite,
                   failure_reason::unsolved_stages, failure_reason::cancelled}) {
        words.insert(std::string(to_string(r)));
    }
    for (auto a :
         {advice::smaller_box, advice::higher_order, advice::more_steps, advice::shorter_steps,
          advice::other_set, advice::higher_degree, advice::nothing}) {
        words.insert(std::string(to_string(a)));
    }
    CHECK(words.size() == 14);
    CHECK(words.count("") == 0);
    enclosure_failure f{failure_reason::too_wide, 1.5, 2, advice::smaller_box};
    CHECK(f.message("psi", "s") ==
          "enclosure stopped at t = 1.5 s (state psi): the enclosure grew too "
          "wide; split the box of parameters and initial states");
    f.reason = failure_reason::undefined;
    f.until = 1.50390625;
    f.note(domain_edge{3, false, operation::log, -1e-3, 2});
    CHECK(f.component == 3);
    CHECK_THAT(f.message("v", "ms"),
               ContainsSubstring("(state v, last step tried of 0.00390625 ms)") &&
                   ContainsSubstring("(log of a value in [-0.001, 2])"));
    CHECK(domain_edge{0, true, operation::div, -1, 1}.text() ==
          "division by a value in [-1, 1], in a derivative");
}

TEST_CASE("no text claims more time than was proved") {
    CHECK(short_text_down(0.5) == "0.5");
    CHECK(short_text_down(-0.5) == "-0.5");
    CHECK(short_text(HUGE_VAL) == "inf");
    support::draws d(88);
    for (int k = 0; k < 20'000; ++k) {
        double const t =
            d.coin() ? 1 - std::pow(10, -d.uniform(0, 16)) : std::pow(10, d.uniform(-12, 12));
        double const shown = std::stod(short_text_down(t));
        REQUIRE(shown <= t);
        REQUIRE(t - shown <= 1e-5 * t);
    }
}

TEST_CASE("what is likely to help follows from what failed") {
    using r = failure_reason;
    CHECK(advise(r::too_wide, true, 1, 0.1) == advice::smaller_box);
    CHECK(advise(r::too_wide, true, 0.1, 1) == advice::other_set);
    CHECK(advise(r::too_wide, false, 0, 1e-3) == advice::higher_order); // a point is not split
    CHECK(advise(r::minimum_step, true, 1, 0.1) == advice::smaller_box);
    CHECK(advise(r::not_finite, true, HUGE_VAL, std::nan("")) == advice::other_set);
    CHECK(advise(r::undefined, true, 1, 0.1) == advice::smaller_box);
    CHECK(advise(r::undefined, false, 0, 0) == advice::nothing);
    CHECK(advise(r::step_limit, true, 0.1, 1) == advice::more_steps);
    CHECK(advise(r::unsolved_stages, true, 1, 0.1) == advice::shorter_steps);
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
    enclosure_options stopped;
    stopped.maximum_step = 0.01;
    int asked = 0;
    stopped.keep_going = [&asked] { return ++asked <= 7; };
    auto const part = integrate<interval>(f, box{interval(1.0)}, box{}, 0, 1, stopped);
    REQUIRE(part.failure());
    CHECK(part.failure()->reason == failure_reason::cancelled);
    CHECK(part.failure()->help == advice::nothing);
    CHECK(part.steps().size() == 7);
    CHECK(contains(part.at(0.05)[0], std::exp(0.05)));
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

TEST_CASE("every engine names the state that blows up, and where") {
    auto const f = support::flow_of(
        support::model_of({3, 0, 0, 1e6}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{-x[0], sqr(x[1]), x[0] - x[2]};
        }));
    interval const one(1.0);
    for (auto const& e : engines()) {
        CAPTURE(e.name);
        auto const point = e.run(*f, box{one, one, one}, box{}, 2);
        REQUIRE(point);
        CHECK(point->time < 1);
        CHECK(point->time > 0.8);
        CHECK(point->component == 1);
        CHECK(point->until >= point->time);
        CHECK(point->until < 1.2);
        CHECK(point->help != advice::smaller_box);
        auto const wide = e.run(*f, box{one, between(0.98, 1.02), one}, box{}, 2);
        REQUIRE(wide);
        CHECK(wide->time < 1 / 1.02);
        CHECK(wide->component == 1);
        CHECK(wide->spread + wide->lost >= 0.02);
        bool const models = std::string(e.name).find("Taylor models") != std::string::npos;
        CHECK((wide->help == advice::smaller_box ||
               wide->help == (models ? advice::higher_degree : advice::other_set)));
    }
}

TEST_CASE("every engine names the state in whose rate a function is not defined") {
    auto const f = support::flow_of(
        support::model_of({2, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{-x[0], -(p[0] * sqrt(x[1]))}; // x1 reaches 0 at t = 2
        }));
    interval const one(1.0);
    for (auto const& e : engines()) {
        CAPTURE(e.name);
        auto const point = e.run(*f, box{one, one}, box{one}, 3);
        REQUIRE(point);
        CHECK(point->time < 2);
        CHECK(point->time > 1);
        CHECK(point->component == 1);
        auto const wide = e.run(*f, box{one, between(-0.1, 1)}, box{one}, 3);
        REQUIRE(wide);
        CHECK(wide->time == 0);
        CHECK(wide->reason == failure_reason::undefined);
        REQUIRE(wide->edge);
        CHECK(wide->edge->state == 1);
        CHECK(wide->component == 1);
        CHECK(wide->edge->function == operation::sqrt);
        CHECK(wide->edge->lower <= -0.1);
        CHECK(wide->edge->upper >= 1);
        CHECK(wide->help == advice::smaller_box);
        auto const outside = e.run(*f, box{one, interval(-1.0)}, box{one}, 3);
        REQUIRE(outside);
        CHECK(outside->reason == failure_reason::undefined);
        CHECK(outside->component == 1);
        CHECK(outside->help == advice::nothing);
    }
}

TEST_CASE("every engine names the state that no step was proved for") {
    auto const f = support::flow_of(support::model_of(
        {2, 0, 0, 1e300}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{x[0], 1e7 * exp(x[1])};
        }));
    for (auto const& e : engines()) {
        CAPTURE(e.name);
        auto const wide = e.run(*f, box{interval(0.0), between(0, 1)}, box{}, 1);
        REQUIRE(wide);
        CHECK(wide->time == 0);
        CHECK(wide->component == 1);
    }
}
