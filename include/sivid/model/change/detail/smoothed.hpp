// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CHANGE_DETAIL_SMOOTHED_HPP
#define SIVID_MODEL_CHANGE_DETAIL_SMOOTHED_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/change/detail/with_equations.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A model without kinks, and what that leaves out as inputs of which only a bound is known.
struct smoothed_model {
    recorded_model model;       ///< its further inputs stand behind those of the original
    std::vector<double> bounds; ///< of the modulus of each of these at all times; one for each kink
};

/// Rounds the kinks of a model off. For every x
///   \f$ |x| = \sqrt{x^2 + \epsilon^2} - \epsilon/2 + w, \quad |w| \le \epsilon/2, \f$
/// and min and max are \f$ (a + b \mp |a - b|)/2 \f$. So the trajectories of the original are among
/// those of the result for all measurable inputs w within the bound, and so are its outputs; but
/// the result can be expanded to high orders: near a kink in steps of its distance, and where the
/// argument rests at the kink in long ones. Jumps (`sign`) stay what they are.
/// @param width_of  \f$ \epsilon \f$ for a node with a kink, in the unit of its argument, rounded
///               to a power of two: multiples of it are exact; a millionth of it where no state
///               enters: such an argument is a function of time, not a set, and what its kink
///               leaves open must not make the sets of other kinks wide. A kink stays where the
///               width is not in [1e-100, 1e100]: its square may not be exact
/// @cost  O(nodes)
[[nodiscard]] inline smoothed_model smoothed(recorded_model const& model,
                                             std::function<double(node const&)> const& width_of) {
    smoothed_model result{model, {}};
    auto& about = result.model.about;
    graph made;
    auto const modulus = [&](node_id x, double width, graph& to) {
        double const of_states = std::exp2(std::round(std::log2(width)));
        bool const of_time = (to.depends(x) & on_state) == 0;
        double const epsilon = of_time ? of_states * 0x1p-20 : of_states;
        auto const w = to.leaf(operation::input, about.inputs.size());
        result.bounds.push_back(epsilon / 2);
        about.inputs.push_back({"kink " + std::to_string(result.bounds.size()), ""});
        auto const inner = to.add(to.unary(operation::sqr, x), to.constant(epsilon * epsilon));
        auto const low = to.sub(to.unary(operation::sqrt, inner), to.constant(epsilon / 2));
        return to.add(low, w);
    };
    auto const make = [&](node const& n, node_id a, node_id b, graph& to) {
        bool const binary = n.op == operation::min || n.op == operation::max;
        auto const argument = binary ? to.sub(a, b) : a;
        bool const moves = (to.depends(argument) & (on_time | on_state | on_input)) != 0;
        if (!moves || !(binary || n.op == operation::abs)) return same_operation()(n, a, b, to);
        double const width = width_of(n);
        if (!(width >= 1e-100 && width <= 1e100)) return same_operation()(n, a, b, to);
        auto const size = modulus(argument, width, to);
        if (!binary) return size;
        auto const sum = to.add(a, b);
        auto const twice = n.op == operation::max ? to.add(sum, size) : to.sub(sum, size);
        return to.mul(to.constant(0.5), twice);
    };
    auto outputs = model.rate;
    outputs.insert(outputs.end(), model.observe.begin(), model.observe.end());
    auto const images = copy_into(made, model.g, outputs, same_leaf{}, make);
    auto const rates = images.begin() + static_cast<std::ptrdiff_t>(model.rate.size());
    result.model = with_equations(std::move(result.model), std::move(made), {images.begin(), rates},
                                  {rates, images.end()});
    return result;
}

/// The same with one width for all kinks.
/// @throws std::invalid_argument  for a width beyond [1e-100, 1e100]
[[nodiscard]] inline smoothed_model smoothed(recorded_model const& model, double width) {
    if (!(width >= 1e-100 && width <= 1e100)) {
        throw std::invalid_argument("kinks are rounded off over a width between 1e-100 and 1e100, "
                                    "in the units of their arguments");
    }
    return smoothed(model, [width](node const&) { return width; });
}

/// The same with a share of how large each argument may be, whatever its unit.
/// @param at  what states, constants, inputs and the time may be
[[nodiscard]] inline smoothed_model smoothed(recorded_model const& model, double share,
                                             leaf_ranges const& at) {
    auto outputs = model.rate;
    outputs.insert(outputs.end(), model.observe.begin(), model.observe.end());
    graph_range range(model.g, outputs);
    range.evaluate(at);
    return smoothed(model, [&](node const& n) {
        auto x = range.value(n.a);
        if (n.op != operation::abs) x = interval_traits<interval>::sub(x, range.value(n.b));
        return share * mag(x);
    });
}

} // namespace sivid

#endif
