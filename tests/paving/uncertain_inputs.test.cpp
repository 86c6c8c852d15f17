// SPDX-License-Identifier: MIT
// Identification with inputs that are known up to an error: planted truths are never lost, and what
// is said to explain the data does, by the recorded inputs.
#include <sivid/paving/identify.hpp>
#include <sivid/paving/inflation.hpp>
#include <sivid/verifier/proof/detail/plain_proof.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/real_functions.hpp"
#include "support/uncertain_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::extended_state;

namespace {

/// x' = u - p0 x - p1 x^3, seen as x and as x + u/2.
auto const rate = [](auto const&, auto const& x, auto const& p, auto const& u) {
    using namespace support::real;
    return std::vector{u[0] - p[0] * x[0] - p[1] * pown(x[0], 3)};
};
auto const outputs = [](auto const&, auto const& x, auto const&, auto const& u) {
    return std::vector{x[0], x[0] + 0.5 * u[0]};
};

struct planted {
    identification_problem problem; ///< with error bounds of the input
    std::vector<double> truth;
    double start = 0;
};

/// @param share  of its bound by which the true input is off all the time; 2: it varies somehow
planted plant(std::uint64_t seed, double share, double input_error, double noise = 0.01) {
    draws d(seed);
    planted result;
    result.truth = {d.uniform(0.6, 1.8), d.uniform(0.05, 0.45)};
    result.start = d.uniform(0.2, 1);
    double const end = 3;
    std::vector<double> times{0}, values{d.uniform(0, 1)}, errors{input_error};
    while (times.back() < end) {
        times.push_back(times.back() + d.uniform(0.2, 0.6));
        values.push_back(d.uniform(-0.5, 1.5));
        errors.push_back(input_error * d.uniform(0.5, 1));
    }
    auto const kind = d.coin() ? interpolation::hold : interpolation::linear;
    sampled_signal const recorded(times, values, kind, errors);
    auto const chosen =
        share > 1 ? support::draw_inputs(d, 1, end) : support::constant_share(1, share);
    std::vector<double> when;
    for (int k = 1; k <= 10; ++k) when.push_back(end * k / 10);
    extended_state p(result.truth.begin(), result.truth.end());
    auto const states =
        support::states_under(rate, {result.start}, p, when, {recorded}, chosen, 1e-13L);
    experiment e;
    e.name = "run";
    e.inputs = {recorded};
    e.initial = {interval(result.start - 0.02, result.start + 0.02)};
    for (std::size_t k = 0; k < when.size(); ++k) {
        auto const piece = recorded.piece(when[k]);
        double sigma = chosen.sigma[0].approximate(when[k]);
        if (chosen.frequency[0] != 0) {
            sigma *= static_cast<double>(std::sin(chosen.frequency[0] * when[k] + chosen.phase[0]));
        }
        double const u = recorded.approximate(when[k]) +
                         recorded.error_bound(piece, when[k]) * (1 - 1e-12) * sigma;
        double const x = static_cast<double>(states[k][0]);
        for (std::size_t y = 0; y < 2; ++y) {
            double const seen = (y == 0 ? x : x + 0.5 * u) + d.uniform(-0.99, 0.99) * noise;
            e.measurements.push_back({when[k], y, interval(seen - noise, seen + noise)});
        }
    }
    result.problem = {support::model_of({1, 2, 1}, rate, outputs),
                      {{"p0", "p1"}, {}},
                      {interval(0.5, 2.0), interval(0.0, 0.5)},
                      {e}};
    return result;
}

identification_problem without_errors(identification_problem problem) {
    for (auto& e : problem.experiments) e.inputs = nominal(e.inputs);
    return problem;
}

identify_options brief(carried_set set = carried_set::taylor_model) {
    identify_options o;
    o.search.boxes = 300;
    o.search.seconds = 20;
    o.search.accuracy = 0.02;
    o.test.set = set;
    return o;
}

} // namespace

TEST_CASE("a planted truth is never refuted, whatever the inputs do within their bounds") {
    std::size_t consistent = 0, refuted_without = 0;
    for (std::uint64_t seed = 1; seed <= 15; ++seed) {
        double const share = seed % 3 == 0 ? 2 : seed % 3 == 1 ? 1 : -1;
        auto const p = plant(seed, share, 0.05 * static_cast<double>(1 + seed % 4));
        CAPTURE(seed, share);
        auto const found = identify(
            p.problem, brief(seed % 4 == 0 ? carried_set::doubleton : carried_set::taylor_model));
        REQUIRE(found.assumptions.front() == "inputs within their stated errors");
        REQUIRE(found.verdict != verdict::inconsistent);
        REQUIRE(contains(found.hull, p.truth));
        bool kept = false;
        for (auto const& b : found.paving.boxes()) {
            kept = kept || (b.verdict != box_verdict::outside && contains(b.set, p.truth));
        }
        REQUIRE(kept);
        consistent += found.verdict == verdict::consistent ? 1 : 0;
        auto const exact = identify(without_errors(p.problem), brief());
        CHECK(exact.assumptions.front() == "inputs exact");
        refuted_without += exact.verdict == verdict::inconsistent ? 1 : 0;
    }
    // The data tell the difference: taken as exact, the recorded inputs are often refuted.
    CAPTURE(consistent, refuted_without);
    CHECK(refuted_without >= 7);
}

