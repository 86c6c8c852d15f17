// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate/detail/sliced_input.hpp>

#include "diagnosis/late_position.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

#include <sivid/diagnosis/candidate/detail/hull_search.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/effects.hpp>

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

using namespace sivid;
using namespace sivid::literals;

namespace {

effect const late = effects::input_delay("late", "u", {0_dec, 0.5_dec});
effect const slow = effects::sensor_latency("slow", {"p"}, {0_dec, 0.5_dec});
effect const gap = effects::input_backlash("gap", "u", "N", {0_dec, 0.5_dec});
effect const dead = effects::input_dead_band("dead", "u", "N", {0_dec, 0.5_dec});
/// A motor that tires: the time stands in an equation.
effect tiring() {
    effect e;
    e.name = "tired";
    e.parameters = {{"a", "1/s", 0_dec, 0.2_dec, 0_dec}};
    e.on_inputs = [](effect_scope& m) { m.input("u") *= 1 - m.parameter() * m.time(); };
    return e;
}

/// A motor that is stronger than it should be, whatever reaches it.
effect stronger() {
    effect e;
    e.name = "more";
    e.parameters = {{"g", "1", 0_dec, 1_dec, 0_dec}};
    e.order = 5;
    e.on_inputs = [](effect_scope& m) { m.input("u") *= 1 + m.parameter(); };
    return e;
}

/// What is planted of each effect: milliseconds, newtons, per second.
struct planted {
    int late = 0, slow = 0;
    double gap = 0, dead = 0, tired = 0, more = 0;

    [[nodiscard]] double of(std::string name) const {
        if (auto const at = name.find('@'); at != name.npos) name.erase(at, name.find('.') - at);
        return name == "late.tau"   ? 0.001 * late
               : name == "slow.tau" ? 0.001 * slow
               : name == "gap.b"    ? gap
               : name == "dead.b"   ? dead
               : name == "tired.a"  ? tired
               : name == "more.g"   ? more
                                    : 1;
    }
};

/// Bounds that the truth nearly touches, on a side that chance decides; one sample is far off
/// where outliers are allowed.
identification_problem measured(planted const& true_ones, interpolation between,
                                std::size_t outliers, std::mt19937& chance) {
    small_campaign::truth real;
    real.between = between;
    real.delay = 0.001 * true_ones.late;
    real.play = true_ones.gap;
    // In their order: the dead band, or the tired motor, of what is late; then the stronger one.
    real.missing = [band = true_ones.dead, tired = true_ones.tired,
                    more = true_ones.more](double t, double, double u) {
        return (u - std::clamp(u, -band, band)) * (1 - tired * t) * (1 + more) - u;
    };
    auto problem = diagnosis_support::with_late_position(true_ones.slow, real);
    std::uniform_real_distribution<double> share(-0.385, 0.385); // 60 % are filled already
    for (auto& x : problem.experiments) {
        for (auto& m : x.measurements) {
            double const move = share(chance) * width(m.bound) / 2;
            m.bound = interval(m.bound.lower() + move, m.bound.upper() + move);
        }
        x.outliers = outliers;
        for (std::size_t k = 0; k < outliers; ++k) {
            auto& m = x.measurements[(17 * k + 40) % x.measurements.size()];
            m.bound = interval(m.bound.lower() + 3, m.bound.upper() + 3);
        }
    }
    return problem;
}

} // namespace

