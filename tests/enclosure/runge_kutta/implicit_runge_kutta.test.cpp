// SPDX-License-Identifier: MIT
// The formula of an implicit method as a series in the step, its local error on its own, orders of
// convergence, and enclosures of whole trajectories.
#include <sivid/enclosure/runge_kutta/runge_kutta.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/runge_kutta.hpp"
#include "support/sampling.hpp"
#include "support/systems.hpp"

#include <cmath>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::encloses;
using support::exact_step;
using support::implicit_methods;
using support::mp;

namespace {

std::vector<mp> lift(std::vector<double> const& x) { return {x.begin(), x.end()}; }
std::vector<interval> points(std::vector<double> const& x) {
    auto const b = point_box(x);
    return std::vector<interval>(b.begin(), b.end());
}

std::vector<tableau> all_methods() {
    auto methods = implicit_methods();
    for (auto const& m :
         {explicit_midpoint(), heun(), kutta3(), rk4(), dormand_prince5(), butcher6()}) {
        methods.push_back(m);
    }
    return methods;
}

/// phi(h) and phi^[p+1] over [0, h], whatever the method.
std::optional<runge_kutta_formula<interval>> formula(flow const& f, tableau const& m, box const& x,
                                                     box const& p, double h) {
    if (m.is_explicit()) {
        runge_kutta<interval> method(f, m);
        method.set_parameters(p);
        return method.formula(0, x, interval(h));
    }
    implicit_runge_kutta<interval> method(f, m);
    method.set_parameters(p);
    return method.formula(0, x, interval(h));
}

/// h^(p+1) (x^[p+1](B) - phi^[p+1]([0, h]))
std::vector<interval> local_error(flow const& f, tableau const& m, box const& tube, box const& p,
                                  runge_kutta_formula<interval> const& q, double h) {
    using traits = interval_traits<interval>;
    auto const k = m.order + 1;
    expansion<interval> e(f, k);
    e.set_parameters(p);
    e.expand(0.0, between(0, h), tube, k);
    bool never = false;
    auto const power = traits::pown(interval(h), static_cast<int>(k), never);
    std::vector<interval> result;
    for (std::size_t i = 0; i < tube.size(); ++i) {
        result.push_back(traits::mul(power, traits::sub(e.state(i, k), q.next[i])));
    }
    return result;
}

struct closed_form {
    std::string name;
    support::shape sizes;
    std::function<std::vector<mp>(mp const& t, mp const& x0)> solution;
    std::shared_ptr<flow const> equations;
    std::function<std::vector<mp>(std::vector<mp> const& x)> rate;
    double initial;
    double step; ///< a coarse one
};

std::vector<closed_form> closed_forms() {
    std::vector<closed_form> list;
    auto const add = [&](std::string name, auto const& rate, auto const& solution, double x0,
                         double step) {
        closed_form c;
        c.name = std::move(name);
        c.equations = support::flow_of(
            support::model_of({1, 0}, [rate](auto const&, auto const& x, auto const&, auto const&) {
                return std::vector{rate(x[0])};
            }));
        c.rate = [rate](std::vector<mp> const& x) { return std::vector<mp>{mp(rate(x[0]))}; };
        c.solution = [solution](mp const& t, mp const& x) {
            return std::vector<mp>{solution(t, x)};
        };
        c.initial = x0;
        c.step = step;
        list.push_back(std::move(c));
    };
    add(
        "growth", [](auto const& x) { return x * 1; },
        [](mp const& t, mp const& x) { return mp(x * exp(t)); }, 1, 0.75);
    add(
        "decay", [](auto const& x) { return -(2 * x); },
        [](mp const& t, mp const& x) { return mp(x * exp(-2 * t)); }, 1, 0.4);
    add(
        "logistic", [](auto const& x) { return x * (1 - x); },
        [](mp const& t, mp const& x) { return mp(x * exp(t) / (1 + x * (exp(t) - 1))); }, 0.25,
        0.75);
    add(
        "hyperbola", [](auto const& x) { return -(x * x); },
        [](mp const& t, mp const& x) { return mp(x / (1 + x * t)); }, 1, 0.3);
    return list;
}

} // namespace

