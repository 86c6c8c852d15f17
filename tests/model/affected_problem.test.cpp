// SPDX-License-Identifier: MIT
#include <sivid/approximate/fit/fit.hpp>
#include <sivid/model/affected_problem.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

using namespace sivid;
using namespace sivid::literals;

TEST_CASE("an affected problem has the effects' parameters as further unknowns") {
    auto const base = small_campaign::problem();
    auto const p = affected(base, {effects::linear_damping("drag", "v", {0_dec, 0.5_dec}),
                                   effects::input_lag("lag", "u", "N", {0.1_dec, 1_dec}, 5)});
    CHECK(p.choice.unknown == std::vector<std::string>{"k", "drag.k", "lag.tau"});
    REQUIRE(p.prior.size() == 3);
    CHECK(contains(p.prior[2], 0.1));
    CHECK(p.prior[1].upper() == 0.5);
    for (auto const& e : p.experiments) {
        REQUIRE(e.initial.size() == 3);
        CHECK(e.initial[2].lower() == 1);
        CHECK(e.initial[2].upper() == 1);
    }
    p.require_valid();
    CHECK(affected(base, {}).prior.size() == 1);
}

TEST_CASE("effects are switched on in the experiments in which they act") {
    auto const base = small_campaign::problem();
    auto const drag = effects::linear_damping("drag", "v", {0_dec, 0.5_dec});
    auto const slope = effects::constant_rate("slope", "v", "m/s^2", {-1_dec, 1_dec});
    auto const p =
        affected(base, {only_within(drag, {"E2"}), slope, only_within(slope, {"E1", "E2"})});
    CHECK(p.choice.unknown ==
          std::vector<std::string>{"k", "drag@E2.k", "slope.a", "slope@E1+E2.a"});
    p.require_valid();
    for (std::size_t e = 0; e < 2; ++e) {
        auto const& inputs = p.experiments[e].inputs;
        REQUIRE(inputs.size() == 3);
        CHECK(input_at(inputs[1], 0).lower() == (e == 1 ? 1 : 0));
        CHECK(input_at(inputs[2], 0).lower() == 1);
    }
    // With the effect everywhere, and with one that acts in all experiments, runs are the same.
    auto const at = [&base](effect const& e) {
        auto const problem = affected(base, {e});
        return approximate_fitter(problem).at({1.1, 0.3}, {{0, 0}, {0, 0.5}}).residuals;
    };
    CHECK(at(drag) == at(only_within(drag, {"E1", "E2"})));
    auto const second = at(only_within(drag, {"E2"}));
    CHECK(second[1] == at(drag)[1]);
    CHECK(second[0] == approximate_fitter(base).at({1.1}, {{0, 0}, {0, 0.5}}).residuals[0]);
}

TEST_CASE("an effect that begins later is none before, and acts from then on") {
    auto const base = small_campaign::problem();
    CHECK(measured_time(base.experiments[0]).lower() == 0);
    CHECK(measured_time(base.experiments[0]).upper() == 4);
    auto const drag = effects::linear_damping("drag", "v", {0_dec, 0.5_dec});
    auto const at = [&base](effect const& e) {
        auto const problem = affected(base, {e});
        problem.require_valid();
        return approximate_fitter(problem).at({1.1, 0.3}, {{0, 0}, {0, 0.5}}).residuals;
    };
    auto const without = approximate_fitter(base).at({1.1}, {{0, 0}, {0, 0.5}}).residuals;
    auto const always = at(drag);
    double const never = 9;
    for (double const t : {1.0, 1.23}) { // a sample, between two
        auto const some = at(only_within(drag, {"E1", "E2"}, {t, never}));
        auto const data = sorted(base.experiments[0].measurements);
        for (std::size_t k = 0; k < data.size(); ++k) {
            CAPTURE(t, data[k].time);
            double const off = std::abs(some[0][k] - without[0][k]);
            CHECK((data[k].time <= t ? off < 1e-6 : off > 1e-3));
        }
        CHECK_THAT(some[1].back(), Catch::Matchers::WithinAbs(without[1].back(), 1e-6));
    }
    // At its begin or before: the same as always, by the same model.
    CHECK(at(only_within(drag, {"E1", "E2"}, {0, -1})) == always);
    CHECK(at(only_within(drag, {"E1", "E2"}, {effect::from_start, effect::from_start})) == always);
}

