// SPDX-License-Identifier: MIT
#include <sivid/io/diagnosis_json.hpp>

#include "support/catch.hpp"

#include <nlohmann/json.hpp>

using namespace sivid;

TEST_CASE("an empty diagnosis is a valid document") {
    auto const text = diagnosis_json({}, "nothing");
    CHECK(nlohmann::json::accept(text));
    CHECK_THAT(text, ContainsSubstring("\"verdict\": \"undecided\""));
    CHECK_THAT(text, ContainsSubstring("\"inflation\": [0, null]"));
    CHECK_THAT(text, ContainsSubstring("\"fit\": null"));
    CHECK_THAT(text, ContainsSubstring("\"next\": null"));
    CHECK_THAT(text, ContainsSubstring("\"remainder\": null"));
}

TEST_CASE("what stays unexplained is written with its size and place") {
    diagnosis d;
    d.answer = answer_kind::unexplained;
    suspected_place tank;
    tank.kind = "equation";
    tank.name = "upper tank";
    d.remainder = unexplained_remainder{{"overflow"}, interval(1.5, 2.5), {tank}};
    auto const json = nlohmann::json::parse(diagnosis_json(d, "tanks"));
    CHECK(json["remainder"]["effects"][0] == "overflow");
    CHECK(json["remainder"]["inflation"][1] == 2.5);
    CHECK(json["remainder"]["where"][0]["name"] == "upper tank");
}

TEST_CASE("what a simulator has to take is written, with its symbols") {
    diagnosis d;
    d.change = {{"v' becomes v' - k * v"}, {{"film.k", "k"}}};
    auto const json = nlohmann::json::parse(diagnosis_json(d, "cart"))["answer"];
    CHECK(json["formulas"] == nlohmann::json{"v' becomes v' - k * v"});
    CHECK(json["symbols"]["film.k"] == "k");
    CHECK(nlohmann::json::parse(diagnosis_json({}, "cart"))["answer"]["formulas"].empty());
}

TEST_CASE("measurements that stand alone are written with their factor and its witness") {
    diagnosis d;
    d.confined.push_back(
        {"v", {"S1", "S3"}, interval(1.5, 2.25), {{{"k", "1/s", 3}}, {}}, {"held"}});
    d.confined.push_back({"", {"S2"}, interval(0, 4), {}, {}});
    d.confined[0].correlated = error_correlation{0.5, 0.25};
    d.confined[1].steps = reading_steps{0.125, "m/s", true};
    d.confined[0].grows = noise_growth{noise_growth::with::rate, interval(0.5, 0.75),     42,
                                       {{{"k", "1/s", 5}}, {}},  {{{"k", "1/s", 6}}, {}}, "s"};
    auto const json = nlohmann::json::parse(diagnosis_json(d, "cart"))["gap"]["confined"];
    REQUIRE(json.size() == 2);
    CHECK(json[0]["channel"] == "v");
    CHECK(json[0]["scenarios"] == nlohmann::json{"S1", "S3"});
    CHECK(json[0]["factor"] == nlohmann::json{1.5, 2.25});
    CHECK(json[0]["witness"]["parameters"]["k"] == 3);
    CHECK(json[0]["assumptions"][0] == "held");
    CHECK(json[0]["grows"]["with"] == "rate");
    CHECK(json[0]["grows"]["unit"] == "s");
    CHECK(json[0]["correlated"]["of_neighbours"] == 0.5);
    CHECK(json[0]["correlated"]["seconds"] == 0.25);
    CHECK(json[1]["correlated"].is_null());
    CHECK(json[0]["steps"].is_null());
    CHECK(json[1]["steps"]["size"] == 0.125);
    CHECK(json[1]["steps"]["unit"] == "m/s");
    CHECK(json[1]["steps"]["cut_off"] == true);
    CHECK(json[0]["grows"]["coefficient"] == nlohmann::json{0.5, 0.75});
    CHECK(json[0]["grows"]["likelier"] == 42);
    CHECK(json[0]["grows"]["witness"]["parameters"]["k"] == 5);
    CHECK(json[0]["grows"]["shown"]["parameters"]["k"] == 6);
    CHECK(json[1]["channel"].is_null());
    CHECK(json[1]["grows"].is_null());
    CHECK(nlohmann::json::parse(diagnosis_json({}, "cart"))["gap"]["confined"].empty());
}