TEST_CASE("value and coefficients of the formula are the exact ones") {
    draws d(621);
    support::for_each_smooth_system([&](auto const& system) {
        auto const f = system.flow();
        for (auto const& method : implicit_methods()) {
            implicit_runge_kutta<interval> rk(*f, method);
            auto const x = d.in(system.initial);
            auto const p = d.in(system.parameters);
            rk.set_parameters(point_box(p));
            double const h = 0.01;
            auto const k = rk.stages().prove(0, points(x), interval(h));
            REQUIRE(k);
            auto const value = rk.value(points(x), interval(h), *k);
            auto const exact =
                exact_step(system.rate, system.inputs, method, mp(0), lift(x), lift(p), mp(h), 0);
            double const e = 0x1p-30;
            auto const moved = exact_step(system.rate, system.inputs, method, mp(0), lift(x),
                                          lift(p), mp(h) + e, 0);
            for (std::size_t i = 0; i < x.size(); ++i) {
                CAPTURE(system.name, method.name, i);
                CHECK(encloses(value[i], exact[i], 1e-40));
                CHECK(width(value[i]) < 1e-13 * (1 + mag(value[i])));
                mp lo = value[i].lower();
                mp hi = value[i].upper();
                mp power = 1;
                for (std::size_t j = 1; j <= method.order + 1; ++j) {
                    power *= mp(e);
                    auto const c = rk.coefficient(0, points(x), interval(h), *k, j);
                    REQUIRE(c);
                    lo += mp((*c)[i].lower()) * power;
                    hi += mp((*c)[i].upper()) * power;
                }
                mp const room = power * mp(e) * 1e10;
                CHECK(lo - room <= moved[i]);
                CHECK(moved[i] <= hi + room);
            }
        }
    });
}

TEST_CASE("up to its order a method agrees with the solution, one order above it does not") {
    draws d(622);
    support::for_each_smooth_system([&](auto const& system) {
        auto const f = system.flow();
        for (auto const& method : implicit_methods()) {
            auto const x = d.in(system.initial);
            auto const p = d.in(system.parameters);
            implicit_runge_kutta<interval> rk(*f, method);
            rk.set_parameters(point_box(p));
            expansion<interval> e(*f, method.order + 1);
            e.set_parameters(point_box(p));
            e.expand(0.0, interval(0.0), point_box(x), method.order + 1);
            auto const k = rk.stages().prove(0, points(x), interval(0.0));
            REQUIRE(k);
            bool differs = false;
            for (std::size_t j = 1; j <= method.order + 1; ++j) {
                auto const c = rk.coefficient(0, points(x), interval(0.0), *k, j);
                REQUIRE(c);
                for (std::size_t i = 0; i < x.size(); ++i) {
                    CAPTURE(system.name, method.name, j, i);
                    bool const apart = disjoint((*c)[i], e.state(i, j));
                    if (j <= method.order)
                        CHECK_FALSE(apart);
                    else
                        differs = differs || apart;
                }
            }
            CHECK(differs);
        }
    });
}

TEST_CASE("the coefficient over a whole step holds those at every length of it") {
    draws d(623);
    support::for_each_smooth_system([&](auto const& system) {
        auto const f = system.flow();
        for (auto const& method : implicit_methods()) {
            auto const x = d.in(system.initial);
            implicit_runge_kutta<interval> rk(*f, method);
            rk.set_parameters(point_box(mid(system.parameters)));
            for (double const h : {0.01, 0.05}) {
                auto const all = rk.formula(0, points(x), interval(h));
                if (!all) continue;
                for (double const share : {0.0, 0.3, 0.5, 1.0}) {
                    auto const s = interval(h * share);
                    auto const k = rk.stages().prove(0, points(x), s);
                    REQUIRE(k);
                    auto const c = rk.coefficient(0, points(x), s, *k, method.order + 1);
                    REQUIRE(c);
                    for (std::size_t i = 0; i < x.size(); ++i) {
                        CAPTURE(system.name, method.name, h, share, i);
                        CHECK_FALSE(disjoint((*c)[i], all->next[i]));
                        CHECK(contains(all->next[i], mid((*c)[i])));
                    }
                }
            }
        }
    });
}

TEST_CASE("the local error of a coarse step contains the true defect") {
    for (auto const& problem : closed_forms()) {
        auto const& f = *problem.equations;
        support::rate_on<mp> const rate = [&](auto const&, auto const& x, auto const&,
                                              auto const&) { return problem.rate(x); };
        for (auto const& method : all_methods()) {
            for (double const h : {problem.step, problem.step / 4}) {
                CAPTURE(problem.name, method.name, h);
                auto const x0 = point_box({problem.initial});
                auto const end = problem.solution(h, problem.initial)[0];
                // The range of the solution, which is monotone.
                double const a = problem.initial;
                double const b = end.convert_to<double>();
                auto const tube = box{between(std::min(a, b) - 1e-15, std::max(a, b) + 1e-15)};
                auto const q = formula(f, method, x0, box{}, h);
                REQUIRE(q);
                auto const error = local_error(f, method, tube, box{}, *q, h)[0];
                auto const step =
                    exact_step(rate, {}, method, mp(0), {mp(problem.initial)}, {}, mp(h), 0);
                mp const defect = end - step[0];
                CHECK(encloses(error, defect, 1e-40));
                // And no more than a few times the remainder of a Taylor series of that order.
                expansion<interval> e(f, method.order + 1);
                e.set_parameters(box{});
                e.expand(0.0, between(0, h), tube, method.order + 1);
                double const taylor = mag(e.state(0, method.order + 1)) *
                                      std::pow(h, static_cast<double>(method.order + 1));
                CHECK(mag(error) < (h < problem.step ? 12 : 300) * taylor);
            }
        }
    }
}

