// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/weak_equation.hpp>

#include <sivid/paving/relation/detail/stated_equation.hpp>

#include "paving/relation/two_links.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

#include <cmath>
#include <vector>

using namespace diagnosis_support;
using namespace relation_support;

namespace {

/// A bound model and its stated relations.
struct stated_bench {
    bound_model bound;
    box prior;
    std::vector<derivative_pair> pairs;
    stated_relations relations;

    stated_bench(recorded_model const& m, box p, std::vector<derivative_pair> all)
        : bound(bind(m, {names_of(m), {}},
                     std::vector<signal>(m.about.inputs.size(),
                                         sampled_signal({0.0}, {0.0}, interpolation::linear)))),
          prior(std::move(p)),
          pairs(std::move(all)),
          relations(bound, prior, pairs, [](std::size_t) { return false; }) {}

    static std::vector<std::string> names_of(recorded_model const& m) {
        std::vector<std::string> names;
        for (auto const& c : m.about.constants) names.push_back(c.name);
        return names;
    }
    observed_motion motion_of(experiment const& e) const {
        return proved_motion(bound, prior, e, measured_states(bound, {&e}), 4, {});
    }
    double value_of(parameter_product const& theta, std::vector<double> const& p) const {
        double v = 1;
        for (auto const& [node, power] : theta) {
            graph_range atom(bound.g, {node});
            std::vector<interval> at;
            for (double const c : p) at.emplace_back(c);
            atom.evaluate({interval(0.0), {}, box(at), {}});
            v *= std::pow(mid(atom.value(node)), power);
        }
        return v;
    }
    /// What a row leaves at the truth, and how far that is open.
    interval left_of(window_row const& w, std::size_t equation, bool middle,
                     std::vector<double> const& p) const {
        auto const& row = relations.row(equation, middle);
        auto sum = w.a.back() - w.difference;
        for (std::size_t j = 0; j < row.theta.size(); ++j) {
            double const v = value_of(row.theta[j], p) - (middle ? row.centre[j] : 0);
            sum = sum + w.a[j] * v;
        }
        return sum;
    }
};

} // namespace

TEST_CASE("stated equations of a mass matrix contain the truth, seen by angles alone") {
    auto const m = record_model(two_links());
    REQUIRE(m.stated.has_value());
    auto const prior = prior_of_links(0.1);
    draws d(31);
    auto const count = support::swept(std::size_t{4}, std::size_t{400});
    for (std::size_t n = 0; n < count; ++n) {
        auto const p = d.in(prior);
        auto e = record_of_links(d, m, p, 1.5, d.coin() ? 0.001 : 0.01, static_cast<noise>(n % 4));
        for (std::size_t i = 0; d.coin() && i < 4; ++i) {
            double const start = mid(e.initial[i]);
            e.initial[i] = around(start + d.uniform(-0.009, 0.009), 0.01);
        }
        stated_bench b(m, prior, {{2, 0}, {3, 1}});
        auto const motion = b.motion_of(e);
        for (std::size_t equation : {2U, 3U}) {
            CHECK(b.relations.bounded(equation));
            for (bool const middle : {false, true}) {
                auto const rows =
                    b.relations.windows(equation, middle, {motion}, {.shortest_gaps = 2});
                CHECK(rows.size() > 20);
                for (auto const& w : rows) {
                    INFO(n << ": " << equation << ", " << w.from << " to " << w.to);
                    CHECK(contains(b.left_of(w, equation, middle, p), 0));
                }
            }
        }
    }
}

TEST_CASE("stated equations show a torque that is missing") {
    auto const m = record_model(two_links());
    draws d(32);
    std::vector<double> const truth{0.6, 0.12, 0.15, 0.3, 0.2};
    stated_bench b(m, prior_of_links(0.02), {{2, 0}, {3, 1}});
    auto e = record_of_links(d, m, truth, 2, 0.001, noise::uniform);
    auto const motion = b.motion_of(e);
    std::size_t shown = 0;
    for (auto const& w : b.relations.windows(2, true, {motion}, {.shortest_gaps = 3})) {
        auto const left = b.left_of(w, 2, true, truth);
        shown += contains(left + 0.1 * w.length, 0) ? 0U : 1U; // a tenth of a newton metre
    }
    CHECK(shown > 10);
}

