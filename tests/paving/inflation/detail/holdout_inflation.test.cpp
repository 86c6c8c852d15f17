// SPDX-License-Identifier: MIT
#include <sivid/paving/inflation/detail/holdout_inflation.hpp>

#include "support/catch.hpp"
#include "support/inflations.hpp"

#include <sivid/approximate/detail/residuals.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

constexpr double half_width = 0.0078125;

inflation_options brief(double seconds = 2) {
    inflation_options o;
    o.seconds = seconds;
    o.relative_width = 0.02;
    return o;
}

/// The decay from about 2, measured at 0.5 and 1.5.
identification_problem other_start(interval const& prior, double spread, std::size_t outliers) {
    auto problem = support::decay(prior, 0, 0, half_width);
    auto& e = problem.experiments[0];
    e.initial = box{spread > 0 ? support::around(2, spread) : interval(2.0)};
    e.measurements = {{0.5, 0, support::around(1.5, half_width)},
                      {1.5, 0, support::around(0.75, half_width)}};
    e.outliers = outliers;
    return problem;
}
double holdout_at(double p, double spread, std::size_t outliers) {
    double best = HUGE_VAL;
    for (int k = -400; k <= 400; ++k) {
        double const x0 = 2 + spread * k / 400;
        double const first = std::abs(x0 * std::exp(-0.5 * p) - 1.5);
        double const second = std::abs(x0 * std::exp(-1.5 * p) - 0.75);
        best = std::min(best, outliers == 0 ? std::max(first, second) : std::min(first, second));
    }
    return best / half_width;
}

} // namespace

TEST_CASE("the range over all fits contains, and about equals, what samples show") {
    auto const prior = between(0.25, 3);
    auto const fit = support::decay(prior, 0.5, 0.16, half_width);
    for (double const spread : {0.0, 0.05}) {
        for (std::size_t const outliers : {std::size_t{0}, std::size_t{1}}) {
            auto const holdout = other_start(prior, spread, outliers);
            auto fitted = bound_inflation(fit, nullptr, brief());
            // A looser bound lets more parameters count as fits.
            for (double const factor : {1.0, 1.5}) {
                fitted.value = interval_traits<interval>::bounds(fitted.value.lower(),
                                                                 factor * fitted.value.upper());
                fitted.hull = prior.lower() < 1 ? box{prior} : box{};
                auto const found = holdout_inflation(fit, fitted, holdout, brief());
                double least = HUGE_VAL;
                double most = 0;
                for (double p = 0.25; p < 3; p += 1e-4) {
                    double const here =
                        std::max(std::abs(std::exp(-p) - 0.5), std::abs(std::exp(-2 * p) - 0.16)) /
                        half_width;
                    if (here > fitted.value.upper()) continue;
                    double const there = holdout_at(p, spread, outliers);
                    least = std::min(least, there);
                    most = std::max(most, there);
                }
                INFO("spread " << spread << " outliers " << outliers << " factor " << factor);
                if (most > 0) {
                    CHECK(found.over_fits.lower() <= least * (1 + 1e-3) + 1e-6);
                    CHECK(found.over_fits.upper() >= most * (1 - 1e-3) - 1e-6);
                    if (spread == 0 && outliers == 0) {
                        CHECK(found.over_fits.lower() >= 0.9 * least);
                        CHECK(found.over_fits.upper() <= 1.1 * most);
                    }
                    CHECK(std::isfinite(found.over_fits.upper()));
                    // The start follows the parameter.
                    if (outliers == 0) CHECK(found.over_fits.upper() <= 1.2 * most);
                }
                double const p = fitted.witness->parameters[0];
                double const exact = holdout_at(p, spread, outliers);
                CHECK(found.at_witness.lower() <= exact * (1 + 1e-6) + 1e-6);
                CHECK(found.at_witness.upper() >= exact * (1 - 0.02) - 0.05);
                CHECK(found.integrations > 0);
            }
        }
    }
}

