// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DISTURBANCE_DETAIL_NARROWED_TUBE_HPP
#define SIVID_PAVING_DISTURBANCE_DETAIL_NARROWED_TUBE_HPP

#include <sivid/model/disturbance.hpp>
#include <sivid/paving/disturbance/detail/disturbance_program.hpp>
#include <sivid/paving/disturbance/detail/disturbed_motion.hpp>
#include <sivid/paving/disturbance/detail/plain_motion.hpp>
#include <sivid/paving/disturbance/detail/weighted_motion.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// A stretch of a motion between two nodes, the measurements in it included.
[[nodiscard]] inline disturbed_motion stretch_of(disturbed_motion const& m, std::size_t from,
                                                 std::size_t to) {
    auto const at = [](std::size_t k) { return static_cast<std::ptrdiff_t>(k); };
    disturbed_motion result;
    result.line.assign(m.line.begin() + at(from), m.line.begin() + at(to + 1));
    result.beside.assign(m.beside.begin() + at(from), m.beside.begin() + at(to + 1));
    result.cells.assign(m.cells.begin() + at(from), m.cells.begin() + at(to));
    for (auto const& s : m.samples) {
        if (s.node < from || s.node > to) continue;
        result.samples.push_back(s);
        result.samples.back().node -= from;
    }
    return result;
}

/// Narrows where the states are at the nodes by measurements around them: the weights of a least
/// squares estimate, in which a weighted sum encloses the state. So states are told that no channel
/// shows, or only through a function, and by what came later.
/// @guarantee  all motions that keep the measured bounds stay in the tube
/// @cost  O(nodes states block n^2), a block being 96 cells
[[nodiscard]] inline motion_tube narrowed_tube(disturbed_motion const& motion, motion_tube tube,
                                               disturbance_set const& set, box const& parameters,
                                               double size, std::function<bool()> const& go_on) {
    using traits = interval_traits<interval>;
    constexpr std::size_t block = 96, stride = 48;
    auto const cells = motion.cells.size();
    for (std::size_t c = 0; c < cells; ++c) {
        for (std::size_t i = 0; i < tube.over[c].size(); ++i) {
            auto const line = hull(interval(motion.line[c][i]), interval(motion.line[c + 1][i]));
            tube.over[c][i] = agreed(tube.over[c][i], traits::add(line, motion.cells[c].beside[i]));
        }
    }
    for (std::size_t from = 0; from < cells && go_on(); from += stride) {
        auto const first = from < (block - stride) / 2 ? 0 : from - (block - stride) / 2;
        auto const last = std::min(cells, first + block);
        std::vector<disturbed_motion> part{stretch_of(motion, first, last)};
        segment_begins begins(1, std::vector<std::size_t>(last - first));
        std::iota(begins[0].begin(), begins[0].end(), std::size_t{0});
        program_room room{{}, {part[0].beside.front()}};
        for (auto const& side : parameters)
            room.parameters.push_back(traits::sub(side, traits::point(mid(side))));
        std::vector<plain_motion> plain{plain_motion(part[0], room.parameters)};
        disturbance_program program(part, plain, set, begins, room);
        auto const end = std::min(from + stride, cells) + (from + stride >= cells ? 1 : 0);
        for (double const lasting : {8.0, 64.0}) {
            if (!program.prepare(size, lasting)) continue;
            for (auto k = from; k < end; ++k) {
                for (std::size_t i = 0; i < tube.at[k].size(); ++i) {
                    weighted_motion sum(set, parameters);
                    weighted_motion::place const target{k - first, i};
                    sum.add(part[0], plain[0], program.weights_for(0, k - first, i), &target);
                    auto const x =
                        traits::add(traits::point(motion.line[k][i]), sum.enclosed(size));
                    tube.at[k][i] = agreed(tube.at[k][i], x);
                }
            }
        }
    }
    return tube;
}

} // namespace sivid::paving_detail

#endif
