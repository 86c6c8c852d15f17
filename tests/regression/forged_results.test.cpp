// SPDX-License-Identifier: MIT
// Every kind of forgery that a check once accepted: what is stored is altered with its sums and
// digests adapted, so that nothing but a proof can tell.
#include <sivid/io/checkpoint.hpp>
#include <sivid/io/checkpoint_reader.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/verifier/claim/detail/identification_check_work.hpp>
#include <sivid/verifier/identification_check.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"
#include "verifier/forgery.hpp"

#ifdef SIVID_HAS_MPFI
#include <sivid/verifier/mp_identification_check.hpp>
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sivid;
using outcome = check_finding::outcome;

namespace {

outcome checked(identification_problem const& problem, stored_identification const& stored,
                bool all = false, std::uint64_t seed = 1) {
    identification_check_options options;
    options.all = all;
    options.seed = seed;
    options.seconds = 60;
#ifdef SIVID_HAS_MPFI
    return overall(check_by_proven_functions(problem, stored, options));
#else
    return overall(check_identification(problem, stored, options));
#endif
}

using io_support::adapt;

} // namespace

TEST_CASE("the result that is forged below is sampled and verified in the whole") {
    auto const problem = io_support::one_rate_problem();
    auto const good = io_support::stored_result(problem).read();
    CHECK(checked(problem, good) == outcome::sampled);
    CHECK(checked(problem, good, true) == outcome::verified);
    auto thin = io_support::two_rates_problem();
    thin.prior[1] = interval(0.5, std::nextafter(0.5, 1.0)); // a decimal
    CHECK(checked(thin, io_support::stored_result(thin).read(), true) == outcome::verified);
}

TEST_CASE("consistent data said to be inconsistent are refuted for every seed") {
    for (int const kind : {0, 1, 2}) {
        auto problem = kind > 0 ? io_support::two_rates_problem() : io_support::one_rate_problem();
        if (kind == 2) problem.prior[1] = interval(0.5, std::nextafter(0.5, 1.0)); // a decimal
        auto forged = io_support::stored_result(problem).read();
        forged.verdict = verdict::inconsistent;
        forged.reason = stop_reason::decided;
        forged.witness.reset();
        forged.rows.clear();
        forged.products.reset();
        adapt(problem, forged);
        for (std::uint64_t seed = 1; seed <= 7; ++seed) {
            CAPTURE(kind, seed);
            CHECK(checked(problem, forged, false, seed) == outcome::refuted);
        }
    }
}

TEST_CASE("boxes dropped or made larger are refuted without luck") {
    auto const problem = io_support::one_rate_problem();
    auto const good = io_support::stored_result(problem).read();
    auto const inside = io_support::first_row(good.rows, box_verdict::inside);
    for (std::uint64_t seed = 1; seed <= 7; ++seed) {
        CAPTURE(seed);
        auto dropped = good;
        dropped.rows.erase(dropped.rows.begin() + static_cast<std::ptrdiff_t>(inside));
        adapt(problem, dropped);
        CHECK(checked(problem, dropped, false, seed) == outcome::refuted);
        auto wider = good;
        auto edge = good.rows[inside].set[0];
        for (auto const& row : good.rows) edge = hull(edge, row.set[0]);
        double const more = 1e-3 * width(problem.prior[0]);
        std::vector<paved_box> rows{
            {box{interval(edge.lower() - more, edge.upper() + more)}, box_verdict::inside}};
        wider.rows = rows;
        adapt(problem, wider);
        CHECK(checked(problem, wider, false, seed) == outcome::refuted);
    }
}

TEST_CASE(
    "what stands beside the boxes is recomputed - assumptions and grounds and reason and tables") {
    for (bool const reduced : {false, true}) {
        auto const problem =
            reduced ? io_support::two_rates_problem() : io_support::one_rate_problem();
        auto const good = io_support::stored_result(problem).read();
        auto const refuted = [&](auto const& spoil) {
            auto bad = good;
            spoil(bad);
            return checked(problem, bad) == outcome::refuted;
        };
        CAPTURE(reduced);
        CHECK(refuted([](auto& s) { s.stated.erase("/assumptions/0"); }));
        CHECK(refuted([](auto& s) { s.stated["/assumptions/0"] = "inputs within stated errors"; }));
        CHECK(refuted([](auto& s) { s.stated["/assumptions/1"] = "the moon is full"; }));
        for (int k = 0; !to_string(static_cast<stop_reason>(k)).empty(); ++k) {
            auto const other = static_cast<stop_reason>(k);
            if (other == good.reason) continue;
            CAPTURE(to_string(good.reason), to_string(other));
            auto bad = good;
            bad.reason = other;
            // Nothing tells what ended a search in which boxes wait.
            auto const& rows = good.products ? good.products->rows : good.rows;
            bool const waits =
                std::ranges::count(rows, box_verdict::pending, &paved_box::verdict) > 0;
            auto const found = check_stop(bad).found;
            bool const no_trace = found == outcome::nothing && waits;
            CHECK((found == outcome::refuted || no_trace));
            CHECK((checked(problem, bad) == outcome::refuted || no_trace));
        }
        REQUIRE(good.witness);
        CHECK(refuted([](auto& s) { s.witness.reset(); }));
        CHECK(refuted([](auto& s) { s.stated["/verdict_rests_on"] = "inside boxes"; }));
        CHECK(refuted([](auto& s) { s.stated["/files/boxes.csv"][0] = 'x'; }));
        CHECK(refuted([](auto& s) {
            s.stated.erase("/files/boxes.csv");
            s.stated["/files/x"];
        }));
        // Where nothing is stated, nothing is verified.
        auto silent = good;
        std::erase_if(silent.stated, [](auto const& m) { return m.first.starts_with("/files"); });
        CHECK(checked(problem, silent, true) == outcome::undecided);
        silent = good;
        silent.stated.erase("/verdict_rests_on");
        CHECK(checked(problem, silent, true) == outcome::undecided);
    }
}

