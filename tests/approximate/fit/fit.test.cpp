// SPDX-License-Identifier: MIT
#include <sivid/approximate/fit/fit.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"
#include "support/hovercraft_campaign.hpp"
#include "support/inflations.hpp"
#include "support/problems.hpp"

#include <cmath>

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
                approximate_fitter fit(planted.problem);
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
    approximate_fitter fit(planted.problem);
    auto const found = fit({{100, -100}}); // far outside: clamped
    CHECK(contains(planted.problem.prior, found.parameters));
    CHECK(found.inflation < 1.2);
}

TEST_CASE("a rough look at a point misses little of the bounds") {
    draws d(343);
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        auto const planted = support::plant(d, model, {.experiments = 2, .samples = 15});
        approximate_fitter fit(planted.problem);
        for (auto const& parameters : {planted.truth, mid(planted.problem.prior)}) {
            auto const starts = middles(planted.problem);
            auto const rough = fit.roughly_at(parameters, starts);
            auto const fine = fit.at(parameters, starts);
            CHECK(rough.parameters == fine.parameters);
            CHECK(rough.starts == fine.starts);
            for (std::size_t e = 0; e < fine.residuals.size(); ++e)
                for (std::size_t k = 0; k < fine.residuals[e].size(); ++k)
                    CHECK_THAT(rough.residuals[e][k], WithinAbs(fine.residuals[e][k], 0.02));
        }
    }
}

TEST_CASE("data that nothing explains give a finite inflation above one") {
    draws d(343);
    auto planted = support::plant(d, 0, {});
    planted.problem.experiments[0].measurements[1].bound = support::between(50, 51);
    auto const found = approximate_fitter(planted.problem)();
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
    auto const found = approximate_fitter(problem)();
    CHECK(found.parameters.empty());
    CHECK(found.inflation == HUGE_VAL);
}

TEST_CASE("the parameters of a simulated hovercraft are found again") {
    draws d(345);
    std::map<std::string, double> const truth{
        {"Sv", 0.236}, {"Sg", 0.051}, {"L", 0.3}, {"m", 1.27}};
    support::hover_options options{.truth = truth};
    for (bool const outliers : {false, true}) {
        options.outlier_fraction = outliers ? 0.07 : 0;
        auto problem = support::hovercraft_campaign(d, {}, options);
        problem.choice.fixed["m"] = interval(1.27);
        approximate_fitter fit(problem);
        auto const found = fit();
        CHECK(found.inflation < 1);
        auto const& names = problem.choice.unknown;
        for (std::size_t j = 0; j < names.size(); ++j) {
            if (names[j] == "Sv") CHECK(std::abs(found.parameters[j] - 0.236) < 0.004);
        }
        CHECK(std::abs(found.parameters[0] * found.parameters[1] - 0.3 * 0.051) < 3e-4); // L Sg
        auto const again = fit.at(found.parameters, found.starts);
        CHECK(std::abs(again.inflation - found.inflation) < 1e-9);
    }
}

TEST_CASE("unknown delays of an input and of channels are fitted") {
    draws d(346);
    for (bool const input : {true, false}) {
        support::hover_effect effect;
        if (input) {
            effect.inputs = [](double t, auto const& recorded) {
                return support::controls{recorded(t)[0], recorded(std::max(0.0, t - 0.15))[1]};
            };
        } else {
            effect.sensors = [](double t, auto const& at) {
                auto y = at(t);
                auto const late = at(std::max(0.0, t - 0.15));
                y[3] = late[3];
                y[4] = late[4];
                return y;
            };
        }
        auto problem = support::hovercraft_campaign(d, effect, {});
        CHECK(approximate_fitter(problem)().inflation > 2);
        problem.model.about.constants.push_back({"tau", "s", literal{interval(0.0), 0.0}});
        auto const tau = problem.model.about.constants.size() - 1;
        if (input) {
            problem.model.input_memory = {{1, tau}};
        } else {
            problem.model.channel_delays = {{3, tau}, {4, tau}};
        }
        problem.choice.unknown.push_back("tau");
        box prior(4);
        for (std::size_t j = 0; j < 3; ++j) prior[j] = problem.prior[j];
        prior[3] = support::between(0, 0.5);
        problem.prior = prior;
        auto const found = approximate_fitter(problem)();
        CHECK(found.inflation < 1);
        CHECK(std::abs(found.parameters[3] - 0.15) < 0.02);
    }
}

TEST_CASE("least squares have fewer squares, the fit less inflation") {
    draws d(347);
    support::hover_effect effect;
    effect.inputs = [](double t, auto const& recorded) {
        return support::controls{recorded(t)[0], recorded(std::max(0.0, t - 0.15))[1]};
    };
    auto const problem = support::hovercraft_campaign(d, effect, {});
    auto const squares = fit(problem, fit_norm::squares);
    auto const minimax = fit(problem, fit_norm::largest, {squares.parameters});
    CHECK(minimax.inflation <= squares.inflation + 1e-6);
    auto const sum = [](approximate_fit const& f) {
        double total = 0;
        for (auto const& e : f.residuals) {
            for (double const r : e) total += r * r;
        }
        return total;
    };
    CHECK(sum(squares) <= 1.01 * sum(minimax));
}

