// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_RUNGE_KUTTA_CLASS_HPP
#define SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_RUNGE_KUTTA_CLASS_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/failure.hpp>
#include <sivid/enclosure/options.hpp>
#include <sivid/enclosure/runge_kutta/implicit_runge_kutta.hpp>
#include <sivid/enclosure/runge_kutta/runge_kutta.hpp>
#include <sivid/enclosure/series/detail/variation_step.hpp>
#include <sivid/enclosure/series/domain_edge.hpp>
#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/enclosure/set/parametric_set.hpp>
#include <sivid/enclosure/step/perturbed_step.hpp>
#include <sivid/model/series/taylor_arithmetic.hpp>
#include <sivid/number/guard.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// Carries a family of trajectories as Taylor models in its unknowns, its centre by a Runge-Kutta
/// method of order p, explicit or implicit, in polynomials:
///   centre  \f$ \phi(h; P) + h^{p+1} ( x_{p+1}(b) - \phi_{p+1}([0,h]; P) ) \f$
///   flow    \f$ V(s) \in \sum_{k<L} s^k V_k + s^L J_L(b) (1 + [-W, W]) \f$
/// The tube b is proved with the series of the solution, as in `parametric_flow`; the stages of an
/// implicit method by a Krawczyk operator that holds for every value of the unknowns.
/// Smooth models only: a step whose tube touches a kink is not taken.
/// @guarantee  after each successful `step`, for every q and every member of the set before, the
///             solution lies in the set after (same q), and during the step in `swept()`.
/// @ref  docs/runge_kutta.md
template <class Model = taylor_model<double>>
class parametric_runge_kutta {
public:
    using polynomial = Model;
    using set_type = parametric_set<polynomial>;
    using shape_type = typename polynomial::shape_type;

    /// @param variables  at least as many as the unknowns
    /// @param degree     of the polynomials
    /// @throws std::invalid_argument when the options name no method
    parametric_runge_kutta(flow const& f, enclosure_options const& options, std::size_t variables,
                           std::size_t degree)
        : flow_(&f),
          options_(options),
          shape_(&shape_type::of(variables, degree)),
          column_shape_(&shape_type::of(variables, (degree + 1) / 2)),
          tube_shape_(&shape_type::of(variables + 1, degree >= 5 ? 3 : 2)),
          order_(order_of(options)),
          flow_order_(std::max<std::size_t>(2, (order_ + 2) / 2)),
          set_(f.states(), *shape_),
          centre_(f, order_ + 1, variations::by_state, *shape_),
          derivative_(f, order_ + 1, variations::by_state, *column_shape_),
          tube_(f, order_ + 1, variations::by_state, *tube_shape_) {
        if (options.method->is_explicit()) {
            explicit_value_.emplace(f, *options.method, *shape_);
            explicit_next_.emplace(f, *options.method, *tube_shape_);
        } else {
            implicit_value_.emplace(f, *options.method, *shape_);
            implicit_next_.emplace(f, *options.method, *tube_shape_);
        }
        if (f.uncertain()) perturbed_.emplace(f, *tube_shape_);
        disturbed_.resize(f.states());
    }

    /// @given  the unknowns have at most as many variables as the flow (checked)
    void begin(double time, box const& initial, box const& parameters);

    /// Goes on from what `set()` was at some step of the same family.
    /// @given  `begin` for that family (trusted)
    void resume(set_type const& set) { set_ = set; }

    /// One proved step, at most to `limit`.
    /// @throws std::invalid_argument when `limit` is not later than `time()`
    [[nodiscard]] bool step(double limit);

    [[nodiscard]] double time() const { return set_.time; }
    [[nodiscard]] set_type const& set() const { return set_; }
    [[nodiscard]] normalised_unknowns const& unknowns() const { return *unknowns_; }
    [[nodiscard]] std::optional<enclosure_failure> const& failure() const { return failure_; }
    [[nodiscard]] std::size_t steps() const { return steps_; }
    /// A box that contains all states during the last proved step.
    [[nodiscard]] box swept() const {
        box result(swept_.size());
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = range(swept_[i]);
        return result;
    }

private:
    static constexpr double up = enclosure_detail::sum_up;

