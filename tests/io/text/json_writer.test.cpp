// SPDX-License-Identifier: MIT
#include <sivid/io/text/json_writer.hpp>

#include <sivid/io/text/json_document.hpp>

#include "support/catch.hpp"

#include <limits>
#include <random>

using namespace sivid;
using layout = json_writer::layout;

TEST_CASE("documents are laid out in lines or in one line") {
    json_writer json;
    json.begin_object()
        .key("a")
        .integer(-3)
        .key("l")
        .begin_array(layout::one_line)
        .integer(1u)
        .boolean(true)
        .null()
        .end_array();
    json.key("empty")
        .begin_object()
        .end_object()
        .key("o")
        .begin_object(layout::one_line)
        .key("x")
        .string("y")
        .end_object();
    json.end_object();
    CHECK(json.text() == "{\n  \"a\": -3,\n  \"l\": [1, true, null],\n  \"empty\": {},\n  \"o\": "
                         "{\"x\": \"y\"}\n}\n");
}

TEST_CASE("text is escaped") {
    std::string const nasty{"q\" b\\ n\n t\t z\0 \x1f \xC3\xA9", 19};
    json_writer json;
    json.begin_array().string(nasty).end_array();
    CHECK(parse_json("x", json.text()).elements()[0].raw_string() == nasty);
}

TEST_CASE("printed bounds are bounds") {
    std::mt19937_64 random{11};
    std::uniform_real_distribution<double> exponent{-300, 300}, unit{-1, 1};
    for (int i = 0; i < 1000; ++i) {
        double const value = unit(random) * std::pow(10.0, exponent(random));
        json_writer json;
        json.begin_array(layout::one_line)
            .lower_bound(value)
            .upper_bound(value)
            .nearest(value)
            .bounds(interval{value, value})
            .end_array();
        auto const root = parse_json("x", json.text());
        auto const& list = root.elements();
        REQUIRE(list.size() == 4);
        CAPTURE(json.text());
        // The double is an exact decimal of many digits; its tightest enclosure is itself.
        CHECK(lower(*enclose(list[0].number())) <= value);
        CHECK(upper(*enclose(list[0].number())) <= value);
        CHECK(lower(*enclose(list[1].number())) >= value);
        CHECK(*nearest(list[2].number()) == value);
        CHECK(list[3].elements()[0].number() == list[0].number());
        CHECK(list[3].elements()[1].number() == list[1].number());
    }
}

TEST_CASE("what is not finite is null") {
    double const infinity = std::numeric_limits<double>::infinity();
    json_writer json;
    json.begin_array(layout::one_line)
        .lower_bound(-infinity)
        .upper_bound(infinity)
        .nearest(std::nan(""))
        .bounds(interval{-infinity, 1})
        .end_array();
    CHECK(json.text() == "[null, null, null, [null, 1]]\n");
}

TEST_CASE("wrong use of the writer is noticed") {
    CHECK_THROWS_AS(json_writer{}.key("a"), std::logic_error);
    CHECK_THROWS_AS(json_writer{}.begin_object().integer(1), std::logic_error);
    CHECK_THROWS_AS(json_writer{}.begin_object().end_array(), std::logic_error);
    CHECK_THROWS_AS(json_writer{}.begin_object().key("a").end_object(), std::logic_error);
    CHECK_THROWS_AS(json_writer{}.integer(1).integer(2), std::logic_error);
    CHECK_THROWS_AS(json_writer{}.begin_object().text(), std::logic_error);
}
