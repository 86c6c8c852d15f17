// SPDX-License-Identifier: MIT
// The formula of a method as a series in the step: its coefficients agree with the solution's up to
// the order, its remainder alone shrinks as it should.
#include <sivid/enclosure/methods.hpp>
#include <sivid/enclosure/runge_kutta/runge_kutta.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/runge_kutta.hpp"
#include "support/sampling.hpp"
#include "support/systems.hpp"

#include <cmath>
#include <vector>

using namespace sivid;
using support::draws;
using support::encloses;
using support::mp;

namespace {

/// Three-eighths rule of order 4 and Euler's method: a user's own.
tableau three_eighths() {
    return {"3/8",
            4,
            {{}, {{1, 3}}, {{-1, 3}, {1, 1}}, {{1, 1}, {-1, 1}, {1, 1}}},
            {{1, 8}, {3, 8}, {3, 8}, {1, 8}},
            {{0, 1}, {1, 3}, {2, 3}, {1, 1}}};
}
tableau euler() { return {"euler", 1, {{}}, {{1, 1}}, {{0, 1}}}; }

std::vector<tableau> all_explicit() {
    return {euler(),         explicit_midpoint(), heun(),    kutta3(), rk4(),
            three_eighths(), dormand_prince5(),   butcher6()};
}

} // namespace

TEST_CASE("coefficient 0 is the formula, the next ones are its Taylor coefficients") {
    draws d(251);
    support::for_each_system([&](auto const& system) {
        auto const f = system.flow();
        for (auto const& method : all_explicit()) {
            runge_kutta<interval> rk(*f, method);
            auto const x0 = d.in(system.initial);
            auto const p0 = d.in(system.parameters);
            rk.set_parameters(point_box(p0));
            std::vector<mp> const x(x0.begin(), x0.end());
            std::vector<mp> const p(p0.begin(), p0.end());
            double const t = 0.0625;
            double const h = 0.01;
            bool undefined = false;
            auto const value = rk.coefficient(t, point_box(x0), interval(h), 0, undefined);
            auto const exact =
                support::exact_step(system.rate, system.inputs, method, t, x, p, h, t);
            // phi(h + e) from the expansion about h, with e small
            double const e = 0x1p-30;
            auto const moved =
                support::exact_step(system.rate, system.inputs, method, t, x, p, mp(h) + mp(e), t);
            auto const top = method.order + 1;
            std::vector<std::vector<interval>> c;
            bool kinked = false;
            for (std::size_t k = 0; k <= top; ++k) {
                c.push_back(rk.coefficient(t, point_box(x0), interval(h), k, undefined));
                kinked = kinked || rk.kinked();
            }
            if (undefined || kinked) continue;
            for (std::size_t i = 0; i < x.size(); ++i) {
                CAPTURE(system.name, method.name, i);
                CHECK(encloses(value[i], exact[i], 1e-40));
                CHECK(width(value[i]) < 1e-13 * (1 + mag(value[i])));
                mp sum_lo = 0;
                mp sum_hi = 0;
                mp power = 1;
                for (std::size_t k = 0; k <= top; ++k) {
                    sum_lo += mp(c[k][i].lower()) * power;
                    sum_hi += mp(c[k][i].upper()) * power;
                    power *= mp(e);
                }
                // The rest of the series: one more power of e, times something moderate.
                mp const room = power * 1e6;
                CHECK(sum_lo - room <= moved[i]);
                CHECK(moved[i] <= sum_hi + room);
            }
        }
    });
}