TEST_CASE("starts about a likely one, or about a wrong one, bound the inflation as well") {
    auto const prior = between(0.25, 3);
    auto const fit = support::decay(prior, 0.5, 0.16, half_width);
    auto fitted = bound_inflation(fit, nullptr, brief());
    fitted.value = interval_traits<interval>::bounds(0, 1.5 * fitted.value.upper());
    double const spread = 0.05;
    auto const holdout = other_start(prior, spread, 0);
    double most = 0;
    for (double p = 0.25; p < 3; p += 1e-4) {
        double const here =
            std::max(std::abs(std::exp(-p) - 0.5), std::abs(std::exp(-2 * p) - 0.16)) / half_width;
        if (here <= fitted.value.upper()) most = std::max(most, holdout_at(p, spread, 0));
    }
    REQUIRE(most > 0);
    for (double const likely : {2.0, 2.02, 1.96, 7.0}) {
        auto const found = holdout_inflation(fit, fitted, holdout, brief(), {{likely}});
        CAPTURE(likely, found.over_fits, most);
        CHECK(found.over_fits.upper() >= most * (1 - 1e-3));
        CHECK(found.over_fits.lower() <= most);
        CHECK(found.over_fits.upper() <= 1.3 * most);
    }
}

TEST_CASE("products that are known narrow what is said of held-out data") {
    auto const model = support::model_of(
        {1, 2, 0, 10}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{-(p[0] * p[1]) * x[0]};
        });
    auto fit = support::decay(between(0.25, 3), 0.5, 0.16, half_width);
    fit.model = model;
    fit.choice.unknown = {"p0", "p1"};
    fit.choice.fixed.clear();
    fit.prior = box{between(0.5, 2), between(0.5, 2)};
    auto holdout = other_start(between(0.25, 3), 0, 0);
    holdout.model = model;
    holdout.choice = fit.choice;
    holdout.prior = fit.prior;
    inflation_bound known;
    known.value = interval(0.0, 1e6); // the data of the fit tell nothing
    known.hull = fit.prior;
    known.products = {{{{1, 1}, "p0*p1", ""}, between(0.65, 0.75)}};
    auto const found = holdout_inflation(fit, known, holdout, brief());
    double least = HUGE_VAL, most = 0;
    for (double p = 0.65; p <= 0.75; p += 1e-3) {
        least = std::min(least, holdout_at(p, 0, 0));
        most = std::max(most, holdout_at(p, 0, 0));
    }
    CHECK(found.over_fits.lower() <= least * (1 + 1e-6));
    CHECK(found.over_fits.upper() >= most * (1 - 1e-6));
    CHECK(found.over_fits.upper() <= 1.1 * most);
    known.products.clear();
    CHECK(holdout_inflation(fit, known, holdout, brief()).over_fits.upper() > 2 * most);
}

