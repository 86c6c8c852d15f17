// SPDX-License-Identifier: MIT
#include <sivid/model/implicit_model.hpp>

#include <sivid/model/graph/graph_range.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <vector>

using namespace sivid;

namespace {

/// A pole on a cart: angle from upright, the cart's place; the rod and the push are known.
struct pole {
    static constexpr auto name = "pole";
    static constexpr auto states =
        sivid::states({{"p", "m", 5}, {"a", "rad", 9}, {"v", "m/s", 9}, {"w", "rad/s", 20}});
    static constexpr auto inputs = sivid::inputs({{"F", "N"}});
    static constexpr auto channels = sivid::channels({{"p", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"M", "kg", 2_dec}, {"m", "kg", 0.5_dec}, {"l", "m", 0.8_dec}});
    }();
    template <class T>
    vec<T, 4> rate(T const&, vec<T, 4> const& x, vec<T, 3> const& c, vec<T, 1> const& u) const {
        auto const& [M, m, l] = c;
        T const s = sin(x[1]), k = cos(x[1]), whole = M + m * sqr(s);
        T const push = u[0] + m * l * sqr(x[3]) * s;
        return {x[2], x[3], (push - m * 10 * s * k) / whole,
                ((M + m) * 10 * s - k * push) / (l * whole)};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 4> const& x, vec<T, 3> const&, vec<T, 1> const&) const {
        return {x[0]};
    }
};
/// The same by Lagrange's equations.
struct pole_by_mass : pole {
    template <class T>
    matrix_of<pole, T> mass(T const&, vec<T, 4> const& x, vec<T, 3> const& c,
                            vec<T, 1> const&) const {
        auto const& [M, m, l] = c;
        T const off = m * l * cos(x[1]);
        return {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, M + m, off}, {0, 0, off, m * sqr(l)}}};
    }
    template <class T>
    vec<T, 4> force(T const&, vec<T, 4> const& x, vec<T, 3> const& c, vec<T, 1> const& u) const {
        auto const& [M, m, l] = c;
        T const s = sin(x[1]);
        return {x[2], x[3], u[0] + m * l * sqr(x[3]) * s, m * 10 * l * s};
    }
    template <class T>
    vec<T, 4> rate(T const&, vec<T, 4> const&, vec<T, 3> const&) const = delete; // hides the other
};
/// With the rod as a constraint: pole's ends as states, what the rod bears is an output.
struct pole_on_rod : pole {
    static constexpr auto states = sivid::states({{"p", "m", 5},
                                                  {"x", "m", 9},
                                                  {"y", "m", 9},
                                                  {"vp", "m/s", 9},
                                                  {"vx", "m/s", 9},
                                                  {"vy", "m/s", 9}});
    static constexpr auto algebraic = sivid::algebraic({{"b", "N/m"}});
    template <class T>
    matrix_of<pole_on_rod, T> mass(T const&, vec<T, 6> const& s, vec<T, 3> const& c,
                                   vec<T, 1> const&) const {
        auto const &M = c[0], &m = c[1];
        T const dx = s[1] - s[0], y = s[2];
        return {{{1, 0, 0, 0, 0, 0, 0},
                 {0, 1, 0, 0, 0, 0, 0},
                 {0, 0, 1, 0, 0, 0, 0},
                 {0, 0, 0, M, 0, 0, -dx},
                 {0, 0, 0, 0, m, 0, dx},
                 {0, 0, 0, 0, 0, m, y},
                 {0, 0, 0, -dx, dx, y, 0}}};
    }
    template <class T>
    vec<T, 7> force(T const&, vec<T, 6> const& s, vec<T, 3> const& c, vec<T, 1> const& u) const {
        return {s[3], s[4], s[5], u[0], 0, -10 * c[1], -(sqr(s[4] - s[3]) + sqr(s[5]))};
    }
    template <class T>
    vec<T, 4> rate(T const&, vec<T, 6> const&) const = delete;
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 6> const&, vec<T, 3> const&, vec<T, 1> const&,
                      vec<T, 1> const& z) const {
        return z;
    }
};
/// A constraint that no acceleration stands in.
struct undifferentiated : pole_on_rod {
    template <class T>
    matrix_of<pole_on_rod, T> mass(T const& t, vec<T, 6> const& s, vec<T, 3> const& c,
                                   vec<T, 1> const& u) const {
        auto rows = pole_on_rod::mass(t, s, c, u);
        rows[6] = {0, 0, 0, 0, 0, 0, 0};
        return rows;
    }
};

/// Rates, then outputs, at a point.
std::vector<interval> values_at(recorded_model const& m, std::vector<double> const& x,
                                std::vector<double> const& c, double u) {
    auto nodes = m.rate;
    nodes.insert(nodes.end(), m.observe.begin(), m.observe.end());
    graph_range range(m.g, nodes);
    range.evaluate({interval(0.0), point_box(x), point_box(c), point_box({u})});
    std::vector<interval> result;
    for (auto const i : nodes) {
        CHECK_FALSE(range.undefined(i));
        result.push_back(range.value(i));
    }
    return result;
}

} // namespace

TEST_CASE("a mass matrix and a constraint give the rates that are worked out by hand") {
    STATIC_REQUIRE(explicit_model<pole>);
    STATIC_REQUIRE((implicit_model<pole_by_mass> && !explicit_model<pole_by_mass>));
    STATIC_REQUIRE((dynamic_model<pole_on_rod> && !explicit_model<pole_on_rod>));
    auto const plain = record_model<pole>(), by_mass = record_model<pole_by_mass>(),
               on_rod = record_model<pole_on_rod>();
    support::draws d(77);
    for (int round = 0; round < 200; ++round) {
        std::vector<double> const c{d.uniform(0.5, 3), d.uniform(0.1, 1), d.uniform(0.3, 1.5)};
        std::vector<double> const x{d.uniform(-1, 1), d.uniform(-3, 3), d.uniform(-3, 3),
                                    d.uniform(-5, 5)};
        double const u = d.uniform(-9, 9);
        auto const exact = values_at(plain, x, c, u), same = values_at(by_mass, x, c, u);
        for (std::size_t i = 0; i < exact.size(); ++i) {
            CHECK(std::abs(mid(exact[i]) - mid(same[i])) < 1e-9 * (1 + mag(exact[i])));
        }
        double const s = c[2] * std::sin(x[1]), k = c[2] * std::cos(x[1]);
        auto const free =
            values_at(on_rod, {x[0], x[0] + s, k, x[2], x[2] + k * x[3], -s * x[3]}, c, u);
        double const turn = mid(exact[3]); // w'
        double const by_hand[] = {x[2],
                                  x[2] + k * x[3],
                                  -s * x[3],
                                  mid(exact[2]),
                                  mid(exact[2]) + k * turn - s * x[3] * x[3],
                                  -s * turn - k * x[3] * x[3]};
        for (std::size_t i = 0; i < 6; ++i) {
            CHECK(std::abs(mid(free[i]) - by_hand[i]) < 1e-8 * (1 + std::abs(by_hand[i])));
        }
        // M p'' = F + b (x - p)
        double const rod = mid(free[6]);
        CHECK(std::abs(c[0] * by_hand[3] - u - rod * s) < 1e-8 * (1 + std::abs(rod)));
    }
    CHECK_THROWS_WITH(record_model<undifferentiated>(),
                      ContainsSubstring("model 'pole'") && ContainsSubstring("place of b"));
}
