// SPDX-License-Identifier: MIT
// Every motion under the recorded inputs is among those of the model with slower ones; what they
// leave is bounded, and tightly; models that do not fit are refused.
#include <sivid/model/change/detail/slower_inputs.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"

#include <sivid/approximate/simulate/approximate_program.hpp>
#include <sivid/enclosure/enclose.hpp>
#include <sivid/model/model.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::extended;
using support::extended_state;

namespace {

/// Functions of one input and of two, which drive two states with gains of a third and of
/// constants.
struct driven_craft {
    static constexpr auto name = "driven craft";
    static constexpr auto states =
        sivid::states({{"q", "rad", 20}, {"v", "rad/s", 50}, {"s", "m", 50}});
    static constexpr auto inputs = sivid::inputs({{"W", "1/s"}, {"delta", "rad"}, {"F", "N"}});
    static constexpr auto channels = sivid::channels({{"q", "rad"}, {"v", "rad/s"}, {"s", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"a", "1", 1_dec}, {"d", "1/s", 0.5_dec}});
    }();
    template <class T>
    vec<T, 3> rate(T const& t, vec<T, 3> const& x, vec<T, 2> const& c, vec<T, 3> const& u) const {
        using std::cos, std::sin;
        T const squared = u[0] * u[0];
        return {x[1], c[0] * cos(x[0]) * squared + (2 + sin(x[0])) * u[2] - c[1] * x[1] * x[1],
                c[0] * u[0] * u[1] - x[2] + sin(t)};
    }
    template <class T>
    vec<T, 3> observe(T const&, vec<T, 3> const& x, vec<T, 2> const&, vec<T, 3> const&) const {
        return {x[0], x[1], x[2] * x[0]};
    }
};

using shape = std::function<double(double)>;

sampled_signal logged(shape const& f, double period, double end, interpolation kind) {
    std::vector<double> times, values;
    for (double k = 0; k * period <= end; ++k) {
        times.push_back(k * period);
        values.push_back(f(k * period));
    }
    return {times, values, kind};
}

/// Within boxes of starts and parameters, or nearly known, so that only the inputs leave room.
identification_problem posed(std::vector<signal> inputs, double end, bool known = false) {
    identification_problem p{record_model(driven_craft()), {{"a", "d"}, {}}, {}, {}};
    p.prior = known ? box{interval(1), between(0.5, 0.5000001)}
                    : box{between(0.9, 1.1), between(0.4, 0.6)};
    experiment e{"E", std::move(inputs),
                 0,   box{known ? interval(0.125) : between(0.1, 0.15), interval(0.2), interval(0)},
                 {},  0};
    e.measurements.push_back({end, 0, between(-9, 9)});
    p.experiments.push_back(std::move(e));
    return p;
}

sampled_signal const& sampled(signal const& s) { return std::get<sampled_signal>(s); }

} // namespace

TEST_CASE("every motion under the recorded inputs is among those under slower ones") {
    draws d(5);
    double const end = 0.5;
    std::vector<double> noise(4000);
    for (auto& x : noise) x = d.uniform(-1, 1);
    auto const at = [&noise](double t, std::size_t shift) {
        return noise[(static_cast<std::size_t>(std::lround(t * 1000)) + shift) % noise.size()];
    };
    struct drive {
        std::string what;
        shape W, delta, F;
    };
    std::vector<drive> const drives{
        {"smooth", [](double t) { return 1 + 0.5 * std::sin(9 * t); },
         [](double t) { return std::cos(7 * t); }, [](double t) { return 2 * std::sin(11 * t); }},
        {"rough", [&](double t) { return 1 + 0.3 * at(t, 0); },
         [&](double t) { return at(t, 1300); }, [&](double t) { return at(t, 2600); }},
        {"jumps", [](double t) { return t < 0.213 ? 1.5 : 0.7; },
         [](double t) { return std::sin(40 * t) > 0 ? 1 : -1; },
         [](double t) { return t < 0.3105 ? -2 : 2; }}};
    for (auto const& each : drives) {
        for (auto const kind : {interpolation::hold, interpolation::linear}) {
            for (double const period : {0.01, 0.0173, -0.01}) {
                bool const known = period < 0;
                CAPTURE(each.what, static_cast<int>(kind), period);
                std::vector<sampled_signal> const inputs{
                    logged(each.W, 0.001, end, interpolation::hold),
                    logged(each.delta, 0.001, end, interpolation::hold),
                    logged(each.F, 0.001, end, kind)};
                auto const p = posed({inputs.begin(), inputs.end()}, end, known);
                auto const slow = with_slower_inputs(p, std::fabs(period));
                REQUIRE(slow);
                auto const& e = slow->experiments[0];
                CHECK(slow->model.about.inputs.size() == 6); // W^2, F, W delta
                for (auto const& u : e.inputs) CHECK(sampled(u).times().size() < 60);
                auto const f = std::make_shared<flow const>(slow->model, slow->choice, e.inputs);
                auto const motion = enclose(f, e.initial, slow->prior, 0, end,
                                            carried_set::taylor_model, {.tolerance = 1e-9});
                REQUIRE(motion.complete());
                // Rates are as smooth as lines: no step ends at a sample.
                CHECK(motion.spans().size() < 3 * sampled(e.inputs[0]).times().size());
                std::vector<double> times;
                for (double t = 0.0037; t < end; t += 0.0087) times.push_back(t);
                std::vector<box> seen;
                for (double const t : times) seen.push_back(motion.observe_at(t));
                driven_craft const craft;
                for (int sample = 0; sample < 6; ++sample) {
                    extended_state const c{known ? 1 : d.uniform(0.9, 1.1),
                                           known ? 0.5 : d.uniform(0.4, 0.6)};
                    extended_state const x0{known ? 0.125 : d.uniform(0.1, 0.15), 0.2, 0};
                    auto const states = support::reference_states(
                        [&](extended t, extended_state const& x, extended_state const& k,
                            extended_state const& u) {
                            auto const rate = craft.rate<extended>(
                                t, {x[0], x[1], x[2]}, {k[0], k[1]}, {u[0], u[1], u[2]});
                            return extended_state(rate.begin(), rate.end());
                        },
                        x0, c, 0, times, inputs);
                    for (std::size_t k = 0; k < times.size(); ++k) {
                        auto const& x = states[k];
                        extended_state const y{x[0], x[1], x[2] * x[0]};
                        for (std::size_t i = 0; i < y.size(); ++i) {
                            CAPTURE(times[k], i, static_cast<double>(y[i]));
                            REQUIRE(support::encloses_reference(seen[k][i], y[i]));
                        }
                    }
                }
            }
        }
    }
}

