// SPDX-License-Identifier: MIT
#include <sivid/paving/taylor_kernels.hpp>

#include "support/catch.hpp"

#include <cstddef>
#include <utility>

TEST_CASE("the smallest kernel that has a variable for every unknown is chosen") {
    auto const chosen = [](std::size_t unknowns) {
        return sivid::with_taylor_kernel(unknowns, []<std::size_t N, std::size_t D>() {
            return std::pair<std::size_t, std::size_t>(N, D);
        });
    };
    using kernel = std::pair<std::size_t, std::size_t>;
    kernel const expected[] = {{1, 0}, {2, 4}, {2, 4}, {3, 4},  {4, 3},  {6, 2},  {6, 2},
                               {9, 2}, {9, 2}, {9, 2}, {12, 2}, {12, 2}, {12, 2}, {0, 0}};
    for (std::size_t n = 0; n <= 13; ++n) CHECK(chosen(n) == expected[n]);
}
