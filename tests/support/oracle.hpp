// SPDX-License-Identifier: MIT
// Exact bounds of functions at doubles, by MPFR: the greatest double <= f and the least double >=
// f. One value of the oracle serves every interval type: f is in [lo, hi] of doubles exactly if lo
// <= below and above <= hi.
#ifndef SIVID_TESTS_SUPPORT_ORACLE_HPP
#define SIVID_TESTS_SUPPORT_ORACLE_HPP

#include <mpfr.h>

#include <bit>
#include <cstdint>
#include <random>

namespace oracle {

/// The exact value lies in [below, above]; NaN where the function is not defined.
struct value {
    double below, above;
    bool defined() const { return below <= above; }
    bool in(double lo, double hi) const { return lo <= below && above <= hi; }
};

struct extra_bits {};
inline constexpr extra_bits extra{};

/// A number of 53 (64 if `extra`) bits and unbounded exponent: rounding to it and then to double in
/// one direction is rounding to double in that direction.
class number {
public:
    number() { mpfr_init2(raw_, 53); }
    explicit number(extra_bits) { mpfr_init2(raw_, 64); }
    explicit number(double x) : number() { mpfr_set_d(raw_, x, MPFR_RNDN); }
    ~number() { mpfr_clear(raw_); }
    number(number const&) = delete;
    number& operator=(number const&) = delete;
    mpfr_ptr raw() { return raw_; }

private:
    mpfr_t raw_;
};

using unary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using binary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

/// The doubles around the exact value v of which r is the rounding down to more than 53 bits, from
/// MPFR's statement whether it is exact: no double lies between r and the number above it.
inline value around(mpfr_ptr r, int ternary) {
    value v{};
    v.below = mpfr_get_d(r, MPFR_RNDD);
    if (ternary != 0) mpfr_nextabove(r);
    v.above = mpfr_get_d(r, MPFR_RNDU);
    return v;
}
inline value at(unary f, double x) {
    thread_local number a, r{extra};
    mpfr_set_d(a.raw(), x, MPFR_RNDN);
    return around(r.raw(), f(r.raw(), a.raw(), MPFR_RNDD));
}
inline value at(binary f, double x, double y) {
    thread_local number a, b, r{extra};
    mpfr_set_d(a.raw(), x, MPFR_RNDN);
    mpfr_set_d(b.raw(), y, MPFR_RNDN);
    return around(r.raw(), f(r.raw(), a.raw(), b.raw(), MPFR_RNDD));
}
/// x^n.
inline value power(double x, long n) {
    thread_local number a, r{extra};
    mpfr_set_d(a.raw(), x, MPFR_RNDN);
    return around(r.raw(), mpfr_pow_si(r.raw(), a.raw(), n, MPFR_RNDD));
}

/// Doubles that hurt, from a seed.
class inputs {
public:
    explicit inputs(std::uint64_t seed) : random_{seed} {}

    std::uint64_t bits() { return random_(); }
    std::uint64_t below(std::uint64_t n) { return random_() % n; }
    /// Uniform in [lo, hi]; the same on every machine, so nothing may be contracted.
    double uniform(double lo, double hi) {
        double const volatile above = (hi - lo) * (static_cast<double>(random_() >> 11) * 0x1p-53);
        return lo + above;
    }
    /// Any finite bit pattern: every magnitude with equal weight, subnormals, both signs.
    double any() {
        for (;;) {
            double const x = std::bit_cast<double>(random_());
            if (x - x == 0.0) return x;
        }
    }
    /// Magnitude between 2^lo and 2^(hi+1), either sign.
    double magnitude(int lo, int hi) {
        double const m = 1.0 + static_cast<double>(random_() >> 12) * 0x1p-52;
        int const e = lo + static_cast<int>(below(static_cast<std::uint64_t>(hi - lo + 1)));
        double const x = __builtin_ldexp(m, e);
        return (random_() & 1) != 0 ? -x : x;
    }
    double subnormal() {
        double const x = std::bit_cast<double>(random_() >> (12 + below(52)));
        return (random_() & 1) != 0 ? -x : x;
    }
    /// One of the doubles next to k pi/2, k up to 2^62.
    double near_quarter_turn() {
        thread_local number half_pi, r;
        mpfr_set_prec(half_pi.raw(), 200);
        mpfr_const_pi(half_pi.raw(), MPFR_RNDN);
        auto const k = static_cast<unsigned long>(random_() >> (2 + below(62)));
        mpfr_set_prec(r.raw(), 200);
        mpfr_mul_ui(r.raw(), half_pi.raw(), k, MPFR_RNDN);
        mpfr_div_2ui(r.raw(), r.raw(), 1, MPFR_RNDN);
        double const x = moved(mpfr_get_d(r.raw(), MPFR_RNDN), static_cast<int>(below(5)) - 2);
        return (random_() & 1) != 0 ? -x : x;
    }
    /// x a few floats further; infinities become the greatest finite number.
    static double moved(double x, int floats) {
        auto const magnitude_bits =
            static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) & ~(std::uint64_t{1} << 63));
        std::int64_t ordered = x < 0.0 ? -magnitude_bits : magnitude_bits;
        ordered += floats;
        constexpr std::int64_t top = 0x7fefffffffffffff;
        if (ordered > top) ordered = top;
        if (ordered < -top) ordered = -top;
        return ordered < 0 ? -std::bit_cast<double>(static_cast<std::uint64_t>(-ordered))
                           : std::bit_cast<double>(static_cast<std::uint64_t>(ordered));
    }
    /// A mixture of all of the above, and values around small integers and fractions.
    double mixed() {
        switch (below(8)) {
        case 0:
            return any();
        case 1:
            return subnormal();
        case 2:
            return near_quarter_turn();
        case 3:
            return magnitude(-60, 60);
        case 4: {
            int const by = static_cast<int>(below(7)) - 3; // one after the other on every machine
            return moved((static_cast<double>(below(65)) - 32.0) * 0.25, by);
        }
        case 5:
            return magnitude(-4, 10);
        case 6:
            return magnitude(-1070, -960);
        default:
            return uniform(-10.0, 10.0);
        }
    }

private:
    std::mt19937_64 random_;
};

} // namespace oracle

#endif
