// SPDX-License-Identifier: MIT
// What actuators do: each effect of the servo's model, planted and found again.
#include <sivid/approximate/fit/fit.hpp>
#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/text/read_model.hpp>

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

using namespace sivid;

namespace {

/// Three seconds of a pendulum that the servo swings, through rest and to its limits; then off.
experiment swing() {
    std::vector<double> t, duty, on;
    for (int k = 0; k <= 300; ++k) {
        t.push_back(0.01 * k);
        duty.push_back(0.5 * std::sin(3.1 * t.back()) + 0.4 * std::sin(11 * t.back() + 1));
        on.push_back(k < 240 ? 1 : 0);
    }
    experiment e;
    e.name = "swing";
    e.initial = {interval(0.3), interval(0)};
    e.inputs = {sampled_signal(t, duty, interpolation::linear),
                sampled_signal({0.0}, {7.4}, interpolation::linear),
                sampled_signal(t, on, interpolation::hold)};
    return e;
}

std::vector<std::vector<double>> outputs(identification_problem const& p,
                                         std::vector<double> const& parameters) {
    std::vector<double> times;
    for (int k = 1; k <= 150; ++k) times.push_back(0.02 * k);
    auto const& e = p.experiments[0];
    return simulate(std::make_shared<approximate_model>(p.model, p.choice, e.inputs), e.inputs,
                    mid(e.initial), parameters, 0, times)
        .outputs;
}

} // namespace

TEST_CASE("on a stiff spring the servo's pendulum moves as without one") {
    auto const text = read_model(SIVID_SOURCE_DIR "/examples/servo/servo.toml");
    identification_problem plain{text.model, {{"rotor"}, {}}, {interval(0, 0.01)}, {swing()}};
    plain.experiments[0].measurements = {{0.02, 0, interval(-1, 1)}};
    auto const spring = std::find_if(text.effects.begin(), text.effects.end(),
                                     [](auto const& e) { return e.name == "flexible_joint"; });
    auto const elastic = affected(plain, {*spring}); // rotor, share, frequency, loss
    auto const with = [&](double frequency) {
        double most = 0;
        auto const a = outputs(plain, {0.002}), b = outputs(elastic, {0.002, 1, frequency, 0.05});
        for (std::size_t k = 0; k < a.size(); ++k)
            most = std::max(most, std::abs(a[k][0] - b[k][0]));
        return most;
    };
    CHECK(with(20) > 0.05);
    CHECK(with(800) < 0.005);
}

TEST_CASE("each effect of an actuator is found again where it was planted") {
    auto const text = read_model(SIVID_SOURCE_DIR "/examples/servo/servo.toml");
    CHECK(text.effects.size() == 20);
    for (auto const& e : text.effects) {
        CAPTURE(e.name);
        identification_problem plain{text.model, {{"kt"}, {}}, {interval(0.36, 0.38)}, {swing()}};
        std::vector<double> planted{0.37};
        for (auto const& p : e.parameters) {
            auto const neutral = nearest(p.neutral), most = nearest(p.upper);
            planted.push_back(neutral + 0.4 * (most - neutral));
        }
        plain.experiments[0].measurements = {{0.02, 0, interval(-1, 1)}};
        auto const seen = outputs(affected(plain, {e}), planted);
        auto& record = plain.experiments[0].measurements;
        record.clear();
        for (std::size_t k = 0; k < seen.size(); ++k)
            for (std::size_t c = 0; c < 2; ++c) {
                double const error = c == 0 ? 0.002 : 0.05;
                record.push_back({0.02 * static_cast<double>(k + 1), c,
                                  interval(seen[k][c] - error, seen[k][c] + error)});
            }
        CHECK(fit(plain).inflation > 1.5);
        CHECK(fit(affected(plain, {e})).inflation < 1);
    }
}