    [[nodiscard]] static std::size_t order_of(enclosure_options const& options) {
        if (!options.method) {
            throw std::invalid_argument("parametric_runge_kutta: the options name no method");
        }
        return options.method->order;
    }
    [[nodiscard]] double allowed(std::size_t i) const {
        auto const& p = set_.centre[i];
        return options_.tolerance * (1 + std::abs(p.c(0))) +
               options_.relative_tolerance * (p.spread() + set_.reach[i]);
    }
    [[nodiscard]] std::vector<polynomial> parameter_models(shape_type const& shape) const {
        std::vector<polynomial> models;
        for (auto const& s : unknowns_->parameters) {
            enclosure_detail::put(s, 0, models.emplace_back(shape));
        }
        return models;
    }
    /// \f$ h (1 + \tau) / 2 \f$, as the tube has it.
    [[nodiscard]] polynomial within_step(double half) const {
        return polynomial::variable(*tube_shape_, tube_shape_->variables - 1, half, half);
    }
    /// The step length at which a coefficient reaches what is allowed, and its state.
    [[nodiscard]] std::pair<double, std::size_t> estimate() const {
        std::pair<double, std::size_t> least{HUGE_VAL, 0};
        for (std::size_t k = std::max<std::size_t>(order_, 2) - 1; k <= order_; ++k) {
            for (std::size_t i = 0; i < set_.centre.size(); ++i) {
                double const c = centre_.state(i, k).norm();
                if (!(c > 0) || !std::isfinite(c)) continue;
                double const h = std::pow(allowed(i) / c, 1.0 / static_cast<double>(k));
                if (h < least.first) least = {h, i};
            }
        }
        return least;
    }
    [[nodiscard]] double propose(double rest) const;
    /// The state whose row of the derivative of the step grows most.
    [[nodiscard]] std::size_t steepest(std::vector<double> const& base,
                                       std::vector<double> const& last) const {
        std::size_t const n = flow_->states();
        std::vector<double> rows(n, 0.0);
        for (std::size_t k = 0; k < base.size(); ++k) rows[k / n] += base[k] + last[k];
        for (auto& x : rows) x = std::isnan(x) ? HUGE_VAL : x;
        return static_cast<std::size_t>(std::max_element(rows.begin(), rows.end()) - rows.begin());
    }
    /// Proves the tube and what the method needs on it; `shorten` is for the next attempt.
    [[nodiscard]] bool try_step(double to, double& shorten, enclosure_failure& why);
    /// The method's value at h and its coefficient p + 1 at all times of the step.
    [[nodiscard]] bool apply_method(interval const& h);
    void accept(double to, interval const& h, std::vector<double> const& w);
    [[nodiscard]] bool useful(enclosure_failure& why) const;
    [[nodiscard]] bool fail(enclosure_failure why) {
        complete(why, set_, 0, *unknowns_);
        failure_ = why;
        return false;
    }
    /// What is not defined for some states.
    [[nodiscard]] std::optional<domain_edge> edge(shape_type const& shape, polynomial const& times,
                                                  std::vector<polynomial> const& x) const {
        return find_domain_edge(
            *flow_, set_.time, times, x, parameter_models(shape), [](bool flag) { return flag; },
            [](polynomial const& a) {
                auto const b = rough_bounds(a);
                return std::pair{b.lower, b.upper};
            });
    }

    flow const* flow_;
    enclosure_options options_;
    shape_type const *shape_, *column_shape_, *tube_shape_;
    std::size_t order_;      ///< p
    std::size_t flow_order_; ///< L
    std::optional<normalised_unknowns> unknowns_;
    set_type set_;
    expansion<polynomial> centre_;
    expansion<polynomial> derivative_;
    expansion<polynomial> tube_;
    std::optional<runge_kutta<polynomial>> explicit_value_;
    std::optional<runge_kutta<polynomial>> explicit_next_;
    std::optional<implicit_runge_kutta<polynomial>> implicit_value_;
    std::optional<implicit_runge_kutta<polynomial>> implicit_next_;
    std::optional<perturbed_step<polynomial>> perturbed_; ///< where inputs are uncertain
    std::vector<double> disturbed_; ///< about how much of the reach they cause; a preference
    std::vector<polynomial> value_; ///< phi(h; P)
    std::vector<polynomial> next_;  ///< phi_{p+1}
    std::vector<polynomial> tube_box_, swept_;
    double learned_ = 1;
    std::size_t steps_ = 0;
    std::optional<enclosure_failure> failure_;
};

#ifdef SIVID_COMPILED // its members are compiled once
extern template class parametric_runge_kutta<taylor_model<double>>;
extern template class implicit_stages<taylor_model<double>>;
#endif

} // namespace sivid

#endif
