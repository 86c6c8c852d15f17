// SPDX-License-Identifier: MIT
#include <sivid/model/change/copy_equations.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <sivid/model/graph/graph_range.hpp>

#include <vector>

TEST_CASE("equations are copied with other leaves, and what else a model says stays") {
    auto const from = [] {
        auto m = support::model_of(
            {.states = 1, .constants = 1, .inputs = 1},
            [](auto const&, auto const& x, auto const& c, auto const& u) {
                return std::vector{c[0] * x[0] + u[0]};
            },
            [](auto const&, auto const& x, auto const&, auto const&) { return x; });
        m.added_states.push_back(
            {0, m.g.mul(m.g.constant(2.0), m.g.leaf(sivid::operation::input, 0))});
        return m;
    }();
    sivid::recorded_model to;
    to.about.name = "kept";
    to.rate = {0, 0, 0};
    sivid::copy_equations(to, from, [](sivid::node const& n, sivid::graph& g) {
        return n.op == sivid::operation::input ? g.constant(5.0)
                                               : g.leaf(n.op, static_cast<std::size_t>(n.index));
    });
    CHECK(to.about.name == "kept");
    REQUIRE(to.rate.size() == 1);
    REQUIRE(to.observe.size() == 1);
    REQUIRE(to.added_states.size() == 1);
    CHECK(to.g.is(to.added_states[0].at_begin, 10));
    sivid::graph_range range(to.g, {to.rate[0], to.observe[0]});
    range.evaluate({sivid::interval(0.0), {sivid::interval(3.0)}, {sivid::interval(2.0)}, {}});
    CHECK(contains(range.value(to.rate[0]), 11.0));
    CHECK(contains(range.value(to.observe[0]), 3.0));
}

TEST_CASE("an added state begins behind others, and behind states of the model as before") {
    auto m =
        support::model_of({.states = 4, .inputs = 1},
                          [](auto const&, auto const& x, auto const&, auto const&) { return x; });
    auto const state = [&m](std::size_t k) { return m.g.leaf(sivid::operation::state, k); };
    m.added_states = {{1, m.g.leaf(sivid::operation::input, 0)},
                      {2, m.g.mul(m.g.constant(2.0), state(1))},
                      {3, m.g.add(state(0), state(2))}};
    sivid::start_behind_others(m);
    sivid::graph_range range(m.g, {m.added_states[2].at_begin});
    range.evaluate(
        {sivid::interval(0.0), sivid::point_box({5, 100, 100, 100}), {}, sivid::point_box({3})});
    CHECK(contains(range.value(m.added_states[2].at_begin), 11.0));
    CHECK((m.g.depends(m.added_states[1].at_begin) & sivid::on_state) == 0);
}
