// SPDX-License-Identifier: MIT
// The smallest number of outliers, against planted ones and against a sweep in closed form.
#include <sivid/paving/outlier_budget.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"
#include "support/epidemic.hpp"
#include "support/problems.hpp"

#include <sivid/paving/identify.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

/// x = x0 exp(-a t): how many of the samples the best rate in [from, to] violates.
std::size_t sweep(std::vector<experiment> const& runs, double from, double to) {
    std::vector<std::pair<double, int>> ends;
    std::size_t all = 0;
    for (auto const& e : runs) {
        double const x0 = mid(e.initial[0]);
        for (auto const& m : e.measurements) {
            ++all;
            if (!(m.bound.upper() > 0)) continue;
            double const low = std::max(from, -std::log(m.bound.upper() / x0) / m.time);
            double const high =
                m.bound.lower() > 0 ? std::min(to, -std::log(m.bound.lower() / x0) / m.time) : to;
            if (!(low <= high)) continue;
            ends.emplace_back(low, -1);
            ends.emplace_back(high, 1);
        }
    }
    std::sort(ends.begin(), ends.end());
    std::size_t depth = 0, most = 0;
    for (auto const& [at, kind] : ends) {
        if (kind < 0) {
            most = std::max(most, ++depth);
        } else {
            --depth;
        }
    }
    return all - most;
}

identification_problem decays(draws& d, std::size_t experiments, double noise, double chaos) {
    auto problem = plain_problem::make();
    auto const one = problem.experiments[0];
    problem.experiments.clear();
    for (std::size_t e = 0; e < experiments; ++e) {
        auto run = one;
        run.name += std::to_string(e);
        run.initial[0] = interval(d.uniform(1, 3));
        run.measurements.clear();
        for (int k = 1; k <= 10; ++k) {
            double const t = 0.3 * k;
            double x = mid(run.initial[0]) * std::exp(-plain_problem::truth * t);
            x += d.uniform(-1, 1) * noise;
            if (d.uniform(0, 1) < chaos) x += d.uniform(-1, 1);
            run.measurements.push_back({t, 0, interval(x - noise, x + noise)});
        }
        problem.experiments.push_back(run);
    }
    return problem;
}

void check_witness(identification_problem const& problem, smallest_budget const& found,
                   std::size_t total) {
    REQUIRE(found.budgets.size() == problem.experiments.size());
    CHECK(std::accumulate(found.budgets.begin(), found.budgets.end(), std::size_t{0}) ==
          found.total.most);
    CHECK(found.total.least <= total);
    CHECK(found.total.most >= total);
    REQUIRE(found.witness);
    CHECK(contains(problem.prior, found.witness->parameters));
}

} // namespace

TEST_CASE("the smallest number of outliers of decays is the one that a sweep finds") {
    draws d(761);
    int exact = 0, several = 0;
    for (int round = 0; round < 24; ++round) {
        auto const experiments = 1 + d.below(3);
        auto const problem = decays(d, experiments, d.uniform(0.01, 0.05), d.uniform(0, 0.4));
        CAPTURE(round, experiments);
        auto const found = smallest_outlier_budget(problem);
        auto const total = sweep(problem.experiments, 0.25, 1);
        check_witness(problem, found, total);
        REQUIRE(found.alone.size() == experiments);
        for (std::size_t e = 0; e < experiments; ++e) {
            auto const own = sweep({problem.experiments[e]}, 0.25, 1);
            CHECK(found.alone[e].least <= own);
            CHECK(found.alone[e].most >= own);
        }
        exact += found.total.exact() ? 1 : 0;
        several += total > 1 ? 1 : 0;
    }
    CHECK(exact >= 22);
    CHECK(several >= 8);
}

TEST_CASE("planted outliers are never outnumbered from below, and named when they are fewest") {
    draws d(762);
    int exact = 0, named = 0, planted_in_all = 0;
    for (int round = 0; round < 14; ++round) {
        support::planting how;
        how.experiments = 1 + d.below(2);
        how.samples = 10 + d.below(6);
        how.outliers = d.below(3);
        how.spread = d.below(4) == 0 ? 0.01 : 0;
        how.noise = 0.03;
        auto const model = d.below(support::planted_models);
        auto planted = support::plant(d, model, how);
        auto const total = how.experiments * how.outliers;
        CAPTURE(round, model, how.experiments, how.outliers, how.spread);
        for (auto& e : planted.problem.experiments) e.outliers = 0; // not told
        outlier_search_options options;
        options.boxes = 600;
        auto const found = smallest_outlier_budget(planted.problem, options);
        CHECK(found.total.least <= total);
        REQUIRE(found.witness);
        std::size_t violated = 0;
        for (std::size_t e = 0; e < how.experiments; ++e) {
            auto const& w = *found.witness;
            CHECK(planted.violated(e, w.parameters, w.starts[e], 1e-10) <= found.budgets[e]);
            CHECK(contains(planted.problem.experiments[e].initial, w.starts[e]));
            violated += found.budgets[e];
            CHECK(found.alone[e].least <= how.outliers);
        }
        CHECK(violated == found.total.most);
        exact += found.total.exact() ? 1 : 0;
        if (found.total.most != total) continue;
        // With these budgets the truth is feasible again, unless they are shared out otherwise.
        bool same = true;
        for (std::size_t e = 0; e < how.experiments; ++e) {
            same = same && found.budgets[e] == how.outliers;
            planted.problem.experiments[e].outliers = found.budgets[e];
        }
        if (!same) continue;
        identify_options search;
        search.search.boxes = 300;
        auto const set = identify(planted.problem, search);
        CHECK(set.verdict == verdict::consistent);
        CHECK(contains(set.hull, planted.truth));
        for (auto const& f : set.forced) {
            CHECK(planted.outliers[f.experiment].count(f.measurement) == 1);
        }
        named += static_cast<int>(set.forced.size());
        planted_in_all += static_cast<int>(total);
    }
    CHECK(exact >= 11);
    CHECK(named >= planted_in_all / 2);
    CHECK(planted_in_all >= 8);
}

