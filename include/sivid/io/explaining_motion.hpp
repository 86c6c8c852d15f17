// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_EXPLAINING_MOTION_HPP
#define SIVID_IO_EXPLAINING_MOTION_HPP

#include <sivid/compiled.hpp>
#include <sivid/measurement/record.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/problem.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace sivid {

class flow;
template <class I>
class tube; // enclosure/tube.hpp, for those who look into one

/// Which parameters a tube stands for.
enum class motion_source {
    inside_box, ///< a box of parameters that is proved to explain the data
    witness,    ///< the verified point
    best_guess  ///< the best fit found, about which nothing is proved
};

/// Proven enclosures of the motions of some parameters with the recorded inputs, for tables and
/// pictures.
struct explaining_motion {
    motion_source source = motion_source::best_guess;
    box parameters;
    std::vector<box> starts;                            ///< one per experiment
    std::vector<std::shared_ptr<flow const>> flows;     ///< one per experiment
    std::vector<std::shared_ptr<tube<interval>>> tubes; ///< one per experiment

    /// Encloses the measured channels of experiment e; unbounded where the tube ends before.
    [[nodiscard]] std::vector<interval> outputs_of(std::size_t e, record const& samples) const;
};

namespace io_detail {

inline double last_measurement(experiment const& e) {
    double last = e.begin;
    for (auto const& m : e.measurements) last = std::max(last, m.time);
    return last;
}

} // namespace io_detail

/// Encloses the motions of the parameters that best show why the data are consistent: the largest
/// inside box (or the largest part around its middle whose tube alone shows it), else the witness,
/// else the best guess.
/// @param pieces  least number of steps of each tube, so that pictures are smooth
/// @returns nothing when there is no point to show
/// @cost  a handful of integrations of each experiment
[[nodiscard]] SIVID_ENTRY std::optional<explaining_motion>
find_explaining_motion(identification_problem const& problem, identification const& found,
                       std::size_t pieces = 240);

} // namespace sivid

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_FIND_EXPLAINING_MOTION)
#include <sivid/io/detail/explaining_motion_search.hpp>
#endif

#endif // SIVID_IO_EXPLAINING_MOTION_HPP
