// SPDX-License-Identifier: MIT
// Legal problems that are built otherwise than most: one parameter in several places, an effect
// that does two things, readings that begin late, a saturation that acts here and there. The truth
// is planted, and has to stay.
#include <sivid/diagnosis/verification.hpp>
#include <sivid/model/affected_problem.hpp>

#include "diagnosis/late_position.hpp"
#include "diagnosis/planted_motion.hpp"
#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

#include <sivid/approximate/candidate/detail/wrapped_channels.hpp>
#include <sivid/diagnosis/candidate/detail/effect_hulls.hpp>
#include <sivid/diagnosis/candidate/detail/episode_hulls.hpp>
#include <sivid/diagnosis/sensor/detail/sensor_discharge.hpp>
#include <sivid/model/effects.hpp>
#include <sivid/paving/inflation.hpp>
#include <sivid/paving/inflation/detail/holdout_inflation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

using namespace sivid;
using namespace sivid::literals;

namespace {

effect slack(effect::edit on_inputs) {
    effect e;
    e.name = "slack";
    e.parameters = {{"tau", "s", 0_dec, 0.5_dec, 0_dec}};
    e.on_inputs = std::move(on_inputs);
    return e;
}

/// The truth explains, is not excluded by any program, and lies in the hulls.
void check_kept(identification_problem const& base, std::vector<effect> const& effects,
                std::vector<double> const& truth, std::vector<double> const& start = {}) {
    auto const whole = affected(base, effects);
    approximate_fit at;
    at.parameters = truth;
    for (auto const& x : whole.experiments) {
        at.starts.push_back(mid(x.initial));
        std::copy(start.begin(), start.end(), at.starts.back().begin());
    }
    REQUIRE(verify_at(whole, at).range.upper() <= 1);
    if (!whole.model.has_memory()) CHECK(bound_inflation(whole, &at, {}).value.lower() <= 1);
    auto const hull = effect_hulls(base, effects, {.seconds = 20}).parameters;
    for (std::size_t j = 0; j < truth.size(); ++j) {
        INFO(whole.choice.unknown[j] << " in [" << hull[j].lower() << ", " << hull[j].upper()
                                     << "], planted " << truth[j]);
        CHECK(contains(hull[j], truth[j]));
    }
}

/// The cart's input is cut at a limit that each experiment has, from some time on.
identification_problem cut_inputs(double first, double second, double from = 0) {
    auto p = small_campaign::problem();
    for (std::size_t e = 0; e < 2; ++e) {
        small_campaign::truth real;
        double const limit = e == 0 ? first : second, begin = e == 0 ? from : 0;
        real.missing = [limit, begin](double t, double, double force) {
            return t < begin ? 0.0 : std::clamp(force, -limit, limit) - force;
        };
        p.experiments[e].measurements = small_campaign::experiment(e, real).measurements;
    }
    return p;
}

/// a' = w, w' = k u - w/2; the angle is shown modulo a turn.
struct shaft {
    static constexpr auto name = "shaft";
    static constexpr auto states = sivid::states({{"a", "rad", 500}, {"w", "rad/s", 50}});
    static constexpr auto inputs = sivid::inputs({{"u", "N"}});
    static constexpr auto channels = sivid::channels({{"a", "rad"}, {"w", "rad/s"}});
    static constexpr auto constants = sivid::constants({{"k", "1", 1_dec}});
    template <class T>
    states_of<shaft, T> rate(T const&, states_of<shaft, T> const& x,
                             constants_of<shaft, T> const& c, inputs_of<shaft, T> const& u) const {
        return {x[1], c[0] * u[0] - 0.5 * x[1]};
    }
    template <class T>
    channels_of<shaft, T> observe(T const&, states_of<shaft, T> const& x,
                                  constants_of<shaft, T> const&, inputs_of<shaft, T> const&) const {
        return {x[0], x[1]};
    }
};

/// @param turn  which the readings are modulo; another one than 2 pi is of no angle
identification_problem turning_shaft(double at, interval const& start, double late,
                                     double slow_second = 4, double turn = 2 * std::numbers::pi) {
    identification_problem p{record_model(shaft{}), {{"k"}, {}}, box{interval(0.9, 1.1)}, {}};
    for (int e = 0; e < 2; ++e) {
        double const w = e == 0 ? 4 : slow_second;
        experiment x;
        x.name = support::numbered('E', static_cast<std::size_t>(e));
        x.inputs = {sampled_signal({0, 10}, {w / 2, w / 2}, interpolation::linear)};
        x.initial = box{start, interval(w)};
        for (int k = 1; k <= 60; ++k) {
            double const t = 0.05 * k;
            double const a = std::remainder(at + w * std::max(0.0, t - late), turn);
            x.measurements.push_back({t, 0, interval(a - 0.02, a + 0.02)});
            x.measurements.push_back({t, 1, interval(w - 0.03, w + 0.03)});
        }
        p.experiments.push_back(std::move(x));
    }
    return p;
}

} // namespace

