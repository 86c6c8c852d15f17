// SPDX-License-Identifier: MIT
#include <sivid/paving/static/mean_value_cut.hpp>

#include "paving/static_models.hpp"
#include "support/catch.hpp"

#include <random>

using namespace sivid;

TEST_CASE("no point that satisfies leaves the rest, none that violates leaves the core") {
    using I = pack<4>;
    using traits = interval_traits<I>;
    auto const problem = static_models::mixed_problem(1.2, 0.7);
    static_program const program(problem);
    auto memory = program.memory<I>();
    mean_value_cut<4> cut(program);
    std::mt19937 random(9);
    std::uniform_real_distribution<double> place(-0.5, 0.5), size(0.01, 0.4), share(-1, 1);
    std::size_t cut_off = 0;
    for (int round = 0; round < 150; ++round) {
        std::vector<I> sides(2);
        for (std::size_t n = 0; n < 4; ++n) {
            for (std::size_t j = 0; j < 2; ++j) {
                double const m = (j == 0 ? 1.2 : 0.7) + place(random), r = size(random);
                sides[j].set(n, interval(m - r, m + r));
            }
        }
        for (auto const& own : problem.measurements) {
            auto const k = own.channel;
            if (!program.differentiable(k)) continue;
            traits::mask undefined{};
            program.start(memory, [&](std::size_t j) { return sides[j]; });
            program.at(memory, k, traits::point(own.time));
            (void)program.value(memory, k, undefined);
            program.differentiate_at(memory, k, undefined);
            auto const bound = traits::bounds(own.bound.lower(), own.bound.upper());
            cut.begin(sides);
            CHECK_FALSE(cut.used());
            auto const lanes = traits::all_lanes & ~undefined;
            auto const says = cut.use(program, memory, k, bound, lanes, 0b0111, 0b1110);
            CHECK(cut.used());
            CHECK((says.proved & ~lanes) == 0);
            for (std::size_t n = 0; n < 4; ++n) {
                auto const in = [n](I const& x, double v) {
                    return x.lower(n) - 1e-12 <= v && v <= x.upper(n) + 1e-12;
                };
                for (int sample = 0; sample < 30; ++sample) {
                    double const p = mid(sides[0][n]) + share(random) * rad(sides[0][n]);
                    double const q = mid(sides[1][n]) + share(random) * rad(sides[1][n]);
                    double const y = static_models::value(own.channel, own.time, p, q);
                    bool const holds = y >= own.bound.lower() && y <= own.bound.upper();
                    bool const in_rest = in(cut.rest(0), p) && in(cut.rest(1), q);
                    bool const in_core = in(cut.core(0), p) && in(cut.core(1), q);
                    cut_off += in_rest && in_core ? 0 : 1;
                    if (holds) CHECK(in_rest);
                    if (!holds) CHECK(in_core);
                    if (((says.hit >> n) & 1U) != 0) CHECK(holds);
                    if (((says.miss >> n) & 1U) != 0) CHECK_FALSE(holds);
                }
                if (n == 3) CHECK(cut.rest(0).lower(n) == sides[0].lower(n));
                if (n == 0) CHECK(cut.core(0).lower(n) == sides[0].lower(n));
            }
        }
    }
    CHECK(cut_off > 10000);
}
