// SPDX-License-Identifier: MIT
#include "hovercraft/effects.hpp"

#include "hovercraft/model.hpp"
#include "support/catch.hpp"
#include "support/flow_simulation.hpp"
#include "support/random.hpp"

#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/bound_model.hpp>

#include <cmath>
#include <map>
#include <set>
#include <string>

using namespace sivid;

namespace {

/// The craft with all its effects, written down as formulas in plain numbers.
struct plain_craft {
    double m = 1.297, Iz = 0.058, rho = 1.225, Cd = 0.6, CL = 1.891, Cdelta = 0.1339, D = 0.18,
           Su = 0.1276, Sv = 0.22, Sg = 0.04, A = 0.025447, L = 0.3, Ff = 0.5, eps = 0.05,
           D22 = 0.2, D33 = 0.1;
    std::map<std::string, double> p; ///< parameters of effects, "wind.wx"; others are neutral

    double of(std::string const& name, double neutral = 0) const {
        auto const f = p.find(name);
        return f == p.end() ? neutral : f->second;
    }
    /// u', v', r', x', y', psi', then the lags' states d', w' where they exist.
    std::map<std::string, double> rate(double t, std::map<std::string, double> const& s, double W,
                                       double delta) const {
        std::map<std::string, double> rate;
        double const u = s.at("u"), v = s.at("v"), r = s.at("r"), psi = s.at("psi");
        double const c = std::cos(psi), sn = std::sin(psi);
        W *= 1 - of("battery_sag.k") * t;
        if (p.count("motor_lag.tau")) {
            rate["motor_lag.W"] = (W - s.at("motor_lag.W")) / of("motor_lag.tau");
            W = s.at("motor_lag.W");
        }
        double const b = of("rudder_deadband.b");
        delta = delta > b ? delta - b : delta < -b ? delta + b : 0;
        if (p.count("rudder_lag.tau")) {
            rate["rudder_lag.delta"] = (delta - s.at("rudder_lag.delta")) / of("rudder_lag.tau");
            delta = s.at("rudder_lag.delta");
        }
        double const lim = of("rudder_saturation.lim", 10);
        delta = std::min(std::max(delta, -lim), lim) + of("rudder_trim.d0");
        double const mass = m + of("payload.dm");
        double const Fu =
            Cdelta * rho * std::pow(D, 4) * W * W * (1 - of("thrust_loss_with_speed.k") * u);
        double const V = std::sqrt(u * u + v * v + eps * eps);
        double const ur = u - (c * of("wind.wx") + sn * of("wind.wy"));
        double const vr = v - (-sn * of("wind.wx") + c * of("wind.wy"));
        double const Vr = std::sqrt(ur * ur + vr * vr + eps * eps);
        double const g = 9.81, sx = of("ground_slope.sx"), sy = of("ground_slope.sy");
        double const slow =
            1 + of("stribeck.k") * std::exp(-V * V / std::pow(of("stribeck.vs", 1), 2));
        double const friction = Ff * slow;
        double const X = Fu - friction * u / V - 0.5 * rho * Cd * Su * Vr * ur -
                         of("linear_surge_damping.k") * u + mass * g * (c * sx + sn * sy);
        double const Y = CL * Sv * Fu * delta / (4 * A) -
                         (1 + of("friction_anisotropy.k")) * friction * v / V -
                         0.5 * rho * Cd * Sv * Vr * vr - D22 * v + mass * g * (-sn * sx + c * sy);
        double const N = -L * CL * Sg * Fu * delta / (4 * A) - D33 * r +
                         Fu * of("thrust_offset.yT") -
                         of("quadratic_yaw_damping.k") * std::abs(r) * r -
                         of("dry_yaw_friction.k") * r / std::sqrt(r * r + 1e-4);
        double const xg = of("cg_offset.xg");
        rate["u"] = (X + mass * v * r + mass * xg * r * r) / mass;
        // Cramer's rule for [m, m xg; m xg, Iz + m xg^2] (v', r') = (Y - m u r, N - m xg u r)
        double const a = Y - mass * u * r, d = N - mass * xg * u * r;
        double const i = Iz + mass * xg * xg;
        double const det = mass * i - mass * xg * mass * xg;
        rate["v"] = (a * i - mass * xg * d) / det;
        rate["r"] = (mass * d - mass * xg * a) / det;
        rate["x"] = u * c - v * sn;
        rate["y"] = u * sn + v * c;
        rate["psi"] = r;
        return rate;
    }
};

std::set<std::string> names(std::vector<effect> const& effects) {
    std::set<std::string> result;
    for (auto const& e : effects) result.insert(e.name);
    return result;
}

/// Compares rates and channels of the recorded model with the formulas at random points.
void compare(std::vector<effect> const& effects, unsigned seed) {
    auto const model = with(record_model(hovercraft{}), effects);
    support::draws d(seed);
    for (int trial = 0; trial < 20; ++trial) {
        plain_craft craft;
        parameter_choice choice;
        for (auto const& e : effects) {
            for (auto const& p : e.parameters) {
                double const v = d.uniform(nearest(p.lower), nearest(p.upper));
                craft.p[e.name + "." + p.name] = v;
                choice.fixed[e.name + "." + p.name] = interval(v);
            }
        }
        auto plain = model;
        plain.input_memory.clear();
        plain.channel_delays.clear();
        double const W = d.uniform(0, 250), delta = d.uniform(-0.6, 0.6);
        auto const hold = [](double v) { return sampled_signal({0.0}, {v}, interpolation::hold); };
        flow const f(plain, choice, {hold(W), hold(delta)});
        std::map<std::string, double> s;
        std::vector<double> x;
        for (auto const& state : model.about.states) {
            x.push_back(state.name == "motor_lag.W" ? d.uniform(0, 250) : d.uniform(-1, 1));
            s[state.name] = x.back();
        }
        double const t = d.uniform(0, 5);
        series<double> rate(f.rate(), 0), observe(f.observe(), 0);
        input_pieces<double> const inputs(f, t, t);
        for (auto* run : {&rate, &observe}) {
            run->set_parameters(std::vector<double>{});
            run->start(t);
            run->advance(
                0, [&x](std::size_t i, std::size_t) { return x[i]; }, inputs);
        }
        auto const expected = craft.rate(t, s, W, delta);
        for (std::size_t i = 0; i < model.about.states.size(); ++i) {
            INFO(model.about.states[i].name);
            double const want = expected.at(model.about.states[i].name);
            CHECK(std::abs(rate.output(i, 0) - want) <= 1e-11 * (1 + std::abs(want)));
        }
        double const scale = 1 + craft.of("position_scale.k");
        std::vector<double> const seen{
            s["u"],         s["v"],         s["r"] + craft.of("gyro_bias.b"),
            scale * s["x"], scale * s["y"], s["psi"] + craft.of("heading_bias.b")};
        for (std::size_t i = 0; i < seen.size(); ++i) {
            CHECK(std::abs(observe.output(i, 0) - seen[i]) <= 1e-14);
        }
    }
}

} // namespace

