// SPDX-License-Identifier: MIT
#include <sivid/io/dataset_value.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("each scenario has its own outlier budget") {
    dataset data;
    data.max_outlier_fraction = *exact_decimal::parse("0.1");
    scenario s;
    for (auto [count, budget] : {std::pair{0, 0}, {9, 0}, {10, 1}, {29, 2}, {30, 3}}) {
        s.measurements.resize(static_cast<std::size_t>(count));
        CHECK(data.outlier_budget(s) == static_cast<std::size_t>(budget));
    }
}
