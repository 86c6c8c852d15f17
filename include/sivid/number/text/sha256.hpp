// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TEXT_SHA256_HPP
#define SIVID_NUMBER_TEXT_SHA256_HPP

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sivid {

namespace detail {

inline constexpr std::array<std::uint32_t, 64> sha256_constants{
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

/// One block of 64 bytes into the state.
inline void sha256_block(std::array<std::uint32_t, 8>& state, unsigned char const* block) {
    std::array<std::uint32_t, 64> w{};
    for (std::size_t i = 0; i < 16; ++i) {
        w[i] = static_cast<std::uint32_t>(block[4 * i]) << 24 |
               static_cast<std::uint32_t>(block[4 * i + 1]) << 16 |
               static_cast<std::uint32_t>(block[4 * i + 2]) << 8 |
               static_cast<std::uint32_t>(block[4 * i + 3]);
    }
    for (std::size_t i = 16; i < 64; ++i) {
        auto const a = std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ (w[i - 15] >> 3);
        auto const b = std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ (w[i - 2] >> 10);
        w[i] = w[i - 16] + a + w[i - 7] + b;
    }
    auto [a, b, c, d, e, f, g, h] = state;
    // eight rounds turn the names of the eight words round once: nothing is moved
    auto const round = [&w](auto& p, auto q, auto r, auto& s, auto t, auto u, auto v, auto& x,
                            std::size_t i) {
        auto const turned = std::rotr(t, 6) ^ std::rotr(t, 11) ^ std::rotr(t, 25);
        auto const first = x + turned + (v ^ (t & (u ^ v))) + sha256_constants[i] + w[i];
        auto const other = std::rotr(p, 2) ^ std::rotr(p, 13) ^ std::rotr(p, 22);
        s += first;
        x = first + other + ((p & q) | (r & (p | q)));
    };
    for (std::size_t i = 0; i < 64; i += 8) {
        round(a, b, c, d, e, f, g, h, i);
        round(h, a, b, c, d, e, f, g, i + 1);
        round(g, h, a, b, c, d, e, f, i + 2);
        round(f, g, h, a, b, c, d, e, i + 3);
        round(e, f, g, h, a, b, c, d, i + 4);
        round(d, e, f, g, h, a, b, c, i + 5);
        round(c, d, e, f, g, h, a, b, i + 6);
        round(b, c, d, e, f, g, h, a, i + 7);
    }
    std::array const s{a, b, c, d, e, f, g, h};
    for (std::size_t k = 0; k < 8; ++k) state[k] += s[k];
}

} // namespace detail

/// The SHA-256 digest of a text as 64 hexadecimal digits: texts with one digest are the same text,
/// for all that is known.
/// @ref  FIPS 180-4
/// @cost  linear in the length
[[nodiscard]] inline std::string sha256(std::string_view text) {
    std::array<std::uint32_t, 8> state{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                       0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    auto const bits = static_cast<std::uint64_t>(text.size()) * 8;
    auto const bytes = [](std::string_view part) {
        return reinterpret_cast<unsigned char const*>(part.data());
    };
    for (; text.size() >= 64; text.remove_prefix(64)) detail::sha256_block(state, bytes(text));
    std::string padded{text};
    padded += static_cast<char>(0x80);
    while (padded.size() % 64 != 56) padded += '\0';
    for (int shift = 56; shift >= 0; shift -= 8) {
        padded += static_cast<char>(static_cast<unsigned char>((bits >> shift) & 0xff));
    }
    for (std::string_view rest = padded; !rest.empty(); rest.remove_prefix(64)) {
        detail::sha256_block(state, bytes(rest));
    }
    std::string hex;
    for (auto const word : state) {
        for (int shift = 28; shift >= 0; shift -= 4) {
            hex += "0123456789abcdef"[(word >> shift) & 0xf];
        }
    }
    return hex;
}

} // namespace sivid

#endif // SIVID_NUMBER_TEXT_SHA256_HPP
