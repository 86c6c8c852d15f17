// SPDX-License-Identifier: MIT
#include <sivid/paving/static_program.hpp>

#include "paving/static_models.hpp"
#include "support/catch.hpp"

#include <sivid/number/pack_traits.hpp>

#include <random>

using namespace sivid;

namespace {

/// Values and slopes at points are near those in doubles, and differences; over boxes they enclose.
template <class I>
void check_program() {
    using traits = interval_traits<I>;
    auto const problem = static_models::mixed_problem(1.2, 0.7);
    static_program const program(problem);
    auto m = program.template memory<I>();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0.1, 2), size(0, 0.2);
    for (int round = 0; round < 200; ++round) {
        double const p = place(random) + 4, q = place(random), w = size(random);
        auto const cut = program.start(
            m, [&](std::size_t j) { return traits::bounds((j ? q : p) - w, (j ? q : p) + w); });
        CHECK(cut == typename traits::mask{});
        for (std::size_t k = 0; k < program.outputs(); ++k) {
            auto const& own = problem.measurements[k];
            typename traits::mask undefined{};
            auto const y = program.value(m, k, undefined);
            for (double const a : {-w, 0.0, w}) {
                double const exact = static_models::value(own.channel, own.time, p + a, q - a);
                if (std::isnan(exact)) continue;
                CHECK(traits::lower(y) <= exact + 1e-12);
                CHECK(exact - 1e-12 <= traits::upper(y));
            }
            if (own.channel == 2 || undefined != typename traits::mask{}) continue;
            program.differentiate_at(m, k, undefined);
            auto const at = [&](double a, double b) {
                return static_models::value(own.channel, own.time, a, b);
            };
            double const h = 1e-6;
            double const d[] = {(at(p + h, q) - at(p - h, q)) / (2 * h),
                                (at(p, q + h) - at(p, q - h)) / (2 * h)};
            for (std::size_t j = 0; j < 2; ++j) {
                auto const& slope = program.slope(m, k, j);
                CHECK(traits::lower(slope) <= d[j] + 1e-6);
                CHECK(d[j] - 1e-6 <= traits::upper(slope));
            }
        }
    }
}

} // namespace

TEST_CASE("values and gradients enclose, in scalars and packs") {
    check_program<interval>();
    check_program<pack<8>>();
}

TEST_CASE("repeated parameters and jumps are seen") {
    auto const problem = static_models::mixed_problem(1.2, 0.7);
    static_program const program(problem);
    CHECK(program.parameters() == 2);
    for (std::size_t k = 0; k < program.outputs(); ++k) {
        auto const channel = problem.measurements[k].channel;
        CHECK(program.differentiable(k) == (channel != 2));
        if (channel == 0 && problem.measurements[k].time > 0) CHECK(program.repeats(k));
        if (channel == 1) CHECK_FALSE(program.repeats(k));
    }
    static_program const ring(static_models::ring_problem());
    CHECK_FALSE(ring.repeats(0));
}

TEST_CASE("fixed constants are bound, and an undefined output is flagged") {
    auto problem = static_models::mixed_problem(1.2, 0.7);
    problem.choice.fixed["s"] = interval(4.0);
    problem.measurements = {{1.0, 0, interval(0, 1)}, {1.0, 1, interval(0, 1)}};
    static_program const program(problem);
    auto m = program.memory<interval>();
    (void)program.start(m, [](std::size_t j) { return interval(j ? 2.0 : 1.0); });
    bool undefined = false;
    CHECK(contains(program.value(m, 0, undefined), std::exp(-2.0) + 0.5));
    CHECK_FALSE(undefined);
    (void)program.value(m, 1, undefined);
    CHECK(undefined);
}
