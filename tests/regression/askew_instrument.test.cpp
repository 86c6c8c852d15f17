// SPDX-License-Identifier: MIT
// An instrument of u and v mounted askew: the sway equation, exactly right, was called proved to
// lack something, because no sensor was estimated to be wrong.
#include <sivid/approximate/place/detail/place_estimate.hpp>
#include <sivid/diagnosis/claim/detail/place_report.hpp>
#include <sivid/diagnosis/sensor/detail/sensor_discharge.hpp>

#include "support/catch.hpp"
#include "support/hovercraft_campaign.hpp"

#include <cmath>
#include <functional>

using namespace sivid;
using namespace support;

TEST_CASE("sensors that are wrong in any of the searched ways leave no equation proved") {
    using shown = std::function<void(motion&, double)>;
    std::vector<std::pair<char const*, shown>> const faults{
        {"askew by 0.07 rad",
         [](motion& x, double) {
             double const c = std::cos(0.07), s = std::sin(0.07);
             x = {c * x[0] + s * x[1], c * x[1] - s * x[0], x[2], x[3], x[4], x[5]};
         }},
        {"lever arm of 0.08 m", [](motion& x, double) { x[1] += 0.08 * x[2]; }},
        {"drifting gyro", [](motion& x, double t) { x[2] += 0.02 * t; }},
        {"gyro offset", [](motion& x, double) { x[2] += 0.15; }},
        {"scaled log", [](motion& x, double) { x[0] *= 1.06; }}};
    draws d(71);
    int broken = 0;
    for (auto const& [what, act] : faults) {
        hover_effect effect;
        effect.sensors = [&act = act](double t, std::function<motion(double)> const& at) {
            auto x = at(t);
            act(x, t);
            return x;
        };
        auto const problem = hovercraft_campaign(d, effect, {});
        INFO(what);
        sensor_discharge discharged(problem);
        for (auto const& f : find_broken_relations(problem)) {
            ++broken;
            INFO(f.name);
            CHECK_FALSE(discharged(f));
            // An estimate that blames the equation does not make it proved.
            place_estimate estimate;
            estimate.places.resize(1);
            estimate.places[0].name = f.name;
            auto const places = reported(estimate, {f});
            CHECK_FALSE(places[0].proved);
            CHECK_FALSE(places[0].missing);
        }
    }
    CHECK(broken >= 4);
}

TEST_CASE("an instrument askew is found before an equation is blamed") {
    draws d(72);
    hover_effect effect;
    effect.sensors = [](double t, std::function<motion(double)> const& at) {
        auto x = at(t);
        double const c = std::cos(0.07), s = std::sin(0.07);
        return motion{c * x[0] + s * x[1], c * x[1] - s * x[0], x[2], x[3], x[4], x[5]};
    };
    auto const found = estimate_places(hovercraft_campaign(d, effect, {}));
    REQUIRE_FALSE(found.places.empty());
    CHECK(found.places[0].kind == place_kind::sensor);
    CHECK_THAT(found.places[0].law, ContainsSubstring("cross-talk"));
    CHECK_THAT(std::abs(found.places[0].missing), WithinAbs(0.07, 0.03));
}

TEST_CASE("positions in a frame that is turned are found before an equation is blamed") {
    draws d(74);
    hover_effect effect;
    effect.sensors = [](double t, std::function<motion(double)> const& at) {
        auto x = at(t);
        double const c = std::cos(0.07), s = std::sin(0.07);
        return motion{x[0], x[1], x[2], c * x[3] + s * x[4], c * x[4] - s * x[3], x[5]};
    };
    auto const found = estimate_places(hovercraft_campaign(d, effect, {}));
    REQUIRE_FALSE(found.places.empty());
    CHECK(found.places[0].kind == place_kind::sensor);
    CHECK((found.places[0].name == "x" || found.places[0].name == "y"));
    CHECK_THAT(found.places[0].law, ContainsSubstring("cross-talk"));
    CHECK_THAT(std::abs(found.places[0].missing), WithinAbs(0.07, 0.03));
}

TEST_CASE("an effect on one equation is proved of it with right sensors") {
    draws d(73);
    hover_effect effect; // a thruster beside the axis
    effect.rates = [](double, motion const&, controls const& u, hover_constants const&,
                      motion& dx) { dx[2] += 4e-5 * u[0] * u[0]; };
    auto const problem = hovercraft_campaign(d, effect, {});
    auto const found = find_broken_relations(problem);
    REQUIRE_FALSE(found.empty());
    CHECK(found[0].name == "yaw");
    auto const place = sensor_discharge(problem)(found[0]);
    REQUIRE(place);
    if (place->missing) CHECK(place->missing->value.lower() > 0);
}
