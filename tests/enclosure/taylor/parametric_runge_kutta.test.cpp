// SPDX-License-Identifier: MIT
// Runge-Kutta steps on Taylor-model sets: every step's set and tube against closed forms, at the
// same unknowns; the order of convergence of what is lost; agreement with the Taylor series.
#include <sivid/enclosure/taylor/parametric_runge_kutta.hpp>

#include "support/catch.hpp"
#include "support/parametric_sets.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"
#include "support/runge_kutta.hpp"
#include "support/systems.hpp"
#include "support/taylor_models.hpp"

#include <sivid/enclosure/taylor/parametric_flow.hpp>

#include <cmath>
#include <functional>
#include <vector>

using namespace sivid;
using support::at;
using support::between;
using support::draws;
using support::encloses_at;
using support::extended;
using support::extended_state;
using support::flow_of;
using support::model_of;

namespace {

using exact_solution = std::function<extended_state(extended, std::vector<extended> const&,
                                                    std::vector<extended> const&)>;

std::vector<tableau> methods() {
    auto all = support::implicit_methods();
    for (auto const& m : {heun(), kutta3(), rk4(), dormand_prince5(), butcher6()}) {
        all.push_back(m);
    }
    return all;
}

template <std::size_t N, std::size_t D>
std::size_t check_run(flow const& f, enclosure_options const& options, box const& x0, box const& p,
                      double end, exact_solution const& exact, extended slack = 1e-16L) {
    draws d(661);
    support::sized_runge_kutta<N, D> run(f, options);
    run.begin(0, x0, p);
    while (run.time() < end) {
        double const from = run.time();
        bool const done = run.step(end);
        CAPTURE(options.method->name, options.tolerance, from, run.steps());
        if (!done) FAIL(run.failure()->message("x"));
        auto const swept = run.swept();
        auto const hull = run.set().hull();
        for (int sample = 0; sample < 8; ++sample) {
            std::vector<double> q;
            for (std::size_t v = 0; v < N; ++v) q.push_back(d.in(between(-1, 1)));
            auto const start = at(run.unknowns().initial, q);
            auto const parameters = at(run.unknowns().parameters, q);
            auto const x = exact(run.time(), start, parameters);
            REQUIRE(encloses_at(run.set(), q, x, slack));
            double const within = d.uniform(from, run.time());
            auto const during = exact(within, start, parameters);
            for (std::size_t i = 0; i < x.size(); ++i) {
                REQUIRE(support::encloses_reference(hull[i], x[i], 1e-15));
                REQUIRE(support::encloses_reference(swept[i], during[i], 1e-15));
            }
        }
    }
    return run.steps();
}

enclosure_options patient(tableau const& method, double tolerance) {
    enclosure_options o;
    o.method = method;
    o.tolerance = tolerance;
    o.minimum_step = 1e-4;
    o.widest = 1e6;
    o.remainder_share = 1e9;
    return o;
}

} // namespace

TEST_CASE("every step's set holds the solution at the same unknowns") {
    auto const decay =
        flow_of(model_of({1, 1, 0, 1e3}, [](auto const&, auto const& x, auto const& p,
                                            auto const&) { return std::vector{-(p[0] * x[0])}; }));
    auto const logistic = flow_of(
        model_of({1, 1, 0, 1e3}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[0] * (1 - x[0])};
        }));
    auto const forced = flow_of(
        model_of({2, 1, 0, 1e3}, [](auto const& t, auto const& x, auto const& p, auto const&) {
            using namespace support::real;
            return std::vector{p[0] * x[1] + 0 * t, -(p[0] * x[0])};
        }));
    std::size_t steps = 0;
    for (auto const& method : methods()) {
        // Coarse steps as well: the local error does not hide behind rounding.
        for (double const tolerance : {1e-2, 1e-6}) {
            if (method.order <= 2 && tolerance < 1e-3) continue;
            auto const o = patient(method, tolerance);
            steps += check_run<2, 3>(*decay, o, box{between(0.9, 1.1)}, box{between(0.8, 1.2)}, 2,
                                     [](extended t, auto const& x, auto const& p) {
                                         return extended_state{x[0] * std::exp(-p[0] * t)};
                                     });
            steps += check_run<2, 5>(*logistic, o, box{between(0.1, 0.2)}, box{between(0.9, 1.1)},
                                     2, [](extended t, auto const& x, auto const& p) {
                                         extended const e = std::exp(p[0] * t);
                                         return extended_state{x[0] * e / (1 + x[0] * (e - 1))};
                                     });
            steps += check_run<3, 2>(
                *forced, o, box{between(0.9, 1.1), between(-0.1, 0.1)}, box{between(0.9, 1.1)}, 2,
                [](extended t, auto const& x, auto const& p) {
                    extended const c = std::cos(p[0] * t);
                    extended const s = std::sin(p[0] * t);
                    return extended_state{c * x[0] + s * x[1], c * x[1] - s * x[0]};
                },
                1e-15L);
        }
    }
    CHECK(steps > 300);
}

