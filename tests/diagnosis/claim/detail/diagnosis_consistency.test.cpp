// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/claim/detail/diagnosis_consistency.hpp>

#include <sivid/diagnosis/claim/detail/claim_review.hpp>

#include "support/catch.hpp"

#include <functional>

using namespace sivid;

namespace {

/// A diagnosis in which everything fits.
diagnosis sound() {
    diagnosis d;
    d.gap = gap_verdict::certified;
    d.inflation = interval(2, 5);
    d.relations.push_back({"sway", {"u", "v", "r"}, true, {"u' varies little"}, {}, false});
    d.relations.push_back({"psi", {"psi", "v"}, true, {}, {{"S2", 0, 1}}, true});
    suspected_place p{"equation", "sway", true, {"S1", 1, 2}, interval(1, 3), 2, "m/s^2", "", ""};
    p.assumptions = {"one sensor at most errs"};
    d.where.push_back(p);
    d.where.push_back({"sensor", "x", false, {"S1", 1, 2}, std::nullopt, 0.2, "m", "", ""});
    cause wind;
    wind.effects = {"wind"};
    wind.verdict = cause_verdict::explains;
    wind.inflation = interval(0.2, 0.9);
    wind.parameters = {{"wind.wx", "m/s", 0.5, interval(0, 1)}};
    wind.witness = named_witness{{{"wind.wx", "m/s", 0.5, std::nullopt}}, {}};
    wind.untouched = {"psi_other"};
    cause trim;
    trim.effects = {"trim"};
    trim.verdict = cause_verdict::excluded;
    trim.excluded_by = "sway";
    trim.untouched = {"sway"};
    trim.assumptions = {"u' varies little"};
    cause both;
    both.effects = {"wind", "trim"};
    both.inflation = interval(0, 0.8);
    both.verdict = cause_verdict::explains;
    d.causes = {wind, both, trim};
    d.answer = answer_kind::effects;
    d.effects = {"wind"};
    d.shrink_fit = shrink(d.inflation, wind.inflation);
    d.scenario_inflation = {{"S1", "1", 0, interval(1, 3)}, {"S2", "1", 0, interval(0, 3)}};
    d.channel_inflation = {{"v", "1", 0, interval(1.5, 3)}};
    d.confined = {{"v", {}, interval(2, 6), {}, {"inputs are held"}}};
    return d;
}

} // namespace

TEST_CASE("a diagnosis whose claims fit together is left as it is") {
    auto d = sound();
    for (auto const& c : find_contradictions(d)) FAIL(c.claim + ": " + c.reason);
    withdraw_contradictions(d);
    CHECK(d.withdrawn.empty());
    CHECK(d.relations.size() == 2);
    CHECK(find_contradictions(diagnosis{}).empty());
}

