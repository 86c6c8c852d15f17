// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_DETAIL_PACK_ELEMENTARY_HPP
#define SIVID_NUMBER_PACK_DETAIL_PACK_ELEMENTARY_HPP

/// @file
/// Elementary functions of vectors of intervals: kernels at the ends, domains cut, empty lanes
/// kept. Lanes that a kernel does not serve (|x| > 2^20 of sin, cos, tan) go one by one through the
/// vocabulary type, with its excess.

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/pack/detail/pack_arctangent.hpp>
#include <sivid/number/pack/detail/pack_logarithm.hpp>
#include <sivid/number/pack/detail/pack_trigonometric.hpp>

#include <array>
#include <cstddef>

namespace sivid::simd {
inline namespace SIVID_PACK_TARGET {

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
[[nodiscard]] bounds<V> log(bounds<V> const& x, mask_of<V>& undefined) noexcept {
    return evaluate(
        x, undefined,
        [](V lo, V hi, mask_of<V>& left) {
            left = left | (lo <= V(0.0));
            return empty_where(hi <= V(0.0), bounds<V>{log_lower(lo), log_upper(hi)});
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
    return increasing<atan_lower<V>, atan_upper<V>>(
        x, [](interval const& t) { return sivid::atan(t); });
}

template <class V>
[[nodiscard]] bounds<V> tanh(bounds<V> const& x) noexcept {
    return increasing<tanh_lower<V>, tanh_upper<V>>(
        x, [](interval const& t) { return sivid::tanh(t); });
}

} // namespace SIVID_PACK_TARGET
} // namespace sivid::simd

#endif
