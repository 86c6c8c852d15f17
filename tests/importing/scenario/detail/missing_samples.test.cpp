// SPDX-License-Identifier: MIT
#include <sivid/importing/scenario/detail/missing_samples.hpp>

#include "support/catch.hpp"

using namespace sivid;
using list = std::vector<std::size_t>;

TEST_CASE("missing samples are counted where steps are alike, in any unit") {
    bool regular = false;
    for (double const unit : {1e-9, 1.0, 3600.0}) {
        std::vector<double> steps{1, 1.1, 2, 0.9, 1, 4.1, 1, 0, 1};
        for (double& s : steps) s *= unit;
        CHECK(missing_by_steps(steps, 0.25, regular) == list{0, 0, 1, 0, 0, 3, 0, 0, 0});
        CHECK(regular);
    }
    CHECK(missing_by_steps({1, 2, 4, 8, 16, 32}, 0.25, regular) == list{0, 0, 0, 0, 0, 0});
    CHECK_FALSE(regular);
    CHECK(missing_by_steps({}, 0.25, regular).empty());
    CHECK_FALSE(regular);
    CHECK(missing_by_steps({0, 0}, 0.25, regular) == list{0, 0});
}

TEST_CASE("rows without a sample are missing ones only where the others have theirs") {
    auto const missing = [](std::vector<int> const& kinds) { // 1 a sample, 0 none, 2 a wrong one
        sample_rows rows;
        std::size_t count = 0;
        for (int const k : kinds) {
            rows.add(0, k > 0, k == 1);
            count += k == 1;
        }
        list result;
        for (std::size_t i = 0; i < count; ++i) result.push_back(rows.missing_before(i));
        return result;
    };
    CHECK(missing({1, 1, 1, 0, 1, 1}) == list{0, 0, 0, 1, 0});
    CHECK(missing({0, 0, 1, 1, 1, 2, 2, 1}) == list{0, 0, 0, 2});
    CHECK(missing({1, 0, 0, 1, 0, 0, 1, 0, 0, 1}) == list{0, 0, 0, 0}); // every third row
    CHECK(missing({1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 1}) == list{0, 0, 0, 1, 0});
    CHECK(missing({1, 0, 1, 2, 0, 0, 1}) == list{0, 0, 1}); // no pattern: the wrong one counts
    CHECK(missing({0, 2}).empty());
    sample_rows rows;
    rows.add(3, true, true);
    rows.add(2, true, true);
    CHECK(rows.lost_before(0) == 0);
    CHECK(rows.lost_before(1) == 2);
}
