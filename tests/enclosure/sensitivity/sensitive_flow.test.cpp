// SPDX-License-Identifier: MIT
// Certified sensitivities as polynomials in the unknowns: at each q, against closed forms and the
// variational equation in extended precision.
#include <sivid/enclosure/sensitivity/sensitive_flow.hpp>

#include "../../../examples/hovercraft/model.hpp"
#include "support/catch.hpp"
#include "support/parametric_sets.hpp"
#include "support/systems.hpp"
#include "support/variational_reference.hpp"

#include <cmath>

using namespace sivid;
using support::between;
using support::draws;
using support::extended;
using support::extended_state;
using support::part_of;

namespace {

/// x within p(q) plus or minus the radius.
bool encloses_at(taylor_model<double> const& m, std::vector<double> const& q, extended x,
                 extended slack) {
    extended const off = std::fabs(x - support::value<extended>(m, q));
    return off <= static_cast<extended>(m.r()) + slack * (1 + std::fabs(x));
}

/// Steps to random times up to the horizon; every member's sensitivities at every one of them.
template <std::size_t D, class System>
std::size_t check(System const& system, enclosure_options const& options, draws& d, int members,
                  extended error, bool kinks = false) {
    auto const f = system.flow();
    sensitive_flow<> run(*f, options, 4, D);
    run.begin(0, system.initial, system.parameters);
    std::vector<double> times{system.horizon};
    for (int k = 0; k < 3; ++k) times.push_back(d.uniform(0, system.horizon));
    std::sort(times.begin(), times.end());
    struct member {
        std::vector<double> q;
        std::vector<support::reference_sensitivity> exact;
    };
    std::vector<member> all(static_cast<std::size_t>(members));
    for (auto& m : all) {
        m.q = support::short_point(d, 4);
        m.exact = support::reference_sensitivities(
            system.rate, support::at(run.states().unknowns().initial, m.q),
            support::at(run.states().unknowns().parameters, m.q), 0, times, system.inputs,
            error * 1e-3L, kinks);
    }
    std::size_t compared = 0;
    for (std::size_t k = 0; k < times.size(); ++k) {
        while (run.time() < times[k]) {
            if (!run.step(times[k])) return compared;
        }
        if (!run.known()) return compared;
        auto const outputs = run.output_derivatives();
        for (auto const& m : all) {
            for (std::size_t i = 0; i < f->states(); ++i) {
                for (std::size_t c = 0; c < run.columns(); ++c) {
                    auto const& exact = m.exact[k].s[i][c];
                    auto const found = run.derivative(i, c);
                    CAPTURE(system.name, D, options.order, times[k], i, c,
                            static_cast<double>(exact), found.r());
                    REQUIRE(encloses_at(found, m.q, exact, error));
                    // Every state is a channel.
                    REQUIRE(encloses_at(outputs[i * run.columns() + c], m.q, exact, error));
                    ++compared;
                }
            }
        }
    }
    return compared;
}

template <std::size_t D>
void sweep(std::uint64_t seed, enclosure_options const& options, double share, int members,
           std::size_t enough) {
    draws d(seed);
    std::size_t compared = 0;
    support::for_each_smooth_system([&](auto system) {
        system.initial = part_of(d, system.initial, share);
        system.parameters = part_of(d, system.parameters, share);
        compared += check<D>(system, options, d, members, 1e-13L);
    });
    CHECK(compared > enough);
}

enclosure_options sharp(std::size_t order, double tolerance) {
    enclosure_options o;
    o.order = order;
    o.tolerance = tolerance;
    o.relative_tolerance = tolerance > 1e-10 ? 1e-4 : 0;
    o.minimum_step = 1e-4;
    return o;
}

} // namespace

