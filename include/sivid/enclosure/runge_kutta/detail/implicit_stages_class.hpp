// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_RUNGE_KUTTA_DETAIL_IMPLICIT_STAGES_CLASS_HPP
#define SIVID_ENCLOSURE_RUNGE_KUTTA_DETAIL_IMPLICIT_STAGES_CLASS_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/runge_kutta/detail/stage_arithmetic.hpp>
#include <sivid/enclosure/runge_kutta/order_conditions.hpp>
#include <sivid/enclosure/runge_kutta/tableau.hpp>
#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/model/series/series.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Proven stages of an implicit method, stage after stage: for every x and every step s of the sets
/// they were computed for, the stage equations have exactly one solution in
/// \f$ centre \pm radius \f$, and it lies in `value`.
template <class T>
struct stage_set {
    std::vector<T> value;
    std::vector<T> centre;
    std::vector<double> radius;
    std::vector<T> jacobian;     ///< \f$ \partial f \f$ at the stages: [stage * entries + entry]
    Eigen::MatrixXd inverse;     ///< Y, approximate
    Eigen::MatrixXd contraction; ///< \f$ E \ge |1 - Y (1 - s A \otimes J)| \f$, E radius < radius

    /// Whether all of `z` lies where the solution is unique.
    [[nodiscard]] bool holds(std::vector<T> const& z) const {
        for (std::size_t i = 0; i < z.size(); ++i) {
            auto const off = arithmetic_of<T>::sub(z[i], centre[i]);
            if (!(enclosure_detail::stage_arithmetic<T>::size(off) <= radius[i])) return false;
        }
        return true;
    }
    /// Whether E shrinks the region to this share of it: a measure of how long the range of steps
    /// is against the problem's time constants.
    [[nodiscard]] bool contracts(double share) const {
        auto const r = Eigen::Map<Eigen::VectorXd const>(radius.data(),
                                                         static_cast<Eigen::Index>(radius.size()));
        return ((contraction * r).array() <= share * r.array()).all();
    }
};

/// The stage equations of an implicit method,
///   \f$ k_i = f(t + c_i s, x + s \sum_j a_{ij} k_j) \f$, i = 1 .. s:
/// Newton's method finds the stages approximately, a Krawczyk operator proves them.
///   With \f$ G(k) = k - F(k) \f$, a centre \f$ \tilde k \f$, radii R and
///   \f$ E \ge |1 - Y G'(\tilde k \pm R)| \f$: if \f$ |Y G(\tilde k)| + E R < R \f$ then G has
///   exactly one zero in \f$ \tilde k \pm R \f$, every matrix in \f$ G'(\tilde k \pm R) \f$ is
///   regular, and the zero lies in \f$ \tilde k - Y G(\tilde k) \pm E R \f$.
/// @tparam T  an interval type, or a Taylor model: then all holds for every value of its variables
/// @ref  Krawczyk 1969; Neumaier, Interval Methods for Systems of Equations (1990), section 5.1
template <class T>
class implicit_stages {
    using arithmetic = arithmetic_of<T>;
    using set = enclosure_detail::stage_arithmetic<T>;
    using vector = std::vector<T>;

public:
    /// @throws std::invalid_argument for a tableau of another shape, or not of its stated order
    /// @param values  see `series`
    implicit_stages(flow const& f, tableau const& method, size_of_values<T> const& values = {})
        : flow_(&f), stages_(method.stages()), derivatives_(f.rate_jacobian(), 0, values) {
        rates_.reserve(stages_);
        for (std::size_t i = 0; i < stages_; ++i) {
            rates_.emplace_back(f.rate(), method.order + 1, values);
        }
        method.require_implicit();
        require_order(method);
        auto const enter = [](surd const& x) {
            return arithmetic::enclose(x.template enclose<interval>());
        };
        for (auto const& row : method.a) {
            for (auto const& x : row) a_.push_back(enter(x));
        }
        for (auto const& x : method.c) c_.push_back(enter(x));
    }

    template <class Box>
    void set_parameters(Box const& p) {
        for (auto& r : rates_) r.set_parameters(p);
        derivatives_.set_parameters(p);
    }

