// SPDX-License-Identifier: MIT
#include <sivid/approximate/fit/detail/thinned.hpp>
#include <sivid/approximate/fit/fit.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;

namespace {

/// x = 2 exp(-0.5 t), `count` times within three seconds, errors that fill their bound, half of
/// them this way, half that.
identification_problem decay(std::size_t count, std::size_t outliers = 0) {
    auto problem = plain_problem::make(0, outliers);
    auto& data = problem.experiments[0].measurements;
    data.clear();
    for (std::size_t k = 1; k <= count; ++k) {
        double const t = 3 * static_cast<double>(k) / static_cast<double>(count);
        double const error = 0.0499 * std::sin(37.0 * static_cast<double>(k * k % 1009));
        double const seen = 2 * std::exp(-plain_problem::truth * t) + error;
        data.push_back({t, 0, interval(seen - 0.05, seen + 0.05)});
    }
    return problem;
}

} // namespace

TEST_CASE("few measurements stay what they are") {
    auto const problem = decay(100);
    CHECK(measurement_count(problem) == 100);
    auto const same = thinned(problem, 100);
    CHECK(same.experiments[0].measurements.size() == 100);
    CHECK(thinned_indices(problem, 100)[0].size() == 100);
}

TEST_CASE("thinned measurements are every n-th of a channel, and its last") {
    auto problem = decay(1000, 7);
    problem.model.about.channels.push_back({"again", "m"});
    problem.model.observe.push_back(problem.model.observe[0]);
    auto& data = problem.experiments[0].measurements;
    for (std::size_t k = 0; k < 50; ++k) {
        data.push_back({2.9 - 0.01 * static_cast<double>(k), 1, interval(0.0, 2.0)}); // not sorted
    }
    auto const all = sorted(data);
    problem.experiments.push_back(experiment(problem.experiments[0]));
    auto const some = thinned(problem, 210);
    auto const indices = thinned_indices(problem, 210);
    REQUIRE(indices.size() == 2);
    for (std::size_t const e : {0u, 1u}) {
        auto const& left = some.experiments[e].measurements;
        REQUIRE(left.size() == 105);              // a tenth of each
        CHECK(some.experiments[e].outliers == 4); // 0.7 and three times its root
        REQUIRE(indices[e].size() == left.size());
        std::size_t slow = 0;
        for (std::size_t k = 0; k < left.size(); ++k) {
            auto const& m = all[indices[e][k]];
            CHECK(left[k].time == m.time);
            CHECK(left[k].channel == m.channel);
            CHECK(left[k].bound.lower() == m.bound.lower());
            slow += left[k].channel;
        }
        CHECK(slow == 5);
        CHECK(left.back().time == 3);
        auto const last = [](auto const& m) { return m.channel == 1 && m.time == 2.9; };
        CHECK(std::any_of(left.begin(), left.end(), last));
    }
    // What stands beside the measurements is thinned with them.
    std::vector<double> numbers;
    for (std::size_t k = 0; k < all.size(); ++k) numbers.push_back(static_cast<double>(k));
    auto const beside = thinned(std::vector<std::vector<double>>{numbers, numbers}, indices);
    REQUIRE(beside[1].size() == 105);
    CHECK(beside[1][17] == static_cast<double>(indices[1][17]));
}

TEST_CASE("a fit of many measurements answers for all of them") {
    constexpr std::size_t count = 5 * many_measurements;
    auto const explained = fit(decay(count));
    REQUIRE(explained.parameters.size() == 1);
    CHECK(explained.inflation <= 1);
    CHECK(std::abs(explained.parameters[0] - plain_problem::truth) < 2e-3);
    CHECK(explained.residuals[0].size() == count);
    auto const from = fit(decay(count), fit_norm::largest, {{0.9}, {}});
    CHECK(from.inflation <= 1);

    // One that thinning leaves out contradicts.
    auto spoilt = decay(count);
    auto const kept = thinned_indices(spoilt, many_measurements)[0];
    std::size_t const odd = kept[kept.size() / 2] + 1;
    REQUIRE(std::find(kept.begin(), kept.end(), odd) == kept.end());
    auto& bound = spoilt.experiments[0].measurements[odd].bound;
    bound = interval(bound.lower() + 0.5, bound.upper() + 0.5); // ten error bounds off
    auto const missed = fit(spoilt);
    CHECK(missed.inflation > 3);
    CHECK(missed.inflation < 10);
    // The budget allows it, and some more of which thinning keeps more than their share.
    spoilt.experiments[0].outliers = 5;
    for (std::size_t const k : {1u, 2u, 3u}) {
        auto& also = spoilt.experiments[0].measurements[kept[kept.size() / 2 + 100 * k]].bound;
        also = interval(also.lower() - 0.5, also.upper() - 0.5);
    }
    CHECK(fit(spoilt).inflation <= 1);
}
