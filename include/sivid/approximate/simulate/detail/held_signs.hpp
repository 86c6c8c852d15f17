// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_DETAIL_HELD_SIGNS_HPP
#define SIVID_APPROXIMATE_SIMULATE_DETAIL_HELD_SIGNS_HPP

#include <sivid/model/change/detail/freed_signs.hpp>
#include <sivid/model/change/detail/with_equations.hpp>
#include <sivid/model/graph/graph_range.hpp>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// Half the width of a layer about y = 0: a small share of |y|, with states within their own
/// ranges; of 1 where that has no bound.
[[nodiscard]] inline double layer_of(recorded_model const& model, freed_signs const& freed,
                                     node_id y) {
    using traits = interval_traits<interval>;
    auto const& about = model.about;
    leaf_ranges at{traits::point(0), box(about.states.size()), box(about.constants.size()),
                   box(about.inputs.size() + freed.signs().size())};
    for (std::size_t i = 0; i < about.states.size(); ++i)
        at.states[i] = traits::bounds(-about.states[i].limit, about.states[i].limit);
    for (std::size_t i = 0; i < about.constants.size(); ++i)
        at.constants[i] = traits::point(about.constants[i].nominal.nearest);
    for (std::size_t i = 0; i < at.inputs.size(); ++i) at.inputs[i] = traits::bounds(-1, 1);
    graph_range range(freed.nodes(), {y});
    range.evaluate(at);
    double const most = mag(range.value(y));
    // Ranges are generous: of 30 rad/s, 1.5 mrad/s; a lever of `benchmarks/simulator` is carried
    // through it in steps of a millisecond.
    return 5e-5 * (std::isfinite(most) && most > 0 ? most : 1);
}

/// A model in which sign(y), where y depends on states, is what a simulation in doubles can follow
/// and what has a slope for fits. With y' = a - b sign(y), and H half the width of a layer,
///   \f$ \mathrm{sign}(y) \to c(c(a/b) + y/H), \quad c(s) = \max(-1, \min(1, s)). \f$
/// Beyond the layer that is the sign. Within it, where b > |a|, y' = -b y/H: what sticks rests,
/// while a smoothed sign, y/sqrt(y^2 + H^2), lets it creep by H a/b. Several signs that act on
/// each other take one another's plain c(y/H) first, and creep by a part of H.
/// @returns  the model as it is where nothing in it jumps
/// @cost  O(signs * nodes)
[[nodiscard]] inline recorded_model with_held_signs(recorded_model const& model) {
    freed_signs freed(model);
    if (freed.signs().empty()) return model;
    graph to;
    std::vector<node_id> held;
    auto const copy = [&](node_id i) {
        return freed.copy(to, {i}, [&](std::size_t k, graph&) { return held[k]; })[0];
    };
    auto const clamped = [&](node_id x) {
        return to.binary(operation::max, to.constant(-1.0),
                         to.binary(operation::min, to.constant(1.0), x));
    };
    auto const signs = freed.signs();
    std::vector<node_id> layers; // y/H
    for (auto const& s : signs) {
        layers.push_back(
            to.mul(to.constant(1 / layer_of(model, freed, s.argument)), copy(s.argument)));
        held.push_back(clamped(layers.back()));
    }
    for (std::size_t k = 0; k < signs.size(); ++k) {
        auto& g = freed.nodes();
        auto const rate = freed.rate_of(signs[k]);
        auto const b = g.neg(freed.slopes({rate}, signs[k])[0]);
        auto const a = g.add(rate, g.mul(b, signs[k].leaf));
        // a/b that is finite where b is 0, and has finite slopes there
        auto const square = [&](node_id x) { return g.unary(operation::sqr, x); };
        auto const some = g.add(square(b), g.mul(g.constant(1e-12), square(a)));
        auto const resting = g.div(g.mul(a, b), g.add(some, g.constant(1e-300)));
        held[k] = clamped(to.add(clamped(copy(resting)), layers[k]));
    }
    auto const& all = freed.outputs();
    auto const images = freed.copy(to, all, [&](std::size_t k, graph&) { return held[k]; });
    auto const rates = static_cast<std::ptrdiff_t>(model.rate.size());
    return with_equations(model, std::move(to), {images.begin(), images.begin() + rates},
                          {images.begin() + rates, images.end()});
}

} // namespace sivid

#endif
