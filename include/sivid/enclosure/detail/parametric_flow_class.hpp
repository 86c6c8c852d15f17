// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_DETAIL_PARAMETRIC_FLOW_CLASS_HPP
#define SIVID_ENCLOSURE_DETAIL_PARAMETRIC_FLOW_CLASS_HPP

#include <sivid/enclosure/expansion.hpp>
#include <sivid/enclosure/failure.hpp>
#include <sivid/enclosure/options.hpp>
#include <sivid/enclosure/parametric_set.hpp>
#include <sivid/model/taylor_arithmetic.hpp>
#include <sivid/number/guard.hpp>

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

/// Carries a family of trajectories as Taylor models in its unknowns (see `parametric_set`), one
/// proved step at a time. Stays tight over boxes in which first-order sets blow up.
///
/// One step from t over h, with s in [0,h], E the reach, \f$ x_k, V_k \f$ the Taylor coefficients
/// in time of the solution through P(q) and of the flow's derivative there (the latter over \f$
/// P(q) \pm E \f$), K and L their orders, and b(q, s) a tube:
///   centre  \f$ x(s; P) \in \sum_{k \le K} s^k x_k + s^{K+1} x_{K+1}(b) \f$
///   flow    \f$ V(s) \in \sum_{k<L} s^k V_k + s^L J_L(b) (1 + [-W, W]) \f$
/// and the tube is proved when both images lie strictly inside it.
/// @guarantee  after each successful `step`, for every q and every member of the set before, the
///             solution lies in the set after (same q), and during the step in `swept()`.
/// @tparam N  number of variables, at least that of the unknowns
/// @tparam D  degree of the polynomials
/// @cost  O(nodes K^2 products of degree D in N variables) a step
/// @ref   Makino and Berz 2003 (Taylor models for flows); Kühn 1998 (zonotopes); Zgliczynski 2002
/// (C1)
template <std::size_t N, std::size_t D>
class parametric_flow {
public:
    using set_type = parametric_set<N, D>;
    using polynomial = typename set_type::polynomial;
    using column_entry = typename set_type::column_entry;
    static constexpr std::size_t column_degree = set_type::column_degree;
    static constexpr std::size_t tube_degree = D >= 5 ? 3 : 2;
    using tube_entry = taylor_model<N + 1, tube_degree>;

    parametric_flow(flow const& f, enclosure_options const& options)
        : flow_(&f),
          options_(options),
          centre_(f, options.order + 1, variations::by_state),
          derivative_(f, options.order + 1, variations::by_state),
          tube_(f, options.order + 1, variations::by_state),
          observe_(f.observe(), 0) {
        if (options.order < 1)
            throw std::invalid_argument("enclosure_options: order must be at least 1");
    }

    /// @given  the unknowns have at most N variables (checked)
    void begin(double time, box const& initial, box const& parameters) {
        require_sound_environment();
        if (initial.size() != flow_->states() || parameters.size() != flow_->parameters()) {
            throw std::invalid_argument("parametric_flow: the boxes do not have the model's sizes");
        }
        for (auto const* x : {&initial, &parameters}) {
            for (auto const& side : *x) {
                if (!std::isfinite(mag(side))) {
                    throw std::invalid_argument("parametric_flow: empty or unbounded box");
                }
            }
        }
        unknowns_.emplace(initial, parameters);
        if (unknowns_->variables > N)
            throw std::invalid_argument("parametric_flow: too many unknowns");
        centre_.set_parameters(unknowns_->template parameter_models<N, D>());
        derivative_.set_parameters(unknowns_->template parameter_models<N, column_degree>());
        tube_.set_parameters(unknowns_->template parameter_models<N + 1, tube_degree>());
        observe_.set_parameters(unknowns_->template parameter_models<N, D>());
        set_ = set_type::start(time, *unknowns_);
        swept_.clear();
        failure_.reset();
        steps_ = 0;
        order_ = std::min<std::size_t>(options_.order, 6);
        flow_order_ = 3;
        learned_ = 1;
    }

    /// One proved step, at most to `limit`.
    /// @throws std::invalid_argument when `limit` is not later than `time()`
    [[nodiscard]] bool step(double limit);

    [[nodiscard]] double time() const { return set_.time; }
    [[nodiscard]] set_type const& set() const { return set_; }
    [[nodiscard]] normalised_unknowns const& unknowns() const { return *unknowns_; }
    [[nodiscard]] std::optional<enclosure_failure> const& failure() const { return failure_; }
    [[nodiscard]] std::size_t steps() const { return steps_; }
    [[nodiscard]] flow const& equations() const { return *flow_; }
    /// The outputs at the set's time, as functions of the unknowns.
    [[nodiscard]] std::vector<polynomial> outputs() {
        std::vector<polynomial> x;
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            x.push_back(widened(set_.centre[i], set_.reach[i]));
        }
        auto const t = polynomial::constant(set_.time);
        input_pieces<polynomial> const inputs(*flow_, set_.time, t);
        observe_.start(t);
        observe_.advance(
            0, [&x](std::size_t i, std::size_t) -> polynomial const& { return x[i]; }, inputs);
        std::vector<polynomial> result;
        for (std::size_t y = 0; y < flow_->channels(); ++y) {
            result.push_back(observe_.output(y, 0));
            if (observe_.undefined()) result.back().r = std::numeric_limits<double>::infinity();
        }
        return result;
    }

    /// A box that contains all states during the last proved step; without sides before the first.
    [[nodiscard]] box swept() const {
        box result(swept_.size());
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = range(swept_[i]);
        return result;
    }

private:
    /// Upper bounds of sums of a few dozen non-negative doubles.
    static constexpr double up = 1 + 1e-12;

    [[nodiscard]] double allowed(std::size_t i) const {
        auto const& p = set_.centre[i];
        return options_.tolerance * (1 + std::abs(p.c[0])) +
               options_.relative_tolerance * (p.spread() + set_.reach[i]);
    }
    [[nodiscard]] double propose(double rest) const;
    void adapt_order(double h, bool clamped);
    /// Bounds |V - 1| on the step; false when h is too long for that.
    [[nodiscard]] bool bound_flow(double h, Eigen::MatrixXd const& last, Eigen::MatrixXd& w) const;
    [[nodiscard]] bool try_step(double to, double& shorten, enclosure_failure& why);
    void accept(double to, interval const& h, Eigen::MatrixXd const& w);
    [[nodiscard]] Eigen::MatrixXd sizes(double h, std::size_t from) const;
    [[nodiscard]] bool useful(enclosure_failure& why) const;
    [[nodiscard]] bool fail(enclosure_failure why) {
        why.time = set_.time;
        failure_ = why;
        return false;
    }

    flow const* flow_;
    enclosure_options options_;
    std::optional<normalised_unknowns> unknowns_;
    set_type set_;
    expansion<polynomial> centre_;
    expansion<column_entry> derivative_;
    expansion<tube_entry> tube_;
    series<polynomial> observe_;
    std::vector<tube_entry> tube_box_, lagrange_, swept_;
    bool smooth_ = true;
    bool jumps_ = false;
    std::size_t order_ = 6;      ///< K
    std::size_t flow_order_ = 3; ///< L
    double learned_ = 1;
    std::size_t steps_ = 0;
    std::optional<enclosure_failure> failure_;
};

} // namespace sivid

#endif
