// SPDX-License-Identifier: MIT
#include <sivid/paving/run/detail/scalar_run.hpp>

#include <sivid/paving/response/local_response.hpp>

#include "support/catch.hpp"
#include "support/problems.hpp"

#include <cstddef>

using namespace sivid;
using support::draws;

TEST_CASE("runs in scalars enclose the outputs of all parameters and starts") {
    draws d(3301);
    std::size_t compared = 0;
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        for (double const spread : {0.0, 0.03}) {
            auto const planted =
                support::plant(d, model, {.samples = 10, .noise = 0.1, .spread = spread});
            auto const& problem = planted.problem;
            auto const& e = problem.experiments[0];
            flow const f(problem.model, problem.choice, e.inputs);
            auto const samples = sorted(e.measurements);
            auto const run = make_scalar_run(f, e, samples, e.initial, problem.prior, {});
            auto part = problem.prior;
            for (std::size_t j = 0; j < part.size(); ++j) {
                double const w = 0.02 * width(part[j]);
                part[j] = intersect(part[j], interval(planted.truth[j] - w, planted.truth[j] + w));
            }
            auto const known = (*run)(e.initial, part);
            for (int k = 0; k < 5; ++k) {
                auto const p = k == 0 ? planted.truth : d.in(part);
                auto const start = k == 0 ? planted.starts[0] : d.in(e.initial);
                auto const y = planted.simulate(0, p, start);
                auto const ranges = output_ranges(*known, point_within(part, p));
                for (std::size_t i = 0; i < ranges.size(); ++i, ++compared) {
                    REQUIRE(ranges[i].lower() - 1e-9 <= y[i]);
                    REQUIRE(y[i] <= ranges[i].upper() + 1e-9);
                }
            }
        }
    }
    CHECK(compared >= 500);
}
