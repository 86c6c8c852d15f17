// SPDX-License-Identifier: MIT
#include <sivid/verifier/check_finding.hpp>

#include "support/catch.hpp"

#include <vector>

using namespace sivid;
using outcome = check_finding::outcome;

TEST_CASE("one refuted statement refutes a result, whatever else is proved") {
    auto const verdict = [](std::vector<outcome> const& all) {
        std::vector<check_finding> findings;
        for (auto const o : all) findings.push_back({"a statement", o, "", 0});
        return overall(findings);
    };
    CHECK(verdict({outcome::verified, outcome::nothing}) == outcome::verified);
    CHECK(verdict({outcome::verified, outcome::sampled}) == outcome::sampled);
    CHECK(verdict({outcome::sampled, outcome::undecided}) == outcome::undecided);
    CHECK(verdict({outcome::undecided, outcome::verified, outcome::refuted}) == outcome::refuted);
    // A sample is never called a proof.
    CHECK(to_string(outcome::sampled) == "by sample");
    CHECK(to_string(outcome::verified) == "verified");
}
