// SPDX-License-Identifier: MIT
#include <sivid/model/change/added_start.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <limits>
#include <vector>

using support::between;

TEST_CASE("inputs are enclosed at a time, with their errors") {
    sivid::signal const held =
        sivid::sampled_signal({0, 1}, {2, 3}, sivid::interpolation::hold, {0.5, 0.25});
    CHECK(sivid::input_at(held, 0.5).lower() <= 1.5);
    CHECK(sivid::input_at(held, 0.5).upper() >= 2.5);
    CHECK(sivid::input_at(held, 0.5).upper() < 2.6);
    CHECK(sivid::input_at(held, 1).lower() > 2.7);
    sivid::signal const formula =
        sivid::analytic_signal::from([](auto const& t) { return 1.0 / (t - 1.0); });
    CHECK(contains(sivid::input_at(formula, 3), 0.5));
    CHECK_THROWS_AS(sivid::input_at(formula, 1), std::domain_error);
}

TEST_CASE("the start of an added state holds its value for all that it depends on") {
    auto m = support::model_of(
        {.states = 2, .constants = 1, .inputs = 2},
        [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{x[0], x[1]};
        },
        [](auto const&, auto const& x, auto const& c, auto const& u) {
            return std::vector{c[0] * u[1] - x[0], sqrt(u[1])};
        });
    std::vector<sivid::signal> inputs(
        2, sivid::sampled_signal({0}, {3}, sivid::interpolation::hold, {1}));
    std::vector<sivid::interval> const constants{between(-1, 2)};
    sivid::box const states{between(0, 1), sivid::interval_traits<sivid::interval>::entire()};
    auto const start = [&](std::size_t output) {
        return sivid::start_of(m, {1, m.observe[output]}, constants, inputs, 0, states);
    };
    auto const found = start(0); // [-1, 2] * [2, 4] - [0, 1]
    CHECK(found.lower() <= -5);
    CHECK(found.lower() > -5.001);
    CHECK(found.upper() >= 8);
    CHECK(found.upper() < 8.001);
    CHECK(contains(start(1), 2.0));
    inputs[1] = sivid::sampled_signal({0}, {0.5}, sivid::interpolation::hold, {1});
    CHECK_THROWS_WITH(start(1), ContainsSubstring("'x1' is not defined"));
}

TEST_CASE("at a point an added state begins where the parameters say, within its initial range") {
    auto m = support::model_of(
        {.states = 2, .constants = 1, .inputs = 1},
        [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{x[0], x[1]};
        },
        [](auto const&, auto const&, auto const& c, auto const& u) {
            return std::vector{c[0] * u[0]};
        });
    m.added_states.push_back({1, m.observe[0]});
    sivid::identification_problem p{
        m, {{m.about.constants[0].name}, {}}, sivid::box{between(-1, 2)}, {}};
    sivid::experiment e;
    e.inputs = {sivid::sampled_signal({0}, {3}, sivid::interpolation::hold, {1})};
    e.initial = sivid::box{between(0, 1), between(0, 0)};
    p.experiments.push_back(e);
    sivid::start_added_states(p);
    CHECK(sivid::starts_follow_parameters(p)); // [-1, 2] * [2, 4]
    auto const at = [&p](double c) {
        return sivid::start_that_follows(p, 0, sivid::point_box({c}), sivid::point_box({0.5, 7.0}));
    };
    REQUIRE(at(0.5));
    CHECK(contains((*at(0.5))[0], 0.5));
    CHECK(contains((*at(0.5))[1], 1.5)); // of the input as recorded
    CHECK(width((*at(0.5))[1]) < 1e-9);
    p.experiments[0].initial[1] = between(0, 1);
    CHECK_FALSE(at(0.5)); // it may not begin there
    p.experiments[0].initial[1] = between(1, 1);
    CHECK_FALSE(sivid::starts_follow_parameters(p));
    CHECK(contains((*at(0.5))[1], 7.0)); // whatever is given
}