TEST_CASE("all that a diagnosis says is written, bounds outward and names quoted") {
    diagnosis d;
    d.gap = gap_verdict::certified;
    d.inflation = interval(0.1 + 0.2, 4);
    d.relations.push_back({"yaw", {"r", "psi"}, true, {"|r''| <= 40 rad/s^3"}, {{"S4", 1.2, 2}}});
    suspected_place yaw;
    yaw.kind = "equation";
    yaw.name = "yaw";
    yaw.where = {"S4", 1.2, 2};
    yaw.missing = interval(-0.42, -0.18);
    yaw.law = "F_u \"quoted\"";
    d.where.push_back(yaw);
    cause c;
    c.effects = {"rudder_lag"};
    c.verdict = cause_verdict::explains;
    c.inflation = interval(0.5, 0.75);
    c.parameters.push_back({"rudder_lag.tau", "s", 0.169, interval(0.125, 0.25)});
    c.parameters.push_back({"rudder_lag.other", "s", 0.5, std::nullopt});
    c.witness = named_witness{{{"Sv", "m^2", 0.1 + 0.2, std::nullopt}},
                              {{"S1", {{"u", "m/s", 2, std::nullopt}}}}};
    c.holdout = holdout_figures{};
    c.holdout->channels = {"u"};
    c.holdout->rmse_before = {0.5};
    d.causes.push_back(c);
    d.answer = answer_kind::effects;
    d.effects = {"rudder_lag"};
    d.indistinguishable = {{"input_delay"}, {"wind", "payload"}};
    d.next = next_experiment{"zigzag", {{"amplitude", "rad", 0.25, std::nullopt}}, 7.5, false};
    auto const text = diagnosis_json(d, "dev \"7\"");
    CHECK(nlohmann::json::accept(text));
    for (auto const* part :
         {"\"inflation\": [0.3", ", 4]", "\"sensors\": [\"r\", \"psi\"]",
          "{\"scenario\": \"S4\", \"from\": 1.2, \"to\": 2}", "\"law\": \"F_u \\\"quoted\\\"\"",
          "\"regime\": null", "\"rudder_lag.tau\": [0.125, 0.25]", "\"rudder_lag.other\": null",
          "\"Sv\": 0.30000000000000004", "\"S1\": {\"u\": 2}", "\"rmse_before\": {\"u\": 0.5}",
          "[\"wind\", \"payload\"]", "\"amplitude\": 0.25", "\"dataset\": \"dev \\\"7\\\"\""}) {
        CHECK_THAT(text, ContainsSubstring(part));
    }
}

TEST_CASE("what was tried, and every constant with its prior, is written") {
    diagnosis d;
    d.answer = answer_kind::open;
    d.tried.singles = {8, 8};
    d.tried.pairs = {0, 27};
    d.constants = {{"k", "1/s", 3, std::nullopt, interval(3, 4)},
                   {"b", "1", 2, interval(1.5, 2.5), interval(1, 3)}};
    d.at_ends = {{{"wind"}, d.constants[0], prior_end::lower}};
    d.combinations = {
        {{"k*b^2", "1/s", 12, interval(11, 13), interval(3, 36)},
         {{"k", 1}, {"e.b", 2}},
         false,
         true},
        {{"k + b", "1", 5, interval(4, 6), interval(4, 7)}, {{"k", 1}, {"e.b", 1}}, true, true}};
    auto const answer = nlohmann::json::parse(diagnosis_json(d, "x"))["answer"];
    auto const& product = answer["combinations"][0];
    CHECK(product["formula"] == "k*b^2");
    CHECK(product["factors"]["e.b"] == 2);
    CHECK(answer["combinations"][1]["terms"]["e.b"] == 1);
    CHECK_FALSE(answer["combinations"][1].contains("factors"));
    CHECK(product["value"] == 12);
    CHECK(product["hull"][0] == 11);
    CHECK(product["prior"][1] == 36);
    CHECK(answer["kind"] == "open");
    CHECK(answer["tried"]["singles"]["tried"] == 8);
    CHECK(answer["tried"]["pairs"]["planned"] == 27);
    CHECK(answer["tried"]["pairs"]["tried"] == 0);
    CHECK(answer["constants"]["k"]["end"] == "lower");
    CHECK(answer["constants"]["k"]["hull"].is_null());
    CHECK(answer["constants"]["b"]["end"].is_null());
    CHECK(answer["constants"]["b"]["hull"][1] == 2.5);
    CHECK(answer["verified"] == false);
    CHECK(answer["at_ends"][0]["constant"] == "k");
    CHECK(answer["at_ends"][0]["effects"][0] == "wind");
}
