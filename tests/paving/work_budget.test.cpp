// SPDX-License-Identifier: MIT
// Budgets count work: what a search finds within one depends neither on threads, nor on the load of
// the machine, nor on where it was interrupted.
#include <sivid/paving/identify.hpp>

#include "support/catch.hpp"
#include "support/oscillator_in_units.hpp"
#include "support/threads.hpp"

#include <chrono>
#include <cstddef>
#include <memory>
#include <thread>

using namespace sivid;

namespace {

struct found {
    std::size_t boxes, integrations, paved;
    double work;
    stop_reason reason;
    box hull;
};

identification_problem problem() { return support::in_units::problem_in({}, {}, {4, 40}); }

/// Within an outer limit, so that the time of a loaded machine has no say.
identify_options budget(double seconds) {
    identify_options options;
    options.search.seconds = seconds;
    options.search.accuracy = 1e-9;
    options.search.sufficient_ratio = 1;
    options.search.keep_going = work_limit(1e6);
    return options;
}
found result_of(identification const& of) {
    REQUIRE(of.effort);
    return {of.effort->boxes,   of.integrations, of.paving.boxes().size(),
            of.effort->seconds, of.reason,       of.hull};
}
void check_same(found const& a, found const& b) {
    CHECK(a.boxes == b.boxes);
    CHECK(a.integrations == b.integrations);
    CHECK(a.paved == b.paved);
    CHECK(a.reason == b.reason);
    CHECK(subset(a.hull, b.hull));
    CHECK(subset(b.hull, a.hull));
}

} // namespace

TEST_CASE("a budget of work ends a search at the same box, with any threads and on any machine") {
    auto const once = result_of(identify(problem(), budget(0.3)));
    CHECK(once.reason == stop_reason::time_budget);
    CHECK(once.boxes > 20);
    SECTION("with two threads") {
        auto options = budget(0.3);
        options.search.workers = support::threads(2);
        auto const other = result_of(identify(problem(), options));
        check_same(other, once);
        CHECK_THAT(other.work, Catch::Matchers::WithinRel(once.work, 1e-9));
    }
    SECTION("on a machine that is slow") {
        auto options = budget(0.3);
        std::size_t asked = 0;
        options.search.progress = [&asked](paving_progress const&) {
            if (++asked % 8 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(3));
            return true;
        };
        check_same(result_of(identify(problem(), options)), once);
    }
}

TEST_CASE("a search resumed from a smaller budget ends at the same box, with the same count") {
    for (double const all : {0.1, 0.15, 0.2, 0.25, 0.31, 0.4}) {
        auto const once = result_of(identify(problem(), budget(all)));
        for (double const share : {0.5, 0.7}) {
            CAPTURE(all, share);
            std::shared_ptr<identification_state const> state;
            auto first = budget(share * all);
            first.checkpoint = [&state](identification_state const& now) {
                state = std::make_shared<identification_state const>(now);
            };
            (void)identify(problem(), first);
            REQUIRE(state);
            auto second = budget(all);
            second.resume = state;
            auto const resumed = result_of(identify(problem(), second));
            check_same(resumed, once);
            CHECK_THAT(resumed.work, Catch::Matchers::WithinRel(once.work, 1e-9));
        }
    }
}

TEST_CASE("where the time ended a search, the result says so") {
    auto options = budget(1);
    options.search.keep_going = nullptr;
    options.search.progress = [](paving_progress const&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        return true;
    };
    CHECK(identify(problem(), options).by_clock);
    CHECK_FALSE(identify(problem(), budget(0.1)).by_clock);
}
