// SPDX-License-Identifier: MIT
#include <sivid/paving/run/detail/lending_pool.hpp>

#include "support/catch.hpp"

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

TEST_CASE("a pool makes as many as are borrowed at once, and lends them again") {
    int made = 0;
    sivid::lending_pool<std::unique_ptr<int>> pool([&] { return std::make_unique<int>(++made); });
    CHECK(made == 0);
    for (int k = 0; k < 3; ++k) CHECK(**pool.borrow() == 1);
    {
        auto one = pool.borrow();
        auto two = pool.borrow();
        CHECK(**one != **two);
    }
    CHECK(made == 2);
}

TEST_CASE("what a pool has lent to one thread is for no other") {
    std::atomic<int> made = 0;
    sivid::lending_pool<std::unique_ptr<int>> pool([&] {
        ++made;
        return std::make_unique<int>(0);
    });
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&] {
            for (int k = 0; k < 1000; ++k) {
                auto lent = pool.borrow();
                ++**lent;
            }
        });
    }
    for (auto& t : threads) t.join();
    CHECK(made <= 4);
    int sum = 0;
    std::vector<std::unique_ptr<sivid::lending_pool<std::unique_ptr<int>>::loan>> all;
    for (int k = 0; k < made; ++k) {
        all.push_back(std::make_unique<sivid::lending_pool<std::unique_ptr<int>>::loan>(pool));
        sum += ***all.back();
    }
    CHECK(sum == 4000);
}
