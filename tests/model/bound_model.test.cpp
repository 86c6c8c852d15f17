// SPDX-License-Identifier: MIT
#include <sivid/model/bound_model.hpp>

#include "support/catch.hpp"
#include "support/formulas.hpp"
#include "support/models.hpp"

#include <cmath>
#include <string>

using namespace sivid;
using support::between;

namespace {

/// x0' = p0 x0 + p1 u0, x1' = u1 x0, y = p1 x1 + u1
recorded_model sample() {
    return support::model_of(
        {2, 2, 2},
        [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{p[0] * x[0] + p[1] * u[0], u[1] * x[0]};
        },
        [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{p[1] * x[1] + u[1]};
        });
}
sampled_signal ramp() { return {{0, 1}, {0, 1}, interpolation::linear}; }
analytic_signal wave() {
    return analytic_signal::from([](auto const& t) { return sin(3 * t); });
}

} // namespace

TEST_CASE("binding makes parameters of the unknown constants, in the order asked for") {
    auto const m = sample();
    auto const bound = bind(m, {{"p1", "p0"}, {}}, {ramp(), ramp()});
    CHECK(bound.state_count() == 2);
    CHECK(bound.parameter_count() == 2);
    CHECK(bound.channel_count() == 1);
    CHECK(bound.parameters == std::vector<std::size_t>{1, 0});
    CHECK(bound.sampled == std::vector<std::size_t>{0, 1});
    support::place_box where;
    where.x = box{interval(2.0), interval(5.0)};    // the helper feeds the inputs from here too
    where.p = box{interval(10.0), interval(100.0)}; // p1 = 10, p0 = 100
    auto const rate = support::evaluate(bound.g, bound.rate, where).outputs;
    CHECK(rate[0].lower() == 100 * 2 + 10 * 2);
    CHECK(rate[1].lower() == 5 * 2);
    auto const j = support::evaluate(bound.g,
                                     {bound.rate_dx[0][0], bound.rate_dp[0][0], bound.rate_dp[0][1],
                                      bound.observe_dx[0][1], bound.observe_dp[0][0]},
                                     where)
                       .outputs;
    CHECK(j[0].lower() == 100); // d rate0 / d x0 = p0
    CHECK(j[1].lower() == 2);   // by the first parameter, p1: u0
    CHECK(j[2].lower() == 2);   // by p0: x0
    CHECK(j[3].lower() == 10);
    CHECK(j[4].lower() == 5);
    CHECK(bound.g.is(bound.rate_dx[0][1], 0));
}

TEST_CASE("known constants and analytic inputs are folded in") {
    auto const m = sample();
    auto const bound =
        bind(m, {{}, {{"p0", interval(0.0)}, {"p1", interval(4.0)}}}, {wave(), ramp()});
    CHECK(bound.parameter_count() == 0);
    CHECK(bound.sampled == std::vector<std::size_t>{1});
    support::place_box where;
    where.t = interval(0.25);
    where.x = box{interval(2.0), interval(5.0)};
    auto const rate = support::evaluate(bound.g, bound.rate, where).outputs;
    CHECK(contains(rate[0], 4 * std::sin(0.75)));
    CHECK(width(rate[0]) < 1e-14);
    CHECK(bound.g.is(bound.rate_dx[0][0], 0));
    // Nominal values are used where nothing is said (1 in this model).
    auto const nominal = bind(m, {}, {wave(), ramp()});
    CHECK(support::evaluate(nominal.g, {nominal.rate_dx[0][0]}, where).outputs[0].lower() == 1);
}

TEST_CASE("constants with an uncertain value stay independent of each other") {
    auto const m =
        support::model_of({1, 2}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[0] - p[1] * x[0]};
        });
    auto const bound = bind(m, {{}, {{"p0", between(1, 2)}, {"p1", between(1, 2)}}}, {});
    support::place_box where;
    where.x[0] = interval(1.0);
    auto const rate = support::evaluate(bound.g, bound.rate, where).outputs[0];
    CHECK(rate.lower() <= -1);
    CHECK(rate.upper() >= 1);
}

TEST_CASE("binding refuses what does not fit, by name") {
    auto const m = sample();
    auto const u = std::vector<signal>{ramp(), ramp()};
    CHECK_THROWS_WITH(bind(m, {{"mass"}, {}}, u),
                      ContainsSubstring("mass") && ContainsSubstring("p0"));
    CHECK_THROWS_WITH(bind(m, {{"p0", "p0"}, {}}, u), ContainsSubstring("twice"));
    CHECK_THROWS_WITH(bind(m, {{}, {{"mass", interval(1.0)}}}, u), ContainsSubstring("mass"));
    CHECK_THROWS_AS(bind(m, {{}, {{"p0", interval_traits<interval>::empty()}}}, u),
                    std::invalid_argument);
    CHECK_THROWS_WITH(bind(m, {}, {ramp()}), ContainsSubstring("2 inputs"));
    CHECK_THROWS_AS(bind(m, {}, {}), std::invalid_argument);
}
