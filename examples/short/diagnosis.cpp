// SPDX-License-Identifier: MIT
// What is wrong with a model?  v' = a  is what somebody believes; the cart has drag.
#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/model/effects.hpp>

#include <cmath>
#include <iostream>

using namespace sivid;

struct cart {
    static constexpr auto name = "cart";
    static constexpr auto states = sivid::states({{"v", "m/s", 10, "force balance"}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"v", "m/s"}});
    static constexpr auto constants = sivid::constants({{"a", "m/s^2", 2_dec}});

    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const&, vec<T, 1> const& c, vec<T, 0> const&) const {
        return {c[0]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 1> const& v, vec<T, 1> const&, vec<T, 0> const&) const {
        return v;
    }
};

int main() {
    experiment run{"run", {}, 0, {0}, {}};
    for (double t = 0.1; t < 3; t += 0.1) { // v' = 2 - v^2/2, within +-0.02
        double const v = 2 * std::tanh(t);
        run.measurements.push_back({t, 0, {v - 0.02, v + 0.02}});
    }
    auto const said = diagnose({record_model<cart>(), {{"a"}, {}}, {hull(1_dec, 3_dec)}, {run}},
                               {effects::quadratic_damping("drag", "v", "1/m", {0_dec, 1_dec}),
                                effects::linear_damping("damping", "v", {0_dec, 1_dec})});
    for (auto const& effect : said.result.effects) std::cout << "missing: " << effect << '\n';
}
