// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SENSITIVITY_SENSITIVE_FLOW_HPP
#define SIVID_ENCLOSURE_SENSITIVITY_SENSITIVE_FLOW_HPP

#include <sivid/enclosure/series/detail/expansion_tail.hpp>
#include <sivid/enclosure/series/detail/variation_step.hpp>
#include <sivid/enclosure/series/taylor_expansion.hpp>
#include <sivid/enclosure/suggested_degree.hpp>
#include <sivid/enclosure/taylor/parametric_flow.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/space/frame/orthogonal_frame.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// What is not known of the columns of a matrix that linear maps carry along: column c lies within
/// \f$ B [-\rho_c, \rho_c] \f$, with one nearly orthogonal frame B for all columns, so that radii
/// do not wrap from step to step. Radii need no intervals: products of absolute values and bounds
/// of roundings do, in any rounding mode.
/// @ref  Lohner 1987; Zgliczynski 2002 (C1-Lohner); Rump 1999 (midpoint-radius products)
class framed_radii {
    using matrix = Eigen::MatrixXd;

public:
    framed_radii() = default;
    framed_radii(std::size_t n, std::size_t columns)
        : axes_(matrix::Identity(index(n), index(n))),
          radii_(matrix::Zero(index(n), index(columns))) {}

    /// The whole of \f$ \{ A B r_c + d_c \} \f$ for \f$ |A - centre| \le spread \f$,
    /// \f$ |r_c| \le \rho_c, |d_c| \le rest_c \f$, in a new frame.
    /// @param units  powers of two in which rows are measured where the frame is to be orthogonal;
    ///               none: 1
    /// @given  no entry of `spread` and `rest` is negative
    void map(matrix centre, matrix spread, matrix rest, std::vector<double> const& units = {}) {
        auto const n = axes_.rows();
        for (auto* rows : {&centre, &spread, &rest}) {
            for (std::size_t i = 0; i < units.size(); ++i) rows->row(index(i)) /= units[i];
        }
        // Of a product of n by n matrices, in units of the product of the absolute values.
        double const rounding = static_cast<double>(n + 2) * unit;
        std::vector<double> weights(static_cast<std::size_t>(n), 0.0);
        for (Eigen::Index c = 0; c < radii_.cols(); ++c) {
            double const most = radii_.col(c).maxCoeff(); // columns may have units of their own
            for (Eigen::Index i = 0; i < n && most > 0; ++i) {
                auto& w = weights[static_cast<std::size_t>(i)];
                w = std::max(w, radii_(i, c) / most);
            }
        }
        matrix const turned = centre.lazyProduct(axes_);
        matrix axes = orthogonal_axes(turned, weights);
        double excess = distance(axes);
        if (!(excess < 1)) {
            axes = matrix::Identity(n, n);
            excess = 0;
        }
        // |Y|, Y = Q^T A B: what was computed; roundings of Q^T W; those of W = A B, and A's
        // spread. Then |Q^-1 A B| and |Q^-1|.
        matrix const size = axes.transpose().cwiseAbs();
        matrix const doubt = (spread + rounding * centre.cwiseAbs()).lazyProduct(axes_.cwiseAbs());
        matrix along = axes.transpose().lazyProduct(turned).cwiseAbs();
        along += size.lazyProduct(doubt + rounding * turned.cwiseAbs());
        matrix inverse = size;
        for (Eigen::Index j = 0; j < n; ++j) {
            add_excess(along, j, excess);
            add_excess(inverse, j, excess);
        }
        matrix const carried = along.lazyProduct(radii_);
        matrix const added = inverse.lazyProduct(rest);
        for (Eigen::Index c = 0; c < radii_.cols(); ++c) {
            if (is_zero(radii_, c) && is_zero(rest, c)) continue;
            for (Eigen::Index i = 0; i < n; ++i) {
                double const r = (carried(i, c) + added(i, c)) * up + tiny;
                radii_(i, c) = r < largest ? r : infinity; // NaN as well
            }
        }
        for (std::size_t i = 0; i < units.size(); ++i) axes.row(index(i)) *= units[i];
        axes_ = std::move(axes);
    }