TEST_CASE("with the recorded inputs being the true ones, a witness is found, and boxes hold") {
    for (std::uint64_t seed = 100; seed < 103; ++seed) {
        auto const p = plant(seed, 0, 0.02, 0.05);
        // The inputs' errors make what is not excluded ten times larger than what the recorded ones
        // prove; the boxes have to reach that.
        auto fine = brief();
        fine.search.boxes = 3000;
        fine.search.accuracy = 0.005;
        auto const found = identify(p.problem, fine);
        CAPTURE(seed);
        CHECK(found.verdict == verdict::consistent);
        CHECK(found.witness);
        REQUIRE(contains(found.hull, p.truth));
        // An error of inputs makes fewer parameters excluded, and none more.
        auto const exact = identify(without_errors(p.problem), brief());
        CHECK(found.paving.outer_volume().upper() >= exact.paving.inner_volume().lower());
        // What is inside explains the data by the recorded inputs, which are possible ones.
        draws d(seed);
        auto const& e = p.problem.experiments[0];
        auto const& recorded = std::get<sampled_signal>(e.inputs[0]);
        REQUIRE(found.guess);
        std::size_t inside = 0;
        for (auto const& b : found.paving.boxes()) {
            if (b.verdict != box_verdict::inside) continue;
            ++inside;
            auto const q = d.in(b.set);
            std::vector<double> when;
            for (std::size_t k = 0; k < e.measurements.size(); k += 2) {
                when.push_back(e.measurements[k].time);
            }
            auto const x =
                support::states_under(rate, {found.guess->starts[0][0]}, {q[0], q[1]}, when,
                                      {recorded}, support::constant_share(1, 0), 1e-13L);
            for (std::size_t k = 0; k < when.size(); ++k) {
                double const y = static_cast<double>(x[k][0]);
                CHECK(support::encloses_reference(e.measurements[2 * k].bound, y, 1e-9));
                CHECK(support::encloses_reference(e.measurements[2 * k + 1].bound,
                                                  y + 0.5 * recorded.approximate(when[k]), 1e-9));
            }
        }
        CHECK(inside > 0);
    }
}

TEST_CASE("the inflation of data within the errors of their inputs may be 1") {
    for (std::uint64_t seed = 31; seed < 34; ++seed) {
        auto const p = plant(seed, seed % 2 == 0 ? 1 : 2, 0.15);
        CAPTURE(seed);
        inflation_options options;
        options.seconds = 1;
        auto const bound = bound_inflation(p.problem, nullptr, options).value;
        CHECK(bound.lower() <= 1);
        CHECK(bound.lower() <= bound.upper());
        auto const exact = bound_inflation(without_errors(p.problem), nullptr, options).value;
        CHECK(bound.lower() <= exact.upper());
    }
}

TEST_CASE("certificates hold for all inputs where they refute, for the recorded one elsewhere") {
    for (std::uint64_t seed = 51; seed < 55; ++seed) {
        auto const p = plant(seed, seed % 2 == 0 ? 1 : -1, 0.1);
        CAPTURE(seed);
        proved_campaign<interval> campaign(p.problem, {}, {});
        auto const truth = point_box(p.truth);
        CHECK(campaign.judge(campaign.learn(truth), truth) != run_finding::refuted);
        // Far away is refuted whatever the input did.
        box const away{interval(1.95, 2.0), interval(0.45, 0.5)};
        box const near{interval(0.5, 0.52), interval(0.0, 0.01)};
        auto const& far = p.truth[0] < 1.2 ? away : near;
        CHECK(campaign.judge(campaign.learn(far), far) == run_finding::refuted);
        auto const easy = plant(seed + 50, 0, 0.02, 0.1);
        proved_campaign<interval> other(easy.problem, {box{interval(easy.start)}}, {});
        auto const there = point_box(easy.truth);
        CHECK(other.judge(other.learn(there), there) == run_finding::explained);
    }
}

TEST_CASE("what proofs take for granted of the inputs is said") {
    sampled_signal const exact({0}, {1}, interpolation::hold);
    sampled_signal const uncertain({0}, {1}, interpolation::hold, {0.1});
    experiment e;
    CHECK(input_assumption({e}) == "inputs exact");
    e.inputs = {exact, exact};
    CHECK(input_assumption({e}) == "inputs exact");
    auto other = e;
    other.inputs = {uncertain, uncertain};
    CHECK(input_assumption({other}) == "inputs within their stated errors");
    CHECK(input_assumption({e, other}) ==
          "inputs within their stated errors, exact where none is stated");
    // What is bridged is named, once for each input.
    e.bridged = {{"torque", 40, 0.12, false}, {"flow", 1, 2, true}};
    CHECK(input_assumption({e}) ==
          "inputs exact; input torque: straight lines over 40 missing samples, longest gap 0.12 s; "
          "input flow: held over 1 missing sample, longest gap 2 s");
    other.bridged = {{"torque", 3, 0.05, false}};
    CHECK(input_assumption({e, other}) ==
          "inputs within their stated errors, exact where none is stated; input torque: straight "
          "lines over 43 missing samples, longest gap 0.12 s; input flow: held over 1 missing "
          "sample, longest gap 2 s");
}
