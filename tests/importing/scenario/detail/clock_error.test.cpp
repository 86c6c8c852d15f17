// SPDX-License-Identifier: MIT
#include <sivid/importing/scenario/detail/clock_error.hpp>

#include "io/import_support.hpp"

#include <cmath>
#include <random>

using namespace sivid;
using io_support::dec;

namespace {

imported_quantity read_at(std::vector<double> const& times, std::vector<double> const& values,
                          quantity_mapping const& mapping) {
    imported_quantity q;
    q.mapping = &mapping;
    for (std::size_t k = 0; k < times.size(); ++k) {
        imported_sample s;
        s.time = exact_decimal::of(times[k]);
        s.reading.value = exact_decimal::of(values[k]);
        q.samples.push_back(s);
    }
    return q;
}

} // namespace

TEST_CASE("readings that were taken before or after their times are within what is added") {
    std::mt19937_64 random{3};
    std::uniform_real_distribution<double> unit{-1, 1};
    quantity_mapping mapping;
    mapping.error.from = bound_source::kind::number;
    mapping.error.number = dec("0.001");
    mapping.clock = dec("0.002");
    double loosest = 0;
    for (int i = 0; i < 200; ++i) {
        // x = a sin(w t + b): the motion is late or early as a whole, at random, or where it hurts
        double const a = 1 + unit(random) / 2, w = 4 + 3 * unit(random), b = 3 * unit(random);
        mapping.curved = i % 3 != 0;
        mapping.slope = exact_decimal::shortest(a * w * (mapping.curved ? w : 1) * 1.0001);
        std::vector<double> times, values;
        for (int k = 0; k < 60; ++k) {
            double const t = 0.01 * k + 0.001 * unit(random);
            double const slope = a * w * std::cos(w * t + b);
            double const late = i % 4 == 0   ? 0.002
                                : i % 4 == 1 ? 0.002 * unit(random)
                                             : (slope > 0 ? 0.002 : -0.002);
            double const error = i % 4 == 3 ? (slope > 0 ? 1 : -1) : unit(random);
            times.push_back(t);
            values.push_back(a * std::sin(w * (t + late) + b) + 0.001 * error * (1 - 1e-9));
        }
        auto q = read_at(times, values, mapping);
        REQUIRE(add_clock_errors(q).empty());
        for (std::size_t k = 0; k < times.size(); ++k) {
            double const off = std::abs(values[k] - a * std::sin(w * times[k] + b));
            CHECK(off <= 0.001 + *nearest(q.samples[k].late));
            loosest = std::max(loosest, *nearest(q.samples[k].late) / (0.002 * a * w));
        }
    }
    CHECK(loosest < 2.5); // of the largest slope
}

TEST_CASE("slopes that no two readings bound are said, and no clock error leaves all as it is") {
    quantity_mapping mapping;
    mapping.error.from = bound_source::kind::number;
    mapping.error.number = dec("0.001");
    auto q = read_at({0, 0.001}, {0, 1}, mapping);
    CHECK(add_clock_errors(q).empty());
    CHECK(q.samples[0].late.is_zero());
    mapping.clock = dec("0.002");
    mapping.slope = dec("5");
    CHECK(add_clock_errors(q).empty());
    CHECK_FALSE(q.samples[1].late < dec("0.01"));
    CHECK(q.samples[1].late < dec("0.0102"));
    mapping.curved = true;
    CHECK_FALSE(add_clock_errors(q).empty());
}
