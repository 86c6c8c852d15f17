// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/claim/detail/place_report.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("a place is called proved where its equation is and with the proof's window") {
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
    // As long as its sensors may be wrong the relation is what is proved.
    auto const open = reported(estimate, {f});
    CHECK_FALSE(open[0].proved);
    CHECK_FALSE(open[0].missing);
    CHECK(open[0].where.scenario == "E1");
    CHECK(open[0].estimate == 2.0);
    f.place = proved_place{{"inputs exact"}, f.missing};
    auto const places = reported(estimate, {f});
    REQUIRE(places.size() == 2);
    CHECK(places[0].proved);
    CHECK(places[0].assumptions == std::vector<std::string>{"inputs exact"});
    CHECK_FALSE(places[0].estimate); // nothing was estimated in that window
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
    f.place = proved_place{{}, missing_rate{{"E2", 3, 4}, interval(1.0, 1.5), "1"}};
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

TEST_CASE("what is missing and its estimate are of one window and contain no zero") {
    relation_finding f;
    f.name = "v";
    f.proved = true;
    f.place = proved_place{{}, missing_rate{{"E2", 1, 3}, interval(1.0, 1.5), "1"}};
    place_estimate estimate;
    estimate.places.resize(1);
    auto& p = estimate.places[0];
    p.name = "v";
    p.scenario = "E1";
    p.to = 1;
    p.missing = -7;
    p.rates = {{"E1", {0, 1}, {-7, -7}, {}}, {"E2", {0, 2, 4}, {0, 2, 0}, {}}};
    auto place = reported(estimate, {f})[0];
    CHECK(place.where.scenario == "E2");
    CHECK(place.estimate == 1.5);
    CHECK_THAT(*mean_missing(p, {"E2", 1, 3}), WithinAbs(1.5, 1e-12));
    CHECK_FALSE(mean_missing(p, {"E3", 1, 3}));
    p.rates[1].values = {0, 9, 0}; // what is proved is known better
    CHECK(reported(estimate, {f})[0].estimate == 1.5);
    f.place->missing->value = interval(-0.5, 1.5);
    place = reported(estimate, {f})[0];
    CHECK(place.proved);
    CHECK_FALSE(place.missing);
    CHECK(place.where.scenario == "E1");
    CHECK(place.estimate == -7.0);
}

TEST_CASE("no equation is called proved where instruments alone explain the data") {
    relation_finding f;
    f.name = "v";
    f.proved = true;
    f.place = proved_place{{}, std::nullopt};
    place_estimate estimate;
    estimate.places.resize(1);
    estimate.places[0].name = "v";
    estimate.tried = {{{}, 3, 9, 0}, {{"sensor u, v", "v"}, 0.8, 9, 2}, {{"sensor r"}, 1.2, 9, 1}};
    CHECK(reported(estimate, {f})[0].proved);
    estimate.tried.push_back({{"sensor u, v"}, 0.9, 9, 1});
    CHECK(instruments_explain(estimate));
    CHECK_FALSE(reported(estimate, {f})[0].proved);
}

TEST_CASE("a definition is not blamed but its sensors") {
    place_estimate estimate;
    estimate.places.resize(2);
    estimate.places[0].kind = place_kind::kinematic;
    estimate.places[0].name = "psi";
    estimate.places[0].missing = 20;
    estimate.places[0].law = "r";
    estimate.places[0].sensors = {"heading", "gyro"};
    estimate.places[1].kind = place_kind::sensor;
    estimate.places[1].name = "heading";
    estimate.places[1].missing = 0.25;
    estimate.places[1].law = "offset";
    auto const places = reported(estimate);
    REQUIRE(places.size() == 1); // one sensor is one place
    CHECK(places[0].kind == "sensor");
    CHECK(places[0].name == "heading");
    CHECK(places[0].estimate == 0.25);
    CHECK(places[0].law == "offset");
    CHECK(places[0].alternatives == std::vector<std::string>{"sensor gyro"});
    estimate.places.pop_back();
    auto const alone = reported(estimate);
    CHECK(alone[0].kind == "sensor");
    CHECK_FALSE(alone[0].estimate);
    CHECK(alone[0].law.empty());
}
