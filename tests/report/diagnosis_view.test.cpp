// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <sivid/report/diagnosis_view.hpp>

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