TEST_CASE("growth by its closed form, over a wide box") {
    // x' = p x: dx/dx0 = e^(pt), dx/dp = x0 t e^(pt).
    auto const f = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[0]};
        }));
    box const x0{between(0.5, 1.5)}, p{between(0.5, 1)};
    std::optional<enclosure_failure> failure;
    auto const found = sensitivities_at(*f, sharp(10, 1e-8), x0, p, 0, {0.5, 1.0, 2.0}, &failure);
    REQUIRE_FALSE(failure);
    REQUIRE(found.size() == 3);
    for (auto const& at : found) {
        auto const t = static_cast<extended>(at.time);
        for (extended const a : {-1.0L, -0.3L, 0.0L, 0.7L, 1.0L}) {
            for (extended const b : {-1.0L, 0.4L, 1.0L}) {
                extended const e = std::exp((0.75L + 0.25L * a) * t); // parameters come first
                std::vector<double> const q{static_cast<double>(a), static_cast<double>(b)};
                extended const start = 1 + 0.5L * static_cast<extended>(q[1]);
                CHECK(encloses_at(at.derivatives[0], q,
                                  std::exp((0.75L + 0.25L * static_cast<extended>(q[0])) * t),
                                  1e-17L));
                CHECK(encloses_at(at.derivatives[1], q,
                                  start * t *
                                      std::exp((0.75L + 0.25L * static_cast<extended>(q[0])) * t),
                                  1e-17L));
                CHECK(encloses_at(
                    at.outputs[0], q,
                    start * std::exp((0.75L + 0.25L * static_cast<extended>(q[0])) * t), 1e-17L));
                CHECK(e > 0);
            }
        }
        // The ranges over the box, at most 2 % too wide.
        extended const low = std::exp(0.5L * t), high = std::exp(t);
        auto const s = at.over_box(0, 0);
        CHECK(s.lower() <= low);
        CHECK(s.upper() >= high);
        CHECK(width(s) < 1.02 * static_cast<double>(high - low));
        auto const r = at.over_box(0, 1);
        extended const span = t * (1.5L * high - 0.5L * low);
        CHECK(r.lower() <= 0.5L * t * low);
        CHECK(r.upper() >= 1.5L * t * high);
        CHECK(width(r) < 1.02 * static_cast<double>(span));
    }
}

TEST_CASE("points: thin, and equal to the variational equation's solution") {
    draws d(311);
    support::for_each_smooth_system([&](auto system) {
        system.initial = point_box(d.in(system.initial));
        system.parameters = point_box(d.in(system.parameters));
        auto const f = system.flow();
        sensitive_flow<> run(*f, sharp(16, 1e-14), 1, 0);
        run.begin(0, system.initial, system.parameters);
        while (run.time() < system.horizon) REQUIRE(run.step(system.horizon));
        REQUIRE(run.known());
        auto const exact = support::reference_sensitivities(
            system.rate, support::extend(mid(system.initial)),
            support::extend(mid(system.parameters)), 0, {system.horizon}, system.inputs, 1e-17L);
        CAPTURE(system.name);
        for (std::size_t i = 0; i < f->states(); ++i) {
            for (std::size_t c = 0; c < run.columns(); ++c) {
                auto const s = run.derivative(i, c);
                CHECK(encloses_at(s, {0.0}, exact[0].s[i][c], 1e-14L));
                CHECK(s.r() <= 1e-9 * (1 + std::abs(s.c(0))));
            }
        }
    });
}

TEST_CASE("boxes: each member's sensitivities, degrees 1 to 4") {
    sweep<1>(312, sharp(10, 1e-7), 0.3, 3, 500);
    sweep<2>(313, sharp(10, 1e-7), 0.6, 3, 500);
    sweep<4>(314, sharp(12, 1e-8), 0.6, 2, 300);
}

TEST_CASE("low orders, whose Lagrange terms matter") {
    for (std::size_t const order : {1u, 2u, 3u, 4u}) {
        auto o = sharp(order, 1e-3);
        o.relative_tolerance = 1e-2;
        o.widest = o.remainder_share = 1e3;
        sweep<1>(320 + order, o, 0.05, 3, 20);
        sweep<2>(330 + order, o, 0.05, 3, 20);
    }
}

TEST_CASE("the Lagrange term of the derivatives keeps its factor V") {
    // x' = x, first order, steps of 0.375: without V the step gives 1.375 < e^0.375.
    auto const f =
        support::flow_of(support::model_of({1, 0}, [](auto const&, auto const& x, auto const&,
                                                      auto const&) { return std::vector{x[0]}; }));
    enclosure_options o;
    o.order = 1;
    o.tolerance = 10;
    o.minimum_step = 0.375;
    o.maximum_step = 0.375;
    o.widest = o.remainder_share = 1e6;
    sensitive_flow<> run(*f, o, 1, 1);
    run.begin(0, box{interval(0.001)}, box{});
    REQUIRE(run.step(0.375));
    REQUIRE(run.time() == 0.375);
    REQUIRE(run.known());
    auto const s = range(run.derivative(0, 0));
    CHECK(s.upper() >= std::exp(0.375));
    CHECK(s.lower() <= std::exp(0.375));
}

