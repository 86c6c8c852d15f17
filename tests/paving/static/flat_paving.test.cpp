// SPDX-License-Identifier: MIT
#include <sivid/paving/static/flat_paving.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("boxes beyond one chunk are kept, their volumes summed") {
    box const whole{interval(0, 1), interval(0, 4), interval(2)};
    box_chunk from(3);
    from.lower(2)[7] = from.upper(2)[7] = 2;
    flat_paving paving(whole);
    std::size_t const n = 2 * box_chunk::capacity + 3;
    for (std::size_t k = 0; k < n; ++k) {
        from.lower(0)[7] = 0.25;
        from.upper(0)[7] = 0.5;
        from.lower(1)[7] = static_cast<double>(k);
        from.upper(1)[7] = static_cast<double>(k) + 1;
        (k % 2 == 0 ? paving.inside : paving.open).add(from, 7);
    }
    CHECK(paving.inside.size() == (n + 1) / 2);
    CHECK(paving.open.size() == n / 2);
    CHECK(paving.open.lower(200, 1) == 401);
    CHECK(paving.inside.at(256)[1].upper() == 513);
    CHECK(contains(paving.inner_volume(), static_cast<double>((n + 1) / 2) / 16));
    CHECK(contains(paving.uncertain_volume(), static_cast<double>(n / 2) / 16));
    CHECK(width(paving.inner_volume()) < 1e-10);
    auto const boxes = paving.boxes();
    CHECK(boxes.count(box_verdict::inside) == (n + 1) / 2);
    CHECK(boxes.count(box_verdict::undecided) == n / 2);
}

TEST_CASE("the hull is that of all boxes, and empty of none") {
    box const whole{interval(0, 8), interval(0, 8)};
    flat_paving paving(whole);
    CHECK(is_empty(paving.hull()));
    paving.open.add(box{interval(1, 2), interval(3, 4)});
    paving.inside.add(box{interval(5), interval(3.5)});
    CHECK(paving.open.at(0)[1].upper() == 4);
    CHECK(paving.open.hull()[0].upper() == 2);
    CHECK(width(paving.inside.hull()) == 0);
    auto const hull = paving.hull();
    CHECK(hull[0].lower() == 1);
    CHECK(hull[0].upper() == 5);
    CHECK(hull[1].lower() == 3);
    CHECK(hull[1].upper() == 4);
}
