// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/place_report.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("a place is called proved where its equation is, with the proof's window") {
    place_estimate estimate;
    estimated_place p;
    p.name = "r";
    p.missing = 2;
    p.scenario = "E1";
    p.from = 0.1 + 0.2;
    p.to = 1;
    estimate.places.push_back(p);
    p.kind = place_kind::sensor;
    p.name = "x";
    estimate.places.push_back(p);
    estimate.alternatives = {{"u", "v"}, {"sensor x"}};
    relation_finding f;
    f.name = "r";
    f.proved = true;
    f.channels = {"r"};
    f.windows = {{"E2", 1, 2}};
    f.missing = missing_rate{{"E2", 3, 4}, interval(1.0, 1.5), "1"};
    auto const places = reported(estimate, {f});
    REQUIRE(places.size() == 2);
    CHECK(places[0].proved);
    CHECK(places[0].kind == "equation");
    CHECK(places[0].where.scenario == "E2");
    CHECK(places[0].where.from == 3);
    CHECK(places[0].missing->lower() == 1);
    CHECK(places[0].alternatives == std::vector<std::string>{"u and v", "sensor x"});
    CHECK_FALSE(places[1].proved);
    CHECK(places[1].kind == "sensor");
    CHECK(places[1].where.from == 0.3);
    CHECK(places[1].estimate == 2.0);
    auto const relation = reported(f);
    CHECK(relation.equation == "r");
    CHECK(relation.proved);
    REQUIRE(relation.windows.size() == 1);
    CHECK(relation.windows[0].to == 2);
    CHECK(reported(place_estimate{}).empty());
}

TEST_CASE("no equation is called proved where a suspect may be what its proof met") {
    // A biased gyro breaks what links v and r; that proves nothing of the sway alone.
    relation_finding f;
    f.name = "v";
    f.proved = true;
    f.channels = {"v", "r"};
    f.missing = missing_rate{{"E2", 3, 4}, interval(1.0, 1.5), "1"};
    place_estimate estimate;
    estimate.places.resize(2);
    estimate.places[0].name = "v";
    estimate.places[0].scenario = "E1";
    estimate.places[1].name = "r";
    for (auto const kind : {place_kind::sensor, place_kind::input}) {
        estimate.places[1].kind = kind;
        auto const places = reported(estimate, {f});
        CHECK_FALSE(places[0].proved);
        CHECK_FALSE(places[0].missing);
        CHECK(places[0].where.scenario == "E1");
        CHECK(places[1].kind == (kind == place_kind::sensor ? "sensor" : "input"));
    }
    estimate.places[1].kind = place_kind::equation; // its sensors are not suspected
    CHECK(reported(estimate, {f})[0].proved);
}
