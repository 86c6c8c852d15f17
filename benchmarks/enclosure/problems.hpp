// SPDX-License-Identifier: MIT
// The problems of the engine's benchmark, as a user would write them.
#ifndef SIVID_BENCHMARKS_ENCLOSURE_PROBLEMS_HPP
#define SIVID_BENCHMARKS_ENCLOSURE_PROBLEMS_HPP

#include <sivid/model/model.hpp>

namespace problems {

/// x' = y,  y' = mu (1 - x^2) y - x
struct van_der_pol {
    static constexpr auto name = "van der Pol";
    static constexpr auto states = sivid::states({{"x", "1", 3}, {"y", "1", 4}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"mu", "1", 1_dec}});
    }();
    template <class T>
    sivid::vec<T, 2> rate(T const&, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const& c,
                          sivid::vec<T, 0> const&) const {
        auto const& [x, y] = s;
        return {y, c[0] * (1 - sqr(x)) * y - x};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const&,
                             sivid::vec<T, 0> const&) const {
        return {s[0]};
    }
};

/// Enzymatic reactions: M. T. Laub and W. F. Loomis, Molecular Biology of the Cell 9 (1998).
struct laub_loomis {
    static constexpr auto name = "Laub-Loomis";
    static constexpr auto states = sivid::states({{"x1", "1", 3},
                                                  {"x2", "1", 3},
                                                  {"x3", "1", 3},
                                                  {"x4", "1", 5},
                                                  {"x5", "1", 3},
                                                  {"x6", "1", 1},
                                                  {"x7", "1", 3}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x4", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"k", "1", 1_dec}});
    }();
    template <class T>
    sivid::vec<T, 7> rate(T const&, sivid::vec<T, 7> const& x, sivid::vec<T, 1> const&,
                          sivid::vec<T, 0> const&) const {
        using namespace sivid::literals;
        return {1.4_dec * x[2] - 0.9_dec * x[0],        2.5_dec * x[4] - 1.5_dec * x[1],
                0.6_dec * x[6] - 0.8_dec * x[1] * x[2], 2 - 1.3_dec * x[2] * x[3],
                0.7_dec * x[0] - x[3] * x[4],           0.3_dec * x[0] - 3.1_dec * x[5],
                1.8_dec * x[5] - 1.5_dec * x[1] * x[6]};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 7> const& x, sivid::vec<T, 1> const&,
                             sivid::vec<T, 0> const&) const {
        return {x[3]};
    }
};

struct lorenz {
    static constexpr auto name = "Lorenz";
    static constexpr auto states = sivid::states({{"x", "1", 25}, {"y", "1", 30}, {"z", "1", 50}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"sigma", "1", 10_dec}, {"rho", "1", 28_dec}});
    }();
    template <class T>
    sivid::vec<T, 3> rate(T const&, sivid::vec<T, 3> const& s, sivid::vec<T, 2> const& c,
                          sivid::vec<T, 0> const&) const {
        auto const& [x, y, z] = s;
        return {c[0] * (y - x), x * (c[1] - z) - y, x * y - 8 * z / 3};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 3> const& s, sivid::vec<T, 2> const&,
                             sivid::vec<T, 0> const&) const {
        return {s[0]};
    }
};

/// ARCH-COMP, category nonlinear dynamics: x' = -0.4 x + beta y z, y' = 0.4 x - beta y z - gamma
/// y^2, z' = gamma y^2.
struct robertson {
    static constexpr auto name = "Robertson";
    static constexpr auto states = sivid::states({{"x", "1", 1}, {"y", "1", 1}, {"z", "1", 1}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"beta", "1", 100_dec}, {"gamma", "1", 1000_dec}});
    }();
    template <class T>
    sivid::vec<T, 3> rate(T const&, sivid::vec<T, 3> const& s, sivid::vec<T, 2> const& c,
                          sivid::vec<T, 0> const&) const {
        using namespace sivid::literals;
        auto const& [x, y, z] = s;
        T const slow = 0.4_dec * x;
        T const middle = c[0] * y * z;
        T const fast = c[1] * sqr(y);
        return {middle - slow, slow - middle - fast, fast};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 3> const& s, sivid::vec<T, 2> const&,
                             sivid::vec<T, 0> const&) const {
        return {s[0]};
    }
};

/// x' = 3 x - 3 x y,  y' = x y - y
struct lotka_volterra {
    static constexpr auto name = "Lotka-Volterra";
    static constexpr auto states = sivid::states({{"x", "1", 3}, {"y", "1", 3}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"k", "1", 3_dec}});
    }();
    template <class T>
    sivid::vec<T, 2> rate(T const&, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const& c,
                          sivid::vec<T, 0> const&) const {
        auto const& [x, y] = s;
        return {c[0] * x * (1 - y), y * (x - 1)};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const&,
                             sivid::vec<T, 0> const&) const {
        return {s[0]};
    }
};

/// Stiff relaxation to cos t, with a slow follower: x' = -k (x - cos t) - sin t,  y' = (x - y)/2
struct relaxation {
    static constexpr auto name = "relaxation";
    static constexpr auto states = sivid::states({{"x", "1", 2}, {"y", "1", 2}});
    static constexpr auto inputs = sivid::no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"k", "1", 10000_dec}});
    }();
    template <class T>
    sivid::vec<T, 2> rate(T const& t, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const& c,
                          sivid::vec<T, 0> const&) const {
        auto const& [x, y] = s;
        return {-(c[0] * (x - cos(t))) - sin(t), (x - y) / 2};
    }
    template <class T>
    sivid::vec<T, 1> observe(T const&, sivid::vec<T, 2> const& s, sivid::vec<T, 1> const&,
                             sivid::vec<T, 0> const&) const {
        return {s[0]};
    }
};

} // namespace problems

#endif
