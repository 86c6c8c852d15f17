// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STEP_DETAIL_TUBE_STEP_HPP
#define SIVID_ENCLOSURE_STEP_DETAIL_TUBE_STEP_HPP

#include <sivid/enclosure/set/doubleton.hpp>
#include <sivid/enclosure/step/perturbed_step.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/matrix.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <optional>

namespace sivid {

/// What a step does with a set: F(x, p) lies in image + derivative ((x, p) - (m, centre of p)).
template <class I>
struct step_map {
    basic_box<I> image;
    interval_matrix<I> derivative; ///< n x (n + parameters)
    Eigen::VectorXd error;         ///< half-width of the image that the method's defect makes
    Eigen::MatrixXd slack;         ///< half-widths of the derivative
};

/// A proved step: all solutions that start in `start` at `from` exist on [from, to] and stay in
/// `tube`, and the derivatives V of the flow by initial state and parameters satisfy
/// \f$ |V(s) - V(0)| \le variation \f$ there. That is said of the recorded inputs; `perturbation`
/// says how far others within their error bounds may lead away, and `swept` holds for all of them.
template <class I>
struct tube_step {
    double from = 0;
    double to = 0;
    doubleton<I> start;
    basic_box<I> tube;         ///< a-priori enclosure B
    Eigen::MatrixXd variation; ///< n x (n + parameters)
    std::size_t order = 1;     ///< K of the centre's series
    std::size_t variational_order = 1;
    bool smooth = true; ///< false: a kink lies in the tube, first-order set-valued step
    bool jumps = false; ///< the right-hand side may be discontinuous in the tube
    /// Of a step that is long against the problem's time constants (`dissipative_step`): where it
    /// leads at its end; `variation` says nothing then.
    std::shared_ptr<step_map<I> const> long_map;
    std::optional<perturbation_law<double>> perturbation; ///< where inputs are uncertain
    basic_box<I> swept; ///< a tighter box for the states over [from, to]
};

} // namespace sivid

#endif
