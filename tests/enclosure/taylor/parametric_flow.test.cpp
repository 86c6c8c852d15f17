// SPDX-License-Identifier: MIT
// The pieces of a step, apart: the remainder alone, the Lagrange terms at the lowest orders, kinks
// and jumps. That whole trajectories are contained at the orders of everyday use is tested with the
// kernels of `experiment_run.test.cpp`.
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/parametric_sets.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"
#include "support/taylor_models.hpp"

#include <sivid/enclosure/taylor/parametric_flow.hpp>
#include <sivid/number/decimal.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
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

using exact_solution = std::function<extended_state(extended t, std::vector<extended> const& x0,
                                                    std::vector<extended> const& p)>;

/// The set and the tube of one lane after a step against an exact solution.
template <class Flow>
void check_step(Flow const& run, std::size_t lane, double from, draws& d, int samples,
                exact_solution const& exact, extended slack) {
    auto const set = lane_of(run.set(), lane);
    auto const swept = run.swept(lane);
    auto const hull = run.set().hull(lane);
    for (int sample = 0; sample < samples; ++sample) {
        auto const q = support::short_point(d, run.shape().variables);
        auto const start = at(run.unknowns(lane).initial, q);
        auto const parameters = at(run.unknowns(lane).parameters, q);
        auto const x = exact(set.time, start, parameters);
        CAPTURE(set.time, sample, lane);
        REQUIRE(encloses_at(set, q, x, slack));
        auto const within = static_cast<extended>(std::clamp(d.uniform(-0.1, 1.1), 0.0, 1.0));
        auto const between_steps =
            exact(from + within * (static_cast<extended>(set.time) - from), start, parameters);
        for (std::size_t i = 0; i < x.size(); ++i) {
            REQUIRE(support::encloses_reference(hull[i], x[i], 1e-16));
            REQUIRE(support::encloses_reference(swept[i], between_steps[i], 1e-16));
        }
    }
}

box part_of(box const& whole, draws& d) {
    box part = whole;
    for (std::size_t i = 0; i < part.size(); ++i) {
        auto const& side = whole[i];
        if (width(side) == 0) continue;
        double const a = d.uniform(lower(side), upper(side));
        double const b = d.coin() ? upper(side) : d.uniform(lower(side), upper(side));
        part[i] = interval(std::min(a, b), std::max(a, b));
    }
    return part;
}

/// Ten parts of the boxes in eight lanes, begun one after the other, two of them in a lane that has
/// become free: each at its own time with its own steps.
template <std::size_t N, std::size_t D>
void check_lanes(flow const& f, enclosure_options const& options, box const& x0, box const& p,
                 double end, exact_solution const& exact, std::uint64_t seed, extended slack) {
    using C = lanes<8>;
    draws d(seed + 77);
    parametric_flow<taylor_model<C>> run(f, options, N, D);
    std::size_t begun = 0;
    std::size_t finished = 0;
    while (finished < 10) {
        for (std::size_t l = 0; l < 8; ++l) {
            if (run.running()[l] && !(run.time(l) < end)) {
                run.end(l);
                ++finished;
            }
            REQUIRE_FALSE(run.failure(l));
            if (!run.running()[l] && begun < 10 && (begun == 0 || d.coin())) {
                ++begun;
                run.begin(l, 0, part_of(x0, d), part_of(p, d));
            }
        }
        auto const before = run.set().time;
        auto const moved = run.advance(C(end));
        for (std::size_t l = 0; l < 8; ++l) {
            if (moved[l]) {
                REQUIRE(run.time(l) > before[l]);
                check_step(run, l, before[l], d, 3, exact, slack);
            } else {
                REQUIRE(run.time(l) == before[l]);
            }
        }
    }
}

/// What a run does to be tested: every step's set and tube against an exact solution.
template <std::size_t N, std::size_t D>
std::size_t check_run(flow const& f, enclosure_options const& options, box const& x0, box const& p,
                      double end, exact_solution const& exact, std::uint64_t seed = 1,
                      extended slack = 1e-16L) {
    draws d(seed);
    parametric_flow<taylor_model<double>> run(f, options, N, D);
    run.begin(0, x0, p);
    while (run.time() < end) {
        double const from = run.time();
        bool const done = run.step(end);
        CAPTURE(from, run.steps());
        REQUIRE(done);
        check_step(run, 0, from, d, 12, exact, slack);
    }
    check_lanes<N, D>(f, options, x0, p, end, exact, seed, slack);
    return run.steps();
}

/// Nothing gives up: only the proofs are tested.
enclosure_options patient(std::size_t order, double tolerance) {
    enclosure_options o;
    o.order = order;
    o.tolerance = tolerance;
    o.relative_tolerance = 0;
    o.minimum_step = 1e-4;
    o.widest = 1e6;
    o.remainder_share = 1e9;
    return o;
}

template <class X>
X vector(std::initializer_list<typename X::value_type> values) {
    return X(values);
}

