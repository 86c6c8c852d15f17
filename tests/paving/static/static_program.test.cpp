// SPDX-License-Identifier: MIT
#include <sivid/paving/static/static_program.hpp>

#include "paving/static_models.hpp"
#include "support/catch.hpp"

#include <sivid/number/pack.hpp>

#include <array>
#include <cstdint>
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
        program.start(
            m, [&](std::size_t j) { return traits::bounds((j ? q : p) - w, (j ? q : p) + w); });
        CHECK(m.common == typename traits::mask{});
        for (auto const& own : problem.measurements) {
            auto const k = own.channel;
            program.at(m, k, traits::point(own.time));
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

TEST_CASE("jumps are seen") {
    static_program const program(static_models::mixed_problem(1.2, 0.7));
    CHECK(program.parameters() == 2);
    for (std::size_t c = 0; c < 3; ++c) CHECK(program.differentiable(c) == (c != 2));
}

TEST_CASE("fixed constants are bound, and an undefined output is flagged") {
    auto problem = static_models::mixed_problem(1.2, 0.7);
    problem.choice.fixed["s"] = interval(4.0);
    static_program const program(problem);
    auto m = program.memory<interval>();
    program.start(m, [](std::size_t j) { return interval(j ? 2.0 : 1.0); });
    program.at(m, 0, interval(1.0));
    bool undefined = false;
    CHECK(contains(program.value(m, 0, undefined), std::exp(-2.0) + 0.5));
    CHECK_FALSE(undefined);
    program.at(m, 1, interval(1.0));
    (void)program.value(m, 1, undefined);
    CHECK(undefined);
    // The next parameters are not the last ones.
    program.start(m, [](std::size_t j) { return interval(j ? 1.0 : 5.0); });
    undefined = false;
    CHECK(contains(program.value(m, 1, undefined), 2));
    CHECK_FALSE(undefined);
}

TEST_CASE("each lane has a time of its own") {
    using I = pack<8>;
    auto const problem = static_models::mixed_problem(1.2, 0.7);
    static_program const program(problem);
    auto m = program.memory<I>();
    program.start(m, [](std::size_t j) { return I(interval(j ? 0.7 : 1.2)); });
    std::array<double, 8> const times{0, 0.25, 0.5, 1, 1.5, 2, 3, 5};
    program.at(m, 0, I::load(times.data(), times.data()));
    std::uint64_t undefined = 0;
    auto const y = program.value(m, 0, undefined);
    program.differentiate_at(m, 0, undefined);
    CHECK(undefined == 0);
    for (std::size_t n = 0; n < 8; ++n) {
        double const t = times[n];
        CHECK(std::abs(mid(y[n]) - static_models::value(0, t, 1.2, 0.7)) < 1e-12);
        CHECK(std::abs(mid(program.slope(m, 0, 0)[n]) - (std::exp(-0.7 * t) + 0.35 * t)) < 1e-12);
    }
}

TEST_CASE("the program is as long for a thousand measurements as for one") {
    auto problem = static_models::ring_problem();
    auto const one = static_program(problem).memory<interval>().values.size();
    problem.measurements.assign(1000, problem.measurements[0]);
    for (std::size_t k = 0; k < 1000; ++k) problem.measurements[k].time = 0.1 * double(k);
    CHECK(static_program(problem).memory<interval>().values.size() == one);
}
