// SPDX-License-Identifier: MIT
#include <sivid/paving/fit.hpp>

#include "support/catch.hpp"
#include "support/problems.hpp"

#include <cmath>

using namespace sivid;
using support::draws;

TEST_CASE("easy problems are fitted within their bounds, outliers and unknown starts included") {
    draws d(341);
    int explained = 0;
    int tried = 0;
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        for (std::size_t outliers : {std::size_t{0}, std::size_t{2}}) {
            for (double const spread : {0.0, 0.03}) {
                auto const planted = support::plant(
                    d, model,
                    {.experiments = 2, .samples = 12, .outliers = outliers, .spread = spread});
                fitter fit(planted.problem);
                auto const found = fit();
                ++tried;
                REQUIRE(found.parameters.size() == planted.truth.size());
                REQUIRE(found.starts.size() == 2);
                CHECK(contains(planted.problem.prior, found.parameters));
                for (std::size_t e = 0; e < 2; ++e) {
                    CHECK(contains(planted.problem.experiments[e].initial, found.starts[e]));
                }
                CHECK(found.residuals[0].size() == 12);
                if (found.inflation > 1) continue;
                ++explained;
                for (std::size_t e = 0; e < 2; ++e) { // what it says of itself is true
                    CHECK(planted.violated(e, found.parameters, found.starts[e], 1e-7) <= outliers);
                }
            }
        }
    }
    CHECK(explained >= tried - 3);
}

TEST_CASE("a fit from a given point stays within the prior and improves on it") {
    draws d(342);
    auto const planted = support::plant(d, 0, {.samples = 15, .noise = 0.01});
    fitter fit(planted.problem);
    auto const found = fit({100, -100}); // far outside: clamped
    CHECK(contains(planted.problem.prior, found.parameters));
    CHECK(found.inflation < 1.2);
}

TEST_CASE("data that nothing explains give a finite inflation above one") {
    draws d(343);
    auto planted = support::plant(d, 0, {});
    planted.problem.experiments[0].measurements[1].bound = support::between(50, 51);
    auto const found = fitter(planted.problem)();
    CHECK(std::isfinite(found.inflation));
    CHECK(found.inflation > 1);
}

TEST_CASE("a simulation that fails everywhere gives no guess, and ends") {
    auto const model =
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[0] * x[0]}; // blows up at t = 1/p
        });
    identification_problem problem;
    problem.model = model;
    problem.choice.unknown = {"p0"};
    problem.prior = box{support::between(5, 6)};
    experiment e;
    e.name = "E";
    e.initial = box{interval(1.0)};
    e.measurements = {{1, 0, support::between(0, 1)}};
    problem.experiments = {e};
    auto const found = fitter(problem)();
    CHECK(found.parameters.empty());
    CHECK(found.inflation == HUGE_VAL);
}
