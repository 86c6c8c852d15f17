// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate/detail/effect_hulls.hpp>

#include "diagnosis/lagged_input.hpp"
#include "diagnosis/late_position.hpp"
#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

#include <sivid/model/affected_problem.hpp>
#include <sivid/model/effects.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

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
                                        late, {.seconds = 60})
                               .parameters;
        REQUIRE(hulls.size() == 2);
        CHECK(contains(hulls[0], 1.0));
        CHECK(contains(hulls[1], tau));
        CHECK(hulls[1].lower() > 0);
        CHECK(width(hulls[1]) < 0.1 * 0.5);
        CHECK(width(hulls[0]) < 0.2);
    }
}

TEST_CASE("the hull of a play contains it, and excludes that there is none") {
    std::vector<effect> const gap{effects::input_backlash("gap", "u", "N", {0_dec, 0.5_dec})};
    for (double const b : {0.1, 0.3}) {
        auto const hulls = effect_hulls(small_campaign::problem(small_campaign::with_play(b)), gap,
                                        {.seconds = 60})
                               .parameters;
        CAPTURE(b, hulls[0], hulls[1]);
        REQUIRE(hulls.size() == 2);
        CHECK(contains(hulls[0], 1.0));
        CHECK(contains(hulls[1], b));
        CHECK(hulls[1].lower() > 0);
        CHECK(width(hulls[1]) < 0.2 * 0.5);
        CHECK(width(hulls[0]) < 0.3);
    }
    auto const none = effect_hulls(small_campaign::problem(), gap, {.seconds = 20}).parameters;
    CHECK(none[1].lower() == 0);
    auto const wrong = small_campaign::problem(small_campaign::with_drag(0.8));
    CHECK(is_empty(effect_hulls(wrong, gap, {.seconds = 60}).parameters[1]));
}

TEST_CASE("the hull of a rate limit contains it, and excludes that there is none") {
    std::vector<effect> const slow{
        effects::input_rate_limit("slow", "u", "N/s", {0.25_dec, 4_dec})};
    for (auto const between : {interpolation::linear, interpolation::hold}) {
        for (double const limit : {0.6, 1.2}) {
            auto real = small_campaign::with_rate_limit(limit);
            real.between = between;
            auto const hulls =
                effect_hulls(small_campaign::problem(real), slow, {.seconds = 60}).parameters;
            CAPTURE(limit, between == interpolation::hold, hulls[0], hulls[1]);
            REQUIRE(hulls.size() == 2);
            CHECK(contains(hulls[0], 1.0));
            CHECK(contains(hulls[1], limit));
            CHECK(hulls[1].upper() < 2); // the fastest that the input is
            CHECK(width(hulls[1]) < 0.04);
            CHECK(width(hulls[0]) < 0.03);
        }
    }
    auto const none = effect_hulls(small_campaign::problem(), slow, {.seconds = 20}).parameters;
    CHECK(none[1].upper() == 4);
    auto const wrong = small_campaign::problem(small_campaign::with_drag(0.8));
    CHECK(is_empty(effect_hulls(wrong, slow, {.seconds = 60}).parameters[1]));
}

TEST_CASE("the hull of a lag contains it, and excludes that there is none") {
    auto const hulls = effect_hulls(with_lag(0.4), lag(), {.seconds = 60}).parameters;
    REQUIRE(hulls.size() == 2);
    CHECK(contains(hulls[0], 1.0));
    CHECK(contains(hulls[1], 0.4));
    CHECK(hulls[1].lower() > 0);
    CHECK(width(hulls[1]) < 0.1);
}

TEST_CASE("a lag beside an effect that changes a constant alone has a hull, too") {
    effect softer;
    softer.name = "softer";
    softer.parameters = {{"k", "1", -0.5_dec, 0.5_dec, 0_dec}};
    softer.on_inputs = [](effect_scope& m) { m.constant("d") *= 1 + m.parameter(); };
    auto const problem = with_lag(0.4);
    std::vector<effect> const both{lag()[0], softer};
    auto const hulls = effect_hulls(problem, both, {.seconds = 60}).parameters;
    REQUIRE(hulls.size() == 3);
    CHECK(contains(hulls[0], 1.0));
    CHECK(contains(hulls[1], 0.4));
    CHECK(contains(hulls[2], 0.0));
    CHECK(hulls[1].lower() > 0);
    CHECK(width(hulls[1]) < 0.1);
}

