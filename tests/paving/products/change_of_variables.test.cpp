// SPDX-License-Identifier: MIT
// Identification in coordinates of the user's: planted truths, the parameters' own prior, and maps
// that are no inverses.
#include <sivid/paving/products/change_of_variables.hpp>

#include "support/catch.hpp"
#include "support/problems.hpp"

#include <sivid/paving/identifiability.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/inflation.hpp>
#include <sivid/paving/inflation/detail/holdout_inflation.hpp>
#include <sivid/paving/outlier_budget.hpp>
#include <sivid/paving/run/run_reach.hpp>

#include <cmath>
#include <cstddef>

using namespace sivid;
using support::between;
using support::draws;

namespace {

constexpr auto decay_rate = [](auto const&, auto const& x, auto const& p, auto const&) {
    return std::vector{p[1] * p[0] - p[0] * x[0]};
};
box const decay_prior{between(0.5, 2), between(0.25, 0.75)};

/// (p0, p1) in (p0 p1, p0), in (p0 + p1, p0 - p1), or in (p0, 1/p1).
change_of_variables coordinates(std::size_t which) {
    switch (which) {
    case 0:
        return change(
            {{"gain", "1/s"}, {"rate", "1/s"}}, 2,
            [](auto const& p) {
                return std::vector{p[0] * p[1], p[0] * 1};
            },
            [](auto const& q) {
                return std::vector{q[1] * 1, q[0] / q[1]};
            });
    case 1:
        return change(
            {{"sum", "1"}, {"difference", "1"}}, 2,
            [](auto const& p) {
                return std::vector{p[0] + p[1], p[0] - p[1]};
            },
            [](auto const& q) {
                return std::vector{0.5 * (q[0] + q[1]), 0.5 * (q[0] - q[1])};
            });
    default:
        return change(
            {{"p0", "1"}, {"inverse", "1"}}, 2,
            [](auto const& p) {
                return std::vector{p[0] * 1, 1 / p[1]};
            },
            [](auto const& q) {
                return std::vector{q[0] * 1, 1 / q[1]};
            });
    }
}
identification found_in(changed_problem const& posed, std::size_t boxes) {
    identify_options o;
    o.search.seconds = 20;
    o.search.boxes = boxes;
    return identify(posed.problem(), o);
}

} // namespace

TEST_CASE("the coordinates of docs/theory/identification.md") {
    draws d(5);
    auto const planted = support::plant(d, {1, 2, 0, 10}, decay_rate, decay_prior, {1}, {});
    auto const& problem = planted.problem;
    identify_options options;
    options.search.boxes = 50;
    // clang-format off
    auto const gain = change({{"gain", "1/s"}, {"rate", "1/s"}}, 2,
                             [](auto const& p) { return std::vector{p[0] * p[1], p[0] * 1}; },
                             [](auto const& q) { return std::vector{q[1] * 1, q[0] / q[1]}; });
    changed_problem const posed(problem, gain);
    auto const found = identify(posed.problem(), options); // paving, hull, witness in (gain, rate)
    box const p = posed.parameter_hull(found);             // contains every feasible parameter
    // clang-format on
    CHECK(contains(p, planted.truth));
}

TEST_CASE("a planted truth is never lost in other coordinates, and inside boxes are inside") {
    draws d(671);
    int inside = 0;
    for (std::size_t round = 0; round < 9; ++round) {
        auto const planted =
            support::plant(d, {1, 2, 0, 10}, decay_rate, decay_prior, {1},
                           {.outliers = round % 2, .noise = round % 3 == 0 ? 0.2 : 0.02});
        changed_problem const posed(planted.problem, coordinates(round % 3));
        auto const found = found_in(posed, 200);
        auto const truth = coordinates(round % 3).forward.over(point_box(planted.truth));
        REQUIRE(truth);
        REQUIRE(found.verdict != verdict::inconsistent);
        REQUIRE_FALSE(is_empty(intersect(found.hull, *truth)));
        bool somewhere = false;
        for (auto const& b : found.paving.boxes()) {
            if (b.verdict == box_verdict::outside) continue;
            somewhere = somewhere || !is_empty(intersect(b.set, *truth));
            if (b.verdict != box_verdict::inside) continue;
            ++inside;
            // The parameters themselves, in their prior, explain the data.
            auto const p = coordinates(round % 3).backward.over(point_box(d.in(b.set)));
            REQUIRE(p);
            for (std::size_t j = 0; j < 2; ++j) {
                CHECK((*p)[j].upper() >= decay_prior[j].lower());
                CHECK((*p)[j].lower() <= decay_prior[j].upper());
            }
            CHECK(planted.violated(0, mid(*p), planted.starts[0], 1e-9) <= round % 2);
        }
        CHECK(somewhere);
        auto const hull_of_parameters = posed.parameter_hull(found);
        CHECK(contains(hull_of_parameters, planted.truth));
        CHECK(subset(hull_of_parameters, decay_prior));
        if (found.witness) {
            auto const p = posed.parameters_of_witness(found);
            REQUIRE((p && !is_empty(*p)));
            CHECK(planted.violated(0, mid(*p), planted.starts[0], 1e-9) <= round % 2);
        }
    }
    CHECK(inside > 20);
}

