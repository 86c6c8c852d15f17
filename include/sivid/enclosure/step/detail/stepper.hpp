// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STEP_DETAIL_STEPPER_HPP
#define SIVID_ENCLOSURE_STEP_DETAIL_STEPPER_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/failure.hpp>
#include <sivid/enclosure/options.hpp>
#include <sivid/enclosure/series/detail/variation_bound.hpp>
#include <sivid/enclosure/series/domain_edge.hpp>
#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/enclosure/set/doubleton.hpp>
#include <sivid/enclosure/step/detail/step_length.hpp>
#include <sivid/enclosure/step/detail/tube_step.hpp>
#include <sivid/enclosure/step/perturbed_step.hpp>
#include <sivid/enclosure/step/step_method.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
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
        method_ = make_step_method<I>(f, options);
    }

    void set_ensemble(ensemble<I> const& e) {
        ensemble_ = &e;
        centre_.set_parameters(point_box<I>(e.parameter_centre));
        start_.set_parameters(e.parameters);
        tube_.set_parameters(e.parameters);
        if (perturbed_) perturbed_->set_parameters(e.parameters);
        if (method_) method_->set_ensemble(e);
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
    /// One search for a step: what its attempts have in common, and what they leave to the next.
    struct search {
        doubleton<I> const& set;
        basic_box<I> const& x; ///< X, its hull
        double limit;
        enclosure_failure& why;
        bool resting;          ///< on a kink, which short steps do not cross
        double proposed;       ///< first length
        double h;              ///< length to try
        bool cut;              ///< by a kink: the length says nothing about smooth steps
        double until;          ///< end of the last attempt
        bool smooth = true;    ///< what to try: false: a set-valued step of first order
        bool unsolved = false; ///< an implicit formula found no solution when it was last tried
        std::size_t start_order = 0;                ///< of the series at X
        std::optional<basic_box<I>> undefined_on{}; ///< in the last attempt

        [[nodiscard]] double end() const { return h >= limit - set.time ? limit : set.time + h; }
        [[nodiscard]] bool crosses(tube_step<I> const& step) const {
            return !step.smooth && !resting;
        }
        void shorten() { h *= reject_factor; }
        /// A kink, or a root of 0, lies in the tube: next a set-valued step of first order.
        void meet_kink() {
            smooth = false;
            cut = true;
        }
    };
    [[nodiscard]] search begin_search(doubleton<I> const& set, basic_box<I> const& x, double limit,
                                      enclosure_failure& why);
    [[nodiscard]] double shortest(search const& at) const {
        return enclosure_detail::shortest_step(options_, at.cut && !at.resting);
    }
    /// The shortest step that brings the set on: it may touch a root of 0.
    [[nodiscard]] double shortest_useful(search const& at) const {
        return start_.steep() ? enclosure_detail::step_off_root(options_) : shortest(at);
    }
    [[nodiscard]] bool worth_trying(search const& at) const;
    [[nodiscard]] tube_step<I> next_step(search const& at) const;
    [[nodiscard]] bool expand_start(search& at, std::size_t order);
    [[nodiscard]] bool prove_step(tube_step<I>& step, search& at);
    [[nodiscard]] bool enclose_roughly(tube_step<I>& step, search& at);
    [[nodiscard]] basic_box<I> tube_image(tube_step<I> const& step, I const& range);
    [[nodiscard]] static bool bounded(I const& x) {
        return traits::mag(x) < std::numeric_limits<double>::max();
    }
    [[nodiscard]] static bool contains(basic_box<I> const& b, basic_box<I> const& image);
    [[nodiscard]] static bool widen(basic_box<I>& b, basic_box<I> const& image,
                                    enclosure_failure& why);
    [[nodiscard]] std::vector<double> allowed_while_crossing(tube_step<I>& step, search const& at);
    [[nodiscard]] bool truncates_little(tube_step<I>& step, search& at);
    void reduce_truncation(tube_step<I> const& step, search& at, double ratio);
    [[nodiscard]] bool solve_stages(tube_step<I> const& step, search& at);
    [[nodiscard]] bool bound_variation_of(tube_step<I>& step, search& at);
    void learn(search const& at, tube_step<I> const& step);
    [[nodiscard]] std::nullopt_t refuse(enclosure_failure& why, failure_reason reason,
                                        doubleton<I> const& set, double until,
                                        basic_box<I> const& tried) const;
    [[nodiscard]] std::size_t steepest_rate() const;
    [[nodiscard]] std::pair<double, std::size_t> estimate(basic_box<I> const& x) const;
    [[nodiscard]] double propose(double limit, double from, basic_box<I> const& x) const;
    [[nodiscard]] std::size_t choose_order(double h, basic_box<I> const& x) const;
    void load(tube_step<I> const& step);
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

    flow const* flow_;
    enclosure_options options_;
    expansion<I> centre_, start_, tube_;
    std::optional<perturbed_step<I>> perturbed_;    ///< where inputs are uncertain
    std::unique_ptr<step_method<I>> method_;        ///< where the options name one
    std::optional<runge_kutta_formula<I>> formula_; ///< of the step that was proved last
    ensemble<I> const* ensemble_ = nullptr;
    basic_box<I> lagrange_;       ///< x^[K](B)
    basic_box<I> tube_lagrange_;  ///< x^[q](B)
    std::vector<double> size_;    ///< of the states of the set; a preference
    double learned_ = 1;          ///< accepted over estimated step length
    std::size_t extra_order_ = 0; ///< what wide sets need above the centre's order
    double near_ = HUGE_VAL;   ///< about the longest step that the neighbourhood of a kink allows
    std::size_t crossing_ = 0; ///< steps of first order since the last smooth one
};

