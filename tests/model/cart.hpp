// SPDX-License-Identifier: MIT
// A cart for tests of effects, and what an equation with effects comes to.
#ifndef SIVID_TESTS_MODEL_CART_HPP
#define SIVID_TESTS_MODEL_CART_HPP

#include <sivid/model/effect.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace model_support {

using namespace sivid;

/// x' = c u, w' = x; y = x, z = w
struct cart {
    static constexpr auto name = "cart";
    static constexpr auto states = sivid::states({{"x", "m/s", 5}, {"w", "m", 5}});
    static constexpr auto inputs = sivid::inputs({{"u", "N"}});
    static constexpr auto channels = sivid::channels({{"y", "m/s"}, {"z", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"c", "1/kg", 2_dec}});
    }();
    template <class T>
    states_of<cart, T> rate(T const&, states_of<cart, T> const& x, constants_of<cart, T> const& c,
                            inputs_of<cart, T> const& u) const {
        return {c[0] * u[0], x[0]};
    }
    template <class T>
    channels_of<cart, T> observe(T const&, states_of<cart, T> const& x,
                                 constants_of<cart, T> const&, inputs_of<cart, T> const&) const {
        return {x[0], x[1]};
    }
};

/// Value of a node at t = 3, x = (-0.5, 2, 0.25), u, c = 2 and the parameters of effects, the last
/// one for all further ones.
inline double at(recorded_model const& m, node_id n, double u,
                 std::vector<double> const& parameters) {
    graph g;
    auto const image = copy_into(g, m.g, {n}, [&](node const& leaf, graph& to) {
        double const states[] = {-0.5, 2, 0.25};
        auto const k = static_cast<std::size_t>(leaf.index);
        return to.constant(leaf.op == operation::state ? states[k]
                           : leaf.op == operation::constant
                               ? (k == 0 ? 2 : parameters[std::min(k, parameters.size()) - 1])
                           : leaf.op == operation::input ? u
                                                         : 3.0);
    });
    return g.value(g[image.front()]).nearest;
}

} // namespace model_support

#endif
