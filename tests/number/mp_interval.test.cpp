// SPDX-License-Identifier: MIT
#if defined(SIVID_HAS_MPFI)

#include <sivid/number/mp_interval.hpp>

#include "conformance/vectors.hpp"
#include "laws/laws.hpp"
#include "number/support.hpp"

using sivid::mp_interval;
using traits = sivid::interval_traits<mp_interval>;

TEST_CASE("the multiprecision type contains every test vector") {
#if defined(SIVID_SHARED_DIR)
    for (char const* name : {"itf1788.txt", "mpfi_elem.txt"}) {
        auto const lines =
            conformance::read_vectors(std::string{SIVID_SHARED_DIR "/vectors/"} + name);
        conformance::report r;
        conformance::run_vectors<mp_interval>(lines, false, r);
        for (auto const& line : r.unsound) UNSCOPED_INFO("unsound: " << line);
        CHECK(r.unsound.empty());
        CHECK((lines.empty() || r.run > 1000));
    }
#else
    SUCCEED("no vectors");
#endif
}

TEST_CASE("the multiprecision type contains what MPFR computes in double") {
    for (auto const& m : laws::all_contained<mp_interval>(laws::containment_count(5'000), 11)) {
        INFO(m.first);
        CHECK(m.count == 0);
    }
}

TEST_CASE("the multiprecision type obeys the laws") {
    auto const failures = laws::all<mp_interval>(1'000, 12);
    for (auto const& failure : failures) UNSCOPED_INFO(failure);
    CHECK(failures.empty());
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