TEST_CASE("a product is bounded where its factors are not, and slices share it") {
    effect push;
    push.name = "push";
    push.parameters = {{"a", "m/s", 0.25_dec, 2_dec, 1_dec}, {"b", "1/s", 0.125_dec, 1_dec, 1_dec}};
    push.on_rates = [](effect_scope& m) { m.rate("v") += m.parameter(0) * m.parameter(1); };
    auto real = small_campaign::with_slope(0.3);
    for (bool const delayed : {false, true}) {
        auto effects = std::vector{push};
        if (delayed) {
            effects.push_back(late[0]);
            real.delay = 0.2;
        }
        auto const found = effect_hulls(small_campaign::problem(real), effects, {.seconds = 60});
        CAPTURE(delayed, found.parameters);
        REQUIRE(found.parameters.size() == effects.size() + 2);
        CHECK(contains(found.parameters[0], 1.0));
        CHECK(contains(found.parameters[1], 1.0));
        CHECK(contains(found.parameters[1], 0.4));
        CHECK(contains(found.parameters[2], 0.3));
        REQUIRE(found.products.size() == 1);
        auto const& p = found.products[0];
        auto exponents = std::vector<int>(found.parameters.size(), 0);
        exponents[1] = exponents[2] = 1;
        CHECK(p.what.exponents == exponents);
        CAPTURE(p.hull);
        CHECK(contains(p.hull, 0.3));
        CHECK(width(p.hull) < 0.1 * width(p.what.over(found.parameters)));
    }
}

TEST_CASE("a sum is bounded where its terms are not") {
    effect more;
    more.name = "more";
    more.parameters = {{"dk", "1/kg", 0_dec, 0.5_dec, 0.1_dec}};
    more.on_inputs = [](effect_scope& m) { m.constant("k") += m.parameter(); };
    auto const found = effect_hulls(small_campaign::problem(), {more}, {.seconds = 60});
    REQUIRE(found.products.size() == 1);
    auto const& [sum, range] = found.products[0];
    CHECK(sum.signs == std::vector<int>{1, 1});
    CHECK(contains(range, 1.0));
    CHECK(width(range) < 0.25 * width(sum.over(found.parameters)));
    for (double const dk : {0.0, 0.1}) {
        CHECK(contains(found.parameters[0], 1 - dk));
        CHECK(contains(found.parameters[1], dk));
    }
}

TEST_CASE("hulls hold no effect where there is none, and nothing where nothing explains") {
    auto const real = small_campaign::problem();
    for (auto const& effects : {late, lag()}) {
        auto const hulls = effect_hulls(real, effects, {.seconds = 20}).parameters;
        REQUIRE(hulls.size() == 2);
        CHECK(contains(hulls[0], 1.0));
        CHECK(hulls[1].lower() == 0);
        CHECK(hulls[1].upper() < 0.1);
    }
    auto const wrong = small_campaign::problem(small_campaign::with_drag(0.8));
    auto const none = effect_hulls(wrong, late, {.seconds = 60}).parameters;
    REQUIRE(none.size() == 2);
    CHECK((is_empty(none[0]) && is_empty(none[1])));
}

TEST_CASE("hulls end in time, with what is proved until then") {
    auto const problem = small_campaign::problem(small_campaign::with_delay(0.2));
    for (double const seconds : {0.0, 0.05}) {
        for (auto const& effects : {late, lag()}) {
            auto const hulls = effect_hulls(problem, effects, {.seconds = seconds}).parameters;
            REQUIRE(hulls.size() == 2);
            if (effects[0].name != "late") continue; // a lag does not explain a delay
            CHECK(contains(hulls[0], 1.0));
            CHECK(contains(hulls[1], 0.2));
        }
    }
    int asked = 0;
    auto const hulls =
        effect_hulls(problem, late, {.seconds = 60, .keep_going = [&asked] { return ++asked < 3; }})
            .parameters;
    CHECK(contains(hulls[1], 0.2));
    CHECK(width(hulls[1]) == 0.5);
    // Two changes of one input stay as they are.
    auto const both =
        std::vector<effect>{late[0], effects::input_backlash("gap", "u", "N", {0_dec, 0.5_dec})};
    CHECK(width(effect_hulls(problem, both, {.seconds = 1}).parameters[1]) == 0.5);
}

namespace {

/// The cart pushed through a dead band or a saturation.
identification_problem with_threshold(bool stands, double size) {
    small_campaign::truth real;
    real.missing = [stands, size](double, double, double force) {
        double const cut = std::clamp(force, -size, size);
        return (stands ? cut : force - cut) - force;
    };
    return small_campaign::problem(real);
}
} // namespace

