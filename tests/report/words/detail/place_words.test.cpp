// SPDX-License-Identifier: MIT
#include "report/facts.hpp"
#include "support/catch.hpp"

#include <sivid/report/diagnosis_words.hpp>

#include <string>
#include <utility>

using namespace sivid::report;
using namespace sivid_tests;

namespace {

sivid::suspected_place place(std::string kind, std::string name) {
    sivid::suspected_place p;
    p.kind = std::move(kind);
    p.name = std::move(name);
    return p;
}

} // namespace

TEST_CASE("place words: relations and places in plain words") {
    sivid::broken_relation_report r{"yaw", {"r", "psi"}, true, {"inputs exact"}, {}};
    for (int k = 0; k < 6; ++k) r.windows.push_back({"S4", 1.0 * k, k + 0.5});
    CHECK(missing_fact(relation_words(r, "s"),
                       {"yaw", "r and psi", "proved", "S4", "0 to 0.5\xC2\xA0s", "2 more"}) == "");
    CHECK(missing_fact(relation_words(r, "s"), {"inputs exact"}) == "");
    std::string const suspected = relation_words({"yaw", {"r"}, false, {}, {}}, "s");
    CHECK(missing_fact(suspected, {"yaw", "sensor r", "estimate"}) == "");
    CHECK(claims_of(suspected).proved == 0);
    std::string const alone = relation_words({"yaw", {}, true, {}, {}}, "s");
    CHECK(missing_fact(alone, {"yaw", "proved"}) == "");
    CHECK(alone.find("sensor") == std::string::npos);
    auto sensor = place("sensor", "r");
    CHECK(missing_fact(place_clause(sensor, "s"), {"sensor r", "estimate"}) == "");
    sensor.estimate = 0.25;
    sensor.unit = "rad/s";
    CHECK(missing_fact(place_clause(sensor, "s"), {"sensor r", "0.250\xC2\xA0rad/s", "estimate"}) ==
          "");
}

TEST_CASE("place words: lists, windows and laws") {
    CHECK(window_text({"S4", 1.2, 2}, "s") == "S4, 1.2 to 2\xC2\xA0s");
    CHECK(window_text({"S4", 1.2, 2}, "ms") == "S4, 1.2 to 2\xC2\xA0ms");
    CHECK(window_text({"S4", 0, 0}, "s") == "S4");
    CHECK(window_text({"", 0, 1}, "s") == "0 to 1\xC2\xA0s");
    CHECK(law_text("F_u * r") == law_text("F_u*r"));
    CHECK(law_text("a + b") == "a + b");
    CHECK(place_name(place("", "yaw")) == "yaw");
    CHECK(place_name(place("input", "delta")) == "input delta");
    auto yaw = place("equation", "yaw");
    yaw.proved = true;
    yaw.missing = sivid::interval(-0.5, -0.25);
    yaw.unit = "rad/s^2";
    yaw.law = "r";
    yaw.regime = "r > 1";
    CHECK(missing_fact(place_clause(yaw, "s"), {"yaw equation", "0.5", "0.25", "proved",
                                                "shape of r", "estimate", "r > 1", "estimate"}) ==
          "");
}
