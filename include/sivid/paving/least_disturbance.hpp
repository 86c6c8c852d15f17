// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_LEAST_DISTURBANCE_HPP
#define SIVID_PAVING_LEAST_DISTURBANCE_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/disturbance.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/judge/feasibility_test_options.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sivid {

struct least_disturbance_options {
    double relative_width = 0.1; ///< stop when upper - lower is at most this share of upper
    double seconds = 20;
    std::size_t boxes = 2000; ///< of parameters that are bounded from below, at most
    /// A witness is constant between two measured times; in shorter pieces where those are no more
    /// than so many in all.
    std::size_t segments = 600;
    std::function<bool()> keep_going; ///< false stops with what is proved until then
    feasibility_test_options test;
};

/// A stretch of time of an experiment, [model's unit of time].
struct disturbed_stretch {
    std::size_t experiment = 0;
    double from = 0, to = 0;
};
/// What a witness has in a stretch: d of one equation, in its state's unit per time.
struct disturbance_piece : disturbed_stretch {
    std::size_t equation = 0;
    double value = 0;
};

/// What was proved about the least size of disturbances.
struct disturbance_bound {
    /// Contains the least W with which some parameter of the prior explains the data.
    interval size{0.0, detail::infinity};
    /// Explains the data with `pieces` and errors of disturbed channels up to `size.upper()`; none
    /// while that is infinite.
    std::optional<verified_witness> witness;
    /// Of each disturbed equation and experiment from begin to end: no witness, no pieces.
    std::vector<disturbance_piece> pieces;
    /// Proved, where `size.lower()` is above 0: of all disturbances up to `size.upper()` that
    /// explain the data, with any parameter, one reaches the lower size somewhere in these
    /// stretches, one of an experiment.
    std::vector<disturbed_stretch> needed;
    /// Contains every parameter that explains the data with disturbances up to `size.upper()`.
    box hull;
    std::size_t boxes = 0;
    double seconds = 0;
    std::vector<std::string> assumptions;
};

/// Bounds the least disturbance with which a model explains its data:
///   \f[ W^* = \min \{ W : \exists\, p, x_0, |d_i(t)| \le W s_i, |e_k(t)| \le W s_k \text{ with
///   which all measurements hold} \}, \f]
/// with d measurable, e arbitrary (reachset conformance). 0: the model explains them by itself.
///   Below: a linear program weighs the measurements; integration by parts with these weights is an
/// identity for every motion that keeps the measured bounds, whose terms intervals bound over a box
/// of parameters; boxes are halved. Above: disturbances constant in segments, fitted by a sequence
/// of such programs, with a validated run for a proof.
/// A channel that is a function of rates (an acceleration) is taken as the model writes it, without
/// the disturbance of the rate.
/// @guarantee  `size` contains W* whenever the search ends; disturbances between the segments of a
///             witness are covered by the lower bound
/// @throws std::invalid_argument  as `require_valid` of both, for outlier budgets and for
///         experiments that are conditions
/// @cost  an enclosure of the motions over each box, some 10 ms for a thousand cells of time; for
///        the witness some twenty simulations and one validated run
/// @ref   M. Althoff et al., Reachset conformance testing of hybrid automata (2016)
[[nodiscard]] SIVID_DECL disturbance_bound
least_disturbance(identification_problem const& problem, disturbance_set const& set,
                  least_disturbance_options const& options = {});

/// A point of a trade-off: scales of equations times one number, those of channels times another.
struct disturbance_share {
    double equations = 0, channels = 0;
    disturbance_bound found; ///< with these scales
};

/// Which sizes W of equations and E of channels are enough together: from the equations alone to
/// the channels alone, in shares of what these need. Each point is a `least_disturbance`: W and E
/// of `found.size.upper()` times the shares explain the data, less than `found.size.lower()` times
/// them does not.
/// @param points   2 or more
/// @param options  for all points together
/// @throws std::invalid_argument  as that does, and for a set without equations or channels
[[nodiscard]] SIVID_DECL std::vector<disturbance_share>
least_disturbance_curve(identification_problem const& problem, disturbance_set const& set,
                        std::size_t points, least_disturbance_options options = {});

/// Stretches in which the witness has nine tenths of the size or more, the longest first.
[[nodiscard]] SIVID_DECL std::vector<disturbance_piece>
strong_stretches(disturbance_set const& set, disturbance_bound const& found);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/impl/least_disturbance.ipp>
#endif

#endif