TEST_CASE("hulls of thresholds of an input contain them, and are narrow") {
    for (bool const stands : {false, true}) {
        if (stands && !support::long_sweeps) continue;
        std::vector<effect> const one{
            stands ? effects::input_saturation("most", "u", "N", {0.05_dec, 2_dec})
                   : effects::input_dead_band("dead", "u", "N", {0_dec, 0.5_dec})};
        std::vector<double> const sizes{0.21, 0.4, 0.333, 0.07, 0.151};
        for (std::size_t n = 0; n < support::swept(std::size_t{1}, sizes.size()); ++n) {
            auto const problem = with_threshold(stands, sizes[n]);
            auto const hulls = effect_hulls(problem, one, {.seconds = 20, .boxes = 800}).parameters;
            CAPTURE(stands, sizes[n], hulls[0], hulls[1]);
            CHECK(contains(hulls[0], 1.0));
            CHECK(contains(hulls[1], sizes[n]));
            CHECK(width(hulls[1]) < 0.3); // k may make up for much of it
            if (!support::long_sweeps) continue;
            // With another effect beside it.
            std::vector<effect> two = one;
            two.push_back(effects::constant_rate("slope", "v", "m/s^2", {-1_dec, 1_dec}));
            auto const more = effect_hulls(problem, two, {.seconds = 60}).parameters;
            CAPTURE(more[0], more[1], more[2]);
            CHECK(contains(more[0], 1.0));
            CHECK(contains(more[1], sizes[n]));
            CHECK(contains(more[2], 0.0));
            CHECK(width(more[1]) < 0.35);
        }
        if (!support::long_sweeps) continue;
        auto const none = effect_hulls(small_campaign::problem(), one, {.seconds = 10}).parameters;
        CHECK(contains(none[1], stands ? 1.9 : 0.0)); // beyond all that was commanded
    }
}

TEST_CASE("the hull of a late sensor contains its latency, and is narrow") {
    std::vector<effect> const slow{effects::sensor_latency("slow", {"p"}, {0_dec, 0.5_dec})};
    std::vector<int> const latencies{200, 57, 333, 1, 480, 100};
    for (std::size_t n = 0; n < support::swept(std::size_t{1}, latencies.size()); ++n) {
        auto const problem = diagnosis_support::with_late_position(latencies[n]);
        double const tau = 0.001 * latencies[n];
        auto const hulls = effect_hulls(problem, slow, {.seconds = 60}).parameters;
        CAPTURE(tau, hulls[0], hulls[1]);
        CHECK(contains(hulls[0], 1.0));
        CHECK(contains(hulls[1], tau));
        CHECK(width(hulls[1]) < 0.1);
        if (!support::long_sweeps) continue;
        std::vector<effect> two = slow;
        two.push_back(effects::constant_rate("slope", "v", "m/s^2", {-1_dec, 1_dec}));
        auto const more = effect_hulls(problem, two, {.seconds = 60}).parameters;
        CAPTURE(more[0], more[1], more[2]);
        CHECK(contains(more[1], tau));
        CHECK(contains(more[2], 0.0));
    }
    if (!support::long_sweeps) return;
    auto const wrong = small_campaign::problem(small_campaign::with_drag(0.8));
    CHECK(is_empty(effect_hulls(wrong, slow, {.seconds = 60}).parameters[1]));
}

TEST_CASE("hulls of what remembers in one experiment only contain it, and are narrow") {
    struct planted {
        effect what;
        double size;
        identification_problem everywhere;
    };
    std::vector<planted> const all{
        {late[0], 0.2, small_campaign::problem(small_campaign::with_delay(0.2))},
        {lag()[0], 0.4, with_lag(0.4)},
        {effects::input_backlash("gap", "u", "N", {0_dec, 0.5_dec}), 0.3,
         small_campaign::problem(small_campaign::with_play(0.3))},
        {effects::sensor_latency("slow", {"p"}, {0_dec, 0.5_dec}), 0.2,
         diagnosis_support::with_late_position(200)},
        {lag()[0], 0.05, with_lag(0.05)}};
    for (std::size_t k = 0; k < all.size(); ++k) {
        auto const& [what, size, everywhere] = all[k];
        for (std::size_t const acting : {0U, 1U}) {
            if (!support::long_sweeps && (k + acting) % 2 == 0) continue;
            auto problem = small_campaign::problem();
            problem.experiments[acting] = everywhere.experiments[acting];
            auto const name = problem.experiments[acting].name;
            std::vector<effect> const one{only_within(what, {name})};
            auto const hulls = effect_hulls(problem, one, {.seconds = 60}).parameters;
            CAPTURE(one[0].name, hulls[0], hulls[1]);
            REQUIRE(hulls.size() == 2);
            CHECK(contains(hulls[0], 1.0));
            CHECK(contains(hulls[1], size));
            CHECK(width(hulls[1]) < 0.3 * width(one[0].parameters[0].prior()));
            if (size > 0.1) CHECK(hulls[1].lower() > 0);
            // In the other experiment it explains nothing.
            std::vector<effect> const wrong{
                only_within(what, {problem.experiments[1 - acting].name})};
            auto const none = effect_hulls(problem, wrong, {.seconds = 60}).parameters;
            if (size > 0.1) CHECK((is_empty(none[1]) || !contains(none[0], 1.0)));
        }
    }
}

