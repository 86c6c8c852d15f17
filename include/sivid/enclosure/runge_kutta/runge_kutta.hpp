// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_RUNGE_KUTTA_RUNGE_KUTTA_HPP
#define SIVID_ENCLOSURE_RUNGE_KUTTA_RUNGE_KUTTA_HPP

/// @file
/// The formulas of Runge-Kutta methods, explicit and implicit, as functions of the step
/// (docs/theory/runge_kutta.md).

#include <sivid/compiled.hpp>
#include <sivid/enclosure/runge_kutta/tableau.hpp>
#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/enclosure/step/step_method.hpp>
#include <sivid/model/series/series.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/space/dense.hpp>
#include <sivid/space/matrix.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A rooted tree: the subtrees at its root, as indices into a list of trees in which children come
/// before their parents, in ascending order.
struct rooted_tree {
    std::size_t nodes = 1;
    double density = 1; ///< \f$ \gamma \f$, a product of small integers: exact
    std::vector<std::size_t> children;
};

/// All rooted trees with up to `order` nodes: 1, 1, 2, 4, 9, 20, ... of each size.
[[nodiscard]] inline std::vector<rooted_tree> rooted_trees(std::size_t order) {
    std::vector<rooted_tree> trees;
    // Adds all trees of `left` more nodes whose further children have an index of at most `last`.
    auto const grow = [&trees](auto const& self, rooted_tree root, std::size_t left,
                               std::size_t last) -> void {
        if (left == 0) {
            root.density *= static_cast<double>(root.nodes);
            trees.push_back(std::move(root));
            return;
        }
        for (std::size_t k = last + 1; k-- > 0;) {
            auto const size = trees[k].nodes;
            if (size > left) continue;
            auto more = root;
            more.nodes += size;
            more.density *= trees[k].density;
            more.children.push_back(k);
            self(self, std::move(more), left - size, k);
        }
    };
    for (std::size_t n = 1; n <= order; ++n) {
        auto const smaller = trees.size();
        grow(grow, rooted_tree{}, n - 1, smaller == 0 ? 0 : smaller - 1);
    }
    return trees;
}

/// Enclosures of \f$ \sum_i b_i \Phi_i(t) - 1/\gamma(t) \f$ for all trees with up to `order` nodes,
/// after those of \f$ \sum_j a_{ij} - c_i \f$: a method has the order if and only if all these
/// numbers are zero.
/// @ref  Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I (1993), theorem
///       II.2.13
template <class I = interval>
[[nodiscard]] std::vector<I> order_residuals(tableau const& method, std::size_t order) {
    using traits = interval_traits<I>;
    auto const s = method.stages();
    std::vector<I> residuals;
    std::vector<std::vector<I>> a(s);
    for (std::size_t i = 0; i < s; ++i) {
        I sum = traits::neg(method.c[i].template enclose<I>());
        for (auto const& x : method.a[i]) {
            a[i].push_back(x.template enclose<I>());
            sum = traits::add(sum, a[i].back());
        }
        residuals.push_back(sum);
    }
    auto const trees = rooted_trees(order);
    // \Phi_i of the tree: the product over its children of \sum_j a_{ij} \Phi_j(child).
    std::vector<std::vector<I>> branch; // \sum_j a_{ij} \Phi_j(tree)
    for (auto const& tree : trees) {
        std::vector<I> weight(s, traits::point(1.0));
        for (auto const child : tree.children) {
            for (std::size_t i = 0; i < s; ++i) {
                weight[i] = traits::mul(weight[i], branch[child][i]);
            }
        }
        typename traits::mask never{};
        I sum = traits::neg(traits::div(traits::point(1.0), traits::point(tree.density), never));
        for (std::size_t i = 0; i < s; ++i) {
            sum = traits::add(sum, traits::mul(method.b[i].template enclose<I>(), weight[i]));
        }
        residuals.push_back(sum);
        std::vector<I> next(s, traits::point(0.0));
        for (std::size_t i = 0; i < s; ++i) {
            for (std::size_t j = 0; j < a[i].size(); ++j) {
                next[i] = traits::add(next[i], traits::mul(a[i][j], weight[j]));
            }
        }
        branch.push_back(std::move(next));
    }
    return residuals;
}

