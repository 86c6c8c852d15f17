// SPDX-License-Identifier: MIT
// What a diagnosis says beside its answer: fewer effects that explain, and what does not switch.
#include <sivid/app/detail/other_answers.hpp>

#include <catch2/catch.hpp>

#include <string>
#include <utility>
#include <vector>

namespace {

using namespace sivid;

cause cause_with(std::vector<std::string> effects, cause_verdict verdict, double fitted) {
    cause c;
    c.effects = std::move(effects);
    c.verdict = verdict;
    c.fitted_inflation = fitted;
    return c;
}

diagnosis answered(std::vector<std::string> effects) {
    diagnosis d;
    d.answer = answer_kind::effects;
    d.effects = std::move(effects);
    d.causes = {cause_with(d.effects, cause_verdict::explains, 0.7)};
    return d;
}

} // namespace

TEST_CASE("a part of the answer that is proved to explain is found") {
    auto d = answered({"saturation", "bias"});
    d.causes.push_back(cause_with({"bias"}, cause_verdict::undecided, 3));
    CHECK(app::detail::parts_that_explain(d).empty());
    d.causes.push_back(cause_with({"saturation"}, cause_verdict::explains, 2.4));
    d.causes.push_back(cause_with({"lag"}, cause_verdict::explains, 0.9)); // no part of it
    auto const parts = app::detail::parts_that_explain(d);
    REQUIRE(parts.size() == 1);
    CHECK(parts.front()->effects == std::vector<std::string>{"saturation"});
    d.answer = answer_kind::open;
    CHECK(app::detail::parts_that_explain(d).empty());
}

TEST_CASE("beside an answer that switches stands the closest cause that does not") {
    auto d = answered({"friction@S1>=0.2+S2"});
    CHECK(app::detail::closest_without_switches(d) == nullptr);
    d.causes.push_back(cause_with({"friction", "slope", "lag"}, cause_verdict::undecided, 1.516));
    d.causes.push_back(cause_with({"friction", "slope"}, cause_verdict::undecided, 1.517));
    d.causes.push_back(cause_with({"friction"}, cause_verdict::undecided, 3.4));
    d.causes.push_back(cause_with({"friction@S1"}, cause_verdict::undecided, 1.1));
    auto const* const closest = app::detail::closest_without_switches(d);
    REQUIRE(closest != nullptr);
    CHECK(closest->effects == std::vector<std::string>{"friction", "slope"});
    auto always = answered({"friction", "slope"});
    CHECK(app::detail::closest_without_switches(always) == nullptr);
}
