// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_CHECK_SUM_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_CHECK_SUM_HPP

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>

namespace sivid {

/// What stands before the check sum of "text*HHHH", four hexadecimal digits: CRC-16/CCITT (0x1021,
/// from 0xFFFF) of the bytes before the star. Every change of up to three bits of a line shorter
/// than 4000 bytes shows, and of random others all but one in 65536.
/// @returns nothing  when there is none, or it is wrong
[[nodiscard]] inline std::optional<std::string_view> without_check_sum(std::string_view line) {
    constexpr std::size_t tail = 5;
    if (line.size() < tail || line[line.size() - tail] != '*') return std::nullopt;
    unsigned stated = 0;
    auto const* end = line.data() + line.size();
    if (std::from_chars(end - 4, end, stated, 16).ptr != end) return std::nullopt;
    line.remove_suffix(tail);
    unsigned sum = 0xFFFF;
    for (char const c : line) {
        sum ^= static_cast<unsigned>(static_cast<unsigned char>(c)) << 8;
        for (int bit = 0; bit < 8; ++bit)
            sum = ((sum & 0x8000) != 0 ? (sum << 1) ^ 0x1021 : sum << 1) & 0xFFFF;
    }
    return sum == stated ? std::optional{line} : std::nullopt;
}

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_CHECK_SUM_HPP
