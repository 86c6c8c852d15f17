// SPDX-License-Identifier: MIT
#include <sivid/io/result/problem_digest.hpp>

#include "io/small_identification.hpp"
#include "support/catch.hpp"

#include <functional>
#include <set>
#include <string>

using namespace sivid;

TEST_CASE("whatever decides a search changes the digest, budgets and threads do not") {
    auto const problem = io_support::two_rates_problem(true);
    identify_options const options;
    auto const digest = problem_digest(problem, options);
    CHECK(digest.size() == 64);
    CHECK(problem_digest(io_support::two_rates_problem(true), {}) == digest);

    std::set<std::string> seen{digest};
    auto const differs = [&](std::function<void(identification_problem&)> const& change) {
        auto other = problem;
        change(other);
        CHECK(seen.insert(problem_digest(other, options)).second);
    };
    using p = identification_problem;
    differs([](p& x) { x.model.about.name = "another"; });
    differs([](p& x) { x.model.about.states[0].limit = 11; });
    differs([](p& x) { x.model.about.time_unit = "ms"; });
    differs([](p& x) { x.model.about.states[0].unit = "furlong"; });
    differs([](p& x) { x.model.about.channels[0].unit = "furlong"; });
    differs([](p& x) { x.model.about.constants[0].unit = "furlong"; });
    differs([](p& x) { x.model.rate[0] = x.model.g.neg(x.model.rate[0]); });
    differs([](p& x) { x.model.about.constants[1].nominal = {interval(0.25), 0.25}; });
    differs([](p& x) { x.model.derived.push_back({1, x.model.rate[0]}); });
    differs([](p& x) { x.prior[0] = interval(0.5, 1.9999999999999998); });
    differs([](p& x) { x.choice.fixed["b"] = interval(1.0); });
    differs([](p& x) { x.experiments[0].name = "walk"; });
    differs([](p& x) { x.experiments[0].begin = 0.5; });
    differs([](p& x) { x.experiments[0].initial[0] = interval(2.0, 2.1); });
    differs([](p& x) { x.experiments[0].outliers = 2; });
    differs([](p& x) { x.experiments[0].bridged = {{"u", 3, 0.1, false}}; });
    differs([](p& x) { x.experiments[0].bridged = {{"u", 3, 0.1, true}}; });
    differs([](p& x) { x.experiments[0].measurements[0].time += 1e-16; });
    differs([](p& x) { x.experiments[0].measurements.pop_back(); });
    differs([](p& x) { x.experiments[0].inputs.push_back(sampled_signal{}); });
    differs([](p& x) {
        x.experiments[0].inputs.push_back(sampled_signal({0}, {1}, interpolation::hold));
    });
    differs([](p& x) {
        x.experiments[0].inputs.push_back(sampled_signal({0}, {1}, interpolation::hold, {0.1}));
    });
    differs([](p& x) {
        x.experiments[0].inputs.push_back(sampled_signal({0, 1}, {0, 1}, interpolation::linear));
    });
    differs([](p& x) {
        x.experiments[0].inputs.push_back(sampled_signal({0, 1}, {0, 1}, interpolation::hold));
    });
    differs([](p& x) {
        x.experiments[0].inputs.push_back(
            analytic_signal::from([](auto const& t) { return sin(t); }));
    });
    differs([](p& x) {
        x.experiments[0].inputs.push_back(
            analytic_signal::from([](auto const& t) { return cos(t); }));
    });

    auto const matters = [&](std::function<void(identify_options&)> const& change) {
        auto other = options;
        change(other);
        CHECK(seen.insert(problem_digest(problem, other)).second);
    };
    using o = identify_options;
    matters([](o& x) { x.test.contract = false; });
    matters([](o& x) { x.strategy = x.strategy.without("shapes"); });
    matters([](o& x) { x.strategy.steps[0].share = 0.5; });
    matters([](o& x) { x.only_hulls = true; });
    matters([](o& x) { x.drawn_boxes = 10; });
    matters([](o& x) { x.search.accuracy = 0.5; });
    matters([](o& x) { x.search.sufficient_ratio = 1; });
    matters([](o& x) { x.search.batches += 1; });
    matters([](o& x) { x.search.keep_outside = false; });
    matters([](o& x) { x.test.sharp_enough = 0.25; });
    matters([](o& x) { x.test.witness_steps = 1000; });
    matters([](o& x) { x.test.set = carried_set::doubleton; });
    matters([](o& x) { x.test.tolerance = 1e-9; });
    matters([](o& x) { x.test.maximum_step = 1.0; });
    matters([](o& x) { x.test.witness.order = 9; });
    CHECK(seen.insert(problem_digest(problem, options, "data")).second);

    auto budgets = options;
    budgets.search.seconds = 1;
    budgets.search.boxes = 1;
    budgets.search.memory = 1;
    budgets.search.workers.threads = 7;
    budgets.search.progress = [](paving_progress const&) { return false; };
    budgets.search.checkpoint_seconds = 1;
    CHECK(problem_digest(problem, budgets) == digest);
}