TEST_CASE("an effect that delays an input, and does something else by the same parameter") {
    double const tau = 0.3;
    small_campaign::truth real;
    real.delay = tau;
    real.k = 1 - tau;
    auto base = small_campaign::problem(real);
    base.prior = box{interval(0.9, 1.1)};
    SECTION("it is weaker, too") {
        check_kept(base, {slack([](effect_scope& m) {
                       m.remember("u", memory_kind::delay);
                       m.input("u") *= 1 - m.parameter();
                   })},
                   {1, tau});
    }
    SECTION("it has a gain of its own") {
        check_kept(base, {slack([](effect_scope& m) {
                       m.remember("u", memory_kind::delay);
                       m.input("u") *= expression(0.7);
                   })},
                   {1, tau});
    }
    SECTION("it pulls at a rate") {
        auto e = slack([](effect_scope& m) { m.remember("u", memory_kind::delay); });
        e.on_rates = [](effect_scope& m) {
            m.rate("v") -= m.parameter() * m.constant("k") * m.input("u");
        };
        check_kept(base, {e}, {1, tau});
    }
    SECTION("from a time on") {
        for (std::size_t e = 0; e < 2; ++e) {
            small_campaign::truth own;
            own.delay = tau;
            own.from = 1.5;
            own.missing = [](double t, double, double force) {
                return t >= 1.5 ? -0.3 * force : 0.0;
            };
            base.experiments[e].measurements = small_campaign::experiment(e, own).measurements;
        }
        auto const e = slack([](effect_scope& m) {
            m.remember("u", memory_kind::delay);
            m.input("u") *= 1 - m.parameter();
        });
        auto const hull =
            hulls_of_episodes(base, only_within(e, {"E1", "E2"}, {1.5, 1.5}), {.seconds = 20});
        CHECK(contains(hull.parameters[0], 1));
        CHECK(contains(hull.parameters[1], tau));
    }
}

TEST_CASE("a late sensor that shows less by the same parameter") {
    auto base = diagnosis_support::with_late_position(300);
    for (auto& x : base.experiments) {
        for (auto& m : x.measurements) {
            double const less = 0.7 * mid(m.bound);
            if (m.channel == 0) m.bound = interval(less - 0.02, less + 0.02);
        }
    }
    effect e;
    e.name = "filter";
    e.parameters = {{"tau", "s", 0_dec, 0.5_dec, 0_dec}};
    e.on_channels = [](effect_scope& m) {
        m.show_late("p", memory_kind::delay);
        m.channel("p") *= 1 - m.parameter();
    };
    check_kept(base, {e}, {1, 0.3});
}

TEST_CASE("a saturation that acts in one experiment, or from a time on, leaves the others alone") {
    auto const limit = effects::input_saturation("sat", "u", "N", {0.1_dec, 0.6_dec});
    check_kept(cut_inputs(0.4, 100), {only_within(limit, {"E1"})}, {1, 0.4});
    check_kept(cut_inputs(0.4, 100, 1.5), {only_within(limit, {"E1"}, {1.5})}, {1, 0.4});
    auto base = small_campaign::problem();
    for (auto& m : base.experiments[0].measurements) {
        double const c = std::clamp(mid(m.bound), -0.2, 0.2);
        if (m.channel == 1) m.bound = interval(c - 0.03, c + 0.03);
    }
    auto const sensor = effects::sensor_saturation("cut", "v", "m/s", {0.05_dec, 0.4_dec});
    check_kept(base, {only_within(sensor, {"E1"})}, {1, 0.2});
}

TEST_CASE("readings that wrap from many turns on, and late") {
    double const turn = 2 * std::numbers::pi;
    auto const wrapped = [](identification_problem const& p) {
        return with_wrapped_channels(p, {});
    };
    auto const far = turning_shaft(20 * turn + 0.3, interval(20 * turn + 0.3), 0);
    check_kept(far, wrapped(far), {1, turn});
    for (double const second : {4.0, 0.1}) { // without a leap of its own, too
        auto const late = turning_shaft(0, interval(0.0), 0.1, second);
        auto effects = wrapped(late);
        effects.push_back(effects::sensor_latency("late", {"a"}, {0_dec, 0.5_dec}));
        check_kept(late, effects, {1, turn, 0.1});
    }
}

