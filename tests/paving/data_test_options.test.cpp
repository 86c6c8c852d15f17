// SPDX-License-Identifier: MIT
#include <sivid/paving/data_test_options.hpp>

#include "support/catch.hpp"

TEST_CASE("boxes are contracted, and witnesses are verified by finer runs than boxes") {
    sivid::data_test_options const o;
    CHECK((o.contract && o.cut));
    CHECK((0 < o.sharp_enough && o.sharp_enough < 1));
    CHECK(o.witness.enclosure.tolerance < o.run.enclosure.tolerance);
    CHECK(o.witness.enclosure.minimum_step < o.run.enclosure.minimum_step);
    CHECK(o.witness.set == sivid::carried_set::doubleton); // which kinks do not stop
}