TEST_CASE("hulls of the parameters are about those of the original problem") {
    draws d(672);
    auto const planted =
        support::plant(d, {1, 2, 0, 10}, decay_rate, decay_prior, {1}, {.noise = 0.02});
    auto const plain = identify(planted.problem);
    changed_problem const posed(planted.problem, coordinates(0));
    auto const seen = posed.parameter_hull(found_in(posed, 2000));
    for (std::size_t j = 0; j < 2; ++j) {
        CHECK_FALSE(disjoint(seen[j], plain.hull[j]));
        CHECK(width(seen[j]) < 1.3 * width(plain.hull[j]));
        CHECK(width(plain.hull[j]) < 1.3 * width(seen[j]));
    }
}

TEST_CASE(
    "what no parameter of the prior explains is inconsistent, whatever the box of coordinates") {
    draws d(673);
    auto planted = support::plant(d, {1, 2, 0, 10}, decay_rate, decay_prior, {1}, {.noise = 0.01});
    // The truth's coordinates lie in the box around the image, its parameters not in the prior.
    planted.problem.prior = box{between(0.5, 2), between(0.25, 0.3)};
    std::vector<double> const outside{0.75, 0.6};
    auto const y = planted.simulate(0, outside, planted.starts[0]);
    auto& samples = planted.problem.experiments[0].measurements;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        samples[k].bound = support::around(static_cast<double>(y[k]), 0.005);
    }
    changed_problem const posed(planted.problem, coordinates(0));
    REQUIRE(contains(posed.problem().prior, {0.45, 0.75}));
    CHECK(found_in(posed, 2000).verdict == verdict::inconsistent);
}

TEST_CASE("the prior of the parameters is no data: nothing grows, drops or counts it") {
    draws d(675);
    // The truth lies beside the prior, its coordinates in the box around the prior's image: without
    // the prior nothing would be wrong.
    auto planted = support::plant(d, {1, 2, 0, 10}, decay_rate, decay_prior, {1}, {.noise = 0.001});
    auto& problem = planted.problem;
    auto const middle = 0.5 * (planted.truth[1] + decay_prior[1].upper());
    problem.prior[1] = interval(middle, decay_prior[1].upper());
    changed_problem const changed(problem, coordinates(0));
    auto const& posed = changed.problem();
    REQUIRE(contains(posed.prior, {planted.truth[0] * planted.truth[1], planted.truth[0]}));
    auto const refuses = [&](auto const& ask) {
        CHECK_NOTHROW(ask(problem));
        CHECK_THROWS_WITH(ask(posed), ContainsSubstring("'prior of the parameters'") &&
                                          ContainsSubstring("original"));
    };
    inflation_options brief;
    brief.seconds = 0.1;
    outlier_search_options few;
    few.seconds = 0.1;
    refuses([&](auto const& p) { return bound_inflation(p, nullptr, brief); });
    CHECK_THROWS_WITH(holdout_inflation(posed, {}, posed), ContainsSubstring("original"));
    refuses([&](auto const& p) { return smallest_outlier_budget(p, few); });
    refuses([](auto const& p) { return identifiability_of(p, point_box(mid(p.prior))); });
    // What is left where data are dropped still knows the prior.
    auto const none = restricted_to(posed, [](std::size_t, measurement const&) { return false; });
    REQUIRE(none.experiments.size() == 1);
    CHECK(none.experiments[0].constraint);
    CHECK(none.experiments[0].measurements.size() == 2);
    CHECK(found_in(changed, 2000).verdict == verdict::inconsistent);
    for (auto const& r : reach_of_runs(posed, posed.prior, {})) CHECK(r.scenario == "E0");
}

TEST_CASE("maps that do not fit are refused") {
    draws d(674);
    auto const problem = support::plant(d, {1, 2, 0, 10}, decay_rate, decay_prior, {1}, {}).problem;
    auto const good = coordinates(1);
    auto const same = [](auto const& p) { return std::vector{p[0] * 1, p[1] * 1}; };
    auto const refused = [&](auto const& forward, auto const& backward, std::size_t parameters) {
        CHECK_THROWS_AS(changed_problem(problem, change({{"a", "1"}, {"b", "1"}}, parameters,
                                                        forward, backward)),
                        std::invalid_argument);
    };
    refused(
        same,
        [](auto const& q) {
            return std::vector{q[0] * 1, q[1] * 2};
        },
        2);
    refused(
        same, [](auto const& q) { return std::vector{q[0] * 1}; }, 2);
    refused([](auto const& p) { return std::vector{p[0] * 1, p[1] + p[2]}; }, same, 3);
    refused([](auto const& p) { return std::vector{p[0] / (p[1] - 0.5), p[1] * 1}; }, same, 2);
    CHECK_NOTHROW(changed_problem(problem, good));
    CHECK_NOTHROW(changed_problem(problem, change({{"a", "1"}, {"b", "1"}}, 2, same, same)));
}