/// x' = u c + (1 - u) f(x), u = 1 before time 1 and 0 after. From x = 0 the set at time 1 is [-1,
/// 1]^n in generators alone: the polynomial is constant, so that everything rests on the flow's
/// derivative.
template <class Rate>
std::shared_ptr<flow const> remainder_alone(std::size_t n, Rate const& f) {
    auto const model =
        model_of({n, n, 1, 1e6}, [n, &f](auto const&, auto const& x, auto const& c, auto const& u) {
            auto rate = f(x);
            for (std::size_t i = 0; i < n; ++i) rate[i] = u[0] * c[i] + (1 - u[0]) * rate[i];
            return rate;
        });
    parameter_choice choice;
    for (std::size_t i = 0; i < n; ++i) choice.fixed[support::numbered('p', i)] = between(-1, 1);
    return std::make_shared<flow const>(
        model, choice, std::vector<signal>{sampled_signal({0, 1}, {1, 0}, interpolation::hold)});
}

/// A box that contains the set.
template <class Set>
bool hull_contains(Set const& set, extended_state const& x) {
    auto const hull = set.hull();
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!support::encloses_reference(hull[i], x[i], 1e-15)) return false;
    }
    return true;
}

/// The member c + m of the sets at time 1 is followed by `exact` (time since 1, start).
template <std::size_t D>
std::size_t
check_remainder(std::size_t n, flow const& f, enclosure_options const& options, double end,
                std::function<extended_state(extended, extended_state const&)> const& exact) {
    parametric_flow<taylor_model<double>> run(f, options, 1, D);
    run.begin(0, box(n), box());
    while (run.time() < 1) REQUIRE(run.step(1));
    for (std::size_t i = 0; i < n; ++i) {
        REQUIRE(run.set().reach[i] >= 1);
        REQUIRE(run.set().reach[i] < 1.001);
        REQUIRE(run.set().centre[i].spread() == 0);
    }
    std::size_t const before = run.steps();
    draws d(3);
    while (run.time() < end) {
        double const from = run.time();
        bool const done = run.step(end);
        CAPTURE(from, n, run.set().reach[0]);
        INFO((run.failure() ? run.failure()->message("x") : ""));
        REQUIRE(done);
        for (int sample = 0; sample < 32; ++sample) {
            extended_state c(n);
            for (auto& x : c) x = d.below(3) == 0 ? d.uniform(-1, 1) : d.coin() ? 1 : -1;
            CAPTURE(run.time(), sample);
            REQUIRE(hull_contains(run.set(), exact(run.time() - 1.0L, c)));
            // within the step, its end included
            extended const share = sample % 2 == 0 ? 1 : d.uniform(0, 1);
            extended const middle = static_cast<extended>(from) +
                                    share * (static_cast<extended>(run.time()) - from) - 1;
            auto const x = exact(middle, c);
            auto const swept = run.swept();
            for (std::size_t i = 0; i < n; ++i) {
                REQUIRE(support::encloses_reference(swept[i], x[i], 1e-15));
            }
        }
    }
    return run.steps() - before;
}

} // namespace

TEST_CASE("parametric flow: rotation by an unknown frequency, closed form") {
    auto const f = flow_of(
        model_of({2, 1, 0, 100}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return vector<std::decay_t<decltype(x)>>({-p[0] * x[1], p[0] * x[0]});
        }));
    exact_solution const exact = [](extended t, auto const& x, auto const& p) {
        extended const c = std::cos(p[0] * t);
        extended const s = std::sin(p[0] * t);
        return extended_state{x[0] * c - x[1] * s, x[0] * s + x[1] * c};
    };
    box const x0{between(1, 1), between(0, 0)};
    for (std::size_t const order : {1U, 2U, 3U, 8U}) {
        CAPTURE(order);
        auto options = patient(order, order == 1 ? 1e-2 : 1e-3);
        check_run<1, 2>(*f, options, x0, {between(0.9, 1.1)}, 2, exact);
    }
    check_run<2, 2>(*f, patient(10, 1e-8), {between(0.9, 1.1), between(0, 0)}, {between(0.9, 1.1)},
                    6, exact);
    // sharp: a narrow box over one turn
    parametric_flow<taylor_model<double>> run(*f, patient(12, 1e-10), 1, 2);
    run.begin(0, x0, {between(1 - 1e-4, 1 + 1e-4)});
    while (run.time() < 6) REQUIRE(run.step(6));
    REQUIRE(run.set().reach[0] < 1e-6);
}

