// SPDX-License-Identifier: MIT
// The reference example: facts of the scenarios, widths as a point problem, random parameters and
// times.
#include "support/catch.hpp"
#include "support/flow_simulation.hpp"
#include "support/models.hpp"
#include "support/parametric_sets.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"

#include "../../examples/hovercraft/model.hpp"

#include <sivid/enclosure/taylor/parametric_flow.hpp>
#include <sivid/enclosure/methods.hpp>
#include <sivid/enclosure/tube.hpp>

#include <cmath>
#include <numbers>

using namespace sivid;
using support::between;
using support::draws;
using support::extended;
using support::extended_state;

namespace {

/// Extended precision with the functions that the model's functor looks up by its argument.
struct wide {
    extended v = 0;
    wide() = default;
    wide(extended x) : v(x) {}
    wide(int x) : v(x) {}
    friend wide operator+(wide a, wide b) { return a.v + b.v; }
    friend wide operator-(wide a, wide b) { return a.v - b.v; }
    friend wide operator*(wide a, wide b) { return a.v * b.v; }
    friend wide operator/(wide a, wide b) { return a.v / b.v; }
    friend wide operator-(wide a) { return -a.v; }
    friend wide sqr(wide a) { return a.v * a.v; }
    friend wide sqrt(wide a) { return std::sqrt(a.v); }
    friend wide sin(wide a) { return std::sin(a.v); }
    friend wide cos(wide a) { return std::cos(a.v); }
    friend wide pown(wide a, int n) {
        extended y = 1;
        for (int i = 0; i < n; ++i) y *= a.v;
        return y;
    }
};

struct scenario {
    extended W;        // rotor speed
    bool rudder_moves; // pi/12 (1 + sin(pi t/2)), or 0
    double speed;      // u at the start
    double end;
};
constexpr scenario scenarios[] = {
    {250.0L, false, 0.1, 1}, {0.0L, false, 2, 10}, {250.0L / 3, true, 2, 3}};

auto reference_rate(scenario const& s, hovercraft const& model = {}) {
    return [s, model](extended t, extended_state const& x, extended_state const& p, auto const&) {
        constants_of<hovercraft, wide> c{1.297L, 0.058L,  1.225L, 0.6L, 1.891L,    0.1339L,
                                         0.18L,  0.1276L, p[0],   p[1], 0.025447L, p[2],
                                         0.5L,   0.05L,   0.0L,   0.2L, 0.1L};
        states_of<hovercraft, wide> state;
        for (std::size_t i = 0; i < 6; ++i) state[i] = x[i];
        extended const pi = std::numbers::pi_v<extended>;
        extended const delta = s.rudder_moves ? pi / 12 * (1 + std::sin(pi * t / 2)) : 0;
        auto const f = model.rate(wide(t), state, c, {wide(s.W), wide(delta)});
        extended_state result;
        for (auto const& v : f) result.push_back(v.v);
        return result;
    };
}

std::vector<sivid::signal> inputs_of(scenario const& s) {
    expression const rotor =
        s.rudder_moves ? expression(250) / 3 : expression(static_cast<double>(s.W));
    expression const pi(between(0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1));
    auto const steady = analytic_signal::from([&](auto const&) { return rotor; });
    auto const turning = analytic_signal::from([&](auto const& t) {
        return s.rudder_moves ? pi / 12 * (1 + sin(pi * t / 2)) : expression(0.0);
    });
    return {steady, turning};
}
std::shared_ptr<flow const> flow_of(scenario const& s, hovercraft const& model = {}) {
    return std::make_shared<flow const>(record_model(model),
                                        parameter_choice{{"Sv", "Sg", "L"}, {}}, inputs_of(s));
}
box start_of(scenario const& s) {
    box x(6);
    x[0] = interval(s.speed);
    if (s.speed == 0.1) { // one tenth, not the double next to it
        x[0] = between(0x1.9999999999999p-4, 0x1.999999999999ap-4);
    }
    return x;
}
box truth() {
    return {between(std::nextafter(0.22, 0), std::nextafter(0.22, 1)),
            between(std::nextafter(0.04, 0), std::nextafter(0.04, 1)),
            between(std::nextafter(0.30, 0), std::nextafter(0.30, 1))};
}
extended_state const exact_truth{0.22L, 0.04L, 0.30L};
extended_state exact_start(scenario const& s) {
    return {s.speed == 0.1 ? 0.1L : static_cast<extended>(s.speed), 0, 0, 0, 0, 0};
}

} // namespace

TEST_CASE("the scenarios end where the reference page says") {
    double const ends[3][6] = {{7.311, 0, 0, 3.872, 0, 0},
                               {0, 0, 0, 4.420, 0, 0},
                               {-1.184, 1.463, -0.315, 7.717, 1.581, -2.356}};
    for (std::size_t k = 0; k < 3; ++k) {
        auto const& s = scenarios[k];
        auto const x =
            support::reference_states(reference_rate(s), exact_start(s), exact_truth, 0, {s.end});
        auto const f = flow_of(s);
        support::flow_simulation simulate(*f);
        auto const y = simulate({s.speed, 0, 0, 0, 0, 0}, {0.22, 0.04, 0.30}, 0, {s.end});
        for (std::size_t i = 0; i < 6; ++i) {
            CAPTURE(k, i);
            CHECK(std::fabs(x[0][i] - ends[k][i]) < 6e-4L);
            CHECK(std::abs(y.states[0][i] - ends[k][i]) < 6e-4);
        }
    }
}

