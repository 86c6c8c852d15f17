// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/broken_relation.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

#include "../../../../examples/hovercraft/model.hpp"
#include "support/sweep.hpp"

using namespace diagnosis_support;

namespace {

/// Experiments of `truth` told about to a problem with `model`.
struct planting {
    std::vector<std::size_t> shown{0, 1};
    noise kind = noise::uniform;
    double error = 0.02;
    std::vector<double> shift{};
    double duration = 4;
};
identification_problem plant(draws& d, recorded_model const& truth, recorded_model const& model,
                             box const& prior, std::vector<double> const& p,
                             planting const& how = {}) {
    identification_problem problem{model, {support::all_constants(prior.size()), {}}, prior, {}};
    for (std::size_t e = 0; e < 2; ++e) {
        std::vector<sampled_signal> const inputs{
            sine_input(d.uniform(1, 3), d.uniform(1, 3), how.duration)};
        auto const motion =
            simulate(truth, p, inputs, {d.uniform(-1, 1), d.uniform(-1, 1)}, how.duration);
        problem.experiments.push_back(measured(d, support::numbered('S', e), motion, inputs,
                                               how.shown, how.error, how.kind, how.shift));
    }
    return problem;
}
box const pendulum_prior{between(1, 10), between(0, 1), between(0.5, 2)};
std::vector<double> pendulum_truth(draws& d) {
    return {d.uniform(2, 8), d.uniform(0.1, 0.9), d.uniform(0.7, 1.8)};
}
std::string names_of_broken(identification_problem const& problem) {
    std::string text;
    for (auto const& f : find_broken_relations(problem)) text += f.name + " ";
    return text;
}

} // namespace

TEST_CASE("a model that holds is never refuted, whatever the noise within its bounds") {
    draws d(30);
    for (int n = 0; n < support::swept(80, 240); ++n) {
        auto const kind = static_cast<noise>(n % 4);
        auto const p = pendulum_truth(d);
        planting how{{0, 1}, kind, d.coin() ? 0.02 : 0.002, {}, 3};
        if (n % 5 == 0) how.shown = {0};
        auto const problem = plant(d, pendulum(), pendulum(), pendulum_prior, p, how);
        for (auto const& f : examine_relations(problem)) {
            CHECK_FALSE(f.proved);
            CHECK(f.margin <= 0);
            if (f.missing) CHECK(contains(f.missing->value, 0));
        }
    }
}

TEST_CASE("friction that nobody modelled breaks the pendulum's second equation only") {
    draws d(31);
    int found = 0;
    for (int n = 0; n < 20; ++n) {
        auto const p = pendulum_truth(d);
        auto const problem = plant(d, pendulum(0.8), pendulum(), pendulum_prior, p);
        auto const broken = find_broken_relations(problem);
        for (auto const& f : broken) {
            CHECK(f.equation == 1);
            CHECK(f.name == "x1");
            CHECK(f.channels == std::vector<std::string>{"y0", "y1"});
            CHECK(f.margin > 0);
            CHECK(f.windows.size() <= 4); // three coefficients
            CHECK_FALSE(f.windows.empty());
            CHECK_FALSE(f.assumptions.empty());
            REQUIRE(f.missing);
            CHECK(f.missing->unit == "1/s");
        }
        found += broken.empty() ? 0 : 1;
    }
    CHECK(found >= 18);
}

TEST_CASE("a sensor that lies breaks the relations in whose rows it stands") {
    draws d(32);
    auto const p = pendulum_truth(d);
    planting how;
    how.error = 0.01;
    how.shift = {0, 0.15}; // the rate's sensor is biased
    auto const problem = plant(d, pendulum(), pendulum(), pendulum_prior, p, how);
    auto const broken = find_broken_relations(problem);
    bool kinematic = false;
    for (auto const& f : broken) kinematic = kinematic || f.equation == 0;
    CHECK(kinematic);
    for (auto const& f : broken) {
        CHECK(std::find(f.channels.begin(), f.channels.end(), "y1") != f.channels.end());
    }
}

