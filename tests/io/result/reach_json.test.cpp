// SPDX-License-Identifier: MIT
#include <sivid/io/result/reach_json.hpp>

#include "support/catch.hpp"

#include <nlohmann/json.hpp>

#include <limits>
#include <string>
#include <vector>

using namespace sivid;

TEST_CASE("what holds runs back is written by name, and nothing where nobody looked") {
    run_reach r;
    r.scenario = "S1";
    r.until = 1.5;
    r.end = 3;
    r.state = "x";
    r.width = 7.5;
    r.causes = {{false, 0, "a", 0.75}, {true, 0, "x", 0.25}};
    r.moved = 40;
    r.spread = 60;
    r.interrupted = true;
    r.lost = std::numeric_limits<double>::infinity();
    json_writer writer;
    writer.begin_object();
    write_reach(writer, {r});
    writer.end_object();
    auto const json = nlohmann::json::parse(writer.text())["reach"];
    REQUIRE(json.size() == 1);
    CHECK(json[0]["scenario"] == "S1");
    CHECK(json[0]["state"] == "x");
    CHECK(json[0]["until"] == 1.5);
    CHECK(json[0]["end"] == 3);
    CHECK(json[0]["by"] == nlohmann::json{{"a", 0.75}, {"start of x", 0.25}});
    CHECK(json[0]["moved"] == 40);
    CHECK(json[0]["spread"] == 60);
    CHECK(json[0]["interrupted"] == true);
    CHECK(json[0]["lost"].is_null());
    json_writer silent;
    silent.begin_object();
    write_reach(silent, {});
    silent.end_object();
    CHECK(nlohmann::json::parse(silent.text()).empty());
}

TEST_CASE("divisors are written with where they vanish") {
    json_writer writer;
    writer.begin_object();
    write_divisors(writer, {{"a - x", {"x", "output y"}, zeros::some, {{"a", 1.5}, {"x", 1.5}}},
                            {"", {"x"}, zeros::unknown, {}}});
    writer.end_object();
    auto const json = nlohmann::json::parse(writer.text())["divisors"];
    REQUIRE(json.size() == 2);
    CHECK(json[0]["formula"] == "a - x");
    CHECK(json[0]["equations"] == std::vector<std::string>{"x", "output y"});
    CHECK(json[0]["zeros"] == "some");
    CHECK(json[0]["near"] == nlohmann::json{{"a", 1.5}, {"x", 1.5}});
    CHECK(json[1]["zeros"] == "unknown");
    json_writer silent;
    silent.begin_object();
    write_divisors(silent, {});
    silent.end_object();
    CHECK(nlohmann::json::parse(silent.text()).empty());
}
