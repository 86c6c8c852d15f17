// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_TRAITS_HPP
#define SIVID_NUMBER_PACK_TRAITS_HPP

/// @file
/// `interval_traits` of packs: those of the vocabulary type in every lane. Masks and relations have
/// one bit for each lane, lane 0 the lowest.

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/pack.hpp>
#include <sivid/number/pack/detail/pack_elementary.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace sivid {
inline namespace SIVID_PACK_TARGET {

/// What `interval_traits<pack<W>>` inherits.
template <std::size_t W>
struct pack_traits {
    using I = pack<W>;
    using mask = std::uint64_t;
    static constexpr std::size_t lanes = W;
    static constexpr mask all_lanes = ~mask{0} >> (64 - W);

    // Making.
    static I point(double t) noexcept { return I{scalar::point(t)}; }
    static I bounds(double lo, double hi) noexcept { return I{scalar::bounds(lo, hi)}; }
    static I empty() noexcept { return I{scalar::empty()}; }
    static I entire() noexcept { return I{scalar::entire()}; }

    /// Lane i is [lo(i), hi(i)]; empty where that is no interval.
    template <class Lower, class Upper>
    static I from_lanes(Lower const& lo, Upper const& hi) noexcept {
        std::array<double, W> l, h;
        for (std::size_t i = 0; i < W; ++i) {
            l[i] = lo(i);
            h[i] = hi(i);
        }
        return I::load(l.data(), h.data());
    }

    // Reading a lane.
    static double lower(I const& a, std::size_t lane = 0) noexcept { return a.lower(lane); }
    static double upper(I const& a, std::size_t lane = 0) noexcept { return a.upper(lane); }
    static double mid(I const& a, std::size_t lane = 0) noexcept { return scalar::mid(a[lane]); }
    static double rad(I const& a, std::size_t lane = 0) noexcept { return scalar::rad(a[lane]); }
    static double width(I const& a, std::size_t lane = 0) noexcept {
        return scalar::width(a[lane]);
    }
    static double mag(I const& a, std::size_t lane = 0) noexcept { return scalar::mag(a[lane]); }
    static double mig(I const& a, std::size_t lane = 0) noexcept { return scalar::mig(a[lane]); }

    // Relations. The empty set is a subset of, interior to and disjoint from everything.
    static mask is_empty(I const& a) noexcept {
        return ask([](part const& x) { return simd::is_empty(x); }, a);
    }
    static mask is_point(I const& a) noexcept {
        return ask([](part const& x) { return x.lo == x.hi; }, a);
    }
    static mask contains(I const& a, double t) noexcept {
        if (!(t > -simd::infinity && t < simd::infinity)) return 0;
        return ask([t](part const& x) { return (x.lo <= V(t)) & (V(t) <= x.hi); }, a);
    }
    static mask subset(I const& a, I const& b) noexcept {
        return ask(
            [](part const& x, part const& y) {
                return simd::is_empty(x) | ((y.lo <= x.lo) & (x.hi <= y.hi));
            },
            a, b);
    }
    static mask interior(I const& a, I const& b) noexcept {
        return ask(
            [](part const& x, part const& y) {
                auto const below = (y.lo < x.lo) | (y.lo == V(-simd::infinity));
                auto const above = (x.hi < y.hi) | (y.hi == V(simd::infinity));
                return simd::is_empty(x) | (below & above);
            },
            a, b);
    }
    static mask disjoint(I const& a, I const& b) noexcept {
        return ask(
            [](part const& x, part const& y) {
                return simd::either_empty(x, y) | (x.hi < y.lo) | (y.hi < x.lo);
            },
            a, b);
    }
    static I hull(I const& a, I const& b) noexcept { return map<simd::hull<V>>(a, b); }
    static I intersect(I const& a, I const& b) noexcept { return map<simd::intersect<V>>(a, b); }

    // Arithmetic: tight.
    static I neg(I const& a) noexcept { return map<simd::neg<V>>(a); }
    static I add(I const& a, I const& b) noexcept { return map<simd::add<V>>(a, b); }
    static I sub(I const& a, I const& b) noexcept { return map<simd::sub<V>>(a, b); }
    static I mul(I const& a, I const& b) noexcept { return map<simd::mul<V>>(a, b); }
    static I div(I const& a, I const& b, mask& undefined) noexcept {
        return flagged<simd::div<V>>(undefined, a, b);
    }
    static I sqr(I const& a) noexcept { return map<simd::sqr<V>>(a); }
    static I abs(I const& a) noexcept { return map<simd::abs<V>>(a); }
    static I min(I const& a, I const& b) noexcept { return map<simd::min<V>>(a, b); }
    static I max(I const& a, I const& b) noexcept { return map<simd::max<V>>(a, b); }
    static I sqrt(I const& a, mask& undefined) noexcept {
        return flagged<simd::sqrt<V>>(undefined, a);
    }
    /// By squaring: up to 2 log2 |n| roundings a side.
    static I pown(I const& a, int n, mask& undefined) noexcept {
        return flagged<simd::pown<V>>(undefined, a, n);
    }

    // Elementary functions: error bounds in docs/pack_functions.md.
    static I exp(I const& a) noexcept { return map<simd::exp<V>>(a); }
    static I log(I const& a, mask& undefined) noexcept {
        return flagged<simd::log<V>>(undefined, a);
    }
    static I sin(I const& a) noexcept { return map<simd::sin<V>>(a); }
    static I cos(I const& a) noexcept { return map<simd::cos<V>>(a); }
    static I tan(I const& a, mask& undefined) noexcept {
        return flagged<simd::tan<V>>(undefined, a);
    }
    static I atan(I const& a) noexcept { return map<simd::atan<V>>(a); }
    static I tanh(I const& a) noexcept { return map<simd::tanh<V>>(a); }

    static I sign(I const& a) noexcept { return map<simd::sign<V>>(a); }

private:
    using scalar = interval_traits<interval>;
    using V = typename I::vector;
    using M = typename V::mask;
    using part = typename I::part;

    static part const& piece(I const& a, std::size_t p) noexcept { return a(p); }
    static int piece(int n, std::size_t) noexcept { return n; }

    template <auto Op, class... X>
    static I map(X const&... x) noexcept {
        return I::make([&](std::size_t p) { return Op(piece(x, p)...); });
    }
    template <auto Op, class... X>
    static I flagged(mask& undefined, X const&... x) noexcept {
        return I::make([&](std::size_t p) {
            M m{};
            part const y = Op(piece(x, p)..., m);
            undefined |= mask{m.bits()} << (p * V::lanes);
            return y;
        });
    }
    template <class Op, class... Packs>
    static mask ask(Op const& op, Packs const&... packs) noexcept {
        mask answer = 0;
        for (std::size_t p = 0; p < I::parts; ++p)
            answer |= mask{op(packs(p)...).bits()} << (p * V::lanes);
        return answer;
    }
};

} // namespace SIVID_PACK_TARGET

template <std::size_t W>
struct interval_traits<pack<W>> : pack_traits<W> {};

static_assert(interval_scalar<pack<1>> && interval_scalar<pack<8>>);

} // namespace sivid

#endif
