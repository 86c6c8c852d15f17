// SPDX-License-Identifier: MIT
#include <sivid/approximate/simulate/approximate_program.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <cmath>

using namespace sivid;

TEST_CASE("every operation has its plain value") {
    auto const model = support::model_of(
        {2, 1, 1}, [](auto const& t, auto const& x, auto const& p, auto const& u) {
            using std::abs;
            auto const a = x[0];
            auto const b = x[1];
            return std::vector{a + b - p[0] * u[0],
                               a / b + t,
                               sqrt(a) + exp(b) + log(a),
                               sin(a) * cos(b) + tan(b),
                               atan(a) + tanh(b),
                               abs(b) + sign(b) + sign(-b),
                               min(a, b) + max(a, p[0]),
                               pown(a, 5) + sqr(b) - 2.5,
                               -(a * b)};
        });
    program_shape const shape{2, 1, 1};
    auto rate = model.rate;
    approximate_program const program(model.g, rate, shape);
    auto memory = program.memory();
    double const t = 0.3, a = 1.7, b = -0.4, u = 2.2, p = 0.9;
    memory[shape.constant()] = p;
    program.prepare(memory);
    memory[0] = t;
    memory[shape.state()] = a;
    memory[shape.state() + 1] = b;
    memory[shape.input()] = u;
    program.run(memory);
    double const expected[] = {a + b - p * u,
                               a / b + t,
                               std::sqrt(a) + std::exp(b) + std::log(a),
                               std::sin(a) * std::cos(b) + std::tan(b),
                               std::atan(a) + std::tanh(b),
                               std::abs(b),
                               std::min(a, b) + std::max(a, p),
                               std::pow(a, 5) + b * b - 2.5,
                               -(a * b)};
    REQUIRE(program.output_count() == std::size(expected));
    for (std::size_t k = 0; k < std::size(expected); ++k) {
        CAPTURE(k);
        CHECK_THAT(memory[program.output(k)], WithinAbs(expected[k], 1e-12));
    }
}

TEST_CASE("what depends on constants alone is computed by prepare") {
    auto const model =
        support::model_of({1, 2}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{x[0] * exp(p[0] * p[1])};
        });
    approximate_program const program(model.g, model.rate, {1, 0, 2});
    auto memory = program.memory();
    for (double const p : {0.5, 1.5}) {
        memory[2] = p;
        memory[3] = 2;
        program.prepare(memory);
        memory[1] = 3;
        program.run(memory);
        CHECK_THAT(memory[program.output(0)], WithinAbs(3 * std::exp(2 * p), 1e-9));
    }
}

TEST_CASE("divisions by one divisor are products, and mean the same") {
    // By a constant, by what several divide by, by what one does; by 0, too.
    auto const model =
        support::model_of({2, 1}, [](auto const& t, auto const& x, auto const& p, auto const&) {
            auto const s = sqr(x[1]);
            return std::vector{x[0] / p[0], (x[0] + t) / p[0] / 3.0, x[0] / s, x[1] / s,
                               t / x[0],    p[0] / (2 * p[0]),       1 / s};
        });
    approximate_program const program(model.g, model.rate, {2, 0, 1});
    auto memory = program.memory();
    double const t = 0.3;
    for (double const p : {0.9, -3.0}) {
        memory[3] = p;
        program.prepare(memory);
        for (double const b : {0.7, -2.0, 0.0}) {
            double const a = 1.7, s = b * b;
            memory[0] = t;
            memory[1] = a;
            memory[2] = b;
            program.run(memory);
            double const expected[] = {a / p, (a + t) / p / 3, a / s, b / s, t / a, 0.5, 1 / s};
            for (std::size_t k = 0; k < std::size(expected); ++k) {
                CAPTURE(p, b, k);
                double const found = memory[program.output(k)];
                if (std::isfinite(expected[k]))
                    CHECK_THAT(found, WithinAbs(expected[k], 1e-14 * (1 + std::abs(expected[k]))));
                else
                    CHECK_FALSE(std::isfinite(found));
            }
        }
    }
}