TEST_CASE("parametric flow: nonlinear, at the lowest orders and with long steps") {
    // x' = p x (1 - x)
    auto const f = flow_of(
        model_of({1, 1, 0, 100}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return vector<std::decay_t<decltype(x)>>({p[0] * x[0] * (1 - x[0])});
        }));
    exact_solution const exact = [](extended t, auto const& x, auto const& p) {
        extended const e = std::exp(p[0] * t);
        return extended_state{x[0] * e / (1 + x[0] * (e - 1))};
    };
    box const x0{between(0.2, 0.4)};
    box const p{between(0.5, 1.5)};
    for (std::size_t const order : {1U, 2U, 3U}) {
        for (double const tolerance : {1e-4, 1e-2, 0.3}) {
            CAPTURE(order, tolerance);
            check_run<2, 1>(*f, patient(order, tolerance), x0, p, 0.5, exact);
            check_run<2, 2>(*f, patient(order, tolerance), x0, p, 0.75, exact);
        }
    }
    check_run<2, 2>(*f, patient(12, 1e-6), x0, p, 1, exact);
}

TEST_CASE("parametric flow: the remainder alone, V not dropped from its own Lagrange term") {
    // x' = x from [-1, 1], first order, steps of 0.375. The Lagrange term of V is h V(s), 0 <= s <=
    // h; with h alone the step would give 1.375, less than exp(0.375) = 1.455.
    auto const f = remainder_alone(1, [](auto const& x) { return x; });
    auto options = patient(1, 10);
    options.maximum_step = 0.375;
    auto const steps =
        check_remainder<2>(1, *f, options, 1.75, [](extended t, extended_state const& x) {
            return extended_state{x[0] * std::exp(t)};
        });
    REQUIRE(steps == 2); // as long as asked for: the test is as sharp as it means to be
    // The tube's room comes from the set's growth, not from a generous tolerance.
    options.tolerance = 0.05;
    check_remainder<2>(1, *f, options, 1.75, [](extended t, extended_state const& x) {
        return extended_state{x[0] * std::exp(t)};
    });
}

TEST_CASE("parametric flow: the remainder alone, linear and nonlinear") {
    auto const rotation = remainder_alone(2, [](auto const& x) {
        return vector<std::decay_t<decltype(x)>>({-x[1], x[0]});
    });
    auto const turn = [](extended t, extended_state const& x) {
        return extended_state{x[0] * std::cos(t) - x[1] * std::sin(t),
                              x[0] * std::sin(t) + x[1] * std::cos(t)};
    };
    // x' = x / 4 - x^3 / 16: a Bernoulli equation with a closed form
    auto const bernoulli = remainder_alone(1, [](auto const& x) {
        return vector<std::decay_t<decltype(x)>>({x[0] / 4 - x[0] * x[0] * x[0] / 16});
    });
    auto const fall = [](extended t, extended_state const& x) {
        extended const e = std::exp(t / 2);
        return extended_state{x[0] * std::sqrt(e / (1 + x[0] * x[0] * (e - 1) / 4))};
    };
    for (std::size_t const order : {1U, 2U, 3U, 6U}) {
        for (double const step : {0.1, 0.35}) {
            CAPTURE(order, step);
            auto options = patient(order, 10);
            options.maximum_step = step;
            check_remainder<2>(2, *rotation, options, 1.7, turn);
            options.tolerance = 0.3; // a wider tube would let the cube blow up
            check_remainder<1>(1, *bernoulli, options, 1.7, fall);
        }
    }
}

TEST_CASE("parametric flow: right-hand sides that depend on time") {
    auto const f = flow_of(
        model_of({1, 1, 0, 100}, [](auto const& t, auto const& x, auto const& p, auto const&) {
            using std::cos;
            return vector<std::decay_t<decltype(x)>>({p[0] * cos(t) * x[0]});
        }));
    exact_solution const exact = [](extended t, auto const& x, auto const& p) {
        return extended_state{x[0] * std::exp(p[0] * std::sin(t))};
    };
    for (std::size_t const order : {1U, 3U, 8U}) {
        CAPTURE(order);
        check_run<2, 2>(*f, patient(order, order == 1 ? 0.05 : 1e-3), {between(0.9, 1.1)},
                        {between(0.5, 0.75)}, 2, exact);
    }
}

TEST_CASE("parametric flow: sampled inputs end steps at their knots") {
    auto const model =
        model_of({1, 1, 1, 100}, [](auto const&, auto const&, auto const& p, auto const& u) {
            return vector<std::decay_t<decltype(u)>>({p[0] * u[0]});
        });
    // decimal times: the slope is not a double
    sampled_signal const linear({0, 0.1, 0.3, 0.7}, {1, -2, 0.1, 5}, interpolation::linear);
    sampled_signal const hold({0, 0.1, 0.3, 0.7}, {1, -2, 0.1, 5}, interpolation::hold);
    for (auto const& u : {linear, hold}) {
        auto const f = flow_of(model, {u});
        exact_solution const exact = [&u](extended t, auto const& x, auto const& p) {
            extended sum = x[0];
            for (std::size_t k = 0; k < 4 && u.times()[k] < t; ++k) {
                bool const last = k == 3;
                extended const to = last ? t : std::min<extended>(t, u.times()[k + 1]);
                extended const step = to - u.times()[k];
                extended slope = 0;
                auto const piece =
                    u.kind() == interpolation::linear ? std::min<std::size_t>(k, 2) : k;
                if (u.kind() == interpolation::linear) {
                    slope = (static_cast<extended>(u.values()[piece + 1]) - u.values()[piece]) /
                            (static_cast<extended>(u.times()[piece + 1]) - u.times()[piece]);
                }
                extended const value =
                    u.values()[piece] +
                    slope * (static_cast<extended>(u.times()[k]) - u.times()[piece]);
                sum += p[0] * (value * step + slope * step * step / 2);
            }
            return extended_state{sum};
        };
        CAPTURE(u.kind() == interpolation::hold);
        for (std::size_t const order : {1U, 2U, 6U}) {
            auto const steps = check_run<1, 2>(*f, patient(order, 0.1), {interval(0.5)},
                                               {between(0.9, 1.1)}, 1, exact);
            REQUIRE(steps >= 4);
        }
    }
}

