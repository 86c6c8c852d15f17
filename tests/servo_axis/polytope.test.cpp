// SPDX-License-Identifier: MIT
#include "polytope.hpp"
#include "support/catch.hpp"

#include <random>

using servo::linear_relation;
using servo::polytope;
using sivid::box;
using sivid::interval;

TEST_CASE("relations together give what none gives alone", "[servo_axis]") {
    // x + y <= 0.5 and x - y <= 0.3: x <= 0.4; and y >= x - 0.3 >= -1.3 says nothing.
    std::vector<linear_relation<2>> const rows{
        {{interval(1.0), interval(1.0)}, interval(-5.0, 0.5)},
        {{interval(1.0), interval(-1.0)}, interval(-5.0, 0.3)}};
    box p{interval(-1.0, 1.0), interval(-1.0, 1.0)};
    REQUIRE(polytope<2>(p, rows).contract(p));
    CHECK(p[0].lower() == -1);
    CHECK(p[0].upper() >= 0.4);
    CHECK(p[0].upper() <= 0.4 + 1e-12);
    CHECK(p[1].lower() == -1);
    CHECK(p[1].upper() == 1);
}

TEST_CASE("a contradiction is proved, a near one is not", "[servo_axis]") {
    auto const contradicts = [](double gap) {
        std::vector<linear_relation<3>> const rows{
            {{interval(1.0), interval(1.0), interval(0.0)}, interval(0.0, 2.0)},
            {{interval(0.0), interval(-1.0), interval(1.0)}, interval(0.0, 2.0)},
            // x + z is the sum of the first two, hence at least 0.
            {{interval(1.0), interval(0.0), interval(1.0)}, interval(-2.0, -gap)}};
        box p{interval(-1.0, 1.0), interval(-1.0, 1.0), interval(-1.0, 1.0)};
        return !polytope<3>(p, rows).contract(p);
    };
    CHECK(contradicts(0.1));
    CHECK(contradicts(1e-5));
    CHECK_FALSE(contradicts(0.0));
    CHECK_FALSE(contradicts(-0.1));
}

TEST_CASE("no point that satisfies all relations is removed", "[servo_axis]") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::size_t shrunk = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        std::vector<double> truth;
        box p(4);
        for (std::size_t j = 0; j < 4; ++j) {
            double const size = std::pow(10.0, 3 * unit(random));
            truth.push_back(size * unit(random));
            p[j] = interval(-size, size);
        }
        std::vector<linear_relation<4>> rows;
        for (int i = 0; i < 12; ++i) {
            linear_relation<4> r;
            interval value(0.0);
            for (std::size_t j = 0; j < 4; ++j) {
                double const a = unit(random) / p[j].upper();
                // Some factor in the interval is the true one.
                r.factor[j] = interval(a - 0.01 / p[j].upper(), a + 0.02 / p[j].upper());
                value += interval(a) * truth[j];
            }
            double const above = 0.2 * (1 + unit(random)), below = 0.2 * (1 + unit(random));
            r.target = value + interval(-below, above);
            rows.push_back(r);
        }
        auto rest = p;
        REQUIRE(polytope<4>(p, rows).contract(rest));
        for (std::size_t j = 0; j < 4; ++j) {
            CHECK(contains(rest[j], truth[j]));
            shrunk += width(rest[j]) < 0.9 * width(p[j]) ? 1 : 0;
        }
    }
    CHECK(shrunk > 2000); // of 4000 sides
}
