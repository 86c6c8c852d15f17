// SPDX-License-Identifier: MIT
// What stands in certificates.csv is never believed: whatever is forged there and in the tables, a
// false result is not verified, and a true one loses time at most.
#include <sivid/io/checkpoint.hpp>
#include <sivid/io/checkpoint_reader.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/verifier/claim/detail/paving_check.hpp>
#include <sivid/verifier/identification_check.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

using namespace sivid;
using kind = proof_step::kind;
using outcome = check_finding::outcome;

namespace {

/// What the whole check says of the boxes that the rows leave, with all sums left aside.
outcome excluded(identification_problem const& problem, std::vector<paved_box> const& rows,
                 exclusion_proof const& proof, double seconds = 20) {
    identification_check_options options;
    options.all = true;
    options.seconds = seconds;
    paving_check<interval> check(problem, problem.choice.unknown, rows, {}, options, proof);
    (void)check.covering("cover");
    return check.outside("excluded").found;
}

struct stored {
    identification_problem problem;
    std::vector<paved_box> rows;
    exclusion_proof proof;
};
stored truth() {
    auto const problem = io_support::one_rate_problem();
    auto const file = io_support::stored_result(problem).read();
    return {problem, file.rows, file.proof};
}
std::size_t cuts(exclusion_proof const& proof) {
    std::size_t count = 0;
    for (auto const& s : proof) count += s.what == kind::cut ? 1 : 0;
    return count;
}

} // namespace

TEST_CASE("a certificate that is wrong or missing costs a true result time at most") {
    auto const good = truth();
    REQUIRE(cuts(good.proof) > 2);
    CHECK(excluded(good.problem, good.rows, good.proof) == outcome::verified);
    CHECK(excluded(good.problem, good.rows, {}) == outcome::verified);
    auto const still_verified = [&](auto const& spoil) {
        auto bad = good;
        for (auto& s : bad.proof) spoil(s);
        return excluded(bad.problem, bad.rows, bad.proof) == outcome::verified;
    };
    CHECK(still_verified([](auto& s) { s.why.clear(); }));
    CHECK(still_verified([](auto& s) {
        for (auto& g : s.why) {
            for (auto& w : g) w.value = -w.value;
        }
    }));
    CHECK(still_verified([](auto& s) {
        for (auto& g : s.why) {
            for (auto& w : g) w = {7, 1000, std::nan("")};
        }
    }));
    CHECK(still_verified([](auto& s) { s.upper = !s.upper; }));
    CHECK(still_verified([](auto& s) { s.index += 1; }));
    CHECK(still_verified([](auto& s) { s.what = kind::leaf; }));
    CHECK(still_verified([](auto& s) {
        if (s.what != kind::run) s.what = kind::empty; // all of the prior, rows and all
    }));
    CHECK(still_verified([](auto& s) { s.at = 0.7; }));
    auto half = good.proof;
    half.resize(half.size() / 2);
    CHECK(excluded(good.problem, good.rows, half) == outcome::verified);
}

TEST_CASE("no certificate verifies that what is feasible is excluded") {
    auto const good = truth();
    auto const inside = io_support::first_row(good.rows, box_verdict::inside);
    auto const set = good.rows[inside].set;
    auto const never = [&](std::vector<paved_box> const& rows, exclusion_proof const& proof) {
        CHECK(excluded(good.problem, rows, proof, 3) != outcome::verified);
    };
    // A box removed: the proof says of it nothing, that it is empty, or cuts it off.
    auto removed = good.rows;
    removed.erase(removed.begin() + static_cast<std::ptrdiff_t>(inside));
    never(removed, good.proof);
    auto said = good.proof;
    for (auto& s : said) {
        if (s.what == kind::leaf) s = {kind::empty, 0, false, 0, {{{0, 0, 1.0}}}};
    }
    never(removed, said);
    never({}, said);
    never({}, {{kind::run, 0}, {kind::empty, 0, false, 0, {{{0, 0, 1e300}}}}});
    never({}, {{kind::cut, 0, true, -1e300, {{{0, 0, 1.0}}}}});
    never({}, {{kind::cut, 0, true, set[0].lower()}, {kind::cut, 0, false, set[0].upper()}});
    // A face moved inward, in the rows and in the proof.
    double const middle = mid(set[0]);
    auto moved = good.rows;
    moved[inside].set[0] = interval(middle, set[0].upper());
    auto face = good.proof;
    for (auto& s : face) {
        if (s.at == set[0].lower()) s.at = middle;
    }
    never(moved, face);
    // Weights of one cut for another place.
    for (auto const& from : good.proof) {
        if (from.what != kind::cut || from.why.empty()) continue;
        exclusion_proof forged{{kind::run, 0}};
        forged.push_back({kind::cut, 0, false, middle, from.why});
        forged.push_back({});
        never({{box{interval(middle, good.problem.prior[0].upper())}, box_verdict::undecided}},
              forged);
        break;
    }
    // Steps that lead nowhere, in great number.
    exclusion_proof const many(1000, proof_step{kind::split, 0, false, 0.75});
    never(removed, many);
}

TEST_CASE("a search that was interrupted tells its whole proof") {
    auto const problem = io_support::two_rates_problem();
    identify_options options;
    options.search.accuracy = 1.0 / 256;
    options.search.sufficient_ratio = 1;
    options.search.checkpoint_seconds = 0;
    auto const at_once = identify(problem, options);
    auto first = options;
    first.search.boxes = 20;
    auto const digest = problem_digest(problem, options);
    std::string saved;
    first.checkpoint = [&](identification_state const& s) { saved = checkpoint_text(s, digest); };
    (void)identify(problem, first);
    options.resume =
        std::make_shared<identification_state const>(parse_checkpoint(saved, "f", digest));
    CHECK(checkpoint_text(*options.resume, digest) == saved);
    auto const resumed = identify(problem, options);
    REQUIRE(resumed.boxes == at_once.boxes);
    CHECK(at_once.proof.size() > 20);
    CHECK(certificates_csv(resumed.proof) == certificates_csv(at_once.proof));
}

TEST_CASE("the tolerance that a result states proves nothing by itself") {
    auto const problem = io_support::one_rate_problem();
    auto result = io_support::stored_result(problem).read();
    CHECK(result.tolerance > 0);
    for (double const stated : {0.0, -1.0, 1e300, 1e-300}) {
        CAPTURE(stated);
        result.tolerance = stated;
        identification_check_options options;
        options.all = true;
        options.seconds = 60;
        CHECK(overall(check_identification(problem, result, options)) == outcome::verified);
    }
}
