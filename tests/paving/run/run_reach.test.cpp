// SPDX-License-Identifier: MIT
#include <sivid/paving/run/run_reach.hpp>

#include <sivid/paving/identify.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"
#include "support/pendulum.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>

using namespace sivid;

TEST_CASE("runs that end early name the state that is wide and what spreads it") {
    auto p = support::swinging(6, 0.5, 7);
    auto const by_prior = reach_of_runs(p, p.prior, {});
    REQUIRE(by_prior.size() == 1);
    auto const& r = by_prior[0];
    CHECK_FALSE(r.complete());
    CHECK(r.end == 6);
    CHECK(r.until > 0.1);
    CHECK(r.until < 6);
    CHECK(r.width > 1);
    REQUIRE_FALSE(r.causes.empty());
    double sum = 0;
    for (std::size_t k = 0; k < r.causes.size(); ++k) {
        CHECK_FALSE(r.causes[k].start);
        CHECK((r.causes[k].name == "k" || r.causes[k].name == "d" || r.causes[k].name == "F"));
        if (k > 0) CHECK(r.causes[k].share <= r.causes[k - 1].share);
        sum += r.causes[k].share;
    }
    CHECK(sum <= 1 + 1e-12);
    // With the truth's constants and wide starts these are what spreads.
    for (std::size_t j = 0; j < p.prior.size(); ++j)
        p.prior[j] = interval(support::pendulum_truth[j]);
    p.experiments[0].initial = {interval(-1.5, 1.5), interval(-6.0, 6.0)};
    auto const by_starts = reach_of_runs(p, p.prior, {});
    REQUIRE_FALSE(by_starts[0].causes.empty());
    CHECK(by_starts[0].causes[0].start);
    CHECK_FALSE(by_starts[0].complete());
}

TEST_CASE("runs that are complete say how much measurements are moved and what was lost") {
    auto p = plain_problem::make();
    auto const r = reach_of_runs(p, p.prior, {})[0];
    CHECK(r.complete());
    // x(t) = 2 exp(-a t) is moved most at t = 1.5 to 2: affine parts of the range over the prior
    double widest = 0;
    for (int k = 1; k <= 6; ++k) {
        double const t = 0.5 * k;
        widest = std::max(widest, 0.5 * (2 * std::exp(-0.25 * t) - 2 * std::exp(-1.0 * t)) / 0.05);
    }
    CHECK_THAT(r.moved, WithinAbs(widest, 0.1 * widest));
    CHECK(r.lost < 1);
    p.prior[0] = interval(0.4999, 0.5001);
    CHECK(reach_of_runs(p, p.prior, {})[0].moved < 0.01);
}

TEST_CASE("no parameter moves a measurement by more than the spread that is stated") {
    auto p = plain_problem::make();
    auto const r = reach_of_runs(p, p.prior, {})[0];
    CHECK(r.instants == r.measured);
    auto const& side = p.prior[0];
    double most = 0;
    for (auto const& m : p.experiments[0].measurements) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int k = 0; k <= 100; ++k) {
            double const a = side.lower() + (side.upper() - side.lower()) * k / 100;
            double const x = 2 * std::exp(-a * m.time);
            low = std::min(low, x);
            high = std::max(high, x);
        }
        most = std::max(most, 0.5 * (high - low) / (0.5 * width(m.bound)));
    }
    CHECK(r.spread >= most);
    CHECK(r.spread < 1.3 * most);
    CHECK(r.spread >= r.moved);
    // An exact measurement has no bound to be compared with.
    p.experiments[0].measurements[2].bound =
        interval(p.experiments[0].measurements[2].bound.lower());
    CHECK_FALSE(std::isfinite(reach_of_runs(p, p.prior, {})[0].spread));
}

TEST_CASE("a run that time ends says that it says nothing") {
    auto const p = support::swinging(8, 0.01, 7);
    auto const whole = reach_of_runs(p, p.prior, {})[0];
    CHECK_FALSE(whole.interrupted);
    CHECK(whole.instants < whole.measured);
    run_options some;
    some.keep_going = [left = std::make_shared<int>(4)] { return --*left > 0; };
    auto const cut = reach_of_runs(p, p.prior, some);
    REQUIRE(cut.size() == 1);
    CHECK(cut[0].interrupted);
    CHECK(cut[0].until < whole.until);
}

TEST_CASE("long records are looked at in places and time ends the looking") {
    auto const p = support::swinging(8, 0.01, 7);
    auto const r = reach_of_runs(p, p.prior, {})[0];
    CHECK(r.end == 8);
    CHECK(r.until > 1);
    run_options none;
    none.keep_going = [] { return false; };
    CHECK(reach_of_runs(p, p.prior, none).empty());
}

TEST_CASE("identifications that leave much say how far runs are carried and others do not") {
    identify_options options;
    options.search.boxes = 4;
    options.search.seconds = 5;
    options.strategy = {};
    auto p = support::swinging(6, 0.95, 7);
    p.experiments[0].initial = {interval(-1.5, 1.5), interval(-6.0, 6.0)};
    auto const found = identify(p, options);
    REQUIRE(found.reach.size() == 1);
    CHECK(found.reach[0].until < 6);
    CHECK(identify(plain_problem::make()).reach.empty());
}
