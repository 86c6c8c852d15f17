// SPDX-License-Identifier: MIT
// Whole identifications with a planted truth.
#include <sivid/paving/identify.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"
#include "support/power_series.hpp"
#include "support/models.hpp"
#include "support/problems.hpp"
#include "support/some_start.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::planted_problem;

namespace {

/// By contraction, or by Algorithm 2 of the report, which without outliers is Algorithm 1.
enum class algorithm { contracting, bisection };

identify_options quick(algorithm a, double accuracy, std::size_t boxes) {
    identify_options o;
    if (a == algorithm::bisection) o = by_bisection(o);
    o.search.accuracy = accuracy;
    o.search.boxes = boxes;
    o.search.seconds = 20;
    return o;
}

/// Everything that a result claims, against the truth and against simulation.
void check_claims(planted_problem const& planted, identification const& found, draws& d,
                  std::size_t allowed) {
    auto const& truth = planted.truth;
    CHECK(found.verdict != verdict::inconsistent);
    CHECK(contains(found.hull, truth));
    bool covered = false;
    for (auto const& b : found.paving.boxes()) {
        covered = covered || (b.verdict != box_verdict::outside && contains(b.set, truth));
    }
    CHECK(covered);
    for (auto const& c : found.combinations) {
        support::mp exact = 1;
        for (std::size_t j = 0; j < truth.size(); ++j) {
            exact *= support::real::pown(support::mp(truth[j]), c.what.exponents[j]);
        }
        CHECK(support::encloses(c.hull, exact, 1e-30));
    }
    for (auto const& f : found.forced) {
        CHECK(planted.outliers[f.experiment].count(f.measurement) == 1);
    }
    if (found.witness) {
        CHECK(found.verdict == verdict::consistent);
        for (std::size_t e = 0; e < planted.starts.size(); ++e) {
            CHECK(contains(planted.problem.experiments[e].initial, found.witness->starts[e]));
            CHECK(planted.violated(e, found.witness->parameters, found.witness->starts[e], 1e-10) <=
                  allowed);
            auto const& v = found.witness->violated[e];
            CHECK(v.size() == planted.problem.experiments[e].measurements.size());
            CHECK(static_cast<std::size_t>(std::count(v.begin(), v.end(), true)) <= allowed);
        }
    }
    // Inside: some start explains the data.
    int sampled = 0;
    for (auto const& b : found.paving.boxes()) {
        if (b.verdict != box_verdict::inside || ++sampled > 12) continue;
        for (int member = 0; member < 2; ++member) {
            auto const p = d.in(b.set);
            for (std::size_t e = 0; e < planted.starts.size(); ++e) {
                auto const& start = found.guess ? found.guess->starts[e] : planted.starts[e];
                CHECK(planted.problem.experiments[e].outliers == allowed);
                CHECK(support::some_start_explains(planted, e, p, {start}, 1e-10));
            }
        }
    }
    CHECK(found.paving.inner_volume().lower() <= found.paving.outer_volume().upper());
}

void sweep(std::uint64_t seed, int problems, std::size_t boxes) {
    draws d(seed);
    int consistent = 0;
    for (int round = 0; round < problems; ++round) {
        support::planting how;
        how.experiments = 1 + d.below(2);
        how.samples = 5 + d.below(6);
        how.outliers = d.below(3);
        how.spread = d.below(3) == 0 ? 0.01 : 0;
        how.noise = d.uniform(0.01, 0.08);
        auto const model = d.below(support::planted_models);
        auto const which = d.below(4);
        auto const a = which < 2 ? algorithm::bisection : algorithm::contracting;
        if (which == 0) how.outliers = 0;
        auto const planted = support::plant(d, model, how);
        CAPTURE(seed, round, model, which, how.experiments, how.outliers, how.spread);
        auto options = quick(a, d.coin() ? 1.0 / 8 : 1.0 / 32, boxes);
        if (d.below(4) == 0) options.test.set = carried_set::doubleton;
        auto const found = identify(planted.problem, options);
        check_claims(planted, found, d, how.outliers);
        consistent += found.verdict == verdict::consistent ? 1 : 0;
    }
    CHECK(consistent > problems / 3);
}

} // namespace

TEST_CASE("identified sets contain the planted truth, and claims hold") { sweep(361, 50, 150); }
TEST_CASE("identified sets contain the planted truth, longer", "[.long]") {
    for (std::uint64_t seed = 3600; seed < 3640; ++seed) sweep(seed, 60, 600);
}

