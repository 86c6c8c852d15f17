// SPDX-License-Identifier: MIT
#include <sivid/number/pack.hpp>

#include "support/catch.hpp"

#include <cstdint>
#include <limits>

using sivid::interval;
using P = sivid::pack<8>;
using T = sivid::interval_traits<P>;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double least = std::numeric_limits<double>::denorm_min();
constexpr double most = std::numeric_limits<double>::max();

P lanes(std::initializer_list<interval> list) {
    P x = T::empty();
    std::size_t i = 0;
    for (interval const& y : list) x.set(i++, y);
    return x;
}
interval const none = sivid::interval_traits<interval>::empty();
interval const all = sivid::interval_traits<interval>::entire();
interval of(double lo, double hi) { return sivid::interval_traits<interval>::bounds(lo, hi); }

void check_lane(P const& x, std::size_t lane, double lo, double hi) {
    INFO("lane " << lane);
    CHECK(T::lower(x, lane) == lo);
    CHECK(T::upper(x, lane) == hi);
}

} // namespace

TEST_CASE("pack traits: masks have one bit for each lane") {
    P const x = lanes(
        {of(1.0, 2.0), none, of(-1.0, 1.0), of(3.0, 3.0), all, of(0.0, 0.0), none, of(5.0, 6.0)});
    CHECK(T::all_lanes == 0xFF);
    CHECK(T::is_empty(x) == 0b01000010);
    CHECK(T::is_point(x) == 0b00101000);
    CHECK(T::contains(x, 1.0) == 0b00010101);
    CHECK(T::contains(x, inf) == 0);
    CHECK(T::subset(x, T::bounds(0.0, 5.0)) == 0b01101011);
    CHECK(T::interior(x, T::bounds(0.0, 5.0)) == 0b01001011);
    CHECK(T::interior(x, T::entire()) == 0xFF);
    CHECK(T::disjoint(x, T::bounds(2.5, 4.0)) == 0b11100111);
    CHECK(sivid::interval_traits<sivid::pack<64>>::all_lanes == ~std::uint64_t{0});
}

TEST_CASE("pack traits: quotients over the non-zero part of the divisor") {
    std::uint64_t cut = 0;
    P const q = T::div(lanes({of(1.0, 2.0), of(1.0, 2.0), of(-30.0, 0.0), of(0.0, 0.0),
                              of(1.0, 1.0), of(1.0, 1.0), none, of(-inf, -1.0)}),
                       lanes({of(0.0, 4.0), of(-1.0, 4.0), of(0.0, 3.0), of(-1.0, 1.0),
                              of(0.0, 0.0), of(3.0, 3.0), of(0.0, 1.0), of(-2.0, 0.0)}),
                       cut);
    check_lane(q, 0, 0.25, inf);
    check_lane(q, 1, -inf, inf);
    check_lane(q, 2, -inf, 0.0);
    check_lane(q, 3, 0.0, 0.0);
    check_lane(q, 5, 0x1.5555555555555p-2, 0x1.5555555555556p-2);
    check_lane(q, 7, 0.5, inf);
    CHECK(T::is_empty(q) == 0b01010000);
    CHECK(cut == 0b10011111);
    T::div(T::point(1.0), T::point(2.0), cut);
    CHECK(cut == 0b10011111); // never cleared
}

TEST_CASE("pack traits: infinities, zeros and the ends of the range in products") {
    P const p = T::mul(lanes({of(0.0, 0.0), of(0.0, 1.0), all, of(least, least), of(most, most),
                              of(-most, -most), none, of(-inf, -1.0)}),
                       lanes({all, of(-inf, inf), all, of(least, least), of(2.0, 2.0), of(2.0, 2.0),
                              all, of(0.0, 0.0)}));
    check_lane(p, 0, 0.0, 0.0);
    check_lane(p, 1, -inf, inf);
    check_lane(p, 2, -inf, inf);
    check_lane(p, 3, 0.0, least);
    check_lane(p, 4, most, inf);
    check_lane(p, 5, -inf, -most);
    check_lane(p, 7, 0.0, 0.0);
    CHECK(T::is_empty(p) == 0b01000000);
    P const s = T::add(T::point(1.0), T::point(0x1p-80));
    check_lane(s, 0, 1.0, 1.0 + 0x1p-52);
    check_lane(T::sub(T::point(1.0), T::point(least)), 7, 1.0 - 0x1p-53, 1.0);
}

TEST_CASE("pack traits: a cut domain is seen lane by lane") {
    std::uint64_t cut = 0;
    P const x = lanes({of(-1.0, 4.0), of(4.0, 9.0), of(-2.0, -1.0), none, of(0.0, 1.0), all,
                       of(0.0, 0.0), of(2.0, 2.0)});
    P const root = T::sqrt(x, cut);
    CHECK(cut == 0b00100101);
    check_lane(root, 0, 0.0, 2.0);
    check_lane(root, 1, 2.0, 3.0);
    CHECK(T::is_empty(root) == 0b00001100);
    cut = 0;
    CHECK(T::is_empty(T::log(x, cut)) == 0b01001100);
    CHECK(cut == 0b01110101);
    cut = 0;
    T::tan(x, cut);
    CHECK(cut == 0b00100011 + 0b00000100); // pi/2 in [-1, 4], 3 pi/2 in [4, 9], -pi/2 in [-2, -1]
    cut = 0;
    CHECK(T::is_empty(T::pown(x, -3, cut)) == 0b01001000);
    CHECK(cut == 0b01110001);
}

TEST_CASE("pack traits: integer powers") {
    std::uint64_t cut = 0;
    P const x = lanes({of(-2.0, 3.0), of(-3.0, -2.0), of(2.0, 3.0), of(0.0, 0.0), none,
                       of(-inf, 2.0), of(-1.0, 1.0), of(-2.0, 0.0)});
    P const third = T::pown(x, 3, cut), fourth = T::pown(x, 4, cut), zeroth = T::pown(x, 0, cut);
    check_lane(third, 0, -8.0, 27.0);
    check_lane(third, 1, -27.0, -8.0);
    check_lane(third, 5, -inf, 8.0);
    check_lane(fourth, 0, 0.0, 81.0);
    check_lane(fourth, 1, 16.0, 81.0);
    check_lane(fourth, 5, 0.0, inf);
    check_lane(zeroth, 3, 1.0, 1.0);
    CHECK(T::is_empty(zeroth) == 0b00010000);
    CHECK(cut == 0);
    // Powers that underflow do not divide by zero.
    P const tiny = T::pown(T::point(1e-200), -3, cut);
    CHECK(cut == 0);
    CHECK(T::lower(tiny) > 1e300);
    CHECK(T::upper(tiny) == inf);
}

TEST_CASE("pack traits: one lane is read as the vocabulary type reads it") {
    P const x = lanes({of(-1.0, 4.0), all});
    CHECK(T::mid(x, 0) == 1.5);
    CHECK(T::rad(x, 0) == 2.5);
    CHECK(T::width(x, 0) == 5.0);
    CHECK(T::mag(x, 0) == 4.0);
    CHECK(T::mig(x, 0) == 0.0);
    CHECK(T::mid(x, 1) == 0.0);
    CHECK(T::width(x, 1) == inf);
}
