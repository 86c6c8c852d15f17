// SPDX-License-Identifier: MIT
#include <sivid/importing/detail/import_protocol.hpp>

#include "support/catch.hpp"

#include <nlohmann/json.hpp>

using sivid::import_protocol;
using kind = import_protocol::kind;

TEST_CASE("notes of one kind, scenario, field and reason become one") {
    import_protocol p;
    p.dataset = "d";
    p.mapping = "m.json";
    p.scenarios.push_back({"A", "fit", "a.csv", 20, 2, 19, 18, 30, "1.5"});
    for (std::size_t line : {7u, 3u, 4u, 5u}) p.add(kind::dropped, "A", "h", "no reading", line);
    p.add(kind::dropped, "A", "u", "no reading", 9);
    p.add(kind::assumed, "A", "", "inputs exact");
    p.add(kind::decided, "B", "", "a \"quoted\" reason", 2);
    REQUIRE(p.notes().size() == 4);
    CHECK(p.notes()[0].lines.size() == 4);
    auto const text = p.text();
    CHECK_THAT(
        text, ContainsSubstring(
                  "scenario A (fit): a.csv, lines 2 to 19 of 20, 18 rows, 30 measurements, 1.5 s"));
    CHECK_THAT(text, ContainsSubstring("  dropped: h: no reading (4 lines: 3-5, 7)\n"));
    CHECK_THAT(text, ContainsSubstring("  dropped: u: no reading (1 line: 9)\n"));
    CHECK_THAT(text, ContainsSubstring("  assumed: inputs exact\n"));
    CHECK_THAT(text, ContainsSubstring("became no scenario\n  decided: a \"quoted\" reason"));
    auto const json = nlohmann::json::parse(p.json());
    CHECK(json["format"] == "sivid-import-1");
    CHECK(json["scenarios"][0]["measurements"] == 30);
    CHECK(json["scenarios"][0]["duration"] == "1.5");
    CHECK(json["notes"][0]["count"] == 4);
    CHECK(json["notes"][0]["lines"] == nlohmann::json::parse("[[3,5],[7,7]]"));
    CHECK(json["notes"][2]["lines"].empty());
    CHECK(json["notes"][3]["kind"] == "decided");
}

TEST_CASE("long lists of lines are cut in the text alone") {
    import_protocol p;
    for (std::size_t line = 1; line < 200; line += 2) p.add(kind::dropped, "A", "", "blank", line);
    CHECK_THAT(p.text(), ContainsSubstring("(100 lines: 1, 3, 5"));
    CHECK_THAT(p.text(), ContainsSubstring("23, ...)"));
    CHECK(nlohmann::json::parse(p.json())["notes"][0]["lines"].size() == 100);
}

TEST_CASE("proposed bounds are told with what they rest on") {
    import_protocol p;
    p.bounds.push_back({"h", "m", "0.031", {{"neighbours", 0.031, 1.0 / 301, {"no drift"}}}});
    p.bounds.push_back(
        {"u", "", "", {{"step", 0.5, 0, {"rounded"}}, {"neighbours", 0, 0, {"short"}}}});
    CHECK_THAT(p.text(),
               ContainsSubstring("error bound of h, proposed: 0.031 m\n  neighbours: 0.031 "
                                 "m, worse at most 0.333 %\n    assumed: no drift\n"));
    CHECK_THAT(p.text(),
               ContainsSubstring("error bound of u is stated; candidates\n  step: 0.5\n    "
                                 "assumed: rounded\n  neighbours: none\n    short\n"));
    CHECK_THAT(p.text(), ContainsSubstring("--by-bounds"));
    auto const json = nlohmann::json::parse(p.json());
    CHECK(json["bounds"][0]["candidates"][0]["rests_on"][0] == "no drift");
    CHECK(json["bounds"][1]["candidates"][0]["bound"] == 0.5);
}

TEST_CASE("the JSON is UTF-8 whatever the names are") {
    import_protocol p;
    p.dataset = "\xC3\xBC \xE2\x82\xAC \xF0\x9F\x98\x80"; // valid ones stay
    p.add(kind::dropped, "A\xC3", "\xED\xA0\x80", "\xFF\x80 \xE0\x80\x80 \xF5 \xC0\xAF");
    for (int i = 0; i < 256; ++i)
        p.add(kind::changed, std::string(1, static_cast<char>(i)), "", "\xE2\x82");
    auto const json = nlohmann::json::parse(p.json());
    CHECK(json["dataset"] == p.dataset);
    CHECK(json["notes"][0]["scenario"] == "A?");
    CHECK(json["notes"][0]["reason"] == "?? ??? ? ??");
}

TEST_CASE("lines as ranges") {
    using list = std::vector<std::pair<std::size_t, std::size_t>>;
    CHECK(import_protocol::ranges({}).empty());
    CHECK(import_protocol::ranges({5, 4, 4, 9}) == list{{4, 5}, {9, 9}});
}
