// SPDX-License-Identifier: MIT
#include <sivid/paving/static/detail/static_block.hpp>

#include "support/catch.hpp"

#include "paving/static_models.hpp"
#include <bit>

using sivid::static_block;

TEST_CASE("a box is copied with what is open for it, and pads the lanes") {
    static_block from(2), to(2);
    from.boxes.lower(1)[3] = -4;
    from.boxes.upper(1)[3] = 5;
    from.open[3] = 9;
    from.missed[3] = 2;
    to.copy(from, 3, 0);
    to.count = 1;
    to.pad(4);
    CHECK(to.count == 1);
    CHECK_FALSE(to.full());
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(to.boxes.lower(1)[i] == -4);
        CHECK(to.boxes.upper(1)[i] == 5);
        CHECK(to.open[i] == 9);
        CHECK(to.missed[i] == 2);
    }
    CHECK(to.missed[4] == 0);
}

TEST_CASE("a whole list is open, of any length up to a word") {
    static_block b(1);
    for (std::size_t const n : {0U, 1U, 63U, 64U}) {
        b.list = std::make_shared<std::vector<sivid::static_samples::index> const>(n);
        b.open_all(2, 3);
        CHECK(static_cast<std::size_t>(std::popcount(b.open[2])) == n);
        CHECK(b.missed[2] == 3);
    }
}

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
