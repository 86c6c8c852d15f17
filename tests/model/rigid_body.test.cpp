// SPDX-License-Identifier: MIT
// A double pendulum derived by hand, by doubles, intervals and the recording scalar.
#include "support/catch.hpp"
#include "support/random.hpp"

#include <sivid/model/expression.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/model/rigid_body.hpp>
#include <sivid/number/elementary.hpp>
#include <sivid/number/interval.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;

namespace {

constexpr double m1 = 1.25, m2 = 0.75, l = 0.5, c1 = 0.25, c2 = 0.375, I1 = 0.125, I2 = 0.0625,
                 g = 9.75;

/// Two bodies that turn about z in a vertical plane, with centres c1, c2 from their joints and
/// moments I1, I2 about these centres.
template <class T>
rigid_bodies<T> pendulum(std::array<T, 4> const& x) {
    auto const k = [](double v) { return sparse<T>(T(v)); };
    std::vector<body_joint> joints(2);
    joints[1].parent = 0;
    std::vector<body_inertia<T>> bodies(2);
    bodies[0].mass = k(m1);
    bodies[0].first[0] = k(m1 * c1);
    bodies[0].inertia[2] = k(I1 + m1 * c1 * c1);
    bodies[1].mass = k(m2);
    bodies[1].first[0] = k(m2 * c2);
    bodies[1].inertia[2] = k(I2 + m2 * c2 * c2);
    body_motion<T> motion;
    motion.origin.resize(2);
    motion.origin[1][0] = k(l);
    motion.place = {x[0], x[1]};
    motion.speed = {x[2], x[3]};
    motion.gravity[1] = k(-g);
    return {joints, bodies, motion};
}

/// M11, M12, M22, h1, h2 by hand (Lagrange).
std::array<double, 5> by_hand(std::array<double, 4> const& x) {
    auto const [a, b, v, w] = x;
    double const pull = m2 * l * c2, s = pull * std::sin(b);
    return {I1 + m1 * c1 * c1 + I2 + m2 * (l * l + c2 * c2) + 2 * pull * std::cos(b),
            I2 + m2 * c2 * c2 + pull * std::cos(b), I2 + m2 * c2 * c2,
            -s * w * (2 * v + w) +
                g * ((m1 * c1 + m2 * l) * std::cos(a) + m2 * c2 * std::cos(a + b)),
            s * v * v + g * m2 * c2 * std::cos(a + b)};
}

template <class T>
std::array<T, 5> computed(std::array<T, 4> const& x) {
    auto bodies = pendulum(x);
    auto const h = bodies.bias();
    auto const m = bodies.mass();
    return {*m[0][0], *m[0][1], *m[1][1], *h[0], *h[1]};
}

} // namespace

TEST_CASE("a double pendulum has the equations that one derives by hand") {
    support::draws random{7};
    for (int n = 0; n < 200; ++n) {
        std::array<double, 4> x{};
        for (auto& v : x) v = random.uniform(-3, 3);
        auto const expected = by_hand(x), found = computed(x);
        std::array<interval, 4> wide;
        for (std::size_t k = 0; k < 4; ++k)
            wide[k] = interval_traits<interval>::bounds(x[k] - 0.01, x[k] + 0.01);
        auto const enclosed = computed(wide);
        for (std::size_t k = 0; k < 5; ++k) {
            CHECK_THAT(found[k], WithinAbs(expected[k], 1e-12));
            CHECK(enclosed[k].lower() <= expected[k]);
            CHECK(expected[k] <= enclosed[k].upper());
            CHECK(enclosed[k].upper() - enclosed[k].lower() < 2);
        }
    }
}

TEST_CASE("what is 0 by structure is not computed") {
    graph record;
    std::array<expression, 4> const x{expression(record, record.leaf(operation::state, 0)),
                                      expression(record, record.leaf(operation::state, 1)),
                                      expression(record, record.leaf(operation::state, 2)),
                                      expression(record, record.leaf(operation::state, 3))};
    auto const found = computed(x);
    for (auto const& e : found) (void)e.in(record);
    CHECK(record.size() < 80);

    auto still = pendulum<double>({0.1, 0.2, 0, 0});
    CHECK(still.seen_by_body(0, {})[0].is_zero());
}
