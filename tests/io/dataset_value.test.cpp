// SPDX-License-Identifier: MIT
#include <sivid/io/dataset_value.hpp>

#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("inputs are exact when none has an error") {
    scenario s;
    CHECK(s.inputs_exact());
    s.inputs.push_back({sampled_signal{{0, 1}, {1, 2}, interpolation::linear}, {}, {}});
    CHECK(s.inputs_exact());
    s.inputs.push_back({sampled_signal{{0, 1}, {1, 2}, interpolation::linear}, {0.1, 0.1}, {}});
    CHECK_FALSE(s.inputs_exact());
}

TEST_CASE("each scenario has its own outlier budget") {
    dataset data;
    data.max_outlier_fraction = *exact_decimal::parse("0.1");
    scenario s;
    for (auto [count, budget] : {std::pair{0, 0}, {9, 0}, {10, 1}, {29, 2}, {30, 3}}) {
        s.measurements.resize(static_cast<std::size_t>(count));
        CHECK(data.outlier_budget(s) == static_cast<std::size_t>(budget));
    }
}
