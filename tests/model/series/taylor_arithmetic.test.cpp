// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/formulas.hpp"
#include "support/sweep.hpp"
#include "support/taylor_models.hpp"

#include <sivid/model/expression.hpp>
#include <sivid/model/graph/tape.hpp>
#include <sivid/model/series/series.hpp>
#include <sivid/model/series/taylor_arithmetic.hpp>
#include <sivid/number/pack/lanes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::draws;
using support::mp;

namespace {

constexpr std::size_t variables = 2, degree = 3, order = 4;
using model = support::sized_model<variables, degree>;
using value = taylor_model<double>;
using arithmetic = arithmetic_of<value>;
using reference = support::power_series<order>;

/// A series of Taylor models in q, and its value at one q.
struct inputs {
    std::array<std::array<model, order + 1>, 2> x;
    std::vector<model> p;
    model t;

    explicit inputs(draws& d, double spread) {
        for (auto& state : x) {
            double const centre = d.uniform(-2, 2);
            for (std::size_t k = 0; k <= order; ++k) {
                state[k] = support::random_model<variables, degree>(d, k == 0 ? spread : 1, 0.7,
                                                                    k == 0 ? spread : 0.1);
                if (k == 0) state[k].c()[0] = centre;
                state[k].finish();
            }
        }
        for (int j = 0; j < 2; ++j) {
            auto a = support::random_model<variables, degree>(d, spread, 0.7, spread);
            a.c()[0] = d.uniform(-2, 2);
            a.finish();
            p.push_back(a);
        }
        t = widened(model::constant(d.uniform(0, 2)), d.coin() ? 0 : spread);
    }
};

/// The series of a formula by the library and, at members of its arguments, by 100 digits.
int check_formula(draws& d, double spread) {
    auto const f = support::random_formula(d, 1 + d.below(8), true);
    graph g;
    auto const root = support::recorded_if_defined(f, g);
    if (!root) return 0;
    tape const program(g, {*root});
    inputs const in(d, spread);
    series<value> s(program, order, model::size());
    s.set_parameters(in.p);
    s.start(in.t);
    for (std::size_t k = 0; k <= order; ++k) {
        s.advance(
            k, [&](std::size_t i, std::size_t j) { return value(in.x[i][j]); },
            [](std::size_t, std::size_t) { return value{}; });
    }
    if (s.undefined()) return 0;
    for (int sample = 0; sample < 5; ++sample) {
        auto const q = support::short_point(d, variables);
        std::array<reference, 2> x;
        std::array<reference, 2> p;
        reference t = support::member<mp>(d, in.t, q);
        t.c[1] = 1;
        for (std::size_t i = 0; i < 2; ++i) {
            for (std::size_t k = 0; k <= order; ++k) {
                x[i].c[k] = support::member<mp>(d, in.x[i][k], q);
            }
            p[i] = support::member<mp>(d, in.p[i], q);
        }
        reference exact;
        try {
            exact =
                support::values<reference>(
                    f,
                    [&](operation op, std::size_t i) {
                        return op == operation::time ? t : op == operation::state ? x[i] : p[i];
                    },
                    [](support::formula::term const& n, reference const& a, reference const& b) {
                        support::require_defined(n, a.c[0], b.c[0], true);
                    })
                    .back();
        } catch (support::not_defined const&) {
            continue;
        } catch (support::too_large const&) {
            continue;
        }
        for (std::size_t k = 0; k <= order; ++k) {
            auto const& c = s.output(0, program.output_varies(0) ? k : 0);
            if (!program.output_varies(0) && k > 0) {
                REQUIRE(exact.c[k] == 0);
                continue;
            }
            CAPTURE(k, spread, c.r());
            REQUIRE(support::holds(c, q, exact.c[k], 1e-30));
        }
    }
    return 1;
}

} // namespace

TEST_CASE("series of Taylor models contain the series at each value of the unknowns") {
    draws d(101);
    int compared = 0;
    for (int trial = 0; trial < 250; ++trial) compared += check_formula(d, 0.02);
    for (int trial = 0; trial < 250; ++trial) compared += check_formula(d, 0.4);
    REQUIRE(compared > 200);
}

