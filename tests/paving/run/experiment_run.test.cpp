// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/problems.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"

#include <sivid/paving/judge/feasibility_test_options.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/run/experiment_run.hpp>
#include <sivid/paving/run/further_runs.hpp>
#include <sivid/paving/run/run_parts.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::extended;
using support::extended_state;

namespace {

/// A model with its boxes, and the same equations in extended precision.
struct problem {
    std::string name;
    std::shared_ptr<flow const> equations;
    experiment run;
    box prior;
    std::vector<double> times;
    std::function<extended_state(extended, extended_state const&, extended_state const&,
                                 extended_state const&)>
        rate;
    std::vector<sampled_signal> inputs;

    [[nodiscard]] std::vector<extended_state> exact(extended_state const& x0,
                                                    extended_state const& p) const {
        return support::reference_states(rate, x0, p, run.begin, times, inputs);
    }
};

template <class Rate>
problem make(std::string name, Rate const& rate, box const& x0, box const& p, double end,
             std::vector<sampled_signal> const& inputs = {}) {
    problem result;
    result.name = std::move(name);
    auto const m = support::model_of({x0.size(), p.size(), inputs.size(), 50}, rate);
    result.equations = support::flow_of(m, std::vector<signal>(inputs.begin(), inputs.end()));
    result.run.initial = x0;
    result.prior = p;
    result.rate = rate;
    result.inputs = inputs;
    for (int k = 1; k <= 4; ++k) {
        result.times.push_back(end * k / 4);
        for (std::size_t i = 0; i < x0.size(); ++i) {
            result.run.measurements.push_back({result.times.back(), i, between(-1e3, 1e3)});
        }
    }
    return result;
}

template <class X>
X vector(X const&, std::initializer_list<typename X::value_type> values) {
    return X(values);
}

/// Models over every degree, and beyond the sizes that are compiled apart: the number of unknowns
/// stands in the name.
std::vector<problem> some_models() {
    std::vector<problem> all;
    auto const one = between(1, 1);
    all.push_back(make(
        "2: van der Pol",
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return vector(x, {x[1], p[0] * (1 - x[0] * x[0]) * x[1] - x[0]});
        },
        {between(1.3, 1.5), between(2.4, 2.4)}, {between(0.9, 1.1)}, 2));
    all.push_back(make(
        "2: pendulum",
        [](auto const&, auto const& x, auto const& p, auto const&) {
            using std::sin;
            return vector(x, {x[1], -p[0] * sin(x[0]) - p[1] * x[1]});
        },
        {one, between(0, 0)}, {between(0.9, 1.2), between(0.1, 0.3)}, 3));
    all.push_back(make(
        "3: Lotka and Volterra",
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return vector(x, {x[0] * (p[0] - x[1]), x[1] * (x[0] - p[1])});
        },
        {between(0.9, 1.1), between(0.5, 0.5)}, {between(0.9, 1.1), between(0.8, 1.2)}, 2));
    all.push_back(make(
        "3: Lorenz",
        [](auto const&, auto const& x, auto const&, auto const&) {
            return vector(
                x, {10 * (x[1] - x[0]), x[0] * (28 - x[2]) - x[1], x[0] * x[1] - x[2] * 8 / 3});
        },
        {between(14.99, 15.01), between(14.99, 15.01), between(35.99, 36.01)}, {}, 0.5));
    all.push_back(make(
        "3: Michaelis and Menten",
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return vector(x, {-p[0] * x[0] / (p[1] + x[0])});
        },
        {between(0.9, 1.1)}, {between(0.8, 1.2), between(0.4, 0.6)}, 1.5));
    all.push_back(make(
        "4: drag",
        [](auto const&, auto const& x, auto const& p, auto const&) {
            using std::sqrt;
            auto const drag = p[1] * sqrt(p[2] + x[1] * x[1]);
            return vector(x, {x[1], p[0] - drag * x[1]});
        },
        {between(0, 0), between(0.9, 1.1)},
        {between(0.9, 1.1), between(0.4, 0.6), between(0.1, 0.2)}, 2));
    all.push_back(make(
        "4: activation",
        [](auto const& t, auto const& x, auto const& p, auto const&) {
            using std::atan;
            using std::cos;
            using std::tanh;
            return vector(x, {-x[0] + tanh(p[0] * x[1]) + cos(t), atan(p[1] * x[0]) - p[2] * x[1]});
        },
        {between(0.4, 0.6), between(0, 0)},
        {between(0.9, 1.1), between(0.9, 1.1), between(0.45, 0.55)}, 2));
    all.push_back(make(
        "5: reactor",
        [](auto const&, auto const& x, auto const& p, auto const&) {
            using std::exp;
            using std::log;
            auto const speed = p[0] * x[0] * exp(-p[1] / x[1]);
            return vector(x, {-speed, p[2] * speed - p[3] * log(x[1])});
        },
        {between(0.95, 1.05), one},
        {between(0.9, 1.1), between(0.9, 1.1), between(0.5, 0.6), between(0.2, 0.3)}, 1.5));
    all.push_back(
        make("6: sampled input",
             [](auto const&, auto const& x, auto const& p, auto const& u) {
                 return vector(x, {x[1], -p[0] * x[0] - p[1] * x[1] + p[2] * u[0] + p[3] * u[1]});
             },
             {between(0.95, 1.05), between(-0.05, 0.05)},
             {between(0.9, 1.1), between(0.2, 0.3), between(0.9, 1.1), between(0.4, 0.6)}, 2,
             {sampled_signal({0, 0.3, 0.7, 1.1}, {0, 1, -1, 0.5}, interpolation::linear),
              sampled_signal({0, 0.4, 1.2}, {0.1, -1, 0.7}, interpolation::hold)}));
    all.push_back(make(
        "9: chain",
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return vector(x, {-p[0] * x[0] + p[1] * x[1], p[2] * x[0] - p[3] * x[1] * x[1],
                              p[4] * x[1] - p[5] * x[2]});
        },
        {between(0.98, 1.02), between(0.49, 0.51), between(0, 0.02)},
        {between(0.98, 1.02), between(0.49, 0.51), between(0.7, 0.72), between(0.3, 0.31),
         between(0.4, 0.41), between(0.9, 0.92)},
        1));
    for (std::size_t const n : {8U, 14U}) {
        box starts(n), flows(n);
        for (std::size_t i = 0; i < n; ++i) {
            starts[i] = between(0.98, 1.02);
            flows[i] = between(0.49, 0.51);
        }
        all.push_back(make(
            std::to_string(2 * n) + ": ring",
            [n](auto const&, auto const& x, auto const& p, auto const&) {
                auto rate = x;
                for (std::size_t i = 0; i < n; ++i) {
                    rate[i] = p[i] * (x[(i + 1) % n] - x[i]) - x[i] * x[i] / 4;
                }
                return rate;
            },
            starts, flows, 0.8));
    }
    return all;
}

