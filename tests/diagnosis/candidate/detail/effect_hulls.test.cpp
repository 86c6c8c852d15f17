// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/candidate/detail/effect_hulls.hpp>

#include "diagnosis/lagged_input.hpp"
#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"
#include "support/sweep.hpp"

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

TEST_CASE("the hull of a play contains it, and excludes that there is none") {
    std::vector<effect> const gap{effects::input_backlash("gap", "u", "N", {0_dec, 0.5_dec})};
    for (double const b : {0.1, 0.3}) {
        auto const hulls = effect_hulls(small_campaign::problem(small_campaign::with_play(b)), gap,
                                        {.seconds = 60});
        CAPTURE(b, hulls[0], hulls[1]);
        REQUIRE(hulls.size() == 2);
        CHECK(contains(hulls[0], 1.0));
        CHECK(contains(hulls[1], b));
        CHECK(hulls[1].lower() > 0);
        CHECK(width(hulls[1]) < 0.2 * 0.5);
        CHECK(width(hulls[0]) < 0.3);
    }
    auto const none = effect_hulls(small_campaign::problem(), gap, {.seconds = 20});
    CHECK(none[1].lower() == 0);
    auto const wrong = small_campaign::problem(small_campaign::with_drag(0.8));
    CHECK(is_empty(effect_hulls(wrong, gap, {.seconds = 60})[1]));
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

namespace {

/// An effect of small_catalogue.hpp that begins in each experiment at a time of its own.
struct begun {
    std::size_t which; ///< in the catalogue
    double size;
    std::vector<double> onsets;
    std::vector<double> ends{9, 9};
};
double const never = 9;

identification_problem with_onsets(begun const& b) {
    auto problem = small_campaign::problem();
    for (std::size_t e = 0; e < 2; ++e) {
        auto const onset = b.onsets[e], end = b.ends[e];
        small_campaign::truth real, always;
        auto const now =
            b.which == 0 ? small_campaign::with_drag(b.size) : small_campaign::with_slope(b.size);
        if (b.which < 2) {
            real.missing = [now, onset, end](double t, double v, double u) {
                return t >= onset && t < end ? now.missing(t, v, u) : 0;
            };
        } else {
            always = small_campaign::with_scale(b.size);
        }
        auto measured = small_campaign::experiment(e, real).measurements;
        auto const scaled = small_campaign::experiment(e, always).measurements;
        for (std::size_t k = 0; k < measured.size(); ++k) {
            bool const acts = measured[k].time >= onset && measured[k].time < end;
            if (acts && b.which == 2) measured[k] = scaled[k];
        }
        problem.experiments[e].measurements = std::move(measured);
    }
    return problem;
}

} // namespace

TEST_CASE("windows of onsets hold the true ones, wherever they are") {
    double const k = 1;
    std::vector<begun> const all{begun{0, 0.3, {0.7, 1.5}}, // at knots and samples
                                 begun{1, 0.4, {0.02, 3.95}},   begun{2, 0.25, {1.1, 2.05}},
                                 begun{0, 0.5, {1.234, 0.333}}, begun{1, -0.3, {2.015, 0}},
                                 begun{1, 0.4, {never, 1}},     begun{2, -0.2, {3.9, 0.1}},
                                 begun{0, 0.3, {0, 0}},         begun{0, 0, {never, never}}};
    for (std::size_t n = 0; n < support::swept(std::size_t{2}, all.size()); ++n) {
        auto const& b = all[n];
        CAPTURE(b.which, b.size, b.onsets[0], b.onsets[1]);
        auto const problem = with_onsets(b);
        auto const found =
            hulls_of_episodes(problem, small_campaign::catalogue()[b.which], {.seconds = 20});
        REQUIRE(found.parameters.size() == 2);
        REQUIRE(found.times.size() == 2);
        CHECK(contains(found.parameters[0], k));
        CHECK(contains(found.parameters[1], b.size));
        for (std::size_t e = 0; e < 2; ++e) {
            auto const& on = found.times[e].on;
            CAPTURE(e, on.lower(), on.upper());
            CHECK(contains(on, std::min(b.onsets[e], 4.0)));
            // One that shows for a while is bounded.
            bool const shows = b.onsets[e] > 0.2 && b.onsets[e] < 3;
            if (shows) CHECK(width(on) < 2.5);
        }
    }
}

TEST_CASE("windows of ends and of episodes hold the true ones") {
    double const k = 1;
    std::vector<begun> const all{begun{1, 0.4, {0.8, 0}, {2.6, 1.5}},
                                 begun{2, 0.3, {0, 0}, {1.7, 2.6}},
                                 begun{0, 0.4, {0, 0}, {2, never}},
                                 begun{0, 0.5, {1.234, 0.333}, {3.1, 2.5}},
                                 begun{2, -0.25, {0.5, never}, {2.55, never}},
                                 begun{1, -0.3, {0, never}, {1.015, never}}};
    for (std::size_t n = 0; n < support::swept(std::size_t{2}, all.size()); ++n) {
        auto const& b = all[n];
        CAPTURE(b.which, b.size, b.onsets[0], b.onsets[1], b.ends[0], b.ends[1]);
        bool const begins = b.onsets[0] > 0 || (b.onsets[1] > 0 && b.onsets[1] < never);
        // What is asked: begins and ends somewhere, wherever that is.
        auto const e =
            only_within(small_campaign::catalogue()[b.which], {"E1", "E2"},
                        begins ? std::vector<double>{1, 1} : std::vector<double>{}, {2, 2});
        auto const found = hulls_of_episodes(with_onsets(b), e, {.seconds = 20});
        CHECK(contains(found.parameters[0], k));
        CHECK(contains(found.parameters[1], b.size));
        for (std::size_t x = 0; x < 2; ++x) {
            auto const& [on, off] = found.times[x];
            CAPTURE(x, on.lower(), on.upper(), off.lower(), off.upper());
            bool const acts = b.onsets[x] < never;
            if (acts) {
                CHECK(contains(on, std::min(b.onsets[x], 4.0)));
                CHECK(contains(off, std::min(b.ends[x], 4.0)));
            }
            if (!begins) CHECK(width(on) == 0);
        }
        // That of the first experiment shows.
        auto const& [on, off] = found.times[0];
        if (begins) CHECK(width(on) < 3.9);
        CHECK(width(off) < 3.9);
    }
}

TEST_CASE("nothing is known of onsets without time, and none are left where nothing explains") {
    auto const e = small_campaign::catalogue()[1];
    begun const slope{1, 0.4, {1, 2}};
    auto const idle = hulls_of_episodes(with_onsets(slope), e, {.seconds = 0});
    CHECK(width(idle.times[0].on) == 4);
    CHECK(width(idle.parameters[1]) == 2);
    // Which of them, and since when, a name says is left open.
    auto const told =
        hulls_of_episodes(with_onsets(slope), only_within(e, {"E2"}, {3.5}), {.seconds = 20});
    CHECK(contains(told.times[0].on, 1.0));
    CHECK(contains(told.times[1].on, 2.0));
    CHECK(contains(told.parameters[1], 0.4));
    auto const wrong = hulls_of_episodes(with_onsets({2, 0.25, {1.1, 2.05}}), e, {.seconds = 20});
    CHECK((is_empty(wrong.parameters[0]) || !contains(wrong.times[0].on, 0.0) ||
           width(wrong.times[0].on) < 4));
}