TEST_CASE("over wide ranges tanh and its slope contain theirs, order by order") {
    graph g;
    expression const x(g, g.leaf(operation::state, 0));
    auto const y = tanh(x).in(g);
    tape const program(g, {y, g[y].companion}); // the slope is found from x, not from tanh
    series<value> s(program, order, model::size());
    draws d(107);
    double narrowest = HUGE_VAL;
    for (int trial = 0; trial < 60; ++trial) {
        inputs const in(d, trial % 2 == 0 ? 1.5 : 0.5);
        s.start(in.t);
        for (std::size_t k = 0; k <= order; ++k) {
            s.advance(
                k, [&](std::size_t i, std::size_t j) { return value(in.x[i][j]); },
                [](std::size_t, std::size_t) { return value{}; });
        }
        CHECK(s.output(1, 0).r() <= 0.501); // it lies in [0, 1]
        narrowest = std::min(narrowest, s.output(1, 0).r());
        for (int sample = 0; sample < 10; ++sample) {
            auto const q = support::short_point(d, variables);
            reference at;
            for (std::size_t k = 0; k <= order; ++k) {
                at.c[k] = support::member<mp>(d, in.x[0][k], q);
            }
            auto const exact = tanh(at);
            auto const slope = reference(1) - exact * exact;
            for (std::size_t k = 0; k <= order; ++k) {
                CAPTURE(trial, k);
                REQUIRE(support::holds(s.output(0, k), q, exact.c[k], 1e-30));
                REQUIRE(support::holds(s.output(1, k), q, slope.c[k], 1e-30));
            }
        }
    }
    CHECK(narrowest < 0.3);
}

TEST_CASE("kinks and jumps of Taylor models are sets") {
    draws d(102);
    for (int trial = 0; trial < 300; ++trial) {
        auto a = support::random_model<variables, degree>(d, 1, 0.8, 0.2);
        auto b = support::random_model<variables, degree>(d, 1, 0.8, 0.2);
        a.c()[0] = d.uniform(-2, 2);
        a.finish();
        auto const absolute = arithmetic::abs(a);
        auto const sign = arithmetic::sign(a);
        auto const least = arithmetic::min(a, b);
        auto const most = arithmetic::max(a, b);
        auto const side = arithmetic::sign_of(a);
        for (int sample = 0; sample < 20; ++sample) {
            auto const q = support::short_point(d, variables);
            auto const x = support::member<mp>(d, a, q);
            auto const y = support::member<mp>(d, b, q);
            REQUIRE(support::holds(absolute, q, mp(abs(x)), 1e-40));
            REQUIRE(support::holds(sign, q, support::real::sign(x), 1e-40));
            REQUIRE(support::holds(least, q, support::real::min(x, y), 1e-40));
            REQUIRE(support::holds(most, q, support::real::max(x, y), 1e-40));
            if (side.positive) REQUIRE(x > 0);
            if (side.negative) REQUIRE(x < 0);
            REQUIRE(side.neither == (!side.positive && !side.negative));
        }
    }
    // An argument that touches zero at one point only: both ends of [-1, 1].
    auto const touching = arithmetic::sign(model::variable(0, 1, 1));
    REQUIRE(support::holds(touching, {-1, 0}, mp(-1)));
    REQUIRE(support::holds(touching, {-1, 0}, mp(1)));
    REQUIRE(arithmetic::sign_of(model::variable(0, 1, 1)).neither);
}