TEST_CASE("rates in the new states are those of the old ones, without what the integral carries") {
    double const end = 0.5;
    auto const u = logged([](double t) { return std::sin(t); }, 0.001, end, interpolation::hold);
    auto const five = logged([](double) { return 5; }, 0.001, end, interpolation::hold);
    auto const slow = with_slower_inputs(posed({u, u, five}, end), 0.02);
    REQUIRE(slow);
    // Of W^2 and F, compilers choose which one the model meets first.
    std::size_t const F = sampled(slow->experiments[0].inputs[0]).values()[3] > 4 ? 4 : 5,
                      W = 9 - F;
    auto outputs = slow->model.rate;
    outputs.insert(outputs.end(), slow->model.observe.begin(), slow->model.observe.end());
    approximate_program const program(slow->model.g, outputs, {3, 6, 2});
    draws d(4);
    for (int sample = 0; sample < 200; ++sample) {
        auto m = program.memory();
        for (std::size_t i = 0; i < 12; ++i) m[i] = d.uniform(-2, 2);
        double const t = m[0], q = m[1], s = m[3] + m[10] * m[9], a = m[10], damping = m[11];
        double const v = m[2] + a * std::cos(q) * m[W + 3] + (2 + std::sin(q)) * m[F + 3];
        program.prepare(m);
        program.run(m);
        auto const is = [&](std::size_t k, double x) {
            CAPTURE(k, x, m[program.output(k)]);
            CHECK(std::fabs(m[program.output(k)] - x) <= 1e-12 * (1 + std::fabs(x)));
        };
        is(0, v);
        is(1, a * std::cos(q) * m[W] + (2 + std::sin(q)) * m[F] - damping * v * v +
                  a * std::sin(q) * v * m[W + 3] - std::cos(q) * v * m[F + 3]);
        is(2, a * m[6] - s + std::sin(t));
        is(3, q);
        is(4, v);
        is(5, s * q);
    }
}

TEST_CASE("the integral of what lines leave is bounded in each period, and tightly") {
    draws d(8);
    double const end = 1;
    for (int round = 0; round < 6; ++round) {
        double const a = d.uniform(5, 15), b = d.uniform(0, 6);
        auto const kind = round % 2 == 0 ? interpolation::hold : interpolation::linear;
        auto const F = logged([&](double t) { return std::sin(a * t + b); }, 0.001, end, kind);
        auto const still = logged([](double) { return 1.0; }, 0.5, end, interpolation::hold);
        auto const p = posed({still, still, F}, end);
        auto const slow = with_slower_inputs(p, 0.01);
        REQUIRE(slow);
        REQUIRE(slow->model.about.inputs.size() == 4); // two that stay, line and integral of F
        auto const& e = slow->experiments[0];
        auto const &line = sampled(e.inputs[2]), &integral = sampled(e.inputs[3]);
        extended U = 0;
        std::vector<extended> largest(line.times().size(), 0);
        int const fine = 100000;
        for (int k = 0; k < fine; ++k) { // the middle rule, in parts of a held sample
            double const t = (k + 0.5) * end / fine;
            U += (static_cast<extended>(F.approximate(t)) - line.approximate(t)) * end / fine;
            auto& most = largest[line.piece(t)];
            most = std::max(most, std::fabs(U));
        }
        double worst = 0;
        for (std::size_t k = 0; k + 1 < line.times().size(); ++k) {
            CAPTURE(round, k);
            auto const bound = static_cast<extended>(integral.errors()[k]);
            REQUIRE(bound >= largest[k] * (1 - 1e-6L) - 1e-12L);
            REQUIRE(bound <= largest[k] * 1.1L + 1e-8L);
            worst = std::max(worst, integral.errors()[k]);
        }
        // The sawtooth of held samples, the bend within a period, and extrapolation at both ends.
        CHECK(worst < (kind == interpolation::hold ? 3e-5 : 2e-5));
        auto const middle = integral.errors()[50];
        CHECK(middle < (kind == interpolation::hold ? a * 0.001 * 0.001 / 8 + 1e-6 * a : 1e-6 * a));
    }
}

