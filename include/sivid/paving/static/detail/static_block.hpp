// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_DETAIL_STATIC_BLOCK_HPP
#define SIVID_PAVING_STATIC_DETAIL_STATIC_BLOCK_HPP

#include <sivid/paving/static/flat_paving.hpp>
#include <sivid/paving/static_problem.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid {

/// The measurements of a static problem in flat arrays, channel after channel, each in the order of
/// the record. Their numbers here are what lists of measurements mean.
struct static_samples {
    using index = std::uint32_t;

    std::vector<double> time, lower, upper;
    std::vector<index> end; ///< by channel: the number after its last measurement

    /// @given  a valid problem
    /// @throws std::invalid_argument for more than 2^32 - 2 measurements
    /// @cost  O(measurements), 24 bytes each
    explicit static_samples(static_problem const& problem)
        : end(problem.model.about.channels.size(), 0) {
        auto const& all = problem.measurements;
        if (all.size() >= std::numeric_limits<index>::max()) {
            throw std::invalid_argument("static problem: too many measurements, " +
                                        std::to_string(all.size()));
        }
        for (auto const& m : all) ++end[m.channel];
        std::partial_sum(end.begin(), end.end(), end.begin());
        auto place = end; // of the next one, from the end of each channel
        time.resize(all.size());
        lower.resize(all.size());
        upper.resize(all.size());
        for (auto m = all.rbegin(); m != all.rend(); ++m) {
            auto const k = --place[m->channel];
            time[k] = m->time;
            lower[k] = m->bound.lower();
            upper[k] = m->bound.upper();
        }
    }

    [[nodiscard]] std::size_t size() const { return time.size(); }
    [[nodiscard]] std::size_t channel(index k) const {
        std::size_t c = 0;
        while (k >= end[c]) ++c;
        return c;
    }
    [[nodiscard]] std::vector<index> all() const {
        std::vector<index> result(size());
        std::iota(result.begin(), result.end(), index{0});
        return result;
    }
};

/// Measurements that were open for a box, ascending, and may be for its parts; others are decided.
using static_list = std::shared_ptr<std::vector<static_samples::index> const>;

/// Boxes that wait, with the measurements that are still open for each: at most 64 of one list.
struct static_block {
    static constexpr std::size_t most_open = 64;

    explicit static_block(std::size_t sides)
        : boxes(sides), open(box_chunk::capacity), missed(box_chunk::capacity) {}

    static_list list;
    std::size_t family = 0; ///< a number of the list
    box_chunk boxes;
    std::vector<std::uint64_t> open;   ///< by box: bit k is set while k of the list is not decided
    std::vector<std::uint32_t> missed; ///< by box: measurements that are certainly violated
    std::size_t count = 0;

    [[nodiscard]] static std::size_t bytes(std::size_t sides) {
        return sizeof(static_block) +
               box_chunk::capacity *
                   (2 * sides * sizeof(double) + sizeof(std::uint64_t) + sizeof(std::uint32_t));
    }
    [[nodiscard]] bool full() const { return count == box_chunk::capacity; }
    void copy(static_block const& from, std::size_t i, std::size_t to) {
        boxes.copy(from.boxes, i, to);
        missed[to] = from.missed[i];
        open[to] = from.open[i];
    }
    /// Everything in the list is open for box i.
    void open_all(std::size_t i, std::size_t already_missed = 0) {
        open[i] = list->empty() ? 0 : ~std::uint64_t{0} >> (most_open - list->size());
        missed[i] = static_cast<std::uint32_t>(already_missed);
    }
    /// Copies of the last box up to a multiple of the lanes.
    void pad(std::size_t lanes) {
        for (auto i = count; i % lanes != 0; ++i) copy(*this, count - 1, i);
    }
};

} // namespace sivid

#endif
