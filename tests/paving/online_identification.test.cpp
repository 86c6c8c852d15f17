// SPDX-License-Identifier: MIT
// Measurements one by one, against the planted truth and against all of them at once.
#include <sivid/paving/online_identification.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"
#include "support/epidemic.hpp"
#include "support/problems.hpp"
#include "support/some_start.hpp"

#include <sivid/paving/identify.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <random>
#include <thread>
#include <utility>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::planted_problem;

namespace {

std::vector<online_sample> samples_of(identification_problem const& problem) {
    std::vector<online_sample> all;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        for (auto const& m : problem.experiments[e].measurements) all.push_back({e, m});
    }
    std::stable_sort(all.begin(), all.end(),
                     [](auto const& a, auto const& b) { return a.what.time < b.what.time; });
    return all;
}

identification_problem without_samples(identification_problem problem) {
    for (auto& e : problem.experiments) e.measurements.clear();
    return problem;
}

bool covers(identification const& found, std::vector<double> const& p) {
    return std::any_of(
        found.paving.boxes().begin(), found.paving.boxes().end(),
        [&](auto const& b) { return b.verdict != box_verdict::outside && contains(b.set, p); });
}

online_options quick() {
    online_options o;
    o.refinement.boxes = 60;
    o.refinement.live = 24;
    o.refinement.seconds = 1e9; // the machine's speed decides nothing
    o.drawn_boxes = 200;
    return o;
}

/// Everything that the final result claims.
void check_result(planted_problem const& planted, identification const& found, draws& d,
                  std::size_t allowed) {
    CHECK(found.verdict != verdict::inconsistent);
    CHECK(contains(found.hull, planted.truth));
    CHECK(covers(found, planted.truth));
    for (auto const& f : found.forced) {
        CHECK(planted.outliers[f.experiment].count(f.measurement) == 1);
    }
    if (found.witness) {
        for (std::size_t e = 0; e < planted.starts.size(); ++e) {
            auto const& w = *found.witness;
            CHECK(planted.violated(e, w.parameters, w.starts[e], 1e-10) <= allowed);
            REQUIRE(w.violated[e].size() == planted.problem.experiments[e].measurements.size());
            auto const y = planted.simulate(e, w.parameters, w.starts[e]);
            auto const samples = sorted(planted.problem.experiments[e].measurements);
            for (std::size_t i = 0; i < y.size(); ++i) {
                if (w.violated[e][i]) continue; // else it holds by proof
                CHECK(static_cast<double>(y[i]) >= samples[i].bound.lower() - 1e-10);
                CHECK(static_cast<double>(y[i]) <= samples[i].bound.upper() + 1e-10);
            }
        }
    }
    int sampled = 0;
    for (auto const& b : found.paving.boxes()) {
        if (b.verdict != box_verdict::inside || ++sampled > 12) continue;
        auto const p = d.in(b.set);
        for (std::size_t e = 0; e < planted.starts.size(); ++e) {
            CHECK(support::some_start_explains(planted, e, p, {planted.starts[e]}, 1e-10));
        }
    }
}

enum class arrival { in_time, in_groups, shuffled };

void compare_with_batch(std::uint64_t seed, int problems, int& wider, int& consistent) {
    draws d(seed);
    for (int round = 0; round < problems; ++round) {
        support::planting how;
        how.experiments = 1 + d.below(2);
        how.samples = 5 + d.below(8);
        how.outliers = d.below(3);
        how.spread = d.below(3) == 0 ? 0.01 : 0;
        how.noise = d.uniform(0.01, 0.08);
        auto const model = d.below(support::planted_models);
        auto const planted = support::plant(d, model, how);
        auto const order = static_cast<arrival>(d.below(3));
        auto all = samples_of(planted.problem);
        if (order == arrival::shuffled) {
            for (std::size_t k = all.size(); k > 1; --k) std::swap(all[k - 1], all[d.below(k)]);
        }
        CAPTURE(seed, round, model, how.experiments, how.outliers, how.spread,
                static_cast<int>(order));
        online_identification online(without_samples(planted.problem), quick());
        auto hull = planted.problem.prior;
        for (std::size_t k = 0; k < all.size();) {
            std::vector<online_sample> group;
            auto const size = order == arrival::in_time ? 1 : 1 + d.below(3);
            while (group.size() < size && k < all.size()) group.push_back(all[k++]);
            auto const& now = online.add(group);
            CHECK(now.samples == k);
            CHECK(now.verdict != verdict::inconsistent);
            CHECK(contains(now.hull, planted.truth));
            CHECK(subset(now.hull, hull)); // what was outside stays outside
            hull = now.hull;
        }
        auto const found = online.result();
        check_result(planted, found, d, how.outliers);
        identify_options options;
        options.search.accuracy = 1.0 / 64;
        options.search.boxes = 150;
        options.drawn_boxes = 200;
        auto const batch = identify(planted.problem, options);
        consistent += found.verdict == verdict::consistent ? 1 : 0;
        if (batch.verdict == verdict::consistent) CHECK(found.verdict == batch.verdict);
        for (auto const& b : batch.paving.boxes()) {
            if (b.verdict != box_verdict::inside) continue;
            for (int member = 0; member < 2; ++member) CHECK(covers(found, d.in(b.set)));
        }
        for (std::size_t j = 0; j < hull.size(); ++j) {
            wider += width(found.hull[j]) > 1.25 * width(batch.hull[j]) ? 1 : 0;
            CHECK_FALSE(is_empty(intersect(found.hull, batch.hull)));
        }
    }
}

} // namespace