    /// A bound of \f$ |B r_c|_i \f$.
    [[nodiscard]] double operator()(std::size_t i, std::size_t c) const {
        if (is_zero(radii_, index(c))) return 0;
        double sum = 0;
        for (Eigen::Index k = 0; k < axes_.rows(); ++k) {
            sum += std::abs(axes_(index(i), k)) * radii_(k, index(c));
        }
        double const r = sum * up + tiny;
        return r < largest ? r : infinity;
    }

private:
    static constexpr double unit = std::numeric_limits<double>::epsilon();
    /// Makes computed sums of a few dozen non-negative numbers upper bounds.
    static constexpr double up = 1 + 1e-12;
    /// More than all underflows, times anything that counts as known.
    static constexpr double tiny = 1e-290;
    static constexpr double largest = 1e300;
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }
    /// d of `enclose_inverse`: \f$ \|Q^{-1} - Q^T\| \f$ relative to \f$ Q^T \f$.
    static double distance(matrix const& q) {
        auto const n = q.rows();
        double const rounding = static_cast<double>(n + 2) * unit;
        matrix const square = q.transpose().lazyProduct(q);
        matrix const sizes = q.transpose().cwiseAbs().lazyProduct(q.cwiseAbs());
        double e = 0;
        for (Eigen::Index i = 0; i < n; ++i) {
            double row = tiny;
            for (Eigen::Index j = 0; j < n; ++j) {
                row += std::abs(square(i, j) - (i == j ? 1.0 : 0.0)) + rounding * sizes(i, j);
            }
            if (!(row < 0.5)) return infinity; // NaN as well
            e = std::max(e, row);
        }
        return 2 * e * up; // e / (1 - e) <= 2 e
    }
    static bool is_zero(matrix const& a, Eigen::Index c) { return (a.col(c).array() == 0).all(); }
    /// Column j of a matrix Y of absolute values becomes that of (1 + F) Y, |F| at most `excess`.
    static void add_excess(matrix& y, Eigen::Index j, double excess) {
        double const more = y.col(j).sum() * excess + tiny;
        for (Eigen::Index i = 0; i < y.rows(); ++i) {
            double const x = (y(i, j) + more) * up;
            // What may have overflowed on the way has left a rounding bound of that size.
            y(i, j) = x < 1e280 ? x : infinity;
        }
    }

    matrix axes_;  ///< B
    matrix radii_; ///< \f$ \rho \f$
};

/// A `parametric_flow` that carries the derivatives of all its trajectories along: for each q,
///   \f$ S(q) = \partial x(t) / \partial (x_0, p) \in K(q) + B R \f$
/// with polynomials K of the states' degree and one orthogonal frame B for what is lost.
///
/// With \f$ V^{[k]} \f$ the coefficients of the flow's derivatives by states and parameters on the
/// set before, \f$ M = V(h) \in \sum_{k<L} h^k V^{[k]} + [-\bar R, \bar R] \f$ encloses the
/// derivatives over the step at every member, and \f$ S' = M_x S + [0, M_p] \f$. \f$ \bar R \f$
/// follows from the sizes of coefficients alone (`expansion_tail`). Where that fails, and at kinks,
/// the tube b(q, s) serves that the step of the flow has left: with J the coefficients of order L
/// on it,
///   \f$ W > \sum_{1 \le k<L} h^k |V^{[k]}| + h^L (|J| + |J_x| W) \f$
/// bounds \f$ |V - [1, 0]| \f$ on the step (docs/theory/taylor_models.md, section 3, (a)), and
///   \f$ M \in \sum_{k<L} h^k V^{[k]} + h^L (J + |J_x| [-W, W]) \f$.
/// Columns: initial states, then parameters, in the model's units (not per unit of q). Across kinks
/// L = 1 and the derivative is Clarke's; across jumps there is none, and the entries say nothing
/// from there on.
/// @guarantee  for every q and every start of the family, the derivative lies in `derivative(i, c)`
///             at that q.
/// @cost  about (n + parameters) / 2 times that of the flow's own derivatives
/// @ref   Zgliczynski 2002 (C1)
template <class Model = taylor_model<double>>
class sensitive_flow {
public:
    using entry = Model;
    using flow_type = parametric_flow<Model>;

