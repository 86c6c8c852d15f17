// SPDX-License-Identifier: MIT
#include "support/systems.hpp"

#include <vector>

namespace support {

void for_each_smooth_system(system_visit const& visit) {
    visit({"linear",
           {2, 2},
           [](auto const&, auto const& x, auto const& p, auto const&) {
               return std::vector{p[0] * x[1] - p[1] * x[0], -(p[0] * x[0]) - p[1] * x[1]};
           },
           box{between(0.9, 1.1), between(-0.1, 0.1)},
           box{between(1.9, 2.1), between(0.1, 0.2)},
           2});
    visit({"pendulum",
           {2, 1},
           [](auto const&, auto const& x, auto const& p, auto const&) {
               using namespace real;
               return std::vector{x[1], -(p[0] * sin(x[0])) - 0.25 * x[1]};
           },
           box{between(0.95, 1.05), between(-0.05, 0.05)},
           box{between(1.9, 2.1)},
           2});
    visit({"van der Pol",
           {2, 1},
           [](auto const&, auto const& x, auto const& p, auto const&) {
               using namespace real;
               return std::vector{x[1], p[0] * (1 - sqr(x[0])) * x[1] - x[0]};
           },
           box{between(1.98, 2.02), between(-0.02, 0.02)},
           box{between(0.99, 1.01)},
           2});
    visit({"Lorenz",
           {3, 1},
           [](auto const&, auto const& x, auto const& p, auto const&) {
               return std::vector{10 * (x[1] - x[0]), x[0] * (p[0] - x[2]) - x[1],
                                  x[0] * x[1] - 2.5 * x[2]};
           },
           box{between(1, 1.001), interval(1.0), interval(1.0)},
           box{between(28, 28.001)},
           1});
    visit({"Lotka-Volterra",
           {2, 2},
           [](auto const&, auto const& x, auto const& p, auto const&) {
               return std::vector{x[0] * (p[0] - x[1]), -(x[1] * (p[1] - x[0]))};
           },
           box{between(1.19, 1.21), between(1.09, 1.11)},
           box{between(0.99, 1.01), between(0.98, 1)},
           3});
    visit({"logistic",
           {1, 2},
           [](auto const&, auto const& x, auto const& p, auto const&) {
               return std::vector{p[0] * x[0] * (1 - x[0] / p[1])};
           },
           box{between(0.1, 0.12)},
           box{between(0.9, 1.1), between(0.95, 1.05)},
           4});
    visit({"stiff",
           {2, 1},
           [](auto const& t, auto const& x, auto const& p, auto const&) {
               using namespace real;
               return std::vector{-(p[0] * (x[0] - cos(t))) - sin(t), 0.5 * (x[0] - x[1])};
           },
           box{between(1.4, 1.5), between(0, 0.1)},
           box{between(48, 52)},
           0.5});
    visit({"functions",
           {2, 2},
           [](auto const& t, auto const& x, auto const& p, auto const&) {
               using namespace real;
               return std::vector{p[1] * atan(x[1]) - tanh(2 * x[0]) + exp(-t),
                                  0.5 * tan(0.5 * x[0]) - pown(x[1], 3) / (p[0] + sqr(x[1]))};
           },
           box{between(0.4, 0.5), between(0.9, 1)},
           box{between(1, 1.1), between(0.5, 0.6)},
           2});
    visit({"end of the domain",
           {2, 1},
           [](auto const&, auto const& x, auto const& p, auto const&) {
               using namespace real;
               return std::vector{-(p[0] * sqrt(x[0])), -(log(x[1]) / x[0]) * 0.125};
           },
           box{between(1, 1.01), between(1.4, 1.5)},
           box{between(1, 1.02)},
           1.7});
}

void for_each_rough_system(system_visit const& visit) {
    using sivid::interpolation;
    visit({"friction with a kink",
           {2, 1},
           [](auto const&, auto const& x, auto const& p, auto const&) {
               using namespace real;
               return std::vector{x[1], -x[0] - p[0] * abs(x[1]) * x[1] - 0.25 * abs(x[1])};
           },
           box{between(0.99, 1.01), between(0.19, 0.21)},
           box{between(0.49, 0.51)},
           1.5});
    visit({"saturation",
           {1, 1},
           [](auto const& t, auto const& x, auto const& p, auto const&) {
               using namespace real;
               auto const drive = 2 * sin(2 * t);
               return std::vector{max(min(drive, p[0]), -p[0]) - x[0]};
           },
           box{between(0, 0.02)},
           box{between(0.99, 1.01)},
           1.5});
    visit({"held input",
           {2, 1, 1},
           [](auto const&, auto const& x, auto const& p, auto const& u) {
               return std::vector{x[1], u[0] - p[0] * x[0] - 0.5 * x[1] * u[0]};
           },
           box{between(-0.1, 0.1), between(0, 0)},
           box{between(0.9, 1.1)},
           2,
           {sivid::sampled_signal({0, 0.25, 0.5, 1.3, 1.7}, {1, -1, 0.5, 0.5, 2},
                                  interpolation::hold)}});
    visit({"linear and held input",
           {1, 1, 2},
           [](auto const&, auto const& x, auto const& p, auto const& u) {
               using namespace real;
               return std::vector{p[0] * sin(u[0] * x[0]) + u[1]};
           },
           box{between(0.4, 0.5)},
           box{between(0.9, 1.1)},
           2,
           {sivid::sampled_signal({0, 0.7, 1.5}, {1, 3, -1}, interpolation::linear),
            sivid::sampled_signal({-1, 0.3, 1.5, 1.75}, {0, 1, -1, 0}, interpolation::hold)}});
}

void for_each_system(system_visit const& visit) {
    for_each_smooth_system(visit);
    for_each_rough_system(visit);
}

} // namespace support
