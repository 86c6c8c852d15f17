// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate/effect_hulls.hpp>

#include "diagnosis/lagged_input.hpp"
#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <sivid/diagnosis/affected_problem.hpp>
#include <sivid/model/effects.hpp>

using namespace sivid;
using namespace sivid::literals;

namespace {

std::vector<effect> const late{effects::input_delay("late", "u", {0_dec, 0.5_dec})};
std::vector<effect> lag(bool rests = false) {
    return {effects::input_lag("lag", "u", "N", {0_dec, 1_dec}, 5, rests)};
}
/// The cart pushed through a lag. One experiment: its truth knows one input.
identification_problem with_lag(double tau) {
    auto problem = small_campaign::problem();
    for (std::size_t e = 0; e < 2; ++e) {
        auto const u = std::get<sampled_signal>(problem.experiments[e].inputs[0]);
        small_campaign::truth real;
        real.missing = [u, tau](double t, double, double force) {
            return diagnosis_support::lagged(u, 0, false, tau, t) - force;
        };
        problem.experiments[e].measurements = small_campaign::experiment(e, real).measurements;
    }
    return problem;
}

} // namespace

TEST_CASE("the hull of a delay contains it, and excludes that there is none") {
    for (double const tau : {0.13, 0.31}) {
        auto const hulls = effect_hulls(small_campaign::problem(small_campaign::with_delay(tau)),
                                        late, {.seconds = 60});
        REQUIRE(hulls.size() == 2);
        CHECK(contains(hulls[0], 1.0));
        CHECK(contains(hulls[1], tau));
        CHECK(hulls[1].lower() > 0);
        CHECK(width(hulls[1]) < 0.1 * 0.5);
        CHECK(width(hulls[0]) < 0.2);
    }
}

TEST_CASE("the hull of a lag contains it, and excludes that there is none") {
    auto const hulls = effect_hulls(with_lag(0.4), lag(), {.seconds = 60});
    REQUIRE(hulls.size() == 2);
    CHECK(contains(hulls[0], 1.0));
    CHECK(contains(hulls[1], 0.4));
    CHECK(hulls[1].lower() > 0);
    CHECK(width(hulls[1]) < 0.1);
}

TEST_CASE("hulls hold no effect where there is none, and nothing where nothing explains") {
    auto const real = small_campaign::problem();
    for (auto const& effects : {late, lag()}) {
        auto const hulls = effect_hulls(real, effects, {.seconds = 20});
        REQUIRE(hulls.size() == 2);
        CHECK(contains(hulls[0], 1.0));
        CHECK(hulls[1].lower() == 0);
        CHECK(hulls[1].upper() < 0.1);
    }
    auto const wrong = small_campaign::problem(small_campaign::with_drag(0.8));
    auto const none = effect_hulls(wrong, late, {.seconds = 60});
    REQUIRE(none.size() == 2);
    CHECK((is_empty(none[0]) && is_empty(none[1])));
}

TEST_CASE("hulls end in time, with what is proved until then") {
    auto const problem = small_campaign::problem(small_campaign::with_delay(0.2));
    for (double const seconds : {0.0, 0.05}) {
        for (auto const& effects : {late, lag()}) {
            auto const hulls = effect_hulls(problem, effects, {.seconds = seconds});
            REQUIRE(hulls.size() == 2);
            if (effects[0].name != "late") continue; // a lag does not explain a delay
            CHECK(contains(hulls[0], 1.0));
            CHECK(contains(hulls[1], 0.2));
        }
    }
    int asked = 0;
    auto const hulls = effect_hulls(
        problem, late, {.seconds = 60, .keep_going = [&asked] { return ++asked < 3; }});
    CHECK(contains(hulls[1], 0.2));
    CHECK(width(hulls[1]) == 0.5);
    // Two late inputs and late sensors stay as they are.
    auto const slow = std::vector<effect>{effects::sensor_latency("slow", {"p"}, {0_dec, 0.5_dec})};
    CHECK(width(effect_hulls(problem, slow, {.seconds = 1})[1]) == 0.5);
}