TEST_CASE("what low orders leave out, by closed forms, in single long steps") {
    // By the parameter alone, x' = p e^t: all but h of dx/dp = e^h - 1 is the rest of
    // \f$ \partial_p f \f$ at L = 2. And x' = p x^2: dx/dx0 = 1/d^2, dx/dp = h/d^2 at x0 = p = 1.
    auto const direct = support::flow_of(
        support::model_of({1, 1}, [](auto const& t, auto const&, auto const& p, auto const&) {
            return std::vector{p[0] * exp(t)};
        }));
    auto const growing = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * sqr(x[0])};
        }));
    for (std::size_t const order : {2u, 3u, 4u, 6u}) {
        for (double const h : {0.0625, 0.125, 0.25}) {
            enclosure_options o;
            o.order = order;
            o.tolerance = 10;
            o.maximum_step = o.minimum_step = h;
            o.widest = o.remainder_share = 1e6;
            CAPTURE(order, h);
            sensitive_flow<> first(*direct, o, 1, 0), second(*growing, o, 1, 0);
            for (auto* const run : {&first, &second}) {
                run->begin(0, box{interval(1.0)}, box{interval(1.0)});
                REQUIRE(run->step(h));
                REQUIRE(run->time() == h);
                REQUIRE(run->known());
            }
            auto const e = static_cast<extended>(h), d = 1 - e;
            CHECK(encloses_at(first.derivative(0, 0), {0.0}, 1, 0));
            CHECK(encloses_at(first.derivative(0, 1), {0.0}, std::expm1(e), 0));
            CHECK(encloses_at(second.derivative(0, 0), {0.0}, 1 / (d * d), 0));
            CHECK(encloses_at(second.derivative(0, 1), {0.0}, e / (d * d), 0));
            // The bounds are near what is left out: at order 6 and h = 1/16 about 1e-6.
            if (order == 6 && h == 0.0625) CHECK(second.derivative(0, 1).r() < 1e-5);
        }
    }
}

TEST_CASE("kinks, sampled inputs and jumps") {
    draws d(340);
    std::size_t compared = 0;
    support::for_each_rough_system([&](auto system) {
        system.initial = part_of(d, system.initial, 0.3);
        system.parameters = part_of(d, system.parameters, 0.3);
        compared += check<2>(system, sharp(8, 1e-7), d, 3, 1e-8L, true);
    });
    CHECK(compared > 50);
    auto const f = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{-(p[0] * sign(x[0]))};
        }));
    sensitive_flow<> run(*f, sharp(4, 1e-4), 1, 1);
    run.begin(0, box{interval(0.5)}, box{interval(1.0)});
    while (run.time() < 0.25) REQUIRE(run.step(0.25));
    REQUIRE(run.known());
    CHECK(support::encloses_reference(range(run.derivative(0, 1)), -0.25L));
    while (run.time() < 0.75 && run.step(0.75)) {
    }
    REQUIRE(run.time() == 0.75);
    CHECK_FALSE(run.known());
    CHECK(std::isinf(run.derivative(0, 0).r()));
    CHECK(std::isinf(run.output_derivatives()[0].r()));
}

TEST_CASE("a sign of parameters alone jumps, too, though never in time") {
    auto const f = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{sign(p[0]) - 0.1 * x[0]};
        }));
    // x(1) differs by about 2 from p = -1 to p = 1: no bound on dx/dp but infinity holds.
    auto const across = sensitivities_at(*f, {}, box{interval(1.0)}, box{between(-1, 1)}, 0, {1.0});
    REQUIRE(across.size() == 1);
    CHECK(width(range(across[0].outputs[0])) > 1.8);
    CHECK(std::isinf(across[0].derivatives[1].r()));
    auto const beside =
        sensitivities_at(*f, {}, box{interval(1.0)}, box{between(0.5, 1)}, 0, {1.0});
    REQUIRE(beside.size() == 1);
    CHECK(mag(beside[0].over_box(0, 1)) < 1e-9);
}