/// The step length at which a coefficient of the centre reaches what is allowed, and its state.
template <class I>
std::pair<double, std::size_t> stepper<I>::estimate(basic_box<I> const& x) const {
    std::pair<double, std::size_t> least{HUGE_VAL, 0};
    std::size_t const top = options_.method ? options_.method->order + 1 : options_.order;
    for (std::size_t k = top > 1 ? top - 1 : 1; k <= top; ++k) {
        for (std::size_t i = 0; i < x.size(); ++i) {
            double const c = traits::mag(centre_.state(i, k));
            if (!(c > 0) || !std::isfinite(c)) continue;
            // The remainder's half-width is a fraction of the coefficient times h^k.
            double const h = enclosure_detail::length_for(allowed(x, i), c, k);
            if (h < least.first) least = {h, i};
        }
    }
    return least;
}

/// Step length from the growth of the centre's coefficients; a preference, no proof rests on it.
template <class I>
double stepper<I>::propose(double limit, double from, basic_box<I> const& x) const {
    double const rest = limit - from;
    double const h = std::min({options_.longest_step(), rest, learned_ * estimate(x).first});
    if (h >= rest) return rest;
    return h > 0.5 * rest ? 0.5 * rest : h; // no tiny last step
}

/// The lowest order whose truncation stays within the tolerance for a step of length h.
template <class I>
std::size_t stepper<I>::choose_order(double h, basic_box<I> const& x) const {
    if (options_.method) return options_.method->order + 1;
    for (std::size_t order = 2; order < options_.order; ++order) {
        bool enough = true;
        for (std::size_t k = order; k <= order + 1 && enough; ++k) {
            for (std::size_t i = 0; i < x.size() && enough; ++i) {
                double const c = traits::mag(centre_.state(i, k));
                enough = c * enclosure_detail::power_of(h, k) <= 0.1 * allowed(x, i);
            }
        }
        if (enough) return std::min(options_.order, order + extra_order_);
    }
    return options_.order;
}

template <class I>
std::optional<tube_step<I>> stepper<I>::prove(doubleton<I> const& set, double limit,
                                              enclosure_failure& why) {
    auto const x = set.hull_and_centre();
    size_ = set.largest;
    for (std::size_t i = 0; i < x.size(); ++i) size_[i] = std::max(size_[i], flow_->small(i));
    why.time = set.time;
    if (method_) {
        std::vector<double> margin(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) margin[i] = allowed(x, i);
        if (auto step = method_->prove_long(set, limit, margin,
                                            [this](tube_step<I>& s) { return perturb(s); }))
            return step;
    }
    centre_.expand(set.time, traits::point(set.time), point_box<I>(set.centre),
                   options_.method ? options_.method->order + 1 : options_.order);
    if (centre_.undefined()) {
        return refuse(why, failure_reason::undefined, set, set.time, point_box<I>(set.centre));
    }
    auto at = begin_search(set, x, limit, why);
    for (int attempt = 0; attempt < 60 && worth_trying(at); ++attempt) {
        at.until = at.end();
        auto step = next_step(at);
        if (!expand_start(at, step.variational_order))
            return refuse(why, failure_reason::undefined, set, set.time, x);
        if (!prove_step(step, at)) continue;
        learn(at, step);
        return step;
    }
    if (!(at.until > set.time)) why.component = estimate(x).second; // too short to be tried
    return refuse(why,
                  at.undefined_on ? failure_reason::undefined
                  : at.unsolved   ? failure_reason::unsolved_stages
                                  : failure_reason::minimum_step,
                  set, at.until, at.undefined_on.value_or(x));
}

