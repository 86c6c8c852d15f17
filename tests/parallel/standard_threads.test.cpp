// SPDX-License-Identifier: MIT
// Searches in threads of the standard library, which the thread sanitizer understands (preset
// sanitize-thread).
#include <sivid/number/guard.hpp>
#include <sivid/paving/identify.hpp>

#include "support/catch.hpp"
#include "support/problems.hpp"
#include "support/threads.hpp"

#include <atomic>
#include <optional>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

bool same(identification const& a, identification const& b) {
    bool equal = a.verdict == b.verdict && a.reason == b.reason && a.boxes == b.boxes &&
                 a.paving.boxes().size() == b.paving.boxes().size();
    for (std::size_t k = 0; equal && k < a.paving.boxes().size(); ++k) {
        auto const &x = a.paving.boxes()[k], &y = b.paving.boxes()[k];
        equal = x.verdict == y.verdict && x.set.size() == y.set.size();
        for (std::size_t i = 0; equal && i < x.set.size(); ++i)
            equal = sivid::equal(x.set[i], y.set[i]);
    }
    return equal;
}

} // namespace

TEST_CASE("the guard is asked by many threads at once") {
    std::atomic<int> held = 0;
    support::threads(4)(16, [&](std::size_t) {
        require_sound_environment();
        ++held;
    });
    CHECK(held == 16);
}

TEST_CASE("a search in threads of the standard library finds the same, box for box") {
    draws d(5104);
    for (std::size_t round = 0; round < 3; ++round) {
        support::planting how;
        how.experiments = 2;
        how.samples = 6;
        how.outliers = round;
        auto const planted = support::plant(d, round % support::planted_models, how);
        identify_options options;
        options.search.accuracy = 1.0 / 100;
        options.search.boxes = 120;
        options.search.seconds = 1e9;
        options.search.batches = 3;
        options.drawn_boxes = 100;
        auto const alone = identify(planted.problem, options);
        options.search.workers = support::threads(3);
        CAPTURE(round);
        CHECK(same(identify(planted.problem, options), alone));
        // Several searches share the problem.
        std::vector<std::optional<identification>> found(3);
        options.search.workers = {};
        support::threads(3)(found.size(), [&](std::size_t k) {
            found[k].emplace(identify(planted.problem, options));
        });
        for (auto const& f : found) CHECK(same(*f, alone));
    }
}
