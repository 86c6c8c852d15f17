// SPDX-License-Identifier: MIT
#include <sivid/approximate/place/place.hpp>

#include "../../../examples/hovercraft/model.hpp"
#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("the places of the hovercraft: equations, geometry, inputs, sensors") {
    auto const model = record_model(hovercraft{});
    auto const all = places_of(model, std::vector<bool>(6, true), {true, true});
    std::vector<std::string> names;
    std::vector<double> costs;
    for (auto const& p : all) {
        names.push_back(p.name);
        costs.push_back(p.cost);
    }
    CHECK(names == std::vector<std::string>{"surge", "sway", "yaw", "x", "y", "psi", "W", "delta",
                                            "u", "v", "r", "x", "psi", "u, v", "x, y"});
    CHECK(costs == std::vector<double>{1, 1, 1, 2.5, 2.5, 1.5, 1.5, 1.5, 1, 1, 1, 1, 1, 1, 1});
    CHECK(all[13].askew); // u and v of one instrument
    CHECK(all[13].members == std::vector<std::size_t>{0, 1});
    CHECK(all[14].askew); // positions in a frame that is turned
    CHECK(all[14].members == std::vector<std::size_t>{3, 4});
    CHECK(all[5].sensors == std::vector<std::string>{"psi", "r"}); // of psi' = r
    CHECK(all[3].sensors == std::vector<std::string>{"x", "u", "v", "psi"});
    CHECK(all[2].kind == place_kind::equation);
    CHECK(all[5].kind == place_kind::kinematic);
    CHECK(all[7].kind == place_kind::input);
    CHECK(all[11].is_sensor());
    CHECK(all[11].members == std::vector<std::size_t>{3, 4}); // the position
    auto const poses = places_of(model, {false, false, false, true, true, true}, {false, true});
    CHECK(poses.size() == 6 + 1 + 2 + 1);
}
