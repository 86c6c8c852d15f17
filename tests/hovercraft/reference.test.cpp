// SPDX-License-Identifier: MIT
// The model against numbers and equations that do not come from it.
#include "craft.hpp"
#include "model.hpp"

#include "support/catch.hpp"
#include "support/flow_simulation.hpp"

#include <sivid/app/generate.hpp>
#include <sivid/enclosure/methods.hpp>
#include <sivid/enclosure/tube.hpp>
#include <sivid/io/dataset/model_names.hpp>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <random>

using sivid::interval;

namespace {

using state = std::array<double, 6>;

/// One scenario with its exact inputs and some constants set.
struct run {
    run(std::string const& name, std::map<std::string, double> const& set = {},
        hovercraft craft = {})
        : model{sivid::record_model(craft)},
          scenario{sivid::app::find_scenario(hovercraft_example::craft(), name)} {
        sivid::parameter_choice choice;
        for (auto const& [constant, value] : set) choice.fixed[constant] = interval(value);
        std::vector<sivid::signal> inputs;
        for (auto const& i : scenario.inputs) inputs.push_back(exact_signal(i, scenario.duration));
        f = std::make_shared<sivid::flow const>(model, choice, inputs);
        for (auto const& s : scenario.initial) start.push_back(mid(s.enclosure));
    }
    std::vector<double> simulated(double t) const {
        return support::flow_simulation(*f)(start, {}, 0, {t}, 1e-10).states[0];
    }
    sivid::tube<interval> enclosed(sivid::enclosure_options const& options = {}) const {
        return sivid::integrate<interval>(f, sivid::point_box(start), sivid::box{}, 0,
                                          scenario.duration, options);
    }
    sivid::recorded_model model;
    sivid::scenario_description scenario;
    std::shared_ptr<sivid::flow const> f;
    std::vector<double> start;
};

/// The right-hand side as docs/hovercraft.md states it, written a second time.
state stated_rate(state const& s, std::map<std::string, double> const& c, double W, double delta,
                  bool rudder_lift, bool printed_friction) {
    auto const k = [&](char const* name) { return c.at(name); };
    auto const [u, v, r, x, y, psi] = s;
    double const F = k("Cdelta") * k("rho") * std::pow(k("D"), 4) * W * W;
    double const V = std::sqrt(u * u + v * v + k("eps") * k("eps"));
    double const friction = printed_friction ? V * V : V;
    double const lift = k("CL") * F * delta / (4 * k("A"));
    double const X =
        F - k("Ff") * u / friction - 0.5 * k("rho") * k("Cd") * k("Su") * V * u - k("D11") * u;
    double const Y = (rudder_lift ? k("Sg") : k("Sv")) * lift - k("Ff") * v / friction -
                     0.5 * k("rho") * k("Cd") * k("Sv") * V * v - k("D22") * v;
    double const N = -k("L") * k("Sg") * lift - k("D33") * r;
    return {v * r + X / k("m"),
            -u * r + Y / k("m"),
            N / k("Iz"),
            u * std::cos(psi) - v * std::sin(psi),
            u * std::sin(psi) + v * std::cos(psi),
            r};
}

} // namespace

TEST_CASE("the reference values of all three scenarios, simulated and enclosed") {
    struct expectation {
        char const* name;
        state at_end;
    };
    for (auto const& [name, expected] : {expectation{"S1", {7.311, 0, 0, 3.872, 0, 0}},
                                         {"S2", {0, 0, 0, 4.420, 0, 0}},
                                         {"S3", {-1.184, 1.463, -0.315, 7.717, 1.581, -2.356}}}) {
        INFO(name);
        run const r(name);
        auto const simulated = r.simulated(r.scenario.duration);
        auto const tube = r.enclosed();
        REQUIRE(tube.complete());
        auto const proved = tube.at(r.scenario.duration);
        for (std::size_t i = 0; i < 6; ++i) {
            INFO(i);
            CHECK_THAT(simulated[i], WithinAbs(expected[i], 0.00051));
            CHECK_THAT(mid(proved[i]), WithinAbs(simulated[i], 1e-7));
            CHECK(width(proved[i]) < 1e-8);
        }
    }
}

TEST_CASE("scenario 3 by a validated Runge-Kutta method") {
    run const r("S3");
    sivid::enclosure_options options;
    options.method = sivid::rk4();
    options.tolerance = 1e-10;
    auto const tube = r.enclosed(options);
    REQUIRE(tube.complete());
    auto const proved = tube.at(3);
    auto const taylor = r.enclosed().at(3);
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(width(proved[i]) < 1e-6);
        CHECK_FALSE(disjoint(proved[i], taylor[i]));
    }
}