    /// @param variables, degree  of the polynomials: see `parametric_flow`
    /// @throws std::invalid_argument for inputs with error bounds: the tubes that bound derivatives
    ///         are those of the recorded inputs
    sensitive_flow(flow const& f, enclosure_options const& options, std::size_t variables,
                   std::size_t degree)
        : flow_(&f),
          options_(options),
          run_(f, options, variables, degree),
          series_(f, options.order + 1, variations::by_state_and_parameter, run_.shape()),
          tube_(f, options.order + 1, variations::by_state_and_parameter, run_.tube_shape()),
          tail_(f, series_),
          observe_(f.observe_jacobian(), 0, run_.shape()),
          parameters_(f.parameters(), entry(run_.shape())),
          tube_parameters_(f.parameters(), entry(run_.tube_shape())),
          around_(f.states()) {
        if (f.uncertain()) {
            throw std::invalid_argument("sensitive_flow: inputs with error bounds are not "
                                        "supported; give signals without bounds");
        }
    }

    /// See `parametric_flow::begin`.
    void begin(double time, box const& initial, box const& parameters) {
        run_.begin(time, initial, parameters);
        auto const n = flow_->states();
        auto const& sides = run_.unknowns().parameters;
        for (std::size_t j = 0; j < sides.size(); ++j) {
            enclosure_detail::put(sides[j], 0, parameters_[j]);
            enclosure_detail::put(sides[j], 0, tube_parameters_[j]);
        }
        series_.set_parameters(parameters_);
        tube_.set_parameters(tube_parameters_);
        observe_.set_parameters(parameters_);
        centre_.assign(n * columns(), entry::constant(0.0));
        for (std::size_t i = 0; i < n; ++i) centre_[i * columns() + i] = entry::constant(1.0);
        rest_ = framed_radii(n, columns());
        exists_ = true;
        order_ = options_.order;
    }

    /// One proved step of states and derivatives, at most to `limit`.
    /// @returns false when the states could not be enclosed any further: `states().failure()`
    [[nodiscard]] bool step(double limit) {
        auto const before = run_.set();
        if (!run_.step(limit)) return false;
        if (exists_) exists_ = follow(before, run_.time());
        return true;
    }

    [[nodiscard]] flow_type const& states() const { return run_; }
    [[nodiscard]] double time() const { return run_.time(); }
    /// Initial states, then parameters.
    [[nodiscard]] std::size_t columns() const { return flow_->states() + flow_->parameters(); }
    /// Whether derivatives exist and are known. They are not after a jump, nor after a step on
    /// which they could not be bounded.
    [[nodiscard]] bool known() const { return exists_; }

    /// \f$ \partial x_i / \partial (x_0, p)_c \f$ as a function of the unknowns.
    [[nodiscard]] entry derivative(std::size_t i, std::size_t c) const {
        double const r = exists_ ? rest_(i, c) : std::numeric_limits<double>::infinity();
        return widened(centre_[i * columns() + c], r);
    }

    /// The channels at the present time, as functions of the unknowns.
    [[nodiscard]] std::vector<entry> outputs() { return run_.outputs(); }
    /// \f$ \partial y / \partial (x_0, p) \f$ of all channels by rows, as functions of the
    /// unknowns.
    [[nodiscard]] std::vector<entry> output_derivatives() {
        auto const n = flow_->states();
        around(run_.set());
        auto const t = entry::constant(run_.time());
        input_pieces<entry> const inputs(*flow_, run_.time(), t);
        observe_.start(t);
        auto const state = [this](std::size_t i, std::size_t) -> entry const& {
            return around_[i];
        };
        observe_.advance_principal(0, state, inputs);
        bool const jumps = observe_.jumped();
        observe_.advance_rest(0, state, inputs);
        bool const unknown = jumps || observe_.undefined() || !exists_;
        std::vector<entry> s;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < columns(); ++c) s.push_back(derivative(i, c));
        }
        std::vector<product_sum<>> sums(flow_->channels() * columns());
        for (auto const& e : flow_->observe_entries()) {
            auto const& d = observe_.output(e.output, 0);
            auto* const row = &sums[e.row * columns()];
            if (e.column >= n) {
                row[e.column].add(d);
                continue;
            }
            for (std::size_t c = 0; c < columns(); ++c) {
                if (flow_->sensitive(e.column, c)) row[c].add(d, s[e.column * columns() + c]);
            }
        }
        std::vector<entry> result;
        for (auto& sum : sums) {
            result.push_back(sum.result());
            if (unknown) result.back().r() = std::numeric_limits<double>::infinity();
        }
        return result;
    }