TEST_CASE("products that alone are known are named, and inside boxes stay true for them") {
    draws d(362);
    for (int round = 0; round < 4; ++round) {
        auto const planted = support::plant(
            d, 2, {.experiments = 2, .samples = 12, .noise = round < 2 ? 0.1 : 0.03});
        auto const found = identify(planted.problem, quick(algorithm::contracting, 1.0 / 64, 1500));
        CHECK(found.entangled == std::vector<std::size_t>{0, 1});
        REQUIRE(found.combinations.size() == 1);
        CHECK(found.combinations[0].what.formula == "p0*p1");
        // The product is known better than its factors.
        CHECK(width(found.combinations[0].hull) <
              0.7 * width(found.combinations[0].what.over(planted.problem.prior)));
        check_claims(planted, found, d, 0);
    }
}

TEST_CASE("impossible data are proved inconsistent by every algorithm") {
    draws d(363);
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        auto planted = support::plant(d, model, {.samples = 6});
        auto& samples = planted.problem.experiments[0].measurements;
        for (std::size_t k = 0; k < 3; ++k) samples[k].bound = between(500, 501);
        planted.problem.experiments[0].outliers = 2;
        for (auto const a : {algorithm::contracting, algorithm::bisection}) {
            auto const found = identify(planted.problem, quick(a, 1.0 / 64, 2000));
            CAPTURE(model, static_cast<int>(a));
            CHECK(found.verdict == verdict::inconsistent);
            CHECK_FALSE(found.witness);
            CHECK(is_empty(found.hull));
            CHECK_FALSE(found.paving.has_outer());
        }
        // One more outlier is allowed: no longer refuted.
        planted.problem.experiments[0].outliers = 3;
        CHECK(identify(planted.problem, quick(algorithm::contracting, 1.0 / 16, 500)).verdict !=
              verdict::inconsistent);
    }
}

TEST_CASE("Algorithm 1 refutes data with gross outliers, Algorithm 2 tolerates them") {
    draws d(364);
    auto const planted = support::plant(d, 0, {.samples = 15, .outliers = 2, .noise = 0.03});
    auto exact = planted.problem;
    for (auto& e : exact.experiments) e.outliers = 0;
    auto const strict = identify(exact, quick(algorithm::bisection, 1.0 / 64, 5000));
    CHECK(strict.verdict == verdict::inconsistent);
    auto const tolerant = identify(planted.problem, quick(algorithm::bisection, 1.0 / 64, 5000));
    CHECK(tolerant.verdict == verdict::consistent);
    check_claims(planted, tolerant, d, 2);
}

TEST_CASE("gross outliers that every feasible parameter violates are named") {
    draws d(365);
    int named = 0;
    for (int round = 0; round < 5; ++round) {
        auto planted = support::plant(d, 0, {.samples = 15, .outliers = 2, .noise = 0.02});
        for (auto const k : planted.outliers[0]) {
            auto& bound = planted.problem.experiments[0].measurements[k].bound;
            bound = support::around(mid(bound) + 3, 0.02);
        }
        auto const found = identify(planted.problem, quick(algorithm::contracting, 1.0 / 32, 500));
        named += static_cast<int>(found.forced.size());
        check_claims(planted, found, d, 2);
    }
    CHECK(named >= 8);
}

TEST_CASE("budgets and cancellation leave the truth in what is left") {
    draws d(366);
    auto const planted = support::plant(d, 4, {.samples = 8, .noise = 0.05});
    auto options = quick(algorithm::contracting, 1e-4, 30);
    auto const few = identify(planted.problem, options);
    CHECK(few.boxes <= 30);
    CHECK((few.reason == stop_reason::box_budget || few.reason == stop_reason::inside_share));
    check_claims(planted, few, d, 0);
    options.search.seconds = 0;
    auto const none = identify(planted.problem, options);
    CHECK(none.reason == stop_reason::time_budget);
    check_claims(planted, none, d, 0);
    options.search.seconds = 20;
    int calls = 0;
    options.search.progress = [&calls](paving_progress const&) { return ++calls < 5; };
    auto const cancelled = identify(planted.problem, options);
    CHECK(cancelled.reason == stop_reason::cancelled);
    CHECK(cancelled.paving.count(box_verdict::pending) > 0);
    check_claims(planted, cancelled, d, 0);
    // The same from within integrations and simulations, at any time.
    options.search.progress = nullptr;
    for (std::size_t const most : {0u, 1u, 30u, 300u, 3000u}) {
        std::atomic<std::size_t> asked = 0;
        options.search.keep_going = [&] { return ++asked <= most; };
        auto const stopped = identify(planted.problem, options);
        CHECK((stopped.reason == stop_reason::cancelled || asked <= most));
        check_claims(planted, stopped, d, 0);
    }
}

