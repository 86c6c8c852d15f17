// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_BLOCK_HPP
#define SIVID_PAVING_STATIC_BLOCK_HPP

#include <sivid/paving/flat_paving.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sivid {

/// Boxes that wait, with the measurements that are still open for each.
struct static_block {
    static_block(std::size_t sides, std::size_t words)
        : boxes(sides), open(box_chunk::capacity * words), missed(box_chunk::capacity) {}

    box_chunk boxes;
    std::vector<std::uint64_t> open;   ///< by box and word: bit k is set while k is not decided
    std::vector<std::uint32_t> missed; ///< by box: measurements that are certainly violated
    std::size_t count = 0;

    [[nodiscard]] bool full() const { return count == box_chunk::capacity; }
    void copy(static_block const& from, std::size_t i, std::size_t to) {
        boxes.copy(from.boxes, i, to);
        missed[to] = from.missed[i];
        auto const words = open.size() / box_chunk::capacity;
        for (std::size_t w = 0; w < words; ++w) open[to * words + w] = from.open[i * words + w];
    }
    /// Copies of the last box up to a multiple of the lanes.
    void pad(std::size_t lanes) {
        for (auto i = count; i % lanes != 0; ++i) copy(*this, count - 1, i);
    }
};

} // namespace sivid

#endif