TEST_CASE("parametric flow: parameters of one ulp") {
    auto const f = flow_of(
        model_of({1, 2, 0, 100}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return vector<std::decay_t<decltype(x)>>({p[0] * p[1] * x[0]});
        }));
    box const p{hull(0.1_dec, 0.1_dec), hull(0.7_dec, 0.7_dec)};
    parametric_flow<taylor_model<double>> run(*f, patient(14, 1e-15), 1, 2);
    run.begin(0, {interval(1.0)}, p);
    REQUIRE(run.unknowns().variables == 0);
    while (run.time() < 2) REQUIRE(run.step(2));
    auto const hull = run.set().hull()[0];
    using support::mp;
    mp const exact = exp(mp(7) / 100 * 2);
    REQUIRE(support::encloses(hull, exact));
    // every pair of parameters within the ulps
    REQUIRE(support::encloses(hull, exp(mp(p[0].upper()) * mp(p[1].upper()) * 2)));
    REQUIRE(support::encloses(hull, exp(mp(p[0].lower()) * mp(p[1].lower()) * 2)));
    REQUIRE(width(hull) < 1e-13);
}

TEST_CASE("parametric flow: a kink is crossed") {
    // x' = 1 + |x|: from x0 < 0 to 0 at log(1 - x0), then exponential
    auto const f =
        flow_of(model_of({1, 0, 0, 100}, [](auto const&, auto const& x, auto const&, auto const&) {
            using sivid::abs;
            return vector<std::decay_t<decltype(x)>>({1 + abs(x[0])});
        }));
    exact_solution const exact = [](extended t, auto const& x, auto const&) {
        if (x[0] >= 0) return extended_state{(x[0] + 1) * std::exp(t) - 1};
        extended const zero = std::log(1 - x[0]);
        if (t <= zero) return extended_state{1 - (1 - x[0]) * std::exp(-t)};
        return extended_state{std::exp(t - zero) - 1};
    };
    for (std::size_t const order : {1U, 2U, 8U}) {
        CAPTURE(order);
        auto options = patient(order, 1e-3);
        options.maximum_step = 0.05;
        check_run<1, 2>(*f, options, {between(-0.5, -0.4)}, {}, 1, exact);
        check_run<1, 1>(*f, options, {between(-0.5, 0.1)}, {}, 1, exact);
    }
}

TEST_CASE("parametric flow: a dead band that has no width yet is no kink beyond 0") {
    // x' = (0.5 - t with a dead band p u), u = 0 until 2: the kinks at 0 are crossed once. A dead
    // band as x less its saturation would be a kink wherever the width is 0.
    auto const m =
        model_of({1, 1, 1, 100}, [](auto const& t, auto const& x, auto const& p, auto const& u) {
            using sivid::deadband;
            return vector<std::decay_t<decltype(x)>>({deadband(0.5 - t, p[0] * u[0])});
        });
    auto const f = flow_of(m, {sampled_signal({0, 2, 3}, {0, 1, 1}, interpolation::hold)});
    parametric_flow<taylor_model<double>> run(*f, {}, 2, 2);
    run.begin(0, {interval(0.0)}, {between(0.1, 0.2)});
    std::size_t steps = 0;
    while (run.time() < 2) {
        REQUIRE(run.step(2));
        REQUIRE(++steps < 100);
    }
    CHECK(contains(run.set().hull()[0], -1.0)); // t/2 - t^2/2
    CHECK(width(run.set().hull()[0]) < 1e-6);
    while (run.time() < 3) REQUIRE(run.step(3)); // (0.5 - t) + p from now on
    CHECK(contains(run.set().hull()[0], -3 + 0.15));
}

TEST_CASE("parametric flow: a kink seen by the polynomial of low degree only") {
    // y' = |x^2 + 1e-4 + t|: x^2 + 1e-4 in degree 1 touches zero, in the tube's degree 2 it does
    // not.
    auto const f = flow_of(
        model_of({2, 0, 0, 100}, [](auto const& t, auto const& x, auto const&, auto const&) {
            using sivid::abs;
            return vector<std::decay_t<decltype(x)>>({0 * x[0], abs(x[0] * x[0] + 1e-4 + t)});
        }));
    exact_solution const exact = [](extended t, auto const& x, auto const&) {
        return extended_state{x[0], x[1] + (x[0] * x[0] + 1e-4) * t + t * t / 2};
    };
    check_run<1, 1>(*f, patient(6, 1e-9), {between(0.001, 0.2), interval(0.0)}, {}, 1, exact);
    check_run<1, 2>(*f, patient(6, 1e-9), {between(0.001, 0.2), interval(0.0)}, {}, 1, exact);
}

