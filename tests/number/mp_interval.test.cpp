// SPDX-License-Identifier: MIT
#if defined(SIVID_HAS_MPFI)

#include <sivid/number/mp_interval.hpp>

#include "number/support.hpp"

using sivid::mp_interval;
using traits = sivid::interval_traits<mp_interval>;

// Vectors, laws and random containment: tests/conformance and tests/laws, as for every type.

TEST_CASE("NaN and infinity are no members") {
    CHECK_FALSE(traits::contains(traits::entire(), sivid::detail::not_a_number));
    CHECK_FALSE(traits::contains(traits::entire(), inf));
    CHECK(traits::contains(traits::entire(), greatest));
    CHECK_FALSE(traits::contains(traits::empty(), 0.0));
}

TEST_CASE("more digits than double") {
    bool cut = false;
    mp_interval const third = traits::div(traits::point(1.0), traits::point(3.0), cut);
    mp_interval const product = traits::mul(third, traits::point(3.0));
    CHECK(traits::contains(product, 1.0));
    CHECK(traits::upper(traits::sub(third, third)) < 1e-38);
    CHECK_FALSE(traits::is_point(third));
    // The operators of Boost.Multiprecision agree.
    CHECK(traits::subset(third, mp_interval{1} / mp_interval{3}));
    CHECK(traits::upper(traits::exp(traits::point(1.0))) == 0x1.5bf0a8b14576ap1);
    CHECK(traits::lower(traits::exp(traits::point(1.0))) == 0x1.5bf0a8b145769p1);
}

#endif
