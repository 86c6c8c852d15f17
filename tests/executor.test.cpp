// SPDX-License-Identifier: MIT
#include <sivid/executor.hpp>

#include "support/catch.hpp"

#include <cstddef>
#include <stdexcept>
#include <vector>

using sivid::executor;

TEST_CASE("without a pool the tasks run one after the other, each once") {
    std::vector<std::size_t> order;
    executor{}(4, [&](std::size_t k) { order.push_back(k); });
    CHECK(order == std::vector<std::size_t>{0, 1, 2, 3});
    executor{}(0, [&](std::size_t k) { order.push_back(k); });
    CHECK(order.size() == 4);
}

TEST_CASE("a pool is asked where it can help") {
    std::size_t asked = 0;
    executor workers{2, [&](std::size_t count, auto const& task) {
                         ++asked;
                         for (std::size_t k = count; k-- > 0;) task(k);
                     }};
    std::vector<std::size_t> order;
    auto const note = [&](std::size_t k) { order.push_back(k); };
    workers(3, note);
    CHECK(order == std::vector<std::size_t>{2, 1, 0});
    workers(1, note);
    CHECK(asked == 1);
    workers.threads = 1;
    workers(3, note);
    CHECK(asked == 1);
    CHECK(order.size() == 7);
}

TEST_CASE("what a task throws comes out") {
    CHECK_THROWS_AS(executor{}(2,
                               [](std::size_t k) {
                                   if (k == 1) throw std::runtime_error("task");
                               }),
                    std::runtime_error);
}