template <class I>
typename stepper<I>::search stepper<I>::begin_search(doubleton<I> const& set, basic_box<I> const& x,
                                                     double limit, enclosure_failure& why) {
    double h = propose(limit, set.time, x);
    if (h < enclosure_detail::resting_step(options_)) {
        // Where the set touches a root of 0, the centre's coefficients say nothing of a step.
        start_.expand_with_variations(set.time, traits::point(set.time), x, 1);
        if (start_.steep()) h = std::min(options_.longest_step(), limit - set.time);
    }
    bool const cut = near_ < h;
    if (cut) h = near_;
    return {.set = set,
            .x = x,
            .limit = limit,
            .why = why,
            .resting = crossing_ >= enclosure_detail::crossing_steps,
            .proposed = h,
            .h = h,
            .cut = cut,
            .until = set.time};
}

template <class I>
bool stepper<I>::worth_trying(search const& at) const {
    double const to = at.end();
    return to > at.set.time && !(at.h < shortest(at) && to < at.limit);
}

/// What is to be proved next: from where to where, and by which orders.
template <class I>
tube_step<I> stepper<I>::next_step(search const& at) const {
    tube_step<I> step;
    step.from = at.set.time;
    step.to = at.until;
    step.smooth = at.smooth;
    step.order = at.smooth ? choose_order(at.h, at.x) : 1;
    step.variational_order =
        std::min(step.order, !at.smooth                       ? 1
                             : options_.variational_order > 0 ? options_.variational_order
                             : perturbed_ ? step.order // wide sets even from points
                                          : std::max<std::size_t>(2, (step.order + 1) / 2));
    return step;
}

/// The series at X.
/// @returns whether the rates are defined there
template <class I>
bool stepper<I>::expand_start(search& at, std::size_t order) {
    if (at.start_order != order) {
        at.start_order = order;
        start_.expand_with_variations(at.set.time, traits::point(at.set.time), at.x, order);
    }
    return !start_.undefined() || start_.steep();
}

/// The theorem: B exists, the remainder over it is small enough, an implicit formula has a
/// solution, and V has a bound; then what uncertain inputs add.
/// @returns whether all of it holds; if not, `at` says what to try next
template <class I>
bool stepper<I>::prove_step(tube_step<I>& step, search& at) {
    if (!enclose_roughly(step, at) || !truncates_little(step, at) || !solve_stages(step, at) ||
        !bound_variation_of(step, at))
        return false;
    step.start = at.set;
    if (perturb(step)) return true;
    at.shorten();
    return false;
}

/// The a-priori enclosure B of a step, guessed from the series at X and widened until its image
/// lies in it. Writes `step.tube` and `step.swept`, and leaves in `tube_` the series over B.
template <class I>
bool stepper<I>::enclose_roughly(tube_step<I>& step, search& at) {
    at.undefined_on.reset();
    if (step.smooth && start_.steep()) {
        at.meet_kink();
        return false;
    }
    I const times = traits::bounds(step.from, step.to);
    I const range = traits::bounds(0.0, traits::upper(span(step.from, step.to)));
    auto const q = step.variational_order;
    auto& b = step.tube;
    b = sum(start_, range, q, coefficients(start_, q));
    for (std::size_t i = 0; i < b.size(); ++i) {
        double const room = 0.05 * traits::width(b[i]) + allowed(at.x, i);
        b[i] = traits::add(b[i], traits::bounds(-room, room));
    }
    for (int round = 0; round < 4; ++round) {
        tube_.expand(step.from, times, b, step.order);
        if (tube_.undefined()) {
            at.undefined_on = b;
            break;
        }
        if (step.smooth && step.order > 1 && tube_.kinked()) {
            at.meet_kink();
            return false;
        }
        auto const image = tube_image(step, range);
        if (contains(b, image)) {
            step.swept = intersect(image, b);
            // What the room for the proof adds to a rate, as of a root at 0.
            for (int again = 0; again < 2 && !step.smooth; ++again) {
                b = step.swept;
                tube_.expand(step.from, times, b, step.order);
                step.swept = intersect(tube_image(step, range), b);
            }
            return true;
        }
        if (!widen(b, image, at.why)) break;
    }
    at.shorten();
    at.smooth = true;
    return false;
}