TEST_CASE("the local error shrinks as the step to the power of the order plus one") {
    // The pendulum; the tube is that of the Taylor series.
    auto const f = support::flow_of(
        support::model_of({2, 0}, [](auto const&, auto const& x, auto const&, auto const&) {
            using namespace support::real;
            return std::vector{x[1], -sin(x[0]) - 0.25 * x[1]};
        }));
    box const x0{interval(1.0), interval(0.5)};
    for (auto const& method : all_methods()) {
        std::vector<double> sizes;
        std::vector<double> widths;
        for (double const h : {0x1p-7, 0x1p-8, 0x1p-15, 0x1p-16}) {
            auto const tube = integrate<interval>(f, x0, box{}, 0, h);
            REQUIRE(tube.complete());
            auto const q = formula(*f, method, x0, box{}, h);
            REQUIRE(q);
            double size = 0;
            double wide = 0;
            for (auto const& e : local_error(*f, method, tube.over(0, h), box{}, *q, h)) {
                size = std::max(size, mag(e));
                wide = std::max(wide, width(e));
            }
            sizes.push_back(size);
            widths.push_back(wide);
        }
        CAPTURE(method.name, sizes, widths);
        auto const order = static_cast<double>(method.order);
        CHECK_THAT(std::log2(sizes[2] / sizes[3]), WithinAbs(order + 1, 0.3));
        // The enclosures over the step shrink with it as well. They are wider than the error for
        // longer steps: the leading coefficient of a good method is small against that of x.
        CHECK_THAT(std::log2(widths[0] / widths[1]), WithinAbs(order + 2, 0.3));
        CHECK(sizes[0] / sizes[1] >= std::exp2(order + 0.7));
    }
}

TEST_CASE(
    "the enclosure of a point at a fixed time shrinks as the step to the power of the order") {
    auto const f = support::flow_of(
        support::model_of({2, 0}, [](auto const&, auto const& x, auto const&, auto const&) {
            using namespace support::real;
            return std::vector{x[1], -sin(x[0]) - 0.25 * x[1]};
        }));
    box const x0{interval(1.0), interval(0.5)};
    auto const fine = integrate<interval>(f, x0, box{}, 0, 1).end().hull;
    for (auto const& method : all_methods()) {
        std::vector<double> widths;
        for (double const h : {0x1p-4, 0x1p-5, 0x1p-6}) {
            enclosure_options o;
            o.method = method;
            o.tolerance = 2; // no limit but the length: the tube's margin does not shrink with it
            o.maximum_step = h;
            auto const tube = integrate<interval>(f, x0, box{}, 0, 1, o);
            REQUIRE(tube.complete());
            REQUIRE(tube.steps().size() == static_cast<std::size_t>(std::lround(1 / h)));
            for (std::size_t i = 0; i < 2; ++i) CHECK(subset(fine[i], tube.end().hull[i]));
            widths.push_back(width(tube.end().hull));
        }
        CAPTURE(method.name, widths);
        auto const order = static_cast<double>(method.order);
        CHECK_THAT(std::log2(widths[0] / widths[1]), WithinAbs(order, 0.3));
        CHECK_THAT(std::log2(widths[1] / widths[2]), WithinAbs(order, 0.3));
    }
}

TEST_CASE("implicit methods enclose all systems") {
    draws d(624);
    support::for_each_system([&](auto const& original) {
        for (auto const& method : implicit_methods()) {
            auto system = original;
            enclosure_options o;
            o.method = method;
            o.tolerance = method.order <= 2 ? 1e-4 : 1e-6;
            for (int kind = 0; kind < 2; ++kind) {
                if (kind == 1) { // a point
                    system.initial = point_box(d.in(system.initial));
                    system.parameters = point_box(mid(system.parameters));
                }
                auto const tube = integrate<interval>(system.flow(), system.initial,
                                                      system.parameters, 0, system.horizon, o);
                CAPTURE(system.name, method.name, kind);
                CHECK(tube.end_time() > 0);
                if (kind == 1) CHECK(tube.complete());
                support::check_tube(system, tube, d, 1);
            }
        }
    });
}

