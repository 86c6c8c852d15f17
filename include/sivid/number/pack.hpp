// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_HPP
#define SIVID_NUMBER_PACK_HPP

/// @file
/// W intervals side by side in vector registers, lower bounds and upper bounds apart, every
/// operation on all of them at once and without branches on data; and their `interval_traits`.
///
/// | compiled for         | W                                  | bounds                       |
/// |----------------------|------------------------------------|------------------------------|
/// | AVX-512 F and DQ     | 8, 16, ...                         | embedded rounding            |
/// | AVX2 and FMA         | 4, 12, ... (8, 16 without AVX-512) | nearest and exact residuals  |
/// | every x86-64, ARM64  | 2, 6, ...                          | the same, 2 lanes at a time  |
/// | any machine          | odd; all that remain               | the same in plain C++        |
///
/// No operation sets the rounding mode. Arithmetic proves its bounds in whichever mode the thread
/// is. Elementary functions do so with embedded rounding; elsewhere they need round-to-nearest,
/// look at the mode, and take the slow way through the vocabulary type in any other, as under FTZ
/// or DAZ. Arithmetic (with sqr, sqrt, pown, hypot), and all that AVX-512 does, needs these two
/// off: `require_sound_environment` rejects them at the entry of a solver.

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/pack/detail/pack_arithmetic.hpp>
#include <sivid/number/pack/detail/pack_kernels.hpp>
#include <sivid/number/rounding/detail/machine.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

/// Lanes of the widest vector that divides w.
[[nodiscard]] constexpr std::size_t widest(std::size_t w) noexcept {
    std::size_t n = lanes_detail::per_vector;
    while (w % n != 0) n /= 2;
    return n;
}

// Elementary functions of vectors of intervals: kernels at the ends, domains cut, empty lanes kept.
// Lanes that a kernel does not serve (|x| > 2^20 of sin, cos, tan) go one by one through the
// vocabulary type.

/// y with f(x) in the lanes of `which`; f sets its last argument where it is not defined.
template <class V, class F>
[[nodiscard]] bounds<V> replace_lanes(bounds<V> const& y, unsigned which, bounds<V> const& x,
                                      mask_of<V>& undefined, F const& f) noexcept {
    std::array<double, V::lanes> lo, hi, flag{}, from, to;
    y.lo.store(lo.data());
    y.hi.store(hi.data());
    x.lo.store(from.data());
    x.hi.store(to.data());
    for (std::size_t i = 0; i < V::lanes; ++i) {
        if ((which >> i & 1u) == 0) continue;
        bool cut = false;
        interval const z = f(interval_traits<interval>::bounds(from[i], to[i]), cut);
        lo[i] = z.lower();
        hi[i] = z.upper();
        flag[i] = cut ? 1.0 : 0.0;
    }
    undefined = undefined | (V::load(flag.data()) > V(0.0));
    return {V::load(lo.data()), V::load(hi.data())};
}

/// The same numbers, in registers: a kernel's operations stay between here and there, whatever the
/// mode is elsewhere, and nothing that points to them is handed on. g++ 12 with -flto drops what is
/// stored to an argument that is handed over by reference when the callee only passes members of it
/// on, by value, to a function found to be without side effects while linking (its summary of
/// memory accesses skips those calls; tests/regression/link_time_optimisation.cpp).
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> in_registers(bounds<V> const& x) noexcept {
    return {kept(x.lo), kept(x.hi)};
}

/// Whether the kernels prove their bounds in the state that the thread is in: rounding is to
/// nearest and subnormals are kept. Back ends with embedded rounding do not ask: reading MXCSR
/// waits for all operations before, which would cost half of exp. FTZ and DAZ are the guard's
/// there.
template <class V>
[[nodiscard]] bool kernels_hold() noexcept {
    return V::keeps_own_mode || detail::control_is_plain();
}

/// kernel(x.lo, x.hi, undefined) where the kernels hold; else lane by lane through the vocabulary
/// type, which sets its own mode. Comparisons belong into the kernel: under DAZ a subnormal number
/// equals zero.
template <class V, class Kernel, class F>
[[nodiscard]] bounds<V> evaluate(bounds<V> const& x, mask_of<V>& undefined, Kernel const& kernel,
                                 F const& f) noexcept {
    if (!kernels_hold<V>()) [[unlikely]]
        return replace_lanes(constant<V>(0.0, 0.0), ~0u, x, undefined, f);
    bounds<V> const t = in_registers(x);
    return in_registers(kernel(t.lo, t.hi, undefined));
}
/// The same for functions that are defined everywhere.
template <class V, class Kernel, class F>
[[nodiscard]] bounds<V> evaluate(bounds<V> const& x, Kernel const& kernel, F const& f) noexcept {
    mask_of<V> ignored{};
    return evaluate(
        x, ignored, [&](V lo, V hi, mask_of<V>&) { return kernel(lo, hi); },
        [&](interval const& t, bool&) { return f(t); });
}

/// An increasing function from its bounds at the two ends, of which `f` is that of intervals.
template <class Bounds, class V, class F>
[[nodiscard]] bounds<V> increasing(bounds<V> const& x, F const& f) noexcept {
    return evaluate(
        x,
        [](V lo, V hi) {
            return bounds<V>{Bounds::template at<downward>(lo), Bounds::template at<upward>(hi)};
        },
        f);
}
template <class V>
[[nodiscard]] bounds<V> exp(bounds<V> const& x) noexcept {
    return increasing<exp_bounds>(x, [](interval const& t) { return sivid::exp(t); });
}
template <class V>
[[nodiscard]] bounds<V> log(bounds<V> const& x, mask_of<V>& undefined) noexcept {
    return evaluate(
        x, undefined,
        [](V lo, V hi, mask_of<V>& left) {
            left = left | (lo <= V(0.0));
            return empty_where(hi <= V(0.0),
                               bounds<V>{log_bounds::at<downward>(lo), log_bounds::at<upward>(hi)});
        },
        [](interval const& t, bool& cut) { return sivid::log(t, cut); });
}

