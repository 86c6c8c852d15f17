// SPDX-License-Identifier: MIT
// What the generated literal tests need.
#ifndef SIVID_TESTS_CONFORMANCE_LITERALS_HPP
#define SIVID_TESTS_CONFORMANCE_LITERALS_HPP

#include "conformance/operations.hpp"

#include <iostream>

namespace conformance {

/// For types that compute in a library: the literals are arguments of calls in any case, and the
/// generated files compile several times faster.
template <class I>
struct out_of_line {
    using o = operations<I>;
    report& r;
    char const *name, *text;
    double lo, hi;

    void check(I const& got) const { r.result(text, got, lo, hi, must_be_tight<I>(name)); }
    [[gnu::noinline]] void call(I (*f)(I const&), double a, double b) const {
        check(f(o::make(a, b)));
    }
    [[gnu::noinline]] void call(I (*f)(I const&, int), double a, double b, int n) const {
        check(f(o::make(a, b), n));
    }
    [[gnu::noinline]] void call(I (*f)(I const&, I const&), double a, double b, double c,
                                double d) const {
        check(f(o::make(a, b), o::make(c, d)));
    }
    [[gnu::noinline]] void call(I (*f)(I const&, I const&, I const&), double a, double b, double c,
                                double d, double e, double g) const {
        check(f(o::make(a, b), o::make(c, d), o::make(e, g)));
    }
};

/// Prints the failures; the exit code of the program.
inline int conclude(report const& r) {
    for (auto const& text : r.unsound) std::cout << "unsound: " << text << '\n';
    for (auto const& text : r.loose) std::cout << "not tight: " << text << '\n';
    std::cout << r.run << " literal vectors, " << r.unsound.size() << " unsound, " << r.loose.size()
              << " not tight\n";
    return r.run > 0 && r.unsound.empty() && r.loose.empty() ? 0 : 1;
}

} // namespace conformance

// One vector of 1, 2, 3 intervals (and an integer). With SIVID_LITERAL_CALLS: out of line.
#if defined(SIVID_LITERAL_CALLS)
#define SIVID_LITERAL(name, text, lo, hi)                                                          \
    conformance::out_of_line<type> { r, #name, text, lo, hi }
#define SIVID_LITERAL_1_0(name, text, a, b, lo, hi)                                                \
    SIVID_LITERAL(name, text, lo, hi).call(o::name, a, b)
#define SIVID_LITERAL_1_1(name, text, a, b, n, lo, hi)                                             \
    SIVID_LITERAL(name, text, lo, hi).call(o::name, a, b, n)
#define SIVID_LITERAL_2_0(name, text, a, b, c, d, lo, hi)                                          \
    SIVID_LITERAL(name, text, lo, hi).call(o::name, a, b, c, d)
#define SIVID_LITERAL_3_0(name, text, a, b, c, d, e, f, lo, hi)                                    \
    SIVID_LITERAL(name, text, lo, hi).call(o::name, a, b, c, d, e, f)
#else
#define SIVID_LITERAL(name, text, call, lo, hi)                                                    \
    r.result(text, call, lo, hi, conformance::must_be_tight<type>(#name))
#define SIVID_LITERAL_1_0(name, text, a, b, lo, hi)                                                \
    SIVID_LITERAL(name, text, o::name(o::make(a, b)), lo, hi)
#define SIVID_LITERAL_1_1(name, text, a, b, n, lo, hi)                                             \
    SIVID_LITERAL(name, text, o::name(o::make(a, b), n), lo, hi)
#define SIVID_LITERAL_2_0(name, text, a, b, c, d, lo, hi)                                          \
    SIVID_LITERAL(name, text, o::name(o::make(a, b), o::make(c, d)), lo, hi)
#define SIVID_LITERAL_3_0(name, text, a, b, c, d, e, f, lo, hi)                                    \
    SIVID_LITERAL(name, text, o::name(o::make(a, b), o::make(c, d), o::make(e, f)), lo, hi)
#endif

#endif