private:
    static constexpr double up = enclosure_detail::sum_up;

    void around(typename flow_type::set_type const& set) {
        for (std::size_t i = 0; i < set.centre.size(); ++i) {
            around_[i] = widened(set.centre[i], set.reach[i]);
        }
    }

    /// |V - [1, 0]| on a step of length h, by the series up to order L: n x columns.
    [[nodiscard]] std::optional<std::vector<double>> bound(double h, std::size_t L) const {
        using namespace enclosure_detail;
        auto const n = flow_->states();
        auto const m = columns();
        double power = h;
        for (std::size_t k = 1; k < L; ++k) power *= h;
        std::vector<double> w;
        bool const found = bound_variations(variation_sizes(*flow_, series_, m, h, L, 1),
                                            last_variation_sizes(*flow_, tube_, m, power * up, L),
                                            n, 12 + n, true, w);
        return found ? std::optional(std::move(w)) : std::nullopt;
    }

    /// Carries the derivatives over the step that the flow has just proved.
    /// @returns false where they do not exist or could not be bounded
    [[nodiscard]] bool follow(typename flow_type::set_type const& before, double to) {
        double const from = before.time;
        double const length = to - from;                 // off by less than a unit
        double const h = length * (1 + 4 * entry::unit); // not less than the length
        auto const s = run_.within_step(h);              // as in the tube's proof
        auto const times = entry::constant(from) + s;
        around(before);
        std::size_t L = std::clamp<std::size_t>(order_, 1, options_.order);
        std::optional<std::vector<double>> w;
        for (;; L = std::max<std::size_t>(1, L / 2)) {
            series_.expand_with_variations(from, entry::constant(from), around_, L - 1);
            // A sign of parameters alone never changes in time: it is no kink, but still a jump.
            if (L > 1 && tail_.covers() && !series_.undefined() && !series_.kinked() &&
                !series_.jumped() && tail_.bound_variations(series_, h, L)) {
                carry(flow_over_step(nullptr, length, L));
                return true;
            }
            tube_.expand(from, times, run_.swept_models(), L);
            bool const jumps = tube_.jumped();
            bool kinked = L > 1 && (series_.kinked() || tube_.kinked());
            if (L == 1 && jumps) return false;
            if (!kinked && !(L > 1 && jumps)) {
                tube_.add_variations(L);
                if (series_.undefined() || tube_.undefined()) return false;
                kinked = L > 1 && tube_.kinked();
                if (!kinked) w = bound(h, L);
            }
            if (w || L == 1) break;
            if (kinked || jumps) L = 1; // halving would not take the kink away
        }
        if (!w) return false;
        carry(flow_over_step(&*w, length, L));
        return true;
    }

    /// V over a step.
    /// @param w  what `bound` says of the tube; null where `tail_` has bounded V
    /// @param L  its order; `order_` follows the truncation
    [[nodiscard]] std::vector<entry> flow_over_step(std::vector<double> const* w, double length,
                                                    std::size_t L) {
        using namespace enclosure_detail;
        auto const n = flow_->states();
        auto const m = columns();
        std::vector<entry> map(n * m);
        double const power = w ? power_of(length, L) : 1;
        // By columns, each in its own unit: the largest of the rows, in the states' own ranges.
        double worst = 0;
        for (std::size_t c = 0; c < m; ++c) {
            double tail = 0, spread = 0, size = 0;
            for (std::size_t i = 0; i < n; ++i) {
                if (!flow_->sensitive(i, c)) continue;
                auto& over_step = map[i * m + c];
                double rest = 0;
                if (w) {
                    auto const last = last_variation(*flow_, tube_, *w, i, c, L, run_.shape());
                    rest = last.norm() * power;
                    over_step = variation_at_end(series_, last, i, c, L, run_.shape(), length);
                } else {
                    rest = tail_.variation(i, c);
                    over_step = variation_at_end(series_, rest, i, c, L, run_.shape(), length);
                }
                tail = std::max(tail, rest / flow_->own_range(i));
                spread = std::max(spread, over_step.spread() / flow_->own_range(i));
                size = std::max(size, over_step.polynomial_norm() / flow_->own_range(i));
            }
            double const allowed =
                std::max(options_.tolerance * size + options_.relative_tolerance * spread,
                         entry::unit * size);
            if (tail > 0) worst = std::max(worst, tail / allowed);
        }
        // The next step's order follows the truncation, as far as it exceeds a rounding: a
        // preference.
        if (worst > 1) {
            order_ = std::min(options_.order, L + 2);
        } else if (worst < 0.01 && L > 2) {
            order_ = L - 1;
        } else {
            order_ = L;
        }
        return map;
    }

    /// @param map  V over the step
    void carry(std::vector<entry> const& map) {
        auto const n = flow_->states();
        auto const m = columns();
        std::vector<entry> next(n * m);
        auto const rows = static_cast<Eigen::Index>(n);
        Eigen::MatrixXd lost = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(m));
        Eigen::MatrixXd along = Eigen::MatrixXd::Zero(rows, rows);
        Eigen::MatrixXd spread_along = along;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t l = 0; l < n; ++l) {
                if (!flow_->sensitive(i, l)) continue;
                auto const entries = range(map[i * m + l]);
                at(along, i, l) = mid(entries);
                at(spread_along, i, l) = rad(entries);
            }
            for (std::size_t c = 0; c < m; ++c) {
                if (!flow_->sensitive(i, c)) continue;
                product_sum<> sum;
                for (std::size_t l = 0; l < n; ++l) {
                    if (flow_->sensitive(i, l) && flow_->sensitive(l, c))
                        sum.add(map[i * m + l], centre_[l * m + c]);
                }
                if (c >= n) sum.add(map[i * m + c]);
                auto image = sum.result();
                at(lost, i, c) = image.r();
                image.r() = 0;
                next[i * m + c] = std::move(image);
            }
        }
        centre_ = std::move(next);
        std::vector<double> units;
        for (std::size_t i = 0; i < n; ++i) units.push_back(unit_below(flow_->own_range(i)));
        rest_.map(along, spread_along, lost, units);
    }

    static double& at(Eigen::MatrixXd& a, std::size_t i, std::size_t j) {
        return a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }

    flow const* flow_;
    enclosure_options options_;
    flow_type run_;
    expansion<entry> series_;
    expansion<entry> tube_;
    expansion_tail<entry> tail_;
    series<entry> observe_;
    std::vector<entry> parameters_;
    std::vector<entry> tube_parameters_;
    std::vector<entry> around_;
    std::vector<entry> centre_; ///< K, radii 0, n x columns
    framed_radii rest_;         ///< B R
    bool exists_ = false;
    std::size_t order_ = 8; ///< L to try next
};