/// \f$ \sum_{k<q} [0,h]^k x^{[k]}(X) + [0,h]^q x^{[q]}(B) \f$, with the series over B in `tube_`.
template <class I>
basic_box<I> stepper<I>::tube_image(tube_step<I> const& step, I const& range) {
    lagrange_ = coefficients(tube_, step.order);
    tube_lagrange_ = coefficients(tube_, step.variational_order);
    return sum(start_, range, step.variational_order, tube_lagrange_);
}

/// Whether an image is bounded and lies in B: then all solutions exist and stay in it.
template <class I>
bool stepper<I>::contains(basic_box<I> const& b, basic_box<I> const& image) {
    for (std::size_t i = 0; i < b.size(); ++i) {
        if (!bounded(image[i]) || !traits::subset(image[i], b[i])) return false;
    }
    return true;
}

/// Widens B about an image that leaves it, and notes the state that leaves it by most.
/// @returns false where the image has no bound
template <class I>
bool stepper<I>::widen(basic_box<I>& b, basic_box<I> const& image, enclosure_failure& why) {
    double worst = 0;
    for (std::size_t i = 0; i < b.size(); ++i) {
        if (!bounded(image[i])) {
            why.component = i;
            return false;
        }
        if (traits::subset(image[i], b[i])) continue;
        double const excess = traits::width(image[i]) / traits::width(b[i]);
        if (excess > worst) {
            worst = excess;
            why.component = i;
        }
        double const room = 0.3 * traits::width(image[i]);
        b[i] = traits::hull(b[i], traits::add(image[i], traits::bounds(-room, room)));
    }
    return true;
}

/// What a step that is to cross a kink may lose. At kinks the first-order error is what it is:
/// there the step only has to be short against the change of the set.
template <class I>
std::vector<double> stepper<I>::allowed_while_crossing(tube_step<I>& step, search const& at) {
    tube_.add_variations(step.variational_order);
    step.jumps = step.jumps || tube_.steep();
    auto const n = flow_->states();
    std::vector<double> crossing(n);
    for (std::size_t i = 0; i < n; ++i) crossing[i] = allowed_at_kink(at.x, i);
    double const length = traits::upper(span(step.from, step.to));
    for (auto const& e : flow_->entries()) {
        if (step.jumps || e.column >= n) continue;
        crossing[e.row] +=
            0.25 * length * traits::mag(tube_.jacobian(e)) * traits::width(at.x[e.column]);
    }
    return crossing;
}

/// Whether the truncation is within the tolerance, or the step too short to be shortened.
template <class I>
bool stepper<I>::truncates_little(tube_step<I>& step, search& at) {
    step.jumps = tube_.jumped();
    std::vector<double> crossing;
    if (at.crosses(step)) crossing = allowed_while_crossing(step, at);
    double const length = traits::upper(span(step.from, step.to));
    double ratio = 0;
    for (std::size_t i = 0; i < flow_->states(); ++i) {
        double const error = scaled_radius(lagrange_[i], length, step.order);
        double const limit = step.smooth  ? allowed(at.x, i)
                             : at.resting ? 1e3 * allowed(at.x, i)
                                          : crossing[i];
        if (error / limit > ratio) {
            ratio = error / limit;
            at.why.component = i;
        }
    }
    bool const short_already =
        at.h <= 4 * shortest_useful(at) ||
        (!step.smooth && at.resting && at.h <= enclosure_detail::resting_step(options_));
    if (!(ratio > 1) || short_already) return true;
    reduce_truncation(step, at, ratio);
    return false;
}

/// The next attempt after a truncation of `ratio` times what is allowed: by a higher order, or
/// shorter.
template <class I>
void stepper<I>::reduce_truncation(tube_step<I> const& step, search& at, double ratio) {
    if (step.smooth && !options_.method && step.order < options_.order && ratio < 1e4) {
        extra_order_ += 2;
        return;
    }
    double const power = 1.0 / static_cast<double>(step.order);
    // At a kink the loss may be in proportion to the length, and stay too large.
    double const shorter =
        at.h * std::clamp(0.9 * std::pow(1 / ratio, power), 0.1, step.smooth ? 0.8 : 0.4);
    at.h = step.smooth ? shorter : std::max(shorter, std::min(at.h, shortest_useful(at)));
    if (at.crosses(step)) at.smooth = true; // a shorter step may miss the kink
}

