// SPDX-License-Identifier: MIT
// Compiled once for each back end.
#include "pack_backends/backend.hpp"

#include "conformance/shapes.hpp"
#include "conformance/vectors.hpp"
#include "laws/laws.hpp"
#include "pack_backends/kernel_errors.hpp"

#include "support/pack_functions.hpp"

#include <bit>
#include <cfenv>

namespace backends::SIVID_PACK_TARGET {
namespace {

using sivid::interval;
using sivid::pack;
using vocabulary = sivid::interval_traits<interval>;
constexpr std::size_t native = sivid::pack<8>::vector::lanes;

std::string text(char const* what, interval const& a, interval const& b, interval const& got,
                 interval const& expected) {
    char line[400];
    std::snprintf(line, sizeof line, "%s of [%a, %a], [%a, %a] is [%a, %a] instead of [%a, %a]",
                  what, a.lower(), a.upper(), b.lower(), b.upper(), got.lower(), got.upper(),
                  expected.lower(), expected.upper());
    return line;
}
bool same(double a, double b) { return a == b || (a != a && b != b); }
bool same(interval const& a, interval const& b) {
    return same(a.lower(), b.lower()) && same(a.upper(), b.upper());
}

/// An interval that hurts: any shape, zeros, infinities, empty.
interval draw(oracle::inputs& in) {
    double const special[] = {0.0,
                              -0.0,
                              1.0,
                              -1.0,
                              0x1p-1074,
                              -0x1p-1074,
                              0x1p-1022,
                              0x1.fffffffffffffp+1023,
                              -0x1.fffffffffffffp+1023,
                              2.0,
                              0x1p511,
                              0x1p-537,
                              0x1.8p-520,
                              0x1.fffffffffffffp-1};
    auto const end = [&] {
        return in.below(4) == 0 ? special[in.below(std::size(special))] : in.mixed();
    };
    double const infinity = std::numeric_limits<double>::infinity();
    double a = end(), b = in.below(3) == 0 ? a : end();
    if (b < a) std::swap(a, b);
    switch (in.below(24)) {
    case 0:
        return vocabulary::empty();
    case 1:
        return vocabulary::entire();
    case 2:
        return vocabulary::bounds(-infinity, b);
    case 3:
        return vocabulary::bounds(a, infinity);
    case 4:
        return vocabulary::bounds(0.0, b < 0.0 ? -b : b);
    case 5:
        return vocabulary::bounds(a > 0.0 ? -a : a, 0.0);
    default:
        return vocabulary::bounds(a, b);
    }
}

/// Every tight operation and every relation, bit for bit the vocabulary type's in every lane.
template <std::size_t W>
void same_as_vocabulary(outcome& o, std::uint64_t seed, int rounds) {
    using P = pack<W>;
    using t = sivid::interval_traits<P>;
    using v = vocabulary;
    oracle::inputs in{seed};
    std::array<interval, W> a, b, c;
    for (int round = 0; round < rounds; ++round) {
        P x, y, z;
        for (std::size_t i = 0; i < W; ++i) {
            x.set(i, a[i] = draw(in));
            y.set(i, b[i] = draw(in));
            z.set(i, c[i] = draw(in));
        }
        auto const results = [&](char const* what, P const& got, auto expected) {
            for (std::size_t i = 0; i < W; ++i, ++o.checks)
                if (interval const e = expected(i); !same(got[i], e) && o.failures.size() < 20)
                    o.failures.push_back(text(what, a[i], b[i], got[i], e));
        };
        auto const masks = [&](char const* what, std::uint64_t got, auto expected) {
            for (std::size_t i = 0; i < W; ++i, ++o.checks)
                if ((got >> i & 1u) != (expected(i) ? 1u : 0u) && o.failures.size() < 20)
                    o.failures.push_back(text(what, a[i], b[i], {}, {}) + " (mask)");
            if ((got & ~t::all_lanes) != 0)
                o.failures.push_back(std::string{what} + ": lanes beyond W");
        };
        std::uint64_t cut = 0;
        auto const cuts = [&](auto f) {
            return [=](std::size_t i) {
                bool flag = false;
                f(i, flag);
                return flag;
            };
        };
        results("neg", t::neg(x), [&](std::size_t i) { return v::neg(a[i]); });
        results("add", t::add(x, y), [&](std::size_t i) { return v::add(a[i], b[i]); });
        results("sub", t::sub(x, y), [&](std::size_t i) { return v::sub(a[i], b[i]); });
        results("mul", t::mul(x, y), [&](std::size_t i) { return v::mul(a[i], b[i]); });
        results("sqr", t::sqr(x), [&](std::size_t i) { return v::sqr(a[i]); });
        results("abs", t::abs(x), [&](std::size_t i) { return v::abs(a[i]); });
        results("min", t::min(x, y), [&](std::size_t i) { return v::min(a[i], b[i]); });
        results("max", t::max(x, y), [&](std::size_t i) { return v::max(a[i], b[i]); });
        results("hull", t::hull(x, y), [&](std::size_t i) { return v::hull(a[i], b[i]); });
        results("intersect", t::intersect(x, y),
                [&](std::size_t i) { return v::intersect(a[i], b[i]); });
        results("sign", t::sign(x), [&](std::size_t i) { return v::sign(a[i]); });
        bool ignored = false;
        results("div", t::div(x, y, cut),
                [&](std::size_t i) { return v::div(a[i], b[i], ignored); });
        masks("div", cut, cuts([&](std::size_t i, bool& flag) { v::div(a[i], b[i], flag); }));
        cut = 0;
        results("sqrt", t::sqrt(x, cut), [&](std::size_t i) { return v::sqrt(a[i], ignored); });
        masks("sqrt", cut, cuts([&](std::size_t i, bool& flag) { v::sqrt(a[i], flag); }));
        cut = 0;
        results("pown 1", t::pown(x, 1, cut), [&](std::size_t i) { return a[i]; });
        results("pown 2", t::pown(x, 2, cut), [&](std::size_t i) { return v::sqr(a[i]); });
        masks("pown 2", cut, [](std::size_t) { return false; });
        results("pown -1", t::pown(x, -1, cut),
                [&](std::size_t i) { return v::div(v::point(1.0), a[i], ignored); });
        masks("pown -1", cut, cuts([&](std::size_t i, bool& flag) { v::pown(a[i], -1, flag); }));
        for (auto const& [name, f, g] :
             {std::tuple{"log cut", &t::log, &v::log}, {"tan cut", &t::tan, &v::tan}}) {
            cut = 0;
            P const got = f(x, cut);
            auto const exact = g;
            masks(name, cut, cuts([&](std::size_t i, bool& flag) { exact(a[i], flag); }));
            for (std::size_t i = 0; i < W; ++i)
                if (interval const e = exact(a[i], ignored); v::is_empty(e) != v::is_empty(got[i]))
                    o.failures.push_back(text(name, a[i], b[i], got[i], e));
        }
        masks("is_empty", t::is_empty(x), [&](std::size_t i) { return v::is_empty(a[i]); });
        masks("is_point", t::is_point(x), [&](std::size_t i) { return v::is_point(a[i]); });
        masks("subset", t::subset(x, y), [&](std::size_t i) { return v::subset(a[i], b[i]); });
        masks("interior", t::interior(x, y),
              [&](std::size_t i) { return v::interior(a[i], b[i]); });
        masks("disjoint", t::disjoint(x, y),
              [&](std::size_t i) { return v::disjoint(a[i], b[i]); });
        double const number = in.mixed();
        masks("contains", t::contains(x, number),
              [&](std::size_t i) { return v::contains(a[i], number); });
        P const e[] = {t::exp(x), t::sin(x), t::cos(x), t::atan(x), t::tanh(x)};
        for (P const& f : e)
            masks("empty stays empty", t::is_empty(f),
                  [&](std::size_t i) { return v::is_empty(a[i]); });
    }
}

void note(outcome& o, laws::misses const& m, std::string const& where) {
    o.checks += m.inputs;
    if (m.count != 0)
        o.failures.push_back(where + ": " + std::to_string(m.count) + " misses: " + m.first);
}

template <class P>
void vectors(outcome& o) {
    for (char const* name : {"itf1788.txt", "mpfi_elem.txt"}) {
        auto const lines =
            conformance::read_vectors(std::string{SIVID_SOURCE_DIR "/tests/data/vectors/"} + name);
        conformance::report r;
        conformance::run_vectors<P>(lines, r);
        o.checks += r.run;
        for (auto const& line : r.unsound) o.failures.push_back("unsound vector: " + line);
        for (auto const& line : r.loose) o.failures.push_back("vector not tight: " + line);
    }
}

/// Arithmetic and functions while the thread rounds in some direction.
template <std::size_t W>
void in_mode(outcome& o, int mode, std::string const& name) {
    using P = pack<W>;
    using t = sivid::interval_traits<P>;
    using mask = typename t::mask;
    auto const while_set = [mode](auto f) {
        return [mode, f](auto const&... x) {
            std::fesetround(mode);
            auto y = f(x...);
            if (std::fegetround() != mode) y = t::empty();
            std::fesetround(FE_TONEAREST);
            return y;
        };
    };
    constexpr std::size_t n = 2000;
    auto const unary = [&](char const* what, oracle::unary exact, auto f) {
        note(o, laws::contained<P>(what, n, 5, exact, while_set(f)), name);
    };
    auto const binary = [&](char const* what, oracle::binary exact, auto f) {
        note(o, laws::contained<P>(what, 4 * n, 6, exact, while_set(f)), name);
    };
    binary("add", mpfr_add, [](P const& x, P const& y) { return t::add(x, y); });
    binary("sub", mpfr_sub, [](P const& x, P const& y) { return t::sub(x, y); });
    binary("mul", mpfr_mul, [](P const& x, P const& y) { return t::mul(x, y); });
    binary("div", mpfr_div, [](P const& x, P const& y) {
        mask m{};
        return t::div(x, y, m);
    });
    unary("sqrt", mpfr_sqrt, [](P const& x) {
        mask m{};
        return t::sqrt(x, m);
    });
    unary("sqr", mpfr_sqr, [](P const& x) { return t::sqr(x); });
    unary("exp", mpfr_exp, [](P const& x) { return t::exp(x); });
    unary("log", mpfr_log, [](P const& x) {
        mask m{};
        return t::log(x, m);
    });
    unary("sin", mpfr_sin, [](P const& x) { return t::sin(x); });
    unary("cos", mpfr_cos, [](P const& x) { return t::cos(x); });
    unary("tan", mpfr_tan, [](P const& x) {
        mask m{};
        return t::tan(x, m);
    });
    unary("atan", mpfr_atan, [](P const& x) { return t::atan(x); });
    unary("tanh", mpfr_tanh, [](P const& x) { return t::tanh(x); });
}

template <std::size_t W>
void check_width(outcome& o) {
    std::string const name = "pack<" + std::to_string(W) + ">";
    same_as_vocabulary<W>(o, 11 + W, 2000);
    for (auto const& m : laws::all_contained<pack<W>>(4000, 100 + W)) note(o, m, name);
    for (auto const& failure : laws::all<pack<W>>(500, 7))
        o.failures.push_back(name + ": " + failure);
    vectors<pack<W>>(o);
    check_kernels<typename pack<W>::vector>(o.checks, o.failures);
    shapes::tally t;
    oracle::inputs in{7};
    for (int mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        if (mode != FE_TONEAREST)
            in_mode<W>(o, mode, name + " in rounding mode " + std::to_string(mode));
        for (int i = 0; mode == FE_TONEAREST && i < 20'000; ++i)
            shapes::every_shape<shapes::by_traits<pack<W>>>(t, in);
    }
    o.checks += t.run;
    if (t.missed != 0)
        o.failures.push_back(name + ": " + std::to_string(t.missed) + " code shapes missed");
}

} // namespace

outcome check_all() {
    outcome o;
    if (!sivid::pack_supported()) o.failures.emplace_back("pack_supported() is false");
    check_width<native>(o);
    if constexpr (native > 4) check_width<4>(o); // narrower vectors in a build for wider ones
    if constexpr (native > 2) check_width<2>(o);
    if constexpr (native > 1) check_width<1>(o);
    same_as_vocabulary<2 * native>(o, 3, 500);
    same_as_vocabulary<3>(o, 4, 500);
    return o;
}

fingerprint arithmetic_bits() {
    fingerprint bits;
    oracle::inputs in{99};
    using P = pack<8>;
    for (int i = 0; i < 200; ++i) {
        P x, y;
        for (std::size_t k = 0; k < 8; ++k) {
            x.set(k, draw(in));
            y.set(k, draw(in));
        }
        for (P const& z : {x + y, x - y, x * y, x / y, sqr(x), sqrt(x), min(x, y), hull(x, y)})
            for (std::size_t k = 0; k < 8; ++k)
                for (double b : {z.lower(k), z.upper(k)}) // one zero, one NaN
                    bits.push_back(b != b ? 1 : b == 0.0 ? 0 : std::bit_cast<std::uint64_t>(b));
    }
    return bits;
}

} // namespace backends::SIVID_PACK_TARGET