TEST_CASE("one by one, in any order, the result keeps the truth and agrees with all at once") {
    int wider = 0, consistent = 0;
    compare_with_batch(7100, 30, wider, consistent);
    CHECK(wider <= 6); // sides, of about 60
    CHECK(consistent >= 27);
    // Among these, starts that were chosen early fail measurements that come later.
    compare_with_batch(7200, 20, wider, consistent);
}
TEST_CASE("one by one against all at once, longer", "[.long]") {
    int wider = 0, consistent = 0;
    for (std::uint64_t seed = 7200; seed < 7220; ++seed) {
        compare_with_batch(seed, 50, wider, consistent);
    }
    CHECK(wider < 200);
    CHECK(consistent > 900);
}

TEST_CASE("later measurements cost no integration from the start, however many came before") {
    draws d(711);
    auto const planted = support::plant(d, 0, {.samples = 400, .noise = 0.05, .horizon = 8});
    auto options = quick();
    online_identification online(without_samples(planted.problem), options);
    std::size_t late_runs = 0, late_judged = 0, k = 0;
    for (auto const& s : samples_of(planted.problem)) {
        auto const& now = online.add(s);
        if (++k <= 200) continue;
        late_runs += now.integrations;
        late_judged += now.judged;
    }
    CHECK(late_runs <= 2);
    CHECK(late_judged < 200 * 8); // most measurements concern no box
    CHECK(online.last().verdict == verdict::consistent);
    check_result(planted, online.result(), d, 0);
}

TEST_CASE("an impossible measurement ends it for ever, unless the budget pays for it") {
    draws d(712);
    for (std::size_t q = 0; q < 3; ++q) {
        auto const planted = support::plant(d, 1, {.samples = 8, .noise = 0.03});
        auto problem = without_samples(planted.problem);
        problem.experiments[0].outliers = q;
        online_identification online(problem, quick());
        std::size_t wrong = 0;
        for (auto s : samples_of(planted.problem)) {
            CHECK(online.add(s).verdict ==
                  (wrong > q ? verdict::inconsistent : verdict::consistent));
            s.what.bound = between(500, 501);
            ++wrong;
            CHECK((online.add(s).verdict == verdict::inconsistent) == (wrong > q));
        }
        auto const found = online.result();
        CHECK(found.verdict == verdict::inconsistent);
        CHECK(is_empty(found.hull));
        CHECK_FALSE(found.paving.has_outer());
        CHECK_FALSE(found.witness);
    }
}

TEST_CASE("outliers that every parameter violates are named while data arrive") {
    draws d(713);
    std::size_t named = 0;
    for (int round = 0; round < 5; ++round) {
        auto const planted = support::plant(d, 0, {.samples = 15, .outliers = 2, .noise = 0.02});
        online_identification online(without_samples(planted.problem), quick());
        for (auto const& s : samples_of(planted.problem)) (void)online.add(s);
        auto const found = online.result();
        check_result(planted, found, d, 2);
        named += found.forced.size();
    }
    CHECK(named >= 7);
}

TEST_CASE("hulls alone are as tight as those of all measurements at once") {
    draws d(714);
    auto const planted = support::plant(d, 2, {.experiments = 2, .samples = 20, .noise = 0.03});
    auto options = quick();
    options.only_hulls = true;
    online_identification online(without_samples(planted.problem), options);
    for (auto const& s : samples_of(planted.problem)) (void)online.add(s);
    identify_options batch_options;
    batch_options.only_hulls = true;
    auto const batch = identify(planted.problem, batch_options);
    REQUIRE(online.last().combinations.size() == 1);
    CHECK(width(online.last().combinations[0].hull) <= 1.05 * width(batch.combinations[0].hull));
    check_result(planted, online.result(), d, 0);
}

TEST_CASE("idle time refines, and without measurements everything is feasible") {
    draws d(715);
    auto const planted = support::plant(d, 4, {.samples = 10, .noise = 0.05});
    auto options = quick();
    options.refinement.boxes = 4;
    online_identification online(without_samples(planted.problem), options);
    CHECK(online.last().verdict == verdict::consistent);
    CHECK(subset(planted.problem.prior, online.last().hull));
    online_identification at_once(planted.problem, options); // measurements it begins with
    auto const before = at_once.last().hull;
    for (int k = 0; k < 20; ++k) (void)at_once.refine();
    CHECK(width(at_once.last().hull) <= width(before));
    CHECK(contains(at_once.last().hull, planted.truth));
    CHECK(at_once.last().samples == 10);
}