TEST_CASE("exact measurements do not stop the search") {
    identification_problem problem;
    problem.model =
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{-(p[0] * x[0])};
        });
    problem.choice.unknown = {"p0"};
    problem.prior = box{between(0.5, 1.5)};
    experiment e;
    e.name = "E";
    e.initial = box{interval(1.0)};
    e.measurements = {{0, 0, interval(1.0)}, {1, 0, interval(0.5)}};
    problem.experiments = {e};
    auto const found = identify(problem, quick(algorithm::contracting, 1e-6, 2000));
    CHECK(found.verdict != verdict::inconsistent);
    CHECK(contains(found.hull[0], std::log(2.0)));
    CHECK(width(found.hull[0]) < 1e-5);
}

TEST_CASE("problems that do not fit are refused before any work") {
    draws d(367);
    auto const sound = support::plant(d, 0, {}).problem;
    auto p = sound;
    p.choice.unknown = {"p0", "mass"};
    CHECK_THROWS_WITH(identify(p), ContainsSubstring("mass"));
    p = sound;
    p.prior = box{between(0, 1)};
    CHECK_THROWS_AS(identify(p), std::invalid_argument);
    p = sound;
    p.prior[0] = between(0, HUGE_VAL);
    CHECK_THROWS_AS(identify(p), std::invalid_argument);
    p = sound;
    p.experiments[0].initial[0] = interval_traits<interval>::entire();
    CHECK_THROWS_AS(identify(p), std::invalid_argument);
    p = sound;
    p.experiments[0].inputs = {sampled_signal({0}, {1}, interpolation::hold)};
    CHECK_THROWS_AS(identify(p), std::invalid_argument);
    p = sound;
    p.experiments[0].measurements[0].time = HUGE_VAL;
    CHECK_THROWS_AS(identify(p), std::invalid_argument);
}

TEST_CASE("products with outliers and uncertain starts keep the truth, with volumes that hold") {
    draws d(367);
    int measured = 0;
    for (int round = 0; round < 24; ++round) {
        auto const q = d.below(3);
        auto const planted = support::plant(d, 2,
                                            {.experiments = 1 + d.below(3),
                                             .samples = 8 + d.below(8),
                                             .outliers = q,
                                             .noise = d.uniform(0.01, 0.15),
                                             .spread = d.coin() ? 0.02 : 0.0});
        auto options = quick(algorithm::contracting, 1.0 / 64, 200);
        options.only_hulls = d.below(3) == 0;
        options.drawn_boxes = 50 + d.below(500);
        CAPTURE(round, q);
        auto const found = identify(planted.problem, options);
        check_claims(planted, found, d, q);
        CHECK(found.volumes == volume_source::preimage);
        // A sample of the prior: what explains the data for the planted starts is not excluded.
        for (int sample = 0; sample < 40; ++sample) {
            auto const p = d.in(found.hull);
            bool holds = true;
            for (std::size_t e = 0; e < planted.starts.size(); ++e) {
                holds = holds && planted.violated(e, p, planted.starts[e], -1e-10) <= q;
            }
            if (!holds) continue;
            bool covered = false;
            for (auto const& b : found.paving.boxes()) {
                covered = covered || (b.verdict != box_verdict::outside && contains(b.set, p));
            }
            CHECK(covered);
        }
        measured += found.paving.inner_volume().lower() > 0 ? 1 : 0;
        double drawn_inside = 0;
        double drawn_left = 0;
        for (auto const& b : found.paving.boxes()) {
            double const share = mid(relative_volume(b.set, planted.problem.prior));
            drawn_inside += b.verdict == box_verdict::inside ? share : 0;
            drawn_left += b.verdict != box_verdict::outside ? share : 0;
        }
        CHECK(drawn_inside <= found.paving.inner_volume().upper() * (1 + 1e-9));
        CHECK(drawn_left >= found.paving.outer_volume().lower() * (1 - 1e-9));
    }
    CHECK(measured > 5);
}

TEST_CASE("hulls alone take few boxes and are no wider than those of a paving by much") {
    draws d(368);
    auto const planted = support::plant(d, 0, {.samples = 15, .noise = 0.03});
    auto options = quick(algorithm::contracting, 1.0 / 256, 5000);
    options.search.sufficient_ratio = 0.9;
    auto const paved = identify(planted.problem, options);
    options.only_hulls = true;
    auto const hulls = identify(planted.problem, options);
    CHECK(hulls.boxes < paved.boxes);
    for (std::size_t j = 0; j < 2; ++j) {
        CHECK(width(hulls.hull[j]) < 1.1 * width(paved.hull[j]));
    }
    check_claims(planted, hulls, d, 0);
}