/// Of an implicit method: its formula over the step.
template <class I>
bool stepper<I>::solve_stages(tube_step<I> const& step, search& at) {
    formula_.reset();
    if (!step.smooth || !method_ || !method_->is_implicit()) return true;
    formula_ = method_->formula(step.from, at.set.centre, span(step.from, step.to));
    at.unsolved = !formula_;
    if (!at.unsolved) return true;
    at.why.component = steepest_rate();
    at.shorten();
    return false;
}

/// Bounds |V - V(0)| over the step, from the series of V over B.
template <class I>
bool stepper<I>::bound_variation_of(tube_step<I>& step, search& at) {
    auto const q = step.variational_order;
    if (!at.crosses(step))
        tube_.expand_with_variations(step.from, traits::bounds(step.from, step.to), step.tube, q);
    bool const steep = tube_.steep();
    step.jumps = step.jumps || steep;
    if (tube_.undefined() && !steep) {
        at.undefined_on = step.tube;
        at.shorten();
        at.smooth = true;
        return false;
    }
    if (step.smooth && (steep || (q > 1 && tube_.kinked()))) {
        at.meet_kink();
        return false;
    }
    double const length = traits::upper(span(step.from, step.to));
    auto variation = steep ? unbounded_variation() : bound_variation(*flow_, tube_, length);
    if (!variation) {
        at.why.component = steepest_rate();
        at.shorten();
        return false;
    }
    step.variation = std::move(*variation);
    return true;
}

/// What a proved step says of the next ones.
template <class I>
void stepper<I>::learn(search const& at, tube_step<I> const& step) {
    crossing_ = step.smooth ? 0 : crossing_ + 1;
    near_ = at.cut ? 4 * at.h : HUGE_VAL;
    // A step that the end of the interval or a kink cut short teaches nothing.
    if (at.cut) return;
    if (at.h < at.proposed) {
        learned_ = std::max(0.05, learned_ * at.h / at.proposed);
    } else if (at.h < 0.5 * (at.limit - at.set.time)) {
        learned_ = std::min(4.0, 1.08 * learned_);
    }
}

/// Says why, in which state, and what is likely to help.
template <class I>
std::nullopt_t stepper<I>::refuse(enclosure_failure& why, failure_reason reason,
                                  doubleton<I> const& set, double until,
                                  basic_box<I> const& tried) const {
    why.reason = reason;
    why.until = until;
    if (reason == failure_reason::undefined) {
        why.note(find_domain_edge<I>(*flow_, set.time, traits::bounds(set.time, until), tried,
                                     ensemble_->parameters));
    }
    complete(why, set, *ensemble_);
    return std::nullopt;
}

/// The state whose rate has the steepest slopes on the set.
template <class I>
std::size_t stepper<I>::steepest_rate() const {
    std::vector<double> slope(flow_->states(), 0.0);
    for (auto const& e : flow_->entries()) {
        if (e.column >= slope.size()) continue;
        double const size = traits::mag(start_.jacobian(e));
        slope[e.row] += size >= 0 ? size : HUGE_VAL; // NaN: nothing is known
    }
    return static_cast<std::size_t>(std::max_element(slope.begin(), slope.end()) - slope.begin());
}

template <class I>
bool stepper<I>::perturb(tube_step<I>& step) {
    if (!perturbed_) return true;
    I const times = traits::bounds(step.from, step.to);
    if (!perturbed_->prove(step.from, step.to, times, step.tube, true)) return false;
    step.perturbation = perturbed_->law();
    auto const& away = perturbed_->largest();
    for (std::size_t i = 0; i < away.size(); ++i) {
        step.swept[i] = traits::add(step.swept[i], traits::bounds(-away[i], away[i]));
    }
    return true;
}

// Where a proved step leads.

template <class I>
void stepper<I>::load(tube_step<I> const& step) {
    I const begin = traits::point(step.from);
    I const times = traits::bounds(step.from, step.to);
    formula_.reset();
    if (step.long_map) return;
    centre_.expand(step.from, begin, point_box<I>(step.start.centre), step.order);
    start_.expand_with_variations(step.from, begin, step.start.hull_and_centre(),
                                  step.variational_order);
    tube_.expand(step.from, times, step.tube, step.order);
    lagrange_ = coefficients(tube_, step.order);
    tube_lagrange_ = coefficients(tube_, step.variational_order);
    tube_.expand_with_variations(step.from, times, step.tube, step.variational_order);
}

