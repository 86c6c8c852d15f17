// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STEP_DETAIL_STEPPER_CLASS_HPP
#define SIVID_ENCLOSURE_STEP_DETAIL_STEPPER_CLASS_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/failure.hpp>
#include <sivid/enclosure/options.hpp>
#include <sivid/enclosure/runge_kutta/implicit_runge_kutta.hpp>
#include <sivid/enclosure/runge_kutta/runge_kutta.hpp>
#include <sivid/enclosure/series/detail/variation_bound.hpp>
#include <sivid/enclosure/series/domain_edge.hpp>
#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/enclosure/set/doubleton.hpp>
#include <sivid/enclosure/step/detail/kink_steps.hpp>
#include <sivid/enclosure/step/detail/step_length.hpp>
#include <sivid/enclosure/step/detail/tube_step.hpp>
#include <sivid/enclosure/step/perturbed_step.hpp>
#include <sivid/enclosure/stiff/detail/dissipative_step.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// Proves steps of x' = f(t, x, p, u) for a family of trajectories, and maps its set along them.
///   A-priori enclosure: B with
///   \f$ \sum_{k<q} [0,h]^k x^{[k]}(X) + [0,h]^q x^{[q]}(B) \subset B \f$ (existence on [0, h]);
///   centre: \f$ \sum_{k<K} s^k x^{[k]}(m) + s^K x^{[K]}(B) \f$, or a Runge-Kutta formula;
///   derivative: \f$ \sum_{k<q} s^k V^{[k]}(X) + s^q (J_q(B) W) \f$, W an enclosure of V on [0, h].
/// Inputs with error bounds: all this is done for the recorded ones, and the images are widened by
/// what the others may add (see `perturbed_step`).
/// @guarantee  what `prove` returns is proved; a refusal says why.
/// @ref  Nedialkov, Jackson and Corliss 1999 (high-order enclosure); Lohner 1987; Zgliczynski 2002
///       (C1-Lohner). The factor W in the Lagrange term of V is not to be dropped: V is not 1 at
///       the intermediate time.
template <class I>
class stepper {
    using traits = arithmetic_of<I>;

public:
    stepper(flow const& f, enclosure_options const& options)
        : flow_(&f),
          options_(options),
          centre_(f, highest(options)),
          start_(f, highest(options)),
          tube_(f, highest(options)) {
        if (f.uncertain()) perturbed_.emplace(f);
        if (!options.method) return;
        if (options.method->is_explicit()) {
            method_.emplace(f, *options.method);
        } else {
            implicit_.emplace(f, *options.method);
            long_.emplace(f, *options.method);
        }
    }

    void set_ensemble(ensemble<I> const& e) {
        ensemble_ = &e;
        auto const centre = point_box<I>(e.parameter_centre);
        centre_.set_parameters(centre);
        start_.set_parameters(e.parameters);
        tube_.set_parameters(e.parameters);
        if (perturbed_) perturbed_->set_parameters(e.parameters);
        if (method_) method_->set_parameters(centre);
        if (implicit_) implicit_->set_parameters(centre);
        if (long_) long_->set_parameters(e.parameters, e.parameter_centre);
        long_length_ = options_.longest_step();
        long_pause_ = 0;
        learned_ = 1;
        near_ = HUGE_VAL;
        crossing_ = 0;
        extra_order_ = 0;
    }

    /// Proves a step from `set` that ends at `limit` or before.
    /// @param limit  later than the set's time, at most the next knot of a sampled input
    [[nodiscard]] std::optional<tube_step<I>> prove(doubleton<I> const& set, double limit,
                                                    enclosure_failure& why);

    /// The set at a time in (from, to] of a proved step.
    [[nodiscard]] doubleton<I> advance(tube_step<I> const& step, double to) {
        load(step);
        return map(step, to);
    }
    /// The set at the end of the step that was proved last.
    [[nodiscard]] doubleton<I> finish(tube_step<I> const& step) { return map(step, step.to); }

private:
    static constexpr double reject_factor = 0.5;

    /// @throws std::invalid_argument for order 0
    [[nodiscard]] static std::size_t highest(enclosure_options const& options) {
        if (options.order < 1)
            throw std::invalid_argument("enclosure_options: order must be at least 1");
        return std::max(options.order, options.method ? options.method->order + 1 : 0) + 1;
    }

