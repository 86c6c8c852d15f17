// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_ELEMENTARY_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_ELEMENTARY_HPP

/// @file
/// Elementary functions of vectors of intervals: kernels at the ends, domains cut, empty lanes
/// kept. Lanes that a kernel does not serve (|x| > 2^20 of sin, cos, tan), and pow, atan2 and the
/// inverse hyperbolic functions, go one by one through the vocabulary type, with its excess.

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/pack/detail/pack_arctangent.hpp>
#include <sivid/number/pack/detail/pack_logarithm.hpp>
#include <sivid/number/pack/detail/pack_trigonometric.hpp>

#include <array>
#include <cstddef>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

template <class V>
[[nodiscard]] interval lane_of(std::array<double, V::lanes> const& lo,
                               std::array<double, V::lanes> const& hi, std::size_t i) noexcept {
    return interval_traits<interval>::bounds(lo[i], hi[i]);
}

/// y with f(x...) in the lanes of `which`; f sets its last argument where it is not defined.
template <class V, class F, class... X>
[[nodiscard]] bounds<V> replace_lanes(bounds<V> const& y, unsigned which, mask_of<V>& undefined,
                                      F const& f, X... x) noexcept {
    std::array<double, V::lanes> lo, hi, flag{};
    y.lo.store(lo.data());
    y.hi.store(hi.data());
    std::array<std::array<std::array<double, V::lanes>, 2>, sizeof...(X)> in;
    std::size_t n = 0;
    ((x.lo.store(in[n][0].data()), x.hi.store(in[n][1].data()), ++n), ...);
    for (std::size_t i = 0; i < V::lanes; ++i) {
        if ((which >> i & 1u) == 0) continue;
        bool cut = false;
        interval z;
        if constexpr (sizeof...(X) == 1)
            z = f(lane_of<V>(in[0][0], in[0][1], i), cut);
        else
            z = f(lane_of<V>(in[0][0], in[0][1], i), lane_of<V>(in[1][0], in[1][1], i), cut);
        lo[i] = z.lower();
        hi[i] = z.upper();
        flag[i] = cut ? 1.0 : 0.0;
    }
    undefined = undefined | (V::load(flag.data()) > V(0.0));
    return {V::load(lo.data()), V::load(hi.data())};
}
template <class V, class F, class... X>
[[nodiscard]] bounds<V> lane_by_lane(mask_of<V>& undefined, F const& f, X... x) noexcept {
    return replace_lanes(constant<V>(0.0, 0.0), ~0u, undefined, f, x...);
}