TEST_CASE("kinks of many unknowns, side by side: some lanes are decided, others are sets") {
    using many = lanes<8>;
    using side_by_side = arithmetic_of<taylor_model<many>>;
    auto const& single = model_shape<double>::of(9, 2); // more than 4096 Bernstein coefficients
    draws d(104);
    std::size_t mixed = 0;
    for (int trial = 0; trial < support::swept(40, 120); ++trial) {
        double const bend = trial % 2 == 0 ? 1 : 1e-3; // nearly lines, too
        auto const drawn = [&] {
            taylor_model<many> result(model_shape<many>::of(9, 2));
            for (std::size_t l = 0; l < 8; ++l) {
                auto a = support::random_model(d, single, 1, 0.8, 0.2);
                for (std::size_t i = 0; i < a.terms(); ++i) {
                    if (a.space().degree_of(i) == 2) a.c(i) *= bend;
                    if (i == 0) a.c(i) = d.coin() ? d.uniform(-2, 2) : d.uniform(-30, 30);
                    lane_traits<many>::put(result.c(i), l, a.c(i));
                }
                lane_traits<many>::put(result.r(), l, a.r());
            }
            result.finish();
            return result;
        };
        auto const a = drawn(), b = drawn();
        auto const absolute = side_by_side::abs(a), least = side_by_side::min(a, b),
                   most = side_by_side::max(a, b);
        auto const side = side_by_side::sign_of(a);
        auto const open = lane_traits<many>::any(side.neither);
        mixed += open && !lane_traits<many>::all(side.neither) ? 1 : 0;
        for (std::size_t l = 0; l < 8; ++l) {
            auto const own = lane_of(a, l), other = lane_of(b, l);
            for (int sample = 0; sample < 10; ++sample) {
                auto q = support::short_point(d, 9);
                if (sample < 5) // corners
                    for (double& x : q) x = d.coin() ? 1 : -1;
                auto const x = support::member<mp>(d, own, q), y = support::member<mp>(d, other, q);
                REQUIRE(support::holds(lane_of(absolute, l), q, mp(abs(x)), 1e-40));
                REQUIRE(support::holds(lane_of(least, l), q, support::real::min(x, y), 1e-40));
                REQUIRE(support::holds(lane_of(most, l), q, support::real::max(x, y), 1e-40));
                if (lane_traits<many>::test(side.positive, l)) REQUIRE(x > 0);
                if (lane_traits<many>::test(side.negative, l)) REQUIRE(x < 0);
            }
        }
    }
    CHECK(mixed > support::swept(std::size_t{12}, std::size_t{40}));
}

TEST_CASE("products with constants, powers and quotients contain those of members") {
    draws d(103);
    for (int trial = 0; trial < 200; ++trial) {
        auto const a = support::random_model<variables, degree>(d, 1, 0.8, 0.1);
        auto const constant = widened(model::constant(d.uniform(-2, 2)), d.coin() ? 0 : 0.1);
        auto divisor = support::random_model<variables, degree>(d, 0.2, 0.8, 0.05);
        divisor.c()[0] = d.coin() ? 1.5 : -1.5;
        divisor.finish();
        bool undefined = false;
        auto const left = arithmetic::mul(constant, a);
        auto const right = arithmetic::mul(a, constant);
        auto const square = arithmetic::sqr(a);
        auto const cube = arithmetic::pown(a, 3, undefined);
        auto const ratio = arithmetic::div(a, divisor, undefined);
        auto const third = arithmetic::over(a, 3);
        auto const constant_square = arithmetic::sqr(constant);
        REQUIRE_FALSE(undefined);
        for (int sample = 0; sample < 10; ++sample) {
            auto const q = support::short_point(d, variables);
            auto const x = support::member<mp>(d, a, q);
            auto const c = support::member<mp>(d, constant, q);
            auto const v = support::member<mp>(d, divisor, q);
            REQUIRE(support::holds(left, q, mp(c * x), 1e-40));
            REQUIRE(support::holds(right, q, mp(c * x), 1e-40));
            REQUIRE(support::holds(square, q, mp(x * x), 1e-40));
            REQUIRE(support::holds(cube, q, mp(x * x * x), 1e-40));
            REQUIRE(support::holds(ratio, q, mp(x / v), 1e-40));
            REQUIRE(support::holds(third, q, mp(x / 3), 1e-40));
            REQUIRE(support::holds(constant_square, q, mp(c * c), 1e-40));
        }
    }
}

TEST_CASE("functions of bounded range stay bounded where nothing is known") {
    auto unknown = model::constant(0);
    unknown.r() = HUGE_VAL;
    for (auto const& y : {arithmetic::sin(unknown), arithmetic::cos(unknown),
                          arithmetic::atan(unknown), arithmetic::tanh(unknown)}) {
        REQUIRE(std::isfinite(y.r()));
        REQUIRE(y.c()[0] - y.r() <= -1);
        REQUIRE(y.c()[0] + y.r() >= 1);
    }
    REQUIRE_FALSE(std::isfinite(arithmetic::exp(unknown).r()));
    bool undefined = false;
    (void)arithmetic::div(model::constant(1), unknown, undefined);
    REQUIRE(undefined);
    REQUIRE(arithmetic::sign_of(unknown).neither);
}