    /// Proves the stages for every x in the set `x` and every s in `step`.
    /// @param seeds  sets that the region of uniqueness has to hold
    /// @returns nothing when there is no proof: a shorter step may help
    [[nodiscard]] std::optional<stage_set<T>> prove(double t, vector const& x, T const& step,
                                                    std::vector<vector> const& seeds = {});

    /// Coefficients 0 .. order of the stages as functions of the step, at every s in `step`:
    /// order by order, \f$ k^{[j]} \f$ solves the linear system
    /// \f$ (1 - s A \otimes J) k^{[j]} = r_j \f$, whose right-hand side r_j is the series of f with
    /// \f$ k^{[j]} = 0 \f$.
    /// @returns coefficient j of k, for each j; nothing at a kink or outside the model's domain
    [[nodiscard]] std::optional<std::vector<vector>>
    expand(double t, vector const& x, T const& step, stage_set<T> const& stages, std::size_t order);

    /// A set that holds the solution of \f$ (1 - s A \otimes J) z = right \f$.
    [[nodiscard]] vector solve(T const& step, stage_set<T> const& stages,
                               vector const& right) const;

    /// \f$ f \f$ at the stages' arguments for given k: one application of the stage equations.
    /// Nothing where the model is not defined, or not smooth.
    [[nodiscard]] std::optional<vector> apply(double t, vector const& x, T const& step,
                                              vector const& k);

private:
    static constexpr double up = 1 + 1e-12; ///< rounds sums of some dozen non-negative doubles up
    static constexpr double tiny = 1e-290;

    [[nodiscard]] std::size_t size() const { return stages_ * flow_->states(); }
    [[nodiscard]] T time_of(double t, std::size_t i, T const& step) const {
        return arithmetic::add(arithmetic::point(t), arithmetic::mul(c_[i], step));
    }
    /// \f$ x + step \sum_l a_{il} k_l \f$, component s.
    [[nodiscard]] T argument(std::size_t i, std::size_t s, vector const& x, T const& step,
                             vector const& k) const {
        typename arithmetic::accumulator sum;
        for (std::size_t l = 0; l < stages_; ++l) {
            sum.add_product(a_[i * stages_ + l], k[l * flow_->states() + s]);
        }
        return arithmetic::add(x[s], arithmetic::mul(step, sum.result()));
    }
    /// Values of the Jacobian's entries at the stages; false where it does not exist.
    [[nodiscard]] bool differentiate(double t, vector const& x, T const& step, vector const& k,
                                     vector& jacobian);
    /// \f$ (1 - step A \otimes J) z \f$
    [[nodiscard]] vector matrix_times(T const& step, vector const& jacobian, vector const& z) const;
    /// The inverse of the matrix at the sets' centres.
    [[nodiscard]] Eigen::MatrixXd approximate_inverse(T const& step, vector const& jacobian) const;
    [[nodiscard]] Eigen::MatrixXd contraction(T const& step, vector const& jacobian,
                                              Eigen::MatrixXd const& inverse) const;
    [[nodiscard]] static vector times(Eigen::MatrixXd const& y, vector const& v);
    [[nodiscard]] static Eigen::VectorXd sizes(vector const& v) {
        Eigen::VectorXd result(static_cast<Eigen::Index>(v.size()));
        for (std::size_t i = 0; i < v.size(); ++i) {
            result[static_cast<Eigen::Index>(i)] = set::size(v[i]);
        }
        return result;
    }
    /// Newton's method; nothing where it leaves the numbers.
    [[nodiscard]] std::optional<vector> approximate(double t, vector const& x, T const& step,
                                                    Eigen::MatrixXd& inverse);

    flow const* flow_;
    std::size_t stages_;
    std::vector<series<T>> rates_; ///< one for each stage: the stages are expanded together
    series<T> derivatives_;
    vector a_, c_;
};

#ifdef SIVID_COMPILED // its members are compiled once
extern template class implicit_stages<interval>;
#endif

} // namespace sivid

#endif
