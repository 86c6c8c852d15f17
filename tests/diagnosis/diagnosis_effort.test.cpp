// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/diagnosis_effort.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("a step gets its share of the time, and boxes that count all experiments") {
    diagnosis_effort effort(100, {}, {});
    auto const p = small_campaign::problem();
    auto const search = effort.search(p, {20, 0.25});
    CHECK(search.seconds == 25);
    CHECK(search.boxes == 60); // two experiments and a bound for each box
    inflation_bound found;
    found.boxes = 20;
    found.integrations = 40;
    CHECK(diagnosis_effort::boxes_of(p, found) == 21);
    CHECK(effort.seconds_of({1, 2.0}) <= 100);
    auto const observers = effort.observers({70, 0.25});
    CHECK(observers.boxes == 70);
    CHECK(observers.seconds == 25);
    CHECK(observers.go_on());
    CHECK(effort.within(0.5)());
    CHECK_FALSE(effort.within(-1)()); // it was to have ended already
}

TEST_CASE("what is asked whether to go on can stop a diagnosis for good") {
    int calls = 0;
    diagnosis_effort effort(100, {}, [&](std::string const& what) {
        CHECK(what == "a step");
        return ++calls < 2;
    });
    CHECK(effort.go_on("a step"));
    CHECK_FALSE(effort.stopped());
    CHECK_FALSE(effort.go_on("a step"));
    CHECK(effort.stopped());
    diagnosis_effort none(0, {}, {});
    CHECK(none.left() == 0);
    CHECK_FALSE(none.go_on("a step"));
}

TEST_CASE("runs have the clock of the diagnosis, and what was asked before") {
    diagnosis_effort none(0, {}, {});
    CHECK_FALSE(none.test().witness.keep_going());
    diagnosis_effort effort(100, {}, {});
    CHECK(effort.test().keep_going());
    diagnosis_effort stopped(100, limited({}, [] { return false; }), {});
    CHECK_FALSE(stopped.test().keep_going());
}
