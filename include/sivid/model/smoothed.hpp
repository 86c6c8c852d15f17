// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_SMOOTHED_HPP
#define SIVID_MODEL_SMOOTHED_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/rewrite.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace sivid {

/// A model without kinks, and what that leaves out as inputs of which only a bound is known.
struct smoothed_model {
    recorded_model model;    ///< its further inputs stand behind those of the original
    std::size_t rounded = 0; ///< how many there are, one for each kink
    double bound = 0;        ///< of the modulus of each, at all times
};

/// Rounds the kinks of a model off. For every x
///   \f$ |x| = \sqrt{x^2 + \epsilon^2} - \epsilon/2 + w, \quad |w| \le \epsilon/2, \f$
/// and min and max are \f$ (a + b \mp |a - b|)/2 \f$. So the trajectories of the original are among
/// those of the result for all measurable inputs w within the bound, and so are its outputs; but
/// the result can be expanded to high orders: near a kink in steps of its distance, and where the
/// argument rests at the kink in long ones. Jumps (`sign`) stay what they are.
/// @param width  \f$ \epsilon > 0 \f$, rounded to a power of two, whose multiples are exact
/// @cost  O(nodes)
[[nodiscard]] inline smoothed_model smoothed(recorded_model const& model, double width) {
    double const epsilon = std::exp2(std::round(std::log2(width)));
    smoothed_model result{model, 0, epsilon / 2};
    auto& made = result.model;
    made.g = graph();
    auto const modulus = [&](node_id x, graph& to) {
        auto const w = to.leaf(operation::input, made.about.inputs.size());
        made.about.inputs.push_back({"kink " + std::to_string(++result.rounded), ""});
        auto const inner = to.add(to.unary(operation::sqr, x), to.constant(epsilon * epsilon));
        auto const low = to.sub(to.unary(operation::sqrt, inner), to.constant(epsilon / 2));
        return to.add(low, w);
    };
    auto const make = [&](node const& n, node_id a, node_id b, graph& to) {
        bool const binary = n.op == operation::min || n.op == operation::max;
        auto const argument = binary ? to.sub(a, b) : a;
        bool const moves = (to.depends(argument) & (on_time | on_state | on_input)) != 0;
        if (!moves || !(binary || n.op == operation::abs)) return same_operation()(n, a, b, to);
        auto const size = modulus(argument, to);
        if (!binary) return size;
        auto const sum = to.add(a, b);
        auto const twice = n.op == operation::max ? to.add(sum, size) : to.sub(sum, size);
        return to.mul(to.constant(0.5), twice);
    };
    auto outputs = model.rate;
    outputs.insert(outputs.end(), model.observe.begin(), model.observe.end());
    auto const same_leaf = [](node const& n, graph& to) {
        return to.leaf(n.op, static_cast<std::size_t>(n.index));
    };
    auto const images = copy_into(made.g, model.g, outputs, same_leaf, make);
    auto image = images.begin();
    for (auto* list : {&made.rate, &made.observe}) {
        for (auto& node : *list) node = *image++;
    }
    for (auto& a : made.added_states) {
        a.at_begin = copy_into(made.g, model.g, {a.at_begin}, same_leaf).front();
    }
    return result;
}

} // namespace sivid

#endif