/// What the channels are at a time, and how they depend on initial states and parameters: functions
/// of the normalised unknowns of a box.
template <class Model = taylor_model<double>>
struct measured_sensitivities {
    double time = 0;
    std::vector<Model> outputs;
    std::vector<Model> derivatives; ///< channels x (n + parameters), by rows

    /// Encloses \f$ \partial y_k / \partial (x_0, p)_c \f$ over the whole box.
    [[nodiscard]] interval over_box(std::size_t k, std::size_t c) const {
        return range(derivatives[k * (derivatives.size() / outputs.size()) + c]);
    }
};

/// Encloses the outputs and their derivatives by initial states and parameters, over boxes of both,
/// at each of the times of measurement.
/// @param times  increasing, none before `begin`
/// @returns one value for each time that was reached; all of them unless `failure` is set
template <class Model = taylor_model<double>>
[[nodiscard]] std::vector<measured_sensitivities<Model>>
sensitivities_at(flow const& f, enclosure_options const& options, box const& initial,
                 box const& parameters, double begin, std::vector<double> const& times,
                 std::optional<enclosure_failure>* failure = nullptr) {
    auto const unknowns = normalised_unknowns(initial, parameters).variables;
    double const end = times.empty() ? begin : times.back();
    sensitive_flow<Model> run(f, for_span(options, end - begin), unknowns,
                              suggested_degree(unknowns));
    run.begin(begin, initial, parameters);
    std::vector<measured_sensitivities<Model>> result;
    for (double const t : times) {
        if (t < run.time())
            throw std::invalid_argument("sensitivities_at: times must increase from the begin; " +
                                        nearest_text(t) + " follows " + nearest_text(run.time()));
        while (run.time() < t) {
            if (run.step(t)) continue;
            if (failure != nullptr) *failure = run.states().failure();
            return result;
        }
        result.push_back({t, run.outputs(), run.output_derivatives()});
    }
    return result;
}

} // namespace sivid

#endif