TEST_CASE("parametric flow: jumps of the right-hand side, as a differential inclusion") {
    // x' = -sign(x) reaches zero and stays; Filippov's solution
    auto const f =
        flow_of(model_of({1, 0, 0, 100}, [](auto const&, auto const& x, auto const&, auto const&) {
            using sivid::sign;
            return vector<std::decay_t<decltype(x)>>({-sign(x[0])});
        }));
    exact_solution const exact = [](extended t, auto const& x, auto const&) {
        return extended_state{x[0] > 0 ? std::max<extended>(x[0] - t, 0)
                                       : std::min<extended>(x[0] + t, 0)};
    };
    auto options = patient(4, 1e-2);
    options.maximum_step = 0.05;
    check_run<1, 2>(*f, options, {between(0.2, 0.3)}, {}, 0.6, exact);
    check_run<1, 1>(*f, options, {between(-0.1, 0.3)}, {}, 0.6, exact);
}

namespace {

/// The first time in (from, to] at which `room` is below 0, to the last digits; `to` where none.
/// Its slope is `steepest` at most: it lasts for a while where there is much of it.
template <class Room>
extended first_time(extended from, extended to, Room const& room, extended steepest) {
    for (extended low = from; low < to;) {
        extended high = std::min(low + std::max(1e-3L, room(low) / steepest), to);
        if (room(high) < 0) {
            for (int k = 0; k < 60; ++k) {
                extended const middle = (low + high) / 2;
                (room(middle) < 0 ? high : low) = middle;
            }
            return high;
        }
        low = high;
    }
    return to;
}

/// A block on a rough floor, x' = v, v' = a sin t - mu sign(v), by closed forms between the times
/// at which it stops, sticks and breaks away.
extended_state block(extended end, extended x, extended v, extended mu, extended a) {
    extended t = 0;
    while (t < end) {
        extended const push = a * std::sin(t);
        extended s = v > 0 ? 1 : v < 0 ? -1 : push > mu ? 1 : push < -mu ? -1 : 0;
        if (s == 0) {
            t = first_time(
                t, end, [&](extended later) { return mu - std::fabs(a * std::sin(later)); },
                std::fabs(a));
            continue;
        }
        auto const speed = [&](extended later) {
            return v - a * (std::cos(later) - std::cos(t)) - s * mu * (later - t);
        };
        extended const stop = first_time(
            t, end, [&](extended later) { return s * speed(later); }, std::fabs(a) + mu);
        extended const h = stop - t;
        x += v * h - a * (std::sin(stop) - std::sin(t)) + a * std::cos(t) * h - s * mu * h * h / 2;
        v = stop < end ? 0 : speed(stop);
        t = stop;
    }
    return {x, v};
}

} // namespace

TEST_CASE("parametric flow: a block that sticks, and one that sticks and slips") {
    auto const f = flow_of(
        model_of({2, 2, 0, 100}, [](auto const& t, auto const& x, auto const& p, auto const&) {
            using sivid::sign;
            using sivid::sin;
            return vector<std::decay_t<decltype(x)>>({x[1], p[1] * sin(t) - p[0] * sign(x[1])});
        }));
    exact_solution const exact = [](extended t, auto const& x, auto const& p) {
        return block(t, x[0], x[1], p[0], p[1]);
    };
    box const start{between(-0.01, 0.01), between(0.99, 1.01)};
    auto options = patient(8, 1e-10);
    options.relative_tolerance = 1e-4;
    options.minimum_step = 1e-7;
    options.maximum_step = 1; // nobody says how long it lasts
    // The floor holds it for good: hardly a step is needed, and hardly anything is lost.
    CHECK(check_run<4, 3>(*f, options, start, {between(1.98, 2.02), between(0.99, 1.01)}, 6, exact,
                          1, 1e-9L) < 60);
    parametric_flow<taylor_model<double>> run(*f, options, 4, 3);
    run.begin(0, start, {between(1.98, 2.02), between(0.99, 1.01)});
    while (run.time() < 6) REQUIRE(run.step(6));
    CHECK(width(run.set().hull()[1]) < 3e-5);
    // It stops, sticks and breaks away, again and again.
    check_run<4, 3>(*f, options, start, {between(1.99, 2.01), between(2.99, 3.01)}, 12, exact, 2,
                    1e-9L);
    // Not every member sticks, and those that do break away at times that differ.
    check_run<4, 2>(*f, options, start, {between(1.8, 2.2), between(1.9, 2.1)}, 3, exact, 3, 1e-9L);
    // From rest, and from both directions.
    check_run<4, 2>(*f, options, {interval(0.0), interval(0.0)},
                    {between(0.9, 1.1), between(1.4, 1.6)}, 2, exact, 4, 1e-9L);
    check_run<4, 2>(*f, options, {interval(0.0), between(-0.1, 0.1)},
                    {between(0.9, 1.1), between(0.5, 1.5)}, 2, exact, 5, 1e-9L);
}

