// SPDX-License-Identifier: MIT
#include <sivid/space/box_lanes.hpp>

#include <sivid/number/mp_interval.hpp>
#include <sivid/number/pack.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <cmath>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

constexpr std::size_t width_of_pack = 5;
using lanes_type = pack<width_of_pack>;

/// Now and then with an empty side, an unbounded one, or a point.
box random_box(draws& d) {
    box x(3);
    for (std::size_t i = 0; i < 3; ++i) {
        double const a = d.uniform(-2, 2), b = d.uniform(-2, 2);
        x[i] = between(std::min(a, b), std::max(a, b));
        if (d.below(12) == 0) x[i] = interval_traits<interval>::empty();
        if (d.below(12) == 0) x[i] = interval_traits<interval>::entire();
        if (d.below(12) == 0) x[i] = interval(a);
    }
    return x;
}
std::vector<box> random_boxes(draws& d) {
    std::vector<box> result;
    for (std::size_t k = 0; k < width_of_pack; ++k) result.push_back(random_box(d));
    return result;
}
bool same(box const& a, box const& b) {
    return (is_empty(a) && is_empty(b)) || (subset(a, b) && subset(b, a));
}

} // namespace

TEST_CASE("a box of packs is so many boxes side by side") {
    draws d(3);
    for (int round = 0; round < 300; ++round) {
        auto const a = random_boxes(d), b = random_boxes(d);
        auto const all_a = side_by_side<lanes_type>(a), all_b = side_by_side<lanes_type>(b);
        auto const around = hull(all_a, all_b), both = intersect(all_a, all_b);
        std::vector<double> const point{d.uniform(-2, 2), d.uniform(-2, 2), d.uniform(-2, 2)};
        for (std::size_t k = 0; k < width_of_pack; ++k) {
            INFO("lane " << k);
            CHECK(same(lane_of(all_a, k), a[k]));
            CHECK(lane_of(is_empty(all_a), k) == is_empty(a[k]));
            CHECK(lane_of(subset(all_a, all_b), k) == subset(a[k], b[k]));
            CHECK(lane_of(subset(both, all_a), k));
            CHECK(lane_of(contains(all_a, point), k) == contains(a[k], point));
            CHECK(same(lane_of(around, k), hull(a[k], b[k])));
            CHECK(same(lane_of(both, k), intersect(a[k], b[k])));
            if (is_empty(a[k])) continue;
            CHECK(mid(all_a, k) == mid(a[k]));
            CHECK(width(all_a, k) == width(a[k]));
        }
    }
}

TEST_CASE("lanes that no box was given for are empty") {
    auto const two = side_by_side<lanes_type>({box{between(0, 1)}, box{between(2, 3)}});
    CHECK(is_empty(two) == 0b11100);
    CHECK(every_lane<lanes_type>() == 0b11111);
    CHECK(is_empty(box_in<lanes_type>(box{between(0, 1)})) == 0);
    CHECK(same(lane_of(box_in<lanes_type>(box{between(0, 1)}), 4), box{between(0, 1)}));
    CHECK_THROWS_AS(side_by_side<lanes_type>({}), std::invalid_argument);
    CHECK_THROWS_AS(side_by_side<interval>({box(1), box(1)}), std::invalid_argument);
    CHECK_THROWS_AS(side_by_side<lanes_type>({box(1), box(2)}), std::invalid_argument);
}

TEST_CASE("a box in another type and back contains the box") {
    draws d(4);
    for (int round = 0; round < 200; ++round) {
        auto const x = random_box(d);
        CHECK(same(lane_of(side_by_side<mp_interval>({x})), x));
        CHECK(same(lane_of(box_in<interval>(x)), x));
    }
    // Bounds between doubles are rounded outward.
    using many = interval_traits<mp_interval>;
    bool cut = false;
    auto const third = many::div(many::point(1), many::point(3), cut);
    auto const seen = lane_of(basic_box<mp_interval>{third});
    CHECK(seen[0].lower() < seen[0].upper());
    CHECK(many::subset(third, many::bounds(seen[0].lower(), seen[0].upper())));
}
