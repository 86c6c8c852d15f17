// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <sivid/report/diagnosis_view.hpp>

#include <algorithm>
#include <string>

using namespace sivid::report;

TEST_CASE("diagnosis view: candidates are found whatever the order of their effects") {
    diagnosis_view v;
    v.candidates = {{.effects = {"a", "b"}}, {.effects = {}}, {.effects = {"b"}}};
    CHECK(find_candidate(v, {"b", "a"}) == &v.candidates[0]);
    CHECK(find_candidate(v, {}) == &v.candidates[1]);
    CHECK(find_candidate(v, {"a"}) == nullptr);
}

TEST_CASE("diagnosis view: the answer is a candidate only when there is one") {
    diagnosis_view v;
    v.candidates = {{.effects = {"a"}}, {.effects = {}}};
    v.effects = {"a"};
    CHECK(answer_of(v) == nullptr);
    v.answer = answer_state::effects;
    CHECK(answer_of(v) == &v.candidates[0]);
    v.effects.clear(); // never the model as it is
    CHECK(answer_of(v) == nullptr);
}

TEST_CASE("diagnosis view: the foremost candidates keep their order and never lose the answer") {
    diagnosis_view v;
    for (int k = 0; k < 30; ++k) v.candidates.push_back({.effects = {std::to_string(k)}});
    v.candidates.push_back({});
    v.answer = answer_state::effects;
    v.effects = {"25"};
    v.indistinguishable = {{"20"}, {"not tried"}};
    auto const few = foremost(v, 6);
    REQUIRE(few.size() == 6);
    CHECK(std::is_sorted(few.begin(), few.end()));
    CHECK(few[0]->effects[0] == "0");
    CHECK(few[3]->effects[0] == "20");
    CHECK(few[4]->effects[0] == "25");
    CHECK(few[5]->effects.empty());
    CHECK(foremost({}, 6).empty());
}