TEST_CASE("a fit that stops just short of the bounds is sharpened before nothing is said") {
    // Bounds are scaled so that the first fit misses them and its neighbour keeps them.
    draws d(365);
    int tried = 0;
    for (int round = 0; round < 60 && tried < 4; ++round) {
        auto planted = support::plant(d, d.below(support::planted_models),
                                      {.experiments = 2, .samples = 40, .spread = 0.01});
        auto& problem = planted.problem;
        auto const first = fit(problem);
        auto const sharp = fit(problem, fit_norm::largest, {first.parameters, first.starts});
        if (!(sharp.inflation < 0.9999 * first.inflation) || first.inflation > 1.04) continue;
        double const between_both = 0.5 * (first.inflation + sharp.inflation);
        for (auto& e : problem.experiments) {
            for (auto& m : e.measurements) {
                double const c = mid(m.bound), r = rad(m.bound) * between_both;
                m.bound = between(c - r, c + r);
            }
        }
        if (fit(problem).inflation <= 1) continue;
        ++tried;
        auto const found = identify(problem, quick(algorithm::contracting, 1.0 / 8, 30));
        CAPTURE(round, first.inflation, sharp.inflation);
        CHECK(found.verdict == verdict::consistent);
        CHECK(found.witness);
        REQUIRE(found.guess);
        CHECK(found.guess->inflation <= 1);
    }
    CHECK(tried > 0);
}

TEST_CASE("a state of other data is not resumed, nor one that has lost what explains the data") {
    auto const with_rate = [](double rate) {
        auto problem = plain_problem::make(0, 1);
        for (auto& m : problem.experiments[0].measurements) {
            double const x = 2 * std::exp(-rate * m.time);
            m.bound = interval(x - 0.05, x + 0.05);
        }
        return problem;
    };
    identify_options options;
    options.search.accuracy = 1.0 / 4096;
    options.search.sufficient_ratio = 1;
    options.search.seconds = 30;
    auto first = options;
    first.search.boxes = 20;
    std::optional<identification_state> saved;
    first.checkpoint = [&](identification_state const& s) { saved = s; };
    (void)identify(with_rate(0.35), first);
    REQUIRE(saved);
    auto const resumed = [&](identification_problem const& problem, identification_state const& s) {
        auto going_on = options;
        going_on.resume = std::make_shared<identification_state const>(s);
        return identify(problem, going_on);
    };
    CHECK(contains(resumed(with_rate(0.35), *saved).hull, std::vector<double>{0.35}));
    CHECK_THROWS_WITH(resumed(with_rate(0.8), *saved), ContainsSubstring("another problem"));
    auto fewer = with_rate(0.35); // the same readings, all of which must hold
    fewer.experiments[0].outliers = 0;
    CHECK_THROWS_AS(resumed(fewer, *saved), std::invalid_argument);
    auto forged = *saved; // what is excluded, and nothing else
    forged.search.paved = {{forged.search.prior, box_verdict::outside}};
    forged.search.waiting.clear();
    forged.search.lessons.clear();
    forged.search.waiting_volume = 0;
    CHECK_THROWS_AS(resumed(with_rate(0.35), forged), std::logic_error);
    forged = {};
    forged.search = saved->search;
    CHECK_THROWS_AS(resumed(with_rate(0.35), forged), std::invalid_argument);
}

TEST_CASE("parameters that are seen through their sum alone are searched in it") {
    auto const m = support::model_of({1, 2, 0, 1e9},
                                     [](auto const&, auto const& x, auto const& p, auto const&) {
                                         return std::vector{(1 - x[0]) / (p[0] + p[1])};
                                     });
    experiment e{"S", {}, 0, {interval(0)}, {}, 0};
    for (int k = 1; k <= 20; ++k) {
        double const x = 1 - std::exp(-0.2 * k / 1.6);
        e.measurements.push_back({0.2 * k, 0, between(x - 0.01, x + 0.01)});
    }
    identification_problem const p{
        m, {support::all_constants(2), {}}, {between(0.5, 2), between(0.1, 1)}, {e}};
    auto const found = identify(p, quick(algorithm::contracting, 1.0 / 64, 200));
    CHECK(found.verdict == verdict::consistent);
    REQUIRE(found.combinations.size() == 1);
    CHECK(found.combinations[0].what.is_sum());
    CHECK(contains(found.combinations[0].hull, 1.6));
    CHECK(width(found.combinations[0].hull) < 0.1);
    CHECK(contains(found.hull, std::vector<double>{1.2, 0.4}));
    CHECK_FALSE(found.products);
    for (double const dm : {0.15, 0.4, 0.9}) { // all of which have that sum
        std::vector<double> const truth{1.6 - dm, dm};
        CHECK(std::ranges::any_of(found.paving.boxes(), [&](paved_box const& b) {
            return b.verdict != box_verdict::outside && contains(b.set, truth);
        }));
    }
    CHECK(found.paving.outer_volume().upper() < 0.3);
}
