// SPDX-License-Identifier: MIT
#include <sivid/io/identification_reader.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

#include <string>

using namespace sivid;

TEST_CASE("what was written is read: boxes are the very ones") {
    auto const problem = io_support::two_rates_problem(true);
    auto const found = io_support::two_rates_result(problem);
    auto const stored = io_support::stored_result(problem).read();
    CHECK(stored.dataset == "small");
    CHECK(stored.source_folder == "../data");
    CHECK(stored.source_digest.size() == 64);
    CHECK(stored.verdict == found.verdict);
    REQUIRE(stored.parameters.size() == 2);
    for (std::size_t j = 0; j < 2; ++j) {
        CHECK(stored.parameters[j].name == problem.choice.unknown[j]);
        CHECK(subset(found.hull[j], stored.parameters[j].range));
    }
    CHECK(stored.stated.at("/combinations/0/formula") == "a*b");
    REQUIRE(stored.witness);
    CHECK(stored.witness->parameters.at("a") == found.witness->parameters[0]);
    CHECK(stored.witness->initial.at("run").at("x") == found.witness->starts[0][0]);
    CHECK(stored.budget.at("run") == 1);
    REQUIRE(stored.forced.size() == 1);
    CHECK(stored.forced[0].time == 1.5);
    std::size_t k = 0;
    for (auto const& b : found.paving.boxes()) {
        if (b.verdict == box_verdict::outside) continue;
        REQUIRE(k < stored.rows.size());
        CHECK(stored.rows[k].verdict == b.verdict);
        CHECK((subset(b.set, stored.rows[k].set) && subset(stored.rows[k].set, b.set)));
        ++k;
    }
    CHECK(stored.rows.size() == k);
    CHECK(stored.stated.at("/rows/inside") ==
          std::to_string(found.paving.count(box_verdict::inside)));
}

TEST_CASE("an inconsistent result has no hull, no witness and no rows") {
    auto const stored = io_support::stored_result(io_support::impossible_problem()).read();
    CHECK(stored.verdict == verdict::inconsistent);
    CHECK(is_empty(stored.parameters[0].range));
    CHECK_FALSE(stored.witness);
    CHECK(stored.rows.empty());
}

TEST_CASE("malformed files are refused") {
    io_support::stored_result const good(io_support::one_rate_problem());
    auto const spoilt_json = [&](std::string const& from, std::string const& to) {
        auto copy = good;
        REQUIRE(copy.replace_json(from, to));
        CHECK_THROWS_AS(copy.read(), input_error);
    };
    spoilt_json("sivid-identification-1", "sivid-identification-9");
    spoilt_json("\"consistent\"", "\"surely\"");
    spoilt_json("\"witness\": {", "\"whitness\": {");
    spoilt_json("\"a\": {\"hull\": [", "\"a\": {\"hull\": [9, ");
    for (auto const* count : {"-1", "1e30", "0.5"}) {
        spoilt_json("\"budget\": {\"run\": 0}",
                    "\"budget\": {\"run\": " + std::string{count} + "}");
    }
    auto const spoilt_csv = [&](std::string const& from, std::string const& to) {
        auto copy = good;
        REQUIRE(copy.replace_csv(from, to));
        CHECK_THROWS_AS(copy.read(), input_error);
    };
    spoilt_csv("a_lower", "c_lower");
    spoilt_csv("\ninside,", "\nwithin,");
    spoilt_csv("\ninside,", "\ninside,x");
    spoilt_csv("\ninside,", "\ninside,9");
}