TEST_CASE("slices that hold the truth are never excluded, nor is it cut off") {
    // What else changes the input that is late sees what is late.
    std::vector<std::vector<effect>> const forms{{late, slow},
                                                 {slow, dead},
                                                 {gap, slow},
                                                 {slow},
                                                 {late},
                                                 {dead},
                                                 {slow, tiring()},
                                                 {late, dead},
                                                 {late, tiring()},
                                                 {dead, stronger()},
                                                 {late, slow, dead},
                                                 {slow, dead, stronger()},
                                                 {gap, dead}};
    std::mt19937 chance(20261125);
    std::uniform_real_distribution<double> some(0, 1);
    for (std::size_t n = 0; n < support::swept(std::size_t{26}, std::size_t{390}); ++n) {
        auto form = forms[n % forms.size()];
        auto const has = [&](char const* name) {
            return std::any_of(form.begin(), form.end(),
                               [&](effect const& e) { return e.name == name; });
        };
        planted true_ones;
        if (has("late")) true_ones.late = static_cast<int>(450 * some(chance));
        if (has("slow")) true_ones.slow = static_cast<int>(450 * some(chance));
        if (has("gap")) true_ones.gap = 0.4 * some(chance);
        if (has("dead")) true_ones.dead = 0.4 * some(chance);
        if (has("tired")) true_ones.tired = 0.15 * some(chance);
        if (has("more")) true_ones.more = 0.8 * some(chance);
        bool const band = has("dead") && !has("late") && !has("gap");
        auto const sides = std::size_t{has("late")} + has("slow") + has("gap") + band;
        auto const between = n % 2 == 0 || has("gap") ? interpolation::linear : interpolation::hold;
        std::size_t const outliers = n % 3 == 2 ? 1 : 0;
        auto base = measured(true_ones, between, outliers, chance);
        // The first effect in one experiment only, if it remembers.
        if ((n + n / forms.size()) % 4 >= 2 && form[0].name != "dead") {
            std::size_t const without = n % 2;
            auto others = true_ones;
            if (form[0].name == "late") others.late = 0;
            if (form[0].name == "slow") others.slow = 0;
            if (form[0].name == "gap") others.gap = 0;
            base.experiments[without] =
                measured(others, between, outliers, chance).experiments[without];
            form[0] = only_within(form[0], {base.experiments[1 - without].name});
        }
        auto const whole = affected(base, form);
        auto const sliced = sliced_input_of(base, form);
        REQUIRE(sliced);
        CHECK(sliced->sides.size() == sides);
        // The truth somewhere in a range, or at its end.
        auto all = whole.prior;
        for (auto const& side : sliced->sides) {
            double const at = true_ones.of(whole.choice.unknown[side.index]);
            double const size = 0.1 * some(chance);
            auto const turn = (n + n / forms.size()) % 4;
            double const where = turn == 0 ? 0 : turn == 1 ? 1 : some(chance);
            all[side.index] = intersect(interval(at - where * size, at + (1 - where) * size),
                                        whole.prior[side.index]);
        }
        auto const over = sliced->over(all);
        auto const found = hull_search({.seconds = 5, .boxes = 60})(over, 1);
        CAPTURE(n, true_ones.late, true_ones.slow, true_ones.gap, true_ones.dead, true_ones.tired,
                all);
        REQUIRE(found);
        auto const left = explained_by(whole, *sliced, {all}, over, *found);
        REQUIRE(left);
        for (std::size_t j = 0; j < whole.prior.size(); ++j) {
            CAPTURE(whole.choice.unknown[j], left->parameters[j]);
            CHECK(contains(left->parameters[j], true_ones.of(whole.choice.unknown[j])));
        }
    }
}

TEST_CASE("data that a sliced parameter does not touch stand alone") {
    auto problem = small_campaign::problem();
    CHECK_FALSE(sliced_input_of(problem, {late})->untouched); // both inputs move
    auto const only_speed = sliced_input_of(problem, {slow})->untouched;
    REQUIRE(only_speed);
    CHECK(only_speed->choice.unknown == std::vector<std::string>{"k"});
    for (auto const& x : only_speed->experiments)
        CHECK(std::all_of(x.measurements.begin(), x.measurements.end(),
                          [](auto const& m) { return m.channel == 1; }));
    auto const constant = [](double value, std::vector<double> errors = {}) {
        return sampled_signal({0, 2, 4}, {value, value, value}, interpolation::linear,
                              std::move(errors));
    };
    auto const kept = [&](effect const& e, signal const& u) {
        problem.experiments[1].inputs[0] = u;
        auto const rest = sliced_input_of(problem, {e})->untouched;
        return rest ? rest->experiments.size() : 0;
    };
    CHECK(kept(late, constant(0.3)) == 1);
    CHECK(kept(late, constant(0.3, {0, 0.1, 0})) == 0); // its errors come late, too
    CHECK(kept(dead, constant(0.3)) == 0);
    CHECK(kept(dead, constant(0)) == 1);
    CHECK(kept(gap, constant(0)) == 0);
    problem.experiments[1].outliers = 3;
    CHECK(sliced_input_of(problem, {dead})->untouched->experiments[0].outliers == 3);
}

TEST_CASE("which parameters are sliced") {
    auto const problem = small_campaign::problem();
    CHECK_FALSE(sliced_input_of(problem, {}));
    CHECK_FALSE(
        sliced_input_of(problem, {effects::constant_rate("slope", "v", "m/s^2", {-1_dec, 1_dec})}));
    CHECK_FALSE(sliced_input_of(problem, {late, gap})); // both change u
    auto const behind = sliced_input_of(problem, {dead, late});
    REQUIRE(behind); // a threshold of a late input is an ordinary parameter
    REQUIRE(behind->sides.size() == 1);
    CHECK(behind->sides[0].index == 2);
    auto const two = sliced_input_of(problem, {slow, dead});
    REQUIRE(two);
    CHECK(two->sides.size() == 2);
    auto formula = problem;
    formula.experiments[0].inputs[0] = analytic_signal::from([](auto const& t) { return t; });
    for (auto const& e : {late, dead, gap, slow}) CHECK_FALSE(sliced_input_of(formula, {e}));
}