TEST_CASE("starts of added states follow the parameters they depend on") {
    auto base = small_campaign::problem();
    auto p = affected(base, {effects::input_lag("lag", "u", "N", {0.1_dec, 1_dec}, 5),
                             effects::input_dead_band("band", "u", "N", {0_dec, 0.25_dec})});
    // 1 - b
    CHECK(p.experiments[0].initial[2].lower() == 0.75);
    CHECK(p.experiments[0].initial[2].upper() == 1);
    CHECK(p.choice.unknown[1] == "lag.tau"); // in the order of writing
    CHECK(starts_follow_parameters(p));
    p.prior[2] = interval(0.125);
    start_added_states(p);
    CHECK_FALSE(starts_follow_parameters(p));
    CHECK(p.experiments[0].initial[2].lower() == 0.875);
    CHECK(p.experiments[0].initial[2].upper() == 0.875);
}

TEST_CASE("analytic inputs are read at the begin") {
    auto base = small_campaign::problem();
    base.experiments[0].inputs = {
        analytic_signal::from([](auto const& t) { return 0.5 + t * sin(t); })};
    auto const p = affected(base, {effects::input_lag("lag", "u", "N", {0.1_dec, 1_dec}, 5)});
    CHECK(p.experiments[0].initial[2].lower() == 0.5);
    base.experiments[0].inputs = {analytic_signal::from([](auto const& t) { return 1 / t; })};
    CHECK_THROWS_AS(affected(base, {effects::input_lag("lag", "u", "N", {0.1_dec, 1_dec}, 5)}),
                    std::domain_error);
}

TEST_CASE("a state that starts at an uncertain input starts within its error") {
    auto base = small_campaign::problem();
    base.experiments[0].inputs = {
        sampled_signal({0, 5}, {1, 2}, interpolation::linear, {0.25, 0.5})};
    auto const p = affected(base, {effects::input_lag("lag", "u", "N", {0.1_dec, 1_dec}, 5)});
    CHECK(p.experiments[0].initial[2].lower() == 0.75);
    CHECK(p.experiments[0].initial[2].upper() == 1.25);
}

TEST_CASE("a state that starts at a derived constant starts where its formula says") {
    auto base = small_campaign::problem();
    auto& m = base.model;
    auto const k = index_of(m.about.constants, "k", "constant");
    auto const& nominal = m.about.constants[k].nominal;
    double const twice = 2 * nominal.nearest;
    m.about.constants.push_back({"h", "1", literal{interval(twice), twice}});
    model_detail::add_derived(m, "h", 2 * expression(m.g, m.g.leaf(operation::constant, k)));
    effect e;
    e.name = "memory";
    e.on_inputs = [](effect_scope& s) { s.add_state("w", "1", 9, s.constant("h")); };
    auto const p = affected(base, {e});
    REQUIRE(p.choice.unknown[0] == "k");
    CHECK(p.experiments[0].initial[2].lower() <= 2 * p.prior[0].lower());
    CHECK(p.experiments[0].initial[2].upper() >= 2 * p.prior[0].upper());
    CHECK(width(p.experiments[0].initial[2]) < 2.001 * width(p.prior[0]));
    CHECK(width(p.prior[0]) > 0);
}

TEST_CASE("what counted readings rest on is said of each effect that counts") {
    using namespace sivid::literals;
    auto const words = sivid::wrap_assumptions(
        {sivid::effects::input_gain("gain", "u", {0.5_dec, 2_dec}),
         sivid::effects::sensor_wrap("turned", "p", "m", {0_dec, 13_dec}, 3.25)});
    REQUIRE(words.size() == 1);
    CHECK_THAT(words[0], ContainsSubstring("p has wrapped") && ContainsSubstring("3.25") &&
                             ContainsSubstring("within half a turn of where it starts"));
}
