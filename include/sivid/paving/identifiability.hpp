// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IDENTIFIABILITY_HPP
#define SIVID_PAVING_IDENTIFIABILITY_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/options.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/model/structure/symmetry.hpp>
#include <sivid/paving/identifiability/detail/unknown_quantity.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace sivid {

/// A product or sum that a motion leaves as it is: what its factors or terms act through.
struct fixed_formula {
    motion_kind kind = motion_kind::scaling;
    std::vector<int> weights; ///< exponents of a product, factors of a sum
    std::string formula;
    bool proved = false; ///< all motions that it stands for are
};

/// What the measured outputs can tell about the unknowns, whatever the measured values.
struct identifiability {
    std::vector<unknown_quantity> unknowns;
    box parameters;          ///< where the proofs hold, every parameter in it
    std::vector<box> starts; ///< and the starts, per experiment
    std::size_t outputs = 0; ///< measured outputs that were reached
    std::size_t missing = 0; ///< those that the enclosure did not reach, left out everywhere

    /// The sensitivities of the outputs by the unknowns have at least this rank: proved.
    std::size_t least_rank = 0;
    /// They have at most this rank: proved, by motions that are theorems about the equations.
    std::size_t most_rank = 0;
    /// Their rank in the middle, in floating point: not proved.
    std::size_t approximate_rank = 0;
    /// Not proved; those that are noticed most come first.
    std::vector<sensitive_direction> directions;
    std::vector<free_motion> free; ///< in formulas; found numerically, proved where it says so
    /// Noticed by less than one half-width of a bound; for suggestions only.
    std::vector<free_motion> nearly_free;
    std::vector<fixed_formula> fixed;        ///< what the moving unknowns of `free` act through
    std::vector<fixed_formula> nearly_fixed; ///< the same with `nearly_free`, never proved

    /// Proved: no two values of the unknowns within `parameters` and `starts`, all else being
    /// equal, have the same outputs.
    [[nodiscard]] bool tells_all_apart() const { return least_rank == unknowns.size(); }
};

struct identifiability_options {
    enclosure_options enclosure{};
    bool starts = true;           ///< starts that are not known exactly count among the unknowns
    std::vector<box> at_starts{}; ///< one per experiment; empty: the middles of what is not known
};

/// Which unknowns, or combinations of them, the measured outputs of a problem can tell, at a point
/// or over a small box of parameters. Only the times, channels and bounds of the measurements are
/// used, not the measured values; outliers are not considered.
///   Ranks: sensitivities enclosed along proved trajectories (`sensitivity_runs`), a regular part
///   of them proved (`certified_rank`). Directions: the singular value decomposition of their
///   middles, scaled by the bounds and by the prior. Formulas: vectors of small integers in the
///   common null space of the sensitivities at three points, in logarithms (products and ratios)
///   and plain coordinates (sums and differences); then looked for in the equations
///   (`is_symmetry`).
/// @param at  one side per parameter of the problem, within the prior or not
/// @given     no delays; inputs count as recorded, whatever their error bounds
/// @throws std::invalid_argument  for an invalid problem, or boxes of other sizes
/// @guarantee  `least_rank` for all parameters and starts in the boxes; `most_rank` likewise; with
///             `tells_all_apart` the outputs are injective there (mean value theorem: averages of
///             the sensitivities lie in the enclosure); `proved` motions change no output anywhere
/// @cost  one integration with sensitivities for each experiment at `at`, its middle and two points
/// @ref   Walter and Pronzato, Identification of Parametric Models from Experimental Data (1997)
[[nodiscard]] SIVID_DECL identifiability
identifiability_of(identification_problem const& problem, box const& at,
                   identifiability_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/impl/identifiability.ipp>
#endif

#endif