TEST_CASE("readings that wrap at what is no full turn, from many of these on") {
    // What T may be decides how often they had wrapped, not twice the least leap.
    auto const wraps = [](std::string const& unit, effects::range const& T, double least) {
        return effects::sensor_wrap("wraps", "a", unit, T, least);
    };
    auto counter = [](double at) {
        auto p = turning_shaft(at, interval(at), 0, 4, 3);
        p.model.about.channels[0].unit = "count";
        return p;
    };
    auto const near = counter(0.25), far = counter(300.25);
    check_kept(near, with_wrapped_channels(near, {}), {1, 3});
    check_kept(far, {wraps("count", {2.99_dec, 3.01_dec}, 1.4)}, {1, 3});
    CHECK(with_wrapped_channels(far, {}).empty()); // leaps tell T to a half
    CHECK_THROWS_WITH(affected(far, {wraps("count", {2.9_dec, 3.1_dec}, 1.4)}),
                      ContainsSubstring("effect 'wraps', experiment 'E0', channel 'a'") &&
                          ContainsSubstring("cannot be told"));
    CHECK_NOTHROW(affected(far, {only_within(wraps("count", {2.99_dec, 3.01_dec}, 1.4), {"E1"})}));
    // So does a half turn in rad.
    double const half = std::numbers::pi;
    auto const shaft = turning_shaft(10, interval(10.0), 0, 4, half);
    check_kept(shaft, {wraps("rad", {3.14_dec, 3.145_dec}, 1.5)}, {1, half});
}

TEST_CASE("turns that nobody can count are not counted") {
    double const turn = 2 * std::numbers::pi;
    auto const e = effects::sensor_wrap("wraps", "a", "rad", {6.28_dec, 6.29_dec}, 3);
    auto const refused = [&](identification_problem const& p, std::string const& why) {
        CHECK(with_wrapped_channels(p, {}).empty());
        CHECK_THROWS_WITH(affected(p, {e}), ContainsSubstring(why));
    };
    // Of a start that is known to half a turn or less, more than one number of them may be right.
    for (double const width : {50.0, 6.2, 3.5}) {
        auto const open = turning_shaft(0.1, interval(0.0, width), 0);
        refused(open, "give a narrower start");
    }
    auto const narrow = turning_shaft(0.1, interval(-1.0, 1.0), 0);
    check_kept(narrow, {e}, {1, turn}, {0.1});
    // Two readings at one time on both sides of a leap: it was not counted at all.
    auto twice = turning_shaft(0, interval(0.0), 0);
    auto& readings = twice.experiments[0].measurements;
    double const at = 0.7853, y = 4 * at; // just before half a turn
    for (double const noise : {-0.01, 0.01}) {
        double const a = std::remainder(y + noise, turn);
        readings.push_back({at, 0, interval(a - 0.02, a + 0.02)});
    }
    refused(twice, "on both sides of a leap at t = 0.7853");
    readings.pop_back();
    check_kept(twice, {e}, {1, turn});
}

TEST_CASE("a model's own delay is not scaled in silence") {
    auto p = small_campaign::problem();
    p.model.about.constants.push_back({"tau", "s", literal{interval(0.2), 0.2}});
    p.model.input_memory.push_back({0, 2, memory_kind::delay, {}});
    effect e;
    e.name = "slower";
    e.parameters = {{"k", "1", 0_dec, 1_dec, 0_dec}};
    e.on_inputs = [](effect_scope& m) { m.constant("tau") *= 1 + m.parameter(); };
    CHECK_THROWS_WITH(with(p.model, {e}), ContainsSubstring("'tau' is a delay or a play"));
}

