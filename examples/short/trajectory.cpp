// SPDX-License-Identifier: MIT
// All trajectories of a pendulum from a box of starts and lengths, at any time within the span.
#include <sivid/enclosure/enclosed_motion.hpp>
#include <sivid/number/decimal_output.hpp>

#include <iostream>
#include <memory>

using namespace sivid;

struct pendulum {
    static constexpr auto name = "pendulum";
    static constexpr auto states = sivid::states({{"angle", "rad", 7}, {"rate", "rad/s", 20}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"angle", "rad"}});
    static constexpr auto constants = sivid::constants({{"l", "m", 1_dec}});

    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 1> const& c, vec<T, 0> const&) const {
        return {x[1], T(-9.81_dec) / c[0] * sin(x[0])};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 2> const& x, vec<T, 1> const&, vec<T, 0> const&) const {
        return {x[0]};
    }
};

int main() {
    auto const f = std::make_shared<flow>(record_model<pendulum>(), parameter_choice{{"l"}, {}},
                                          std::vector<signal>{});
    enclosed_motion const motion(f, {hull(0.99_dec, 1.01_dec), interval(0.0)},
                                 {hull(0.99_dec, 1.01_dec)}, 0, 3);
    for (double t = 0; t <= motion.end_time(); t += 0.5) {
        std::cout << t << " s: angle in " << to_string(motion.at(t)[0], 6) << " rad\n";
    }
}