TEST_CASE("planted problems: every fit lies in the hold-out's range") {
    draws d(431);
    std::size_t values = 0;
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        auto const planted =
            support::tightened(support::plant(d, model, {.experiments = 2, .samples = 10}), 2);
        auto fit = planted;
        fit.problem.experiments.pop_back();
        auto holdout = planted.problem;
        holdout.experiments.erase(holdout.experiments.begin());
        auto fitted = bound_inflation(fit.problem, nullptr, brief());
        REQUIRE(fitted.witness);
        // A bound that is twice as large holds for more than the witness.
        fitted.value = interval(fitted.value.lower(), 2 * fitted.value.upper());
        fitted.hull = fit.problem.prior;
        auto const found = holdout_inflation(fit.problem, fitted, holdout, brief());
        auto const own = [&](std::vector<double> const& p) {
            auto const y = planted.simulate(1, p, planted.starts[1]);
            auto const samples = sorted(holdout.experiments[0].measurements);
            double worst = 0;
            for (std::size_t i = 0; i < y.size(); ++i) {
                double const m = mid(samples[i].bound);
                worst = std::max(worst, std::abs(static_cast<double>(y[i]) - m) /
                                            (0.5 * width(samples[i].bound)));
            }
            return worst;
        };
        auto const known_start = std::all_of(holdout.experiments[0].initial.begin(),
                                             holdout.experiments[0].initial.end(),
                                             [](interval const& x) { return width(x) < 1e-12; });
        auto const predicted = [&](std::vector<double> const& p) {
            if (!known_start || found.outputs.empty()) return;
            auto const y = planted.simulate(1, p, planted.starts[1]);
            for (std::size_t i = 0; i < found.outputs[0].size(); ++i) {
                auto const& range = found.outputs[0][i];
                auto const value = static_cast<double>(y[i]);
                CHECK(range.lower() <= value + 1e-9 * (1 + std::abs(value)));
                CHECK(value <= range.upper() + 1e-9 * (1 + std::abs(value)));
                ++values;
            }
        };
        auto const& w = fitted.witness->parameters;
        predicted(w);
        CHECK(found.over_fits.lower() <= own(w) * (1 + 1e-6));
        CHECK(own(w) * (1 - 1e-6) <= found.over_fits.upper());
        CHECK(found.at_witness.lower() <= own(w) * (1 + 1e-6));
        CHECK(own(w) * (1 - 1e-6) <= found.at_witness.upper());
        for (int sample = 0; sample < 200; ++sample) {
            auto p = w;
            for (std::size_t j = 0; j < p.size(); ++j) {
                double const reach = std::pow(10, -d.uniform(1, 5)) * width(fitted.hull[j]);
                p[j] = std::clamp(p[j] + d.uniform(-1, 1) * reach, planted.problem.prior[j].lower(),
                                  planted.problem.prior[j].upper());
            }
            auto one = fit;
            one.starts.pop_back();
            if (support::inflation_of(one, p, one.starts) > fitted.value.upper()) continue;
            CHECK(found.over_fits.lower() <= own(p) * (1 + 1e-6));
            CHECK(own(p) * (1 - 1e-6) <= found.over_fits.upper());
            predicted(p);
        }
    }
    CHECK(values > 100);
}

TEST_CASE("hold-out bounds at the limits") {
    auto const prior = between(0.25, 3);
    auto const fit = support::decay(prior, 0.5, 0.16, half_width);
    auto const holdout = other_start(prior, 0, 0);
    SECTION("no time") {
        auto const found =
            holdout_inflation(fit, bound_inflation(fit, nullptr, brief()), holdout, brief(0));
        CHECK(found.over_fits.lower() == 0);
        CHECK(found.over_fits.upper() == HUGE_VAL);
    }
    SECTION("no memory: little is looked at, and nothing lost") {
        auto little = brief();
        little.memory = 1;
        auto const fitted = bound_inflation(fit, nullptr, brief());
        auto const found = holdout_inflation(fit, fitted, holdout, little);
        CHECK(found.boxes < holdout_inflation(fit, fitted, holdout, brief()).boxes);
        REQUIRE(fitted.witness);
        double const there = holdout_at(fitted.witness->parameters[0], 0, 0);
        CHECK(found.over_fits.lower() <= there * (1 + 1e-9));
        CHECK(there * (1 - 1e-9) <= found.over_fits.upper());
    }
    SECTION("nothing known of the fit: the range over the whole prior") {
        auto const found = holdout_inflation(fit, {}, holdout, brief(0.3));
        CHECK(found.at_witness.upper() == HUGE_VAL);
        for (double p = 0.25; p < 3; p += 0.01) {
            CHECK(found.over_fits.lower() <= holdout_at(p, 0, 0) * (1 + 1e-9));
            CHECK(holdout_at(p, 0, 0) * (1 - 1e-9) <= found.over_fits.upper());
        }
    }
    SECTION("other parameters") {
        auto other = holdout;
        other.choice.unknown = {"q"};
        CHECK_THROWS_AS(holdout_inflation(fit, {}, other, brief()), std::invalid_argument);
    }
}
