// SPDX-License-Identifier: MIT
// Stages of implicit methods: existence and uniqueness over points, boxes and ranges of the step,
// their series in the step, the linear systems, and that no proof is claimed where there is none.
#include <sivid/enclosure/runge_kutta/runge_kutta.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/runge_kutta.hpp"
#include "support/systems.hpp"

#include <cmath>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::encloses;
using support::exact_stages;
using support::implicit_methods;
using support::mp;

namespace {

std::vector<mp> lift(std::vector<double> const& x) { return std::vector<mp>(x.begin(), x.end()); }
std::vector<interval> sides(box const& x) { return std::vector<interval>(x.begin(), x.end()); }

template <class Rate>
std::shared_ptr<flow const> scalar(Rate const& rate, std::size_t parameters = 0) {
    return support::flow_of(support::model_of(
        {1, parameters}, [rate](auto const& t, auto const& x, auto const& p, auto const&) {
            return std::vector{rate(t, x[0], p)};
        }));
}

} // namespace

TEST_CASE("proven stages hold the exact ones, for points, boxes and ranges of the step") {
    draws d(611);
    int proofs = 0;
    support::for_each_system([&](auto const& system) {
        auto const f = system.flow();
        for (auto const& method : implicit_methods()) {
            for (int kind = 0; kind < 3; ++kind) {
                implicit_stages<interval> stages(*f, method);
                bool const wide = kind > 0;
                auto const x = wide ? system.initial : point_box(d.in(system.initial));
                auto const p = wide ? system.parameters : point_box(d.in(system.parameters));
                auto const step = kind == 2 ? between(0, 0.01) : interval(0.01);
                double const t = 0.0625;
                stages.set_parameters(p);
                auto const k = stages.prove(t, sides(x), step);
                if (!k) continue; // across a kink
                ++proofs;
                for (int member = 0; member < 2; ++member) {
                    mp const h = d.in(step);
                    auto const exact = exact_stages(system.rate, system.inputs, method, t,
                                                    lift(d.in(x)), lift(d.in(p)), h, t);
                    for (std::size_t i = 0; i < method.stages(); ++i) {
                        for (std::size_t s = 0; s < x.size(); ++s) {
                            CAPTURE(system.name, method.name, kind, i, s);
                            auto const& value = k->value[i * x.size() + s];
                            CHECK(encloses(value, exact[i][s], 1e-40));
                            if (!wide) CHECK(width(value) < 1e-11 * (1 + mag(value)));
                            auto const centre = mid(k->centre[i * x.size() + s]);
                            CHECK(abs(exact[i][s] - mp(centre)) <= k->radius[i * x.size() + s]);
                        }
                    }
                }
            }
        }
    });
    CHECK(proofs > 250);
}

TEST_CASE("the series of the stages is that of the exact ones") {
    // k(h + e) for a small e, from the coefficients at h.
    draws d(612);
    support::for_each_smooth_system([&](auto const& system) {
        auto const f = system.flow();
        for (auto const& method : implicit_methods()) {
            implicit_stages<interval> stages(*f, method);
            auto const x = d.in(system.initial);
            auto const p = d.in(system.parameters);
            stages.set_parameters(point_box(p));
            double const h = 0.01;
            auto const k = stages.prove(0, sides(point_box(x)), interval(h));
            REQUIRE(k);
            auto const order = method.order + 1;
            auto const c = stages.expand(0, sides(point_box(x)), interval(h), *k, order);
            REQUIRE(c);
            double const e = 0x1p-30;
            auto const moved =
                exact_stages(system.rate, system.inputs, method, 0, lift(x), lift(p), mp(h) + e, 0);
            for (std::size_t i = 0; i < k->value.size(); ++i) {
                mp lo = 0;
                mp hi = 0;
                mp power = 1;
                for (std::size_t j = 0; j <= order; ++j) {
                    lo += mp((*c)[j][i].lower()) * power;
                    hi += mp((*c)[j][i].upper()) * power;
                    power *= mp(e);
                }
                auto const& exact = moved[i / x.size()][i % x.size()];
                mp const room = power * 1e10;
                CAPTURE(system.name, method.name, i);
                CHECK(lo - room <= exact);
                CHECK(exact <= hi + room);
                // The window tells the first two coefficients from their neighbours.
                CHECK(hi - lo < 1e-12 * (1 + mp(mag(k->value[i]))) + 1e-10);
            }
        }
    });
}