namespace {

/// v' = p u - b v, w' = p f - b w, where b = 10 q follows from q.
struct two_carts {
    static constexpr auto name = "carts";
    static constexpr auto states = sivid::states({{"v", "m/s", 20}, {"w", "m/s", 20}});
    static constexpr auto inputs = sivid::inputs({{"u", "N"}, {"f", "N"}});
    static constexpr auto channels = sivid::channels({{"v", "m/s"}, {"w", "m/s"}});
    static constexpr auto constants =
        sivid::constants({{"p", "1", 1_dec}, {"q", "1", 0.2_dec}, {"b", "1", 2_dec}});
    template <class T>
    vec<T, 2> rate(T const&, vec<T, 2> const& x, vec<T, 3> const& c, vec<T, 2> const& u) const {
        return {c[0] * u[0] - c[2] * x[0], c[0] * u[1] - c[2] * x[1]};
    }
    template <class T>
    vec<T, 2> observe(T const&, vec<T, 2> const& x, vec<T, 3> const&, vec<T, 2> const&) const {
        return x;
    }
    template <class T>
    std::array<relation_of_constants<T>, 1> derived(vec<T, 3> const& c) const {
        return {{{"b", 10.0 * c[1]}}};
    }
};

} // namespace

TEST_CASE("a constant that follows from others does so in the problem of a suspected sensor") {
    auto const m = record_model(two_carts{});
    identification_problem p{
        m, {{"p", "q"}, {}}, box{interval(0.8, 1.2), interval(0.02, 0.05)}, {}};
    diagnosis_support::draws d(7);
    double const damping = 0.3, error = 0.005;
    for (double const pace : {1.1, 1.7}) {
        std::vector<sampled_signal> inputs;
        for (double const own : {pace, 0.9}) {
            std::vector<double> t, u;
            for (int k = 0; k <= 500; ++k) {
                t.push_back(k * 0.01);
                u.push_back((own == pace ? 2 : 1.5) * std::sin(own * t.back()));
            }
            inputs.emplace_back(t, u, interpolation::linear);
        }
        auto choice = p.choice;
        auto const truth = diagnosis_support::simulate(
            support::model_of({2, 1, 2, 20},
                              [](auto const&, auto const& x, auto const& c, auto const& u) {
                                  using T = std::decay_t<decltype(x[0])>;
                                  return std::vector<T>{u[0] - c[0] * x[0], u[1] - c[0] * x[1]};
                              }),
            {damping}, inputs, {0.5, -0.5}, 5, 0.001);
        experiment e;
        e.name = pace < 1.5 ? "A" : "B";
        e.inputs = {inputs[0], inputs[1]};
        e.initial = box{interval(0.5), interval(-0.5)};
        for (int k = 1; k <= 50; ++k) {
            auto const x = truth.at(0.1 * k); // the first sensor shows 9 % too much
            for (std::size_t y = 0; y < 2; ++y) {
                double const shown = (y == 0 ? 1.09 : 1.0) * x[y] + d.uniform(-0.9, 0.9) * error;
                e.measurements.push_back({0.1 * k, y, interval(shown - error, shown + error)});
            }
        }
        p.experiments.push_back(std::move(e));
    }
    auto const suspect = suspect_of(p, faults_of(p, {0, 1}, 0, {}), {}, 0, 0).problem.model;
    graph_range formula(suspect.g, {suspect.derived[0].value});
    box known(suspect.about.constants.size());
    known[1] = interval(0.5);
    formula.evaluate({interval(0.0), {}, known, {}});
    CHECK(contains(formula.value(suspect.derived[0].value), 5));
    for (auto const& f : find_broken_relations(p)) CHECK_FALSE(sensor_discharge(p)(f).has_value());
}

TEST_CASE("a delay does not follow from other constants in silence") {
    auto p = small_campaign::problem();
    p.model.input_memory.push_back({0, 1, memory_kind::delay, {}}); // d, for once
    CHECK_NOTHROW(p.require_valid());
    p.model.derived.push_back({1, p.model.g.leaf(operation::constant, 0), false});
    CHECK_THROWS_WITH(p.require_valid(), ContainsSubstring("'d' is a delay or a play"));
}

TEST_CASE("a start that is known within little is known within much of a small unit") {
    auto p = small_campaign::problem();
    for (auto& x : p.experiments) x.initial = box{interval(0, 4e-10), interval(0.0)};
    CHECK(has_uncertain_starts(p));
    for (auto& x : p.experiments) x.initial = box{interval(0.1), hull(0.1_dec, 0.1_dec)};
    CHECK_FALSE(has_uncertain_starts(p));
}

TEST_CASE("a campaign's experiments have names of their own") {
    auto p = small_campaign::problem();
    p.experiments[1].name = p.experiments[0].name;
    CHECK_NOTHROW(p.require_valid());
    CHECK_THROWS_WITH(p.require_valid_campaign(),
                      ContainsSubstring("two experiments are called 'E1'"));
    CHECK_THROWS_AS(sensor_discharge(p), std::invalid_argument);
    CHECK_THROWS_AS(examine_relations(p), std::invalid_argument);
}