TEST_CASE("parametric flow: a place that repels is left at any time") {
    // x' = sign(x) - c: what starts at 0 may stay there for a while (Filippov), while |c| < 1.
    auto const f = flow_of(
        model_of({1, 1, 0, 100}, [](auto const&, auto const& x, auto const& p, auto const&) {
            using sivid::sign;
            return vector<std::decay_t<decltype(x)>>({sign(x[0]) - p[0]});
        }));
    for (extended const rest : {0.0L, 0.1L, 0.5L}) {
        for (int const way : {-1, 1}) {
            exact_solution const exact = [=](extended t, auto const& x, auto const& p) {
                extended const s = x[0] > 0 ? 1 : x[0] < 0 ? -1 : way;
                extended const moving = x[0] == 0 ? std::max<extended>(t - rest, 0) : t;
                return extended_state{x[0] + (s - p[0]) * moving};
            };
            check_run<2, 1>(*f, patient(4, 1e-2), {interval(0.0)}, {between(-0.3, 0.4)}, 0.8,
                            exact);
            check_run<2, 1>(*f, patient(4, 1e-2), {between(0, 0.1)}, {between(-0.3, 0.4)}, 0.8,
                            exact);
        }
    }
}

TEST_CASE("parametric flow: the sign of a parameter that spans zero") {
    // constant in time for each parameter: one of three linear equations
    auto const f = flow_of(
        model_of({1, 1, 0, 100}, [](auto const&, auto const& x, auto const& p, auto const&) {
            using sivid::sign;
            return vector<std::decay_t<decltype(x)>>({sign(p[0]) * x[0]});
        }));
    exact_solution const exact = [](extended t, auto const& x, auto const& p) {
        return extended_state{x[0] * std::exp(p[0] > 0 ? t : p[0] < 0 ? -t : 0)};
    };
    for (std::size_t const order : {1U, 2U, 8U}) {
        CAPTURE(order);
        auto options = patient(order, 1e-2);
        options.maximum_step = 0.25;
        check_run<1, 2>(*f, options, {interval(1.0)}, {between(-1, 2)}, 1, exact);
    }
}

TEST_CASE("parametric flow: a function left its domain, as a value") {
    // x' = -sqrt(x): the domain ends at x = 0, reached at t = 2 sqrt(x0)
    auto const f =
        flow_of(model_of({1, 0, 0, 100}, [](auto const&, auto const& x, auto const&, auto const&) {
            using sivid::sqrt;
            return vector<std::decay_t<decltype(x)>>({-sqrt(x[0])});
        }));
    parametric_flow<taylor_model<double>> run(*f, patient(8, 1e-6), 1, 2);
    run.begin(0, {between(0.9, 1)}, {});
    while (run.time() < 3 && run.step(3)) {
    }
    REQUIRE(run.failure());
    REQUIRE(run.time() < 2);
    REQUIRE(run.time() > 1);
    REQUIRE(run.failure()->time == run.time());
    REQUIRE_FALSE(run.step(3)); // and stays failed
    // from the beginning
    run.begin(0, {between(-0.1, 1)}, {});
    REQUIRE_FALSE(run.step(3));
    REQUIRE(run.failure()->reason == failure_reason::undefined);
    // the object is usable again
    run.begin(0, {between(0.9, 1)}, {});
    REQUIRE(run.step(0.5));
}

TEST_CASE("parametric flow: a power 0 is 1 where its base is defined") {
    auto const f =
        flow_of(model_of({1, 1}, [](auto const& t, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * pown(sqrt(t + 2), 0) * pown(log(x[0]), 0)};
        }));
    parametric_flow<> run(*f, {}, 2, 4);
    draws d(89);
    run.begin(0, box{between(1.5, 2)}, box{between(1, 2)});
    while (run.time() < 1) {
        double const from = run.time();
        REQUIRE(run.step(1));
        check_step(
            run, 0, from, d, 5,
            [](extended t, auto const& x0, auto const& p) {
                return extended_state{x0[0] + p[0] * t};
            },
            1e-17L);
    }
    run.begin(0, box{between(-1, 2)}, box{between(1, 2)});
    CHECK_FALSE(run.step(1));
}

