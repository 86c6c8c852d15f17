// SPDX-License-Identifier: MIT
#include <sivid/io/text/json_writer.hpp>

#include <sivid/io/text/json_document.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

using namespace sivid;
using layout = json_writer::layout;

TEST_CASE("documents are laid out in lines or in one line") {
    json_writer json;
    json.begin_object().members("a", -3).key("l").begin_array(layout::one_line);
    json.value(1u).value(true).null().end_array();
    json.key("empty").begin_object().end_object().key("o").object("x", "y").end_object();
    CHECK(json.text() == "{\n  \"a\": -3,\n  \"l\": [1, true, null],\n  \"empty\": {},\n  \"o\": "
                         "{\"x\": \"y\"}\n}\n");
}

TEST_CASE("text is escaped") {
    std::string const nasty{"q\" b\\ n\n t\t z\0 \x1f \xC3\xA9", 19};
    json_writer json;
    json.begin_array().value(nasty).end_array();
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
            .value(value)
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
        .value(std::nan(""))
        .bounds(interval{-infinity, 1})
        .end_array();
    CHECK(json.text() == "[null, null, null, [null, 1]]\n");
}

TEST_CASE("values are written by their type") {
    std::optional<interval> const nothing, something = interval{0.5, 2};
    json_writer json;
    json.object("truth", false, "count", std::size_t{3}, "text", std::string{"t"}, "number", 0.1,
                "stated", *exact_decimal::parse("0.100"), "none", nothing, "range", something,
                "list", std::vector<std::vector<std::string>>{{"a"}, {}}, "outward",
                interval{0.1 + 0.2, 1});
    auto const text = json.text();
    CHECK_THAT(text,
               StartsWith("{\"truth\": false, \"count\": 3, \"text\": \"t\", \"number\": 0.1, "
                          "\"stated\": 0.1, \"none\": null, \"range\": [0.5, 2], "
                          "\"list\": [[\"a\"], []], \"outward\": [0.3"));
    CHECK(json_writer{}.value(intersect(interval{0, 1}, interval{2, 3})).text() == "null\n");
}

TEST_CASE("lists and names take what is returned, or what is written") {
    struct quantity {
        std::string name;
        double number;
    };
    std::vector<quantity> const all{{"a", 1}, {"b", 2}};
    std::map<std::string, int> const pairs{{"p", 3}};
    json_writer json;
    json.begin_object().list("numbers", all, &quantity::number);
    json.list("objects", all, [&](quantity const& q) { json.object("is", q.name); });
    json.named("by_name", all, &quantity::number).named("pairs", pairs);
    json.named("upper", all, [&](quantity const& q) { json.upper_bound(q.number); });
    json.named("beside", all, std::vector<double>{7}); // as many as both have
    json.maybe("nothing", std::optional<int>{}, [](int i) { return i; });
    json.maybe("twice", std::optional{4}, [](int i) { return 2 * i; });
    json.maybe("pointer", &all[0], [&](quantity const& q) { json.value(q.name); }).end_object();
    CHECK(json.text() == "{\n  \"numbers\": [1, 2],\n"
                         "  \"objects\": [\n    {\"is\": \"a\"},\n    {\"is\": \"b\"}\n  ],\n"
                         "  \"by_name\": {\"a\": 1, \"b\": 2},\n  \"pairs\": {\"p\": 3},\n"
                         "  \"upper\": {\n    \"a\": 1,\n    \"b\": 2\n  },\n"
                         "  \"beside\": {\"a\": 7},\n  \"nothing\": null,\n  \"twice\": 8,\n"
                         "  \"pointer\": \"a\"\n}\n");
}

TEST_CASE("wrong use of the writer is noticed") {
    CHECK_THROWS_AS(json_writer{}.key("a"), std::logic_error);
    CHECK_THROWS_AS(json_writer{}.begin_object().value(1), std::logic_error);
    CHECK_THROWS_AS(json_writer{}.begin_object().end_array(), std::logic_error);
    CHECK_THROWS_AS(json_writer{}.begin_object().key("a").end_object(), std::logic_error);
    CHECK_THROWS_AS(json_writer{}.value(1).value(2), std::logic_error);
    CHECK_THROWS_AS(json_writer{}.begin_object().text(), std::logic_error);
}
