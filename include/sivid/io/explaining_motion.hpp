// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_EXPLAINING_MOTION_HPP
#define SIVID_IO_EXPLAINING_MOTION_HPP

#include <sivid/compiled.hpp>
#include <sivid/measurement/record.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/paving/identification.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
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

[[nodiscard]] constexpr std::string_view to_string(motion_source s) {
    return s == motion_source::inside_box ? "inside box"
           : s == motion_source::witness  ? "witness"
                                          : "best guess";
}

/// Proven enclosures of the motions of some parameters with the recorded inputs, for tables and
/// pictures.
struct explaining_motion {
    motion_source source = motion_source::best_guess;
    box parameters;
    std::vector<box> starts;                            ///< one per experiment
    std::vector<std::shared_ptr<flow const>> flows;     ///< one per experiment
    std::vector<std::shared_ptr<tube<interval>>> tubes; ///< one per experiment
    /// Per experiment and measurement (in order of time): the output; unbounded where the tube ends
    /// before, or nobody had the time to look.
    std::vector<std::vector<interval>> outputs;
};

/// Least number of steps of each tube, so that pictures are smooth; tables of outputs rest on it.
inline constexpr std::size_t motion_pieces = 240;

/// Encloses the motions of the parameters that best show why the data are consistent: the largest
/// inside box (or the largest part around its middle whose tube alone shows it), else the witness,
/// else the best guess.
/// @param pieces  least number of steps of each tube, so that pictures are smooth
/// @param keep_going  asked while integrating; false ends the search with a motion of the next
///                    kind in that order if one is whole, or with what a tube reached. May be empty
/// @returns nothing when there is no point to show, or no time to follow it
/// @cost  a handful of integrations of each experiment, each in so many steps at most as the
/// pieces,
///        the knots of the inputs and the measurements ask for
[[nodiscard]] SIVID_DECL std::optional<explaining_motion>
find_explaining_motion(identification_problem const& problem, identification const& found,
                       std::size_t pieces = motion_pieces,
                       std::function<bool()> const& keep_going = nullptr);

/// Encloses the motions of some parameters, and their outputs at the measurements.
/// @param starts  one box per experiment
[[nodiscard]] SIVID_DECL explaining_motion
enclose_motion(identification_problem const& problem, motion_source source, box parameters,
               std::vector<box> starts, std::size_t pieces = motion_pieces,
               std::function<bool()> const& keep_going = nullptr);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/explaining_motion.ipp>
#endif

#endif // SIVID_IO_EXPLAINING_MOTION_HPP
