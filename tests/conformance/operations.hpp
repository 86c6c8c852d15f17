// SPDX-License-Identifier: MIT
// The operations of the test vectors, called through interval_traits. `expected` results are the
// tightest enclosures.
#ifndef SIVID_TESTS_CONFORMANCE_OPERATIONS_HPP
#define SIVID_TESTS_CONFORMANCE_OPERATIONS_HPP

#include <sivid/number/interval_traits.hpp>

#include "support/further_functions.hpp"

#include <concepts>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace conformance {

/// What happened to the vectors that were run.
struct report {
    std::size_t run = 0, skipped = 0;
    std::vector<std::string> unsound, loose;

    /// All lanes of `got` against the tightest result [lo, hi] (NaN for the empty set).
    template <class I>
    [[gnu::noinline]] void result(char const* what, I const& got, double lo, double hi,
                                  bool must_be_tight) {
        ++run;
        using traits = sivid::interval_traits<I>;
        for (std::size_t lane = 0; lane < traits::lanes; ++lane) {
            double const got_lo = traits::lower(got, lane), got_hi = traits::upper(got, lane);
            bool const expected_empty = !(lo <= hi);
            if (!expected_empty && !(got_lo <= lo && hi <= got_hi)) {
                unsound.emplace_back(what);
                return;
            }
            bool const equal = expected_empty ? !(got_lo <= got_hi) : got_lo == lo && got_hi == hi;
            if (must_be_tight && !equal) {
                loose.emplace_back(what);
                return;
            }
        }
    }
};

inline constexpr double inf = std::numeric_limits<double>::infinity();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The operations by the names of the vector files; the whole line where a type does not have one.
template <class I>
struct operations {
    using t = sivid::interval_traits<I>;
    using mask = typename t::mask;
    static I make(double lo, double hi) { return t::bounds(lo, hi); }

    static I add(I const& a, I const& b) { return t::add(a, b); }
    static I sub(I const& a, I const& b) { return t::sub(a, b); }
    static I mul(I const& a, I const& b) { return t::mul(a, b); }
    static I div(I const& a, I const& b) {
        mask m{};
        return t::div(a, b, m);
    }
    static I min(I const& a, I const& b) { return t::min(a, b); }
    static I max(I const& a, I const& b) { return t::max(a, b); }
    static I hull(I const& a, I const& b) { return t::hull(a, b); }
    static I intersection(I const& a, I const& b) { return t::intersect(a, b); }
    static I pow(I const& a, I const& b) {
        mask m{};
        if constexpr (support::has_further_functions<I>)
            return t::pow(a, b, m);
        else
            return t::entire();
    }
    static I atan2(I const& a, I const& b) {
        mask m{};
        if constexpr (support::has_further_functions<I>)
            return t::atan2(a, b, m);
        else
            return t::entire();
    }
    /// No fused operation is offered; the sum of the product encloses it.
    static I fma(I const& a, I const& b, I const& c) { return t::add(t::mul(a, b), c); }
    static I neg(I const& a) { return t::neg(a); }
    static I recip(I const& a) {
        mask m{};
        return t::div(t::point(1.0), a, m);
    }
    static I sqr(I const& a) { return t::sqr(a); }
    static I sqrt(I const& a) {
        mask m{};
        return t::sqrt(a, m);
    }
    static I abs(I const& a) { return t::abs(a); }
    static I exp(I const& a) { return t::exp(a); }
    static I expm1(I const& a) {
        if constexpr (support::has_further_functions<I>)
            return t::expm1(a);
        else
            return t::entire();
    }
    static I log(I const& a) {
        mask m{};
        return t::log(a, m);
    }
    static I log1p(I const& a) {
        mask m{};
        if constexpr (support::has_further_functions<I>)
            return t::log1p(a, m);
        else
            return t::entire();
    }
    static I sin(I const& a) { return t::sin(a); }
    static I cos(I const& a) { return t::cos(a); }
    static I tan(I const& a) {
        mask m{};
        return t::tan(a, m);
    }
    static I asin(I const& a) {
        mask m{};
        if constexpr (support::has_further_functions<I>)
            return t::asin(a, m);
        else
            return t::entire();
    }
    static I acos(I const& a) {
        mask m{};
        if constexpr (support::has_further_functions<I>)
            return t::acos(a, m);
        else
            return t::entire();
    }
    static I atan(I const& a) { return t::atan(a); }
    static I sinh(I const& a) {
        if constexpr (support::has_further_functions<I>)
            return t::sinh(a);
        else
            return t::entire();
    }
    static I cosh(I const& a) {
        if constexpr (support::has_further_functions<I>)
            return t::cosh(a);
        else
            return t::entire();
    }
    static I tanh(I const& a) { return t::tanh(a); }
    // Not part of the concept: the whole line where a type does not have them.
    static I asinh(I const& a) {
        if constexpr (requires { t::asinh(a); })
            return t::asinh(a);
        else
            return t::entire();
    }
    static I acosh(I const& a) {
        mask m{};
        if constexpr (requires { t::acosh(a, m); })
            return t::acosh(a, m);
        else
            return t::entire();
    }
    static I atanh(I const& a) {
        mask m{};
        if constexpr (requires { t::atanh(a, m); })
            return t::atanh(a, m);
        else
            return t::entire();
    }
    // Operators, of a type that has them and knows the empty set.
    static constexpr bool has_operators = requires(I const& a) { a + a; }
    &&!requires(I const& a) { t::to_interval(a); };
    static I operator_add(I const& a, I const& b) {
        if constexpr (has_operators)
            return a + b;
        else
            return add(a, b);
    }
    static I operator_sub(I const& a, I const& b) {
        if constexpr (has_operators)
            return a - b;
        else
            return sub(a, b);
    }
    static I operator_mul(I const& a, I const& b) {
        if constexpr (has_operators)
            return a * b;
        else
            return mul(a, b);
    }
    static I operator_div(I const& a, I const& b) {
        if constexpr (has_operators)
            return a / b;
        else
            return div(a, b);
    }
    static I pown(I const& a, int n) {
        mask m{};
        return t::pown(a, n, m);
    }
};

/// The operations that are tight on doubles.
inline bool is_tight(std::string const& name) {
    for (char const* tight : {"add", "sub", "mul", "div", "recip", "neg", "sqr", "sqrt", "abs",
                              "min", "max", "hull", "intersection"})
        if (name == tight) return true;
    return false;
}

/// Whether the result of `name` has to be the vector's, not only to contain it: arithmetic of every
/// type (bounds of more digits are read outward in double), everything where MPFR computes.
template <class I>
bool must_be_tight(std::string const& name) {
    if (name == "fma") return false;
    return is_tight(name) || requires(I const& a) { sivid::interval_traits<I>::to_interval(a); };
}

} // namespace conformance

#endif
