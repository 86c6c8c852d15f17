// SPDX-License-Identifier: MIT
#include <sivid/paving/judge/feasibility_test_options.hpp>
#include <sivid/paving/run_options.hpp>

#include "support/catch.hpp"

using sivid::enclosure_options;
using sivid::feasibility_test_options;
using sivid::run_options;

TEST_CASE("runs of many boxes take coarser steps than one enclosure") {
    CHECK(run_options{}.tolerance > enclosure_options{}.tolerance);
    CHECK(run_options{}.minimum_step > enclosure_options{}.minimum_step);
}

TEST_CASE("options of steps are run options, and options of a test are both") {
    run_options const run{enclosure_options{.tolerance = 0.5}};
    CHECK(run.tolerance == 0.5);
    feasibility_test_options test;
    test.tolerance = 0.25;
    test.degree = 3;
    run_options const of_test = test;
    enclosure_options const steps = test;
    CHECK(of_test.tolerance == 0.25);
    CHECK(of_test.degree == 3);
    CHECK(steps.tolerance == 0.25);
}