TEST_CASE("the digest of a problem is that of what it says, not of how it was recorded") {
    auto const problem = io_support::two_rates_problem(true);
    auto const digest = problem_digest(problem);
    CHECK(digest.size() == 64);
    auto more = problem; // nodes that nothing needs
    static_cast<void>(more.model.g.sub(more.model.g.leaf(operation::time, 0), more.model.rate[0]));
    CHECK(problem_digest(more) == digest);

    // x' = a x + b^2 + b - t, recorded in other orders
    auto const recorded = [&](bool otherwise, bool wrong = false) {
        auto p = problem;
        auto& g = p.model.g = graph();
        node_id a = 0, b = 0, x = 0;
        if (otherwise) {
            b = g.leaf(operation::constant, 1);
            x = g.leaf(operation::state, 0);
            a = g.leaf(operation::constant, 0);
        } else {
            a = g.leaf(operation::constant, 0);
            b = g.leaf(operation::constant, 1);
            x = g.leaf(operation::state, 0);
        }
        auto const rest = g.sub(g.unary(operation::sqr, b), g.leaf(operation::time, 0));
        auto const sum = wrong ? g.sub(b, g.mul(a, x)) : g.add(g.mul(a, x), b);
        p.model.rate = {g.add(sum, rest)};
        p.model.observe = {x};
        return problem_digest(p);
    };
    CHECK(recorded(true) == recorded(false));
    CHECK(recorded(true) != recorded(true, true));
    CHECK(recorded(true, true) == recorded(false, true));

    std::set<std::string> seen{digest};
    auto const differs = [&](std::function<void(identification_problem&)> const& change) {
        auto other = problem;
        change(other);
        CHECK(seen.insert(problem_digest(other)).second);
    };
    using p = identification_problem;
    differs([](p& x) { x.model.rate[0] = x.model.g.neg(x.model.rate[0]); });
    differs([](p& x) { x.model.observe[0] = x.model.rate[0]; });
    differs([](p& x) { x.model.derived.push_back({1, x.model.rate[0]}); });
    differs([](p& x) { x.model.added_states.push_back({0, x.model.rate[0]}); });
    differs([](p& x) { x.model.about.constants[1].nominal = {interval(0.25), 0.25}; });
    differs([](p& x) { x.choice.fixed["b"] = interval(1.0); });
    differs([](p& x) { x.prior[0] = interval(0.5, 1.9999999999999998); });
    differs([](p& x) { x.experiments[0].outliers = 2; });
    differs([](p& x) { x.experiments[0].measurements.pop_back(); });
    differs([](p& x) {
        x.experiments[0].inputs.push_back(
            analytic_signal::from([](auto const& t) { return sin(t); }));
    });
    differs([](p& x) {
        x.experiments[0].inputs.push_back(
            analytic_signal::from([](auto const& t) { return cos(t); }));
    });
    differs([](p& x) {
        x.experiments[0].inputs.push_back(sampled_signal({0}, {1}, interpolation::hold));
    });
}

TEST_CASE("zeros of a problem have no sign, which depends on how a compiler adds") {
    auto const problem = [](double zero) {
        auto p = io_support::two_rates_problem(true);
        p.experiments[0].begin = zero;
        p.experiments[0].initial[0] = interval(zero, 0.1);
        p.experiments[0].inputs.push_back(sampled_signal({0}, {zero}, interpolation::hold));
        return p;
    };
    CHECK(problem_digest(problem(-0.0)) == problem_digest(problem(0.0)));
    CHECK(problem_digest(problem(-0.0), {}) == problem_digest(problem(0.0), {}));
}
