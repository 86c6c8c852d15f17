// SPDX-License-Identifier: MIT
#include <sivid/verifier/claim/detail/restated.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"
#include "verifier/forgery.hpp"

#include <map>
#include <string>

using namespace sivid;
using outcome = check_finding::outcome;

namespace {

std::map<std::string, check_finding> compare(identification_problem const& problem,
                                             stored_identification const& stored) {
    auto const again = io_detail::restate(problem, stored);
    REQUIRE(again.fault.empty());
    std::map<std::string, check_finding> result;
    for (auto& found :
         io_detail::compared_groups(stored, again, io_detail::members_of(problem, again.found, {})))
        result.emplace(found.what, found);
    return result;
}
std::size_t refuted(std::map<std::string, check_finding> const& all) {
    std::size_t count = 0;
    for (auto const& [what, found] : all) count += found.found == outcome::refuted ? 1 : 0;
    return count;
}

} // namespace

TEST_CASE("a result follows from its boxes to the last digit") {
    for (bool const reduced : {false, true}) {
        for (bool const impossible : {false, true}) {
            auto problem =
                impossible ? io_support::impossible_problem() : io_support::two_rates_problem();
            if (!reduced) problem = io_support::one_rate(problem);
            auto const stored = io_support::stored_result(problem).read();
            CHECK(stored.products.has_value() == reduced);
            for (auto const& [what, found] : compare(problem, stored)) {
                CAPTURE(reduced, impossible, what, found.detail);
                CHECK(found.found ==
                      (what == "products" && !reduced ? outcome::nothing : outcome::verified));
            }
        }
    }
}

TEST_CASE("each member that is stated otherwise is named with what follows") {
    auto const problem = io_support::two_rates_problem(true);
    auto const good = io_support::stored_result(problem).read();
    std::size_t altered = 0;
    for (auto const& [place, text] : good.stated) {
        auto bad = good;
        auto& own = bad.stated[place];
        own += own.find_first_of("123456789") == std::string::npos ? "x" : "1";
        auto const all = compare(problem, bad);
        CAPTURE(place, text);
        CHECK(refuted(all) == 1);
        for (auto const& [what, found] : all)
            if (found.found == outcome::refuted)
                CHECK_THAT(found.detail, ContainsSubstring("result.json" + place + " is " + own));
        bad.stated.erase(place);
        CHECK(overall({compare(problem, bad).at("hull"), compare(problem, bad).at("volumes"),
                       compare(problem, bad).at("problem"), compare(problem, bad).at("files"),
                       compare(problem, bad).at("products"), compare(problem, bad).at("verdict"),
                       compare(problem, bad).at("assumptions"),
                       compare(problem, bad).at("combinations")}) != outcome::verified);
        ++altered;
    }
    CHECK(altered > 25);
    auto more = good;
    more.stated["/parameters/a/excluded_between/0"] = "1";
    CHECK(compare(problem, more).at("hull").found == outcome::refuted);
}

TEST_CASE("boxes and a witness that were altered contradict what is stated") {
    for (bool const reduced : {false, true}) {
        auto const problem =
            reduced ? io_support::two_rates_problem() : io_support::one_rate_problem();
        auto const good = io_support::stored_result(problem).read();
        CAPTURE(reduced);
        auto const seen = [&](auto const& spoil) {
            auto bad = good;
            spoil(bad);
            return refuted(compare(problem, bad)) > 0;
        };
        auto const rows = [](stored_identification& s) -> std::vector<paved_box>& {
            return s.products ? s.products->rows : s.rows;
        };
        auto const inside = io_support::first_row(good.rows, box_verdict::inside);
        CHECK_FALSE(seen([](auto&) {}));
        CHECK(seen([](auto& s) { s.rows.pop_back(); }));
        CHECK(seen([&](auto& s) { s.rows[inside].verdict = box_verdict::undecided; }));
        CHECK(seen([&](auto& s) { s.rows.push_back(s.rows[inside]); }));
        CHECK(seen([&](auto& s) { rows(s).pop_back(); }));
        CHECK(seen([&](auto& s) { rows(s)[0].set[0] = interval(0.3, 0.31); }));
        CHECK(seen([&](auto& s) { std::swap(rows(s).front(), rows(s).back()); }));
        CHECK(seen([](auto& s) { s.rows.clear(); }));
        CHECK(seen([](auto& s) { s.witness.reset(); }));
    }
}

TEST_CASE("products other than the equations see are a fault") {
    auto const problem = io_support::two_rates_problem();
    auto const good = io_support::stored_result(problem).read();
    REQUIRE(good.products);
    for (std::vector<std::string> const& sides :
         {std::vector<std::string>{"a/b"}, {"a"}, {"a*b", "a"}, {"a*c"}, {}}) {
        auto bad = good;
        bad.products->sides = sides;
        CHECK_FALSE(io_detail::restate(problem, bad).fault.empty());
    }
    CHECK_FALSE(io_detail::restate(io_support::one_rate_problem(), good).fault.empty());
}

TEST_CASE("a volume decides nothing where no product is inside that parameters have") {
    auto const problem = io_support::two_rates_problem();
    auto stored = io_support::stored_result(problem).read();
    stored.witness.reset();
    for (auto& row : stored.rows) row.verdict = box_verdict::pending;
    io_support::adapt(problem, stored);
    auto const verdicts = [&] { return compare(problem, stored).at("verdict").found; };
    CHECK(verdicts() == outcome::verified); // by the products that are inside
    for (auto& row : stored.products->rows) row.set[0] = interval(2.0); // of one point of the prior
    io_support::adapt(problem, stored);
    CHECK(verdicts() == outcome::refuted);
    for (auto& row : stored.products->rows) row.verdict = box_verdict::undecided;
    io_support::adapt(problem, stored);
    CHECK(verdicts() == outcome::refuted);
    stored.stated["/volume/inner/0"] = "1e-301";
    CHECK(compare(problem, stored).at("volumes").found == outcome::refuted);
}
