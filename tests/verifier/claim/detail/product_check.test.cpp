// SPDX-License-Identifier: MIT
#include <sivid/verifier/claim/detail/stored_claims.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

#include <cmath>

using namespace sivid;
using outcome = check_finding::outcome;

TEST_CASE("hull, combinations and volumes follow from the products, and each alteration is seen") {
    auto const problem = io_support::two_rates_problem();
    auto const good = io_support::stored_result(problem).read();
    REQUIRE(good.products);
    auto const rebuilt = rebuild_products<interval>(problem, good.products->sides);
    auto const products = [&](stored_identification const& s) {
        return check_products(rebuilt, *s.products).found;
    };
    auto const hulls = [&](stored_identification const& s) {
        return check_hull_of_products<interval>(problem, s, rebuilt).found;
    };
    auto const volumes = [&](stored_identification const& s) {
        return check_volumes_of_products(problem, s).found;
    };
    CHECK(products(good) == outcome::verified);
    CHECK(hulls(good) == outcome::verified);
    CHECK(volumes(good) == outcome::verified);
    CHECK(check_combinations_of_products(good).found == outcome::verified);

    auto bad = good;
    auto& rows = bad.products->rows;
    SECTION("a row too many, one out of range") {
        rows.push_back(rows[0]);
        CHECK(products(bad) == outcome::refuted);
        rows.pop_back();
        rows[0].set[0] = interval(1.9, 2.1);
        CHECK(products(bad) == outcome::refuted);
    }
    SECTION("rows relabelled or removed") {
        auto const k = io_support::first_row(rows, box_verdict::inside);
        rows[k].verdict = box_verdict::undecided;
        CHECK(products(bad) == outcome::refuted);
        CHECK(volumes(bad) == outcome::refuted);
        rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(k));
        CHECK(volumes(bad) == outcome::refuted);
    }
    SECTION("hulls") {
        for (std::size_t j = 0; j < 2; ++j) {
            auto& range = bad.parameters[j].range;
            auto const whole = range;
            range = interval(whole.lower() + 1e-9, whole.upper());
            CHECK(hulls(bad) == outcome::refuted);
            range = interval(whole.lower() - 1e-9, whole.upper());
            CHECK(hulls(bad) == outcome::refuted);
            range = interval(whole.lower(), whole.upper() + 1e-9);
            CHECK(hulls(bad) == outcome::refuted);
            range = whole;
        }
        bad.rows.clear();
        CHECK(hulls(bad) == outcome::refuted);
    }
    SECTION("combinations") {
        auto& range = bad.combinations[0].range;
        auto const whole = range;
        for (double const d : {-1e-9, 1e-9}) {
            range = interval(whole.lower() + d, whole.upper());
            CHECK(check_combinations_of_products(bad).found == outcome::refuted);
            range = interval(whole.lower(), whole.upper() + d);
            CHECK(check_combinations_of_products(bad).found == outcome::refuted);
        }
        bad.combinations.clear();
        CHECK(check_combinations_of_products(bad).found == outcome::refuted);
    }
    SECTION("a bound at one end only") {
        bad.parameters[0].range = interval_traits<interval>::bounds(1.9, HUGE_VAL);
        CHECK(hulls(bad) == outcome::refuted);
        bad.combinations[0].range = interval_traits<interval>::bounds(5, HUGE_VAL);
        CHECK(check_combinations_of_products(bad).found == outcome::refuted);
        bad.inner = interval_traits<interval>::bounds(good.inner.lower(), HUGE_VAL);
        CHECK(volumes(bad) == outcome::refuted);
    }
    SECTION("volumes") {
        for (double const factor : {0.999, 1.001}) {
            bad = good;
            bad.inner = interval(good.inner.lower() * factor, good.inner.upper() * factor);
            CHECK(volumes(bad) == outcome::refuted);
            bad = good;
            bad.outer = interval(good.outer.lower() * factor, good.outer.upper() * factor);
            CHECK(volumes(bad) == outcome::refuted);
        }
    }
}

TEST_CASE(
    "a volume decides nothing where no product is inside, nor where none is known to be met") {
    auto const problem = io_support::two_rates_problem();
    auto stored = io_support::stored_result(problem).read();
    auto const verdicts = [&] { return check_verdict_of_products(problem, stored).found; };
    CHECK(verdicts() == outcome::verified);
    stored.witness.reset();
    stored.grounds = to_string(verdict_grounds::inside_boxes);
    for (auto& row : stored.rows) row.verdict = box_verdict::pending;
    CHECK(verdicts() == outcome::verified); // by the products that are inside
    auto& rows = stored.products->rows;
    auto const proved = rows;
    for (auto& row : rows) row.set[0] = interval(2.0); // the largest: of one point of the prior
    CHECK(verdicts() == outcome::undecided);
    for (auto const& nothing_inside : {std::vector<paved_box>{}, proved}) {
        rows = nothing_inside;
        for (auto& row : rows) row.verdict = box_verdict::undecided;
        stored.inner = interval(1e-301);
        CHECK(verdicts() == outcome::refuted);
        CHECK(check_verdict(stored).found == outcome::refuted);
        CHECK(check_volumes_of_products(problem, stored).found == outcome::refuted);
    }
}
