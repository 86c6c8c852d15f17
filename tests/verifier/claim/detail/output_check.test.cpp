// SPDX-License-Identifier: MIT
#include <sivid/verifier/identification_check.hpp>

#include "io/stored_result.hpp"
#include "support/catch.hpp"

#include <sivid/number/decimal_output.hpp>
#include <sivid/number/text/sha256.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

using namespace sivid;
using outcome = check_finding::outcome;

namespace {

/// A stored result whose outputs.csv is of this motion.
struct kept_result {
    identification_problem problem;
    stored_identification stored;

    [[nodiscard]] check_finding check() const {
        identification_check_options options;
        options.sample = 0;
        options.seconds = 20;
        auto const all = check_identification(problem, stored, options);
        return *std::ranges::find(all, "outputs", &check_finding::what);
    }
    /// As a forger does it, whose digest is right.
    [[nodiscard]] outcome forged(std::function<void(std::string&)> const& spoil,
                                 bool digest = true) const {
        auto bad = *this;
        spoil(bad.stored.outputs);
        REQUIRE(bad.stored.outputs != stored.outputs);
        if (digest) bad.stored.stated["/outputs/sha256"] = sha256(bad.stored.outputs);
        return bad.check().found;
    }
};

kept_result kept(identification_problem const& problem, motion_source source) {
    auto const found = io_support::two_rates_result(problem);
    REQUIRE(found.witness);
    auto motion = find_explaining_motion(problem, found);
    REQUIRE(motion);
    if (source == motion_source::witness) { // as where no box is inside
        identification bare(problem.prior);
        bare.witness = found.witness;
        motion = find_explaining_motion(problem, bare);
        REQUIRE(motion);
    }
    REQUIRE(motion->source == source);
    return {problem, io_support::stored_result(problem, found, &*motion).read()};
}

/// The cell of a row, numbers from 0, replaced.
void set_cell(std::string& text, std::size_t row, std::size_t column,
              std::function<std::string(std::string)> const& change) {
    std::size_t at = 0;
    for (std::size_t k = 0; k <= row; ++k) at = text.find('\n', at) + 1;
    for (std::size_t k = 0; k < column; ++k) at = text.find(',', at) + 1;
    auto const end = text.find_first_of(",\n", at);
    text.replace(at, end - at, change(text.substr(at, end - at)));
}
auto const moved = [](double by) {
    return [by](std::string const& cell) { return std::to_string(std::stod(cell) + by); };
};
auto const named = [](char const* name) { return [name](std::string const&) { return name; }; };

} // namespace

TEST_CASE("outputs.csv is verified for a box, a witness and a proved outlier") {
    for (bool const spoilt : {false, true}) {
        auto const problem = io_support::one_rate_problem(spoilt);
        for (auto const source : {motion_source::inside_box, motion_source::witness}) {
            auto const good = kept(problem, source);
            auto const found = good.check();
            CAPTURE(spoilt, to_string(source), found.detail);
            CHECK(found.found == outcome::verified);
            CHECK(good.stored.shown->source == to_string(source));
        }
    }
    auto silent = kept(io_support::one_rate_problem(), motion_source::witness);
    silent.stored.shown.reset();
    CHECK(silent.check().found == outcome::undecided);
    silent.stored.outputs.clear();
    CHECK(silent.check().found == outcome::nothing);
}

