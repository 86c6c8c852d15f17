// SPDX-License-Identifier: MIT
// Equations of motion as the textbook has them: a ball on a rod, with the pull that keeps it there.
#include <sivid/enclosure/enclose.hpp>
#include <sivid/model/implicit_model.hpp>
#include <sivid/number/decimal_output.hpp>

#include <iostream>

using namespace sivid;

struct ball { // M (x', z) = f: two definitions, two force balances, the rod's length differentiated
    static constexpr auto name = "ball on a rod";
    static constexpr auto states =
        sivid::states({{"x", "m", 2}, {"y", "m", 2}, {"vx", "m/s", 9}, {"vy", "m/s", 9}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"pull", "N/m"}});
    static constexpr auto constants = sivid::constants({{"m", "kg", 1_dec}});
    static constexpr auto algebraic = sivid::algebraic({{"pull", "N/m"}});
    template <class T, class U>
    matrix_of<ball, T> mass(T const&, vec<T, 4> const& s, vec<T, 1> const& c, U const&) const {
        auto const &x = s[0], &y = s[1], &m = c[0];
        return {
            {{1, 0, 0, 0, 0}, {0, 1, 0, 0, 0}, {0, 0, m, 0, x}, {0, 0, 0, m, y}, {0, 0, x, y, 0}}};
    }
    template <class T, class U>
    vec<T, 5> force(T const&, vec<T, 4> const& s, vec<T, 1> const& c, U const&) const {
        return {s[2], s[3], 0, T(-9.81_dec) * c[0], -(sqr(s[2]) + sqr(s[3]))};
    }
    template <class T, class X, class C, class U>
    vec<T, 1> observe(T const&, X const&, C const&, U const&, vec<T, 1> const& pull) const {
        return pull;
    }
};

int main() {
    auto const motion =
        enclose(record_model<ball>(), {{"m"}, {}}, {1, 0, 0, 0}, {hull(0.99_dec, 1.01_dec)}, 0, 1);
    std::cout << "after 0.5 s the pull is in " << to_string(motion.observe_at(0.5)[0], 5) << '\n';
}
