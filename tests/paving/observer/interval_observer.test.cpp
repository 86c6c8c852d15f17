// SPDX-License-Identifier: MIT
#include <sivid/paving/observer/interval_observer.hpp>

#include "support/catch.hpp"
#include "support/inflations.hpp"
#include "support/problems.hpp"
#include "support/sweep.hpp"

#include <cmath>
#include <string>

using namespace support;
using sivid::interval_observer;

namespace {

/// Boxes of several sizes about a point, within the prior.
std::vector<box> boxes_about(std::vector<double> const& p, box const& prior, draws& d) {
    std::vector<box> all;
    for (double const share : {1.0, 0.3, 0.1, 0.03, 0.01, 0.003, 0.0003, 0.0}) {
        box b(p.size());
        for (std::size_t j = 0; j < p.size(); ++j) {
            double const size = share * width(prior[j]);
            double const low = p[j] - size * d.uniform(0, 1);
            b[j] = between(std::min(std::max(low, prior[j].lower()), p[j]),
                           std::max(std::min(low + size, prior[j].upper()), p[j]));
        }
        all.push_back(std::move(b));
    }
    return all;
}

/// A leaking tank under another one, the upper level not measured; the pump changes stepwise or
/// along lines. With a rim there is a kink, with a jump a sign.
struct two_tanks {
    sivid::identification_problem problem;
    std::vector<double> truth, start;

    two_tanks(draws& d, sivid::interpolation kind, double noise, bool jumps) {
        problem.model = model_of(
            {2, 2, 1, 10},
            [jumps](auto const&, auto const& x, auto const& p, auto const& u) {
                using namespace real;
                auto const over = max(x[0] - 3, 0);
                auto const lid = jumps ? 0.05 * sign(x[0] - x[1]) : 0 * x[0];
                auto const between_them = p[0] * x[0];
                return std::vector{u[0] - between_them - over - lid,
                                   between_them + 0.5 * over + lid - p[1] * x[1]};
            },
            [](auto const&, auto const& x, auto const& p, auto const&) {
                return std::vector{x[1] + 0.1 * p[0]};
            });
        problem.choice.unknown = {"p0", "p1"};
        problem.prior = box{between(0.5, 1.5), between(0.3, 1)};
        truth = d.in(problem.prior);
        start = {d.uniform(0, 5), d.uniform(1, 2)};
        sivid::experiment e;
        e.name = "E";
        e.initial = box{between(0, 5), around(start[1], 0.2)};
        std::vector<double> times, pump;
        for (int k = 0; k <= 30; ++k) {
            times.push_back(0.5 * k);
            pump.push_back(d.uniform(0, 4));
        }
        e.inputs = {sivid::sampled_signal(times, pump, kind)};
        std::vector<double> when;
        for (int k = 1; k < 40; ++k) when.push_back(0.35 * k);
        // Plain simulation with steps much shorter than anything that happens.
        auto x = start;
        double t = 0;
        for (double const to : when) {
            auto const steps = 2000;
            double const h = (to - t) / steps;
            for (int i = 0; i < steps; ++i) x = euler(x, t + i * h, h, e.inputs[0], jumps);
            t = to;
            double const y = x[1] + 0.1 * truth[0] + d.uniform(-0.9, 0.9) * noise;
            e.measurements.push_back({t, 0, around(y, noise)});
        }
        problem.experiments = {e};
    }

    [[nodiscard]] std::vector<double> euler(std::vector<double> const& x, double t, double h,
                                            sivid::signal const& input, bool jumps) const {
        double const u = std::get<sivid::sampled_signal>(input).approximate(t + h / 2);
        auto const rate = [&](std::vector<double> const& y) {
            double const over = std::max(y[0] - 3, 0.0);
            double const lid = jumps ? 0.05 * (y[0] > y[1] ? 1 : -1) : 0;
            return std::vector{u - truth[0] * y[0] - over - lid,
                               truth[0] * y[0] + 0.5 * over + lid - truth[1] * y[1]};
        };
        auto const f = rate(x);
        auto const g = rate({x[0] + h / 2 * f[0], x[1] + h / 2 * f[1]});
        return {x[0] + h * g[0], x[1] + h * g[1]};
    }
};

} // namespace