TEST_CASE("each contradiction is found and withdrawn with what rests on it") {
    using change = std::function<void(diagnosis&)>;
    using check = std::function<bool(diagnosis const&)>;
    struct forgery {
        char const* what;
        change make;
        check settled;
    };
    std::vector<forgery> const all{
        {"certified below 1", [](auto& d) { d.inflation = interval(0.5, 5); },
         [](auto const& d) { return d.gap == gap_verdict::undecided; }},
        {"none above 1",
         [](auto& d) {
             d = diagnosis{};
             d.gap = gap_verdict::none;
             d.inflation = interval(0, 1.5);
         },
         [](auto const& d) { return d.gap == gap_verdict::undecided; }},
        {"no gap and a relation",
         [](auto& d) {
             d.gap = gap_verdict::none;
             d.inflation = interval(0, 0.9);
             d.where.clear();
             d.causes.clear();
             d.shrink_fit.reset();
             d.scenario_inflation.clear();
             d.answer = answer_kind::none;
         },
         [](auto const& d) { return d.relations.empty(); }},
        {"an explaining cause leaves a relation", [](auto& d) { d.causes[0].untouched = {"sway"}; },
         [](auto const& d) {
             return d.relations.size() == 1 && d.relations[0].equation == "psi" &&
                    !d.where[0].proved && !d.where[0].missing &&
                    d.causes[2].verdict == cause_verdict::undecided &&
                    d.causes[2].assumptions.empty();
         }},
        {"a place without its relation", [](auto& d) { d.where[0].name = "yaw"; },
         [](auto const& d) { return !d.where[0].proved; }},
        {"a proved sensor", [](auto& d) { d.where[1].proved = true; },
         [](auto const& d) { return !d.where[1].proved; }},
        {"a definition that is blamed", [](auto& d) { d.where[0].name = "psi"; },
         [](auto const& d) { return !d.where[0].proved; }},
        {"nothing may be missing", [](auto& d) { d.where[0].missing = interval(-1, 3); },
         [](auto const& d) { return !d.where[0].missing; }},
        {"missing without a proof", [](auto& d) { d.where[0].proved = false; },
         [](auto const& d) { return !d.where[0].missing; }},
        {"an estimate elsewhere", [](auto& d) { d.where[0].estimate = -2; },
         [](auto const& d) { return !d.where[0].missing; }},
        {"explains above 1", [](auto& d) { d.causes[1].inflation = interval(0, 1.1); },
         [](auto const& d) { return d.causes[1].verdict == cause_verdict::undecided; }},
        {"excluded at most 1", [](auto& d) { d.causes[2].inflation = interval(0, 0.5); },
         [](auto const& d) { return d.causes[2].verdict != cause_verdict::excluded; }},
        {"excluded by nothing", [](auto& d) { d.causes[2].excluded_by.clear(); },
         [](auto const& d) { return d.causes[2].verdict == cause_verdict::undecided; }},
        {"more effects do worse",
         [](auto& d) {
             d.causes[1].verdict = cause_verdict::excluded;
             d.causes[1].inflation = interval(1.5, 3);
         },
         [](auto const& d) { return d.causes[1].verdict == cause_verdict::undecided; }},
        {"an effect does worse than none",
         [](auto& d) {
             d.causes[2].excluded_by.clear();
             d.causes[2].inflation = interval(6, 7);
         },
         [](auto const& d) { return d.causes[2].verdict == cause_verdict::undecided; }},
        {"a witness outside", [](auto& d) { d.causes[0].parameters[0].hull = interval(0.6, 1); },
         [](auto const& d) { return !d.causes[0].parameters[0].hull; }},
        {"a part above the whole", [](auto& d) { d.scenario_inflation[0].hull = interval(6, 8); },
         [](auto const& d) { return !d.scenario_inflation[0].hull; }},
        {"bounds that grow by no number",
         [](auto& d) { d.confined[0].factor = unknown_inflation(); },
         [](auto const& d) { return d.confined.empty(); }},
        {"bounds of a part that need less than those of all",
         [](auto& d) { d.confined[0].factor = interval(1, 1.5); },
         [](auto const& d) { return d.confined.empty(); }},
        {"a relation without the channel that stands alone",
         [](auto& d) {
             d.relations[1].sensors = {"psi", "r"};
         },
         [](auto const& d) { return d.relations.size() == 1 && d.confined.size() == 1; }},
        {"a relation refuted where the rest is explained",
         [](auto& d) { d.confined[0].scenarios = {"S1"}; },
         [](auto const& d) { return d.relations.size() == 1 && d.confined.size() == 1; }},
        {"a scenario missed where the rest is explained",
         [](auto& d) {
             d.confined[0].scenarios = {"S1"};
             d.relations.pop_back();
             d.scenario_inflation[1].hull = interval(1.5, 2);
         },
         [](auto const& d) {
             return !d.scenario_inflation[1].hull && d.scenario_inflation[0].hull;
         }},
        {"a channel missed where the rest is explained",
         [](auto& d) {
             d.channel_inflation.push_back({"u", "1", 0, interval(1.5, 2)});
         },
         [](auto const& d) { return d.channel_inflation[0].hull && !d.channel_inflation[1].hull; }},
        {"another shrink", [](auto& d) { d.shrink_fit = interval(0.1, 0.2); },
         [](auto const& d) { return !d.shrink_fit; }},
        {"none beside a gap", [](auto& d) { d.answer = answer_kind::none; },
         [](auto const& d) { return d.answer != answer_kind::none; }},
        {"unexplained beside a cause", [](auto& d) { d.answer = answer_kind::unexplained; },
         [](auto const& d) { return d.answer == answer_kind::effects; }},
        {"open beside a cause",
         [](auto& d) {
             d.answer = answer_kind::open;
             d.effects.clear();
         },
         [](auto const& d) { return d.answer == answer_kind::effects && !d.effects.empty(); }},
        {"an excluded answer",
         [](auto& d) {
             d.effects = {"trim"};
             d.shrink_fit.reset();
         },
         [](auto const& d) { return d.effects != std::vector<std::string>{"trim"}; }},
        {"an excluded rival", [](auto& d) { d.indistinguishable = {{"trim"}}; },
         [](auto const& d) { return d.indistinguishable.empty(); }}};
    for (auto const& f : all) {
        INFO(f.what);
        auto d = sound();
        f.make(d);
        auto const found = find_contradictions(d);
        CHECK_FALSE(found.empty());
        withdraw_contradictions(d);
        CHECK(d.withdrawn.size() >= 1);
        CHECK(f.settled(d));
        for (auto const& c : find_contradictions(d)) FAIL_CHECK(c.claim + ": " + c.reason);
    }
}

TEST_CASE("what cannot vanish is not compared with less") {
    auto d = sound();
    d.causes[1].verdict = cause_verdict::excluded;
    d.causes[1].inflation = interval(1.5, 3);
    auto const never = [](std::string const& name) { return name != "trim"; };
    CHECK(find_contradictions(d, never).empty());
    CHECK_FALSE(find_contradictions(d).empty());
}

TEST_CASE("every assumption of a shown proof stands in the list of all") {
    auto d = sound();
    d.assumptions = {"inputs exact"};
    list_assumptions(d);
    CHECK(d.assumptions == std::vector<std::string>{"inputs exact", "u' varies little",
                                                    "one sensor at most errs", "inputs are held"});
    list_assumptions(d);
    CHECK(d.assumptions.size() == 4);
}
