// SPDX-License-Identifier: MIT
#include <sivid/paving/static/detail/static_block.hpp>

#include "support/catch.hpp"

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