TEST_CASE("boxes with the truth are never refuted") {
    for (std::size_t trial = 0; trial < 60; ++trial) {
        draws d(700 + trial);
        planting how;
        how.experiments = 1;
        how.samples = 20;
        how.outliers = trial % 3;
        how.spread = trial % 2 == 0 ? 0.3 : 0;
        auto const planted = plant(d, trial, how);
        CAPTURE(trial);
        interval_observer observe(planted.problem, 0);
        auto const found = observe(boxes_about(planted.truth, planted.problem.prior, d), 1);
        CHECK(found.refuted == 0);
    }
}

TEST_CASE("kinks, jumps, held and linear inputs, and a state that is not measured") {
    for (std::size_t trial = 0; trial < support::swept(std::size_t{10}, std::size_t{24}); ++trial) {
        draws d(900 + trial);
        auto const kind =
            trial % 2 == 0 ? sivid::interpolation::hold : sivid::interpolation::linear;
        two_tanks const tanks(d, kind, 0.02, trial % 4 > 1);
        CAPTURE(trial);
        interval_observer observe(tanks.problem, 0);
        auto const about = boxes_about(tanks.truth, tanks.problem.prior, d);
        CHECK(observe(about, 1).refuted == 0);
        // A pump three times as strong, or an outlet that is far off, explains nothing.
        auto const wrong = [&](std::size_t j, double value) {
            box b = sivid::point_box(tanks.truth);
            b[j] = interval(value);
            return b;
        };
        CHECK(observe({wrong(1, tanks.truth[1] < 0.65 ? 1.0 : 0.3)}, 1).refuted == 1);
    }
}

TEST_CASE("inputs that lie within their error bounds refute nothing") {
    for (std::size_t trial = 0; trial < support::swept(std::size_t{10}, std::size_t{24}); ++trial) {
        draws d(1200 + trial);
        auto const kind =
            trial % 2 == 0 ? sivid::interpolation::hold : sivid::interpolation::linear;
        two_tanks tanks(d, kind, 0.02, false);
        // What was recorded lies off the true input by nearly the stated error.
        auto& input = std::get<sivid::sampled_signal>(tanks.problem.experiments[0].inputs[0]);
        std::vector<double> recorded, errors;
        for (double const u : input.values()) {
            errors.push_back(d.uniform(0.2, 0.6));
            recorded.push_back(u + 0.99 * errors.back());
        }
        auto const times = input.times();
        input = sivid::sampled_signal(times, recorded, kind);
        interval_observer exact(tanks.problem, 0);
        CAPTURE(trial);
        CHECK(exact({sivid::point_box(tanks.truth)}, 1).refuted == 1);
        input = sivid::sampled_signal(times, recorded, kind, errors);
        interval_observer stated(tanks.problem, 0);
        CHECK(stated(boxes_about(tanks.truth, tanks.problem.prior, d), 1).refuted == 0);
    }
}

TEST_CASE("a point that is refuted at a level has a larger inflation") {
    std::size_t refuted = 0;
    for (std::size_t trial = 0; trial < 60; ++trial) {
        draws d(300 + trial);
        planting how;
        how.samples = 15;
        how.outliers = trial % 3;
        auto const planted = plant(d, trial, how);
        interval_observer observe(planted.problem, 0);
        for (int n = 0; n < 4; ++n) {
            auto const p = d.in(planted.problem.prior);
            double const inflation = inflation_of(planted, p, planted.starts);
            CAPTURE(trial, inflation);
            // The starts are points here, so this is the inflation.
            CHECK(observe({sivid::point_box(p)}, inflation * (1 + 1e-9)).refuted == 0);
            if (inflation > 3 && observe({sivid::point_box(p)}, 1).refuted == 1) ++refuted;
        }
    }
    CHECK(refuted > 40);
}

TEST_CASE("solutions that end, and functions that are not defined, refute nothing") {
    sivid::identification_problem problem;
    problem.model = model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
        using namespace real;
        return std::vector{p[0] * sqr(x[0]) + sqrt(x[0] - 0.5)};
    });
    problem.choice.unknown = {"p0"};
    problem.prior = box{between(0.5, 2)};
    sivid::experiment e;
    e.name = "E";
    e.initial = box{between(0.4, 1.1)};
    e.measurements = {{5, 0, between(0, 1e6)}};
    problem.experiments = {e};
    interval_observer observe(problem, 0);
    CHECK(observe({problem.prior}, 1).refuted == 0);
    problem.experiments[0].initial = box{between(1, 1.1)}; // blows up before 5
    interval_observer again(problem, 0);
    CHECK(again({problem.prior}, 1).refuted == 0);
}