TEST_CASE("the hovercraft's outputs by its parameters, over a box") {
    std::vector<signal> const inputs{
        analytic_signal::from([](auto const&) { return 250 / expression(3); }),
        analytic_signal::from([](auto const& t) { return 0.25 * (1 + sin(1.5 * t)); })};
    flow const f(record_model(hovercraft{}), parameter_choice{{"Sv", "Sg", "L"}, {}}, inputs);
    box const p{between(0.215, 0.225), between(0.039, 0.041), between(0.295, 0.305)};
    auto const found =
        sensitivities_at(f, sharp(8, 1e-6), point_box({2, 0, 0, 0, 0, 0}), p, 0, {1.0, 2.0});
    REQUIRE(found.size() == 2);
    auto const rate = [](auto const& t, auto const& x, auto const& c, auto const&) {
        using value = typename std::decay_t<decltype(x)>::value_type;
        auto const k = [](double v) { return value(static_cast<extended>(v)); };
        // The constants as the model's decimals, in extended precision.
        extended const rho = 1.225L, cd = 0.6L, cl = 1.891L, area = 0.025447L, mass = 1.297L;
        extended const w = 250.0L / 3;
        extended const thrust = 0.1339L * rho * 0.18L * 0.18L * 0.18L * 0.18L * w * w;
        auto const delta = k(0.25) * (1 + sin(k(1.5) * t));
        auto const side = value(cl * thrust / (4 * area)) * delta;
        auto const speed = sqrt(sqr(x[0]) + sqr(x[1]) + value(0.0025L));
        auto const drag = value(rho * cd / 2) * speed;
        auto const dry = value(0.5L) / speed;
        auto const surge = value(thrust) - dry * x[0] - value(0.1276L) * drag * x[0];
        auto const sway = c[0] * side - dry * x[1] - c[0] * drag * x[1] - value(0.2L) * x[1];
        auto const yaw = -(c[2] * c[1] * side) - value(0.1L) * x[2];
        return std::vector<value>{x[1] * x[2] + surge / value(mass),
                                  sway / value(mass) - x[0] * x[2],
                                  yaw / value(0.058L),
                                  x[0] * cos(x[5]) - x[1] * sin(x[5]),
                                  x[0] * sin(x[5]) + x[1] * cos(x[5]),
                                  x[2]};
    };
    draws d(350);
    normalised_unknowns const sides(point_box({2, 0, 0, 0, 0, 0}), p);
    for (int round = 0; round < 6; ++round) {
        auto const q = support::short_point(d, 3);
        auto const exact = support::reference_sensitivities(
            rate, {2, 0, 0, 0, 0, 0}, support::at(sides.parameters, q), 0, {1.0, 2.0}, {}, 1e-16L);
        for (std::size_t k = 0; k < 2; ++k) {
            for (std::size_t y = 0; y < 6; ++y) {
                for (std::size_t c = 0; c < 9; ++c) {
                    CAPTURE(k, y, c);
                    REQUIRE(
                        encloses_at(found[k].derivatives[y * 9 + c], q, exact[k].s[y][c], 1e-13L));
                }
            }
        }
    }
    CHECK(width(found[1].over_box(0, 6)) > 0);
    CHECK(width(found[1].over_box(0, 6)) < 10);
}

TEST_CASE("outputs by states, parameters and inputs") {
    // y0 = p x^2, y1 = |x - 1| + u, y2 = 1/(x - 2)
    auto const m = support::model_of(
        {1, 1, 1},
        [](auto const&, auto const& x, auto const&, auto const&) { return std::vector{x[0]}; },
        [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{p[0] * sqr(x[0]), abs(x[0] - 1) + u[0], 1 / (x[0] - 2)};
        });
    auto const f = support::flow_of(m, {sampled_signal({0, 2}, {0, 3}, interpolation::linear)});
    auto const found = sensitivities_at(*f, sharp(12, 1e-13), box{between(0.5, 0.625)},
                                        box{interval(3.0)}, 0, {0.6, 1.0});
    REQUIRE(found.size() == 2);
    auto const y = [&](std::size_t k, std::size_t c) { return found[1].over_box(k, c); };
    extended const e = std::exp(1.0L);
    for (extended const x0 : {0.5L, 0.6L, 0.625L}) {
        CHECK(support::encloses_reference(y(0, 0), 6 * x0 * e * e));
        CHECK(support::encloses_reference(y(0, 1), x0 * x0 * e * e));
        CHECK(support::encloses_reference(y(1, 0), e));
        CHECK(support::encloses_reference(y(2, 0), -e / ((x0 * e - 2) * (x0 * e - 2))));
    }
    CHECK(width(y(1, 0)) < 1e-9);
    CHECK(mag(y(1, 1)) < 1e-200); // nothing but bounds of underflows
    // x = 1 within the set: Clarke's derivative of the kink; x = 2 outside it.
    auto const kink = found[0].over_box(1, 0);
    CHECK(kink.lower() <= -std::exp(0.6));
    CHECK(kink.upper() >= std::exp(0.6));
}

TEST_CASE("a failure on the way is handed over with what was reached") {
    auto const f = support::flow_of(
        support::model_of({1, 0, 0, 1e6}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{sqr(x[0])};
        }));
    std::optional<enclosure_failure> failure;
    auto const found = sensitivities_at(*f, sharp(14, 1e-12), box{interval(1.0)}, box{}, 0,
                                        {0.25, 0.5, 1.5}, &failure);
    CHECK(found.size() == 2);
    REQUIRE(failure);
    CHECK(failure->time < 1);
    CHECK_THROWS_AS((sensitivities_at(*f, {}, box{interval(1.0)}, box{}, 0, {0.5, 0.25})),
                    std::invalid_argument);
}