TEST_CASE("what remembers in all experiments by name has the hull of one that acts everywhere") {
    auto const problem = small_campaign::problem(small_campaign::with_delay(0.2));
    auto const plain = effect_hulls(problem, late, {.seconds = 60}).parameters;
    auto const named =
        effect_hulls(problem, {only_within(late[0], {"E1", "E2"})}, {.seconds = 60}).parameters;
    for (std::size_t j = 0; j < 2; ++j) {
        CHECK(plain[j].lower() == named[j].lower());
        CHECK(plain[j].upper() == named[j].upper());
    }
    // In none that is known it is no unknown of the data.
    auto const nowhere =
        effect_hulls(small_campaign::problem(), {only_within(late[0], {"E9"})}, {.seconds = 20})
            .parameters;
    CHECK(contains(nowhere[0], 1.0));
    CHECK(nowhere[1].lower() == 0);
    CHECK(nowhere[1].upper() == 0.5);
}

TEST_CASE("a delay beside an effect of one experiment: each input has its own place") {
    auto problem = small_campaign::problem(small_campaign::with_delay(0.2));
    auto real = small_campaign::with_slope(0.4);
    real.delay = 0.2;
    problem.experiments[1].measurements = small_campaign::experiment(1, real).measurements;
    std::vector<effect> const effects{
        only_within(effects::constant_rate("slope", "v", "m/s^2", {-1_dec, 1_dec}), {"E2"}),
        late[0]};
    auto const hulls = effect_hulls(problem, effects, {.seconds = 20, .boxes = 800}).parameters;
    CAPTURE(hulls[0], hulls[1], hulls[2]);
    CHECK(contains(hulls[0], 1.0));
    CHECK(contains(hulls[1], 0.4));
    CHECK(contains(hulls[2], 0.2));
    CHECK(width(hulls[2]) < 0.1);
}

TEST_CASE("a late sensor of an experiment that does not begin at 0") {
    auto problem = diagnosis_support::with_late_position(150);
    for (auto& x : problem.experiments) { // all of it 2.7 s later
        auto const u = std::get<sampled_signal>(x.inputs[0]);
        auto times = u.times();
        for (auto& t : times) t += 2.7;
        x.inputs[0] = sampled_signal(times, u.values(), u.kind());
        x.begin = 2.7;
        for (auto& m : x.measurements) m.time += 2.7;
    }
    std::vector<effect> const slow{effects::sensor_latency("slow", {"p"}, {0_dec, 0.5_dec})};
    auto const hulls = effect_hulls(problem, slow, {.seconds = 20, .boxes = 800}).parameters;
    CAPTURE(hulls[0], hulls[1]);
    CHECK(contains(hulls[0], 1.0));
    CHECK(contains(hulls[1], 0.15));
    CHECK(width(hulls[1]) < 0.1);
}

TEST_CASE("hulls of two memories at once contain both, and are narrow") {
    small_campaign::truth real;
    real.delay = 0.13;
    std::vector<effect> const two{effects::sensor_latency("slow", {"p"}, {0_dec, 0.5_dec}),
                                  late[0]};
    auto const hulls = effect_hulls(diagnosis_support::with_late_position(60, real), two,
                                    {.seconds = 60, .boxes = 400})
                           .parameters;
    CAPTURE(hulls[0], hulls[1], hulls[2]);
    CHECK(contains(hulls[0], 1.0));
    CHECK(contains(hulls[1], 0.06));
    CHECK(contains(hulls[2], 0.13));
    CHECK((width(hulls[1]) < 0.1 && width(hulls[2]) < 0.15));
    CHECK((hulls[1].lower() > 0 && hulls[2].lower() > 0));
}