/// Refuses a method whose stated order is disproved: its enclosures would not hold.
/// @throws std::invalid_argument
inline void require_order(tableau const& method) {
    for (auto const& r : order_residuals<interval>(method, method.order)) {
        if (contains(r, 0.0)) continue;
        throw std::invalid_argument("tableau '" + method.name + "' does not have the order " +
                                    std::to_string(method.order) + " that it states");
    }
}

/// The formula of an explicit Runge-Kutta method as a function of the step, \f$ \phi(s) \f$, with
/// its Taylor coefficients in s: the stages are expanded by the same series as the solution itself.
///   A method of order p agrees with the solution in the coefficients 0 .. p at s = 0, hence
///   \f$ x(h) \in \phi(h) + h^{p+1} ( x^{[p+1]}(B) - \phi^{[p+1]}([0, h]) ) \f$,
///   with B an enclosure of the solution on [0, h].
/// @tparam T  an interval type
/// @ref  Alexandre dit Sandretto and Chapoutot, Reliable Computing 22 (2016), section 3; the local
///       error is bounded here by series in the step instead of rooted trees
///       (docs/theory/runge_kutta.md).
template <class T>
class runge_kutta {
    using arithmetic = arithmetic_of<T>;

public:
    /// @throws std::invalid_argument for a tableau of another shape, or not of its stated order
    /// @param values  see `series`
    runge_kutta(flow const& f, tableau const& method, size_of_values<T> const& values = {})
        : flow_(&f), method_(method), rate_(f.rate(), method.order + 1, values) {
        method_.require_explicit();
        require_order(method_);
        auto const enter = [](surd const& x) {
            return arithmetic::enclose(x.template enclose<interval>());
        };
        for (auto const& row : method_.a) {
            a_.emplace_back();
            for (auto const& x : row) a_.back().push_back(enter(x));
        }
        for (auto const& x : method_.b) b_.push_back(enter(x));
        for (auto const& x : method_.c) c_.push_back(enter(x));
    }

    [[nodiscard]] std::size_t order() const { return method_.order; }
    template <class Box>
    void set_parameters(Box const& p) {
        rate_.set_parameters(p);
    }
    /// A stage of the last `coefficient` crossed a kink of the model.
    [[nodiscard]] bool kinked() const { return kinked_; }

    /// Coefficient `k` of \f$ \phi \f$, expanded about each s in `step`, from `x` at time `t`.
    /// @param undefined  set where a stage leaves the domain of the model
    template <class States>
    [[nodiscard]] std::vector<T> coefficient(double t, States const& x, T const& step,
                                             std::size_t k, typename arithmetic::mask& undefined) {
        auto const n = x.size();
        auto const stages = method_.stages();
        kinked_ = false;
        auto const stride = k + 1;
        // stage[(i * n + s) * stride + j]: coefficient j of component s of k_i
        std::vector<T> stage(stages * n * stride, arithmetic::point(0.0));
        auto const get = [&](std::size_t i, std::size_t s, std::size_t j) -> T& {
            return stage[(i * n + s) * stride + j];
        };
        // coefficient j of (step + tau) * k_i
        auto const scaled = [&](std::size_t i, std::size_t s, std::size_t j) {
            T const value = arithmetic::mul(step, get(i, s, j));
            return j == 0 ? value : arithmetic::add(value, get(i, s, j - 1));
        };
        for (std::size_t i = 0; i < stages; ++i) {
            T const time = arithmetic::add(arithmetic::point(t), arithmetic::mul(c_[i], step));
            input_pieces<T> const pieces(*flow_, t, time);
            auto const input = [&](std::size_t u, std::size_t j) {
                return j == 1 ? arithmetic::mul(c_[i], pieces(u, 1)) : pieces(u, j);
            };
            auto const state = [&](std::size_t s, std::size_t j) {
                T value = j == 0 ? x[s] : arithmetic::point(0.0);
                for (std::size_t l = 0; l < i; ++l) {
                    value = arithmetic::add(value, arithmetic::mul(a_[i][l], scaled(l, s, j)));
                }
                return value;
            };
            rate_.start(time, c_[i]);
            for (std::size_t j = 0; j <= k; ++j) {
                rate_.advance(j, state, input);
                for (std::size_t s = 0; s < n; ++s) {
                    bool const zero = j > 0 && !flow_->rate().output_varies(s);
                    get(i, s, j) = zero ? arithmetic::point(0.0) : rate_.output(s, j);
                }
            }
            undefined |= rate_.undefined();
            kinked_ = kinked_ || rate_.kinked();
        }
        std::vector<T> result(n, arithmetic::point(0.0));
        for (std::size_t s = 0; s < n; ++s) {
            T value = k == 0 ? x[s] : arithmetic::point(0.0);
            for (std::size_t i = 0; i < stages; ++i) {
                value = arithmetic::add(value, arithmetic::mul(b_[i], scaled(i, s, k)));
            }
            result[s] = value;
        }
        return result;
    }

