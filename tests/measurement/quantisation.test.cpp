// SPDX-License-Identifier: MIT
#include <sivid/measurement/quantisation.hpp>

#include "support/catch.hpp"

#include <cmath>
#include <random>
#include <vector>

using sivid::quantisation_step;

TEST_CASE("the step of quantised readings is found") {
    std::mt19937_64 random{1};
    std::normal_distribution<double> noise{0, 1};
    for (double const step :
         {5e-8, 1.0, 0.0048875855327468, 5.0 / 1023, 1e-3, 3.14159265358979 / 2048}) {
        CAPTURE(step);
        std::vector<double> values;
        for (int i = 0; i < 500; ++i)
            values.push_back(step * std::round(300 * std::sin(0.01 * i) + 3 * noise(random) + 20));
        CHECK_THAT(quantisation_step(values), WithinRel(step, 1e-6));
        values.push_back(step * 1e5); // an outlier on the grid does no harm
        CHECK_THAT(quantisation_step(values), WithinRel(step, 1e-6));
    }
}

TEST_CASE("a step is found though readings were written with few decimals") {
    std::mt19937_64 random{4};
    std::normal_distribution<double> noise{0, 1};
    auto const written = [](double x, double place) { return std::round(x / place) * place; };
    for (double const step : {5.0 / 1024, 0.0249739, 1.0 / 30}) {
        for (double const place : {1e-4, 1e-6}) {
            CAPTURE(step, place);
            std::vector<double> values, fine;
            for (int i = 0; i < 300; ++i) {
                double const x = std::sin(0.02 * i) + 0.05 * noise(random);
                values.push_back(written(step * std::round(x / step), place));
                fine.push_back(written(x, place));
            }
            CHECK_THAT(quantisation_step(values), WithinRel(step, 1e-3));
            CHECK(quantisation_step(fine) < 2 * place); // what they are written with, or nothing
        }
    }
}

TEST_CASE("the step need not occur as a difference") {
    CHECK_THAT(quantisation_step({0, 0.4, 1.0}), WithinRel(0.2, 1e-9));
    CHECK_THAT(quantisation_step({7, 7.6, 8.6, 7}), WithinRel(0.2, 1e-9));
}

TEST_CASE("a decimal grid is found at any distance from zero") {
    std::vector<double> values;
    for (int i = 0; i < 200; ++i) values.push_back(std::stod("123.45" + std::to_string(100 + i)));
    CHECK_THAT(quantisation_step(values), WithinRel(1e-5, 1e-6));
}

TEST_CASE("no step is invented") {
    CHECK(quantisation_step({}) == 0);
    CHECK(quantisation_step({3}) == 0);
    CHECK(quantisation_step({3, 3, 3}) == 0);
    CHECK(quantisation_step({-1e308, 1e308}) == 0);
    std::mt19937_64 random{2};
    std::normal_distribution<double> noise{0, 1};
    std::vector<double> values;
    for (int i = 0; i < 300; ++i) values.push_back(noise(random));
    CHECK(quantisation_step(values) == 0);
}

TEST_CASE("beside an absurd reading no step is found rather than the distance to it") {
    for (double const absurd : {1e308, -1e308, 1e20}) {
        CAPTURE(absurd);
        CHECK(quantisation_step({0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5, absurd}) == 0);
    }
}

TEST_CASE("different values are counted up to a limit") {
    CHECK(sivid::distinct_count({}, 3) == 0);
    CHECK(sivid::distinct_count({1, 1, 1}, 3) == 1);
    CHECK(sivid::distinct_count({1, 2, 1, 2}, 3) == 2);
    CHECK(sivid::distinct_count({1, 2, 3, 4, 5}, 3) == 3);
}

TEST_CASE("a step is found in whatever unit readings are") {
    std::mt19937_64 random{4};
    std::normal_distribution<double> noise{0, 1};
    std::vector<double> values;
    double const step = 5.0 / 1024;
    for (int i = 0; i < 300; ++i) { // written with four places
        double const x = std::sin(0.02 * i) + 0.05 * noise(random);
        values.push_back(std::round(step * std::round(x / step) * 1e4));
    }
    for (int const k : {-12, -9, -4, 0, 3, 9}) {
        CAPTURE(k);
        auto scaled = values;
        for (double& v : scaled) v *= std::pow(10.0, k);
        CHECK_THAT(quantisation_step(scaled), WithinRel(1e4 * step * std::pow(10.0, k), 1e-3));
    }
}