TEST_CASE("an open box dropped with its count adapted is never verified") {
    auto problem = io_support::one_rate_problem();
    identify_options options;
    options.search.accuracy = 1.0 / 128;
    options.search.boxes = 6;
    options.search.sufficient_ratio = 1;
    auto const found = identify(problem, options);
    io_support::stored_result file(problem, found);
    auto const good = file.read();
    std::size_t dropped = 0;
    for (std::size_t k = 0; k < good.rows.size(); ++k) {
        if (good.rows[k].verdict == box_verdict::inside) continue;
        auto bad = good;
        bad.rows.erase(bad.rows.begin() + static_cast<std::ptrdiff_t>(k));
        CHECK(checked(problem, bad) == outcome::refuted); // the table is another, or its count
        adapt(problem, bad);
        CHECK(checked(problem, bad) != outcome::verified);
        ++dropped;
    }
    CHECK(dropped > 0);
}

TEST_CASE("a checkpoint that lost boxes is refused although its digest is right") {
    auto const problem = io_support::two_rates_problem();
    identify_options options;
    options.search.accuracy = 1.0 / 256;
    options.search.sufficient_ratio = 0.97;
    options.search.boxes = 16; // which ends it, with boxes that wait
    options.search.checkpoint_seconds = 0;
    auto const digest = problem_digest(problem, options);
    std::optional<identification_state> saved;
    options.checkpoint = [&](identification_state const& s) { saved = s; };
    (void)identify(problem, options);
    REQUIRE(saved);
    REQUIRE(saved->search.waiting.size() > 1);
    auto const accepted = [&](identification_state const& s) {
        try {
            (void)parse_checkpoint(checkpoint_text(s, digest), "f", digest);
            return true;
        } catch (input_error const&) {
            return false;
        }
    };
    CHECK(accepted(*saved));
    for (std::size_t keep = 0; keep < saved->search.waiting.size(); ++keep) {
        auto bad = *saved;
        bad.search.waiting.resize(keep);
        bad.search.waiting_volume = 0;
        for (auto const& w : bad.search.waiting) bad.search.waiting_volume += w.volume;
        CHECK_FALSE(accepted(bad));
    }
    auto bad = *saved;
    bad.search.paved.pop_back();
    CHECK_FALSE(accepted(bad));
    bad = *saved; // an inside box twice would count its volume twice
    bad.search.paved.push_back(bad.search.paved.back());
    CHECK_FALSE(accepted(bad));
}

TEST_CASE("a checkpoint whose boxes are labelled anew is refused - its digest adapted") {
    std::size_t inside = 0, outside = 0;
    for (bool const reduced : {false, true}) {
        auto const problem =
            reduced ? io_support::two_rates_problem() : io_support::one_rate_problem();
        identify_options options;
        options.search.accuracy = 1.0 / 256;
        options.search.sufficient_ratio = 1;
        options.search.boxes = 40; // which ends it, with boxes that wait
        options.search.checkpoint_seconds = 0;
        std::optional<identification_state> saved;
        options.checkpoint = [&](identification_state const& s) { saved = s; };
        auto const first = identify(problem, options);
        REQUIRE(saved);
        options.checkpoint = nullptr;
        options.search.boxes = 3000;
        options.search.sufficient_ratio = 0.9;
        auto const resumed = [&](identification_state const& s) {
            options.resume = std::make_shared<identification_state const>(s);
            return identify(problem, options);
        };
        CHECK(resumed(*saved).verdict == first.verdict);
        for (std::size_t k = 0; k < saved->search.paved.size(); ++k) {
            auto bad = *saved;
            auto& label = bad.search.paved[k].verdict;
            if (label == box_verdict::undecided) continue;
            bool const was_inside = label == box_verdict::inside;
            ++(was_inside ? inside : outside);
            label = was_inside ? box_verdict::outside : box_verdict::inside;
            CAPTURE(reduced, k, was_inside);
            CHECK_THROWS_AS(resumed(bad), std::invalid_argument);
            bad.guess.reset(); // nor does a witness help the forger by its absence
            CHECK_THROWS_AS(resumed(bad), std::invalid_argument);
        }
        if (saved->left) { // which exclude all but the middle of the prior's lower half
            auto bad = *saved;
            auto& side = bad.left->parameters[0];
            side = interval(side.lower(), side.lower());
            CHECK_THROWS_AS(resumed(bad), std::invalid_argument);
        }
    }
    CHECK(inside > 0);
    CHECK(outside > 0);
}

TEST_CASE("what contradicts the data is not consistent by a volume that nothing shows") {
    auto const problem = io_support::impossible_problem();
    auto stored = io_support::stored_result(problem).read();
    REQUIRE(stored.products);
    REQUIRE(stored.verdict == verdict::inconsistent);
    CHECK(checked(problem, stored, true) == outcome::verified);
    stored.verdict = verdict::consistent;
    stored.stated["/verdict"] = "consistent";
    stored.stated["/verdict_rests_on"] = to_string(verdict_grounds::inside_boxes);
    for (auto const* const much : {"1e-310", "1e-301", "1e-12"}) {
        stored.stated["/volume/inner/0"] = stored.stated["/volume/inner/1"] = much;
        CHECK(checked(problem, stored, true) == outcome::refuted);
    }
}