TEST_CASE("a fit that is told to stop ends with the best it has") {
    draws d(344);
    auto const planted = support::plant(d, 1, {.experiments = 2, .samples = 12, .outliers = 1});
    double last = HUGE_VAL;
    for (std::size_t const most : {0u, 1u, 10u, 100u, 1000000u}) {
        std::size_t asked = 0;
        auto const found = approximate_fitter(planted.problem, [&] { return ++asked <= most; })();
        CAPTURE(most);
        CHECK((found.parameters.empty() || contains(planted.problem.prior, found.parameters)));
        CHECK(found.inflation <= last);
        last = found.inflation;
        CHECK((asked <= most || asked < most + 100)); // it is heard
    }
    CHECK(last <= 1);
    CHECK(approximate_fitter(planted.problem, [] { return false; })().parameters.empty());
}

TEST_CASE(
    "a descent from a whole point finds what the bounds allow, and says truly what it found") {
    draws d(421);
    int explained = 0;
    int tried = 0;
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        for (std::size_t const outliers : {std::size_t{0}, std::size_t{2}}) {
            for (double const spread : {0.0, 0.03}) {
                auto const planted = support::plant(
                    d, model,
                    {.experiments = 2, .samples = 12, .outliers = outliers, .spread = spread});
                approximate_fitter fit(planted.problem);
                auto const found = fit({mid(planted.problem.prior), middles(planted.problem)});
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
    approximate_fitter fit(problem);
    for (double const from : {0.25, 1.0, 3.0}) {
        auto const found = fit({{from}, {{1}}});
        CHECK_THAT(found.inflation,
                   WithinAbs(support::decay_inflation(prior, 0.5, 0.16, 0.0078125), 1e-4));
    }
    int steps = 0;
    (void)approximate_fitter(problem, [&steps] { return ++steps < 3; })({{0.25}, {{1}}});
    CHECK(steps >= 3); // a fit that is told to stop asks once more at most where it winds up
    CHECK(steps <= 4);
}

TEST_CASE("a descent from outside starts at the nearest point, one that cannot simulate ends") {
    auto problem = support::decay(between(0.25, 3), 0.5, 0.25, 0.0078125);
    CHECK(approximate_fitter(problem)({{100}, {{5}}}).inflation < 1e-3);
    problem.model =
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[0] * x[0]};
        });
    problem.prior = box{between(5, 6)};
    auto const found = approximate_fitter(problem)({{5.5}, {{1}}});
    CHECK(found.parameters.empty());
    CHECK(found.inflation == HUGE_VAL);
}

TEST_CASE("an input that acts late is followed, and its delay found") {
    auto const late = small_campaign::with_delay(0.2);
    auto problem = small_campaign::problem(late);
    problem.model = with(problem.model, std::vector<effect>{small_campaign::catalogue()[3]});
    problem.choice.unknown.push_back("late.tau");
    problem.prior = box{problem.prior[0], between(0, 0.5)};
    auto const found = approximate_fitter(problem)({{0.8, 0.35}, middles(problem)});
    CHECK(found.inflation <= 0.62); // the deviations fill 60 % of the bounds
    CHECK_THAT(found.parameters[0], WithinAbs(1, 0.02));
    CHECK_THAT(found.parameters[1], WithinAbs(0.2, 0.02));
}

TEST_CASE("nothing unknown: the point is looked at") {
    auto const problem = support::decay(interval(0.6931471805599453), 0.5, 0.5, 0.0625);
    auto const found = approximate_fitter(problem)({{0.6931471805599453}, {{1}}});
    CHECK_THAT(found.inflation, WithinAbs(4, 1e-6));
}

TEST_CASE("the three ways to begin end at the same least inflation where there is one minimum") {
    auto const prior = between(0.25, 3);
    auto const problem = support::decay(prior, 0.5, 0.16, 0.0078125);
    double const least = support::decay_inflation(prior, 0.5, 0.16, 0.0078125);
    for (auto const& start : {fit_start{}, fit_start{{0.3}}, fit_start{{2.9}, {{1}}}}) {
        CHECK_THAT(fit(problem, fit_norm::largest, start).inflation,
                   WithinAbs(least, 2e-3 * least));
    }
    auto const squares = fit(problem, fit_norm::squares, {{2.9}, {{1}}});
    CHECK(squares.inflation >= least * (1 - 1e-6));
    CHECK(squares.squares <= fit(problem, fit_norm::squares).squares * (1 + 1e-6));
}