std::vector<double> corner_or_inner(draws& d, std::size_t n) {
    std::vector<double> q(n);
    bool const corner = d.below(3) == 0;
    for (auto& x : q) x = corner ? (d.coin() ? 1.0 : -1.0) : d.uniform(-1, 1);
    return q;
}
extended_state at(std::vector<normalised_unknowns::side> const& sides,
                  std::vector<double> const& q) {
    extended_state x;
    for (auto const& s : sides) {
        x.push_back(s.centre +
                    (s.radius > 0 ? static_cast<extended>(s.radius) * q[s.variable] : 0));
    }
    return x;
}
extended polynomial(response const& r, std::size_t y, std::vector<double> const& q) {
    extended sum = 0;
    for (std::size_t m = 0; m < r.table->size(); ++m) {
        extended term = r.coefficients[m * r.outputs() + y];
        for (std::size_t v = 0; v < r.table->variables; ++v) {
            for (std::size_t k = 0; k < r.table->exponents[m][v]; ++k) term *= q[v];
        }
        sum += term;
    }
    return sum;
}

/// Random parameters and starts: each output within its polynomial and radius.
void check_containment(draws& d, problem const& p, response const& answer, int samples) {
    REQUIRE(answer.outputs() == p.run.measurements.size());
    for (int sample = 0; sample < samples; ++sample) {
        auto const q = corner_or_inner(d, answer.unknowns.variables);
        auto const exact =
            p.exact(at(answer.unknowns.initial, q), at(answer.unknowns.parameters, q));
        for (std::size_t y = 0; y < answer.outputs(); ++y) {
            auto const x = exact[y / p.run.initial.size()][y % p.run.initial.size()];
            CAPTURE(p.name, y, answer.radius[y]);
            REQUIRE(std::fabs(x - polynomial(answer, y, q)) <=
                    answer.radius[y] + 1e-14L * (1 + std::fabs(x)));
        }
    }
}

