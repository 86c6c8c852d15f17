// SPDX-License-Identifier: MIT
#include <sivid/paving/search/detail/split_rule.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

using namespace sivid;
using support::between;

TEST_CASE(
    "the hull is measured anew where the old one leaves nothing, or the wrong side, to split") {
    box const whole{between(0, 100), between(0, 1)};
    box const x{between(0, 0.5), between(0, 0.5)};
    std::size_t looks = 0;
    auto const hull = [&] {
        ++looks;
        return box{between(0, 1), between(0, 1)};
    };
    inversion_options options{.accuracy = 0.1};
    paving_detail::split_rule rule{.whole = whole};
    CHECK(rule(x, {2, 1}, options, 8, hull) == 1); // of the prior: the first side is narrow
    CHECK(looks == 0);
    options.accuracy_of_hull = true;
    CHECK(rule(x, {1, 2}, options, 8, hull) == 1); // the best side may be split
    CHECK(looks == 0);
    CHECK(rule(x, {2, 1}, options, 8, hull) == 0);
    CHECK(looks == 1);
    CHECK(rule.measured_at == 8);
    rule.whole = whole;
    CHECK(rule(x, {2, 1}, options, 9, hull) == 1); // not for every box
    CHECK(rule(x, {2, 1}, options, 10, hull) == 0);
    CHECK(looks == 2);
    CHECK_FALSE(rule(box{between(0, 0.05), between(0, 0.1)}, {}, options, 30, hull));
}
