// SPDX-License-Identifier: MIT
// Boxes of parameters against data with a planted truth: the truth is never excluded, and what is
// called inside is simulated.
#include <sivid/paving/judge/feasibility_test.hpp>

#include "support/catch.hpp"
#include "support/problems.hpp"
#include "support/some_start.hpp"

#include <memory>

using namespace sivid;
using support::between;
using support::draws;
using knowledge = feasibility_test::knowledge;

namespace {

/// A random box around a point, within the prior.
box box_around(draws& d, std::vector<double> const& p, box const& prior, double share) {
    box b(p.size());
    for (std::size_t j = 0; j < p.size(); ++j) {
        double const w = width(prior[j]);
        b[j] = intersect(prior[j],
                         between(p[j] - d.uniform(0, share) * w, p[j] + d.uniform(0, share) * w));
    }
    return b;
}

void sweep(std::uint64_t seed, int problems) {
    draws d(seed);
    int inside = 0;
    int outside = 0;
    for (int round = 0; round < problems; ++round) {
        support::planting how;
        how.experiments = 1 + d.below(2);
        how.samples = 3 + d.below(8);
        how.outliers = d.coin() ? 0 : d.below(3);
        how.spread = d.coin() ? 0 : 0.01;
        how.noise = d.uniform(0.005, 0.1);
        how.outliers = std::min(how.outliers, how.samples - 1);
        auto const model = d.below(support::planted_models);
        auto const planted = support::plant(d, model, how);
        auto const& prior = planted.problem.prior;
        feasibility_test_options options;
        options.contract = d.below(4) != 0;
        if (d.below(4) == 0) options.set = carried_set::doubleton;
        feasibility_test test(planted.problem, options);
        std::vector<box> starts;
        for (auto const& x0 : planted.starts) starts.push_back(point_box(x0));
        test.set_starts(starts);
        CAPTURE(seed, round, model, how.experiments, how.outliers, how.spread);
        // A chain of boxes around the truth, each with what was learned from the last.
        auto current = prior;
        std::shared_ptr<knowledge const> known;
        for (int depth = 0; depth < 5; ++depth) {
            auto a = test.judge(current, d.below(5) == 0 ? nullptr : known);
            if (a.blind) a = test.learn({current})[0];
            bool const kept = a.verdict != box_verdict::outside && contains(a.rest, planted.truth);
            CAPTURE(depth);
            CHECK(kept);
            CHECK(subset(a.rest, current));
            if (!kept || a.verdict == box_verdict::inside) break;
            known = a.knowledge;
            current = box_around(d, planted.truth, a.rest, depth < 3 ? 0.3 : 0.02);
        }
        // Boxes anywhere: their verdicts are checked by simulation.
        for (int k = 0; k < 4; ++k) {
            auto const b = box_around(d, d.in(prior), prior, d.coin() ? 0.1 : 0.005);
            auto const a = test.learn({b})[0];
            if (a.verdict == box_verdict::undecided) continue;
            (a.verdict == box_verdict::inside ? inside : outside)++;
            for (int member = 0; member < 3; ++member) {
                auto const p = d.in(a.verdict == box_verdict::inside ? a.rest : b);
                bool all_explained = true;
                for (std::size_t e = 0; e < how.experiments; ++e) {
                    bool const inside_box = a.verdict == box_verdict::inside;
                    auto const x0 = d.in(planted.problem.experiments[e].initial);
                    all_explained =
                        all_explained &&
                        (inside_box ? support::some_start_explains(planted, e, p,
                                                                   {planted.starts[e]}, 1e-10)
                                    : planted.violated(e, p, x0, -1e-10) <= how.outliers);
                }
                CHECK(all_explained == (a.verdict == box_verdict::inside));
            }
        }
    }
    CHECK(inside > 0);
    CHECK(outside > problems / 2);
}

} // namespace

TEST_CASE("verdicts on boxes agree with the truth and with simulation") { sweep(351, 120); }
TEST_CASE("verdicts on boxes, longer", "[.long]") {
    for (std::uint64_t seed = 3500; seed < 3530; ++seed) sweep(seed, 300);
}

