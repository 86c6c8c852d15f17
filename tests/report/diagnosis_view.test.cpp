// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <sivid/report/diagnosis_view.hpp>

#include <algorithm>
#include <string>
#include <vector>

using namespace sivid::report;

namespace {

std::vector<sivid::cause> with(std::vector<std::vector<std::string>> const& effects) {
    std::vector<sivid::cause> causes(effects.size());
    for (std::size_t k = 0; k < effects.size(); ++k) causes[k].effects = effects[k];
    return causes;
}

} // namespace

TEST_CASE("diagnosis view: candidates are found whatever the order of their effects") {
    diagnosis_view v;
    v.causes = with({{"a", "b"}, {}, {"b"}});
    CHECK(find_candidate(v, {"b", "a"}) == &v.causes[0]);
    CHECK(find_candidate(v, {}) == &v.causes[1]);
    CHECK(find_candidate(v, {"a"}) == nullptr);
}

TEST_CASE("diagnosis view: the answer is a candidate only when there is one") {
    diagnosis_view v;
    v.causes = with({{"a"}, {}});
    v.effects = {"a"};
    CHECK(answer_of(v) == nullptr);
    v.answer = sivid::answer_kind::effects;
    CHECK(answer_of(v) == &v.causes[0]);
    v.effects.clear(); // never the model as it is
    CHECK(answer_of(v) == nullptr);
}

TEST_CASE("diagnosis view: numbers of a candidate are those of its witness where it explains") {
    sivid::cause c;
    c.verdict = sivid::cause_verdict::explains;
    c.parameters = {{"lag.tau", "s", 0.169}, {"lag.k", "1", 2}};
    c.onsets = {{"S1", "s", 0.5}};
    c.ends = {{"S2", "s", 1.5}};
    c.witness = sivid::named_witness{{{"Sv", "m^2", 1}, {"lag.tau", "s", 0.17}}, {}};
    auto const all = parameters_of(c);
    REQUIRE(all.size() == 4);
    CHECK(all[0].number.value == 0.17);
    CHECK(all[0].verified);
    CHECK(all[1].number.value == 2);
    CHECK_FALSE(all[1].verified); // no witness has it
    CHECK(all[2].number.name == "onset in S1");
    CHECK(all[2].verified);
    CHECK(all[3].number.name == "end in S2");
    c.verdict = sivid::cause_verdict::undecided; // the witness is one of a larger inflation
    for (auto const& e : parameters_of(c)) CHECK_FALSE(e.verified);
    CHECK(parameters_of(c)[0].number.value == 0.169);
}

TEST_CASE("diagnosis view: the foremost candidates keep their order and never lose the answer") {
    diagnosis_view v;
    for (int k = 0; k < 30; ++k) v.causes.push_back(with({{std::to_string(k)}})[0]);
    v.causes.push_back({});
    v.answer = sivid::answer_kind::effects;
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