TEST_CASE("parametric flow: the shortest step is tried before giving up") {
    auto const f =
        flow_of(model_of({1, 0, 0, 100}, [](auto const&, auto const& x, auto const&, auto const&) {
            return vector<std::decay_t<decltype(x)>>({x[0]});
        }));
    box const x0{between(0.99, 1.01)};
    auto options = patient(4, 1e-9);
    options.minimum_step = 1e-9;
    parametric_flow<taylor_model<double>> free(*f, options, 1, 2);
    free.begin(0, x0, box());
    REQUIRE(free.step(10));
    double const proposed = free.time();
    // A little longer than the coefficients suggest, and still good enough.
    options.minimum_step = 1.05 * proposed;
    parametric_flow<taylor_model<double>> run(*f, options, 1, 2);
    run.begin(0, x0, box());
    REQUIRE(run.step(10));
    CHECK(run.time() == options.minimum_step);
    CHECK(subset(between(0.99 * std::exp(run.time()) * (1 + 1e-14),
                         1.01 * std::exp(run.time()) * (1 - 1e-14)),
                 run.set().hull()[0]));
    // Far too long: it was tried, and that is what the failure says.
    options.minimum_step = 200 * proposed;
    parametric_flow<taylor_model<double>> fails(*f, options, 1, 2);
    fails.begin(0, x0, box());
    CHECK_FALSE(fails.step(10));
    REQUIRE(fails.failure());
    CHECK(fails.failure()->reason == failure_reason::minimum_step);
    CHECK(fails.failure()->until == options.minimum_step);
}

TEST_CASE("parametric flow: long steps do not magnify what the degree loses") {
    // van der Pol over a box that is wide for degree 4: the tolerance alone would allow steps whose
    // norms lose twice as much, 0.29 of the sampled half-width at the end.
    auto const f =
        flow_of(model_of({2, 0, 0, 100}, [](auto const&, auto const& x, auto const&, auto const&) {
            return vector<std::decay_t<decltype(x)>>({x[1], (1 - x[0] * x[0]) * x[1] - x[0]});
        }));
    auto options = patient(10, 1e-6);
    options.relative_tolerance = 1e-4;
    options.maximum_step = 1; // nobody says how long it lasts
    parametric_flow<taylor_model<double>> run(*f, options, 2, 4);
    run.begin(0, {between(1.25, 1.55), between(2.35, 2.45)}, {});
    while (run.time() < 7) REQUIRE(run.step(7));
    CHECK(run.steps() > 30);
    CHECK(run.set().reach[0] < 0.2 * run.set().centre[0].spread());
    // A narrow one is none of that rule's business.
    parametric_flow<taylor_model<double>> narrow(*f, options, 2, 4);
    narrow.begin(0, {between(1.399, 1.401), between(2.399, 2.401)}, {});
    while (narrow.time() < 7) REQUIRE(narrow.step(7));
    CHECK(narrow.steps() < 30);
}

TEST_CASE("parametric flow: blow-up is never enclosed by a bounded set beyond its time") {
    auto const f = flow_of(
        model_of({1, 0, 0, 1e300}, [](auto const&, auto const& x, auto const&, auto const&) {
            return vector<std::decay_t<decltype(x)>>({x[0] * x[0]});
        }));
    parametric_flow<taylor_model<double>> run(*f, patient(6, 1e-3), 1, 2);
    run.begin(0, {between(0.9, 1)}, {}); // the first solution ends at t = 1
    std::size_t steps = 0;
    while (run.time() < 1.2 && steps++ < 2000 && run.step(1.2)) {
    }
    REQUIRE(run.time() < 1);
}

TEST_CASE("parametric flow: numbers beyond the doubles end in no bound or in a failure") {
    auto const f = flow_of(
        model_of({1, 2, 0, HUGE_VAL}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return vector<std::decay_t<decltype(x)>>({p[0] * p[0] * p[0] * p[1]});
        }));
    // the product is 1e450 times a number that may be 0: infinity times zero on the way
    for (auto const& factor : {between(0, 0), between(1e-200, 1.5e-200), between(-1, 1)}) {
        parametric_flow<taylor_model<double>> run(*f, patient(6, 1e-3), 2, 2);
        run.begin(0, {interval(0.0)}, {between(1e150, 1.1e150), factor});
        if (!run.step(1)) continue;
        REQUIRE(width(run.set().hull()[0]) == HUGE_VAL);
        REQUIRE_FALSE(is_empty(run.set().hull()[0]));
        REQUIRE(width(range(run.outputs()[0])) == HUGE_VAL);
    }
}