TEST_CASE("a proof names the starts wherever it rests on them") {
    // x1 is read once a second: until then its start tells where it is, in windows of x0, too.
    auto const m = support::model_of({2, 2, 1, 100},
                                     [](auto const&, auto const& x, auto const& p, auto const& u) {
                                         return std::vector{p[0] * x[1], p[1] * (u[0] - x[1])};
                                     });
    std::vector<sampled_signal> const inputs{{{0, 10}, {1, 1}, interpolation::linear}};
    auto const truth = simulate(m, {1, 0.5}, inputs, {0, 1}, 6, 0.0025);
    auto const lists = [](relation_finding const& f) {
        return std::find(f.assumptions.begin(), f.assumptions.end(),
                         "initial states in their boxes") != f.assumptions.end();
    };
    for (double const first : {0.0, 1.0}) { // with a reading at the begin both are intersected
        for (double const wrong : {0.0, 5.0}) {
            identification_problem problem{
                m, {support::all_constants(2), {}}, box{between(0.8, 1.2), between(0.4, 0.6)}, {}};
            experiment e{"S", {inputs[0]}, 0, box{between(-50, 50), around(1 + wrong, 0.01)}, {},
                         0};
            for (int k = 1; k < 60; ++k)
                e.measurements.push_back({k * 0.1, 0, around(truth.at(k * 0.1)[0], 0.01)});
            for (double t = first; t < 6; t += 1)
                e.measurements.push_back({t, 1, around(truth.at(t)[1], t == 0 ? 20 : 0.01)});
            problem.experiments.push_back(e);
            for (auto const& f : examine_relations(problem)) {
                CHECK(f.proved == (wrong > 0));
                if (f.proved) CHECK(lists(f));
            }
        }
    }
    // Where all that is used has been read before, they do not count.
    draws d(38);
    auto const p = pendulum_truth(d);
    auto const broken = find_broken_relations(plant(d, pendulum(2), pendulum(), pendulum_prior, p));
    REQUIRE(broken.size() == 1);
    bool begins = false;
    for (auto const& w : broken[0].windows) begins = begins || w.from == 0;
    CHECK(lists(broken[0]) == begins);
}

TEST_CASE("what is missing is enclosed over time") {
    draws d(33);
    // A constant push of 1 that the model lacks; it knows its coefficients.
    auto const truth = support::model_of(
        {2, 3, 1, 20}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            using T = std::decay_t<decltype(x[0])>;
            return std::vector<T>{x[1], p[2] * u[0] - p[0] * sin(x[0]) - p[1] * x[1] + T(1.0)};
        });
    std::vector<double> const p{4, 0.5, 1};
    box const prior{between(3.99, 4.01), between(0.49, 0.51), between(0.99, 1.01)};
    auto const problem = plant(d, truth, pendulum(), prior, p);
    relation_examiner examiner(problem);
    auto& windows = examiner.windows();
    REQUIRE(windows.obstacle(1).empty());
    std::size_t seen = 0;
    for (auto const& w : windows.all(1, window_way::direct)) {
        if (w.to - w.from < 1 || w.to - w.from > 1.2) continue;
        relation_window const at{windows.motion(w.motion).name, w.from, w.to};
        auto const lacks = examiner.missing_over(1, at);
        REQUIRE(lacks);
        CHECK(contains(*lacks, 1));
        CHECK(width(*lacks) < 1);
        if (auto const none = examiner.missing_over(0, at)) CHECK(contains(*none, 0));
        ++seen;
    }
    CHECK(seen > 40);
    auto const finding = examiner.examine(1);
    CHECK(finding.proved);
    REQUIRE(finding.missing);
    CHECK(contains(finding.missing->value, 1));
    CHECK(finding.margin > 1);
}

TEST_CASE("margins below the least one are not called proofs") {
    draws d(34);
    auto const p = pendulum_truth(d);
    auto const problem = plant(d, pendulum(0.8), pendulum(), pendulum_prior, p);
    relation_options strict;
    strict.least_margin = 1e6;
    CHECK(find_broken_relations(problem, strict).empty());
    for (auto const& f : examine_relations(problem, strict)) {
        CHECK_FALSE(f.proved);
        CHECK(f.windows.empty());
    }
}

TEST_CASE("outlier budgets leave nothing to prove") {
    draws d(35);
    auto const p = pendulum_truth(d);
    auto problem = plant(d, pendulum(0.8), pendulum(), pendulum_prior, p);
    for (auto& e : problem.experiments) e.outliers = 3;
    CHECK(find_broken_relations(problem).empty());
    for (auto const& f : examine_relations(problem))
        CHECK_THAT(f.reason, ContainsSubstring("outlier"));
    relation_examiner examiner(problem);
    CHECK_FALSE(examiner.missing_over(1, {"S0", 0, 1}));
}