    /// @returns nothing when a stage leaves the domain of the model or crosses a kink
    template <class States>
    [[nodiscard]] std::optional<runge_kutta_formula<T>> formula(double t, States const& x,
                                                                T const& step) {
        typename arithmetic::mask undefined{};
        auto value = coefficient(t, x, step, 0, undefined);
        bool rough = kinked_;
        auto const range = arithmetic::hull(arithmetic::point(0.0), step);
        auto next = coefficient(t, x, range, order() + 1, undefined);
        if (undefined || rough || kinked_) return std::nullopt;
        return runge_kutta_formula<T>{std::move(value), std::move(next)};
    }

private:
    flow const* flow_;
    tableau method_;
    series<T> rate_;
    std::vector<std::vector<T>> a_;
    std::vector<T> b_, c_;
    bool kinked_ = false;
};

namespace enclosure_detail {
/// What a Krawczyk operator needs of a set of numbers or functions beyond arithmetic.
template <class T>
struct stage_arithmetic {
    using traits = interval_traits<T>;

    /// Upper bound of |a|.
    [[nodiscard]] static double size(T const& a) {
        double result = 0;
        for (std::size_t l = 0; l < traits::lanes; ++l) {
            double const m = traits::mag(a, l);
            // NaN and the empty set: nothing is known.
            if (!(m >= 0)) return std::numeric_limits<double>::infinity();
            result = std::max(result, m);
        }
        return result;
    }
    [[nodiscard]] static T widened(T const& a, double r) {
        return traits::add(a, traits::bounds(-r, r));
    }
    /// A point of the set; no proof rests on which.
    [[nodiscard]] static T core(T const& a) { return traits::point(traits::mid(a)); }
    [[nodiscard]] static double approximate(T const& a) { return traits::mid(a); }
};
} // namespace enclosure_detail

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
/// @tparam T  an interval type
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

template <class T>
auto implicit_stages<T>::apply(double t, vector const& x, T const& step, vector const& k)
    -> std::optional<vector> {
    auto const n = flow_->states();
    vector result;
    for (std::size_t i = 0; i < stages_; ++i) {
        auto const time = time_of(t, i, step);
        input_pieces<T> const input(*flow_, t, time);
        auto& rate = rates_[i];
        rate.start(time, c_[i]);
        rate.advance(
            0, [&](std::size_t s, std::size_t) { return argument(i, s, x, step, k); }, input);
        if (rate.undefined() || rate.jumped()) return std::nullopt;
        for (std::size_t s = 0; s < n; ++s) result.push_back(rate.output(s, 0));
    }
    return result;
}