void check_kernels(std::uint64_t seed, int samples) {
    draws d(seed);
    for (auto const& p : some_models()) {
        INFO(p.name);
        REQUIRE(paving_detail::unknown_count(p.run.initial, p.prior) ==
                static_cast<std::size_t>(std::stoi(p.name)));
        auto const taylor = make_run(*p.equations, p.run, p.run.measurements, p.prior, {});
        // A box alone goes in scalars, several go in lanes.
        check_containment(d, p, *(*taylor)(p.run.initial, p.prior), samples);
        for (auto const& one : (*taylor)(p.run.initial, std::vector<box>{p.prior, p.prior}))
            check_containment(d, p, *one, samples);
        // the same object on parts, the last of them a point of the parameters
        for (double const share : {0.5, 0.1, 0.0}) {
            auto const initial = part_of(d, p.run.initial, share == 0 ? 0.5 : share);
            auto const part = part_of(d, p.prior, share);
            check_containment(d, p, *(*taylor)(initial, part), samples);
            for (auto const& one : (*taylor)(initial, std::vector<box>{part, p.prior, part}))
                check_containment(d, p, *one, samples);
        }
        // points have a kernel of their own
        auto const initial = part_of(d, p.run.initial, 0.0);
        auto const part = part_of(d, p.prior, 0.0);
        auto const point = (*make_run(*p.equations, p.run, p.run.measurements, initial, part,
                                      feasibility_test_options{}.witness))(initial, part);
        CHECK(point->table->size() == 1);
        check_containment(d, p, *point, 1);
    }
}

} // namespace

TEST_CASE("every kernel contains the outputs of models of every size") { check_kernels(1, 5); }

TEST_CASE("every kernel contains the outputs of models of every size, many draws", "[.long]") {
    for (std::uint64_t seed = 2; seed < 22; ++seed) check_kernels(seed, 100);
}

TEST_CASE("first-order sets contain the outputs and agree with Taylor models") {
    draws d(3);
    run_options first;
    first.set = carried_set::doubleton;
    first.tolerance = 1e-9;
    for (auto const& p : some_models()) {
        INFO(p.name);
        auto const initial = part_of(d, p.run.initial, 0.02);
        auto const part = part_of(d, p.prior, 0.02);
        auto const linear =
            (*make_run(*p.equations, p.run, p.run.measurements, p.prior, first))(initial, part);
        auto const taylor =
            (*make_run(*p.equations, p.run, p.run.measurements, p.prior, {}))(initial, part);
        check_containment(d, p, *linear, 4);
        check_containment(d, p, *taylor, 4);
        auto const a = output_ranges(*linear, part);
        auto const b = output_ranges(*taylor, part);
        for (std::size_t y = 0; y < a.size(); ++y) {
            CAPTURE(y);
            REQUIRE_FALSE(is_empty(intersect(a[y], b[y])));
            // both are enclosures of one narrow set: neither is many times the other
            REQUIRE(width(b[y]) <= 2 * width(a[y]) + 1e-5);
        }
        for (int sample = 0; sample < 4; ++sample) {
            auto const q = corner_or_inner(d, linear->unknowns.variables);
            for (std::size_t y = 0; y < a.size(); ++y) {
                REQUIRE(std::fabs(polynomial(*linear, y, q) - polynomial(*taylor, y, q)) <=
                        linear->radius[y] + taylor->radius[y] + 1e-15L);
            }
        }
    }
}