TEST_CASE("what is forged in outputs.csv is found, its digest adapted or not") {
    for (auto const source : {motion_source::inside_box, motion_source::witness}) {
        auto const good = kept(io_support::one_rate_problem(), source);
        CAPTURE(to_string(source));
        auto const refuted = [&](auto const& spoil) {
            return good.forged(spoil, false) == outcome::refuted &&
                   good.forged(spoil) == outcome::refuted;
        };
        CHECK(refuted([](std::string& t) { t.clear(); }));
        CHECK(refuted([](std::string& t) { t.resize(t.find('\n') + 1); }));                // rows
        CHECK(refuted([](std::string& t) { t.resize(t.rfind('\n', t.size() - 2) + 1); })); // one
        CHECK(refuted([](std::string& t) {                                                 // twice
            t += t.substr(t.rfind('\n', t.size() - 2) + 1);
        }));
        CHECK(refuted([](std::string& t) { t.pop_back(); }));
        CHECK(refuted([](std::string& t) { t[0] = 'S'; })); // a heading
        for (std::size_t const row : {0u, 3u, 5u}) {
            CHECK(refuted([&](std::string& t) { set_cell(t, row, 0, named("other")); }));
            CHECK(refuted([&](std::string& t) { set_cell(t, row, 1, moved(0.01)); }));
            CHECK(refuted([&](std::string& t) { set_cell(t, row, 2, named("z")); }));
            CHECK(refuted([&](std::string& t) { set_cell(t, row, 3, named("mm")); }));
            CHECK(refuted([&](std::string& t) { set_cell(t, row, 4, moved(-0.01)); }));
            CHECK(refuted([&](std::string& t) { set_cell(t, row, 5, moved(0.01)); }));
            CHECK(refuted([&](std::string& t) { set_cell(t, row, 6, named("none")); }));
            CHECK(refuted([&](std::string& t) { // both bounds away
                set_cell(t, row, 6, moved(0.1));
                set_cell(t, row, 7, moved(0.1));
            }));
            CHECK(refuted([&](std::string& t) { set_cell(t, row, 6, moved(0.1)); }));
            CHECK(refuted([&](std::string& t) { set_cell(t, row, 8, named("forced_outlier")); }));
            CHECK(refuted([&](std::string& t) { set_cell(t, row, 8, named("witness_outlier")); }));
            CHECK(refuted([&](std::string& t) { set_cell(t, row, 8, named("perhaps")); }));
            // Inward by half.
            for (std::size_t const column : {6u, 7u}) {
                std::array<double, 2> ends{};
                auto const says = good.forged([&](std::string& t) {
                    for (std::size_t const k : {0u, 1u})
                        set_cell(t, row, 6 + k, [&](std::string const& cell) {
                            ends[k] = std::stod(cell);
                            return cell;
                        });
                    set_cell(t, row, column, [&](std::string const&) {
                        return to_decimal_lower(0.5 * (ends[0] + ends[1]));
                    });
                });
                CAPTURE(row, column, ends[0], ends[1], to_string(says));
                CHECK(says == outcome::refuted);
            }
        }
    }
}

TEST_CASE("a cell that states no range states nothing false") {
    auto const good = kept(io_support::one_rate_problem(), motion_source::witness);
    CHECK(good.forged([](std::string& t) {
        set_cell(t, 3, 6, named(""));
        set_cell(t, 3, 7, named(""));
    }) == outcome::verified);
}

TEST_CASE("outputs of another motion than the one that is named are refuted") {
    auto const good = kept(io_support::one_rate_problem(), motion_source::witness);
    auto const refuted = [&](auto const& spoil) {
        auto bad = good;
        spoil(*bad.stored.shown);
        return bad.check().found == outcome::refuted;
    };
    CHECK(refuted([](auto& s) { s.source.clear(); }));
    CHECK(refuted([](auto& s) { s.parameters.clear(); }));
    CHECK(refuted([](auto& s) { s.initial.clear(); }));
    CHECK(refuted([](auto& s) { s.parameters["a"] = interval(3.0); }));
    CHECK(refuted([](auto& s) { s.parameters["a"] = interval(1.25); }));
    CHECK(refuted([](auto& s) { s.initial["run"]["x"] = interval(1.9); }));
    CHECK(refuted([](auto& s) { // what is no witness, but not its outputs
        s.source = to_string(motion_source::best_guess);
        s.parameters["a"] = interval(1.25);
    }));
    auto of_box = kept(io_support::one_rate_problem(), motion_source::inside_box);
    auto wider = of_box;
    auto& side = wider.stored.shown->parameters["a"];
    for (auto const& row : of_box.stored.rows)
        if (row.verdict == box_verdict::inside) side = hull(side, row.set[0]);
    side = interval(side.lower() - 1e-9, side.upper() + 1e-9);
    CHECK_THAT(wider.check().detail, ContainsSubstring("lie in no inside box"));
    for (auto& row : of_box.stored.rows) row.verdict = box_verdict::pending;
    CHECK(of_box.check().found == outcome::refuted);
}

TEST_CASE("a proved outlier that is not marked, or twice, is refuted") {
    auto const good = kept(io_support::one_rate_problem(true), motion_source::witness);
    CHECK(good.forged([](std::string& t) { set_cell(t, 2, 8, named("")); }) == outcome::refuted);
    CHECK(good.forged([](std::string& t) { set_cell(t, 2, 8, named("witness_outlier")); }) ==
          outcome::refuted);
    auto other = good;
    other.stored.forced.clear();
    CHECK(other.check().found == outcome::refuted);
}