TEST_CASE("parametric flow: outputs are functions of the same unknowns") {
    auto const f = flow_of(
        model_of(
            {1, 1, 1, 100},
            [](auto const&, auto const& x, auto const& p, auto const&) {
                return vector<std::decay_t<decltype(x)>>({-p[0] * x[0]});
            },
            [](auto const& t, auto const& x, auto const& p, auto const& u) {
                using std::exp;
                using sivid::sign;
                return vector<std::decay_t<decltype(x)>>(
                    {x[0] * p[0] + t, exp(x[0]) + u[0], sign(x[0] - 0.7), 1 / (x[0] - 0.7)});
            }),
        {sampled_signal({0, 0.5}, {1, 3}, interpolation::hold)});
    parametric_flow<taylor_model<double>> run(*f, patient(10, 1e-8), 2, 2);
    box const x0{between(0.9, 1.1)};
    box const p{between(0.4, 0.6)};
    run.begin(0, x0, p);
    draws d(4);
    for (double const t : {0.25, 0.5, 1.0}) {
        while (run.time() < t) REQUIRE(run.step(t));
        auto const y = run.outputs();
        for (int sample = 0; sample < 40; ++sample) {
            auto const q = support::short_point(d, 2);
            extended const c = at(run.unknowns().parameters, q)[0];
            extended const x = at(run.unknowns().initial, q)[0] * std::exp(-c * t);
            std::vector<extended> const exact{x * c + t, std::exp(x) + (t < 0.5 ? 1 : 3),
                                              x > 0.7L ? 1.0L : -1.0L, 1 / (x - 0.7L)};
            for (std::size_t k = 0; k < 4; ++k) {
                CAPTURE(t, k);
                if (!std::isfinite(y[k].r())) continue;
                extended const off = std::fabs(exact[k] - support::value<extended>(y[k], q));
                REQUIRE(off <= y[k].r() + 1e-16L * (1 + std::fabs(exact[k])));
            }
        }
        // x = 0.7 lies in the set at the later times: the reciprocal is not defined there
        REQUIRE(std::isfinite(y[3].r()) == (t < 0.3));
    }
}

TEST_CASE("parametric flow: what is checked") {
    auto const f = flow_of(
        model_of({1, 1, 0, 100}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return vector<std::decay_t<decltype(x)>>({p[0] * x[0]});
        }));
    enclosure_options none;
    none.order = 0;
    REQUIRE_THROWS_AS((parametric_flow<taylor_model<double>>(*f, none, 1, 2)),
                      std::invalid_argument);
    parametric_flow<taylor_model<double>> run(*f, patient(4, 1e-3), 1, 2);
    auto const all = interval_traits<interval>::entire();
    auto const nothing = interval_traits<interval>::empty();
    box const one{interval(1.0)};
    REQUIRE_THROWS_AS(run.begin(0, {between(0, 1)}, {between(0, 1)}), std::invalid_argument);
    REQUIRE_THROWS_AS(run.begin(0, {all}, one), std::invalid_argument);
    REQUIRE_THROWS_AS(run.begin(0, one, {nothing}), std::invalid_argument);
    REQUIRE_THROWS_AS(run.begin(0, one, {}), std::invalid_argument);
    REQUIRE_THROWS_AS(run.begin(0, {}, one), std::invalid_argument);
    run.begin(0, one, {between(0, 1)});
    while (run.time() < 0.25) REQUIRE(run.step(0.25));
    REQUIRE_THROWS_AS(run.step(0.25), std::invalid_argument);
    REQUIRE_THROWS_AS(run.step(0.0), std::invalid_argument);
    REQUIRE(run.step(0.5)); // the object was not harmed

    auto options = patient(4, 1e-3);
    options.maximum_steps = 2;
    parametric_flow<taylor_model<double>> limited(*f, options, 1, 2);
    limited.begin(0, one, {between(0, 1)});
    REQUIRE(limited.step(0.1));
    REQUIRE(limited.step(0.2));
    auto const swept = limited.swept();
    REQUIRE_FALSE(limited.step(0.3));
    REQUIRE(limited.failure()->reason == failure_reason::step_limit);
    REQUIRE(limited.failure()->help == advice::more_steps);
    REQUIRE(lower(swept[0]) == lower(limited.swept()[0]));
    REQUIRE(upper(swept[0]) == upper(limited.swept()[0]));

    bool go = true;
    auto told = patient(4, 1e-3);
    told.keep_going = [&go] { return go; };
    parametric_flow<taylor_model<double>> stopped(*f, told, 1, 2);
    stopped.begin(0, one, {between(0, 1)});
    REQUIRE(stopped.step(0.1));
    go = false;
    double const reached = stopped.time();
    REQUIRE_FALSE(stopped.step(0.3));
    REQUIRE(stopped.failure()->reason == failure_reason::cancelled);
    REQUIRE(stopped.time() == reached);
}

TEST_CASE("parametric set: a lane begins anew whatever its generators were") {
    parametric_set<taylor_model<lanes<8>>> set(2, model_shape<lanes<8>>::of(1, 2));
    normalised_unknowns const unknowns(box{between(1, 2), between(0, 0)}, box());
    for (std::size_t l = 0; l < 8; ++l) set.begin(l, 0, unknowns);
    std::vector<lanes<8>> spoilt(2, lanes<8>(1e-3));
    spoilt[0].set(3, HUGE_VAL);
    spoilt[1].set(3, std::nan(""));
    set.append(spoilt);
    set.measure();
    REQUIRE_FALSE(std::isfinite(set.reach[0][3]));
    set.begin(3, 0, unknowns);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(set.reach[i][3] == 0);
        CHECK(set.reach[i][4] >= 1e-3);
    }
}
