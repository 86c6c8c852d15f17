// SPDX-License-Identifier: MIT
#include <sivid/paving/run/runge_kutta_run.hpp>

#include <sivid/enclosure/runge_kutta/implicit_tableau.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/response/local_response.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <vector>

using namespace sivid;

namespace {

run_options with(tableau const& method, run_maker make = &runge_kutta_run) {
    run_options options;
    options.method = method;
    options.make = make;
    return options;
}

} // namespace

TEST_CASE("a Runge-Kutta method is never ignored: Taylor models take it, or refuse") {
    auto const problem = plain_problem::make();
    auto const& e = problem.experiments[0];
    flow const f(problem.model, problem.choice, e.inputs);
    auto const samples = sorted(e.measurements);
    CHECK_THROWS_AS(make_run(f, e, samples, problem.prior, with(rk4(), nullptr)),
                    std::invalid_argument);
    CHECK_NOTHROW(make_run(f, e, samples, problem.prior, with(rk4())));
    auto first_order = with(rk4(), nullptr);
    first_order.set = carried_set::doubleton;
    CHECK_NOTHROW(make_run(f, e, samples, problem.prior, first_order));
    CHECK_THROWS_AS(runge_kutta_run(f, e, samples, e.initial, box(4), run_options{}),
                    std::invalid_argument); // no method
    box const wide(std::vector<interval>(4, interval(0, 1)));
    CHECK_NOTHROW(runge_kutta_run(f, e, samples, e.initial, wide, with(rk4())));
}

TEST_CASE("responses by Runge-Kutta hold the exact outputs") {
    auto const problem = plain_problem::make();
    auto const& e = problem.experiments[0];
    flow const f(problem.model, problem.choice, e.inputs);
    auto const samples = sorted(e.measurements);
    for (auto const& method : {rk4(), gauss4(), heun()}) {
        CAPTURE(method.name);
        auto options = with(method);
        if (method.order == 2) options.tolerance = options.relative_tolerance = 1e-3;
        auto const run = make_run(f, e, samples, problem.prior, options);
        box const region{interval(0.45, 0.55)};
        auto const answer = (*run)(e.initial, region);
        REQUIRE(answer->outputs() == samples.size());
        for (double a = 0.45; a <= 0.55; a += 0.02) {
            auto const ranges = output_ranges(*answer, box{interval(a)});
            for (std::size_t k = 0; k < samples.size(); ++k) {
                double const exact = 2 * std::exp(-a * samples[k].time);
                CHECK(ranges[k].lower() <= exact + 1e-12);
                CHECK(exact <= ranges[k].upper() + 1e-12);
                CHECK(width(ranges[k]) < 0.02);
            }
        }
    }
}

TEST_CASE("identification by Runge-Kutta finds what is feasible, with every set") {
    auto const problem = plain_problem::make();
    auto const exact = plain_problem::feasible();
    for (auto const set : {carried_set::taylor_model, carried_set::doubleton}) {
        for (bool const contracting : {true, false}) {
            identify_options options;
            if (!contracting) options = by_bisection(options);
            static_cast<run_options&>(options.test) = with(rk4());
            options.test.set = set;
            auto const found = identify(problem, options);
            CHECK(found.verdict == verdict::consistent);
            CHECK(found.hull[0].lower() <= exact.lower() + 1e-12);
            CHECK(exact.upper() <= found.hull[0].upper() + 1e-12);
            CHECK(width(found.hull[0]) < width(exact) + 0.1);
        }
    }
}
