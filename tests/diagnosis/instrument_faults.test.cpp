// SPDX-License-Identifier: MIT
// Faults of instruments that no catalogue has.
#include <sivid/diagnosis/candidate/detail/effect_hulls.hpp>
#include <sivid/diagnosis/claim/detail/diagnosis_consistency.hpp>
#include <sivid/diagnosis/diagnose.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"

#include <sivid/model/named_effects.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;

namespace {

/// What an instrument shows in the k-th millisecond of what it should have shown in each.
using instrument = std::function<double(std::vector<double> const& should, std::size_t k)>;

/// The cart of small_campaign.hpp, one of whose channels is seen by that.
identification_problem seen_by(std::size_t channel, instrument const& shows,
                               small_campaign::truth fine = {}) {
    auto problem = small_campaign::problem(fine);
    fine.every = 1;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto& real = problem.experiments[e];
        std::vector<double> should{mid(real.initial[channel])};
        for (auto const& m : small_campaign::experiment(e, fine).measurements)
            if (m.channel == channel) should.push_back(mid(m.bound));
        for (auto& m : real.measurements) {
            if (m.channel != channel) continue;
            double const y = shows(should, static_cast<std::size_t>(std::lround(1000 * m.time)));
            m.bound = interval(y - rad(m.bound), y + rad(m.bound));
        }
    }
    return problem;
}
diagnosis diagnosed(identification_problem problem, std::vector<effect> catalogue = {}) {
    diagnosis_options options;
    options.seconds = 60; // a slow machine needs them
    options.hulls.boxes = 400;
    auto d = diagnose(std::move(problem), std::move(catalogue), options).result;
    for (auto const& c : find_contradictions(d)) FAIL_CHECK(c.claim + ": " + c.reason);
    return d;
}
/// Follows by a first-order lag.
instrument slow(double tau) {
    return [tau](std::vector<double> const& y, std::size_t k) {
        double z = y[0];
        for (std::size_t n = 1; n <= k; ++n)
            z += (0.5 * (y[n - 1] + y[n]) - z) * (1 - std::exp(-0.001 / tau));
        return z;
    };
}
std::string joined(std::vector<std::string> const& names) {
    std::string all;
    for (auto const& n : names) all += (all.empty() ? "" : " ") + n;
    return all;
}

} // namespace

TEST_CASE("the fault of an instrument is found without a catalogue, and bounded") {
    struct planted {
        std::string name;
        std::size_t channel;
        double size;
        instrument shows;
    };
    auto const seconds = [](std::size_t k) { return static_cast<double>(k) / 1000; };
    std::vector<planted> const all{
        {"sensor_bias(v)", 1, 0.2, [](auto const& y, std::size_t k) { return y[k] + 0.2; }},
        {"sensor_drift(p)", 0, -0.05,
         [&](auto const& y, std::size_t k) { return y[k] - 0.05 * seconds(k); }},
        {"sensor_scale(v)", 1, -2, [](auto const& y, std::size_t k) { return -y[k]; }},
        {"sensor_saturation(v)", 1, 0.375,
         [](auto const& y, std::size_t k) { return std::clamp(y[k], -0.375, 0.375); }},
        {"sensor_latency(v)", 1, 0.25,
         [](auto const& y, std::size_t k) { return y[k - std::min<std::size_t>(k, 250)]; }},
        {"sensor_lag(v)", 1, 0.25, slow(0.25)},
        {"sensor_wrap(p)", 0, 0.75, [](auto const& y, std::size_t k) {
             return y[k] - 0.75 * std::floor((y[k] + 0.1) / 0.75);
         }}};
    for (auto const& one : all) {
        CAPTURE(one.name);
        auto const d = diagnosed(seen_by(one.channel, one.shows));
        INFO(joined(d.effects));
        CHECK(d.gap == gap_verdict::certified);
        REQUIRE(d.answer == answer_kind::effects);
        REQUIRE(d.effects.size() == 1);
        CHECK(d.effects[0].starts_with(one.name + "~"));
        auto const& c = d.causes.front();
        CHECK(c.verdict == cause_verdict::explains);
        REQUIRE(c.parameters.size() == 1);
        REQUIRE(c.parameters[0].hull);
        REQUIRE(c.parameters[0].prior);
        CHECK(contains(*c.parameters[0].hull, one.size));
        CHECK(width(*c.parameters[0].hull) < 0.15 * width(*c.parameters[0].prior));
        CHECK((!d.where.empty() && d.where[0].name == (one.channel == 0 ? "p" : "v")));
    }
}

