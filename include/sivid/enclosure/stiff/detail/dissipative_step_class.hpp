// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STIFF_DETAIL_DISSIPATIVE_STEP_CLASS_HPP
#define SIVID_ENCLOSURE_STIFF_DETAIL_DISSIPATIVE_STEP_CLASS_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/runge_kutta/implicit_stages.hpp>
#include <sivid/enclosure/stiff/detail/invariant_box.hpp>
#include <sivid/enclosure/stiff/detail/matrix_exponential.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// What a step does with a set: F(x, p) lies in image + derivative ((x, p) - (m, centre of p)).
template <class I>
struct step_map {
    basic_box<I> image;
    interval_matrix<I> derivative; ///< n x (n + parameters)
    Eigen::VectorXd error;         ///< half-width of the image that the method's defect makes
    Eigen::MatrixXd slack;         ///< half-widths of the derivative
};

/// Steps of implicit methods that are long against the time constants of a dissipative problem,
/// where the Taylor coefficients of the solution say nothing any more. With u the polynomial whose
/// slopes at the nodes are the stages, \f$ d = u' - f(u) \f$ its defect and B a box that no
/// solution leaves:
///   \f$ |x(s) - u(s)| \le E(s),\; E' = M E + |d|,\; E(0) = 0 \f$
/// where \f$ M_{ii} \ge \partial_i f_i, M_{ij} \ge |\partial_j f_i| \f$ on the hull of B and u; a
/// negative diagonal of M makes E small whatever the length of the step. The derivatives V of the
/// flow, of states and parameters together, satisfy with \f$ A_c \pm D \f$ an enclosure of the
/// Jacobian
///   \f$ |V(h) - e^{h A_c}| \le \int_0^h e^{(h-s) M} D e^{s M} ds \f$,
/// the block above the diagonal of \f$ \exp(h [M, D; 0, M]) \f$.
/// @ref  Dahlquist 1959; Neumaier, Computing Suppl. 9 (1993) (dissipative problems); Van Loan 1978
template <class I>
class dissipative_step {
    using traits = arithmetic_of<I>;

public:
    /// @throws std::invalid_argument for a tableau of another shape, or not of its stated order
    dissipative_step(flow const& f, tableau const& method)
        : flow_(&f),
          stages_(f, method),
          boxes_(f),
          centre_rate_(f.rate(), method.stages() + 2),
          jacobian_(f.rate_jacobian(), 0) {
        for (auto const& c : method.c) nodes_.push_back(mid(c.template enclose<interval>()));
    }

    void set_parameters(basic_box<I> const& p, std::vector<double> const& centre) {
        stages_.set_parameters(point_box<I>(centre));
        centre_rate_.set_parameters(point_box<I>(centre));
        boxes_.set_parameters(p);
        jacobian_.set_parameters(p);
    }

    /// Order of the error in the length of the step.
    [[nodiscard]] std::size_t order() const { return nodes_.size(); }

    /// Largest row sum of the Jacobian at the states x, each measured in its own range: one over
    /// the shortest time constant.
    [[nodiscard]] double stiffness(double t, basic_box<I> const& x);

    /// A box that holds all solutions from `x` over [from, to].
    /// @param m       a point of `x`
    /// @param margin  a length for each state below which nothing has to be resolved
    [[nodiscard]] std::optional<basic_box<I>> enclose(double from, double to, basic_box<I> const& x,
                                                      std::vector<double> const& m,
                                                      std::vector<double> const& margin);

    /// The map of the step, on solutions that stay in `tube`.
    /// @returns nothing when the stages could not be proved or the Jacobian does not exist
    [[nodiscard]] std::optional<step_map<I>>
    map(double from, double to, std::vector<double> const& m, basic_box<I> const& tube);

private:
    static constexpr std::size_t pieces = 8;
    static constexpr double up = 1 + 1e-12;

    /// u as a polynomial in s/h, [state][power].
    using path = std::vector<std::vector<double>>;

    [[nodiscard]] std::optional<path> interpolate(double from, I const& h,
                                                  std::vector<double> const& m);
    /// Coefficient k of u about each point of `at`.
    [[nodiscard]] static I shifted(std::vector<double> const& u, I const& at, std::size_t k);
    [[nodiscard]] static basic_box<I> range(path const& u, I const& at);
    /// Bounds of |d| on a piece of the step; nothing where it is not smooth.
    [[nodiscard]] std::optional<Eigen::VectorXd> defect(double from, I const& h, path const& u,
                                                        std::size_t piece);
    [[nodiscard]] static I part(std::size_t piece) {
        auto const share = [](std::size_t k) {
            return static_cast<double>(k) / static_cast<double>(pieces);
        };
        return traits::bounds(share(piece), share(piece + 1));
    }

    flow const* flow_;
    implicit_stages<I> stages_;
    invariant_box<I> boxes_;
    series<I> centre_rate_;
    series<I> jacobian_;
    std::vector<double> nodes_;
};

#ifdef SIVID_COMPILED // its members are compiled once
extern template class dissipative_step<interval>;
#endif

} // namespace sivid

#endif