TEST_CASE("scenario 3 as a point: below 1e-8 by Taylor, below 1e-6 by Runge-Kutta") {
    auto const& s = scenarios[2];
    auto const f = flow_of(s);
    auto const x =
        support::reference_states(reference_rate(s), exact_start(s), exact_truth, 0, {3});
    auto const taylor = integrate<interval>(f, start_of(s), truth(), 0, 3);
    REQUIRE(taylor.complete());
    CHECK(width(taylor.at(3)) < 1e-8);
    enclosure_options options;
    options.method = rk4();
    options.tolerance = 1e-10;
    auto const kutta = integrate<interval>(f, start_of(s), truth(), 0, 3, options);
    REQUIRE(kutta.complete());
    CHECK(width(kutta.at(3)) < 1e-6);
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(support::encloses_reference(taylor.at(3)[i], x[0][i], 1e-13));
        CHECK(support::encloses_reference(kutta.at(3)[i], x[0][i], 1e-13));
    }
}

TEST_CASE("all scenarios at all times, with both readings of the misprints") {
    draws d(291);
    for (auto const& s : scenarios) {
        for (bool const literal : {false, true}) {
            hovercraft model;
            if (literal) {
                model.lift = hovercraft::lift_area::rudder;
                model.friction = hovercraft::friction_law::as_printed;
            }
            auto const tube =
                integrate<interval>(flow_of(s, model), start_of(s), truth(), 0, s.end);
            REQUIRE(tube.complete());
            std::vector<double> times;
            for (int k = 0; k < 40; ++k) times.push_back(d.uniform(0, s.end));
            std::sort(times.begin(), times.end());
            auto const x = support::reference_states(reference_rate(s, model), exact_start(s),
                                                     exact_truth, 0, times);
            auto const over = tube.over(times[5], times[30]);
            for (std::size_t k = 0; k < times.size(); ++k) {
                auto const at = tube.at(times[k]);
                for (std::size_t i = 0; i < 6; ++i) {
                    CAPTURE(s.end, literal, times[k], i);
                    CHECK(support::encloses_reference(at[i], x[k][i], 1e-13));
                    if (k >= 5 && k <= 30)
                        CHECK(support::encloses_reference(over[i], x[k][i], 1e-13));
                }
            }
        }
    }
}

TEST_CASE("1000 random parameters and times of scenario 3 are contained") {
    draws d(292);
    auto const& s = scenarios[2];
    auto const f = flow_of(s);
    // 20 small boxes anywhere in the prior, 50 members each.
    box const prior{between(0.2, 0.25), between(0.0042, 0.0754), between(0.25, 0.35)};
    int contained = 0;
    for (int b = 0; b < 20; ++b) {
        auto const centre = d.in(prior);
        box p(3);
        for (std::size_t j = 0; j < 3; ++j) p[j] = support::around(centre[j], 0.002 * centre[j]);
        auto const tube = integrate<interval>(f, start_of(s), p, 0, 3);
        REQUIRE(tube.end_time() > 0.5);
        for (int member = 0; member < 50; ++member) {
            auto const q = d.in(p);
            double const t = d.uniform(0, tube.end_time());
            auto const x = support::reference_states(reference_rate(s), exact_start(s),
                                                     support::extend(q), 0, {t}, {}, 1e-15L);
            auto const at = tube.at(t);
            bool all = true;
            for (std::size_t i = 0; i < 6; ++i) {
                all = all && support::encloses_reference(at[i], x[0][i], 1e-12);
            }
            CHECK(all);
            contained += all ? 1 : 0;
        }
    }
    CHECK(contained == 1000);
}

TEST_CASE("parameter boxes stay within twice the true range") {
    auto const& s = scenarios[2];
    auto const f = flow_of(s);
    for (auto const& [width_of_box, factor] : {std::pair{0.001, 1.25}, std::pair{0.01, 2.0}}) {
        double const relative = width_of_box; // clang 14 captures no structured bindings
        box p(3);
        for (std::size_t j = 0; j < 3; ++j) {
            double const c = static_cast<double>(exact_truth[j]);
            p[j] = support::around(c, 0.5 * relative * c);
        }
        // First-order sets for the narrow box, Taylor models in the parameters for the wider one.
        auto const states = [&] {
            if (relative < 0.005) return integrate<interval>(f, start_of(s), p, 0, 3).at(3);
            support::sized_flow<3, 3> run(*f, {.order = 12, .tolerance = 1e-9});
            run.begin(0, start_of(s), p);
            while (run.time() < 3) REQUIRE(run.step(3));
            return run.set().hull();
        }();
        box seen(6);
        for (int corner = 0; corner < 27; ++corner) {
            extended_state q;
            for (int j = 0, c = corner; j < 3; ++j, c /= 3) {
                auto const& side = p[static_cast<std::size_t>(j)];
                q.push_back(c % 3 == 0 ? side.lower() : c % 3 == 1 ? side.upper() : mid(side));
            }
            auto const x =
                support::reference_states(reference_rate(s), exact_start(s), q, 0, {3}, {}, 1e-14L);
            for (std::size_t i = 0; i < 6; ++i) {
                interval const v(static_cast<double>(x[0][i]));
                seen[i] = corner == 0 ? v : hull(seen[i], v);
            }
        }
        for (std::size_t i = 0; i < 6; ++i) {
            CAPTURE(relative, i, width(states[i]), width(seen[i]));
            CHECK(width(states[i]) <= factor * width(seen[i]));
        }
    }
}
