// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_DETAIL_OWN_TURNS_HPP
#define SIVID_NUMBER_ELEMENTARY_DETAIL_OWN_TURNS_HPP

/// @file
/// Any double reduced modulo quarter turns, in integers: what the kernels of sin, cos and tan take
/// beyond their own limit.

#include <sivid/number/elementary/detail/wide_integer.hpp>
#include <sivid/number/rounding/detail/exact_rounding.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace sivid::detail::own {

/// 2/pi in words, the first below the point.
inline constexpr std::array<std::uint64_t, 20> two_by_pi{
    0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561,
    0xb7246e3a424dd2e0, 0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484,
    0xe99c7026b45f7e41, 0x3991d639835339f4, 0x9c845f8bbdf9283b, 0x1ff897ffde05980f,
    0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d, 0x7527bac7ebe5f17b,
    0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab, 0xf0cfbc209af4361d};

/// |x| = k pi/2 + (head + tail), k modulo 4. The sum is at most pi/4 in magnitude and in error by
/// less than 2^-68 of itself; |tail| <= 2^-53 |head|. A head of 0: not known (no double is so near
/// to a multiple of pi/2).
struct reduced_turns {
    unsigned k;
    double head, tail;
};

/// With |x| = m 2^e: the words of 2/pi before those that matter give multiples of four quarter
/// turns. From there on 320 bits are multiplied by m; at least 255 of the product lie below the
/// point, so what is cut off is below m 2^-255 < 2^-200 quarter turns. The fraction is taken to 192
/// bits, its first 128 from the leading one on (at least 121, if it starts late) are multiplied by
/// pi/2.
/// @given  2^20 <= |x| < infinity
[[nodiscard]] constexpr reduced_turns reduce_far(double x) noexcept {
    scaled_integer const a = significand_of(x);
    int const first = a.e >= 66 ? (a.e - 2) / 64 : 0; // words left out
    std::array<std::uint64_t, 6> p{};                 // the product, its lowest word first
    for (std::size_t i = 0; i < 5; ++i) {
        std::uint64_t const word = two_by_pi[static_cast<std::size_t>(first) + 4 - i];
        two_words const product = full_product(a.m, word) + two_words{0, p[i]};
        p[i] = product.low;
        p[i + 1] = product.high;
    }
    auto const bits_from = [&](int at) { // 64 of them
        auto const word = static_cast<std::size_t>(at / 64);
        int const shift = at % 64;
        std::uint64_t const upper = word < 5 ? p[word + 1] : 0;
        return shift == 0 ? p[word] : p[word] >> shift | upper << (64 - shift);
    };
    int const point = 320 + 64 * first - a.e;
    auto k = static_cast<unsigned>(bits_from(point) & 3u);
    std::uint64_t f0 = bits_from(point - 64), f1 = bits_from(point - 128),
                  f2 = bits_from(point - 192);
    bool const negative = f0 >> 63 != 0; // the rest is counted back from the next quarter turn
    if (negative) {
        k = (k + 1) & 3u;
        f0 = ~f0; // one unit of the last place less than the difference
        f1 = ~f1;
        f2 = ~f2;
    }
    if (f0 == 0 && f1 < 128) return {k, 0.0, 0.0};
    int zeros = f0 == 0 ? 64 : std::countl_zero(f0);
    two_words fraction{f0, f1};
    if (zeros == 64)
        fraction = {f1, f2};
    else if (zeros > 0)
        fraction = {f0 << zeros | f1 >> (64 - zeros), f1 << zeros | f2 >> (64 - zeros)};
    constexpr two_words half_pi{0xc90f'daa2'2168'c234, 0xc4c6'628b'80dc'1cd1}; // 2^-127
    two_words const product = high_product(fraction, half_pi);                 // 2^(-127 - zeros)
    int const more = leading_zeros(product);
    two_words const h = product << more;
    int const exponent = -127 - zeros - more;
    // The head is rounded to nearest, the rest has a sign.
    bool const rounds_up = (h.high >> 10 & 1u) != 0;
    std::uint64_t const kept = (h.high >> 11) + (rounds_up ? 1u : 0u);
    two_words const off =
        rounds_up ? (two_words{0, kept} << 75) - h : h - (two_words{0, kept} << 75);
    double const head = rounded<direction::nearest>(negative, {kept, exponent + 75, false});
    if (off == two_words{}) return {k, head, 0.0};
    int const n = leading_zeros(off);
    return {k, head,
            rounded<direction::nearest>(negative != rounds_up,
                                        {(off << n).high, exponent + 64 - n, false})};
}

} // namespace sivid::detail::own

#endif