TEST_CASE("windows from a known start contain the truth, whatever the rate stands in") {
    // x1' = p0 u - p1 x1 - p2 |x1| - p3 x1/sqrt(x1^2 + 0.05^2) - p4 max(x1, 0.3)
    auto const m = support::model_of(
        {2, 5, 1, 20}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            auto const direction = x[1] / sqrt(sqr(x[1]) + sqr(expression(0.05)));
            return std::vector{x[1], p[0] * u[0] - p[1] * x[1] - p[2] * abs(x[1]) -
                                         p[3] * direction - p[4] * max(x[1], 0.3)};
        });
    box const prior{between(0.5, 2), between(0, 1), between(-0.4, 0.4), between(0, 0.5),
                    between(-0.3, 0.3)};
    draws d(24);
    std::size_t sharp = 0, all = 0;
    auto const count = support::swept(std::size_t{24}, std::size_t{2000});
    stated_bench b(m, prior, {{1, 0}});
    for (std::size_t n = 0; n < count; ++n) {
        auto const p = d.in(prior);
        std::vector<sampled_signal> const inputs{sine_input(d.uniform(0, 3), d.uniform(1, 5), 2)};
        std::vector<double> const start{d.uniform(-1, 1), d.uniform(-1, 1)};
        auto const truth = simulate(m, p, inputs, start, 2, 0.001);
        double const error = d.coin() ? 0.001 : 0.02;
        auto e = measured(d, "S", truth, inputs, {0}, error, static_cast<noise>(n % 4));
        for (std::size_t i = 0; d.coin() && i < 2; ++i)
            e.initial[i] = around(start[i] + d.uniform(-0.009, 0.009), 0.01);
        stated_bench own(m, prior, {{1, 0}});
        auto const motion = own.motion_of(e);
        for (auto const& w : own.relations.windows(1, false, {motion}, {.shortest_gaps = 5})) {
            INFO(n << ": " << w.from << " to " << w.to);
            auto const left = own.left_of(w, 1, false, p);
            CHECK(contains(left, 0));
            bool const begins = w.from == 0 && std::abs(mid(w.length) - w.to / 2) < 1e-9;
            if (!begins || error > 0.01) continue;
            ++all;
            if (width(left) < 0.2 * mid(w.length)) ++sharp;
        }
    }
    CHECK(all > 0);
    CHECK(2 * sharp > all);
}

TEST_CASE("accelerations of other states are summed by parts, too") {
    // Two masses on springs with dampers: places x0, x1 are measured, rates x2, x3 are not.
    auto const m = support::model_of(
        {4, 3, 1, 20}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{x[2], x[3], u[0] - p[0] * x[0] + p[1] * (x[3] - x[2]),
                               p[1] * (x[2] - x[3]) - p[2] * x[1] * (1 + 0.1 * x[1] * x[1])};
        });
    box const prior{between(2, 9), between(0.2, 1), between(1, 5)};
    draws d(23);
    for (std::size_t equation : {2U, 3U}) {
        std::size_t shown = 0;
        for (int n = 0; n < 12; ++n) {
            std::vector<double> const p{d.uniform(2, 9), d.uniform(0.2, 1), d.uniform(1, 5)};
            std::vector<sampled_signal> const inputs{sine_input(d.uniform(0, 3), 2, 4)};
            auto const truth =
                simulate(m, p, inputs, {d.uniform(-1, 1), d.uniform(-1, 1), 0, 0}, 4);
            auto const e = measured(d, "S", truth, inputs, {0, 1}, 0.01, static_cast<noise>(n % 4));
            stated_bench b(m, prior, {{2, 0}, {3, 1}});
            auto const motion = b.motion_of(e);
            auto const rows = b.relations.windows(equation, true, {motion}, {.shortest_gaps = 5});
            CHECK(rows.size() > 20);
            bool shows = false; // a rate that was left out
            for (auto const& w : rows) {
                auto const left = b.left_of(w, equation, true, p);
                CHECK(contains(left, 0));
                shows = shows || !contains(left + w.length, 0);
            }
            shown += shows ? 1U : 0U;
        }
        CHECK(shown > 9);
    }
}

TEST_CASE("inputs that jump and are known to a bound stay within what stated equations allow") {
    auto const m = support::model_of(
        {2, 2, 1, 20}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{x[1], p[0] * u[0] * u[0] - p[1] * x[1] * x[1]};
        });
    box const prior{between(0.5, 2), between(0, 1)};
    draws d(33);
    auto const count = support::swept(std::size_t{12}, std::size_t{400});
    for (std::size_t n = 0; n < count; ++n) {
        auto const p = d.in(prior);
        std::vector<double> t, v, seen;
        for (int k = 0; k < 30; ++k) {
            t.push_back(0.07 * k);
            v.push_back(d.uniform(-1, 2));
            seen.push_back(v.back() + d.uniform(-0.019, 0.019));
        }
        sampled_signal const right(t, v, interpolation::hold);
        sampled_signal const stated(t, seen, interpolation::hold,
                                    std::vector<double>(t.size(), 0.02));
        auto const truth = simulate(m, p, {right}, {0, d.uniform(-1, 1)}, 2, 0.001);
        auto const e = measured(d, "S", truth, {stated}, {0}, 0.005, static_cast<noise>(n % 4));
        stated_bench b(m, prior, {{1, 0}});
        auto const motion = b.motion_of(e);
        for (bool const middle : {false, true}) {
            for (auto const& w : b.relations.windows(1, middle, {motion}, {.shortest_gaps = 5})) {
                INFO(n << ": " << w.from << " to " << w.to);
                CHECK(contains(b.left_of(w, 1, middle, p), 0));
            }
        }
    }
}

TEST_CASE("windows end when they are told to") {
    auto const m = record_model(two_links());
    draws d(34);
    stated_bench b(m, prior_of_links(0.05), {{2, 0}, {3, 1}});
    auto const motion =
        b.motion_of(record_of_links(d, m, {0.6, 0.12, 0.15, 0.3, 0.2}, 1, 0.002, noise::uniform));
    CHECK(
        b.relations.windows(2, true, {motion}, {.shortest_gaps = 2, .go_on = [] { return false; }})
            .empty());
}
