// SPDX-License-Identifier: MIT
#include <sivid/report/draw/paving_plot.hpp>

#include "support/catch.hpp"

using namespace sivid;
using report::named_paving;
using report::paving_projection;
using report::projections;
using report::region;

namespace {

subpaving paved(std::size_t sides) {
    box prior(sides);
    for (std::size_t j = 0; j < sides; ++j) prior[j] = interval(0.0, 8.0);
    subpaving p(prior);
    auto part = [&](double low, double high) {
        auto b = prior;
        b[0] = interval(low, high);
        return b;
    };
    p.add(part(0, 2), box_verdict::inside);
    p.add(part(2, 3), box_verdict::undecided);
    p.add(part(3, 4), box_verdict::pending);
    p.add(part(4, 8), box_verdict::outside);
    return p;
}
named_paving named(subpaving const& p, std::size_t sides) {
    named_paving n{.paving = &p};
    for (std::size_t j = 0; j < sides; ++j) {
        n.sides.push_back({std::string(1, static_cast<char>('a' + j)), "m", report::range{0, 8}});
        n.hull.push_back({0, 8.0 - static_cast<double>(j)}); // later ones are narrower
    }
    return n;
}
std::string pairs(std::vector<paving_projection> const& all) {
    std::string text;
    for (auto const& p : all) text += p.x.label + p.y.label + " ";
    return text;
}

} // namespace

TEST_CASE("a projection has the boxes that are not outside, and the witness") {
    auto const p = paved(2);
    auto n = named(p, 2);
    auto const bare = projections(n, {}, 6).at(0);
    CHECK_FALSE(bare.witness);
    n.witness = {1, 5};
    auto const shown = projections(n, {}, 6).at(0);
    REQUIRE(shown.witness);
    CHECK((shown.witness->x == 1 && shown.witness->y == 5));
    REQUIRE(shown.boxes.size() == 3);
    CHECK(shown.boxes[0].verdict == region::inside);
    CHECK(shown.boxes[1].verdict == region::undecided);
    CHECK(shown.boxes[2].verdict == region::pending);
    CHECK((shown.boxes[1].x.lo == 2 && shown.boxes[1].x.hi == 3));
}

TEST_CASE("all pairs of few sides, or of the four narrowest, wanted ones first, points never") {
    auto const three = paved(3);
    CHECK(pairs(projections(named(three, 3), {}, 6)) == "ab ac bc ");
    CHECK(pairs(projections(named(three, 3), {1, 2}, 6)) == "bc ab ac ");
    CHECK(pairs(projections(named(three, 3), {}, 2)) == "ab ac ");
    auto flat = named(three, 3);
    flat.sides[1].bounds = {4, 4};
    CHECK(pairs(projections(flat, {}, 6)) == "ac ");
    auto const six = paved(6);
    CHECK(pairs(projections(named(six, 6), {}, 6)) == "fe fd fc ed ec dc ");
}