template <class I>
basic_box<I> stepper<I>::centre_image(tube_step<I> const& step, I const& s) {
    auto taylor = sum(centre_, s, step.order, lagrange_);
    if (!method_ || !step.smooth) return taylor;
    // phi(s) + s^(p+1) (x^[p+1](B) - phi^[p+1]([0, s]))
    auto const p = options_.method->order;
    auto const formula = formula_ ? formula_ : method_->formula(step.from, step.start.centre, s);
    // A stage may leave the domain although the solution does not: the series then stands alone.
    if (!formula) return taylor;
    typename traits::mask ignored{};
    auto const power = traits::pown(s, static_cast<int>(p + 1), ignored);
    basic_box<I> image(taylor.size());
    for (std::size_t i = 0; i < image.size(); ++i) {
        auto const error = traits::sub(lagrange_[i], formula->next[i]);
        image[i] = traits::add(formula->value[i], traits::mul(power, error));
    }
    return image;
}

/// A set that starts anew from a box: what it knew of the ensemble is lost.
template <class I>
doubleton<I> stepper<I>::restarted(double to, basic_box<I> const& x,
                                   std::vector<double> const& largest) const {
    auto next = doubleton<I>::start(to, x, flow_->parameters());
    next.largest = largest;
    next.note_sizes(x);
    next.shape.setZero();
    next.remainder = subtract(x, next.centre);
    return next;
}

template <class I>
doubleton<I> stepper<I>::map_long(tube_step<I> const& step, double to) {
    auto const map = to == step.to ? std::optional(*step.long_map) : method_->map_long(step, to);
    auto const direct = perturbed(step, to, step.tube);
    if (!map) return restarted(to, direct, step.start.largest);
    return step.start.mapped(to, perturbed(step, to, map->image), map->derivative, direct,
                             ensemble_->deviation);
}

template <class I>
basic_box<I> stepper<I>::perturbed(tube_step<I> const& step, double to, basic_box<I> x) const {
    if (!step.perturbation) return x;
    auto const away =
        step.perturbation->deviation(input_errors(*flow_, step.from, step.from),
                                     input_errors(*flow_, step.from, to), to - step.from);
    for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = traits::add(x[i], traits::bounds(-away[i], away[i]));
    }
    return x;
}

template <class I>
interval_matrix<I> stepper<I>::flow_derivative(tube_step<I> const& step, I const& s) {
    auto const n = flow_->states();
    auto const columns = n + flow_->parameters();
    auto const q = step.variational_order;
    interval_matrix<I> j(n, columns);
    I power = traits::point(1.0);
    for (std::size_t k = 0; k < q; ++k) power = traits::mul(power, s);
    auto const w = [&](std::size_t i, std::size_t c) {
        double const e = step.variation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c));
        return traits::add(traits::point(i == c ? 1.0 : 0.0), traits::bounds(-e, e));
    };
    for (std::size_t c = 0; c < columns; ++c) {
        for (std::size_t i = 0; i < n; ++i) {
            if (!flow_->sensitive(i, c)) continue;
            // J_q(B) W: the q-th coefficient of the variational equation from any V in W.
            I last = c >= n ? tube_.variation(i, c, q) : traits::point(0.0);
            for (std::size_t l = 0; l < n; ++l) {
                if (!flow_->sensitive(i, l)) continue;
                last = traits::add(last, traits::mul(tube_.variation(i, l, q), w(l, c)));
            }
            I value = traits::mul(power, last);
            I polynomial = traits::point(0.0);
            for (std::size_t k = q; k-- > 0;) {
                polynomial = traits::add(start_.variation(i, c, k), traits::mul(s, polynomial));
            }
            j(i, c) = traits::add(polynomial, value);
        }
    }
    return j;
}

template <class I>
doubleton<I> stepper<I>::map(tube_step<I> const& step, double to) {
    if (step.long_map) return map_long(step, to);
    I const s = span(step.from, to);
    auto const& deviation = ensemble_->deviation;
    auto const direct = perturbed(
        step, to, intersect(sum(start_, s, step.variational_order, tube_lagrange_), step.tube));
    if (step.jumps) {
        // No derivative exists across a jump.
        return restarted(to, direct, step.start.largest);
    }
    return step.start.mapped(to, perturbed(step, to, centre_image(step, s)),
                             flow_derivative(step, s), direct, deviation);
}

#ifdef SIVID_COMPILED_ALIKE // its members are compiled once
extern template class stepper<interval>;
#endif

} // namespace sivid

#endif