TEST_CASE("the recorded equations are the stated ones, in every variant") {
    std::mt19937_64 random(7);
    auto const draw = [&](double lo, double hi) {
        return lo + (hi - lo) * (static_cast<double>(random() >> 11) * 0x1p-53);
    };
    for (auto const lift : {hovercraft::lift_area::as_printed, hovercraft::lift_area::rudder}) {
        for (auto const friction :
             {hovercraft::friction_law::unit_vector, hovercraft::friction_law::as_printed}) {
            hovercraft craft;
            craft.lift = lift;
            craft.friction = friction;
            auto const model = sivid::record_model(craft);
            for (int k = 0; k < 50; ++k) {
                sivid::parameter_choice all;
                std::vector<double> values;
                std::map<std::string, double> named;
                for (auto const& c : model.about.constants) {
                    all.unknown.push_back(c.name);
                    values.push_back(draw(0.5, 1.5) * (c.nominal.nearest + 0.01));
                    named[c.name] = values.back();
                }
                double const W = draw(0, 250), delta = draw(-0.6, 0.6);
                sivid::flow const f(
                    model, all,
                    {sivid::sampled_signal({0}, {W}, sivid::interpolation::hold),
                     sivid::sampled_signal({0}, {delta}, sivid::interpolation::hold)});
                state x;
                for (auto& side : x) side = draw(-3, 3);
                sivid::series<double> rate(f.rate(), 0);
                rate.set_parameters(values);
                sivid::input_pieces<double> const inputs(f, 0, 0.0);
                rate.start(0.0);
                rate.advance(
                    0, [&](std::size_t i, std::size_t) { return x[i]; }, inputs);
                auto const expected =
                    stated_rate(x, named, W, delta, lift == hovercraft::lift_area::rudder,
                                friction == hovercraft::friction_law::as_printed);
                for (std::size_t i = 0; i < 6; ++i) {
                    CHECK_THAT(rate.output(i, 0),
                               WithinRel(expected[i], 1e-12) || WithinAbs(expected[i], 1e-12));
                }
            }
        }
    }
}

TEST_CASE("the facts that fix the readings of the report") {
    // Thrust at W = 250/3 is the report's C_Fu = 1.19576 (there without a unit).
    CHECK_THAT(0.1339 * 1.225 * std::pow(0.18, 4) * std::pow(250.0 / 3, 2),
               WithinAbs(1.195760, 5e-7));
    // Scenario 2 must stop between 3 m and 7 m: this pins the dry friction.
    CHECK_THAT(run("S2", {{"Ff", 0.777}}).simulated(10)[3], WithinAbs(3.0, 0.01));
    CHECK_THAT(run("S2", {{"Ff", 0.286}}).simulated(10)[3], WithinAbs(7.0, 0.01));
    // Scenario 1 reaches far more than 2 m/s; exactly 2 m/s would need W = 132.6.
    run const first("S1");
    sivid::flow const slower(first.model, {},
                             {sivid::sampled_signal({0}, {132.6}, sivid::interpolation::hold),
                              sivid::sampled_signal({0}, {0.0}, sivid::interpolation::hold)});
    auto const end = support::flow_simulation(slower)(first.start, {}, 0, {1}, 1e-10);
    CHECK_THAT(end.states[0][0], WithinAbs(2.0, 0.002));
}

TEST_CASE("scenarios 1 and 2 say nothing about S_v, S_g or L, and scenario 3 knows L S_g only") {
    for (auto const* name : {"S1", "S2"}) {
        auto const a = run(name).simulated(1);
        auto const b = run(name, {{"Sv", 0.25}, {"Sg", 0.07}, {"L", 0.26}}).simulated(1);
        for (std::size_t i = 0; i < 6; ++i) CHECK_THAT(a[i], WithinAbs(b[i], 1e-8));
    }
    auto const a = run("S3").simulated(3);
    auto const b = run("S3", {{"Sg", 0.04 * 0.30 / 0.26}, {"L", 0.26}}).simulated(3);
    for (std::size_t i = 0; i < 6; ++i) CHECK_THAT(a[i], WithinAbs(b[i], 1e-7));
    // How far u moves over the prior of each.
    auto const spread = [](std::string const& name, double lo, double hi) {
        double most = 0;
        run const low("S3", {{name, lo}}), high("S3", {{name, hi}});
        for (double t = 0.1; t < 3.01; t += 0.1)
            most = std::max(most, std::abs(low.simulated(t)[0] - high.simulated(t)[0]));
        return most;
    };
    CHECK_THAT(spread("Sv", 0.20, 0.25), WithinAbs(0.30, 0.05));
    CHECK_THAT(spread("Sg", 0.0042, 0.0754), WithinAbs(5.0, 0.3));
    CHECK_THAT(spread("L", 0.25, 0.35), WithinAbs(1.2, 0.1));
}

TEST_CASE("random truths lie in the tube of their parameters' box at random times") {
    auto const model = sivid::record_model(hovercraft{});
    run const r("S3");
    std::vector<sivid::signal> inputs;
    for (auto const& i : r.scenario.inputs) inputs.push_back(exact_signal(i, 3));
    auto const f = std::make_shared<sivid::flow const>(
        model, sivid::parameter_choice{{"Sv", "Sg", "L"}, {}}, inputs);
    sivid::box const p{interval(0.2195, 0.2205), interval(0.0395, 0.0405), interval(0.298, 0.302)};
    auto const tube = sivid::integrate<interval>(f, sivid::point_box(r.start), p, 0, 3);
    REQUIRE(tube.complete());
    support::flow_simulation simulate(*f);
    std::mt19937_64 random(1);
    auto const share = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    for (int k = 0; k < 1000; ++k) {
        std::vector<double> q;
        for (auto const& side : p) q.push_back(side.lower() + share() * width(side));
        double const t = 3 * share();
        auto const x = simulate(r.start, q, 0, {t}, 1e-11).states[0];
        auto const box = tube.at(t);
        for (std::size_t i = 0; i < 6; ++i)
            CHECK(contains(interval(box[i].lower() - 1e-8, box[i].upper() + 1e-8), x[i]));
    }
}
