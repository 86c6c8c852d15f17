// SPDX-License-Identifier: MIT
#include <sivid/io/identification_json.hpp>

#include "io/small_identification.hpp"
#include "support/catch.hpp"

#include <nlohmann/json.hpp>

using namespace sivid;
using io_support::two_rates_problem;
using io_support::two_rates_result;

TEST_CASE("the result file of a consistent identification holds what was proved") {
    auto const problem = two_rates_problem();
    auto const found = two_rates_result(problem);
    auto const json = nlohmann::json::parse(
        identification_json(problem, found, {.dataset = "d", .further_assumptions = {"more"}}));

    CHECK(json["format"] == "sivid-identification-1");
    CHECK(json["dataset"] == "d");
    CHECK(json["verdict"] == "consistent");
    CHECK(json["stop_reason"] == to_string(found.reason));
    REQUIRE(json["parameters"].size() == 2);
    for (auto const* name : {"a", "b"}) {
        auto const& hull = json["parameters"][name]["hull"];
        auto const j = name[0] == 'a' ? 0u : 1u;
        CHECK(hull[0].get<double>() <= found.hull[j].lower());
        CHECK(hull[1].get<double>() >= found.hull[j].upper());
    }
    CHECK(json["parameters"]["a"]["unit"] == "1/s");
    REQUIRE(json["combinations"].size() == 1);
    CHECK(json["combinations"][0]["formula"] == "a*b");
    CHECK(json["combinations"][0]["hull"][0].get<double>() <= 0.5);
    CHECK(json["combinations"][0]["hull"][1].get<double>() >= 0.5);
    double const inner = json["volume"]["inner"][0], outer = json["volume"]["outer"][1];
    CHECK(0 < inner);
    CHECK(inner <= outer);
    CHECK(outer <= 1);
    REQUIRE(found.witness);
    CHECK(json["witness"]["parameters"]["a"].get<double>() == found.witness->parameters[0]);
    CHECK(json["witness"]["initial"]["run"]["x"] == 2.0);
    CHECK(json["assumptions"] == std::vector<std::string>{"inputs exact", "more"});
    CHECK(json["outliers"]["budget"]["run"] == 0);
    CHECK(json["outliers"]["forced"].empty());
    CHECK(json["boxes"] == found.boxes);
    CHECK(json["integrations"] == found.integrations);
    CHECK(json["seconds"].get<double>() == found.seconds);
}

TEST_CASE("the result file of an inconsistent identification has no hull and no witness") {
    auto const problem = io_support::impossible_problem();
    auto const found = two_rates_result(problem);
    auto const json = nlohmann::json::parse(identification_json(problem, found, {.dataset = "d"}));
    CHECK(json["verdict"] == "inconsistent");
    CHECK(json["parameters"]["a"]["hull"].is_null());
    CHECK(json["witness"].is_null());
    CHECK(json["volume"]["outer"] == std::vector<double>{0, 0});
}

TEST_CASE("an outlier that every feasible parameter violates is listed with time and channel") {
    auto const problem = two_rates_problem(true);
    auto const found = two_rates_result(problem);
    auto const json = nlohmann::json::parse(identification_json(problem, found, {.dataset = "d"}));
    CHECK(json["verdict"] == "consistent");
    CHECK(json["outliers"]["budget"]["run"] == 1);
    REQUIRE(json["outliers"]["forced"].size() == 1);
    CHECK(json["outliers"]["forced"][0]["scenario"] == "run");
    CHECK(json["outliers"]["forced"][0]["t"] == 1.5);
    CHECK(json["outliers"]["forced"][0]["channel"] == "x");
}

TEST_CASE("a share of the prior is never below 0 or above 1") {
    CHECK(share_of_whole(interval(0.25, 1.0000001)).upper() == 1);
    CHECK(share_of_whole(interval(0.25, 0.5)).lower() == 0.25);
}