TEST_CASE("parts of a record side by side contain their outputs, each from its own begin") {
    draws d(6);
    auto p = some_models()[8]; // with inputs that change
    REQUIRE(p.name == "6: sampled input");
    std::vector<experiment> parts;
    std::vector<problem> own;
    for (int k = 0; k < 11; ++k) { // more than there are lanes
        auto q = p;
        q.run.begin = 0.15 * k;
        q.run.initial = k == 4 ? part_of(d, p.run.initial, 0.0) : part_of(d, p.run.initial, 0.5);
        q.run.measurements.clear();
        q.times.clear();
        for (int i = 1; i <= 1 + k % 4; ++i) {
            q.times.push_back(q.run.begin + 0.2 * i);
            for (std::size_t y = 0; y < 2; ++y) {
                q.run.measurements.push_back({q.times.back(), y, between(-1e3, 1e3)});
            }
        }
        parts.push_back(q.run);
        own.push_back(q);
    }
    auto const answers = run_parts(*p.equations, parts, p.prior, {});
    REQUIRE(answers.size() == parts.size());
    for (std::size_t k = 0; k < parts.size(); ++k) check_containment(d, own[k], *answers[k], 8);
    // One by one they say about the same.
    for (std::size_t const k : {0U, 4U, 7U}) {
        auto const alone = run_parts(*p.equations, {parts[k]}, p.prior, {});
        check_containment(d, own[k], *alone[0], 8);
        auto const a = output_ranges(*alone[0], p.prior), b = output_ranges(*answers[k], p.prior);
        for (std::size_t y = 0; y < a.size(); ++y) {
            CHECK(width(b[y]) < 1.01 * width(a[y]) + 1e-9);
            CHECK(width(a[y]) < 1.01 * width(b[y]) + 1e-9);
        }
    }
    CHECK(run_parts(*p.equations, {}, p.prior, {}).empty());
    // Where nothing is unknown they are points.
    auto const point = part_of(d, p.prior, 0.0);
    auto const known = run_parts(*p.equations, {parts[4], parts[4]}, point, {});
    for (auto const& answer : known) check_containment(d, own[4], *answer, 1);
}

TEST_CASE("boxes alone, few and many together contain their outputs, and say about the same") {
    draws d(7);
    for (auto const& p : some_models()) {
        auto const samples = sorted(p.run.measurements);
        auto const run = make_run(*p.equations, p.run, samples, p.prior, {});
        std::vector<box> boxes;
        for (int k = 0; k < 8; ++k) boxes.push_back(part_of(d, p.prior, 0.3));
        auto const many = (*run)(p.run.initial, boxes);
        for (std::size_t const count : {1U, 2U, 5U}) {
            auto some = boxes;
            some.resize(count);
            auto const few = (*run)(p.run.initial, some);
            REQUIRE(few.size() == count);
            for (std::size_t k = 0; k < count; ++k) {
                CAPTURE(p.name, count, k);
                check_containment(d, p, *few[k], 3);
                auto const a = output_ranges(*few[k], boxes[k]);
                auto const b = output_ranges(*many[k], boxes[k]);
                REQUIRE(a.size() == b.size());
                for (std::size_t y = 0; y < a.size(); ++y) {
                    CHECK(width(a[y]) < 1.02 * width(b[y]) + 1e-9);
                    CHECK(width(b[y]) < 1.02 * width(a[y]) + 1e-9);
                }
            }
        }
    }
}

TEST_CASE("a part of a box: the response of the whole stays valid for it") {
    draws d(4);
    auto const p = some_models()[2];
    auto const whole =
        (*make_run(*p.equations, p.run, p.run.measurements, p.prior, {}))(p.run.initial, p.prior);
    for (int trial = 0; trial < 10; ++trial) {
        auto const part = part_of(d, p.prior, 0.3);
        auto const ranges = output_ranges(*whole, part);
        for (int sample = 0; sample < 4; ++sample) {
            auto const exact =
                p.exact(support::extend(d.in(p.run.initial)), support::extend(d.in(part)));
            for (std::size_t y = 0; y < ranges.size(); ++y) {
                auto const x = exact[y / 2][y % 2];
                REQUIRE(support::encloses_reference(ranges[y], x));
            }
        }
    }
}

TEST_CASE("a run ends where it fails, where enough measurements fail, or where nothing is known") {
    auto p = some_models()[2];
    auto const result = [&] {
        return (*make_run(*p.equations, p.run, p.run.measurements, p.prior, {}))(p.run.initial,
                                                                                 p.prior);
    };
    // The second measurement cannot hold: the group of its time is the last.
    p.run.measurements[1].bound = between(100, 101);
    REQUIRE(result()->outputs() == 2);
    p.run.outliers = 1;
    REQUIRE(result()->outputs() == p.run.measurements.size());
    REQUIRE(result()->allowed == 1);
    REQUIRE(result()->measurements == p.run.measurements.size());
    // A box over which no single set can be integrated.
    p.run.initial[0] = between(-200, 200);
    auto const hopeless = result();
    REQUIRE(hopeless->outputs() < p.run.measurements.size());
    for (auto const& range : output_ranges(*hopeless, p.prior)) REQUIRE_FALSE(is_empty(range));
}

