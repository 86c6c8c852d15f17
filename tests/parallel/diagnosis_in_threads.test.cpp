// SPDX-License-Identifier: MIT
// Threads change nothing of a diagnosis but its time.
#include <sivid/diagnosis/diagnose.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"
#include "support/threads.hpp"

#include <sivid/approximate/candidate/screening.hpp>

#include <atomic>

using namespace sivid;

namespace {

diagnosis_run diagnosed(identification_problem const& problem, executor const& workers) {
    diagnosis_options options;
    options.seconds = 600;
    options.test.workers = workers;
    auto run = diagnose(problem, small_campaign::catalogue(), options);
    judge_by_holdout(run, holdout({small_campaign::experiment(2, small_campaign::with_drag(0.3))}),
                     600, options.test);
    return run;
}
bool same(interval const& a, interval const& b) {
    return a.lower() == b.lower() && a.upper() == b.upper();
}
void check_same(std::vector<named_estimate> const& a, std::vector<named_estimate> const& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        CHECK(a[k].name == b[k].name);
        CHECK(same(*a[k].hull, *b[k].hull));
    }
}

} // namespace

TEST_CASE("a diagnosis in several threads says the same") {
    auto real = small_campaign::with_drag(0.3);
    real.seen_position = small_campaign::with_scale(0.15).seen_position;
    auto const problem = small_campaign::problem(real);
    auto const one = diagnosed(problem, {});
    auto const& a = one.result;
    REQUIRE(a.effects.size() == 2);
    for (std::size_t const count : {2U, 3U}) {
        auto const several = diagnosed(problem, support::threads(count));
        auto const& b = several.result;
        CHECK(b.effects == a.effects);
        CHECK(same(b.inflation, a.inflation));
        check_same(b.scenario_inflation, a.scenario_inflation);
        check_same(b.channel_inflation, a.channel_inflation);
        REQUIRE(b.causes.size() == a.causes.size());
        for (std::size_t k = 0; k < a.causes.size(); ++k) {
            CHECK(b.causes[k].effects == a.causes[k].effects);
            CHECK(b.causes[k].verdict == a.causes[k].verdict);
            CHECK(same(b.causes[k].inflation, a.causes[k].inflation));
        }
        REQUIRE(one.holdout_after);
        REQUIRE(several.holdout_after);
        CHECK(same(several.holdout_after->at_witness, one.holdout_after->at_witness));
        REQUIRE(one.holdout_before->over_fits);
        REQUIRE(several.holdout_before->over_fits);
        CHECK(same(*several.holdout_before->over_fits, *one.holdout_before->over_fits));
    }
}

TEST_CASE("a screening in several threads can be stopped, and keeps what was fitted") {
    std::atomic<int> calls = 0;
    screening_options options;
    options.workers = support::threads(3);
    options.progress = [&](std::string const&) { return ++calls <= 3; };
    screening s(small_campaign::problem(small_campaign::with_drag(0.3)),
                small_campaign::catalogue(), options);
    s.run();
    CHECK_FALSE(s.counts().complete());
    CHECK(s.candidates().size() == 3);
    CHECK(s.candidates()[0].figures.effects.empty());
    CHECK(calls == 4);
}
