// SPDX-License-Identifier: MIT
#include <sivid/verifier/identification_check.hpp>

#include <sivid/paving/identifiability.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <string>

using namespace sivid;
using outcome = check_finding::outcome;

namespace {

stored_identification with_claims(identification_problem const& problem) {
    auto const found = io_support::two_rates_result(problem);
    identifiability_options options;
    for (auto const& e : problem.experiments) options.at_starts.push_back(e.initial);
    auto const told = identifiability_of(problem, point_box({1.0, 0.5}), options);
    io_support::stored_result file(problem, found);
    file.set_json(
        identification_json(problem, found, {.dataset = "small", .identifiability = &told}));
    return file.read();
}
check_finding check(identification_problem const& problem, stored_identification const& stored,
                    double seconds = 60) {
    identification_check_options options;
    options.sample = 0;
    options.seconds = seconds;
    auto const all = check_identification(problem, stored, options);
    return *std::ranges::find(all, "identifiability", &check_finding::what);
}

} // namespace

TEST_CASE("what data can tell is read as it was written and computed anew") {
    auto problem = io_support::two_rates_problem();
    for (bool const uncertain : {false, true}) {
        if (uncertain) problem.experiments[0].initial = {interval(1.9, 2.1)};
        auto const stored = with_claims(problem);
        REQUIRE(stored.identifiable_at);
        CHECK(stored.identifiable_at->size() == (uncertain ? 3 : 2));
        auto const found = check(problem, stored);
        CAPTURE(uncertain, found.detail);
        CHECK(found.found == outcome::verified);
    }
    auto const silent = io_support::stored_result(io_support::two_rates_problem()).read();
    CHECK(check(io_support::two_rates_problem(), silent).found == outcome::nothing);
}

TEST_CASE("no figure of what data can tell is taken on trust") {
    auto const problem = io_support::two_rates_problem();
    auto const good = with_claims(problem);
    CHECK(good.stated.at("/identifiability/rank/most") == "1");
    CHECK(good.stated.at("/identifiability/fixed/0/formula") == "a*b");
    for (auto const* const place :
         {"rank/least", "rank/most", "rank/approximate", "fixed/0/formula", "fixed/0/proved",
          "free/0/kind", "free/0/weights/a", "unknowns/0", "at/a/0"}) {
        CAPTURE(place);
        auto bad = good;
        auto const own = bad.stated.find("/identifiability/" + std::string(place));
        REQUIRE(own != bad.stated.end());
        own->second += "1";
        CHECK(check(problem, bad).found == outcome::refuted);
        bad.stated.erase(own);
        CHECK(check(problem, bad).found == outcome::refuted);
    }
    auto bad = good;
    bad.identifiable_at->erase("a");
    CHECK(check(problem, bad).found != outcome::verified);
    CHECK(check(problem, good, -1).found != outcome::verified);
}