/// y, with f in the lanes that have an end beyond the limit of the trigonometric kernels.
template <class V, class F>
[[nodiscard]] bounds<V> replace_beyond_limit(bounds<V> const& y, bounds<V> const& x,
                                             mask_of<V>& undefined, F const& f) noexcept {
    unsigned const far = (mag(x) > V(trigonometric_limit)).bits();
    if (far == 0) [[likely]]
        return y;
    return replace_lanes(y, far, x, undefined, f);
}
/// sin or cos from their kernel.
template <auto Kernel, class V, class F>
[[nodiscard]] bounds<V> wave(bounds<V> const& x, F const& f) noexcept {
    mask_of<V> ignored{};
    return evaluate(
        x, ignored,
        [&](V lo, V hi, mask_of<V>& left) {
            return replace_beyond_limit(Kernel(lo, hi), bounds<V>{lo, hi}, left, f);
        },
        f);
}
template <class V>
[[nodiscard]] bounds<V> sin(bounds<V> const& x) noexcept {
    return wave<sin_within_limit<V>>(x, [](interval const& t, bool&) { return sivid::sin(t); });
}
template <class V>
[[nodiscard]] bounds<V> cos(bounds<V> const& x) noexcept {
    return wave<cos_within_limit<V>>(x, [](interval const& t, bool&) { return sivid::cos(t); });
}
template <class V>
[[nodiscard]] bounds<V> tan(bounds<V> const& x, mask_of<V>& undefined) noexcept {
    auto const f = [](interval const& t, bool& cut) { return sivid::tan(t, cut); };
    return evaluate(
        x, undefined,
        [&](V lo, V hi, mask_of<V>& left) {
            bounds<V> const t{lo, hi}, y = tan_within_limit(lo, hi);
            left = left | ((y.lo == V(-infinity)) & !(mag(t) > V(trigonometric_limit)));
            return replace_beyond_limit(y, t, left, f);
        },
        f);
}

template <class V>
[[nodiscard]] bounds<V> atan(bounds<V> const& x) noexcept {
    return increasing<atan_bounds>(x, [](interval const& t) { return sivid::atan(t); });
}

template <class V>
[[nodiscard]] bounds<V> tanh(bounds<V> const& x) noexcept {
    return increasing<tanh_bounds>(x, [](interval const& t) { return sivid::tanh(t); });
}

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

namespace sivid {
inline namespace SIVID_PACK_TARGET {

/// W intervals. Empty lanes have NaN bounds. A default-made pack holds W times [0, 0].
/// @guarantee  trivially copyable; no allocation; all operations noexcept and thread safe
template <std::size_t W>
class pack {
    static_assert(W >= 1 && W <= 64, "a lane mask has 64 bits");

public:
    using vector = simd::vector<simd::widest(W)>;
    using part = simd::bounds<vector>;
    static constexpr std::size_t lanes = W;
    static constexpr std::size_t parts = W / vector::lanes;

    pack() = default;
    /// x in every lane.
    explicit pack(interval const& x) noexcept {
        parts_.fill(part{vector(x.lower()), vector(x.upper())});
    }

    /// Lanes lo[0], ..., lo[W-1]; NaN or lo > hi gives an empty lane.
    [[nodiscard]] static pack load(double const* lo, double const* hi) noexcept {
        return make([&](std::size_t p) {
            part const x{vector::load(lo + p * vector::lanes),
                         vector::load(hi + p * vector::lanes)};
            return empty_where(unordered(x.lo, x.hi) | (x.hi < x.lo), x);
        });
    }
    void store(double* lo, double* hi) const noexcept {
        for (std::size_t p = 0; p < parts; ++p) {
            parts_[p].lo.store(lo + p * vector::lanes);
            parts_[p].hi.store(hi + p * vector::lanes);
        }
    }
    [[nodiscard]] double lower(std::size_t lane) const noexcept {
        std::array<double, vector::lanes> t;
        parts_[lane / vector::lanes].lo.store(t.data());
        return t[lane % vector::lanes];
    }
    [[nodiscard]] double upper(std::size_t lane) const noexcept {
        std::array<double, vector::lanes> t;
        parts_[lane / vector::lanes].hi.store(t.data());
        return t[lane % vector::lanes];
    }
    [[nodiscard]] interval operator[](std::size_t lane) const noexcept {
        return interval_traits<interval>::bounds(lower(lane), upper(lane));
    }
    void set(std::size_t lane, interval const& x) noexcept {
        std::array<double, vector::lanes> lo, hi;
        part& p = parts_[lane / vector::lanes];
        p.lo.store(lo.data());
        p.hi.store(hi.data());
        lo[lane % vector::lanes] = x.lower();
        hi[lane % vector::lanes] = x.upper();
        p = {vector::load(lo.data()), vector::load(hi.data())};
    }

    /// The pack with f(p) as part p: how operations are made.
    template <class F>
    [[nodiscard]] static pack make(F const& f) noexcept {
        pack result;
        [&]<std::size_t... P>(std::index_sequence<P...>) { ((result.parts_[P] = f(P)), ...); }
        (std::make_index_sequence<parts>{});
        return result;
    }
    [[nodiscard]] part const& operator()(std::size_t p) const noexcept { return parts_[p]; }

private:
    std::array<part, parts> parts_{};
};

static_assert(std::is_trivially_copyable_v<pack<8>> && std::is_trivially_copyable_v<pack<1>>);

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

    // Elementary functions: error bounds in docs/theory/pack_functions.md.
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
