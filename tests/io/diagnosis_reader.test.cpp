// SPDX-License-Identifier: MIT
#include <sivid/io/diagnosis_reader.hpp>

#include "io/support.hpp"
#include "support/catch.hpp"

#include <sivid/io/diagnosis_json.hpp>
#include <sivid/io/input_error.hpp>

#include <string>

using namespace sivid;

namespace {

diagnosis told() {
    diagnosis d;
    d.gap = gap_verdict::certified;
    d.inflation = interval(0.1 + 0.2, 4);
    d.witness = named_witness{{{"k", "1/s", 0.1 + 0.2}}, {{"S1", {{"u", "m/s", 2}}}}};
    d.scenario_inflation = {{"S1", "1", 4, interval(1.5, 4)}};
    d.relations = {{"yaw", {"r"}, true, {"held"}, {{"S1", 0.1 + 0.2, 2}}, false}};
    suspected_place yaw;
    yaw.kind = "equation";
    yaw.name = "yaw";
    yaw.proved = true;
    yaw.where = {"S1", 1, 2};
    yaw.missing = interval(-0.5, -0.25);
    yaw.estimate = -0.3;
    d.where = {yaw};
    cause c;
    c.effects = {"lag"};
    c.verdict = cause_verdict::excluded;
    c.inflation = interval(1.5, unknown_inflation().upper());
    c.parameters = {{"lag.tau", "s", 0.25, interval(0.125, 0.5)}, {"lag.k", "1", 3, std::nullopt}};
    c.onsets = {{"S1", "s", 1, interval(0.5, 2), interval(0, 3)}};
    c.untouched = {"yaw"};
    c.excluded_by = "yaw";
    c.holdout = holdout_figures{};
    c.holdout->inflation_after = interval(0.5, 0.75);
    d.causes = {c};
    d.confined.push_back({"v", {"S1"}, interval(1.5, 2.25), *d.witness, {"held"}});
    d.confined[0].steps = reading_steps{0.125, "m/s", true};
    d.confined[0].grows =
        noise_growth{noise_growth::with::rate, interval(0.5, 0.75), 42, *d.witness, *d.witness};
    d.constants = {{"k", "1/s", 3, interval(2, 4), interval(1, 5)}};
    d.answer = answer_kind::unexplained;
    d.remainder = unexplained_remainder{{"lag"}, interval(1.5, 2), {}};
    d.assumptions = {"held"};
    return d;
}

stored_diagnosis read(std::string const& text) {
    io_support::temporary_folder const folder;
    folder.write("diagnosis.json", text);
    return read_diagnosis(folder.path());
}

} // namespace

TEST_CASE("a diagnosis reads as it was written") {
    auto const d = told();
    auto const stored = read(diagnosis_json(d, "cart", {"../data", std::string(64, 'a'), "b"}));
    auto const& c = stored.claims;
    CHECK(stored.dataset == "cart");
    CHECK(stored.source.folder == "../data");
    CHECK(stored.source.digest == std::string(64, 'a'));
    CHECK(stored.source.problem == "b");
    CHECK(c.gap == d.gap);
    CHECK(subset(d.inflation, c.inflation)); // outward
    CHECK(c.inflation.upper() <= 4 + 1e-14);
    REQUIRE(c.witness);
    CHECK(c.witness->parameters[0].value == 0.1 + 0.2); // the very double
    CHECK(c.witness->starts[0].states[0].value == 2);
    CHECK(subset(interval(1.5, 4), c.scenario_inflation.at(0).hull.value()));
    CHECK(c.relations.at(0).windows.at(0).from == 0.1 + 0.2);
    CHECK(c.relations[0].proved);
    CHECK(c.where.at(0).missing.value().lower() <= -0.5);
    CHECK(c.where[0].estimate == -0.3);
    REQUIRE(c.causes.size() == 1);
    CHECK(c.causes[0].verdict == cause_verdict::excluded);
    CHECK(c.causes[0].inflation.upper() == unknown_inflation().upper());
    CHECK(c.causes[0].parameters.at(0).value == 0.25);
    CHECK_FALSE(c.causes[0].parameters.at(1).hull);
    CHECK(c.causes[0].onsets.at(0).prior);
    CHECK(c.causes[0].excluded_by == "yaw");
    CHECK(c.causes[0].holdout.value().inflation_after.upper() >= 0.75);
    REQUIRE(c.confined.size() == 1);
    CHECK(c.confined[0].steps.value().size == 0.125);
    CHECK(c.confined[0].grows.value().what == noise_growth::with::rate);
    CHECK(c.constants.at(0).hull);
    CHECK(c.answer == answer_kind::unexplained);
    CHECK(c.remainder.value().effects == d.remainder->effects);
    CHECK(c.assumptions == d.assumptions);
}

TEST_CASE("what is missing or malformed in a diagnosis is named") {
    auto const text = diagnosis_json(told(), "cart");
    CHECK_NOTHROW(read(text));
    CHECK_THROWS_AS(read(""), input_error);
    CHECK_THROWS_AS(read("{}"), input_error);
    for (auto const* const key :
         {"\"gap\"", "\"inflation\"", "\"windows\"", "\"witness\"", "\"factor\"", "\"excluded_by\"",
          "\"constants\"", "\"shrink\"", "\"unobservable\"", "\"missing\""}) {
        auto bad = text;
        bad.replace(bad.find(key) + 1, 1, "X");
        CAPTURE(key);
        CHECK_THROWS_AS(read(bad), input_error);
    }
    io_support::temporary_folder const empty;
    CHECK_THROWS_AS(read_diagnosis(empty.path()), input_error);
}
