// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/diagnosis.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("the shrink of a gap encloses every quotient of the excesses") {
    auto const s = shrink(interval(3, 5), interval(1, 2));
    REQUIRE(s);
    CHECK(s->lower() == 0.5); // (2 - 1)/(3 - 1)
    CHECK(s->upper() == 1);
    auto const closed = shrink(interval(3, 5), interval(0.5, 0.75));
    CHECK(closed->lower() == 1);
    CHECK(closed->upper() == 1);
    // A gap that is worse afterwards shrinks by a negative share.
    auto const worse = shrink(interval(2, 3), interval(5, 6));
    CHECK(worse->lower() == -4);
    CHECK(worse->upper() == -1);
    auto const exact = shrink(interval(1.5, 1.5), interval(1.125, 1.125));
    CHECK(contains(*exact, 0.75));
    CHECK(width(*exact) < 1e-14);
}

TEST_CASE("a gap that is not proved has no bounded shrink") {
    CHECK_FALSE(shrink(interval(0.5, 1), interval(0.5, 0.6)));
    auto const unsure = shrink(interval(0.9, 3), interval(0.5, 0.75));
    CHECK(unsure->lower() == -std::numeric_limits<double>::infinity());
    CHECK(unsure->upper() == 1);
    CHECK(shrink(interval(2, 3), unknown_inflation())->lower() ==
          -std::numeric_limits<double>::infinity());
    CHECK(shrink(unknown_inflation(), interval(2, 3))->upper() == 1);
}

TEST_CASE("verdicts have their names in files") {
    CHECK(to_string(gap_verdict::certified) == "certified");
    CHECK(to_string(gap_verdict::none) == "none");
    CHECK(to_string(cause_verdict::explains) == "explains");
    CHECK(to_string(cause_verdict::excluded) == "excluded");
    CHECK(to_string(answer_kind::unexplained) == "unexplained");
    CHECK(to_string(answer_kind::open) == "open");
}