TEST_CASE("the catalogue has the 24 names of diagnoses") {
    auto const all = hovercraft_example::catalogue();
    CHECK(all.size() == 24);
    CHECK(names(all) == std::set<std::string>{"wind",
                                              "rudder_lag",
                                              "input_delay",
                                              "rudder_trim",
                                              "thrust_offset",
                                              "cg_offset",
                                              "ground_slope",
                                              "battery_sag",
                                              "quadratic_yaw_damping",
                                              "linear_surge_damping",
                                              "payload",
                                              "gyro_bias",
                                              "heading_bias",
                                              "rudder_saturation",
                                              "rudder_deadband",
                                              "position_scale",
                                              "motor_lag",
                                              "dry_yaw_friction",
                                              "friction_anisotropy",
                                              "position_latency",
                                              "thrust_loss_with_speed",
                                              "rudder_backlash",
                                              "stribeck",
                                              "rudder_rate_limit"});
}

TEST_CASE("each effect has the rates and channels of its formula") {
    unsigned seed = 100;
    for (auto const& e : hovercraft_example::catalogue()) {
        INFO(e.name);
        compare({e}, ++seed);
    }
}

TEST_CASE("effects join in any combination and in any order of writing") {
    auto const all = hovercraft_example::catalogue();
    support::draws d(7);
    for (int trial = 0; trial < 40; ++trial) {
        std::vector<effect> some;
        for (auto const& e : all) {
            if (d.below(4) == 0) some.push_back(e);
        }
        if (d.coin()) std::reverse(some.begin(), some.end());
        compare(some, 1000 + static_cast<unsigned>(trial));
    }
    compare(all, 5000);
}

