// SPDX-License-Identifier: MIT
#include "conformance/shapes.hpp"
#include "conformance/types.hpp"
#include "support/catch.hpp"
#include "support/rounding_modes.hpp"

#include <cfenv>
#include <concepts>
#include <functional>
#include <thread>

using namespace shapes;

namespace {

constexpr int rounds = 20'000;
/// Fewer for the type that computes in a library, of which compilers see the calls only.
template <class I>
constexpr int rounds_of = by_traits<I>::rounds ? rounds : rounds / 10;
/// The operators of packs are calls of the traits.
template <class I>
constexpr bool own_operators = std::same_as<I, sivid::interval>;

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

TEMPLATE_TEST_CASE("shapes: constants", "", SIVID_COMPILED_TYPES SIVID_MULTIPRECISION_TYPES) {
    require_none_missed(
        run(1, constant_operands<by_traits<TestType>>, FE_TONEAREST, rounds_of<TestType>));
    if constexpr (own_operators<TestType>)
        require_none_missed(run(1, constant_operands<by_operators<TestType>>));
}
TEMPLATE_TEST_CASE("shapes: loop invariants", "", SIVID_COMPILED_TYPES SIVID_MULTIPRECISION_TYPES) {
    require_none_missed(
        run(2, loop_invariants<by_traits<TestType>>, FE_TONEAREST, rounds_of<TestType>));
    if constexpr (own_operators<TestType>)
        require_none_missed(run(2, loop_invariants<by_operators<TestType>>));
}
TEMPLATE_TEST_CASE("shapes: the same operation on plain doubles beside", "",
                   SIVID_COMPILED_TYPES SIVID_MULTIPRECISION_TYPES) {
    require_none_missed(
        run(3, beside_plain<by_traits<TestType>>, FE_TONEAREST, rounds_of<TestType>));
    if constexpr (own_operators<TestType>)
        require_none_missed(run(3, beside_plain<by_operators<TestType>>));
}
TEMPLATE_TEST_CASE("shapes: two enclosures of one product meet", "",
                   SIVID_COMPILED_TYPES SIVID_MULTIPRECISION_TYPES) {
    require_none_missed(
        run(4, twice_enclosed<by_traits<TestType>>, FE_TONEAREST, rounds_of<TestType>));
    if constexpr (own_operators<TestType>)
        require_none_missed(run(4, twice_enclosed<by_operators<TestType>>));
}
TEMPLATE_TEST_CASE("shapes: products that invite contraction", "",
                   SIVID_COMPILED_TYPES SIVID_MULTIPRECISION_TYPES) {
    require_none_missed(
        run(5, contraction<by_traits<TestType>>, FE_TONEAREST, rounds_of<TestType>));
    if constexpr (own_operators<TestType>)
        require_none_missed(run(5, contraction<by_operators<TestType>>));
}
TEMPLATE_TEST_CASE("shapes: loops that invite vectors", "",
                   SIVID_COMPILED_TYPES SIVID_MULTIPRECISION_TYPES) {
    require_none_missed(
        run(6, vector_loop<by_traits<TestType>>, FE_TONEAREST, rounds_of<TestType>));
    if constexpr (own_operators<TestType>)
        require_none_missed(run(6, vector_loop<by_operators<TestType>>));
}
TEMPLATE_TEST_CASE("shapes: constant divisors", "",
                   SIVID_COMPILED_TYPES SIVID_MULTIPRECISION_TYPES) {
    require_none_missed(
        run(7, constant_divisors<by_traits<TestType>>, FE_TONEAREST, rounds_of<TestType>));
    if constexpr (own_operators<TestType>)
        require_none_missed(run(7, constant_divisors<by_operators<TestType>>));
}
TEMPLATE_TEST_CASE("shapes: long sums", "", SIVID_COMPILED_TYPES SIVID_MULTIPRECISION_TYPES) {
    require_none_missed(run(8, long_sum<by_traits<TestType>>, FE_TONEAREST, rounds_of<TestType>));
    if constexpr (own_operators<TestType>)
        require_none_missed(run(8, long_sum<by_operators<TestType>>));
}
TEMPLATE_TEST_CASE("shapes: different lanes beside plain loops", "", SIVID_VECTOR_TYPES) {
    require_none_missed(
        run(17, lanes_beside_plain<by_traits<TestType>>, FE_TONEAREST, rounds_of<TestType>));
    if constexpr (own_operators<TestType>)
        require_none_missed(run(17, lanes_beside_plain<by_operators<TestType>>));
}
TEMPLATE_TEST_CASE("shapes: functions", "", SIVID_COMPILED_TYPES SIVID_MULTIPRECISION_TYPES) {
    require_none_missed(run(18, functions<TestType>, FE_TONEAREST, rounds_of<TestType>));
}

TEMPLATE_TEST_CASE("shapes: a call in another rounding mode", "",
                   SIVID_COMPILED_TYPES SIVID_MULTIPRECISION_TYPES) {
    // MPFR and the checks themselves do not depend on the mode; plain results are compared
    // elsewhere.
    int const mode = GENERATE(FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO), n = rounds_of<TestType>;
    require_none_missed(run(9, constant_operands<by_traits<TestType>>, mode, n));
    if constexpr (own_operators<TestType>)
        require_none_missed(run(9, constant_operands<by_operators<TestType>>, mode, n));
    require_none_missed(run(10, loop_invariants<by_traits<TestType>>, mode, n));
    if constexpr (own_operators<TestType>)
        require_none_missed(run(10, loop_invariants<by_operators<TestType>>, mode, n));
    require_none_missed(run(11, contraction<by_traits<TestType>>, mode, n));
    require_none_missed(run(12, vector_loop<by_traits<TestType>>, mode, n));
    if constexpr (own_operators<TestType>)
        require_none_missed(run(12, vector_loop<by_operators<TestType>>, mode, n));
    require_none_missed(run(13, functions<TestType>, mode, n));
}

TEMPLATE_TEST_CASE("shapes: another thread, while the first one rounds differently", "",
                   SIVID_COMPILED_TYPES SIVID_MULTIPRECISION_TYPES) {
    int const mode = GENERATE(FE_TONEAREST, FE_UPWARD, FE_DOWNWARD);
    tally t;
    std::fesetround(mode); // a new thread inherits it
    std::thread other{[&] {
        oracle::inputs in{14};
        for (int i = 0; i < rounds_of<TestType>; ++i) {
            constant_operands<by_traits<TestType>>(t, in);
            functions<TestType>(t, in);
        }
        mpfr_free_cache(); // of this thread: the oracle's
    }};
    other.join();
    std::fesetround(FE_TONEAREST);
    require_none_missed(t);
}

TEMPLATE_TEST_CASE("shapes: after a callback that leaves another mode behind", "",
                   SIVID_COMPILED_TYPES SIVID_MULTIPRECISION_TYPES) {
    using a = by_traits<TestType>;
    using b = by_operators<TestType>;
    std::function<void(int)> const callback = change_rounding_elsewhere;
    require_none_missed(run(15, [&](tally& t, oracle::inputs& in) {
        double const x = in.magnitude(-20, 20), y = in.magnitude(-20, 20);
        auto const before = a::mul(a::of(x), a::of(y));
        int const mode = support::rounding_modes[in.below(4)];
        callback(mode);
        auto const after = a::mul(a::of(x), a::of(y)), sum = b::add(a::of(x), a::of(y));
        auto const sine = a::sin(a::of(x));
        t.check(std::fegetround() == mode);
        callback(FE_TONEAREST);
        t.check(before, oracle::at(mpfr_mul, x, y));
        t.check(after, oracle::at(mpfr_mul, x, y));
        t.check(sum, oracle::at(mpfr_add, x, y));
        t.check(sine, oracle::at(mpfr_sin, x));
    }));
}

TEMPLATE_TEST_CASE("shapes: two translation units", "",
                   SIVID_COMPILED_TYPES SIVID_MULTIPRECISION_TYPES) {
    using a = by_traits<TestType>;
    require_none_missed(run(16, [](tally& t, oracle::inputs& in) {
        double const x = in.magnitude(-20, 20), y = in.magnitude(-20, 20);
        double const plain = plain_product_elsewhere(x, y);
        auto const here = a::mul(a::of(x), a::of(y)), there = product_elsewhere<TestType>(x, y);
        t.check(same(here, there) && contains(there, plain) && contains(here, x * y));
        t.check(there, oracle::at(mpfr_mul, x, y));
        t.check(sum_elsewhere<TestType>(x, y), oracle::at(mpfr_add, x, y));
        t.check(quotient_elsewhere<TestType>(x, y), oracle::at(mpfr_div, x, y));
        t.check(sine_elsewhere<TestType>(x), oracle::at(mpfr_sin, x));
    }));
}

TEMPLATE_TEST_CASE("shapes: every seed counts", "[.long]",
                   SIVID_COMPILED_TYPES SIVID_MULTIPRECISION_TYPES) {
    for (std::uint64_t seed = 100; seed < 120; ++seed) {
        require_none_missed(run(seed, every_shape<by_traits<TestType>>));
        require_none_missed(run(seed, every_shape<by_operators<TestType>>));
    }
}
