// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_DETAIL_WIDE_INTEGER_HPP
#define SIVID_NUMBER_ELEMENTARY_DETAIL_WIDE_INTEGER_HPP

/// @file
/// Integers of 128 bits in standard C++.

#include <bit>
#include <compare>
#include <concepts>
#include <cstdint>
#include <optional>

namespace sivid::detail {

/// Unsigned, modulo 2^128.
struct two_words {
    std::uint64_t high = 0, low = 0;

    friend constexpr bool operator==(two_words const&, two_words const&) = default;
    friend constexpr std::strong_ordering operator<=>(two_words const&, two_words const&) = default;
    friend constexpr two_words operator+(two_words a, two_words b) noexcept {
        std::uint64_t const sum = a.low + b.low;
        return {a.high + b.high + (sum < a.low ? 1u : 0u), sum};
    }
    friend constexpr two_words operator-(two_words a, two_words b) noexcept {
        return {a.high - b.high - (a.low < b.low ? 1u : 0u), a.low - b.low};
    }
    /// By 0 to 128 bits.
    friend constexpr two_words operator<<(two_words a, int n) noexcept {
        if (n == 0) return a;
        if (n >= 64) return {n == 128 ? 0 : a.low << (n - 64), 0};
        return {a.high << n | a.low >> (64 - n), a.low << n};
    }
    friend constexpr two_words operator>>(two_words a, int n) noexcept {
        if (n == 0) return a;
        if (n >= 64) return {0, n == 128 ? 0 : a.high >> (n - 64)};
        return {a.high >> n, a.low >> n | a.high << (64 - n)};
    }
};

[[nodiscard]] constexpr int leading_zeros(two_words a) noexcept {
    return a.high != 0 ? std::countl_zero(a.high) : 64 + std::countl_zero(a.low);
}

/// a b.
[[nodiscard]] constexpr two_words full_product(std::uint64_t a, std::uint64_t b) noexcept {
    constexpr std::uint64_t half = 0xffff'ffff;
    std::uint64_t const ll = (a & half) * (b & half), lh = (a & half) * (b >> 32),
                        hl = (a >> 32) * (b & half);
    std::uint64_t const middle = (ll >> 32) + (lh & half) + (hl & half);
    return {(a >> 32) * (b >> 32) + (lh >> 32) + (hl >> 32) + (middle >> 32),
            middle << 32 | (ll & half)};
}

/// floor(a b / 2^128).
[[nodiscard]] constexpr two_words high_product(two_words a, two_words b) noexcept {
    two_words const ll = full_product(a.low, b.low), lh = full_product(a.low, b.high),
                    hl = full_product(a.high, b.low);
    two_words const middle = two_words{0, ll.high} + two_words{0, lh.low} + two_words{0, hl.low};
    return full_product(a.high, b.high) + two_words{0, lh.high} + two_words{0, hl.high} +
           two_words{0, middle.high};
}

/// floor(a / d), d < 2^63.
[[nodiscard]] constexpr two_words quotient(two_words a, std::uint64_t d) noexcept {
    two_words q{a.high / d, 0};
    std::uint64_t rest = a.high % d;
    for (int i = 63; i >= 0; --i) {
        rest = rest << 1 | (a.low >> i & 1u);
        if (rest >= d) {
            rest -= d;
            q.low |= std::uint64_t{1} << i;
        }
    }
    return q;
}

/// Signed, in two's complement: what g++ and clang have as `__int128`, as far as sivid uses it.
class signed_two_words {
public:
    constexpr signed_two_words() = default;
    template <std::integral N>
    constexpr signed_two_words(N n) noexcept // NOLINT: as integers convert
        : bits_{n < N{} ? ~std::uint64_t{0} : 0, static_cast<std::uint64_t>(n)} {}

    friend constexpr bool operator==(signed_two_words const&, signed_two_words const&) = default;
    friend constexpr std::strong_ordering operator<=>(signed_two_words a,
                                                      signed_two_words b) noexcept {
        constexpr std::uint64_t sign = std::uint64_t{1} << 63;
        return two_words{a.bits_.high ^ sign, a.bits_.low} <=>
               two_words{b.bits_.high ^ sign, b.bits_.low};
    }
    friend constexpr signed_two_words operator+(signed_two_words a, signed_two_words b) noexcept {
        return signed_two_words{a.bits_ + b.bits_};
    }
    friend constexpr signed_two_words operator-(signed_two_words a, signed_two_words b) noexcept {
        return signed_two_words{a.bits_ - b.bits_};
    }
    friend constexpr signed_two_words operator-(signed_two_words a) noexcept {
        return signed_two_words{two_words{} - a.bits_};
    }
    friend constexpr signed_two_words operator*(signed_two_words a, signed_two_words b) noexcept {
        two_words p = full_product(a.bits_.low, b.bits_.low);
        p.high += a.bits_.high * b.bits_.low + a.bits_.low * b.bits_.high;
        return signed_two_words{p};
    }
    friend constexpr signed_two_words operator<<(signed_two_words a, int n) noexcept {
        return signed_two_words{a.bits_ << n};
    }
    /// floor(a / 2^n).
    friend constexpr signed_two_words operator>>(signed_two_words a, int n) noexcept {
        two_words const ones{~std::uint64_t{0}, ~std::uint64_t{0}};
        two_words const shifted = a.bits_ >> n;
        bool const negative = a.bits_.high >> 63 != 0;
        return signed_two_words{negative ? shifted + (ones << (128 - n)) : shifted};
    }
    [[nodiscard]] constexpr two_words bits() const noexcept { return bits_; }

private:
    constexpr explicit signed_two_words(two_words bits) noexcept : bits_{bits} {}
    two_words bits_;
};

/// Nothing where the result is no `int64_t`.
[[nodiscard]] constexpr std::optional<std::int64_t> narrowed(signed_two_words x) noexcept {
    auto const low = static_cast<std::int64_t>(x.bits().low);
    if (x == signed_two_words{low}) return low;
    return std::nullopt;
}
[[nodiscard]] constexpr std::optional<std::int64_t> checked_product(std::int64_t a,
                                                                    std::int64_t b) noexcept {
    return narrowed(signed_two_words{a} * signed_two_words{b});
}
[[nodiscard]] constexpr std::optional<std::int64_t> checked_sum(std::int64_t a,
                                                                std::int64_t b) noexcept {
    return narrowed(signed_two_words{a} + signed_two_words{b});
}

#if defined(__SIZEOF_INT128__)
__extension__ typedef __int128 wide_integer;
#else
using wide_integer = signed_two_words;
#endif

} // namespace sivid::detail

#endif
