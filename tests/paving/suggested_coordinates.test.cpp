// SPDX-License-Identifier: MIT
#include <sivid/paving/suggested_coordinates.hpp>

#include "support/catch.hpp"
#include "support/problems.hpp"

#include <sivid/paving/identify.hpp>

using namespace sivid;
using support::between;
using support::draws;

namespace {

/// p0 and p1 through their sum, p2 and p3 through a ratio.
constexpr auto strip_rate = [](auto const&, auto const& x, auto const& p, auto const&) {
    return std::vector{p[2] / p[3] - (p[0] + p[1]) * x[0]};
};
box const strip_prior{between(0.25, 1), between(0.5, 1.5), between(0.5, 2), between(1, 2)};

support::planted_problem strip(draws& d) {
    return support::plant(d, {1, 4, 0, 10}, strip_rate, strip_prior, {1}, {.noise = 0.01});
}
identifiability told(identification_problem const& problem) {
    return identifiability_of(problem, point_box(mid(problem.prior)));
}

} // namespace

TEST_CASE("sums and ratios become coordinates, and lead back to the parameters") {
    draws d(681);
    auto const planted = strip(d);
    auto const change = suggested_coordinates(planted.problem, told(planted.problem));
    REQUIRE(change);
    std::vector<std::string> names;
    for (auto const& c : change->coordinates) names.push_back(c.name);
    CHECK(names == std::vector<std::string>{"p0 + p1", "p1", "p2/p3", "p3"});
    for (int round = 0; round < 50; ++round) {
        auto const p = d.in(strip_prior);
        auto const q = change->forward.over(point_box(p));
        REQUIRE(q);
        CHECK(std::abs(mid((*q)[0]) - (p[0] + p[1])) < 1e-12);
        CHECK(std::abs(mid((*q)[2]) - p[2] / p[3]) < 1e-12);
        auto const back = change->backward.over(*q);
        REQUIRE(back);
        CHECK(contains(*back, p));
        CHECK(width(*back) < 1e-12);
    }
}

TEST_CASE("without a formula there is nothing to suggest") {
    draws d(682);
    auto const plain = support::plant(d, 0, {});
    CHECK_FALSE(suggested_coordinates(plain.problem, told(plain.problem)));
}

TEST_CASE("in suggested coordinates the same boxes tell more") {
    draws d(683);
    auto const planted = strip(d);
    auto const change = suggested_coordinates(planted.problem, told(planted.problem));
    REQUIRE(change);
    changed_problem const posed(planted.problem, *change);
    identify_options o;
    o.search.boxes = 400;
    o.search.seconds = 60;
    auto const found = identify(posed.problem(), o);
    CHECK(found.verdict == verdict::consistent);
    auto const q = change->forward.over(point_box(planted.truth));
    REQUIRE(q);
    CHECK_FALSE(is_empty(intersect(found.hull, *q)));
    CHECK(contains(posed.parameter_hull(found), planted.truth));
    // The sum and the ratio are found to a small part of what the prior allows.
    CHECK(width(found.hull[0]) < 0.2 * width(posed.problem().prior[0]));
    CHECK(width(found.hull[2]) < 0.2 * width(posed.problem().prior[2]));
}
