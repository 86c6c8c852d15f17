// SPDX-License-Identifier: MIT
#include <sivid/paving/strategy/detail/equation_guide.hpp>

#include <sivid/model/change/detail/slower_inputs.hpp>
#include <sivid/model/structure/states_seen.hpp>

#include "paving/relation/two_links.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

#include <cmath>

using namespace diagnosis_support;
using namespace relation_support;

namespace {

/// Two links under torques that are held for a millisecond.
struct driven_links {
    recorded_model model = record_model(two_links());
    std::vector<double> truth;
    motion_truth motion;
    identification_problem problem;

    driven_links(draws& d, double share, double seconds)
        : problem{model, {{"a1", "a2", "a3", "f", "d"}, {}}, prior_of_links(share), {}} {
        truth = d.in(problem.prior);
        std::vector<sampled_signal> inputs;
        for (double const size : {3.0, 0.8}) {
            double const pace = d.uniform(2, 6), phase = d.uniform(0, 6);
            std::vector<double> t, v;
            for (int k = 0; k * 0.001 < seconds + 0.002; ++k) {
                t.push_back(k * 0.001);
                v.push_back(size * std::sin(pace * t.back() + phase) + d.uniform(-0.05, 0.05));
            }
            inputs.emplace_back(t, v, interpolation::hold);
        }
        motion = simulate(model, truth, inputs, {d.uniform(-1, 1), d.uniform(-1, 1), 0, 0}, seconds,
                          0.0005);
        problem.experiments.push_back(
            measured(d, "S", motion, inputs, {0, 1}, 0.001, noise::uniform, {}, 0.01));
    }
};

} // namespace

TEST_CASE("a guide knows the prior's rest and the states of the true motion") {
    draws d(81);
    auto const count = support::swept(std::size_t{3}, std::size_t{60});
    for (std::size_t n = 0; n < count; ++n) {
        driven_links const r(d, 0.1, 2);
        paving_detail::equation_guide const guide(r.problem, r.problem, {});
        auto const known = guide(r.problem.prior);
        CHECK(contains(known.rest, r.truth));
        CHECK(width(known.rest[0]) < width(r.problem.prior[0]));
        for (double const t : {0.0, 0.01, 0.5, 1.337, 1.99}) {
            auto const states = known.states(0, t);
            for (std::size_t i = 0; i < 4; ++i) {
                INFO(n << ": state " << i << " at " << t);
                CHECK(states[i].lower() - 1e-6 <= r.motion.at(t)[i]);
                CHECK(r.motion.at(t)[i] <= states[i].upper() + 1e-6);
                CHECK(width(states[i]) < 1);
            }
        }
        CHECK_FALSE(is_bounded(known.states(0, 7)[2])); // after the record
    }
}

TEST_CASE("with slower inputs a guide knows the states that these have") {
    // z = x - B U with U the integral of what a line through the torque leaves, and with B U by
    // what the slower model shows of the recorded states.
    draws d(82);
    auto const count = support::swept(std::size_t{2}, std::size_t{40});
    for (std::size_t n = 0; n < count; ++n) {
        driven_links const r(d, 0.1, 2);
        auto seen = r.problem;
        seen.model = with_states_seen(seen.model, "recorded state ");
        auto const slow = with_slower_inputs(seen, 0.01);
        REQUIRE(slow);
        std::vector<signal> const open(slow->model.about.inputs.size(),
                                       sampled_signal({0.0}, {0.0}, interpolation::linear));
        auto const shown = bind(slow->model, slow->choice, open);
        auto const known = paving_detail::equation_guide(r.problem, *slow, {})(r.problem.prior);
        auto const& lines = slow->experiments[0].inputs;
        REQUIRE(lines.size() == 4); // a line and an integral for each torque
        for (double const t : {0.0, 0.3, 0.5045, 1.005, 1.9973}) {
            box inputs(4);
            for (std::size_t m = 0; m < 2; ++m) {
                auto const& torque = std::get<sampled_signal>(r.problem.experiments[0].inputs[m]);
                auto const& line = std::get<sampled_signal>(lines[m]);
                double integral = 0; // by the middles of pieces of 1/20 of a millisecond
                double const h = 5e-5;
                for (long k = 0; k < std::lround(t / h); ++k) {
                    double const s = (static_cast<double>(k) + 0.5) * h;
                    integral += h * (torque.approximate(s) - line.approximate(s));
                }
                inputs[m] = interval(line.approximate(t));
                inputs[2 + m] = interval(integral);
            }
            std::vector<interval> x, c;
            for (double const v : r.motion.at(t)) x.emplace_back(v);
            for (double const v : r.truth) c.emplace_back(v);
            auto const z = known.states(0, t);
            for (std::size_t i = 0; i < 4; ++i) {
                auto at = leaf_ranges{interval(t), box(x), box(c), inputs};
                at.states[i] = interval(0.0);
                auto const channel = shown.observe[2 + i];
                graph_range moved(shown.g, {channel});
                moved.evaluate(at);
                double const truth = mid(x[i]) - mid(moved.value(channel));
                INFO(n << ": state " << i << " at " << t);
                CHECK(z[i].lower() - 1e-6 <= truth);
                CHECK(truth <= z[i].upper() + 1e-6);
            }
        }
        auto const own = paving_detail::equation_guide(r.problem, r.problem, {})(r.problem.prior);
        auto const x = own.states(0, 1.005), z = known.states(0, 1.005);
        CHECK(equal(x[0], z[0])); // no torque moves an angle
        CHECK(width(x[2]) < width(z[2]));
        CHECK(width(z[2]) < width(x[2]) + 0.05);
    }
}

TEST_CASE("windows from states that equations know keep the truth, and tell more") {
    draws d(83);
    auto const count = support::swept(std::size_t{2}, std::size_t{30});
    for (std::size_t n = 0; n < count; ++n) {
        driven_links const r(d, 0.05, 2);
        auto seen = r.problem;
        seen.model = with_states_seen(seen.model, "recorded state ");
        auto const slow = n % 2 == 0 ? with_slower_inputs(seen, 0.01) : std::nullopt;
        auto const& carried = slow ? *slow : r.problem;
        paving_detail::equation_guide const guide(r.problem, carried, {});
        auto const found = contract_by_windows(
            carried, {.seconds = 3, .windows = 4, .equations = std::cref(guide)});
        INFO(n);
        CHECK(contains(found.rest, r.truth));
        CHECK(found.windows > 0);
        CHECK(subset(found.rest, guide(r.problem.prior).rest));
    }
}

TEST_CASE("where the equations contradict the data nothing is left") {
    draws d(84);
    driven_links r(d, 0.02, 2);
    std::vector<interval> sides(r.problem.prior.begin(), r.problem.prior.end());
    sides[2] = between(0.3, 0.31); // twice the second link's inertia
    r.problem.prior = box(sides);
    paving_detail::equation_guide const guide(r.problem, r.problem, {});
    CHECK(contract_by_windows(r.problem, {.windows = 4, .equations = std::cref(guide)}).empty());
}
