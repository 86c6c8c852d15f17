// SPDX-License-Identifier: MIT
#include <sivid/io/result/detail/identifiability_json.hpp>

#include "io/small_identification.hpp"
#include "support/catch.hpp"

#include <sivid/io/identification_json.hpp>

#include <nlohmann/json.hpp>

#include <limits>

using namespace sivid;

TEST_CASE("what data can tell is written with what is proved of it") {
    auto const problem = io_support::two_rates_problem();
    auto const told = identifiability_of(problem, box{interval(1.0), interval(0.5)});
    json_writer writer;
    write_identifiability(writer, told);
    auto const json = nlohmann::json::parse(writer.text());
    CHECK(json["unknowns"] == std::vector<std::string>{"a", "b"});
    CHECK(json["at"]["a"] == std::vector<double>{1, 1});
    CHECK(json["at"]["b"] == std::vector<double>{0.5, 0.5});
    CHECK(json["outputs"] == 6);
    CHECK(json["outputs_not_reached"] == 0);
    CHECK(json["rank"] == nlohmann::json{{"least", 1}, {"most", 1}, {"approximate", 1}});
    REQUIRE(json["free"].size() == 1);
    CHECK(json["free"][0]["kind"] == "scaling");
    CHECK(json["free"][0]["proved"] == true);
    int const a = json["free"][0]["weights"]["a"], b = json["free"][0]["weights"]["b"];
    CHECK((a != 0 && a == -b));
    REQUIRE(json["fixed"].size() == 1);
    CHECK(json["fixed"][0] == nlohmann::json{{"formula", "a*b"}, {"proved", true}});
    REQUIRE(json["directions"].size() == told.directions.size());
    CHECK(json["directions"][0]["noticed"] == told.directions[0].noticed);
    CHECK(json["directions"][0]["components"]["b"] == told.directions[0].components[1]);
}

TEST_CASE("numbers that are none and ranks that differ are said as they are") {
    identifiability told;
    told.unknowns = {{"a", 0, {}, interval(0.0, 1.0)}, {"x(run)", 0, 0, interval(0.0, 1.0)}};
    told.parameters = {interval(0.25, 0.5)};
    told.starts = {box{interval(0.5, 1.0)}};
    told.most_rank = 2;
    told.missing = 3;
    told.nearly_free = {{motion_kind::translation, {0, 2}, 0.5, false}};
    told.directions = {{{1.0, -0.5}, std::numeric_limits<double>::infinity()}};
    json_writer writer;
    write_identifiability(writer, told);
    auto const json = nlohmann::json::parse(writer.text());
    CHECK(json["at"]["a"] == std::vector<double>{0.25, 0.5});
    CHECK(json["at"]["x(run)"] == std::vector<double>{0.5, 1});
    CHECK(json["rank"]["least"] == 0);
    CHECK(json["rank"]["most"] == 2);
    CHECK(json["outputs_not_reached"] == 3);
    CHECK(json["hardly_noticed"][0]["kind"] == "translation");
    CHECK(json["hardly_noticed"][0]["weights"] == nlohmann::json{{"x(run)", 2}});
    CHECK(json["hardly_noticed"][0]["proved"] == false);
    CHECK(json["directions"][0]["noticed"].is_null());
}

TEST_CASE("a result file holds it where it was asked for") {
    auto const problem = io_support::two_rates_problem();
    auto const found = io_support::two_rates_result(problem);
    REQUIRE(found.witness);
    auto const told = identifiability_of(problem, point_box(found.witness->parameters));
    auto const with = nlohmann::json::parse(
        identification_json(problem, found, {.dataset = "d", .identifiability = &told}));
    CHECK(with["identifiability"]["rank"]["least"] == 1);
    auto without = with;
    without.erase("identifiability");
    CHECK(without == nlohmann::json::parse(identification_json(problem, found, {.dataset = "d"})));
}
