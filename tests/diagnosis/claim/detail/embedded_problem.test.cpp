// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/claim/detail/embedded_problem.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

#include <sivid/model/affected_problem.hpp>
#include <sivid/model/effects.hpp>

#include <vector>

using namespace sivid;
using namespace sivid::literals;
namespace any = sivid::effects;

namespace {

identification_problem with_effects(std::vector<effect> const& effects) {
    return affected(small_campaign::problem(), effects);
}
bool vanishes(effect const& e) {
    return embedded(small_campaign::problem(), with_effects({e})).has_value();
}
effect slope() { return any::constant_rate("slope", "v", "m/s^2", {-1_dec, 1_dec}); }
effect late() { return any::input_delay("late", "u", {0_dec, 0.5_dec}); }

} // namespace

TEST_CASE("effects of which nothing is left at their neutral values hold the model as it is") {
    for (auto const& e :
         std::vector<effect>{slope(),
                             late(),
                             any::input_clock_drift("clock", "u", {0_dec, 0.4_dec}),
                             any::input_dead_band("dead", "u", "N", {0_dec, 1_dec}),
                             any::input_backlash("play", "u", "N", {0_dec, 1_dec}),
                             any::input_trim("trim", "u", "N", {-1_dec, 1_dec}),
                             any::input_gain("gain", "u", {-0.5_dec, 0.5_dec}),
                             any::linear_damping("linear", "v", {0_dec, 1_dec}),
                             any::quadratic_damping("quadratic", "v", "1/m", {0_dec, 1_dec}),
                             any::dry_friction("dry", "v", "m/s^2", {0_dec, 1_dec}, 0_dec),
                             any::dry_friction("smooth", "v", "m/s^2", {0_dec, 1_dec}, 0.1_dec),
                             any::stribeck_friction("stick", "v", "m/s^2", {0_dec, 1_dec},
                                                    {0_dec, 1_dec}, 0.1_dec, 0.01_dec),
                             any::drift("ageing", "k", {-0.1_dec, 0.1_dec}),
                             any::sensor_bias("bias", "p", "m", {-1_dec, 1_dec}),
                             any::sensor_drift("creeps", "p", "m/s", {-1_dec, 1_dec}),
                             any::sensor_scale("scale", {"p"}, {-0.5_dec, 0.5_dec}),
                             any::sensor_swap("swap", {"p", "v"}, {0_dec, 1.1_dec}),
                             any::sensor_rotation("askew", {"p", "v"}, {-0.5_dec, 0.5_dec}),
                             any::sensor_latency("old", {"p"}, {0_dec, 0.5_dec}),
                             any::end_stop("stop", "p", "v", "1/s^2", {0_dec, 100_dec}, 1_dec,
                                           any::stop_side::upper),
                             widened(slope()),
                             only_within(slope(), {"E2"}),
                             only_within(late(), {"E2"}),
                             only_within(slope(), {"E1", "E2"}, {1, 2})}) {
        INFO(e.name);
        CHECK(vanishes(e));
    }
}

TEST_CASE("effects that leave something, or cannot be neutral, do not") {
    effect lies = slope(); // says that it vanishes at 0, and does not
    lies.on_rates = [](effect_scope& m) { m.rate("v") += 1 + m.parameter(); };
    effect elsewhere = slope();
    elsewhere.parameters[0].lower = 0.1_dec;
    effect undefined = slope(); // at 0 it has no value
    undefined.on_rates = [](effect_scope& m) { m.rate("v") += sqr(m.parameter()) / m.parameter(); };
    effect always;
    always.name = "always";
    always.on_rates = [](effect_scope& m) { m.rate("v") += 1; };
    for (auto const& e :
         std::vector<effect>{lies, elsewhere, undefined, always,
                             any::input_saturation("sat", "u", "N", {0.2_dec, 2_dec}),
                             any::sensor_saturation("full", "p", "m", {0.2_dec, 2_dec}),
                             any::input_rate_limit("slow", "u", "N/s", {0.1_dec, 5_dec}),
                             any::input_lag("lag", "u", "N", {0_dec, 0.8_dec}, 5),
                             any::sensor_lag("filter", {"p"}, {0.01_dec, 0.8_dec})}) {
        INFO(e.name);
        CHECK_FALSE(vanishes(e));
    }
}

TEST_CASE("one or two effects hold each of them, in any order, and say where") {
    auto const bias = any::sensor_bias("bias", "v", "m/s", {-1_dec, 1_dec});
    auto const lag = any::input_lag("lag", "u", "N", {0.1_dec, 0.8_dec}, 5);
    for (auto const& [fewer, more] :
         std::vector<std::pair<std::vector<effect>, std::vector<effect>>>{
             {{slope()}, {slope(), bias}},
             {{slope()}, {bias, slope()}},
             {{bias}, {slope(), bias}},
             {{late()}, {late(), slope()}},
             {{slope()}, {late(), slope()}},
             {{lag}, {lag, slope()}},
             {{only_within(slope(), {"E2"})}, {bias, only_within(slope(), {"E2"})}}}) {
        auto const poorer = with_effects(fewer), richer = with_effects(more);
        auto const how = embedded(poorer, richer);
        REQUIRE(how);
        REQUIRE(how->size() == richer.prior.size());
        for (std::size_t j = 0; j < how->size(); ++j) {
            auto const& name = richer.choice.unknown[j];
            auto const& p = (*how)[j];
            if (p.same)
                CHECK(poorer.choice.unknown[*p.same] == name);
            else
                CHECK(p.neutral == 0);
        }
        CHECK_FALSE(embedded(richer, poorer));
    }
    CHECK_FALSE(embedded(with_effects({slope()}), with_effects({bias})));
    CHECK_FALSE(embedded(with_effects({slope()}), with_effects({lag, slope()})));
    CHECK_FALSE(embedded(with_effects({only_within(slope(), {"E2"})}),
                         with_effects({only_within(slope(), {"E1"}), bias})));
}

TEST_CASE("a wider prior holds a narrower one, and not the other way round") {
    auto const bias = any::sensor_bias("bias", "v", "m/s", {-1_dec, 1_dec});
    auto const narrow = with_effects({slope()}), wide = with_effects({widened(slope())});
    CHECK(embedded(narrow, wide));
    CHECK_FALSE(embedded(wide, narrow));
    CHECK(embedded(narrow, with_effects({bias, widened(slope())})));
    auto const slow = any::input_lag("lag", "u", "N", {0.1_dec, 0.8_dec}, 5);
    CHECK(embedded(with_effects({slow}), with_effects({widened(slow)})));
    auto other = small_campaign::problem();
    other.prior[0] = interval(0.6, 1.4); // of the model itself
    CHECK(embedded(other, small_campaign::problem()));
    CHECK_FALSE(embedded(small_campaign::problem(), other));
}

TEST_CASE("other starts or other data hold nothing") {
    auto const problem = small_campaign::problem();
    auto other = problem;
    other.experiments[0].initial[0] = interval(0.0, 0.1);
    CHECK(embedded(problem, other));
    CHECK_FALSE(embedded(other, problem));
    other = problem;
    other.experiments[1].outliers = 1;
    CHECK_FALSE(embedded(problem, other));
    other.experiments.pop_back();
    CHECK_FALSE(embedded(problem, other));
}
