// SPDX-License-Identifier: MIT
#include <sivid/paving/static/detail/static_samples.hpp>

#include "paving/static_models.hpp"
#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("measurements stand by channels, in their order") {
    auto problem = static_models::mixed_problem(1.2, 0.7);
    problem.measurements = {{3, 2, interval(0, 1)},
                            {1, 0, interval(1, 2)},
                            {2, 2, interval(2, 3)},
                            {0, 0, interval(3, 4)}};
    static_samples const s(problem);
    CHECK(s.size() == 4);
    CHECK(s.time == std::vector<double>{1, 0, 3, 2});
    CHECK(s.lower == std::vector<double>{1, 3, 0, 2});
    CHECK(s.upper == std::vector<double>{2, 4, 1, 3});
    CHECK(s.end == std::vector<static_samples::index>{2, 2, 4});
    CHECK(s.channel(0) == 0);
    CHECK(s.channel(1) == 0);
    CHECK(s.channel(2) == 2);
    CHECK(s.all() == std::vector<static_samples::index>{0, 1, 2, 3});
}
