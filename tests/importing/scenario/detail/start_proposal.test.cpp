// SPDX-License-Identifier: MIT
#include <sivid/importing/scenario/detail/start_proposal.hpp>

#include "io/import_support.hpp"

#include <cmath>

using namespace sivid;
using io_support::dec;
using kind = mapped_start::kind;

namespace {

mapped_start mapped(kind from, std::optional<std::pair<double, double>> bound) {
    mapped_start m;
    m.from = from;
    m.bounded = bound.has_value();
    if (bound)
        m.range = {exact_decimal::shortest(bound->first), exact_decimal::shortest(bound->second),
                   interval{bound->first, bound->second}};
    return m;
}
start_reading reading(double t, double y, double e) {
    auto const value = exact_decimal::shortest(y), error = exact_decimal::shortest(e);
    return {t, value, error, *enclose(value - error, value + error)};
}
bool holds(start_proposal const& p, double x) {
    REQUIRE(p.range);
    CHECK(contains(p.range->enclosure, *nearest(p.range->lower)));
    return !(exact_decimal::of(x) < p.range->lower) && !(p.range->upper < exact_decimal::of(x));
}
double wide(start_proposal const& p) { return width(p.range->enclosure); }

} // namespace

TEST_CASE("a reading just at the start needs no bound") {
    auto const m = mapped(kind::value, std::nullopt);
    auto const p = propose_start(m, {reading(0, 0.5, 0.02), reading(1, 9, 0.02)}, 0);
    REQUIRE(p.range);
    CHECK(p.range->lower == dec("0.48"));
    CHECK(p.range->upper == dec("0.52"));
    CHECK(propose_start(m, {reading(0.1, 0.5, 0.02)}, 0).refusal == "no reading just at the start");
    CHECK_FALSE(propose_start(m, {}, 0).range);
    CHECK_FALSE(propose_start(m, {reading(0, 0.5, 0.02)}, 1).range); // it may be an outlier
    CHECK_FALSE(propose_start(m, {reading(0, 1e200, 1)}, 0).range);
}

TEST_CASE("readings later than the start are widened by how fast the state changes") {
    auto const m = mapped(kind::value, std::pair{-2.0, 3.0});
    auto const p = propose_start(m, {reading(0.1, 1, 0.02)}, 0);
    CHECK(p.range->lower < dec("0.68001"));
    CHECK_FALSE(dec("0.68") < p.range->lower);
    CHECK(dec("1.21999") < p.range->upper);
    CHECK_FALSE(p.range->upper < dec("1.22"));
    auto const against = propose_start(m, {reading(0, 1, 0.02), reading(0.1, 2, 0.02)}, 0);
    CHECK(against.contradicted);
    CHECK_FALSE(against.range);
}

TEST_CASE("a rate from differences: as tight as the bound of its change lets it be") {
    // x = 1 + 2 t + 1.5 t^2 with |x''| <= 4, read every 10 ms to 1e-4.
    std::vector<start_reading> readings;
    for (int k = 0; k < 200; ++k) {
        double const t = 0.01 * k;
        readings.push_back(reading(t, 1 + 2 * t + 1.5 * t * t + 0.8e-4 * std::sin(7.0 * k), 1e-4));
    }
    auto const p = propose_start(mapped(kind::rate, std::pair{-4.0, 4.0}), readings, 0);
    CHECK(holds(p, 2));
    CHECK(wide(p) < 2 * std::sqrt(1e-4 * 4) * 2.1);
    auto const one_sided = propose_start(mapped(kind::rate, std::pair{2.0, 4.0}), readings, 0);
    CHECK(holds(one_sided, 2));
    CHECK(wide(one_sided) < wide(p));
    CHECK(propose_start(mapped(kind::rate, std::pair{0.0, 0.0}), readings, 0).contradicted);
    CHECK_FALSE(propose_start(mapped(kind::rate, std::pair{-4.0, 4.0}), {readings[0]}, 0).range);
    CHECK_FALSE(propose_start(mapped(kind::rate, std::pair{-4.0, 4.0}), {}, 0).range);
}

TEST_CASE("planted motions: the true start is never excluded, outliers within the budget or not") {
    std::mt19937_64 random{5};
    std::uniform_real_distribution<double> unit{-1, 1};
    double widest = 0;
    for (int i = 0; i < 400; ++i) {
        // x = c + a sin(w t + b), |x'| <= |a| w, |x''| <= |a| w^2.
        double const a = 2 * unit(random), w = 3 + 2 * unit(random), b = 3 * unit(random),
                     c = unit(random);
        double const step = 0.002 + 0.02 * std::abs(unit(random)), e = 1e-3;
        double const fastest = std::abs(a) * w * 1.0001, hardest = fastest * w * 1.0001;
        auto const outliers = random() % 4;
        std::vector<start_reading> readings;
        double t = random() % 2 == 0 ? 0 : step * 0.3;
        for (int k = 0; k < 60; ++k, t += step * (1 + 0.4 * unit(random))) {
            // Errors fill the bound but for the rounding of this test.
            double const x = c + a * std::sin(w * t + b);
            double const error = (k % 3 == 0 ? (unit(random) > 0 ? 1 : -1) : unit(random)) * e;
            readings.push_back(reading(t, x + error * (1 - 1e-9), e));
        }
        for (std::size_t k = 0; k < outliers; ++k) { // preferably where it hurts
            auto& bad = readings[k < 2 ? k : random() % readings.size()];
            bad = reading(bad.time, *nearest(bad.value) + 40 * unit(random), e);
        }
        CAPTURE(i, outliers, a, w, b, step);
        auto const value =
            propose_start(mapped(kind::value, std::pair{-fastest, fastest}), readings, outliers);
        CHECK(holds(value, c + a * std::sin(b)));
        auto const rate =
            propose_start(mapped(kind::rate, std::pair{-hardest, hardest}), readings, outliers);
        CHECK(holds(rate, a * w * std::cos(b)));
        if (outliers == 0) widest = std::max(widest, wide(rate) / std::sqrt(e * hardest));
    }
    CHECK(widest < 8); // one pair gives 4, with readings just there
    CHECK_FALSE(
        propose_start(mapped(kind::value, std::pair{-1.0, 1.0}), {reading(0, 0, 1)}, 1).range);
}