TEST_CASE("a step without tolerance: only the local error stands between method and solution") {
    // One step of 1/4 from a point, exact to the last bit but for what the method loses.
    auto const f =
        flow_of(model_of({1, 0, 0, 1e3}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{x[0] * (1 - x[0])};
        }));
    for (auto const& method : methods()) {
        auto o = patient(method, 0.5); // of states of 1/4
        o.maximum_step = 0.25;
        support::sized_runge_kutta<1, 2> run(*f, o);
        run.begin(0, box{interval(0.25)}, box{});
        REQUIRE(run.step(0.25));
        REQUIRE(run.time() == 0.25);
        extended const e = std::exp(0.25L);
        extended const exact = 0.25L * e / (1 + 0.25L * (e - 1));
        extended const off = std::fabs(exact - run.set().centre[0].c(0));
        CAPTURE(method.name, static_cast<double>(off), run.set().reach[0]);
        CHECK(off > 1e-12L);
        CHECK(off <= run.set().reach[0]);
    }
}

TEST_CASE("what is lost at a fixed time shrinks as the step to the power of the order") {
    auto const f =
        flow_of(model_of({2, 0, 0, 1e3}, [](auto const&, auto const& x, auto const&, auto const&) {
            using namespace support::real;
            return std::vector{x[1], -sin(x[0]) - 0.25 * x[1]};
        }));
    for (auto const& method : methods()) {
        std::vector<double> lost;
        // High orders reach the rounding soon.
        double const longest = method.order >= 5 ? 0.25 : 0.0625;
        for (double const h : {longest, longest / 2, longest / 4}) {
            auto o = patient(method, 0.3); // the tube keeps its margin
            o.maximum_step = h;
            support::sized_runge_kutta<1, 2> run(*f, o);
            run.begin(0, box{interval(1.0), interval(0.5)}, box{});
            while (run.time() < 1) REQUIRE(run.step(1));
            REQUIRE(run.steps() == static_cast<std::size_t>(std::lround(1 / h)));
            lost.push_back(run.set().reach[0] + run.set().reach[1]);
        }
        CAPTURE(method.name, lost);
        auto const order = static_cast<double>(method.order);
        CHECK(std::log2(lost[1] / lost[2]) > order - 0.3);
        CHECK(std::log2(lost[1] / lost[2]) < order + 1.3);
    }
}

TEST_CASE("wide boxes stay as tight as with the Taylor series") {
    auto const f = flow_of(
        model_of({2, 1, 0, 1e3}, [](auto const&, auto const& x, auto const& p, auto const&) {
            using namespace support::real;
            return std::vector{x[1], p[0] * ((1 - sqr(x[0])) * x[1]) - x[0]};
        }));
    box const x0{between(1.9, 2.1), between(-0.1, 0.1)};
    box const p{between(0.9, 1.1)};
    support::sized_flow<3, 4> series(*f, {});
    series.begin(0, x0, p);
    while (series.time() < 2) REQUIRE(series.step(2));
    for (auto const& method : {rk4(), butcher6(), gauss4(), radau_iia5(), gauss6()}) {
        enclosure_options o;
        o.method = method;
        o.tolerance = 1e-6;
        support::sized_runge_kutta<3, 4> run(*f, o);
        run.begin(0, x0, p);
        CAPTURE(method.name);
        while (run.time() < 2) REQUIRE(run.step(2));
        auto const a = series.set().hull();
        auto const b = run.set().hull();
        for (std::size_t i = 0; i < 2; ++i) {
            CHECK_FALSE(disjoint(a[i], b[i]));
            CHECK(width(b[i]) < 1.1 * width(a[i]));
        }
    }
}

TEST_CASE("failures say why, and options without a method are refused") {
    auto const f =
        flow_of(model_of({1, 0, 0, 1e6}, [](auto const&, auto const& x, auto const&, auto const&) {
            using namespace support::real;
            return std::vector{sqr(x[0])};
        }));
    CHECK_THROWS_AS((support::sized_runge_kutta<1, 2>(*f, enclosure_options{})),
                    std::invalid_argument);
    for (auto const& method : {rk4(), gauss4()}) {
        support::sized_runge_kutta<1, 2> run(*f, patient(method, 1e-6));
        run.begin(0, box{between(0.99, 1.01)}, box{});
        CHECK_THROWS_AS(run.step(0), std::invalid_argument);
        while (run.time() < 2 && run.step(2)) {
        }
        REQUIRE(run.failure());
        CHECK(run.time() < 1.011);
        CHECK(run.time() > 0.8);
        CHECK_FALSE(run.failure()->message("x").empty());
        CHECK_FALSE(run.step(3));
        run.begin(0, box{interval(0.5)}, box{}); // a new family
        CHECK(run.step(0.1));
        CHECK_THROWS_AS(run.begin(0, box{}, box{}), std::invalid_argument);
    }
    auto const bent =
        flow_of(model_of({1, 0, 0, 1e6}, [](auto const&, auto const& x, auto const&, auto const&) {
            using namespace support::real;
            return std::vector{-abs(x[0])};
        }));
    support::sized_runge_kutta<1, 2> run(*bent, patient(rk4(), 1e-3));
    run.begin(0, box{between(-1, 1)}, box{});
    CHECK_FALSE(run.step(1));
}
