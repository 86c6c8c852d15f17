// SPDX-License-Identifier: MIT
// Two links whose angles are measured: equations of motion with a mass matrix.
#ifndef SIVID_TESTS_PAVING_RELATION_TWO_LINKS_HPP
#define SIVID_TESTS_PAVING_RELATION_TWO_LINKS_HPP

#include "diagnosis/planted_motion.hpp"

#include <sivid/model/implicit_model.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/problem.hpp>

#include <vector>

namespace relation_support {

using namespace sivid;

struct two_links {
    static constexpr auto name = "two links";
    static constexpr auto states = sivid::states(
        {{"q1", "rad", 10}, {"q2", "rad", 10}, {"w1", "rad/s", 20}, {"w2", "rad/s", 20}});
    static constexpr auto inputs = sivid::inputs({{"T1", "N m"}, {"T2", "N m"}});
    static constexpr auto channels = sivid::channels({{"q1", "rad"}, {"q2", "rad"}});
    static constexpr auto constants = sivid::constants({{"a1", "kg m^2", 0.6_dec},
                                                        {"a2", "kg m^2", 0.12_dec},
                                                        {"a3", "kg m^2", 0.15_dec},
                                                        {"f", "N m s", 0.3_dec},
                                                        {"d", "N m", 0.2_dec}});
    template <class T>
    matrix_of<two_links, T> mass(T const&, vec<T, 4> const& x, vec<T, 5> const& c,
                                 vec<T, 2> const&) const {
        T const m11 = c[0] + 2 * c[1] * cos(x[1]), m12 = c[2] + c[1] * cos(x[1]);
        return {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, m11, m12}, {0, 0, m12, c[2]}}};
    }
    template <class T>
    vec<T, 4> force(T const&, vec<T, 4> const& x, vec<T, 5> const& c, vec<T, 2> const& u) const {
        T const h = c[1] * sin(x[1]);
        return {x[2], x[3],
                u[0] - c[3] * x[2] + h * x[3] * (2 * x[2] + x[3]) - 2 * cos(x[0]) -
                    c[4] * tanh(10 * x[2]),
                u[1] - 0.1 * x[3] - h * x[2] * x[2]};
    }
    template <class T>
    vec<T, 2> observe(T const&, vec<T, 4> const& x, vec<T, 5> const&, vec<T, 2> const&) const {
        return {x[0], x[1]};
    }
};

/// Their prior about the nominal constants, by a share of each.
inline box prior_of_links(double share) {
    std::vector<interval> sides;
    for (auto const& c : two_links::constants) {
        double const v = nearest(c.nominal);
        sides.push_back(interval((1 - share) * v, (1 + share) * v));
    }
    return box(std::move(sides));
}

/// A drawn record of them.
inline experiment record_of_links(diagnosis_support::draws& d, recorded_model const& m,
                                  std::vector<double> const& truth, double seconds, double error,
                                  diagnosis_support::noise kind, std::string name = "S") {
    using namespace diagnosis_support;
    std::vector<sampled_signal> const inputs{
        sine_input(d.uniform(1, 4), d.uniform(2, 5), seconds),
        sine_input(d.uniform(0.5, 1), d.uniform(3, 7), seconds)};
    std::vector<double> const start{d.uniform(-1, 1), d.uniform(-1, 1), d.uniform(-1, 1), 0};
    auto const motion = simulate(m, truth, inputs, start, seconds, 0.001);
    return measured(d, std::move(name), motion, inputs, {0, 1}, error, kind, {}, 0.01);
}

} // namespace relation_support

#endif
