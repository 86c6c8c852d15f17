// SPDX-License-Identifier: MIT
#include <sivid/paving/inflation/detail/inflation_search.hpp>

#include "support/catch.hpp"
#include "support/inflations.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {
bool always() { return true; }
} // namespace

TEST_CASE("the bound grows towards the inflation and never passes it") {
    draws d(411);
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        auto const planted = support::tightened(
            support::plant(d, model, {.experiments = 2, .samples = 10, .outliers = model % 2}), 4);
        double const at_truth = support::inflation_of(planted, planted.truth, planted.starts);
        inflation_search search(planted.problem, {});
        double before = 0;
        double promised = HUGE_VAL;
        search.policy().propose = [&](inflation_relaxation const& found, bool complete) {
            if (complete) promised = std::min(promised, found.approximate_value);
        };
        for (int step = 0; step < 15 && search.next() != nullptr; ++step) {
            search.step(always);
            double const lower = search.lower();
            CHECK(lower >= before);
            CHECK(lower <= at_truth * (1 + 1e-9));
            CHECK(lower <= promised * (1 + 1e-6));
            before = lower;
        }
        // The boxes still cover everything.
        auto const cover = search.cover();
        for (int sample = 0; sample < 20; ++sample) {
            auto const p = d.in(planted.problem.prior);
            CHECK(std::any_of(cover.begin(), cover.end(),
                              [&](box const& b) { return contains(b, p); }));
        }
    }
}

TEST_CASE("boxes above the bound are dropped, those with less are kept") {
    draws d(412);
    auto const prior = between(0.25, 3);
    auto const problem = support::decay(prior, 0.5, 0.16, 0.0078125);
    double const exact = support::decay_inflation(prior, 0.5, 0.16, 0.0078125);
    inflation_search search(problem, {});
    double const above = 1.5 * exact;
    search.policy().above = above;
    search.policy().propose = [](inflation_relaxation const&, bool) {};
    for (int step = 0; step < 40 && search.next() != nullptr; ++step) {
        search.step(always);
    }
    CHECK(search.lower() <= exact * (1 + 1e-6));
    CHECK(search.lower() >= 0.99 * exact);
    auto const cover = search.cover();
    double widths = 0;
    for (auto const& b : cover) widths += width(b[0]);
    CHECK(widths < 0.5 * width(prior));
    for (int sample = 0; sample < 2000; ++sample) {
        double const p = d.uniform(prior.lower(), prior.upper());
        double const there =
            std::max(std::abs(std::exp(-p) - 0.5), std::abs(std::exp(-2 * p) - 0.16)) / 0.0078125;
        if (there > above * (1 - 1e-9)) continue;
        CHECK(std::any_of(cover.begin(), cover.end(),
                          [&](box const& b) { return contains(b, std::vector<double>{p}); }));
    }
    // With a bound that nothing attains, nothing is left but the bound.
    search.policy().above = 0.5 * exact;
    CHECK(search.next() == nullptr);
    CHECK(search.lower() == 0.5 * exact);
    CHECK(search.cover().empty());
}

TEST_CASE("a point is bounded once and kept") {
    auto const problem = support::decay(interval(1.0), 0.5, 0.25, 0.0625);
    inflation_search search(problem, {});
    search.policy().propose = [](inflation_relaxation const&, bool) {};
    int steps = 0;
    for (; search.next() != nullptr && steps < 10; ++steps) {
        search.step(always);
    }
    CHECK(steps == 2);
    CHECK_THAT(search.lower(), WithinAbs((0.5 - std::exp(-1)) / 0.0625, 1e-6));
    CHECK(search.cover().size() == 1);
}