TEST_CASE("point trajectories agree with the Taylor series at its tightest") {
    draws d(625);
    support::for_each_smooth_system([&](auto const& system) {
        auto const x0 = point_box(d.in(system.initial));
        auto const p = point_box(d.in(system.parameters));
        auto const exact = integrate<interval>(system.flow(), x0, p, 0, system.horizon);
        REQUIRE(exact.complete());
        for (auto const& method : {gauss6(), radau_iia5(), lobatto_iiic6(), butcher6()}) {
            enclosure_options o;
            o.method = method;
            o.tolerance = 1e-9;
            auto const tube = integrate<interval>(system.flow(), x0, p, 0, system.horizon, o);
            CAPTURE(system.name, method.name);
            REQUIRE(tube.complete());
            for (std::size_t i = 0; i < x0.size(); ++i) {
                CHECK_FALSE(disjoint(tube.end().hull[i], exact.end().hull[i]));
                CHECK(contains(tube.end().hull[i], mid(exact.end().hull[i])));
                CHECK(width(tube.end().hull[i]) < 1e-4);
            }
        }
    });
}

TEST_CASE("the derivative of the step map by implicit differentiation") {
    draws d(626);
    support::for_each_smooth_system([&](auto const& system) {
        auto const f = system.flow();
        auto const n = f->states();
        for (auto const& method : implicit_methods()) {
            for (bool const wide : {false, true}) {
                auto const x = wide ? system.initial : point_box(d.in(system.initial));
                auto const p = wide ? system.parameters : point_box(d.in(system.parameters));
                implicit_runge_kutta<interval> rk(*f, method);
                rk.set_parameters(p);
                double const h = 0.01;
                auto const k =
                    rk.stages().prove(0, std::vector<interval>(x.begin(), x.end()), interval(h));
                REQUIRE(k);
                auto const j = rk.derivative(interval(h), *k);
                auto const x0 = lift(d.in(x));
                auto const p0 = lift(d.in(p));
                for (std::size_t c = 0; c < n + p.size(); ++c) {
                    mp const e = 1e-14;
                    auto const at = [&](mp const& by) {
                        auto moved = x0;
                        auto parameters = p0;
                        (c < n ? moved[c] : parameters[c - n]) += by;
                        return exact_step(system.rate, system.inputs, method, mp(0), moved,
                                          parameters, mp(h), 0);
                    };
                    auto const above = at(e);
                    auto const below = at(-e);
                    for (std::size_t i = 0; i < n; ++i) {
                        mp const slope = (above[i] - below[i]) / (2 * e);
                        CAPTURE(system.name, method.name, wide, i, c);
                        CHECK(encloses(j(i, c), slope, 1e-22));
                        if (!wide) CHECK(width(j(i, c)) < 1e-10);
                    }
                }
            }
        }
    });
}

TEST_CASE("a step whose stages cannot be proved is shortened, or fails with advice") {
    // y grows from 1, but the first stage of Lobatto IIIC of order 4 lies below 1 by h^3/4: across
    // a kink that neither the solution nor its tube touches.
    auto const f = support::flow_of(
        support::model_of({3, 0}, [](auto const&, auto const& x, auto const&, auto const&) {
            using namespace support::real;
            return std::vector{0 * x[0] + 1, 0.75 - 3 * sqr(x[0]), 0x1p-30 * abs(x[1] - 0.98)};
        }));
    box const x0{interval(0.0), interval(1.0), interval(0.0)};
    enclosure_options o;
    o.method = lobatto_iiic4();
    o.tolerance = 1e-5;
    o.maximum_step = 0.5;
    o.minimum_step = 0.15; // of a span of 2
    auto const stopped = integrate<interval>(f, x0, box{}, 0, 2, o);
    REQUIRE(stopped.failure());
    CHECK(stopped.failure()->reason == failure_reason::unsolved_stages);
    CHECK(stopped.failure()->help == advice::shorter_steps);
    CHECK(stopped.end_time() == 0);
    o.minimum_step = 1e-3;
    auto const shorter = integrate<interval>(f, x0, box{}, 0, 0.5, o);
    REQUIRE(shorter.complete());
    CHECK(shorter.steps().size() > 1);
    CHECK(contains(shorter.end().hull[1], 1 + 0.75 * 0.5 - 0.125));
    o.method = gauss4(); // whose stages stay within
    o.minimum_step = 0.3;
    o.maximum_step = 0.5;
    CHECK(integrate<interval>(f, x0, box{}, 0, 0.5, o).steps().size() == 1);
}
