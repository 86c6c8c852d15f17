// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_STRUCTURE_SYMMETRY_HPP
#define SIVID_MODEL_STRUCTURE_SYMMETRY_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/bound_model.hpp>

#include <vector>

namespace sivid {

/// How quantities move together along one unknown s.
enum class motion_kind {
    scaling,    ///< each is multiplied by \f$ e^{w s} \f$
    translation ///< w s is added to each
};

/// A motion of parameters and states, with one small integer w for each.
struct model_motion {
    motion_kind kind = motion_kind::scaling;
    std::vector<int> parameters; ///< one per unknown parameter
    std::vector<int> states;     ///< one per state
};

/// Whether a motion of parameters and initial states moves the trajectories by the same motion of
/// the states and leaves all outputs as they are. With v the velocity of the motion (w_j p_j or w_j
/// for parameters, likewise for states) that is
///   \f$ \sum_j v_j \partial f_i/\partial p_j + \sum_k v_k \partial f_i/\partial x_k = w_i f_i \f$
/// (0 on the right for a translation) and the same with 0 for every output; these identities are
/// multiplied out and compared term by term, with functions other than + - * / and powers as
/// variables of their own.
/// @guarantee  true is a theorem about the equations: the sensitivities along v vanish, whatever
/// the
///             inputs of the sampled kind; false says nothing
/// @cost  sums of up to 200 terms a node
/// @ref   Yates, Evans and Chappell, Structural identifiability analysis via symmetries of
///        differential equations, Automatica 45 (2009)
[[nodiscard]] SIVID_DECL bool is_symmetry(bound_model const& model, model_motion const& motion);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/structure/impl/symmetry.ipp>
#endif

#endif
