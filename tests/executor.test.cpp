// SPDX-License-Identifier: MIT
#include <sivid/executor.hpp>

#include "support/catch.hpp"

#include <cstddef>
#include <stdexcept>
#include <thread>
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

TEST_CASE(
    "work counts the same whoever does it: tasks begin at one time, and what they did adds up") {
    using sivid::work_clock;
    auto const counted = [](executor const& workers) {
        std::vector<double> begins(40);
        work_clock::set(0); // whole numbers are added exactly
        double const begin = work_clock::now();
        workers(begins.size(), [&](std::size_t k) {
            begins[k] = work_clock::now() - begin;
            work_clock::advance(static_cast<double>(k));
        });
        begins.push_back(work_clock::now() - begin);
        return begins;
    };
    auto const alone = counted({});
    executor const backwards{2, [](std::size_t count, auto const& task) {
                                 for (std::size_t k = count; k-- > 0;) task(k);
                             }};
    executor const elsewhere{2, [](std::size_t count, auto const& task) {
                                 std::vector<std::thread> all;
                                 for (std::size_t k = 0; k < count; ++k) all.emplace_back(task, k);
                                 for (auto& t : all) t.join();
                             }};
    CHECK(counted(backwards) == alone);
    CHECK(counted(elsewhere) == alone);
    CHECK(alone[0] == 0);
    CHECK(alone[15] == 0);      // of the same round
    CHECK(alone[16] == 120);    // 0 + ... + 15
    CHECK(alone.back() == 780); // 0 + ... + 39
}

TEST_CASE("a task that throws leaves the clock of its thread where it was") {
    using sivid::work_clock;
    double const before = work_clock::now();
    try {
        executor{}(1, [](std::size_t) {
            work_clock::advance(5);
            throw std::runtime_error("task");
        });
    } catch (std::runtime_error const&) {
        CHECK(work_clock::now() == before);
    }
}
