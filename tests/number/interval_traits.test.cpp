// SPDX-License-Identifier: MIT
#include <sivid/number/interval_traits.hpp>

#include "number/support.hpp"

#include <cmath>

using sivid::interval;
using traits = sivid::interval_traits<interval>;

TEST_CASE("who models the concept") {
    STATIC_REQUIRE(sivid::interval_scalar<interval>);
    STATIC_REQUIRE_FALSE(sivid::interval_scalar<double>);
    STATIC_REQUIRE_FALSE(sivid::interval_scalar<int>);
    STATIC_REQUIRE(traits::lanes == 1);
}

TEST_CASE("making and reading") {
    CHECK(equal(traits::point(2.5), make(2.5, 2.5)));
    CHECK(is_empty(traits::point(std::nan(""))));
    CHECK(is_empty(traits::bounds(2, 1)));
    CHECK(equal(traits::point(inf), make(greatest, inf)));
    CHECK(equal(traits::entire(), everything()));
    CHECK(is_empty(traits::empty()));
    interval const x = traits::bounds(-1, 3);
    CHECK(traits::lower(x) == -1.0);
    CHECK(traits::upper(x, 0) == 3.0);
    CHECK(traits::mid(x) == 1.0);
    CHECK(traits::rad(x) == 2.0);
    CHECK(traits::width(x) == 4.0);
    CHECK(traits::mag(x) == 3.0);
    CHECK(traits::mig(x) == 0.0);
    CHECK(traits::contains(x, 0.0));
    CHECK(traits::subset(x, traits::entire()));
    CHECK(traits::interior(x, traits::bounds(-2, 4)));
    CHECK(traits::disjoint(x, traits::point(4)));
    CHECK_FALSE(traits::is_point(x));
}

TEST_CASE("the flag is set where a function is not defined, and never cleared") {
    interval const x = make(-1, 4);
    auto const sets = [&](auto const& f, interval const& argument) {
        bool cut = false;
        static_cast<void>(f(argument, cut));
        bool const first = cut;
        static_cast<void>(f(make(0.25, 0.5), cut)); // defined for all of them
        CHECK(cut == first);
        return first;
    };
    CHECK(sets(traits::sqrt, x));
    CHECK(sets(traits::log, x));
    CHECK(sets(traits::log1p, x));
    CHECK(sets(traits::tan, x));
    CHECK(sets(traits::asin, x));
    CHECK(sets(traits::acos, x));
    CHECK(sets([](interval const& a, bool& cut) { return traits::div(a, a, cut); }, x));
    CHECK(sets([](interval const& a, bool& cut) { return traits::pown(a, -1, cut); }, x));
    CHECK(sets([](interval const& a, bool& cut) { return traits::pow(a, a, cut); }, x));
    CHECK(sets([](interval const& a, bool& cut) { return traits::atan2(a, a, cut); }, x));
    CHECK_FALSE(sets(traits::sqrt, make(0, 4)));
    CHECK_FALSE(sets(traits::asin, make(-1, 1)));
}