template <class T>
bool implicit_stages<T>::differentiate(double t, vector const& x, T const& step, vector const& k,
                                       vector& jacobian) {
    jacobian.clear();
    for (std::size_t i = 0; i < stages_; ++i) {
        auto const time = time_of(t, i, step);
        input_pieces<T> const input(*flow_, t, time);
        derivatives_.start(time);
        derivatives_.advance(
            0, [&](std::size_t s, std::size_t) { return argument(i, s, x, step, k); }, input);
        if (derivatives_.undefined() || derivatives_.jumped()) return false;
        for (auto const& e : flow_->entries()) {
            jacobian.push_back(derivatives_.output(e.output, 0));
        }
    }
    return true;
}

template <class T>
auto implicit_stages<T>::matrix_times(T const& step, vector const& jacobian, vector const& z) const
    -> vector {
    auto const n = flow_->states();
    auto const entries = flow_->entries().size();
    std::vector<typename arithmetic::accumulator> sums(size());
    for (std::size_t i = 0; i < stages_; ++i) {
        vector inner; // \sum_l a_{il} z_l
        for (std::size_t s = 0; s < n; ++s) {
            typename arithmetic::accumulator sum;
            for (std::size_t l = 0; l < stages_; ++l) {
                sum.add_product(a_[i * stages_ + l], z[l * n + s]);
            }
            inner.push_back(arithmetic::mul(step, sum.result()));
        }
        for (std::size_t e = 0; e < entries; ++e) {
            auto const& entry = flow_->entries()[e];
            if (entry.column >= n) continue;
            sums[i * n + entry.row].add_product(jacobian[i * entries + e], inner[entry.column]);
        }
    }
    vector result;
    for (std::size_t i = 0; i < size(); ++i) {
        result.push_back(arithmetic::sub(z[i], sums[i].result()));
    }
    return result;
}

