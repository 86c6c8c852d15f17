// SPDX-License-Identifier: MIT
#include <sivid/decision/prediction_problem.hpp>

#include "decision/planar_models.hpp"
#include "support/catch.hpp"

#include <stdexcept>
#include <vector>

using namespace decision_support;

TEST_CASE("outputs are followed once, states first") {
    auto p = oscillator(between(1, 2), 1);
    auto& g = p.model.g;
    auto const speed = g.leaf(sivid::operation::state, 1);
    auto const margin = g.sub(speed, g.leaf(sivid::operation::state, 0));
    sivid::followed_outputs const f(p.model, {margin, speed, margin});
    CHECK(f.model.observe.size() == 3); // two states, which are the channels, and the margin
    CHECK(f.channels == std::vector<std::size_t>{0, 1});
    CHECK(f.margins == std::vector<std::size_t>{2, 1, 2});
    CHECK(f.model.about.channels.size() == 3);
    CHECK(f.model.rate == p.model.rate);
}

TEST_CASE("a grid has the wanted instants, the knots, and no longer cells than asked") {
    auto p = decay({{between(1, 2)}}, {sivid::interval(1.0)}, 2);
    p.inputs = {sivid::sampled_signal({-1, 0.3, 5}, {0, 1, 0}, sivid::interpolation::linear)};
    auto const times = sivid::time_cells(p, {0.7, 3, -1, 0.7, NAN}, 0.25);
    CHECK(times.front() == 0);
    CHECK(times.back() == 2);
    for (double const t : {0.3, 0.7}) CHECK(std::count(times.begin(), times.end(), t) == 1);
    for (std::size_t k = 1; k < times.size(); ++k) {
        CHECK(times[k] > times[k - 1]);
        CHECK(times[k] - times[k - 1] <= 0.25 * (1 + 1e-6));
    }
    CHECK(sivid::time_cells(p, {}, 1e9).size() == 3);
}

TEST_CASE("the smallest box around all sets") {
    auto const p = decay({{between(1, 2)}, {between(4, 5)}}, {sivid::interval(1.0)}, 2);
    CHECK(p.around()[0].lower() == 1);
    CHECK(p.around()[0].upper() == 5);
    auto q = p;
    q.model.input_memory.push_back({});
    CHECK_THROWS_WITH(q.require_valid(), ContainsSubstring("delay"));
}

TEST_CASE("states that effects added begin at what the inputs say") {
    auto p = lagged_cart(2);
    auto const other =
        p.under({sivid::sampled_signal({0.0, 2.0}, {1.25, 3.0}, sivid::interpolation::linear)});
    CHECK(other.initial[1].lower() <= 1.25);
    CHECK(other.initial[1].upper() >= 1.25);
    CHECK(other.initial[1].upper() - other.initial[1].lower() < 1e-12);
    CHECK(other.initial[0].upper() == p.initial[0].upper());
    CHECK(p.initial[1].upper() == 0);
    auto& g = p.model.g;
    p.model.added_states[0].at_begin =
        g.binary(sivid::operation::mul, p.model.added_states[0].at_begin,
                 g.leaf(sivid::operation::constant, 0));
    CHECK_THROWS_AS(p.under(p.inputs), std::invalid_argument);
}
