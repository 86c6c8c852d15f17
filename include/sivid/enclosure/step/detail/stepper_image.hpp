// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STEP_DETAIL_STEPPER_IMAGE_HPP
#define SIVID_ENCLOSURE_STEP_DETAIL_STEPPER_IMAGE_HPP

/// @file
/// Where a proved step leads: members of `stepper`.

#include <sivid/enclosure/step/detail/stepper_class.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

template <class I>
void stepper<I>::load(tube_step<I> const& step) {
    I const begin = traits::point(step.from);
    I const times = traits::bounds(step.from, step.to);
    formula_.reset();
    long_map_.reset();
    if (step.dissipative) return;
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
    if (!options_.method || !step.smooth) return taylor;
    // phi(s) + s^(p+1) (x^[p+1](B) - phi^[p+1]([0, s]))
    auto const p = options_.method->order;
    auto const formula = formula_ ? formula_ : apply_method(step.from, step.start.centre, s);
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
    auto const map =
        long_map_ ? long_map_ : long_->map(step.from, to, step.start.centre, step.tube);
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
    if (step.dissipative) return map_long(step, to);
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

} // namespace sivid

#endif
