// SPDX-License-Identifier: MIT
#include <sivid/enclosure/options.hpp>
#include <sivid/enclosure/methods.hpp>

#include "support/catch.hpp"

#include <cmath>

using namespace sivid;

TEST_CASE("an enclosure is cancelled when who is asked says so and never when nobody is") {
    enclosure_options options;
    CHECK_FALSE(options.cancelled());
    bool go = true;
    options.keep_going = [&go] { return go; };
    CHECK_FALSE(options.cancelled());
    go = false;
    CHECK(options.cancelled());
    CHECK(enclosure_options{options}.cancelled());
}

TEST_CASE("lengths of steps are shares of the span") {
    enclosure_options const asked{.minimum_step = 1e-3};
    for (double const span : {0x1p-20, 1.0, 30.0, 1e6}) {
        CHECK(for_span(asked, span).minimum_step == asked.minimum_step);
        CHECK(for_span(asked, span).shortest_step() == asked.minimum_step * span);
        double const longest = for_span(asked, span).longest_step();
        CHECK(longest > span / 10); // ten of them are the span, whatever is rounded
        CHECK(longest < span / 10 * (1 + 1e-8));
        CHECK(for_span(for_span(asked, 7), span).shortest_step() == asked.minimum_step * span);
    }
    CHECK(for_span(asked, 0).span == asked.span); // nothing to do
}

TEST_CASE("a longest step that was asked for is taken as it is") {
    enclosure_options const asked{.maximum_step = 0.5};
    for (double const span : {0.0, 0x1p-20, 30.0, 1e6}) {
        CHECK(for_span(asked, span).longest_step() == 0.5);
    }
}

TEST_CASE("a method is asked for what its order reaches") {
    CHECK(for_method({}).tolerance == enclosure_options{}.tolerance);
    enclosure_options options;
    options.method = rk4();
    CHECK(for_method(options).tolerance == std::pow(10.0, -10));
    options.tolerance = 1e-6;
    CHECK(for_method(options).tolerance == 1e-6);
    options.minimum_step = 1e-3;
    CHECK(for_method(options).minimum_step == 1e-6);
}