TEST_CASE("the truth as a point is inside, a point that fails is outside") {
    draws d(352);
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        auto const planted = support::plant(d, model, {.samples = 10, .noise = 0.02});
        feasibility_test test(planted.problem, {});
        CHECK(test.learn({point_box(planted.truth)})[0].verdict == box_verdict::inside);
        CHECK(test.integrations() >= 1);
        auto broken = planted.problem;
        auto& bound = broken.experiments[0].measurements[4].bound;
        bound = support::around(mid(bound) + 1, 0.02);
        feasibility_test strict(broken, {});
        CHECK(strict.learn({point_box(planted.truth)})[0].verdict == box_verdict::outside);
        broken.experiments[0].outliers = 1;
        feasibility_test tolerant(broken, {});
        CHECK(tolerant.learn({point_box(planted.truth)})[0].verdict == box_verdict::inside);
    }
}

TEST_CASE("measurements at a knot of a held input that feeds through") {
    // y = u: the sample at the knot is the input there, as the simulation says.
    auto const model = support::model_of(
        {1, 1, 1},
        [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{p[0] * u[0] + 0 * x[0]};
        },
        [](auto const&, auto const& x, auto const&, auto const& u) {
            return std::vector{u[0], x[0]};
        });
    identification_problem problem;
    problem.model = model;
    problem.choice.unknown = {"p0"};
    problem.prior = box{between(0, 2)};
    experiment e;
    e.name = "E";
    e.inputs = {sampled_signal({0, 1, 2}, {1, -1, 3}, interpolation::hold)};
    e.initial = box{interval(0.0)};
    e.measurements = {{1, 0, between(-1.1, -0.9)},
                      {2, 0, between(2.9, 3.1)},
                      {1, 1, between(0.9, 1.1)},
                      {2, 1, between(-0.1, 0.1)}};
    problem.experiments = {e};
    for (auto const set : {carried_set::taylor_model, carried_set::doubleton}) {
        feasibility_test_options options;
        options.set = set;
        feasibility_test test(problem, options);
        CHECK(test.learn({point_box({1.0})})[0].verdict == box_verdict::inside);
        CHECK(test.learn({point_box({1.5})})[0].verdict == box_verdict::outside);
    }
}

TEST_CASE("an undefined output decides nothing, and nothing about the others") {
    auto const model = support::model_of(
        {1, 1},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] + 0 * x[0]};
        },
        [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{log(x[0]), x[0]};
        });
    identification_problem problem;
    problem.model = model;
    problem.choice.unknown = {"p0"};
    problem.prior = box{between(0.9, 1.1)};
    experiment e;
    e.name = "E";
    e.initial = box{interval(-1.0)};
    e.outliers = 1;
    e.measurements = {{0.5, 0, between(0, 1)}, {2, 1, between(0.9, 1.1)}};
    problem.experiments = {e};
    feasibility_test test(problem, {});
    CHECK(test.learn({point_box({1.0})})[0].verdict != box_verdict::outside);
    problem.experiments[0].measurements[1].bound = between(5, 6);
    feasibility_test strict(problem, {});
    CHECK(strict.learn({point_box({1.0})})[0].verdict != box_verdict::inside);
}

TEST_CASE("sides that come into play after a run has ended are halved, too") {
    // x' = r, from t = 0.2 on + b (t - 0.2) x^2: with large b it is infinite soon after.
    auto const model = support::model_of(
        {2, 2},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] + p[1] * max(x[1] - 0.2, 0.0) * x[0] * x[0], 1 + 0 * x[1]};
        },
        [](auto const&, auto const& x, auto const&, auto const&) { return std::vector{x[0]}; });
    identification_problem problem;
    problem.model = model;
    problem.choice.unknown = {"p0", "p1"};
    problem.prior = box{between(0.5, 1.5), between(0, 1000)};
    experiment e;
    e.name = "E";
    e.initial = box{interval(1.0), interval(0.0)};
    e.measurements = {{0.1, 0, between(1.05, 1.15)}};
    for (double t = 2; t < 4; t += 0.05) // r = 1, b = 0
        e.measurements.push_back({t, 0, between(0.9 + t, 1.1 + t)});
    problem.experiments = {e};
    feasibility_test test(problem, {});
    auto const found = test.learn({problem.prior})[0];
    CHECK(feasibility_test::reached(found) < 0.05);
    CHECK(found.smear.empty()); // the widest is
    auto const later = test.learn({box{between(0.5, 1.5), between(0, 0.001)}})[0];
    CHECK(feasibility_test::reached(later) == 1);
    CHECK((later.verdict == box_verdict::outside || later.smear.size() == 2));
}