TEST_CASE("a result says what ended the refinement, and calls itself complete only then") {
    auto const reason_of = [](online_options const& o, int idle = 0) {
        online_identification online(plain_problem::make(0, 0, between(1.5, 2.5)), o);
        for (int k = 0; k < idle; ++k) (void)online.refine();
        return online.result().reason;
    };
    online_options all;
    all.refinement.seconds = 1e9;
    CHECK(reason_of(all) == stop_reason::inside_share);
    auto hulls = all;
    hulls.only_hulls = true;
    hulls.refinement.sufficient_ratio = 1;
    hulls.refinement.accuracy = 0;
    hulls.refinement.live *= 8;
    CHECK(reason_of(hulls) == stop_reason::hulls_rest);
    for (int const idle : {0, 1, 3}) {
        auto o = hulls;
        o.refinement.live = 1; // nothing is split
        CHECK(reason_of(o, idle) == stop_reason::box_budget);
        o = hulls;
        o.refinement.boxes = 1;
        CHECK(reason_of(o, idle) == stop_reason::box_budget);
        o = all;
        o.refinement.seconds = 0;
        CHECK(reason_of(o, idle) == stop_reason::time_budget);
        o.test.keep_going = [] { return false; };
        CHECK(reason_of(o, idle) == stop_reason::cancelled);
    }
    online_identification impossible(plain_problem::make(2, 0), all);
    CHECK(impossible.result().reason == stop_reason::decided);
    auto fine = all;
    fine.refinement.sufficient_ratio = 1;
    fine.refinement.accuracy = 0.1;
    online_identification ends(plain_problem::make(), fine);
    auto const found = ends.result();
    CHECK(found.reason == stop_reason::accuracy_reached);
    CHECK(found.paving.count(box_verdict::undecided) > 0);
    for (auto const& b : found.paving.boxes()) {
        if (b.verdict != box_verdict::undecided) continue;
        CHECK(width(b.set[0]) <= 0.1 * width(found.hull[0]));
    }
}

TEST_CASE("an update ends in time but for a run that was begun, and what it lacks comes later") {
    auto options = quick();
    options.refinement.seconds = 0.02;
    bool slow = true; // one run takes longer than an update may
    options.test.keep_going = [&slow] {
        if (slow) std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return true;
    };
    online_identification online(plain_problem::make(0, 0, between(1.5, 2.5)), options);
    CHECK(online.last().integrations == 1);
    CHECK(online.last().verdict == verdict::undecided);
    slow = false;
    CHECK(online.result().reason == stop_reason::time_budget);
    for (int k = 0; k < 1000 && online.last().verdict == verdict::undecided; ++k) {
        (void)online.refine();
    }
    CHECK(online.last().verdict == verdict::consistent);
}

TEST_CASE("measurements that fit nothing are refused and change nothing") {
    draws d(716);
    auto const planted = support::plant(d, 0, {});
    online_identification online(planted.problem, quick());
    auto const before = online.last().hull;
    auto const good = planted.problem.experiments[0].measurements[0];
    auto bad = good;
    bad.channel = 7;
    CHECK_THROWS_WITH(online.add({online_sample{0, good}, online_sample{0, bad}}),
                      ContainsSubstring("channel"));
    bad = good;
    bad.time = -1;
    CHECK_THROWS_WITH(online.add(online_sample{0, bad}), ContainsSubstring("before the begin"));
    bad.time = HUGE_VAL;
    CHECK_THROWS_AS(online.add(online_sample{0, bad}), std::invalid_argument);
    bad = good;
    bad.bound = interval_traits<interval>::empty();
    CHECK_THROWS_AS(online.add(online_sample{0, bad}), std::invalid_argument);
    CHECK_THROWS_AS(online.add(online_sample{3, good}), std::invalid_argument);
    CHECK(online.problem().experiments[0].measurements.size() ==
          planted.problem.experiments[0].measurements.size());
    CHECK(subset(before, online.last().hull));
}

TEST_CASE("contractors are asked while data arrive where runs over what is left say nothing") {
    for (double const factor : {1., 8.}) {
        auto whole = support::infection(1e4, factor);
        auto const arriving = std::exchange(whole.experiments[0].measurements, {});
        online_options options;
        options.refinement.seconds = 1e6;
        options.refinement.boxes = 100;
        auto const after_all = [&] {
            online_identification now(whole, options);
            for (auto const& m : arriving) now.add({0, m});
            return now.last();
        };
        auto const found = after_all();
        if (factor == 1) CHECK(contains(found.hull, std::vector<double>{0.5, 0.3}));
        CHECK((factor == 1 ? found.hull[0].upper() < 2 : found.verdict == verdict::inconsistent));
        options.strategy = {};
        auto const alone = after_all();
        CHECK_FALSE(
            (factor == 1 ? alone.hull[0].upper() < 100 : alone.verdict == verdict::inconsistent));
    }
}
