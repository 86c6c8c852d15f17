// SPDX-License-Identifier: MIT
#include <sivid/paving/static/detail/mean_value_program.hpp>

#include "support/catch.hpp"

#include <random>

using namespace sivid;

namespace {

/// Random affine functions with uncertain slopes; a point that meets all bounds but `spoilt` ones.
struct planted {
    box whole;
    std::vector<double> truth;
    mean_value_program program;

    planted(std::mt19937& random, std::size_t n, std::size_t functions, std::size_t spoilt,
            double slack) {
        std::uniform_real_distribution<double> u(-1, 1);
        std::vector<double> middle;
        std::vector<interval> sides;
        for (std::size_t j = 0; j < n; ++j) {
            double const m = 3 * u(random), r = 0.1 + std::abs(u(random));
            sides.push_back(interval(m - r, m + r));
            middle.push_back(mid(sides[j]));
            truth.push_back(std::clamp(m + r * u(random), m - r, m + r));
        }
        whole = box(sides);
        program.begin(whole, middle);
        for (std::size_t k = 0; k < functions; ++k) {
            std::vector<interval> slopes;
            double const value = u(random);
            double at = value;
            for (std::size_t j = 0; j < n; ++j) {
                double const s = u(random), loose = slack * std::abs(u(random));
                slopes.push_back(interval(s - loose, s + loose));
                // The true slope is anywhere in it.
                at += (s + loose * u(random)) * (truth[j] - middle[j]);
            }
            double const e = 0.01 + 0.1 * std::abs(u(random));
            double y = at + 0.999 * e * u(random);
            if (k < spoilt) y += u(random) > 0 ? 3 * e : -3 * e;
            auto bound = interval_traits<interval>::bounds(y - e, y + e);
            if (k % 7 == 6) bound = interval_traits<interval>::bounds(y - e, HUGE_VAL);
            program.add(bound, interval(value - 1e-12, value + 1e-12),
                        [&](std::size_t j) { return slopes[j]; });
        }
    }
};

} // namespace

TEST_CASE("a point that meets the bounds is never cut off, whatever may miss") {
    std::mt19937 random(7);
    int narrowed = 0, some = 0;
    for (int round = 0; round < 3000; ++round) {
        std::size_t const n = 1 + static_cast<std::size_t>(round) % 5;
        std::size_t const budgets[] = {0, 0, 1, 3, 9};
        auto const q = budgets[static_cast<std::size_t>(round) / 5 % 5];
        planted p(random, n, 4 + static_cast<std::size_t>(round) % 40, q, round % 3 == 0 ? 0.3 : 0);
        auto x = p.whole;
        INFO(round << " q " << q);
        REQUIRE(p.program(x, q));
        for (std::size_t j = 0; j < n; ++j) {
            REQUIRE(x[j].lower() <= p.truth[j] + 1e-9);
            REQUIRE(p.truth[j] - 1e-9 <= x[j].upper());
            narrowed += width(x[j]) < 0.5 * width(p.whole[j]) ? 1 : 0;
            ++some;
        }
    }
    CHECK(3 * narrowed > some);
}

TEST_CASE("what contradicts itself leaves nothing, unless outliers may explain it") {
    mean_value_program program;
    box const whole{interval(-1, 1), interval(-1, 1)};
    program.begin(whole, {0, 0});
    auto const add = [&](interval const& bound, double a, double b) {
        program.add(bound, interval(0.0), [&](std::size_t j) { return interval(j == 0 ? a : b); });
    };
    add(interval(0.5, 0.6), 1, 1);
    add(interval(0.5, 0.6), 1, -1);
    add(interval(-0.2, 0.2), 1, 0); // the others say about 0.55
    auto x = whole;
    CHECK_FALSE(program(x, 0));
    x = whole;
    CHECK(program(x, 1));
    CHECK(contains(x[0], 0.55));
}

TEST_CASE("hulls of affine functions are exact, and rows that are no numbers are left out") {
    mean_value_program program;
    box const whole{interval(-1, 1), interval(-1, 1)};
    program.begin(whole, {0, 0});
    auto const slopes = [](interval a, interval b) {
        return [a, b](std::size_t j) { return j == 0 ? a : b; };
    };
    program.add(interval(-0.1, 0.1), interval(0.0), slopes(interval(1.0), interval(1.0)));
    program.add(interval(-0.1, 0.1), interval(0.0), slopes(interval(1.0), interval(-2.0)));
    using traits = interval_traits<interval>;
    program.add(interval(7, 8), interval(0.0), slopes(traits::entire(), interval(1.0)));
    program.add(interval(7, 8), traits::empty(), slopes(interval(1.0), interval(1.0)));
    CHECK(program.size() == 2);
    auto x = whole;
    REQUIRE(program(x, 0));
    CHECK(program.sharp());
    // |p + q| <= 0.1 and |p - 2 q| <= 0.1: p up to 0.1, q up to 1/15.
    CHECK(x[0].upper() >= 0.1);
    CHECK(x[0].upper() < 0.1 + 1e-12);
    CHECK(x[1].lower() <= -1.0 / 15);
    CHECK(x[1].lower() > -1.0 / 15 - 1e-12);
    CHECK(program.points().size() == 4);
}
