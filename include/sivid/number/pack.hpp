// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_PACK_HPP
#define SIVID_NUMBER_PACK_HPP

/// @file
/// The engine's number: W intervals side by side in vector registers, lower bounds and upper bounds
/// apart, every operation on all of them at once and without branches on data.
///
/// | compiled for         | W                                  | back end                     |
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

#include <sivid/number/interval.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/pack/detail/pack_avx2.hpp>
#include <sivid/number/pack/detail/pack_avx512.hpp>
#include <sivid/number/pack/detail/pack_elementary.hpp>
#include <sivid/number/pack/detail/pack_neon.hpp>
#include <sivid/number/pack/detail/pack_portable.hpp>
#include <sivid/number/pack/detail/pack_sse2.hpp>
#include <sivid/number/rounding/detail/refused_flags.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace sivid {
inline namespace SIVID_PACK_TARGET {

namespace simd_choice {

template <class V>
struct chosen {
    using type = V;
};
/// The widest vector that divides W.
template <std::size_t W>
[[nodiscard]] constexpr auto choose() noexcept {
    // NOLINTBEGIN(readability-misleading-indentation): one chain across the conditions
#if SIVID_PACK_AVX512
    if constexpr (W % 8 == 0)
        return chosen<simd::vector_avx512>{};
    else
#endif
#if SIVID_PACK_AVX2
        if constexpr (W % 4 == 0)
        return chosen<simd::vector_avx2>{};
    else
#endif
#if SIVID_MACHINE_X86_64
        if constexpr (W % 2 == 0)
        return chosen<simd::vector_sse2>{};
    else
#elif SIVID_MACHINE_ARM64
    if constexpr (W % 2 == 0)
        return chosen<simd::vector_neon>{};
    else
#endif
        return chosen<simd::vector_portable>{};
    // NOLINTEND(readability-misleading-indentation)
}

} // namespace simd_choice

/// W intervals. Empty lanes have NaN bounds. A default-made pack holds W times [0, 0].
/// @guarantee  trivially copyable; no allocation; all operations noexcept and thread safe
template <std::size_t W>
class pack {
    static_assert(W >= 1 && W <= 64, "a lane mask has 64 bits");

public:
    using vector = typename decltype(simd_choice::choose<W>())::type;
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

} // namespace SIVID_PACK_TARGET
} // namespace sivid

#endif
