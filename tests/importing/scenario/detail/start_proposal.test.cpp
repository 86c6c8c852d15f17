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
