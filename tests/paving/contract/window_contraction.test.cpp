// SPDX-License-Identifier: MIT
#include <sivid/paving/contract/window_contraction.hpp>

#include <sivid/paving/identify.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"
#include "support/pendulum.hpp"
#include "support/planted_problems.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

double last_time(experiment const& e) {
    double last = e.begin;
    for (auto const& m : e.measurements) last = std::max(last, m.time);
    return last;
}

window_options within(double seconds) {
    window_options options;
    options.seconds = seconds;
    return options;
}

} // namespace

TEST_CASE("windows keep what is feasible in random problems") {
    std::size_t tried = 0, contracted = 0, several = 0;
    for (std::uint64_t seed = 1; seed <= support::swept(25U, 70U); ++seed) {
        draws d(seed);
        auto planted = planted::plant_by_seed(d);
        auto& p = planted.problem;
        window_options options;
        options.seconds = 1.5;
        options.windows = 2 + d.below(6);
        options.longest =
            d.uniform(0.2, 1.2) * (last_time(p.experiments[0]) - p.experiments[0].begin);
        options.share = d.coin() ? 0.02 : 0.2;
        CAPTURE(seed);
        auto const left = contract_by_windows(p, options);
        REQUIRE_FALSE(left.empty());
        REQUIRE(contains(left.rest, planted.truth));
        CHECK(subset(left.rest, p.prior));
        for (std::size_t e = 0; e < p.experiments.size(); ++e) {
            if (p.experiments[e].outliers == 0)
                REQUIRE(contains(left.starts[e], planted.starts[e]));
        }
        ++tried;
        several += left.windows > 2 ? 1 : 0;
        contracted += relative_volume(left.rest, p.prior).upper() < 0.9 ? 1 : 0;
    }
    CHECK(several > tried / 3);
    CHECK(contracted > tried / 4);
}

TEST_CASE("windows contract a prior that no trajectory carries") {
    auto const p = support::swinging(6, 0.3, 7);
    auto const left = contract_by_windows(p, within(120));
    REQUIRE_FALSE(left.empty());
    CHECK(left.windows > 10);
    for (std::size_t j = 0; j < 3; ++j) {
        CAPTURE(j, width(left.rest[j]) / width(p.prior[j]));
        CHECK(contains(left.rest[j], support::pendulum_truth[j]));
        CHECK(width(left.rest[j]) < 0.3 * width(p.prior[j]));
    }
    CHECK(contains(left.starts[0], std::vector<double>{0.5, 0}));
}

TEST_CASE("a prior without the truth is emptied or kept but nothing is invented") {
    auto p = support::swinging(4, 0.1, 8);
    p.prior[0] = interval(12.0, 13.0);
    auto const left = contract_by_windows(p, within(60));
    CHECK(left.empty());
    identify_options options;
    options.search.seconds = 20;
    auto const found = identify(p, options);
    CHECK(found.verdict == verdict::inconsistent);
}

TEST_CASE("experiments with outliers take no part in windows") {
    auto const spoilt = plain_problem::make(1, 1);
    auto const left = contract_by_windows(spoilt);
    CHECK(left.windows == 0);
    CHECK(subset(spoilt.prior, left.rest));
    auto const sound = contract_by_windows(plain_problem::make());
    CHECK(sound.windows > 0);
    CHECK(subset(plain_problem::feasible(), sound.rest[0]));
    CHECK(width(sound.rest[0]) < 1.1 * width(plain_problem::feasible()));
}

TEST_CASE("windows are carried by Taylor models and series or not at all") {
    auto const p = support::swinging(1, 0.2, 10, 0.1);
    CHECK(contract_by_windows(p).windows > 0);
    window_options other;
    other.run.set = carried_set::doubleton;
    CHECK(contract_by_windows(p, other).windows == 0);
    window_options method;
    method.run.enclosure.method = rk4();
    CHECK(contract_by_windows(p, method).windows == 0);
}

TEST_CASE("windows end in time and when told to") {
    auto const p = support::swinging(20, 0.3, 9);
    int asked = 0;
    window_options options;
    options.keep_going = [&] { return ++asked < 200; };
    auto const left = contract_by_windows(p, options);
    CHECK(contains(left.rest, std::vector<double>{9, 0.3, 4}));
    CHECK(left.seconds < 30);
}

TEST_CASE("starts that are decimals are known: no windows are carried") {
    auto p = support::swinging(6, 0.95, 7);
    p.experiments[0].initial[0] = interval(std::nextafter(0.5, 0.0), std::nextafter(0.5, 1.0));
    identify_options options;
    options.search.seconds = 2;
    options.search.boxes = 16;
    auto const known = identify(p, options);
    CHECK((!known.windows || known.windows->windows == 0));
    p.experiments[0].initial[0] = interval(0.2, 0.8);
    auto const unknown = identify(p, options);
    REQUIRE(unknown.windows.has_value());
    CHECK(unknown.windows->windows > 0);
}