namespace {

/// A motion with a stated third derivative, as a polynomial or a swing: x, x', and |x'''| <= most.
struct motion {
    double c0, c1, c2, c3, a, w, b;
    [[nodiscard]] double at(double t) const {
        return c0 + t * (c1 + t * (c2 + t * c3)) + a * std::sin(w * t + b);
    }
    [[nodiscard]] double rate() const { return c1 + a * w * std::cos(b); }
    [[nodiscard]] double most() const {
        return (6 * std::abs(c3) + std::abs(a) * w * w * w) * (1 + 1e-9);
    }
};

mapped_start by_jerk(double most, double within) {
    auto m = mapped(kind::rate, std::pair{-most, most});
    m.degree = 2;
    m.within = exact_decimal::shortest(within);
    return m;
}

} // namespace

TEST_CASE("a rate from parabolas: no error within the bounds excludes the true one") {
    std::mt19937_64 random{7};
    std::uniform_real_distribution<double> unit{-1, 1};
    for (int i = 0; i < 300; ++i) {
        bool const swing = i % 2 == 0;
        motion const x{unit(random),
                       3 * unit(random),
                       9 * unit(random),
                       swing ? 0 : 30 * unit(random),
                       swing ? unit(random) : 0,
                       5 + 3 * unit(random),
                       3 * unit(random)};
        double const step = 0.002 + 0.008 * std::abs(unit(random)), e = 1e-3;
        int const before = static_cast<int>(random() % 8);
        // Errors are what makes x' look larger (smaller): those of a slope and of a bend that fill
        // the bounds, all at their ends, or at random.
        int const attack = i % 4;
        double const sense = i % 8 < 4 ? 1 : -1;
        std::vector<start_reading> readings;
        for (int k = -before; k < 14; ++k) {
            double const t = step * (k + 0.3 * unit(random));
            double const reach = 14 * step, s = std::clamp(t / reach, -1.0, 1.0);
            double const error = attack == 0   ? s
                                 : attack == 1 ? (t > 0 ? 1 : -1)
                                 : attack == 2 ? 1 - 8 * s * (1 - s) // Chebyshev's parabola
                                               : unit(random);
            readings.push_back(
                reading(t, x.at(t) + sense * e * (1 - 1e-9) * std::clamp(error, -1.0, 1.0), e));
        }
        CAPTURE(i, before, step, attack);
        CHECK(holds(propose_start(by_jerk(x.most(), 1), readings, 0), x.rate()));
        auto one_sided = by_jerk(0, 1); // x''' in [0, most], or in [-most, 0]
        bool const up = !swing && x.c3 >= 0;
        if (swing) continue;
        one_sided.range.enclosure = up ? interval{0, x.most()} : interval{-x.most(), 0};
        CHECK(holds(propose_start(one_sided, readings, 0), x.rate()));
    }
}

TEST_CASE(
    "a rate from parabolas: the largest remainder is reached, and outliers within the budget") {
    // Readings without errors of x = m t^3 / 6, and of one that bends the other way before 0.
    for (double const m : {6.0, -6.0})
        for (bool const both : {false, true}) {
            std::vector<start_reading> readings;
            for (double const t : {-0.1, 0.0, 0.1, 0.2})
                if (both || t >= 0) readings.push_back(reading(t, m * t * t * t / 6, 1e-12));
            auto const p = propose_start(by_jerk(6, 1), readings, 0);
            CHECK(holds(p, 0));
            CHECK(std::abs(wide(p) - (both ? 0 : 0.04)) < 1e-6); // [0, 0.02] meets [-0.04, 0]
            if (!both) CHECK_FALSE(holds(propose_start(by_jerk(5.9, 1), readings, 0), 0));
        }
    std::mt19937_64 random{9};
    std::uniform_real_distribution<double> unit{-1, 1};
    for (int i = 0; i < 100; ++i) {
        motion const x{unit(random), unit(random), unit(random), 4 * unit(random), 0, 1, 0};
        std::vector<start_reading> readings;
        for (int k = -10; k < 20; ++k) {
            double const t = 0.01 * k;
            readings.push_back(reading(t, x.at(t) + 0.999e-3 * unit(random), 1e-3));
        }
        std::size_t const outliers = random() % 4;
        for (std::size_t k = 0; k < outliers; ++k) {
            auto& bad = readings[random() % readings.size()];
            bad = reading(bad.time, *nearest(bad.value) + 9 * unit(random), 1e-3);
        }
        CHECK(holds(propose_start(by_jerk(x.most(), 0.3), readings, outliers), x.rate()));
    }
    auto few = by_jerk(1, 0.015);
    CHECK_FALSE(
        propose_start(few, {reading(0, 0, 1), reading(0.01, 0, 1), reading(0.02, 0, 1)}, 0).range);
    few.within = dec("0.025");
    CHECK(
        propose_start(few, {reading(0, 0, 1), reading(0.01, 0, 1), reading(0.02, 0, 1)}, 0).range);
    CHECK(propose_start(
              by_jerk(0, 5),
              {reading(0, 0, 0.01), reading(1, 1, 0.01), reading(2, 4, 0.01), reading(3, 0, 0.01)},
              0)
              .contradicted);
}