namespace {

template <int What>
struct refused {
    static constexpr auto name = "refused";
    static constexpr auto states = sivid::states({{"x", "m", 5}, {"v", "m/s", 5}});
    static constexpr auto inputs = sivid::inputs({{"u", "N"}});
    static constexpr auto channels = sivid::channels({{"y", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"c", "N", 0.5_dec}});
    }();
    template <class T>
    vec<T, 2> rate(T const& t, vec<T, 2> const& x, vec<T, 1> const& c, vec<T, 1> const& u) const {
        using std::sin, std::abs;
        switch (What) {
        case 0:
            return {x[1], sin(c[0] * u[0])}; // not affine
        case 1:
            return {x[1], x[1] * u[0] - c[0]}; // the gain is driven itself
        case 2:
            return {x[1], sin(t) * u[0] - c[0]}; // the gain moves by itself
        case 3:
            return {x[1], u[0] * u[0] * x[0] + abs(u[0] + x[0])};
        case 6:
            return {x[1], abs(c[0] * u[0])}; // of both signs of the input
        case 7:
            return {x[1], min(c[0] * u[0], T(1)) + u[0]}; // an actuator that saturates
        case 8:
            return {x[1], sign(c[0] * u[0]) + u[0]};
        default:
            return {x[1], u[0] - c[0] * x[1]};
        }
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 2> const& x, vec<T, 1> const&, vec<T, 1> const& u) const {
        return {What == 4 ? x[0] + u[0] : x[0]};
    }
};

template <int What>
identification_problem asked(signal const& u) {
    identification_problem p{record_model(refused<What>()), {{"c"}, {}}, box{between(0, 1)}, {}};
    experiment e{"E", {u}, 0, box(2), {}, 0};
    e.measurements.push_back({1, 0, between(-9, 9)});
    p.experiments.push_back(std::move(e));
    return p;
}

} // namespace

TEST_CASE("what is not affine in fast exact inputs stays as it is") {
    auto const wave = [](double t) { return std::sin(t); };
    auto const fast = logged(wave, 0.001, 1, interpolation::hold);
    CHECK(with_slower_inputs(asked<5>(fast), 0.02));
    CHECK_FALSE(with_slower_inputs(asked<0>(fast), 0.02));
    CHECK_FALSE(with_slower_inputs(asked<1>(fast), 0.02));
    CHECK_FALSE(with_slower_inputs(asked<2>(fast), 0.02));
    CHECK_FALSE(with_slower_inputs(asked<3>(fast), 0.02));
    CHECK_FALSE(with_slower_inputs(asked<4>(fast), 0.02));
    // Affine on either side of a kink, or without a slope beside a jump, is not affine.
    CHECK_FALSE(with_slower_inputs(asked<6>(fast), 0.02));
    CHECK_FALSE(with_slower_inputs(asked<7>(fast), 0.02));
    CHECK_FALSE(with_slower_inputs(asked<8>(fast), 0.02));
    CHECK_FALSE(with_slower_inputs(asked<5>(fast), 0.002)); // not slower
    CHECK_FALSE(with_slower_inputs(asked<5>(logged(wave, 0.1, 1, interpolation::hold)), 0.02));
    sampled_signal const unsure(fast.times(), fast.values(), interpolation::hold,
                                std::vector<double>(fast.times().size(), 0.01));
    CHECK_FALSE(with_slower_inputs(asked<5>(unsure), 0.02));
    CHECK_FALSE(with_slower_inputs(
        asked<5>(analytic_signal::from([](auto const& t) { return sin(t); })), 0.02));
    // A square of lines is no line.
    CHECK_FALSE(with_slower_inputs(asked<3>(logged(wave, 0.001, 1, interpolation::linear)), 0.02));
    // Beyond the largest double.
    auto const huge = logged([](double) { return 1e200; }, 0.001, 1, interpolation::hold);
    CHECK_FALSE(with_slower_inputs(posed({huge, huge, huge}, 1), 0.02));
    auto const swinging =
        logged([](double t) { return std::fmod(t, 0.002) < 0.001 ? 1e308 : -1e308; }, 0.001, 1,
               interpolation::linear);
    CHECK_FALSE(with_slower_inputs(asked<5>(swinging), 0.02));
    auto delayed = asked<5>(fast);
    delayed.model.input_memory.push_back({0, 0});
    CHECK_FALSE(with_slower_inputs(delayed, 0.02));
    CHECK_THROWS_AS(with_slower_inputs(asked<5>(fast), 0), std::invalid_argument);
    CHECK_THROWS_AS(with_slower_inputs(asked<5>(fast), HUGE_VAL), std::invalid_argument);
}