TEST_CASE("measurements at the begin, and several of one channel at one time") {
    auto p = some_models()[0];
    p.run.measurements = {{0, 0, between(-9, 9)},
                          {0, 0, between(-9, 9)},
                          {0, 1, between(2, 3)},
                          {0.5, 1, between(-9, 9)}};
    for (auto const kind : {carried_set::taylor_model, carried_set::doubleton}) {
        run_options options;
        options.set = kind;
        auto const answer = (*make_run(*p.equations, p.run, p.run.measurements, p.prior, options))(
            p.run.initial, p.prior);
        REQUIRE(answer->outputs() >= 3);
        auto const ranges = output_ranges(*answer, p.prior);
        REQUIRE(subset(p.run.initial[0], ranges[0]));
        REQUIRE(width(ranges[0]) < width(p.run.initial[0]) + 1e-9);
        REQUIRE(contains(ranges[2], 2.4));
    }
}

TEST_CASE("inputs that change fast may be followed in shorter steps than were asked for") {
    auto const shortest = [](sivid::experiment const& e, double asked) {
        return sivid::paving_detail::steps_for(e, {.minimum_step = asked}).minimum_step;
    };
    for (double const unit : {1.0, 0x1p-10, 0x1p20}) { // a second in the unit
        sivid::experiment e;
        e.measurements = {{unit, 0, {0, 1}}};
        auto const input = [unit](std::vector<double> times, sivid::interpolation how) {
            for (double& t : times) t *= unit;
            return sivid::sampled_signal(times, {1, 2, 3}, how);
        };
        CHECK(shortest(e, 1e-3) == 1e-3);
        e.inputs = {input({0, 0.05, 0.1}, sivid::interpolation::hold)};
        CHECK_THAT(shortest(e, 1e-3), WithinRel(1e-3, 1e-12));
        CHECK(shortest(e, 1e-6) == 1e-6);
        e.inputs.push_back(input({0, 0.005, 0.01}, sivid::interpolation::linear));
        CHECK_THAT(shortest(e, 1e-3), WithinRel(1e-5, 1e-12));
        e.inputs = {input({0, 1e-9, 1}, sivid::interpolation::linear)};
        CHECK(shortest(e, 1e-3) == 1e-7);
    }
}

TEST_CASE("steps go with what a record lasts, or with its inputs while nothing is measured") {
    using sivid::paving_detail::steps_for;
    sivid::enclosure_options const asked{.minimum_step = 1e-3};
    sivid::experiment e;
    e.begin = 2;
    for (double const lasts : {0x1p-10, 1.0, 30.0, 1e6}) {
        e.measurements = {{2 + lasts, 0, {0, 1}}};
        CHECK(steps_for(e, asked).minimum_step == asked.minimum_step);
        CHECK(steps_for(e, asked).span == lasts);
    }
    e.measurements.clear();
    e.inputs = {sivid::sampled_signal({2, 500, 1002}, {1, 2, 3}, sivid::interpolation::hold)};
    CHECK(steps_for(e, asked).span == 1000);
}

TEST_CASE("runs in scalars enclose the outputs of all parameters and starts") {
    draws d(3301);
    std::size_t compared = 0;
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        for (double const spread : {0.0, 0.03}) {
            auto const planted =
                support::plant(d, model, {.samples = 10, .noise = 0.1, .spread = spread});
            auto const& problem = planted.problem;
            auto const& e = problem.experiments[0];
            flow const f(problem.model, problem.choice, e.inputs);
            auto const samples = sorted(e.measurements);
            auto const run = make_scalar_run(f, e, samples, e.initial, problem.prior, {});
            auto part = problem.prior;
            for (std::size_t j = 0; j < part.size(); ++j) {
                double const w = 0.02 * width(part[j]);
                part[j] = intersect(part[j], interval(planted.truth[j] - w, planted.truth[j] + w));
            }
            auto const known = (*run)(e.initial, part);
            for (int k = 0; k < 5; ++k) {
                auto const p = k == 0 ? planted.truth : d.in(part);
                auto const start = k == 0 ? planted.starts[0] : d.in(e.initial);
                auto const y = planted.simulate(0, p, start);
                auto const ranges = output_ranges(*known, point_within(part, p));
                for (std::size_t i = 0; i < ranges.size(); ++i, ++compared) {
                    REQUIRE(ranges[i].lower() - 1e-9 <= y[i]);
                    REQUIRE(y[i] <= ranges[i].upper() + 1e-9);
                }
            }
        }
    }
    CHECK(compared >= 500);
}