TEST_CASE("coefficients of a linear problem against the closed form, over ranges of the step") {
    // x' = -L x: the one stage of the midpoint rule is k = -L x / (1 + s L / 2), whose coefficients
    // about s are -L x (-L/2)^j / (1 + s L / 2)^(j + 1).
    double const rate = 3;
    auto const f = scalar([&](auto const&, auto const& x, auto const&) { return -(rate * x); });
    implicit_stages<interval> stages(*f, gauss2());
    stages.set_parameters(box{});
    for (auto const& step :
         {interval(0.5), between(0, 0.25), between(0.5, 0.5625), interval(0.0)}) {
        auto const k = stages.prove(0, {interval(1.0)}, step);
        REQUIRE(k);
        auto const c = stages.expand(0, {interval(1.0)}, step, *k, 3);
        REQUIRE(c);
        for (double const s : {step.lower(), mid(step), step.upper()}) {
            mp const base = 1 + mp(s) * rate / 2;
            mp exact = -rate / base;
            for (std::size_t j = 0; j <= 3; ++j) {
                CAPTURE(step.lower(), step.upper(), s, j);
                CHECK(encloses((*c)[j][0], exact, 1e-45));
                exact *= -rate / (2 * base);
            }
        }
        if (is_point(step)) {
            for (auto const& each : *c) CHECK(width(each[0]) < 1e-12);
        }
    }
}

TEST_CASE("linear systems with the stages' matrix are solved for every member") {
    // (1 + s L / 2) z = r for s in a range and r in an interval.
    auto const f = scalar([](auto const&, auto const& x, auto const&) { return -(4 * x); });
    implicit_stages<interval> stages(*f, gauss2());
    stages.set_parameters(box{});
    auto const step = between(0.25, 0.5);
    auto const k = stages.prove(0, {interval(1.0)}, step);
    REQUIRE(k);
    auto const z = stages.solve(step, *k, {between(3, 6)});
    CHECK(encloses(z[0], mp(3) / 2));
    CHECK(encloses(z[0], mp(6) / mp(1.5)));
    CHECK(width(z[0]) < 8);
}

TEST_CASE("no proof where the stages do not exist, are not unique, or leave the domain") {
    // k = 1 + (x + h k / 2)^2 has no real solution from h = 2 (sqrt 2 - 1) on, for x = 1 below
    // that.
    auto const square = scalar([](auto const&, auto const& x, auto const&) {
        using namespace support::real;
        return 1 + sqr(x);
    });
    implicit_stages<interval> stages(*square, gauss2());
    stages.set_parameters(box{});
    // (h k/2)^2 + (2 - 2/h)(h k/2) + 2 = 0 has two roots iff (1 - 1/h)^2 > 2: h < sqrt 2 - 1.
    CHECK(stages.prove(0, {interval(1.0)}, interval(0.40)));
    CHECK_FALSE(stages.prove(0, {interval(1.0)}, interval(0.4142135623730951)));
    CHECK_FALSE(stages.prove(0, {interval(1.0)}, interval(0.42)));
    CHECK_FALSE(stages.prove(0, {interval(1.0)}, between(0.40, 0.42)));
    // Both solutions in one region: never.
    auto const k = stages.prove(0, {interval(1.0)}, interval(0.40));
    REQUIRE(k);
    double const other = 2 / 0.4 * (0.5 * (3 + std::sqrt(1.0)));
    CHECK_FALSE(k->holds({interval(other)}));
    CHECK_FALSE(stages.prove(0, {interval(1.0)}, interval(0.40), {{interval(other)}}));
    CHECK_FALSE(stages.prove(0, {between(0.0, 3.0)}, interval(0.40)));
    // A pole and a kink.
    auto const root = scalar([](auto const&, auto const& x, auto const&) {
        using namespace support::real;
        return -sqrt(x);
    });
    implicit_stages<interval> falling(*root, gauss4());
    falling.set_parameters(box{});
    CHECK(falling.prove(0, {interval(1.0)}, interval(0.5)));
    CHECK_FALSE(falling.prove(0, {between(0, 1)}, interval(0.5)));
    auto const bent = scalar([](auto const&, auto const& x, auto const&) {
        using namespace support::real;
        return -abs(x);
    });
    implicit_stages<interval> kinked(*bent, gauss4());
    kinked.set_parameters(box{});
    CHECK(kinked.prove(0, {interval(1.0)}, interval(0.5)));
    CHECK_FALSE(kinked.prove(0, {between(-1, 1)}, interval(0.5)));
}

TEST_CASE("long steps of a stiff linear problem have proven stages") {
    auto const f = scalar([](auto const&, auto const& x, auto const&) { return -(1000 * x); });
    for (auto const& method : implicit_methods()) {
        implicit_stages<interval> stages(*f, method);
        stages.set_parameters(box{});
        auto const k = stages.prove(0, {interval(1.0)}, interval(1.0));
        CAPTURE(method.name);
        REQUIRE(k);
        for (auto const& value : k->value) CHECK(width(value) < 1e-8);
    }
}

TEST_CASE("tableaux of explicit methods and false orders are refused") {
    auto const f = scalar([](auto const&, auto const& x, auto const&) { return -x; });
    CHECK_THROWS_AS(implicit_stages<interval>(*f, rk4()), std::invalid_argument);
    auto boast = gauss2();
    boast.order = 3;
    CHECK_THROWS_WITH(implicit_stages<interval>(*f, boast), ContainsSubstring("gauss2"));
}