TEST_CASE("neutral effects change nothing") {
    // Lags have their limit at tau = 0, where the right-hand side is not defined.
    std::vector<effect> some;
    for (auto const& e : hovercraft_example::catalogue()) {
        if (e.name != "rudder_lag" && e.name != "motor_lag") some.push_back(e);
    }
    auto plain = with(record_model(hovercraft{}), some);
    plain.input_memory.clear();
    plain.channel_delays.clear();
    std::vector<sivid::signal> const inputs{
        sampled_signal({0.0}, {80.0}, interpolation::hold),
        sampled_signal({0.0, 2.0}, {-0.4, 0.4}, interpolation::linear)};
    flow const base(record_model(hovercraft{}), {}, inputs), affected(plain, {}, inputs);
    support::flow_simulation run(base), run_affected(affected);
    std::vector<double> const start{2, 0.1, 0, 0, 0, 0};
    auto const a = run(start, {}, 0, {1, 2});
    auto const b = run_affected(start, {}, 0, {1, 2});
    for (std::size_t k = 0; k < 2; ++k) {
        for (std::size_t i = 0; i < 6; ++i) {
            CHECK(std::abs(a.outputs[k][i] - b.outputs[k][i]) < 1e-6);
        }
    }
}

TEST_CASE("states that lags add start where the input does") {
    auto const all = hovercraft_example::catalogue();
    auto const find = [&](std::string const& name) {
        for (auto const& e : all) {
            if (e.name == name) return e;
        }
        throw std::logic_error(name);
    };
    experiment e;
    e.name = "S";
    e.inputs = {sampled_signal({0.0}, {80.0}, interpolation::hold),
                sampled_signal({-1.0, 1.0}, {0.0, 0.5}, interpolation::linear)};
    e.initial = box(6);
    e.measurements = {{1.0, 0, interval(0.0)}};
    identification_problem const base{
        record_model(hovercraft{}), {{"Sv"}, {}}, box{interval(0.22)}, {e}};
    auto const lags = affected(base, {find("rudder_lag"), find("motor_lag")});
    REQUIRE(lags.experiments[0].initial.size() == 8);
    // Effects are joined in their own order: sag and motor lag stand behind the rudder's dead band.
    CHECK(lags.model.about.states[6].name == "rudder_lag.delta");
    CHECK(contains(lags.experiments[0].initial[6], 0.25));
    CHECK(width(lags.experiments[0].initial[6]) < 1e-15);
    CHECK(is_point(lags.experiments[0].initial[7]));
    CHECK(lags.choice.unknown.size() == 3);
    CHECK(lags.choice.unknown[1] == "rudder_lag.tau");
    // A dead band in front makes the start depend on its unknown width.
    auto const behind = affected(base, {find("rudder_lag"), find("rudder_deadband")});
    auto const start = behind.experiments[0].initial[6];
    CHECK(contains(start, 0.0));
    CHECK(contains(start, 0.25));
    CHECK(start.upper() < 0.2500001);
    lags.require_valid();
    behind.require_valid();
}
