// SPDX-License-Identifier: MIT
#include <sivid/verifier/claim/detail/identification_check_work.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

#include <string>

using namespace sivid;
using outcome = check_finding::outcome;

namespace {

stored_identification with_claims(identification_problem const& problem, bool reread = true) {
    auto const found = io_support::two_rates_result(problem);
    auto const told = identifiability_of(problem, point_box({1.0, 0.5}));
    io_support::stored_result file(problem, found);
    identification_json_options options;
    options.dataset = "small";
    options.source_folder = "../data";
    options.source_digest = std::string(64, '0');
    options.identifiability = &told;
    file.set_json(identification_json(problem, found, options));
    auto stored = file.read();
    REQUIRE(stored.identifiability);
    if (!reread) stored.identifiability = claims_of(told);
    return stored;
}

} // namespace

TEST_CASE("what data can tell is read as it was written and proved anew") {
    auto const problem = io_support::two_rates_problem();
    auto const stored = with_claims(problem);
    auto const direct = *with_claims(problem, false).identifiability;
    CHECK(direct.most_rank == 1);
    CHECK(stored.identifiability->unknowns == direct.unknowns);
    CHECK(stored.identifiability->proved == direct.proved);
    CHECK(stored.identifiability->proved.size() == 2); // a motion and the product that it leaves
    auto const found = check_identifiability(problem, stored);
    CAPTURE(found.detail);
    CHECK(found.found == outcome::verified);
    auto silent = stored;
    silent.identifiability.reset();
    CHECK(check_identifiability(problem, silent).found == outcome::nothing);
}

TEST_CASE("starts that are not known are among what is told and where") {
    auto problem = io_support::two_rates_problem();
    problem.experiments[0].initial = {interval(1.9, 2.1)};
    auto const stored = with_claims(problem, false);
    CHECK(stored.identifiability->at.size() == 3);
}

TEST_CASE("a rank or a formula that is not proved is not taken on trust") {
    auto const problem = io_support::two_rates_problem();
    auto const good = with_claims(problem);
    auto const says = [&](auto const& spoil) {
        auto bad = good;
        spoil(*bad.identifiability);
        return check_identifiability(problem, bad).found;
    };
    CHECK(says([](auto& c) { c.least_rank = c.most_rank = 2; }) == outcome::refuted);
    CHECK(says([](auto& c) { c.most_rank = 0; }) == outcome::refuted);
    CHECK(says([](auto& c) { c.unknowns.pop_back(); }) == outcome::refuted);
    CHECK(says([](auto& c) { c.proved.push_back("fixed a"); }) == outcome::undecided);
    CHECK(says([](auto& c) { c.at.erase("a"); }) == outcome::undecided);
    // Fewer claims than can be proved are no lie.
    CHECK(says([](auto& c) { c.proved.clear(); }) == outcome::verified);
    CHECK(check_identifiability(problem, good, [] { return false; }).found != outcome::verified);
}
