// SPDX-License-Identifier: MIT
#include <sivid/paving/search/frontier.hpp>

#include <sivid/paving/search/detail/hull_rest.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

using namespace sivid;
using support::between;

TEST_CASE("waiting boxes come by volume or by age, and their hull is known") {
    using paving_detail::frontier;
    for (auto const order : {search_order::largest_first, search_order::first_in}) {
        frontier<int> waiting(order);
        waiting.push(box{between(0, 1)}, 1, 0);
        waiting.push(box{between(4, 6)}, 2, 0);
        CHECK(waiting.volume() == 3);
        auto const all = waiting.hull(box{between(-1, -1)});
        CHECK(all[0].lower() == -1);
        CHECK(all[0].upper() == 6);
        bool const by_age = order == search_order::first_in;
        CHECK(waiting.pop().volume == (by_age ? 1 : 2));
        CHECK(waiting.pop().volume == (by_age ? 2 : 1));
        CHECK(waiting.empty());
    }
}

TEST_CASE("a frontier goes back to a moment, whatever was taken and put back under other numbers") {
    paving_detail::frontier<int> waiting(search_order::largest_first);
    for (int k = 1; k <= 5; ++k) waiting.push(box{between(0, k)}, k, k);
    auto const before = waiting.now();
    auto largest = waiting.pop(), other = waiting.pop();
    std::vector<std::size_t> const moved{other.number};
    waiting.push(std::move(other.set), other.volume, other.load);
    waiting.back_to(before, {std::move(largest)}, moved);
    CHECK(waiting.pushed() == 5);
    CHECK(waiting.volume() == 15);
    for (int k = 5; k >= 1; --k) {
        auto const next = waiting.pop();
        CHECK(next.load == k);
        CHECK(next.number + 1 == static_cast<std::size_t>(k));
    }
}

TEST_CASE("the side to split is the one with the strongest smear that is still wide enough") {
    box const whole{between(0, 1), between(0, 10)};
    box const x{between(0, 0.5), between(0, 1)};
    using paving_detail::side_to_split;
    CHECK(side_to_split(x, whole, {}, 0.01) == 0);
    CHECK(side_to_split(x, whole, {1, 2}, 0.01) == 1);
    CHECK(side_to_split(x, whole, {1, 2}, 0.2) == 0);
    CHECK_FALSE(side_to_split(x, whole, {}, 0.6));
}

TEST_CASE("what is of one size but for rounding comes in the order of its coming") {
    // Halves of halves of a box whose bounds are rounded: in another unit other ones are larger.
    for (double const unit : {1.0, 1e3, 1 / 3600.0, 1e6}) {
        CAPTURE(unit);
        interval const side(0.1 * unit, 0.7 * unit);
        box const whole{side, side};
        std::vector<box> parts{whole};
        for (std::size_t const axis : {0u, 1u, 0u, 1u}) {
            std::vector<box> halves;
            for (auto const& x : parts) {
                // The halves of both sides are equally wide, too: the first one is split.
                CHECK(paving_detail::side_to_split(x, whole, {}, 0.01) == axis);
                auto [low, high] = bisect(x, axis, mid(x[axis]));
                halves.push_back(std::move(low));
                halves.push_back(std::move(high));
            }
            parts = std::move(halves);
        }
        paving_detail::frontier<int> waiting(search_order::largest_first);
        for (auto const& x : parts) waiting.push(x, relative_volume(x, whole).upper(), 0);
        for (std::size_t k = 0; k < parts.size(); ++k) CHECK(waiting.pop().number == k);
    }
    using paving_detail::rank_of;
    CHECK(rank_of(0.25) == 0.25);
    CHECK(rank_of(1.0 / 3) == rank_of(1 - 2.0 / 3));
    CHECK(rank_of(0.25) < rank_of(0.25 * (1 + 1e-6)));
    CHECK(rank_of(0) == 0);
    CHECK(rank_of(1e-320) > 0);
    CHECK(rank_of(HUGE_VAL) == HUGE_VAL);
}

TEST_CASE("a hull rests at the second look in a row at which no side has shrunk") {
    double wide = 8, high = 1;
    std::size_t looks = 0;
    auto const hull = [&] {
        ++looks;
        return box{between(0, wide), between(0, high)};
    };
    auto const always = [](box const&) { return true; };
    paving_detail::hull_rest rest{.last = box{between(0, 8), between(0, 1)}};
    CHECK_FALSE(rest(7, 0.02, hull, always));
    CHECK(looks == 0);
    CHECK_FALSE(rest(8, 0.02, hull, always)); // rests, once
    CHECK_FALSE(rest(15, 0.02, hull, always));
    CHECK(looks == 1);
    high = 0.9; // a slanting sheet: what was cut at first left the hull as it was
    CHECK_FALSE(rest(16, 0.02, hull, always));
    wide = 4;
    CHECK_FALSE(rest(32, 0.02, hull, always));
    wide = 3.95;
    CHECK_FALSE(rest(64, 0.02, hull, always));
    CHECK_FALSE(rest(127, 0.02, hull, always));
    CHECK(rest(128, 0.02, hull, always));
    CHECK(rest(128, 0.02, hull, always)); // also when asked again
    // Without a gain none but a hull that does not move at all.
    paving_detail::hull_rest exact{.last = hull()};
    CHECK_FALSE(exact(1000, 0, hull, always));
    wide = std::nextafter(wide, 0);
    CHECK_FALSE(exact(2000, 0, hull, always));
    CHECK_FALSE(exact(4000, 0, hull, always));
    CHECK(exact(8000, 0, hull, always));
    // What nobody saw sharply does not rest, however long nothing moves.
    paving_detail::hull_rest unseen{.last = hull()};
    bool seen = false;
    auto const held = [&](box const&) { return seen; };
    for (std::size_t const tests : {8u, 16u, 32u, 64u})
        CHECK_FALSE(unseen(tests, 0.02, hull, held));
    seen = true;
    CHECK_FALSE(unseen(127, 0.02, hull, held));
    CHECK(unseen(128, 0.02, hull, held));
}

TEST_CASE("a face of a hull is held by what touches it") {
    box const hull{between(0, 10), between(0, 1)};
    paving_detail::open_faces open(hull, 0.02);
    CHECK_FALSE(open.none());
    open.close({between(0.3, 9), between(0.5, 0.6)}); // touches none
    CHECK(open.touched_by({between(0.1, 1), between(0.5, 0.6)}));
    open.close({between(0.2, 9.8), between(0.5, 0.6)});
    CHECK_FALSE(open.touched_by({between(0, 10), between(0.5, 0.6)}));
    CHECK(open.touched_by({between(3, 4), between(0, 0.1)}));
    open.close({between(3, 4), between(0, 0.1)});
    CHECK_FALSE(open.none());
    open.close({between(3, 4), between(0.97, 0.979)});
    CHECK_FALSE(open.none());
    open.close({between(3, 4), between(0.97, 0.981)});
    CHECK(open.none());
}