TEST_CASE("no instrument is blamed for what an equation or an input lacks") {
    CHECK(diagnosed(small_campaign::problem()).answer == answer_kind::none);
    small_campaign::truth drag;
    drag.missing = [](double, double v, double) { return -0.75 * std::abs(v) * v; };
    small_campaign::truth gust;
    gust.missing = [](double t, double, double) { return t > 1 && t < 1.6 ? 1.5 : 0.0; };
    small_campaign::truth late;
    late.delay = 0.2;
    for (auto const& real : {drag, gust, late}) {
        auto const d = diagnosed(small_campaign::problem(real));
        INFO(joined(d.effects));
        CHECK(d.gap == gap_verdict::certified);
        CHECK(std::none_of(d.effects.begin(), d.effects.end(), names_sensor_fault));
        for (auto const& c : d.causes) {
            INFO(joined(c.effects));
            bool const instruments =
                std::any_of(c.effects.begin(), c.effects.end(), names_sensor_fault);
            CHECK_FALSE((instruments && c.verdict == cause_verdict::explains));
        }
    }
}

TEST_CASE("a fault of the catalogue is found as before, no other one is tried") {
    using namespace sivid::literals;
    auto const problem =
        seen_by(1, [](auto const& y, std::size_t k) { return y[k] + 0.00005 * double(k); });
    auto const d =
        diagnosed(problem, {effects::sensor_drift("drifts", "v", "m/s^2", {-0.5_dec, 0.5_dec})});
    CHECK(joined(d.effects) == "drifts");
    for (auto const& c : d.causes)
        CHECK(std::none_of(c.effects.begin(), c.effects.end(), names_sensor_fault));
}

TEST_CASE("hulls of a low-pass contain it, alone and beside another effect") {
    using namespace sivid::literals;
    auto const drag = effects::quadratic_damping("drag", "v", "1/m", {0_dec, 1_dec});
    auto const seeds = support::swept(4, 60);
    for (int seed = 1; seed <= seeds; ++seed) {
        support::draws d(static_cast<std::uint64_t>(seed));
        double const tau = 0.005 * std::pow(100.0, d.uniform(0, 1)), k = d.uniform(0, 1);
        bool const both = d.coin();
        std::size_t const channel = d.coin() ? 1 : 0;
        small_campaign::truth real;
        if (both) real.missing = [k](double, double v, double) { return -k * std::abs(v) * v; };
        std::string const name = channel == 1 ? "sensor_lag(v)~0.5" : "sensor_lag(p)~0.5";
        CAPTURE(seed, tau, k, both, name);
        std::vector<effect> effects{sensor_fault(name)};
        if (both) effects.push_back(drag);
        effect_hull_options options;
        options.seconds = 20;
        options.boxes = 400;
        auto const hull =
            effect_hulls(seen_by(channel, slow(tau), real), effects, options).parameters;
        REQUIRE(hull.size() == effects.size() + 1);
        CHECK(contains(hull[0], 1.0));
        CHECK(contains(hull[1], tau));
        if (both) CHECK(contains(hull[2], k));
    }
}

TEST_CASE("a channel that wraps is found beside another effect") {
    using namespace sivid::literals;
    small_campaign::truth drag;
    drag.missing = [](double, double v, double) { return -0.75 * std::abs(v) * v; };
    auto const wraps = [](auto const& y, std::size_t k) {
        return y[k] - 0.625 * std::floor((y[k] + 0.1) / 0.625);
    };
    auto const d = diagnosed(seen_by(0, wraps, drag),
                             {effects::linear_damping("film", "v", {0_dec, 1_dec}),
                              effects::quadratic_damping("drag", "v", "1/m", {0_dec, 2_dec})});
    INFO(joined(d.effects));
    REQUIRE(d.effects.size() == 2);
    CHECK(d.effects[0] == "drag");
    CHECK(d.effects[1].starts_with("sensor_wrap(p)~"));
    auto const& c = d.causes.front();
    CHECK(c.verdict == cause_verdict::explains);
    REQUIRE(c.parameters.size() == 2);
    REQUIRE((c.parameters[0].hull && c.parameters[1].hull));
    CHECK(contains(*c.parameters[0].hull, 0.75));
    CHECK(contains(*c.parameters[1].hull, 0.625));
    CHECK(d.change.lines.front().starts_with("v' becomes v' - "));
    REQUIRE(!c.assumptions.empty()); // what its number of turns rests on, with all that is assumed
    CHECK(c.assumptions.front().starts_with("p has wrapped as often as its readings leap by "));
    CHECK(std::find(d.assumptions.begin(), d.assumptions.end(), c.assumptions.front()) !=
          d.assumptions.end());
}

TEST_CASE("readings that are too coarse for their bounds are told by their steps") {
    for (bool const cut_off : {false, true}) {
        auto const coarse = [cut_off](auto const& y, std::size_t k) {
            return 0.15 * (cut_off ? std::floor(y[k] / 0.15) : std::round(y[k] / 0.15));
        };
        auto const d = diagnosed(seen_by(1, coarse));
        CAPTURE(cut_off, joined(d.effects));
        CHECK(d.answer == answer_kind::unexplained);
        REQUIRE(d.confined.size() == 1);
        CHECK(d.confined[0].channel == "v");
        REQUIRE(d.confined[0].steps);
        CHECK_THAT(d.confined[0].steps->size, WithinRel(0.15, 1e-9));
        CHECK_FALSE(d.confined[0].grows);
        CHECK((!d.where.empty() && d.where[0].name == "v"));
    }
}
