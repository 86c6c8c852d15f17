// SPDX-License-Identifier: MIT
#include <sivid/paving/static_block.hpp>

#include "support/catch.hpp"

using sivid::static_block;

TEST_CASE("a box is copied with what is open for it, and pads the lanes") {
    static_block from(2, 2), to(2, 2);
    from.boxes.lower(1)[3] = -4;
    from.boxes.upper(1)[3] = 5;
    from.open[7] = 9;
    from.missed[3] = 2;
    to.copy(from, 3, 0);
    to.count = 1;
    to.pad(4);
    CHECK(to.count == 1);
    CHECK_FALSE(to.full());
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(to.boxes.lower(1)[i] == -4);
        CHECK(to.boxes.upper(1)[i] == 5);
        CHECK(to.open[2 * i + 1] == 9);
        CHECK(to.missed[i] == 2);
    }
    CHECK(to.missed[4] == 0);
}