template <class T>
Eigen::MatrixXd implicit_stages<T>::approximate_inverse(T const& step,
                                                        vector const& jacobian) const {
    auto const n = flow_->states();
    auto const entries = flow_->entries().size();
    auto const m = static_cast<Eigen::Index>(size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(m, m);
    double const h = set::approximate(step);
    for (std::size_t i = 0; i < stages_; ++i) {
        for (std::size_t l = 0; l < stages_; ++l) {
            double const factor = h * set::approximate(a_[i * stages_ + l]);
            for (std::size_t e = 0; e < entries; ++e) {
                auto const& entry = flow_->entries()[e];
                if (entry.column >= n) continue;
                matrix(static_cast<Eigen::Index>(i * n + entry.row),
                       static_cast<Eigen::Index>(l * n + entry.column)) -=
                    factor * set::approximate(jacobian[i * entries + e]);
            }
        }
    }
    return sivid::approximate_inverse(matrix);
}

template <class T>
Eigen::MatrixXd implicit_stages<T>::contraction(T const& step, vector const& jacobian,
                                                Eigen::MatrixXd const& inverse) const {
    auto const m = static_cast<Eigen::Index>(size());
    Eigen::MatrixXd result(m, m);
    for (Eigen::Index c = 0; c < m; ++c) {
        vector unit(size(), arithmetic::point(0.0));
        unit[static_cast<std::size_t>(c)] = arithmetic::point(1.0);
        auto column = times(inverse, matrix_times(step, jacobian, unit));
        auto& diagonal = column[static_cast<std::size_t>(c)];
        diagonal = arithmetic::sub(diagonal, arithmetic::point(1.0));
        result.col(c) = sizes(column);
    }
    return result;
}

template <class T>
auto implicit_stages<T>::times(Eigen::MatrixXd const& y, vector const& v) -> vector {
    vector result;
    for (Eigen::Index i = 0; i < y.rows(); ++i) {
        typename arithmetic::accumulator sum;
        for (Eigen::Index j = 0; j < y.cols(); ++j) {
            if (y(i, j) == 0) continue;
            sum.add_product(arithmetic::point(y(i, j)), v[static_cast<std::size_t>(j)]);
        }
        result.push_back(sum.result());
    }
    return result;
}

template <class T>
auto implicit_stages<T>::approximate(double t, vector const& x, T const& step,
                                     Eigen::MatrixXd& inverse) -> std::optional<vector> {
    auto const n = flow_->states();
    // At step 0 all stages are f(t, x).
    auto const first = apply(t, x, arithmetic::point(0.0), vector(size(), arithmetic::point(0.0)));
    if (!first) return std::nullopt;
    vector k;
    for (auto const& value : *first) k.push_back(set::core(value));
    vector base(n);
    for (std::size_t s = 0; s < n; ++s) base[s] = set::core(x[s]);
    auto const h = set::core(step);
    double before = std::numeric_limits<double>::infinity();
    vector jacobian;
    for (int round = 0; round < 20; ++round) {
        if (round < 4) {
            if (!differentiate(t, base, h, k, jacobian)) return std::nullopt;
            inverse = approximate_inverse(h, jacobian);
            if (!inverse.allFinite()) return std::nullopt;
        }
        auto const image = apply(t, base, h, k);
        if (!image) return std::nullopt;
        vector residual;
        for (std::size_t i = 0; i < k.size(); ++i) {
            residual.push_back(arithmetic::sub(k[i], (*image)[i]));
        }
        auto const change = times(inverse, residual);
        double norm = 0; // as a share of the largest stage of the same state
        for (std::size_t s = 0; s < n; ++s) {
            double most = 0, size = 0;
            for (std::size_t i = s; i < k.size(); i += n) {
                most = std::max(most, set::size(set::core(change[i])));
                size = std::max(size, set::size(k[i]));
            }
            if (most > 0) norm = std::max(norm, most / std::max(size, most));
        }
        if (!std::isfinite(norm)) return std::nullopt;
        if (round > 1 && norm >= 0.5 * before) break;
        for (std::size_t i = 0; i < k.size(); ++i) {
            k[i] = set::core(arithmetic::sub(k[i], set::core(change[i])));
        }
        before = norm;
    }
    return k;
}

template <class T>
auto implicit_stages<T>::prove(double t, vector const& x, T const& step,
                               std::vector<vector> const& seeds) -> std::optional<stage_set<T>> {
    stage_set<T> result;
    auto centre = approximate(t, x, step, result.inverse);
    if (!centre) return std::nullopt;
    result.centre = std::move(*centre);
    auto const image = apply(t, x, step, result.centre);
    if (!image) return std::nullopt;
    vector residual;
    for (std::size_t i = 0; i < size(); ++i) {
        residual.push_back(arithmetic::sub(result.centre[i], (*image)[i]));
    }
    auto const change = times(result.inverse, residual);
    auto const distance = sizes(change);
    Eigen::VectorXd radius = 1.1 * distance;
    for (std::size_t i = 0; i < size(); ++i) {
        auto& r = radius[static_cast<Eigen::Index>(i)];
        r += 1e-14 * set::size(result.centre[i]) + tiny;
        for (auto const& seed : seeds) {
            r = std::max(r, 1.01 * set::size(arithmetic::sub(seed[i], result.centre[i])) + tiny);
        }
    }
    for (int round = 0; round < 8; ++round) {
        if (!radius.allFinite()) return std::nullopt;
        vector region;
        for (std::size_t i = 0; i < size(); ++i) {
            region.push_back(set::widened(result.centre[i], radius[static_cast<Eigen::Index>(i)]));
        }
        if (!differentiate(t, x, step, region, result.jacobian)) return std::nullopt;
        result.contraction = contraction(step, result.jacobian, result.inverse);
        Eigen::VectorXd near = (result.contraction * radius) * up;
        Eigen::VectorXd inside = (distance + near) * up;
        inside.array() += tiny;
        if (!inside.allFinite()) return std::nullopt;
        if ((inside.array() < radius.array()).all()) {
            result.radius.assign(radius.data(), radius.data() + radius.size());
            // The same bound again: the zero is at most `inside` away from the centre.
            for (int again = 0; again < 3; ++again) {
                near = (result.contraction * inside) * up;
                inside = ((distance + near) * up).cwiseMin(inside);
            }
            for (std::size_t i = 0; i < size(); ++i) {
                result.value.push_back(set::widened(arithmetic::sub(result.centre[i], change[i]),
                                                    near[static_cast<Eigen::Index>(i)] + tiny));
            }
            return result;
        }
        // Only where it was too small: else all grow together, and none ever holds its image. What
        // acts through a chain of states arrives one state further each time.
        for (std::size_t state = 0; state < flow_->states(); ++state) {
            if ((inside.array() < radius.array()).all()) break;
            radius = (inside.array() < radius.array()).select(radius, 1.2 * inside);
            inside = (distance + result.contraction * radius) * up;
            inside.array() += tiny;
        }
    }
    return std::nullopt;
}

template <class T>
auto implicit_stages<T>::solve(T const& step, stage_set<T> const& stages, vector const& right) const
    -> vector {
    vector middle;
    for (auto const& r : right) middle.push_back(set::core(r));
    auto guess = times(stages.inverse, middle);
    for (auto& z : guess) z = set::core(z);
    auto residual = matrix_times(step, stages.jacobian, guess);
    for (std::size_t i = 0; i < size(); ++i) {
        residual[i] = arithmetic::sub(right[i], residual[i]);
    }
    // z - guess = change + (1 - Y M) (z - guess), and with E radius < radius the bound
    // |z - guess| <= theta radius holds as soon as |change| <= theta (radius - E radius).
    auto const change = times(stages.inverse, residual);
    auto const distance = sizes(change);
    auto const radius = Eigen::Map<Eigen::VectorXd const>(
        stages.radius.data(), static_cast<Eigen::Index>(stages.radius.size()));
    Eigen::VectorXd const used = (stages.contraction * radius) * up;
    double theta = 0;
    for (Eigen::Index i = 0; i < radius.size(); ++i) {
        double const room = (radius[i] - used[i]) / up;
        theta = std::max(theta, room > 0 ? distance[i] / room * up : HUGE_VAL);
    }
    Eigen::VectorXd off = theta * up * radius;
    off.array() += tiny;
    Eigen::VectorXd near = off;
    for (int round = 0; round < 4; ++round) {
        near = (stages.contraction * off) * up;
        near.array() += tiny;
        off = ((distance + near) * up).cwiseMin(off);
    }
    vector result;
    for (std::size_t i = 0; i < size(); ++i) {
        auto const z = arithmetic::add(guess[i], change[i]);
        double const w = near[static_cast<Eigen::Index>(i)];
        result.push_back(set::widened(z, w >= 0 ? w : HUGE_VAL)); // NaN: nothing is known
    }
    return result;
}

template <class T>
auto implicit_stages<T>::expand(double t, vector const& x, T const& step,
                                stage_set<T> const& stages, std::size_t order)
    -> std::optional<std::vector<vector>> {
    auto const n = flow_->states();
    auto const zero = arithmetic::point(0.0);
    std::vector<vector> k{stages.value};
    std::vector<T> times_of;
    std::vector<input_pieces<T>> pieces;
    for (std::size_t i = 0; i < stages_; ++i) {
        times_of.push_back(time_of(t, i, step));
        pieces.emplace_back(*flow_, t, times_of.back());
        rates_[i].start(times_of[i], c_[i]);
    }
    // Coefficient j of the argument x + (step + tau) \sum_l a_{il} k_l.
    auto const advance = [&](std::size_t i, std::size_t j) {
        rates_[i].advance(
            j,
            [&](std::size_t s, std::size_t) {
                if (j == 0) return argument(i, s, x, step, k[0]);
                typename arithmetic::accumulator now;
                typename arithmetic::accumulator before;
                for (std::size_t l = 0; l < stages_; ++l) {
                    now.add_product(a_[i * stages_ + l], k[j][l * n + s]);
                    before.add_product(a_[i * stages_ + l], k[j - 1][l * n + s]);
                }
                return arithmetic::add(arithmetic::mul(step, now.result()), before.result());
            },
            [&](std::size_t u, std::size_t) {
                return j == 1 ? arithmetic::mul(c_[i], pieces[i](u, 1)) : pieces[i](u, j);
            });
        return !rates_[i].undefined() && !rates_[i].kinked() && !rates_[i].jumped();
    };
    for (std::size_t i = 0; i < stages_; ++i) {
        if (!advance(i, 0)) return std::nullopt;
    }
    for (std::size_t j = 1; j <= order; ++j) {
        k.emplace_back(size(), zero);
        vector right;
        for (std::size_t i = 0; i < stages_; ++i) {
            if (!advance(i, j)) return std::nullopt;
            for (std::size_t s = 0; s < n; ++s) {
                right.push_back(flow_->rate().output_varies(s) ? rates_[i].output(s, j) : zero);
            }
        }
        k[j] = solve(step, stages, right);
        if (j == order) break;
        for (std::size_t i = 0; i < stages_; ++i) {
            if (!advance(i, j)) return std::nullopt;
        }
    }
    return k;
}

/// The formula of an implicit Runge-Kutta method as a function of the step,
///   \f$ \phi(s) = x + s \sum_i b_i k_i(s) \f$, where k(s) is the solution of the stage equations
///   that begins as f(t, x) at s = 0: proved to exist on the whole step, to be the only one near,
///   and expanded in s by the same series as the solution itself.
/// The local error is that of explicit methods: \f$ h^{p+1} ( x^{[p+1]}(B) - \phi^{[p+1]}([0,h]) )
/// \f$.
/// @tparam T  an interval type
/// @ref  docs/theory/runge_kutta.md; Alexandre dit Sandretto and Chapoutot, Reliable Computing 22
/// (2016)
template <class T>
class implicit_runge_kutta {
    using arithmetic = arithmetic_of<T>;
    using vector = std::vector<T>;

public:
    /// @throws std::invalid_argument for a tableau of another shape, or not of its stated order
    /// @param values  see `series`
    implicit_runge_kutta(flow const& f, tableau const& method, size_of_values<T> const& values = {})
        : flow_(&f), order_(method.order), stages_(f, method, values) {
        for (auto const& x : method.b) {
            b_.push_back(arithmetic::enclose(x.template enclose<interval>()));
        }
    }

    [[nodiscard]] std::size_t order() const { return order_; }
    [[nodiscard]] implicit_stages<T>& stages() { return stages_; }
    template <class Box>
    void set_parameters(Box const& p) {
        stages_.set_parameters(p);
    }

    /// \f$ \phi \f$ at every s in `step`, from proven stages there.
    [[nodiscard]] vector value(vector const& x, T const& step, stage_set<T> const& k) const {
        auto result = weighted(k.value);
        for (std::size_t s = 0; s < x.size(); ++s) {
            result[s] = arithmetic::add(x[s], arithmetic::mul(step, result[s]));
        }
        return result;
    }
    /// \f$ \phi^{[order]} \f$ at every s in `step`; nothing at a kink or outside the domain.
    /// @param order  at least 1
    [[nodiscard]] std::optional<vector> coefficient(double t, vector const& x, T const& step,
                                                    stage_set<T> const& stages, std::size_t order) {
        auto const k = stages_.expand(t, x, step, stages, order);
        if (!k) return std::nullopt;
        auto result = weighted((*k)[order]);
        auto const before = weighted((*k)[order - 1]);
        for (std::size_t s = 0; s < x.size(); ++s) {
            result[s] = arithmetic::add(arithmetic::mul(step, result[s]), before[s]);
        }
        return result;
    }
    /// The derivative of \f$ \phi(s) \f$ by x and the parameters, n x (n + parameters), by implicit
    /// differentiation: \f$ (1 - s A \otimes J) \partial k = (\partial_x f, \partial_p f) \f$.
    [[nodiscard]] interval_matrix<T> derivative(T const& step, stage_set<T> const& stages) const {
        auto const n = flow_->states();
        auto const columns = n + flow_->parameters();
        auto const entries = flow_->entries().size();
        interval_matrix<T> result(n, columns);
        for (std::size_t c = 0; c < columns; ++c) {
            vector right(b_.size() * n, arithmetic::point(0.0));
            for (std::size_t e = 0; e < entries; ++e) {
                auto const& entry = flow_->entries()[e];
                if (entry.column != c) continue;
                for (std::size_t i = 0; i < b_.size(); ++i) {
                    right[i * n + entry.row] = stages.jacobian[i * entries + e];
                }
            }
            auto const sum = weighted(stages_.solve(step, stages, right));
            for (std::size_t s = 0; s < n; ++s) {
                result(s, c) = arithmetic::add(arithmetic::point(s == c ? 1.0 : 0.0),
                                               arithmetic::mul(step, sum[s]));
            }
        }
        return result;
    }

    /// Value at the end of `step` and the coefficient over all of [0, step], for intervals.
    ///   The stages are proved on pieces of [0, step] that share their ends, where the solution of
    ///   one piece lies in the region of uniqueness of the next: so all are the same branch.
    /// @returns nothing when the stages could not be proved, or are not smooth
    template <class States>
    [[nodiscard]] std::optional<runge_kutta_formula<T>> formula(double t, States const& states,
                                                                T const& step) {
        static constexpr double smallest = 1.0 / 16; // piece of the step
        vector const x(states.begin(), states.end());
        double const end = arithmetic::upper(step);
        auto const at = [&](double s) { return s >= end ? step : arithmetic::point(s); };
        auto const first = stages_.apply(t, x, arithmetic::point(0.0),
                                         vector(b_.size() * x.size(), arithmetic::point(0.0)));
        if (!first) return std::nullopt;
        auto const last = stages_.prove(t, x, step);
        if (!last) return std::nullopt;
        runge_kutta_formula<T> result{value(x, step, *last), {}};
        auto here = *first; // the stages at the begin of the piece
        double from = 0;
        double to = end;
        while (from < end) {
            auto const range = arithmetic::bounds(from, to);
            auto const there = to >= end ? last : stages_.prove(t, x, at(to));
            bool const shortest = to - from < 1.5 * smallest * end;
            std::optional<vector> next;
            if (there) {
                auto const piece = stages_.prove(t, x, range, {here, there->value});
                bool const same = piece && piece->holds(here) && piece->holds(there->value);
                if (same && (shortest || piece->contracts(0.2))) {
                    next = coefficient(t, x, range, *piece, order_ + 1);
                }
            }
            if (!next) {
                if (shortest) return std::nullopt;
                to = from + 0.5 * (to - from);
                continue;
            }
            if (result.next.empty()) {
                result.next = std::move(*next);
            } else {
                for (std::size_t s = 0; s < x.size(); ++s) {
                    result.next[s] = arithmetic::hull(result.next[s], (*next)[s]);
                }
            }
            here = there->value;
            double const length = to - from;
            from = to;
            to = from + 2 * length < end ? from + length : end;
        }
        return result;
    }

private:
    /// \f$ \sum_i b_i k_i \f$
    [[nodiscard]] vector weighted(vector const& k) const {
        auto const n = flow_->states();
        vector result;
        for (std::size_t s = 0; s < n; ++s) {
            typename arithmetic::accumulator sum;
            for (std::size_t i = 0; i < b_.size(); ++i) sum.add_product(b_[i], k[i * n + s]);
            result.push_back(sum.result());
        }
        return result;
    }

    flow const* flow_;
    std::size_t order_;
    implicit_stages<T> stages_;
    vector b_;
};

#ifdef SIVID_COMPILED_ALIKE // its members are compiled once
extern template class implicit_stages<interval>;
#endif

} // namespace sivid

#endif
