// SPDX-License-Identifier: MIT
#include <sivid/approximate/fit/minimax_fit.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"
#include "support/inflations.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

std::vector<std::vector<double>> middles(identification_problem const& problem) {
    std::vector<std::vector<double>> starts;
    for (auto const& e : problem.experiments) starts.push_back(mid(e.initial));
    return starts;
}

} // namespace

TEST_CASE("the descent finds what the bounds allow, and says truly what it found") {
    draws d(421);
    int explained = 0;
    int tried = 0;
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        for (std::size_t const outliers : {std::size_t{0}, std::size_t{2}}) {
            for (double const spread : {0.0, 0.03}) {
                auto const planted = support::plant(
                    d, model,
                    {.experiments = 2, .samples = 12, .outliers = outliers, .spread = spread});
                minimax_fitter fit(planted.problem);
                auto const found = fit(mid(planted.problem.prior), middles(planted.problem));
                REQUIRE(found.parameters.size() == planted.truth.size());
                CHECK(contains(planted.problem.prior, found.parameters));
                REQUIRE(found.starts.size() == 2);
                for (std::size_t e = 0; e < 2; ++e) {
                    CHECK(contains(planted.problem.experiments[e].initial, found.starts[e]));
                    CHECK(found.residuals[e].size() == 12);
                }
                double const there = support::inflation_of(planted, found.parameters, found.starts);
                CHECK_THAT(found.inflation, WithinAbs(there, 1e-4));
                ++tried;
                explained += found.inflation <= 1 ? 1 : 0;
                if (outliers == 0) {
                    CHECK(found.inflation <=
                          support::inflation_of(planted, planted.truth, planted.starts) + 1e-3);
                }
            }
        }
    }
    CHECK(explained == tried);
}

TEST_CASE("the least inflation of a decay lies at a kink, and is met") {
    auto const prior = between(0.25, 3);
    auto const problem = support::decay(prior, 0.5, 0.16, 0.0078125);
    minimax_fitter fit(problem);
    for (double const from : {0.25, 1.0, 3.0}) {
        auto const found = fit({from}, {{1}});
        CHECK_THAT(found.inflation,
                   WithinAbs(support::decay_inflation(prior, 0.5, 0.16, 0.0078125), 1e-4));
    }
    int steps = 0;
    (void)fit({0.25}, {{1}}, [&steps] { return ++steps < 3; });
    CHECK(steps >= 3); // a fit that is told to stop asks once more at most where it winds up
    CHECK(steps <= 4);
}

TEST_CASE("a descent from outside starts at the nearest point, one that cannot simulate ends") {
    auto problem = support::decay(between(0.25, 3), 0.5, 0.25, 0.0078125);
    CHECK(minimax_fitter(problem)({100}, {{5}}).inflation < 1e-3);
    problem.model =
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[0] * x[0]};
        });
    problem.prior = box{between(5, 6)};
    auto const found = minimax_fitter(problem)({5.5}, {{1}});
    CHECK(found.parameters.empty());
    CHECK(found.inflation == HUGE_VAL);
}

TEST_CASE("an input that acts late is followed, and its delay found") {
    auto const late = small_campaign::with_delay(0.2);
    auto problem = small_campaign::problem(late);
    problem.model = with(problem.model, std::vector<effect>{small_campaign::catalogue()[3]});
    problem.choice.unknown.push_back("late.tau");
    problem.prior = box{problem.prior[0], between(0, 0.5)};
    auto const found = minimax_fitter(problem)({0.8, 0.35}, middles(problem));
    CHECK(found.inflation <= 0.62); // the deviations fill 60 % of the bounds
    CHECK_THAT(found.parameters[0], WithinAbs(1, 0.02));
    CHECK_THAT(found.parameters[1], WithinAbs(0.2, 0.02));
}

TEST_CASE("nothing unknown: the point is looked at") {
    auto const problem = support::decay(interval(0.6931471805599453), 0.5, 0.5, 0.0625);
    auto const found = minimax_fitter(problem)({0.6931471805599453}, {{1}});
    CHECK_THAT(found.inflation, WithinAbs(4, 1e-6));
}