namespace {

/// The hovercraft in three manoeuvres, with `truth` at the wheel and all states measured.
identification_problem drive(draws& d, recorded_model const& truth, noise kind,
                             std::vector<double> const& shift = {},
                             std::vector<std::size_t> const& shown = {0, 1, 2, 3, 4, 5}) {
    auto const model = record_model<hovercraft>();
    identification_problem problem{
        model,
        {{"Sv", "Sg", "L"}, {}},
        box{between(0.2, 0.25), between(0.0042, 0.0754), between(0.25, 0.35)},
        {}};
    std::vector<double> constants;
    for (auto const& c : truth.about.constants) constants.push_back(c.nominal.nearest);
    struct plan {
        double duration, motor, rudder, pace, u;
    };
    std::size_t number = 0;
    for (plan const& s : {plan{1, 250, 0, 1, 0.1}, plan{6, 0, 0, 1, 2}, plan{5, 90, 0.5, 1.5, 1}}) {
        auto const rudder = sine_input(s.rudder, s.pace, s.duration);
        std::vector<sampled_signal> const inputs{
            {rudder.times(), std::vector<double>(rudder.times().size(), s.motor),
             interpolation::linear},
            rudder};
        auto const motion = simulate(truth, constants, inputs, {s.u, 0, 0, 0, 0, 0}, s.duration);
        auto e = measured(d, support::numbered('S', ++number), motion, inputs, {}, 0.02, kind);
        for (auto const i : shown) {
            double const error = i == 2 ? 0.05 : i == 5 ? 0.03 : 0.02;
            auto const one = measured(d, e.name, motion, inputs, {i}, error, kind, shift);
            e.measurements.insert(e.measurements.end(), one.measurements.begin(),
                                  one.measurements.end());
        }
        problem.experiments.push_back(std::move(e));
    }
    return problem;
}
/// The hovercraft with something added to its rates.
template <class F>
recorded_model hovercraft_with(F const& more) {
    auto m = record_model<hovercraft>();
    auto& g = m.g;
    std::vector<expression> x, u;
    for (std::size_t i = 0; i < 6; ++i) x.emplace_back(g, g.leaf(operation::state, i));
    for (std::size_t k = 0; k < 2; ++k) u.emplace_back(g, g.leaf(operation::input, k));
    std::vector<expression> const extra = more(x, u);
    for (std::size_t i = 0; i < extra.size(); ++i) {
        m.rate[i] = g.add(m.rate[i], extra[i].in(g));
    }
    return m;
}

} // namespace

TEST_CASE("the hovercraft as modelled has no broken relation") {
    draws d(36);
    for (auto const kind : {noise::uniform, noise::at_the_bounds, noise::offset, noise::slow}) {
        CHECK(names_of_broken(drive(d, record_model<hovercraft>(), kind)).empty());
    }
    CHECK(names_of_broken(drive(d, record_model<hovercraft>(), noise::uniform, {}, {3, 4, 5}))
              .empty());
}

TEST_CASE("effects on the hovercraft break the relations they act on") {
    draws d(37);
    auto const zero = expression(0.0);
    SECTION("a thruster beside the axis: yaw") {
        auto const aside = [&](double k) {
            return hovercraft_with([&, k](auto const&, auto const& u) {
                return std::vector<expression>{zero, zero, sqr(u[0]) * k};
            });
        };
        CHECK(names_of_broken(drive(d, aside(2e-5), noise::uniform)) == "yaw ");
        // With poses only, through the heading.
        auto const poses =
            find_broken_relations(drive(d, aside(6e-5), noise::uniform, {}, {3, 4, 5}));
        REQUIRE(poses.size() == 1);
        CHECK(poses[0].name == "yaw");
        CHECK(poses[0].channels == std::vector<std::string>{"psi"});
    }
    SECTION("linear damping: surge") {
        auto const m = hovercraft_with(
            [&](auto const& x, auto const&) { return std::vector<expression>{x[0] * -0.2}; });
        auto const broken = find_broken_relations(drive(d, m, noise::uniform));
        REQUIRE(broken.size() == 1);
        CHECK(broken[0].name == "surge");
        CHECK(broken[0].channels.size() >= 3);
        REQUIRE(broken[0].missing);
        CHECK(broken[0].missing->unit == "m/s^2");
        CHECK(broken[0].missing->value.upper() < 0);
    }
    SECTION("a gyro bias: all that use the gyro, nothing else") {
        auto const broken = find_broken_relations(
            drive(d, record_model<hovercraft>(), noise::uniform, {0, 0, 0.2, 0, 0, 0}));
        CHECK(broken.size() >= 2);
        for (auto const& f : broken) {
            CHECK(std::find(f.channels.begin(), f.channels.end(), "r") != f.channels.end());
        }
    }
}

TEST_CASE("inputs with error bounds leave nothing to prove") {
    draws d(35);
    auto const truth = record_model<hovercraft>();
    auto problem = drive(d, truth, noise::uniform);
    for (auto& e : problem.experiments) {
        for (auto& input : e.inputs) {
            auto const& u = std::get<sampled_signal>(input);
            input = sampled_signal(u.times(), u.values(), u.kind(),
                                   std::vector<double>(u.times().size(), 0.01));
        }
    }
    CHECK(find_broken_relations(problem).empty());
    for (auto const& f : examine_relations(problem))
        CHECK_THAT(f.reason, ContainsSubstring("error bounds"));
}