    [[nodiscard]] I span(double from, double to) const {
        return traits::sub(traits::point(to), traits::point(from));
    }
    [[nodiscard]] double allowed(basic_box<I> const& x, std::size_t i) const {
        return options_.tolerance * size_[i] + options_.relative_tolerance * traits::width(x[i]);
    }
    /// What a step across a kink may lose: a small share of what the set spans, besides what is
    /// lost anyway since the slopes differ on its two sides.
    [[nodiscard]] double allowed_at_kink(basic_box<I> const& x, std::size_t i) const {
        return 10 * options_.tolerance * size_[i] +
               enclosure_detail::kink_share(options_) * traits::width(x[i]);
    }
    /// \f$ \sum_{k<order} s^k x_i^{[k]} + s^{order} last_i \f$ by Horner's rule.
    [[nodiscard]] static basic_box<I> sum(expansion<I> const& e, I const& s, std::size_t order,
                                          basic_box<I> const& last) {
        basic_box<I> result(last.size());
        for (std::size_t i = 0; i < last.size(); ++i) {
            I value = last[i];
            for (std::size_t k = order; k-- > 0;) {
                value = traits::add(e.state(i, k), traits::mul(s, value));
            }
            result[i] = value;
        }
        return result;
    }
    [[nodiscard]] basic_box<I> coefficients(expansion<I> const& e, std::size_t k) const {
        basic_box<I> result(flow_->states());
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = e.state(i, k);
        return result;
    }
    /// Half-width of s^k c, per state.
    [[nodiscard]] static double scaled_radius(I const& c, double h, std::size_t k) {
        return traits::rad(c) * enclosure_detail::power_of(h, k);
    }

    /// Where V has no bound, or needs none.
    [[nodiscard]] std::optional<Eigen::MatrixXd> unbounded_variation() const {
        return Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(flow_->states()),
                                         static_cast<Eigen::Index>(ensemble_->deviation.size()),
                                         HUGE_VAL);
    }
    [[nodiscard]] std::nullopt_t refuse(enclosure_failure& why, failure_reason reason,
                                        doubleton<I> const& set, double until,
                                        basic_box<I> const& tried) const;
    [[nodiscard]] std::size_t steepest_rate() const;
    [[nodiscard]] std::pair<double, std::size_t> estimate(basic_box<I> const& x) const;
    [[nodiscard]] double propose(double limit, double from, basic_box<I> const& x) const;
    [[nodiscard]] std::size_t choose_order(double h, basic_box<I> const& x) const;
    void load(tube_step<I> const& step);
    /// Implicit methods: a step that is long against the problem's time constants, if there is one.
    [[nodiscard]] std::optional<tube_step<I>> prove_long(doubleton<I> const& set, double limit);
    [[nodiscard]] doubleton<I> map_long(tube_step<I> const& step, double to);
    [[nodiscard]] doubleton<I> restarted(double to, basic_box<I> const& x,
                                         std::vector<double> const& largest) const;
    [[nodiscard]] doubleton<I> map(tube_step<I> const& step, double to);
    /// Of a smooth or kinked step whose series are loaded.
    [[nodiscard]] interval_matrix<I> flow_derivative(tube_step<I> const& step, I const& s);
    /// Uncertain inputs: bounds their share of a step that is proved without it.
    [[nodiscard]] bool perturb(tube_step<I>& step);
    /// A box at a time of a proved step, widened by that share.
    [[nodiscard]] basic_box<I> perturbed(tube_step<I> const& step, double to, basic_box<I> x) const;
    [[nodiscard]] basic_box<I> centre_image(tube_step<I> const& step, I const& s);
    /// What the Runge-Kutta method says of a step of length s from the centre of the set.
    [[nodiscard]] std::optional<runge_kutta_formula<I>>
    apply_method(double from, std::vector<double> const& m, I const& s) {
        if (method_) return method_->formula(from, point_box<I>(m), s);
        if (implicit_) return implicit_->formula(from, point_box<I>(m), s);
        return std::nullopt;
    }

    flow const* flow_;
    enclosure_options options_;
    expansion<I> centre_, start_, tube_;
    std::optional<perturbed_step<I>> perturbed_; ///< where inputs are uncertain
    std::optional<runge_kutta<I>> method_;       ///< at most one of the two
    std::optional<implicit_runge_kutta<I>> implicit_;
    std::optional<runge_kutta_formula<I>> formula_; ///< of the step that was proved last
    std::optional<dissipative_step<I>> long_;
    std::optional<step_map<I>> long_map_; ///< of the long step that was proved last
    double long_length_ = 1;
    int long_pause_ = 0; ///< steps until long ones are tried again
    ensemble<I> const* ensemble_ = nullptr;
    basic_box<I> lagrange_;       ///< x^[K](B)
    basic_box<I> tube_lagrange_;  ///< x^[q](B)
    std::vector<double> size_;    ///< of the states of the set; a preference
    double learned_ = 1;          ///< accepted over estimated step length
    std::size_t extra_order_ = 0; ///< what wide sets need above the centre's order
    double near_ = HUGE_VAL;   ///< about the longest step that the neighbourhood of a kink allows
    std::size_t crossing_ = 0; ///< steps of first order since the last smooth one
};

#ifdef SIVID_COMPILED // its members are compiled once
extern template class stepper<interval>;
#endif

} // namespace sivid

#endif
