// SPDX-License-Identifier: MIT
#include <sivid/report/identification_report.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

#include <string>

using namespace sivid;

namespace {

bool has(std::string const& text, std::string const& part) {
    return text.find(part) != std::string::npos;
}

/// A run that left the state too wide at 1.2 of 3 s.
run_reach early_end() {
    run_reach r;
    r.scenario = "run";
    r.until = 1.2;
    r.end = 3;
    r.state = "x";
    r.unit = "m";
    r.width = 7.5;
    r.causes = {{false, 0, "a", 0.8}, {true, 0, "x", 0.15}};
    r.moved = 40;
    r.spread = 60;
    r.instants = r.measured = 6;
    return r;
}

} // namespace

TEST_CASE("words on runs name the scenario and its state and what to change") {
    auto const p = plain_problem::make();
    identification found(p.prior);
    CHECK(report::reach_words(p, found).empty());
    found.reason = stop_reason::time_budget;
    CHECK(has(report::reach_words(p, found).at(0), "No time was left"));
    found.reach = {early_end()};
    auto const words = [&] { return report::reach_words(p, found).at(0); };
    auto const early = words();
    for (auto const* part :
         {"run: ", "1.2 of 3.0 s", "x is 7.5", "(80 % of it by a", "15 % by the start of x)",
          "Scenarios shorter than 1.2 s", "a narrower range for a"}) {
        CAPTURE(early, part);
        CHECK(has(early, part));
    }
    found.reach[0].until = 0;
    CHECK(has(words(), "enclosed nowhere"));
    found.reach[0].until = 3;
    CHECK(has(words(), "a larger budget"));
    found.reason = stop_reason::accuracy_reached; // more time would find the same
    CHECK(report::reach_words(p, found).empty());
    found.reach[0].lost = 5;
    CHECK(has(words(), "blur by 5.0 error bounds"));
    found.reach[0].spread = 0.3001;
    CHECK(has(words(), "move no measurement by more than 0.31 of its error bound"));
}

TEST_CASE("words on runs blame neither length nor time for data that nothing moves") {
    auto const p = plain_problem::make();
    identification found(p.prior);
    found.reason = stop_reason::time_budget;
    found.reach = {early_end()};
    auto const words = [&] { return report::reach_words(p, found).at(0); };
    found.reach[0].moved = found.reach[0].spread = 0.3;
    CHECK(has(words(), "no measurement of the first 1.2 s by more than"));
    CHECK_FALSE(has(words(), "shorter"));
    auto longer = found;
    longer.reach[0].until = 2.96;
    CHECK(has(report::reach_words(p, longer).at(0), "of the first 2.9 s by more than"));
    CHECK(has(report::reach_words(p, longer).at(0), "enclosed for 2.9 of 3.0 s only"));
    CHECK(has(words(), "Beyond that, over all that is left"));
    // Affine parts alone prove nothing of the whole movement.
    found.reach[0].spread = 1.5;
    CHECK_FALSE(has(words(), "no measurement"));
    // Nor do some of the instants prove it for the others.
    found.reach[0].spread = 0.3;
    found.reach[0].measured = 1000;
    found.reach[0].instants = 50;
    CHECK(has(words(), "no measurement (of 50 instants among 1"));
    // Where time ended a run, nothing is known of its reach.
    found.reach[0].interrupted = true;
    CHECK(has(words(), "no time was left"));
    CHECK_FALSE(has(words(), "enclosed for"));
}

TEST_CASE("words on runs are few and say first what no method could exclude") {
    auto const p = plain_problem::make();
    identification found(p.prior);
    found.reason = stop_reason::time_budget;
    found.reach.assign(9, early_end());
    auto const many = report::reach_words(p, found);
    REQUIRE(many.size() == 7);
    CHECK(has(many.back(), "3 further scenarios"));
    // Half of the prior inside, the other half undecided.
    auto const& side = p.prior[0];
    double const middle = 0.5 * (side.lower() + side.upper());
    found.paving.add(box{interval(side.lower(), middle)}, box_verdict::inside);
    found.paving.add(box{interval(middle, side.upper())}, box_verdict::undecided);
    found.verdict = verdict::consistent;
    auto const inside = report::reach_words(p, found).at(0);
    CAPTURE(inside);
    CHECK((has(inside, "At least 49.9") || has(inside, "At least 50.0 %")));
    CHECK(has(inside, "nothing of it can be excluded"));
    // Where much is excluded there is nothing to explain.
    identification much(p.prior);
    much.verdict = verdict::consistent;
    much.reach = found.reach;
    CHECK(report::reach_words(p, much).empty());
}

TEST_CASE("words on divisors say what may vanish, in which equations, and where") {
    auto const p = plain_problem::make();
    identification found(p.prior);
    found.reason = stop_reason::accuracy_reached;
    found.divisors = {{"a - x", {"u", "v", "output y"}, zeros::some, {{"a", 0.5}, {"x", 0.5}}},
                      {"", {"v"}, zeros::unknown, {}}};
    auto const words = report::reach_words(p, found);
    REQUIRE(words.size() == 2);
    CHECK(words[0] == "The equations of u, v and output y divide by a - x, which is zero somewhere "
                      "within the prior and the limits of the states (near a = 0.50, x = 0.50): no "
                      "trajectory is enclosed there. A prior, or limits, without it may tell more");
    CHECK(has(words[1], "The equation of v divides by a long expression, which may be zero"));
}
