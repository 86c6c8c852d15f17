// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <sivid/report/place_words.hpp>

using namespace sivid::report;

TEST_CASE("place words: relations and places in plain words") {
    relation_view r{"yaw", {"r", "psi"}, true, {}, {"inputs exact"}};
    for (int k = 0; k < 6; ++k) r.windows.push_back({"S4", 1.0 * k, k + 0.5});
    CHECK_THAT(
        relation_words(r),
        StartsWith(
            "The yaw equation and the sensors r and psi cannot hold together, whatever the "
            "parameters of the prior (proved if inputs exact). Shown by S4, 0 to 0.5\xC2\xA0s; "));
    CHECK_THAT(relation_words(r), EndsWith("and 2 more."));
    CHECK(relation_words({"yaw", {"r"}, false, {}, {}}) ==
          "The yaw equation and the sensor r seem not to hold together (estimate).");
    CHECK(relation_words({"yaw", {}, true, {}, {}}) ==
          "The yaw equation cannot hold, whatever the parameters of the prior (proved).");
    CHECK(place_clause({.kind = "sensor", .name = "r"}) == "the sensor r is suspected (estimate)");
    CHECK(place_clause({.kind = "sensor", .name = "r", .estimate = 0.25, .unit = "rad/s"}) ==
          "the sensor r is off by \xE2\x89\x88\xE2\x80\xAF"
          "0.250\xC2\xA0rad/s (estimate)");
}

TEST_CASE("place words: lists, windows and laws") {
    CHECK(enumeration({}) == "");
    CHECK(enumeration({"a"}) == "a");
    CHECK(enumeration({"a", "b", "c"}, " or ") == "a, b or c");
    CHECK(window_text({"S4", 1.2, 2}) == "S4, 1.2 to 2\xC2\xA0s");
    CHECK(window_text({"S4", 0, 0}) == "S4");
    CHECK(window_text({"", 0, 1}) == "0 to 1\xC2\xA0s");
    CHECK(law_text("F_u * r") == law_text("F_u*r"));
    CHECK(law_text("a + b") == "a + b");
    CHECK(place_name({.name = "yaw"}) == "yaw");
    CHECK(place_name({.kind = "input", .name = "delta"}) == "input delta");
    CHECK_THAT(place_clause({.kind = "equation",
                             .name = "yaw",
                             .proved = true,
                             .missing = {-0.5, -0.25},
                             .unit = "rad/s^2",
                             .law = "r",
                             .regime = "r > 1"}),
               StartsWith("the yaw equation lacks ") &&
                   EndsWith("(proved), in the shape of r (estimate), where r > 1 (estimate)"));
}
