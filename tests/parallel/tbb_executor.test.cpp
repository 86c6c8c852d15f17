// SPDX-License-Identifier: MIT
// Threads change nothing but the time. (How oneTBB's own library synchronises the thread sanitizer
// does not see, and it reports all of it: its preset leaves these out, and runs those in threads of
// the standard library.)
#include <sivid/parallel/tbb_executor.hpp>

#include <sivid/paving/identify.hpp>

#include "support/catch.hpp"
#include "support/problems.hpp"

#include <atomic>
#include <cfenv>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

using namespace sivid;
using support::draws;

namespace {

bool same(box const& a, box const& b) {
    bool equal = a.size() == b.size();
    for (std::size_t i = 0; equal && i < a.size(); ++i) {
        equal = a[i].lower() == b[i].lower() && a[i].upper() == b[i].upper();
    }
    return equal;
}
void check_same(subpaving const& a, subpaving const& b) {
    REQUIRE(a.boxes().size() == b.boxes().size());
    std::size_t differing = 0;
    for (std::size_t k = 0; k < a.boxes().size(); ++k) {
        differing += !same(a.boxes()[k].set, b.boxes()[k].set) ||
                     a.boxes()[k].verdict != b.boxes()[k].verdict;
    }
    CHECK(differing == 0);
    CHECK(a.inner_volume().lower() == b.inner_volume().lower());
    CHECK(a.outer_volume().upper() == b.outer_volume().upper());
}

} // namespace

TEST_CASE("every task runs once, on several threads, and faults come back") {
    auto const workers = tbb_executor(3);
    CHECK(workers.threads == 3);
    std::vector<std::atomic<int>> calls(500);
    std::mutex mutex;
    std::set<std::thread::id> seen;
    workers(calls.size(), [&](std::size_t k) {
        ++calls[k];
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        std::lock_guard const guard(mutex);
        seen.insert(std::this_thread::get_id());
    });
    for (auto const& c : calls) CHECK(c == 1);
    CHECK(seen.size() > 1);
    CHECK(seen.size() <= 3);
    CHECK_THROWS_AS(workers(10,
                            [](std::size_t k) {
                                if (k == 7) throw std::runtime_error("seven");
                            }),
                    std::runtime_error);
    int run = 0;
    workers(0, [&](std::size_t) { ++run; });
    CHECK(run == 0);
    CHECK(tbb_executor().threads >= 1);
}

TEST_CASE("a search finds the same with 1, 2 and 3 threads, box for box") {
    draws d(5101);
    for (int round = 0; round < 14; ++round) {
        support::planting how;
        how.experiments = 1 + d.below(2);
        how.samples = 5 + d.below(6);
        how.outliers = d.below(3);
        how.spread = d.below(3) == 0 ? 0.01 : 0;
        how.noise = d.uniform(0.005, 0.04);
        auto const model = d.below(support::planted_models);
        auto const planted = support::plant(d, model, how);
        identify_options options;
        options.search.accuracy = 1.0 / 100;
        options.search.boxes = 150 + d.below(300);
        options.search.seconds = 1e9;
        options.search.sufficient_ratio = 0.95;
        options.search.batches = 1 + d.below(4);
        options.drawn_boxes = 100;
        auto const kind = d.below(5);
        if (kind == 0) options = by_bisection(options);
        if (kind == 1) options.test.set = carried_set::doubleton;
        CAPTURE(round, model, kind, options.search.batches);
        auto const alone = identify(planted.problem, options);
        CHECK(contains(alone.hull, planted.truth));
        for (std::size_t const threads : {1u, 2u, 3u}) {
            options.search.workers = tbb_executor(threads);
            auto const found = identify(planted.problem, options);
            CAPTURE(threads);
            CHECK(found.verdict == alone.verdict);
            CHECK(found.reason == alone.reason);
            CHECK(found.boxes == alone.boxes);
            CHECK(found.integrations == alone.integrations);
            CHECK(same(found.hull, alone.hull));
            check_same(found.paving, alone.paving);
        }
    }
}

TEST_CASE("many searches at once on one pool of threads do not disturb each other") {
    draws d(5102);
    support::planting how;
    how.experiments = 2;
    auto const planted = support::plant(d, 1, how);
    identify_options options;
    options.search.accuracy = 1.0 / 200;
    options.search.boxes = 200;
    options.search.seconds = 1e9;
    options.search.sufficient_ratio = 1;
    options.search.batches = 2;
    auto const alone = identify(planted.problem, options);
    auto const workers = tbb_executor(3);
    options.search.workers = workers;
    std::vector<std::optional<identification>> found(4);
    workers(found.size(),
            [&](std::size_t k) { found[k].emplace(identify(planted.problem, options)); });
    for (auto const& f : found) check_same(f->paving, alone.paving);
}

TEST_CASE("a thread whose rounding was changed proves nothing") {
    draws d(5103);
    auto const planted = support::plant(d, 0, {});
    identify_options options;
    options.search.boxes = 100;
    options.search.batches = 4;
    options = by_bisection(options);
    auto const pool = tbb_executor(2);
    // Whatever runs the tasks must leave the rounding mode alone; this one does not.
    options.search.workers = {2, [pool](std::size_t count, executor::task const& work) {
                                  pool.run(count, [&work](std::size_t k) {
                                      int const before = std::fegetround();
                                      std::fesetround(FE_UPWARD);
                                      try {
                                          work(k);
                                      } catch (...) {
                                          std::fesetround(before);
                                          throw;
                                      }
                                      std::fesetround(before);
                                  });
                              }};
    CHECK_THROWS_AS(identify(planted.problem, options), unsound_environment);
}