TEST_CASE(
    "up to its order an explicit method agrees with the solution, one order above it does not") {
    draws d(252);
    support::for_each_smooth_system([&](auto const& system) {
        auto const f = system.flow();
        for (auto const& method : all_explicit()) {
            auto const x0 = d.in(system.initial);
            auto const p0 = d.in(system.parameters);
            runge_kutta<interval> rk(*f, method);
            rk.set_parameters(point_box(p0));
            expansion<interval> e(*f, method.order + 1);
            e.set_parameters(point_box(p0));
            e.expand(0, interval(0.0), point_box(x0), method.order + 1);
            bool differs = false;
            for (std::size_t k = 0; k <= method.order + 1; ++k) {
                bool undefined = false;
                auto const c = rk.coefficient(0, point_box(x0), interval(0.0), k, undefined);
                for (std::size_t i = 0; i < x0.size(); ++i) {
                    CAPTURE(system.name, method.name, k, i);
                    if (k <= method.order) {
                        CHECK_FALSE(disjoint(c[i], e.state(i, k)));
                    } else {
                        differs = differs || disjoint(c[i], e.state(i, k));
                    }
                }
            }
            CHECK(differs);
        }
    });
}

TEST_CASE("one step of fixed length: the error has the method's order and is enclosed") {
    // x' = x: phi(h) and the remainder alone; halving h divides its width by 2^(p+1), or more where
    // the enclosures shrink as well.
    auto const f =
        support::flow_of(support::model_of({1, 0}, [](auto const&, auto const& x, auto const&,
                                                      auto const&) { return std::vector{x[0]}; }));
    for (auto const& method : all_explicit()) {
        if (method.order == 1) continue;
        std::vector<double> widths;
        for (double const h : {0.2, 0.1, 0.05}) {
            enclosure_options o;
            o.method = for_steps(method);
            o.tolerance = 1; // no limit but the length
            o.maximum_step = h;
            auto const tube = integrate<interval>(f, box{interval(1.0)}, box{}, 0, h, o);
            REQUIRE(tube.complete());
            REQUIRE(tube.steps().size() == 1);
            CHECK(support::encloses_reference(tube.at(h)[0],
                                              std::exp(static_cast<support::extended>(h))));
            widths.push_back(width(tube.at(h)[0]));
        }
        CAPTURE(method.name);
        double const expected = std::pow(2, static_cast<double>(method.order) + 1);
        CHECK(widths[0] / widths[1] > 0.9 * expected);
        CHECK(widths[1] / widths[2] > 0.9 * expected);
    }
}

TEST_CASE("a user's tableau encloses all systems") {
    draws d(253);
    support::for_each_system([&](auto system) {
        system.initial = point_box(d.in(system.initial));
        for (auto const& method : {kutta3(), three_eighths(), euler()}) {
            enclosure_options o;
            o.method = for_steps(method);
            o.tolerance = method.order == 1 ? 1e-3 : 1e-6;
            auto const tube =
                integrate<interval>(system.flow(), system.initial,
                                    point_box(d.in(system.parameters)), 0, system.horizon, o);
            system.parameters = point_box(mid(system.parameters));
            auto const again = integrate<interval>(system.flow(), system.initial, system.parameters,
                                                   0, system.horizon, o);
            CAPTURE(system.name, method.name);
            CHECK(tube.end_time() > 0);
            support::check_tube(system, again, d, 1);
        }
    });
}

TEST_CASE("the method of docs/theory/runge_kutta.md") {
    support::for_each_system([](auto const& system) {
        auto const flow = system.flow();
        auto const initial = point_box(mid(system.initial));
        auto const parameters = point_box(mid(system.parameters));
        sivid::enclosure_options options;
        options.method = sivid::radau_iia5();
        auto const tube =
            sivid::integrate<sivid::interval>(flow, initial, parameters, 0, 5, options);
        CHECK(tube.end_time() > 0);
    });
}

TEST_CASE("a tableau of the wrong shape is refused") {
    auto const f =
        support::flow_of(support::model_of({1, 0}, [](auto const&, auto const& x, auto const&,
                                                      auto const&) { return std::vector{x[0]}; }));
    auto bad = rk4();
    bad.b.pop_back();
    CHECK_THROWS_AS(runge_kutta<interval>(*f, bad), std::invalid_argument);
    CHECK_THROWS_AS(runge_kutta<interval>(*f, gauss2()), std::invalid_argument);
    auto boast = kutta3();
    boast.order = 4;
    CHECK_THROWS_WITH(runge_kutta<interval>(*f, boast), ContainsSubstring("order 4"));
}
