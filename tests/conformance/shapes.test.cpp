// SPDX-License-Identifier: MIT
#include "conformance/shapes.hpp"
#include "support/catch.hpp"

#include <cfenv>
#include <functional>
#include <thread>

using namespace shapes;

namespace {

constexpr int rounds = 20'000;

/// Runs `body` for 20 000 random inputs, with the rounding mode set to `mode` during the body only.
template <class Body>
tally run(std::uint64_t seed, Body const& body, int mode = FE_TONEAREST, int times = rounds) {
    tally t;
    oracle::inputs in{seed};
    for (int i = 0; i < times; ++i) {
        std::fesetround(mode);
        body(t, in);
        bool const kept = std::fegetround() == mode;
        std::fesetround(FE_TONEAREST);
        t.check(kept);
    }
    return t;
}

void require_none_missed(tally const& t) {
    CHECK(t.run > 0);
    CHECK(t.missed == 0);
}

} // namespace

TEST_CASE("shapes: constants") {
    require_none_missed(run(1, constant_operands<by_traits>));
    require_none_missed(run(1, constant_operands<by_operators>));
}
TEST_CASE("shapes: loop invariants") {
    require_none_missed(run(2, loop_invariants<by_traits>));
    require_none_missed(run(2, loop_invariants<by_operators>));
}
TEST_CASE("shapes: the same operation on plain doubles beside") {
    require_none_missed(run(3, beside_plain<by_traits>));
    require_none_missed(run(3, beside_plain<by_operators>));
}
TEST_CASE("shapes: two enclosures of one product meet") {
    require_none_missed(run(4, twice_enclosed<by_traits>));
    require_none_missed(run(4, twice_enclosed<by_operators>));
}
TEST_CASE("shapes: products that invite contraction") {
    require_none_missed(run(5, contraction<by_traits>));
    require_none_missed(run(5, contraction<by_operators>));
}
TEST_CASE("shapes: loops that invite vectors") {
    require_none_missed(run(6, vector_loop<by_traits>));
    require_none_missed(run(6, vector_loop<by_operators>));
}
TEST_CASE("shapes: constant divisors") {
    require_none_missed(run(7, constant_divisors<by_traits>));
    require_none_missed(run(7, constant_divisors<by_operators>));
}
TEST_CASE("shapes: long sums") {
    require_none_missed(run(8, long_sum<by_traits>));
    require_none_missed(run(8, long_sum<by_operators>));
}

TEST_CASE("shapes: a call in another rounding mode") {
    // MPFR and the checks themselves do not depend on the mode; plain results are compared
    // elsewhere.
    int const mode = GENERATE(FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO);
    require_none_missed(run(9, constant_operands<by_traits>, mode));
    require_none_missed(run(9, constant_operands<by_operators>, mode));
    require_none_missed(run(10, loop_invariants<by_traits>, mode));
    require_none_missed(run(10, loop_invariants<by_operators>, mode));
    require_none_missed(run(11, contraction<by_traits>, mode));
    require_none_missed(run(12, vector_loop<by_traits>, mode));
    require_none_missed(run(12, vector_loop<by_operators>, mode));
    require_none_missed(run(13, library_functions, mode));
}

TEST_CASE("shapes: another thread, while the first one rounds differently") {
    int const mode = GENERATE(FE_TONEAREST, FE_UPWARD, FE_DOWNWARD);
    tally t;
    std::fesetround(mode); // a new thread inherits it
    std::thread other{[&] {
        oracle::inputs in{14};
        for (int i = 0; i < rounds; ++i) {
            constant_operands<by_traits>(t, in);
            library_functions(t, in);
        }
    }};
    other.join();
    std::fesetround(FE_TONEAREST);
    require_none_missed(t);
}

TEST_CASE("shapes: after a callback that leaves another mode behind") {
    std::function<void(int)> const callback = change_rounding_elsewhere;
    static constexpr int modes[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    require_none_missed(run(15, [&](tally& t, oracle::inputs& in) {
        double const x = in.magnitude(-20, 20), y = in.magnitude(-20, 20);
        interval const before = by_traits::mul(x, y);
        int const mode = modes[in.below(4)];
        callback(mode);
        interval const after = by_traits::mul(x, y), sum = by_operators::add(x, y);
        interval const sine = sivid::sin(interval{x});
        t.check(std::fegetround() == mode);
        callback(FE_TONEAREST);
        t.check(before, oracle::at(mpfr_mul, x, y));
        t.check(after, oracle::at(mpfr_mul, x, y));
        t.check(sum, oracle::at(mpfr_add, x, y));
        t.check(sine, oracle::at(mpfr_sin, x));
    }));
}

TEST_CASE("shapes: two translation units") {
    require_none_missed(run(16, [](tally& t, oracle::inputs& in) {
        double const x = in.magnitude(-20, 20), y = in.magnitude(-20, 20);
        double const plain = plain_product_elsewhere(x, y);
        interval const here = by_traits::mul(x, y), there = product_elsewhere(x, y);
        t.check(equal(here, there) && contains(there, plain) && contains(here, x * y));
        t.check(there, oracle::at(mpfr_mul, x, y));
        t.check(sum_elsewhere(x, y), oracle::at(mpfr_add, x, y));
        t.check(quotient_elsewhere(x, y), oracle::at(mpfr_div, x, y));
        t.check(sine_elsewhere(x), oracle::at(mpfr_sin, x));
    }));
}

TEST_CASE("shapes: every seed counts", "[.long]") {
    for (std::uint64_t seed = 100; seed < 120; ++seed) {
        require_none_missed(run(seed, every_shape<by_traits>));
        require_none_missed(run(seed, every_shape<by_operators>));
    }
}
