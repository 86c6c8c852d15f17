// SPDX-License-Identifier: MIT
// All trajectories of a pendulum from a box of starts and lengths, at any time within the span.
#include <sivid/enclosure/enclose.hpp>
#include <sivid/number/decimal_output.hpp>

#include <iostream>

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
    auto const near_one = hull(0.99_dec, 1.01_dec);
    auto const motion =
        enclose(record_model<pendulum>(), {{"l"}, {}}, {near_one, 0}, {near_one}, 0, 3);
    for (double t = 0; t <= motion.end_time(); t += 0.5) {
        std::cout << t << " s: angle in " << to_string(motion.at(t)[0], 6) << " rad\n";
    }
    std::cout << "from 1 s to 2 s: in " << to_string(motion.over(1, 2)[0], 6) << " rad\n";
}