TEST_CASE("scenarios that are consistent alone and not together cost one outlier in all") {
    draws d(763);
    auto problem = decays(d, 2, 0.02, 0);
    // One run decays at another rate: every one of its samples after the first disagrees.
    auto& other = problem.experiments[1];
    other.measurements.clear();
    double const x0 = mid(other.initial[0]);
    for (int k = 1; k <= 5; ++k) {
        double const x = x0 * std::exp(-0.8 * 0.4 * k);
        other.measurements.push_back({0.4 * k, 0, interval(x - 0.01, x + 0.01)});
    }
    auto const found = smallest_outlier_budget(problem);
    CHECK(found.alone[0].most == 0);
    CHECK(found.alone[1].most == 0);
    auto const total = sweep(problem.experiments, 0.25, 1);
    CHECK(total >= 4);
    CHECK(found.total.exact());
    CHECK(found.total.most == total);
}

TEST_CASE("a search that is stopped leaves proved bounds") {
    draws d(764);
    auto const problem = decays(d, 2, 0.01, 0.5);
    auto const total = sweep(problem.experiments, 0.25, 1);
    for (std::size_t const boxes : {0u, 1u, 3u, 10u}) {
        outlier_search_options options;
        options.boxes = boxes;
        auto const found = smallest_outlier_budget(problem, options);
        CHECK(found.total.least <= total);
        CHECK(found.total.most >= total);
    }
    outlier_search_options options;
    options.keep_going = [] { return false; };
    CHECK(smallest_outlier_budget(problem, options).boxes == 0);
    auto nothing = problem;
    nothing.experiments.clear();
    CHECK_THROWS_AS(smallest_outlier_budget(nothing), std::invalid_argument);
}

TEST_CASE("a search for outliers says why it ended before its count was exact") {
    draws d(764);
    auto const problem = decays(d, 2, 0.01, 0.5);
    auto const total = sweep(problem.experiments, 0.25, 1);
    auto const ended = [&](auto const& limit) {
        outlier_search_options options;
        options.seconds = 600;
        limit(options);
        auto const found = smallest_outlier_budget(problem, options);
        CHECK(found.total.least <= total);
        CHECK(found.total.most >= total);
        CHECK(found.total.exact() == (found.reason == stop_reason::decided));
        return found.reason;
    };
    CHECK(ended([](auto&) {}) == stop_reason::decided);
    CHECK(ended([](auto& o) { o.boxes = 3; }) == stop_reason::box_budget);
    CHECK(ended([](auto& o) { o.memory = 1; }) == stop_reason::memory_budget);
    CHECK(ended([](auto& o) { o.seconds = 0; }) == stop_reason::time_budget);
    CHECK(ended([](auto& o) { o.keep_going = [] { return false; }; }) == stop_reason::cancelled);
}

TEST_CASE("outliers are counted where runs over most of the prior end at once") {
    auto problem = support::infection(1e6, 1);
    for (std::size_t const k : {4u, 8u}) { // no rate explains either beside the others
        auto& bound = problem.experiments[0].measurements[k].bound;
        bound = interval(3 * bound.lower(), 3 * bound.upper());
    }
    auto const found = smallest_outlier_budget(problem, {.seconds = 60});
    CHECK(found.total.least == 2);
    CHECK(found.total.most == 2);
    outlier_search_options alone;
    alone.seconds = 5;
    alone.strategy = {};
    CHECK_FALSE(smallest_outlier_budget(problem, alone).total.exact());
}

TEST_CASE("a search for outliers that is told to stop says what is proved") {
    draws d(883);
    auto const planted = support::plant(d, 0, {.experiments = 2, .samples = 12, .outliers = 2});
    outlier_search_options patient;
    patient.seconds = 600;
    auto const whole = smallest_outlier_budget(planted.problem, patient);
    REQUIRE(whole.total.exact());
    for (std::size_t const most : {0u, 1u, 20u, 200u, 2000u, 20000u}) {
        std::atomic<std::size_t> asked = 0;
        outlier_search_options options;
        options.seconds = 600;
        options.keep_going = [&] { return ++asked <= most; };
        auto const part = smallest_outlier_budget(planted.problem, options);
        CAPTURE(most);
        CHECK(part.total.least <= whole.total.least);
        CHECK(part.total.most >= whole.total.most);
    }
    auto const none = smallest_outlier_budget(planted.problem, {.seconds = 0});
    CHECK_FALSE(none.witness);
    CHECK(none.total.most == 24);
}