/// The same numbers, in registers: a kernel's operations stay between here and there, whatever the
/// mode is elsewhere, and nothing that points to them is handed on. g++ 12 with -flto drops what is
/// stored to an argument that is handed over by reference when the callee only passes members of it
/// on, by value, to a function found to be without side effects while linking (its summary of
/// memory accesses skips those calls; tests/regression/link_time_optimisation.cpp).
template <class V>
[[nodiscard, gnu::always_inline]] inline bounds<V> in_registers(bounds<V> const& x) noexcept {
#if defined(SIVID_REGISTER)
    auto lo = x.lo.raw(), hi = x.hi.raw();
    if constexpr (!V::keeps_own_mode)
        __asm__ volatile("" : SIVID_REGISTER(lo), SIVID_REGISTER(hi));
    else
        __asm__("" : SIVID_REGISTER(lo), SIVID_REGISTER(hi));
    return {V(lo), V(hi)};
#else
    return {V(detail::pinned(x.lo.raw())), V(detail::pinned(x.hi.raw()))};
#endif
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
        return lane_by_lane<V>(undefined, f, x);
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

/// An increasing function from its kernels at the two ends, of which `f` is that of intervals.
template <auto Lower, auto Upper, class V, class F>
[[nodiscard]] bounds<V> increasing(bounds<V> const& x, F const& f) noexcept {
    return evaluate(
        x,
        [](V lo, V hi) {
            return bounds<V>{Lower(lo), Upper(hi)};
        },
        f);
}
template <class V>
[[nodiscard]] bounds<V> exp(bounds<V> const& x) noexcept {
    return increasing<exp_lower<V>, exp_upper<V>>(x,
                                                  [](interval const& t) { return sivid::exp(t); });
}
template <class V>
[[nodiscard]] bounds<V> expm1(bounds<V> const& x) noexcept {
    return increasing<expm1_lower<V>, expm1_upper<V>>(
        x, [](interval const& t) { return sivid::expm1(t); });
}
/// The same on ]pole, inf[.
template <auto Lower, auto Upper, class V, class F>
[[nodiscard]] bounds<V> increasing_above(double pole, bounds<V> const& x, mask_of<V>& undefined,
                                         F const& f) noexcept {
    return evaluate(
        x, undefined,
        [&](V lo, V hi, mask_of<V>& left) {
            left = left | (lo <= V(pole));
            return empty_where(hi <= V(pole), bounds<V>{Lower(lo), Upper(hi)});
        },
        f);
}
template <class V>
[[nodiscard]] bounds<V> log(bounds<V> const& x, mask_of<V>& undefined) noexcept {
    return increasing_above<log_lower<V>, log_upper<V>>(
        0.0, x, undefined, [](interval const& t, bool& cut) { return sivid::log(t, cut); });
}
template <class V>
[[nodiscard]] bounds<V> log1p(bounds<V> const& x, mask_of<V>& undefined) noexcept {
    return increasing_above<log1p_lower<V>, log1p_upper<V>>(
        -1.0, x, undefined, [](interval const& t, bool& cut) { return sivid::log1p(t, cut); });
}

/// y, with f in the lanes that have an end beyond the limit of the trigonometric kernels.
template <class V, class F>
[[nodiscard]] bounds<V> replace_beyond_limit(bounds<V> const& y, bounds<V> const& x,
                                             mask_of<V>& undefined, F const& f) noexcept {
    unsigned const far = (mag(x) > V(trigonometric_limit)).bits();
    if (far == 0) [[likely]]
        return y;
    return replace_lanes(y, far, undefined, f, x);
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
    return increasing<atan_lower<V>, atan_upper<V>>(
        x, [](interval const& t) { return sivid::atan(t); });
}

/// kernel(lo, hi) with the ends of x cut to [-1, 1]; f is the function of intervals.
template <class V, class Kernel, class F>
[[nodiscard]] bounds<V> within_unit(bounds<V> const& x, mask_of<V>& undefined, Kernel const& kernel,
                                    F const& f) noexcept {
    return evaluate(
        x, undefined,
        [&](V lo, V hi, mask_of<V>& left) {
            V const one(1.0);
            left = left | (lo < -one) | (hi > one);
            return empty_where((lo > one) | (hi < -one), kernel(max(-one, lo), min(one, hi)));
        },
        f);
}
template <class V>
[[nodiscard]] bounds<V> asin(bounds<V> const& x, mask_of<V>& undefined) noexcept {
    return within_unit(
        x, undefined,
        [](V lo, V hi) {
            return bounds<V>{asin_lower(lo), asin_upper(hi)};
        },
        [](interval const& t, bool& cut) { return sivid::asin(t, cut); });
}
template <class V>
[[nodiscard]] bounds<V> acos(bounds<V> const& x, mask_of<V>& undefined) noexcept {
    return within_unit(
        x, undefined,
        [](V lo, V hi) {
            return bounds<V>{acos_lower(hi), acos_upper(lo)};
        },
        [](interval const& t, bool& cut) { return sivid::acos(t, cut); });
}

template <class V>
[[nodiscard]] bounds<V> sinh(bounds<V> const& x) noexcept {
    return increasing<sinh_lower<V>, sinh_upper<V>>(
        x, [](interval const& t) { return sivid::sinh(t); });
}
template <class V>
[[nodiscard]] bounds<V> cosh(bounds<V> const& x) noexcept {
    return evaluate(
        x,
        [](V lo, V hi) {
            bounds<V> const t{lo, hi};
            return bounds<V>{cosh_lower(mig(t)), cosh_upper(mag(t))};
        },
        [](interval const& t) { return sivid::cosh(t); });
}
template <class V>
[[nodiscard]] bounds<V> tanh(bounds<V> const& x) noexcept {
    return increasing<tanh_lower<V>, tanh_upper<V>>(
        x, [](interval const& t) { return sivid::tanh(t); });
}

template <class V>
[[nodiscard]] bounds<V> asinh(bounds<V> const& x) noexcept {
    mask_of<V> ignored{};
    return lane_by_lane<V>(
        ignored, [](interval const& t, bool&) { return sivid::asinh(t); }, x);
}
template <class V>
[[nodiscard]] bounds<V> acosh(bounds<V> const& x, mask_of<V>& undefined) noexcept {
    return lane_by_lane<V>(
        undefined, [](interval const& t, bool& cut) { return sivid::acosh(t, cut); }, x);
}
template <class V>
[[nodiscard]] bounds<V> atanh(bounds<V> const& x, mask_of<V>& undefined) noexcept {
    return lane_by_lane<V>(
        undefined, [](interval const& t, bool& cut) { return sivid::atanh(t, cut); }, x);
}
template <class V>
[[nodiscard]] bounds<V> pow(bounds<V> const& x, bounds<V> const& y,
                            mask_of<V>& undefined) noexcept {
    return lane_by_lane<V>(
        undefined,
        [](interval const& s, interval const& t, bool& cut) { return sivid::pow(s, t, cut); }, x,
        y);
}
template <class V>
[[nodiscard]] bounds<V> atan2(bounds<V> const& y, bounds<V> const& x,
                              mask_of<V>& undefined) noexcept {
    return lane_by_lane<V>(
        undefined,
        [](interval const& s, interval const& t, bool& cut) { return sivid::atan2(s, t, cut); }, y,
        x);
}

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif
