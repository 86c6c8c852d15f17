// SPDX-License-Identifier: MIT
// The scorer on diagnoses made by hand: right, wrong, and false proofs of every kind.
#include "campaign_files.hpp"
#include "catalogue.hpp"
#include "consistency.hpp"
#include "instruments.hpp"
#include "judge.hpp"
#include "places.hpp"
#include "reading.hpp"
#include "summary.hpp"

#include "io/support.hpp"
#include "support/catch.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>

using namespace withheld;
using io_support::temporary_folder;
using json = nlohmann::json;
using strings = std::vector<std::string>;

namespace {

label labelled(std::string const& family, strings const& effects) {
    label l;
    l.id = "w0000";
    l.family = family;
    for (auto const& e : effects) l.effects.emplace_back(e, std::vector<double>{0.1});
    l.more = {{"fit_base", effects.empty() ? "0.95" : "9"},
              {"fit_base_best", effects.empty() ? "0.95" : "4"},
              {"fit_true", "0.95"},
              {"holdout_base", "5"},
              {"holdout_true", "0.9"}};
    return l;
}

/// A diagnosis that finds a lag of the rudder, with everything proved.
json good() {
    return json::parse(R"({
      "gap": {"verdict": "certified", "inflation": [3.1, 4.2]},
      "relations": [{"equation": "yaw", "sensors": ["r", "psi"], "proved": true}],
      "where": [{"kind": "equation", "name": "yaw", "proved": true}],
      "causes": [{"effects": ["rudder_lag"], "verdict": "explains", "inflation": [0.9, 0.95],
                  "parameters": {"rudder_lag.tau": [0.08, 0.12]}},
                 {"effects": ["wind"], "verdict": "excluded", "inflation": [2.4, 2.6]}],
      "answer": {"kind": "effects", "effects": ["rudder_lag"], "indistinguishable": []},
      "shrink": {"fit": [0.99, 1.0], "holdout": [0.98, 1.0]}, "next": null})");
}

json none() {
    return json::parse(R"({
      "gap": {"verdict": "none", "inflation": [null, 0.96]}, "relations": [], "where": [],
      "causes": [], "answer": {"kind": "none", "effects": [], "indistinguishable": []},
      "shrink": {"fit": null, "holdout": null}, "next": null})");
}

strings kinds_of(std::vector<finding> const& all) {
    strings kinds;
    for (auto const& f : all) kinds.push_back(f.kind);
    return kinds;
}

strings false_proofs(label const& l, json const& d, json const& baseline = {}) {
    return kinds_of(judge(l, d, baseline).false_proofs);
}

strings contradictions(json const& d) { return kinds_of(contradictions_in(d)); }

json answering(strings const& effects, json const& other = json::array()) {
    json d = good();
    d["answer"]["effects"] = effects;
    d["answer"]["indistinguishable"] = other;
    return d;
}

} // namespace

TEST_CASE("a right diagnosis") {
    auto const j = judge(labelled("single", {"rudder_lag"}), good());
    CHECK(j.right);
    CHECK(j.false_proofs.empty());
    CHECK(j.contradictions.empty());
    CHECK(j.proofs == 8); // gap, three inflations, relation, place, excluded, hull
    CHECK(j.hulls_checked == 1);
    CHECK(j.place_right == true);
    CHECK(j.gap_certified);
    CHECK(j.relation_proved);
    CHECK(j.truth_explains == true);
    CHECK(j.intervals == 1);
    CHECK(j.intervals_hold == 1);
    CHECK(j.shrink_true == 1.0);
    CHECK(j.inflation_bound == 4.0);
    CHECK(judge(labelled("none", {}), none()).right);
    CHECK(judge(labelled("none", {}), none()).place_right == true);
}

TEST_CASE("which answers count") {
    auto const lag = labelled("single", {"rudder_lag"});
    CHECK_FALSE(judge(lag, answering({"wind"})).right);
    CHECK_FALSE(judge(lag, answering({"rudder_lag", "wind"})).right);
    CHECK_FALSE(judge(lag, none()).right);
    CHECK(judge(lag, answering({"input_delay"}, {{"wind"}, {"rudder_lag"}})).right);
    json const four{{"wind"}, {"payload"}, {"cg_offset"}, {"rudder_lag"}};
    CHECK_FALSE(judge(lag, answering({"input_delay"}, four)).right);

    auto const pair = labelled("pair", {"wind", "rudder_lag"});
    CHECK(judge(pair, answering({"rudder_lag", "wind"})).right);
    CHECK_FALSE(judge(pair, answering({"rudder_lag"})).right);

    json unexplained = answering({});
    unexplained["answer"]["kind"] = "unexplained";
    CHECK(judge(labelled("outside", {"gust"}), unexplained).right);
    CHECK_FALSE(judge(lag, unexplained).right);
    // A term of an equation that the truth touches is as good; one of another is a wrong name.
    CHECK(judge(labelled("outside", {"gust"}), answering({"v'~2*wave(3*t)"})).right);
    CHECK_FALSE(judge(labelled("outside", {"gust"}), answering({"r'~2*wave(3*t)"})).right);
    CHECK_FALSE(judge(lag, answering({"v'~2*u"})).right); // the catalogue has a name for it
    CHECK_FALSE(judge(labelled("outside", {"gust"}), answering({"wind"})).right);
    CHECK(judge(labelled("outside", {"servo"}), answering({"rudder_lag"})).right);
    CHECK_FALSE(judge(labelled("outside", {"tether"}), answering({"rudder_lag"})).right);
    CHECK_FALSE(judge(labelled("none", {}), unexplained).right);

    // The parameters' priors swallow the effect: both answers are true.
    auto absorbed = lag;
    absorbed.more["fit_base_best"] = "0.9";
    CHECK(judge(absorbed, none()).right);
    CHECK(false_proofs(absorbed, none()).empty());
}

TEST_CASE("false proofs, each kind") {
    auto const lag = labelled("single", {"rudder_lag"});
    CHECK(false_proofs(labelled("none", {}), good()) ==
          strings{"gap", "inflation", "relation", "place", "excluded", "inflation"});

    json d = good();
    d["causes"][0]["verdict"] = "excluded";
    CHECK(false_proofs(lag, d) == strings{"excluded"});
    d["causes"][0]["effects"] = {"rudder_lag", "wind"}; // more effects explain no less
    CHECK(false_proofs(lag, d) == strings{"excluded"});
    d["causes"][0]["effects"] = {"input_delay"};
    CHECK(false_proofs(lag, d).empty());
    CHECK(false_proofs(labelled("outside", {"gust"}), d) == strings{"relation", "place"});

    d = good();
    d["gap"]["inflation"] = {4.1, 5};
    CHECK(false_proofs(lag, d) == strings{"inflation"});
    d = good();
    d["causes"][0]["inflation"] = {1.1, 1.2}; // the truth needs 0.95 only
    CHECK(false_proofs(lag, d) == strings{"inflation"});

    d = good();
    d["relations"][0] = {{"equation", "surge"}, {"sensors", {"u", "v", "r"}}, {"proved", true}};
    CHECK(false_proofs(lag, d) == strings{"relation"});
    d["relations"][0]["proved"] = false;
    CHECK(false_proofs(lag, d).empty());

    d = good();
    d["where"][0] = {{"kind", "sensor"}, {"name", "r"}, {"proved", true}};
    CHECK(false_proofs(lag, d) == strings{"place"});
    CHECK(judge(lag, d).place_right == false);
    d["where"][0]["proved"] = false;
    CHECK(false_proofs(lag, d).empty());

    auto absorbed = lag;
    absorbed.more["fit_base_best"] = "0.9";
    d = good();
    d["gap"]["inflation"] = {nullptr, 4};
    CHECK(false_proofs(absorbed, d) ==
          strings{"gap", "relation", "place", "excluded", "inflation"});
}

TEST_CASE("a relation holds its sensors responsible too") {
    json d = good();
    d["where"] = json::array();
    CHECK(false_proofs(labelled("single", {"gyro_bias"}), d).empty());
    CHECK(false_proofs(labelled("single", {"heading_bias"}), d).empty());
    CHECK(false_proofs(labelled("single", {"position_scale"}), d) == strings{"relation"});
    d["relations"][0]["sensors"] = {"position"};
    CHECK(false_proofs(labelled("single", {"position_latency"}), d).empty());
}

TEST_CASE("places") {
    CHECK(holds(places_of("rudder_trim"), "input", "delta"));
    CHECK_FALSE(holds(places_of("rudder_trim"), "input", "W"));
    CHECK(holds(places_of("battery_sag"), "input", "W"));
    CHECK(holds(places_of("payload"), "equation", "sway"));
    CHECK_FALSE(holds(places_of("payload"), "equation", "yaw"));
    CHECK(holds(places_of("position_scale"), "sensor", "position"));
    CHECK_FALSE(holds(places_of("thrust_offset"), "sensor", "yaw"));
    CHECK(places_of("unheard of").equations.empty());
}

TEST_CASE("answers to what no candidate holds") {
    auto const with = [](std::string const& family, std::string const& effect,
                         std::vector<double> const& values) {
        auto l = labelled(family, {effect});
        l.effects[0].second = values;
        return l;
    };
    json unexplained = answering({}), open = answering({});
    unexplained["answer"]["kind"] = "unexplained";
    open["answer"]["kind"] = "open";
    for (auto const& l : {with("askew", "askew_uv", {0.05}), with("instrument", "drift_r", {0.05}),
                          with("bounds", "bounds_v", {1.6}), with("strong", "payload", {0.7}),
                          with("noise", "jitter_v", {0.05}), with("noise", "growing_v", {0.05}),
                          with("slow", "slow_v", {1.5, 0.4}), with("reading", "steps_v", {0.05}),
                          with("reading", "wraps_psi", {6.28319})}) {
        CAPTURE(l.effects[0].first);
        CHECK_FALSE(l.attainable());
        CHECK(judge(l, unexplained).right);
        CHECK_FALSE(judge(l, answering({"wind"})).right);
        auto const abstained = judge(l, open);
        CHECK(abstained.open);
        CHECK_FALSE(abstained.right);
    }
    CHECK(judge(with("strong", "payload", {0.7}), answering({"payload"})).right);
    CHECK(judge(with("instrument", "lagging_xy", {0.2}), answering({"position_latency"})).right);
    CHECK(judge(with("reading", "wraps_psi", {6.28319}), answering({"sensor_wrap(psi)~13"})).right);
    CHECK_FALSE(judge(with("strong", "payload", {0.3}), unexplained).right); // in its prior

    // Beyond its prior, and said so: the wider effect must hold the truth.
    auto const strong = with("strong", "payload", {0.7});
    CHECK(judge(strong, answering({"payload_wider"})).right);
    CHECK_FALSE(judge(strong, answering({"wind_wider"})).right);
    json wider = answering({"payload_wider"});
    wider["relations"][0]["equation"] = "surge";
    wider["where"][0]["name"] = "surge";
    wider["causes"][0] = {{"effects", {"payload_wider"}},
                          {"verdict", "explains"},
                          {"inflation", {0.9, 0.95}},
                          {"parameters", {{"payload_wider.dm", {0.6, 0.8}}}}};
    CHECK(judge(strong, wider).hulls_checked == 1);
    CHECK(false_proofs(strong, wider).empty());
    wider["causes"][0]["parameters"]["payload_wider.dm"] = {0.75, 0.8};
    CHECK(false_proofs(strong, wider) == strings{"hull"});
    wider["causes"][0]["verdict"] = "excluded";
    CHECK(false_proofs(strong, wider) == strings{"excluded"});
    CHECK_FALSE(with("strong", "payload", {9}).held_by()); // four times the prior is 2

    auto part = with("experiments", "payload", {0.3});
    part.more["onsets"] = "S1=inf S4=inf";
    CHECK_FALSE(part.attainable());
    CHECK(judge(part, unexplained).right);
    auto later = with("onset", "payload", {0.3});
    later.more["onsets"] = "S1=0.4 S2=3.2";
    CHECK(judge(later, unexplained).right);
    CHECK(true_episode(later, "S2").from == 3.2);
    CHECK(true_episode(later, "S3").always());
    auto const three = labelled("three", {"payload", "gyro_bias", "rudder_trim"});
    CHECK(judge(three, unexplained).right);
    CHECK(judge(three, answering({"payload", "gyro_bias", "rudder_trim"})).right);
    CHECK_FALSE(judge(three, answering({"payload", "gyro_bias"})).right);

    // Nothing holds the truth, so nothing that contains its name is excluded wrongly.
    json d = good();
    d["causes"][0] = {{"effects", {"payload"}}, {"verdict", "excluded"}, {"inflation", {2, 3}}};
    d["relations"][0]["equation"] = "surge";
    d["where"][0]["name"] = "surge";
    CHECK(false_proofs(part, d).empty());
    CHECK(false_proofs(with("single", "payload", {0.3}), d) == strings{"excluded", "inflation"});
    // A fit that explains the data knows better.
    json const baseline{{"causes", {{{"effects", {"payload"}}, {"inflation", {nullptr, 0.9}}}}}};
    CHECK(false_proofs(part, d, baseline) == strings{"excluded", "inflation"});
}

TEST_CASE("bounds that are too small touch their sensor alone") {
    auto l = labelled("bounds", {"bounds_y"});
    l.more["fit_base"] = l.more["fit_base_best"] = l.more["fit_true"] = "1.7";
    json d = good();
    d["gap"]["inflation"] = {1.6, 1.7};
    d["causes"] = json::array();
    CHECK(false_proofs(l, d) == strings{"relation", "place"});
    d["relations"][0] = {{"equation", "y"}, {"sensors", {"y", "u", "v", "psi"}}, {"proved", true}};
    d["where"][0] = {{"kind", "sensor"}, {"name", "x"}, {"proved", true}};
    CHECK(false_proofs(l, d).empty()); // x and y are one instrument, called by the first
    CHECK(judge(l, d).place_right == true);
    d["relations"][0] = {{"equation", "x"}, {"sensors", {"x", "u", "v", "psi"}}, {"proved", true}};
    CHECK(false_proofs(l, d) == strings{"relation"});
    d = good();
    d["gap"]["inflation"] = {1.6, 1.8};
    d["relations"] = d["where"] = json::array();
    d["causes"][0]["verdict"] = "undecided";
    d["causes"][0]["inflation"] = {1.72, 1.9};
    CHECK(false_proofs(l, d) == strings{"inflation", "inflation"}); // of wind, too
}

TEST_CASE("hulls and parts against values that explain the data") {
    auto const lag = labelled("single", {"rudder_lag"});
    json d = good();
    d["causes"][0]["parameters"]["rudder_lag.tau"] = {0.11, 0.2};
    CHECK(false_proofs(lag, d) == strings{"hull"});
    d["causes"][0]["parameters"] = {{"rudder_lag.tau", {nullptr, 0.2}}};
    CHECK(false_proofs(lag, d).empty());
    auto known = lag;
    known.constants_true["Sv"] = 0.22;
    d["answer"]["constants"]["Sv"] = {{"value", 0.205}, {"hull", {0.2, 0.21}}};
    CHECK(false_proofs(known, d) == strings{"hull"});
    d["answer"]["constants"].erase("Sv");
    auto& products = d["answer"]["combinations"];
    products = {{{"formula", "Sv^2/rudder_lag.tau"},
                 {"factors", {{"Sv", 2}, {"rudder_lag.tau", -1}}},
                 {"hull", {0.4, 0.5}}}};
    CHECK(false_proofs(known, d).empty()); // 0.22^2/0.1
    products[0]["hull"] = {0.49, 0.5};
    CHECK(false_proofs(known, d) == strings{"hull"});
    products[0] = {{"formula", "Sv - tau"},
                   {"terms", {{"Sv", 1}, {"rudder_lag.tau", -1}}},
                   {"hull", {0.11, 0.13}}};
    CHECK(false_proofs(known, d).empty());
    products[0]["hull"] = {0.11, 0.115};
    CHECK(false_proofs(known, d) == strings{"hull"});
    products[0]["terms"]["Sg"] = 1; // nobody knows it
    CHECK(false_proofs(known, d).empty());
    d = good();
    json const baseline{{"causes",
                         {{{"effects", {"rudder_lag"}},
                           {"inflation", {nullptr, 0.98}},
                           {"witness", {{"parameters", {{"rudder_lag.tau", 0.13}}}}}}}}};
    CHECK(false_proofs(lag, d, baseline) == strings{"hull"});

    auto parts = lag;
    parts.more["best_of_parts"] = "S1=0.9 S3=2.5 r=1.5";
    d["gap"]["scenarios"] = {{"S1", {0.8, 0.9}}, {"S3", {2.6, 2.7}}};
    d["gap"]["channels"] = {{"r", {1.4, 2}}, {"psi", {1.1, 1.2}}};
    CHECK(false_proofs(parts, d) == strings{"part"});
}

TEST_CASE("contradictions within a file") {
    CHECK(contradictions(good()).empty());
    CHECK(contradictions(none()).empty());
    json d = good();
    d["causes"].push_back(
        {{"effects", {"position_scale"}}, {"verdict", "explains"}, {"inflation", {0.9, 0.99}}});
    CHECK(contradictions(d) == strings{"relation", "place"}); // it leaves yaw as it is
    d["where"][0]["proved"] = false;
    CHECK(contradictions(d) == strings{"relation"});
    d["relations"][0]["proved"] = false;
    CHECK(contradictions(d).empty());

    d = good(); // one scenario alone is explained, and refutes
    d["relations"][0]["windows"] = {{{"scenario", "S3"}, {"from", 0}, {"to", 1}}};
    d["gap"]["scenarios"] = {{"S3", {0.8, 0.95}}};
    CHECK(contradictions(d) == strings{"relation"});
    d["relations"][0]["windows"].push_back({{"scenario", "S4"}, {"from", 0}, {"to", 1}});
    CHECK(contradictions(d).empty());

    d = good();
    d["gap"] = {{"verdict", "none"}, {"inflation", {0.8, 0.9}}};
    CHECK(contradictions(d) ==
          strings{"relation", "place", "excluded", "inflation", "answer", "shrink"});
    d = good();
    d["gap"]["inflation"] = {0.5, 0.9};
    CHECK(contradictions(d) == strings{"verdict", "inflation", "shrink"});
    d = good();
    d["causes"][0]["inflation"] = {0.9, 1.1};
    CHECK(contradictions(d) == strings{"verdict", "shrink"});

    d = good();
    d["causes"].push_back({{"effects", {"rudder_lag", "wind"}},
                           {"verdict", "excluded"},
                           {"inflation", {nullptr, nullptr}}});
    CHECK(contradictions(d) == strings{"excluded"});
    d["causes"].back() = {
        {"effects", {"wind", "payload"}}, {"verdict", "undecided"}, {"inflation", {2.7, 3}}};
    CHECK(contradictions(d) == strings{"inflation"}); // wind needs 2.6 at most

    d = good();
    d["where"][0]["missing"] = {-0.2, 0.4};
    d["where"][0]["estimate"] = 0.1;
    CHECK(contradictions(d) == strings{"zero"});
    d["where"][0]["proved"] = false;
    CHECK(contradictions(d).empty());
    d["where"][0]["missing"] = {0.2, 0.4};
    CHECK(contradictions(d) == strings{"estimate"});

    d = good();
    d["shrink"]["fit"] = {0.97, 1.0};
    CHECK(contradictions(d).empty()); // wider than need be
    d["shrink"]["fit"] = {0.5, 0.9};
    CHECK(contradictions(d) == strings{"shrink"});
    d = good();
    d["causes"][0]["holdout"] = {{"inflation_before", {5, 5.2}}, {"inflation_after", {0.9, 1.04}}};
    CHECK(contradictions(d).empty());
    d["causes"][0]["holdout"]["inflation_after"] = {0.9, 1.4};
    CHECK(contradictions(d) == strings{"shrink"});
    d["causes"][0]["holdout"]["inflation_after"] = {0.9, 1.0};
    d["causes"][0]["holdout"]["over_fits_after"] = {1.1, 1.3};
    CHECK(contradictions(d) == strings{"holdout"});

    d = good();
    d["causes"][0]["witness"]["parameters"]["rudder_lag.tau"] = 0.2;
    CHECK(contradictions(d) == strings{"hull"});
    d = good();
    d["causes"][0]["witness"]["parameters"]["Sv"] = 0.22;
    d["answer"]["verified"] = true;
    d["answer"]["constants"]["Sv"] = {{"value", 0.22}, {"hull", {0.21, 0.23}}};
    CHECK(contradictions(d).empty());
    d["answer"]["constants"]["Sv"] = {{"value", 0.225}, {"hull", {0.224, 0.23}}};
    CHECK(contradictions(d) == strings{"hull", "witness"});
    d["answer"]["constants"].erase("Sv");
    d["answer"]["combinations"] = {
        {{"formula", "1/Sv"}, {"factors", {{"Sv", -1}}}, {"hull", {4, 4.5}}}};
    CHECK(contradictions(d) == strings{"hull"});
    d["answer"]["combinations"][0]["hull"] = {4.5, 4.6};
    CHECK(contradictions(d).empty());

    d = good();
    d["answer"] = {{"kind", "unexplained"}, {"effects", json::array()}};
    for (auto const& e : catalogue())
        if (e.name != "rudder_lag" && e.name != "wind") d["unobservable"].push_back(e.name);
    CHECK(contradictions(d) == strings{"answer"}); // the lag explains
    d["causes"].erase(0);
    d["shrink"] = {{"fit", nullptr}, {"holdout", nullptr}};
    CHECK(contradictions(d) == strings{"untried"});
    d["unobservable"].push_back("rudder_lag");
    CHECK(contradictions(d).empty());
    d["tried"] = {{"singles", {{"tried", 21}, {"planned", 21}}},
                  {"pairs", {{"tried", 8}, {"planned", 36}}}};
    CHECK(contradictions(d) == strings{"untried"});
    d["answer"]["kind"] = "open";
    CHECK(contradictions(d).empty());
    d["tried"]["pairs"]["tried"] = 36;
    CHECK(contradictions(d) == strings{"untried"});
    d = good();
    d["answer"]["indistinguishable"] = {{"wind"}};
    CHECK(contradictions(d) == strings{"answer"});
}

TEST_CASE("missing rates and offsets of sensors against the truth") {
    temporary_folder const folder;
    auto c = draw_campaign(3, 0, {family::none});
    c.id = "w0000";
    write_dataset(c, folder.path());
    auto const data = read_recording(folder.path());
    auto l = labelled("single", {"ground_slope"});
    l.effects[0].second = {0.02, 0};
    l.constants_true = {{"Sv", 0.22}, {"Sg", 0.04}, {"L", 0.3}};
    // S2 goes straight along x without thrust: the slope is all that surge lacks.
    double const pull = 0.02 * 9.81;
    auto const found = [&](std::string const& kind, std::string const& name, double lo, double hi,
                           std::string const& scenario = "S2") {
        json const d{{"where",
                      {{{"kind", kind},
                        {"name", name},
                        {"proved", true},
                        {"scenario", scenario},
                        {"from", 1},
                        {"to", 3.5},
                        {"missing", {lo, hi}}}}}};
        judgement j;
        check_claims(l, data, d, j);
        return kinds_of(j.false_proofs);
    };
    CHECK(found("equation", "surge", pull - 1e-3, pull + 1e-3).empty());
    CHECK(found("equation", "surge", pull + 1e-3, pull + 0.1) == strings{"missing"});
    CHECK(found("equation", "surge", -pull - 0.1, -pull + 0.1) == strings{"missing"});
    CHECK(found("equation", "sway", -1e-3, 1e-3).empty());
    CHECK(found("equation", "x", -1e-3, 1e-3).empty());
    CHECK(found("equation", "yaw", 1e-3, 1) == strings{"missing"});
    CHECK(found("equation", "surge", -1, 1, "S1") == strings{"missing"}); // ends before
    CHECK(found("equation", "surge", -1, 1, "S9") == strings{"missing"});
    l.more["onsets"] = "S2=2"; // 1.5 of 2.5 s
    CHECK(found("equation", "surge", 0.6 * pull - 1e-3, 0.6 * pull + 1e-3).empty());

    l = labelled("instrument", {"drift_r"});
    l.effects[0].second = {0.04};
    CHECK(found("sensor", "r", 0.0899, 0.0901).empty()); // in the middle, at 2.25 s
    CHECK(found("sensor", "r", 0.1, 0.2) == strings{"missing"});
    CHECK(found("sensor", "psi", -1e-4, 1e-4).empty());
    CHECK(found("equation", "yaw", 0.01, 1) == strings{"missing"}); // which is right
    l = labelled("single", {"rudder_trim"});
    l.effects[0].second = {0.05};
    CHECK(found("input", "delta", 0.0499, 0.0501, "S4").empty());
    CHECK(found("input", "W", 1, 2, "S4") == strings{"missing"});
}

TEST_CASE("an effect that begins later is held to its windows") {
    CHECK(episode_in("wind", "S1").always());
    CHECK(episode_in("wind@S1>=0.25+S3", "S1").from == 0.25);
    CHECK(episode_in("wind@S1>=0.25+S3", "S3").always());
    CHECK(episode_in("wind@S1>=0.25+S3", "S2").never());
    CHECK(episode_in("wind@S1>=0.25<3.5+S3<2", "S1").from == 0.25);
    CHECK(episode_in("wind@S1>=0.25<3.5+S3<2", "S1").to == 3.5);
    CHECK(episode_in("wind@S1>=0.25<3.5+S3<2", "S3").from == 0);
    CHECK(episode_in("wind@S1>=0.25<3.5+S3<2", "S3").to == 2);
    CHECK(plain_name("wind_wider@S1>=0.25") == "wind");
    auto l = labelled("onset", {"quadratic_yaw_damping"});
    l.effects[0].second = {0.1};
    l.more["onsets"] = "S1=0.5 S2=2";
    l.more["fit_true"] = "0.95";
    std::string const name = "quadratic_yaw_damping@S1>=0.5+S2>=1.9";
    auto const told = [&](double from, double to, double least, double most) {
        auto d = answering({name});
        d["causes"] = {{{"effects", {name}},
                        {"verdict", "explains"},
                        {"inflation", {0.9, 0.95}},
                        {"onsets",
                         {{"S1", {{"value", 0.5}, {"hull", {0.4, 0.6}}, {"prior", {0, 1}}}},
                          {"S2", {{"value", 1.9}, {"hull", {from, to}}, {"prior", {0, 4}}}}}},
                        {"parameters", {{name + ".k", {least, most}}}}}};
        return kinds_of(judge(l, d).false_proofs);
    };
    CHECK(told(1.8, 2.1, 0.05, 0.15).empty());
    CHECK(told(1.8, 1.99, 0.05, 0.15) == strings{"onset"});
    CHECK(told(2.01, 2.1, 0.05, 0.15) == strings{"onset"});
    CHECK(told(1.8, 2.1, 0.11, 0.15) == strings{"hull"});
    l.more["onsets"] = "S1=0.5 S2=inf";
    CHECK(told(1.8, 4, 0.05, 0.15).empty()); // perhaps never
    CHECK(told(1.8, 3.9, 0.05, 0.15) == strings{"onset"});
    // Another effect is another question; so is a truth that outliers hide.
    l.effects[0].first = "dry_yaw_friction";
    CHECK(told(1.8, 1.99, 0.11, 0.15).empty());
    l.effects[0].first = "quadratic_yaw_damping";
    l.more["fit_true"] = "1.2";
    CHECK(told(1.8, 1.99, 0.11, 0.15).empty());
    // The file itself: a value outside of its window, or other than in the name.
    auto d = answering({name});
    d["causes"] = {
        {{"effects", {name}},
         {"verdict", "explains"},
         {"inflation", {0.9, 0.95}},
         {"onsets", {{"S2", {{"value", 1.9}, {"hull", {1.95, 2}}, {"prior", {0, 4}}}}}}}};
    CHECK(kinds_of(contradictions_in(d)) == strings{"onset"});
    d["causes"][0]["onsets"]["S2"]["hull"] = {1.8, 2};
    CHECK(contradictions_in(d).empty());
    d["causes"][0]["onsets"]["S2"]["value"] = 1.85;
    CHECK(kinds_of(contradictions_in(d)) == strings{"onset"});
}

TEST_CASE("an effect that ends is held to its windows") {
    auto l = labelled("episode", {"quadratic_yaw_damping"});
    l.effects[0].second = {0.1};
    l.more["onsets"] = "S1=0.5 S2=inf";
    l.more["ends"] = "S1=3";
    l.more["fit_true"] = "0.95";
    CHECK_FALSE(l.held_by());
    auto const told = [&](std::string const& name, bounds const& on, bounds const& off,
                          bounds const& k) {
        auto d = answering({name});
        auto const time = [](double value, bounds const& b) {
            return json{{"value", value}, {"hull", {b.lower, b.upper}}, {"prior", {0, 4}}};
        };
        d["causes"] = {{{"effects", {name}},
                        {"verdict", "explains"},
                        {"inflation", {0.9, 0.95}},
                        {"onsets", {{"S1", time(0.45, on)}, {"S2", time(3.5, {0, 4})}}},
                        {"ends", {{"S1", time(2.9, off)}}},
                        {"parameters", {{name + ".k", {k.lower, k.upper}}}}}};
        return kinds_of(judge(l, d).false_proofs);
    };
    std::string const both = "quadratic_yaw_damping@S1>=0.45<2.9+S2>=3.5";
    CHECK(told(both, {0.4, 0.6}, {2.8, 3.1}, {0, 0.2}).empty());
    CHECK(told(both, {0.4, 0.6}, {2.8, 2.9}, {0, 0.2}) == strings{"onset"});
    CHECK(told(both, {0.4, 0.6}, {2.8, 3.1}, {0, 0.09}) == strings{"hull"});
    // Who knows of no end speaks of another question.
    std::string const begins = "quadratic_yaw_damping@S1>=0.45+S2>=3.5";
    CHECK(told(begins, {0.6, 0.7}, {2.8, 2.9}, {0, 0.09}).empty());
    l.more.erase("ends");
    CHECK(told(begins, {0.6, 0.7}, {2, 4}, {0, 0.2}) == strings{"onset"});
    l.more = {{"ends", "S1=3"}, {"fit_true", "0.95"}};
    std::string const ends = "quadratic_yaw_damping@S1<2.9";
    CHECK(told(ends, {0, 4}, {2.8, 2.9}, {0, 0.2}) == strings{"onset"});
    CHECK(told(begins, {0.6, 0.7}, {2.8, 2.9}, {0, 0.09}).empty());
    CHECK(judge(l, answering({ends})).right);
}

TEST_CASE("an effect in some scenarios is named with them, and held to them") {
    CHECK(plain_name("wind_wider@S1+S3") == "wind");
    CHECK(effect_named("wind@S1") == effect_named("wind"));
    CHECK_FALSE(episode_in("wind", "S1").never());
    CHECK_FALSE(episode_in("wind@S1+S3", "S3").never());
    CHECK(episode_in("wind@S1+S3", "S2").never());
    CHECK(episode_in("wind@S12", "S1").never());
    auto l = labelled("experiments", {"quadratic_yaw_damping"});
    l.more["starts"] = "S1(0,0,0,0,0,0) S2(0,0,0,0,0,0) S3(0,0,0,0,0,0) H1(0,0,0,0,0,0)";
    using held = std::optional<strings>;
    CHECK(l.held_by() == held{{"quadratic_yaw_damping"}});
    l.more["onsets"] = "S2=inf H1=inf";
    CHECK(l.held_by() == held{{"quadratic_yaw_damping@S1+S3"}});
    CHECK_FALSE(l.attainable());
    l.more["onsets"] = "S2=inf S3=1.5";
    CHECK_FALSE(l.held_by());
    l.more["onsets"] = "H1=inf";
    CHECK(l.held_by() == held{{"quadratic_yaw_damping"}});
    l.more["onsets"] = "S2=inf";
    auto d = answering({"quadratic_yaw_damping@S1+S3"});
    d["causes"] = {{{"effects", {"quadratic_yaw_damping@S1+S3"}},
                    {"verdict", "explains"},
                    {"inflation", {0.9, 0.95}},
                    {"parameters", {{"quadratic_yaw_damping@S1+S3.k", {0.05, 0.15}}}}}};
    auto const j = judge(l, d);
    CHECK(j.right);
    CHECK(j.false_proofs.empty());
    CHECK(j.hulls_checked > 0);
    d["causes"][0]["parameters"]["quadratic_yaw_damping@S1+S3.k"] = {0.11, 0.15};
    CHECK(false_proofs(l, d) == strings{"hull"});
    d["causes"][0]["verdict"] = "excluded";
    d["causes"][0]["inflation"] = {1.5, 2};
    CHECK(false_proofs(l, d) == strings{"excluded", "inflation"});
    d["causes"][0]["effects"] = {"quadratic_yaw_damping@S1"};
    CHECK(false_proofs(l, d).empty());
    CHECK_FALSE(judge(l, answering({"wind@S1+S3"})).right);
    l.more.erase("onsets"); // it acts everywhere
    CHECK_FALSE(judge(l, answering({"quadratic_yaw_damping@S1+S3"})).right);
}

TEST_CASE("noise that grows, against the truth") {
    temporary_folder const folder;
    for (std::size_t i = 0; i < 2; ++i) {
        auto c = draw_campaign(3, i, {family::noise});
        c.id = "w0000";
        write_dataset(c, folder.path());
        auto const data = read_recording(folder.path());
        auto l = labelled("noise", c.effects);
        auto const& name = c.effects.at(0);
        auto const channel = name.substr(name.find('_') + 1);
        auto const at = std::find(channel_names.begin(), channel_names.end(), channel);
        auto const k = static_cast<std::size_t>(at - channel_names.begin());
        double const size = i == 0 ? c.jitter[k] : c.noise_of_value[k];
        l.effects[0].second = {size};
        json truth;
        for (auto const& u : c.unknown)
            truth["parameters"][u.name] = l.constants_true[u.name] =
                c.true_constants.*constant_named(u.name);
        auto const found = [&](std::string const& with, double lower, bool right,
                               double upper = 9) {
            json const part{{"channel", channel},
                            {"scenarios", json::array()},
                            {"factor", {1, 1000}},
                            {"witness", truth},
                            {"grows",
                             {{"with", with},
                              {"coefficient", {lower, upper}},
                              {"witness", truth},
                              {"shown", truth}}}};
            json const d{{"gap", {{"verdict", "certified"}, {"confined", json::array({part})}}}};
            judgement j;
            check_claims(l, data, d, j);
            check_witnesses(data, d, j);
            CHECK(j.part_right == right);
            return kinds_of(j.false_proofs);
        };
        std::string const own = i == 0 ? "rate" : "value", other = i == 0 ? "value" : "rate";
        for (bool const right : {true, false}) {
            // The least with which the truth meets its data.
            bool const by_rate = (right ? own : other) == "rate";
            double least = 0;
            for (auto const& m : c.scenarios) {
                if (m.plan.holdout) continue;
                auto const& when = m.plan.sample_times;
                for (std::size_t n = 0; n < when.size(); ++n) {
                    auto const before = n > 0 ? n - 1 : n, after = std::min(n + 1, when.size() - 1);
                    double const rate =
                        (m.truth[after][k] - m.truth[before][k]) / (when[after] - when[before]);
                    double const grows = std::abs(by_rate ? rate : m.truth[n][k]);
                    double const off = std::abs(m.value[n][k] - m.truth[n][k]) - error_bound[k];
                    if (off > 0) least = std::max(least, off / grows);
                }
            }
            auto const& with = right ? own : other;
            CAPTURE(i, with, size, least);
            REQUIRE(least > 0);
            CHECK(found(with, 0.98 * least, right, 1.02 * least).empty());
            CHECK(found(with, 1.02 * least, right, 2 * least) == strings{"confined"});
            CHECK(found(with, 0.5 * least, right, 0.98 * least) == strings{"confined"});
        }
    }
}

TEST_CASE("parts that stand alone against the truth") {
    temporary_folder const folder;
    auto c = draw_campaign(3, 0, {family::bounds});
    c.id = "w0000";
    write_dataset(c, folder.path());
    auto const data = read_recording(folder.path());
    auto l = labelled("bounds", c.effects);
    json truth;
    for (auto const& u : c.unknown)
        truth["parameters"][u.name] = l.constants_true[u.name] =
            c.true_constants.*constant_named(u.name);
    auto const channel = c.effects.at(0).substr(std::string{"bounds_"}.size());
    auto const at = std::find(channel_names.begin(), channel_names.end(), channel);
    double const reached = c.bound_factor[static_cast<std::size_t>(at - channel_names.begin())];
    auto const found = [&](std::string const& name, double lo, double hi, json const& scenarios) {
        json const part{
            {"channel", name}, {"scenarios", scenarios}, {"factor", {lo, hi}}, {"witness", truth}};
        json const d{{"gap", {{"verdict", "certified"}, {"confined", json::array({part})}}}};
        judgement j;
        check_claims(l, data, d, j);
        check_witnesses(data, d, j);
        CHECK(j.part_right == (name == channel));
        return kinds_of(j.false_proofs);
    };
    json const all = json::array();
    CHECK(found(channel, 1, reached, all).empty());
    CHECK(found(channel, 1, 1, all) == strings{"confined"});             // the witness
    CHECK(found(channel, 1.1 * reached, 3, all) == strings{"confined"}); // the truth needs less
    CHECK(found(channel, 1, reached, {"S1"}) == strings{"confined"});    // others need it, too
    CHECK(found(channel == "u" ? "v" : "u", 1, 9, all) == strings{"confined"});
    truth["parameters"]["Sv"] = 100;
    CHECK(found(channel, 1, 9, all) == strings{"confined"}); // outside of the prior
    truth = {};
    CHECK(found(channel, 1, 9, all) == strings{"confined"}); // no witness

    auto d = good();
    d["causes"] = json::array();
    auto const contradicted = [&](json const& part) {
        d["gap"]["confined"] = json::array({part});
        d["answer"] = {{"kind", "open"}, {"effects", all}};
        d["shrink"] = {{"fit", nullptr}, {"holdout", nullptr}};
        auto kinds = contradictions(d);
        std::erase(kinds, "untried");
        return kinds;
    };
    d["where"] = all;
    d["relations"][0]["windows"] = {{{"scenario", "S1"}, {"from", 0}, {"to", 1}}};
    auto const part = [](json const& name, json const& scenarios, double lo, double hi) {
        return json{{"channel", name}, {"scenarios", scenarios}, {"factor", {lo, hi}}};
    };
    CHECK(contradicted(part("r", all, 4, 5)).empty());
    CHECK(contradicted(part("r", all, 2, 3)) == strings{"confined"}); // all need 3.1
    CHECK(contradicted(part("u", all, 4, 5)) == strings{"relation"}); // of r and psi
    CHECK(contradicted(part(nullptr, {"S1"}, 4, 5)).empty());
    CHECK(contradicted(part(nullptr, {"S2"}, 4, 5)) == strings{"relation"});
    d["gap"]["scenarios"] = {{"S1", {2, 3}}, {"S2", {0.5, 3}}};
    d["gap"]["channels"] = {{"r", {2, 3}}, {"u", {0.5, 3}}};
    CHECK(contradicted(part("r", all, 4, 5)).empty());
    d["relations"] = all;
    CHECK(contradicted(part("u", {"S2"}, 4, 5)) == strings{"inflation", "inflation"});
}

TEST_CASE("witnesses are simulated again") {
    temporary_folder const folder;
    auto const at = folder.path().string();
    auto const run = [](std::string const& command) { return std::system(command.c_str()); };
    REQUIRE(run("\"" WITHHELD_GENERATE "\" --seed 4 --count 1 --families single --out \"" + at +
                "/data\" --labels \"" + at + "/labels.tsv\"") == 0);
    REQUIRE(run("\"" WITHHELD_BASELINE "\" \"" + at + "/data/w0000\" --out \"" + at + "/base\"") ==
            0);
    auto const labels = read_labels(folder.path() / "labels.tsv");
    auto const found = judge_case(labels.at(0), folder.path() / "base", folder.path() / "data");
    CAPTURE(found.truth, found.answer, found.trouble);
    CHECK(found.right);
    // What least squares says it reached, it did, though it claims no proof.
    CHECK(found.witnesses_checked == catalogue().size());
    CHECK(found.false_proofs.empty());

    std::ifstream file{folder.path() / "base" / "w0000" / "diagnosis.json"};
    json d = json::parse(file);
    d["causes"].erase(d["causes"].begin() + 1, d["causes"].end());
    auto& cause = d["causes"][0];
    cause["verdict"] = "explains";
    cause.erase("parameters");
    auto const data = read_recording(folder.path() / "data" / "w0000");
    auto const witness_proofs = [&] {
        auto j = judge(labels.at(0), d);
        check_witnesses(data, d, j);
        CHECK(j.witnesses_checked == 1);
        return kinds_of(j.false_proofs);
    };
    CHECK(witness_proofs().empty());
    auto const held = cause["holdout"]["inflation_after"];
    cause["holdout"]["inflation_after"] = {2.0, 3.0};
    CHECK(witness_proofs() == strings{"holdout"});
    cause["holdout"]["inflation_after"] = held;
    auto& Sv = cause["witness"]["parameters"]["Sv"];
    Sv = Sv.get<double>() > 0.225 ? 0.2 : 0.25;
    CHECK(witness_proofs() == strings{"witness", "holdout"});
}

TEST_CASE("the program: tables, a csv, and the exit code of a false proof") {
    temporary_folder const folder;
    folder.write("labels.tsv", "case\tfamily\teffects\tparams\n"
                               "a\tsingle\trudder_lag(0.2)\tSv=0.22\n"
                               "b\tnone\tnone\tSv=0.22\n"
                               "c\tsingle\twind(1,0)\tSv=0.22\n");
    auto const at = folder.path().string();
    auto const score = [&] {
        return std::system(("\"" WITHHELD_SCORE "\" --labels \"" + at +
                            "/labels.tsv\" --results \"" + at + "/results\" --csv \"" + at +
                            "/score.csv\" > \"" + at + "/out.txt\"")
                               .c_str());
    };
    auto const text_of = [&](std::string const& name) {
        std::ifstream file{folder.path() / name};
        return std::string{std::istreambuf_iterator<char>{file}, {}};
    };
    folder.write("results/a/diagnosis.json", good().dump());
    folder.write("results/a/seconds.txt", "1.5\n");
    folder.write("results/b/diagnosis.json", none().dump());
    folder.write("results/c/diagnosis.json", "{ not json");
    CHECK(score() == 0);
    CHECK_THAT(text_of("out.txt"), ContainsSubstring("rudder_lag x1"));
    CHECK_THAT(text_of("out.txt"), ContainsSubstring("missing      c"));
    CHECK_THAT(text_of("out.txt"), ContainsSubstring("false proofs by kind: none"));
    CHECK_THAT(text_of("score.csv"), ContainsSubstring("a,single,rudder_lag,rudder_lag,1,1,0,,"));
    CHECK_THAT(text_of("score.csv"), ContainsSubstring(",1.500,0,0,,,,,\n"));
    folder.write("results/b/diagnosis.json", good().dump());
    CHECK(score() != 0);
    CHECK_THAT(text_of("out.txt"), ContainsSubstring("FALSE PROOF  b  gap"));
    // A contradiction alone, and an answer that is left open.
    json open = none();
    open["answer"] = {{"kind", "open"}, {"tried", 8}, {"planned", 36}};
    open["gap"]["verdict"] = "undecided";
    folder.write("results/b/diagnosis.json", open.dump());
    CHECK(score() == 0);
    CHECK_THAT(text_of("out.txt"), ContainsSubstring("open         b"));
    CHECK_THAT(text_of("out.txt"), ContainsSubstring("contradictions by kind: none"));
    open["gap"]["verdict"] = "none";
    folder.write("results/b/diagnosis.json", open.dump());
    CHECK(score() != 0);
    CHECK_THAT(text_of("out.txt"), ContainsSubstring("CONTRADICTION  b  answer"));
}

TEST_CASE("faults of instruments are right by the kind that was drawn, their hulls are checked") {
    auto const drawn = [](std::string const& effect, std::vector<double> const& values) {
        auto l = labelled("instrument", {effect});
        l.effects[0].second = values;
        l.constants_true = {{"L", 0.3}};
        return l;
    };
    auto const found = [](std::string const& fault, json const& parameters) {
        auto d = answering({fault});
        d["relations"] = d["where"] = json::array();
        d["causes"] = json::array({{{"effects", {fault}},
                                    {"verdict", "explains"},
                                    {"inflation", {0.9, 0.95}},
                                    {"parameters", parameters}}});
        d["answer"]["constants"] = {{"L", {0.29, 0.31}}};
        return d;
    };
    auto const slow = drawn("lagging_uv", {0.2});
    auto const right = found("sensor_lag(u:v)~0.5", {{"sensor_lag(u:v)~0.5.tau", {0.19, 0.21}}});
    CHECK(judge(slow, right).right);
    CHECK(judge(slow, right).truth_explains == true);
    CHECK(judge(slow, right).hulls_checked == 2);
    CHECK(false_proofs(slow, right).empty());
    auto const wrong = found("sensor_lag(u:v)~0.5", {{"sensor_lag(u:v)~0.5.tau", {0.1, 0.19}}});
    CHECK(false_proofs(slow, wrong) == strings{"hull"});
    for (auto const* name :
         {"sensor_lag(u)~0.5", "sensor_latency(u:v)~0.5", "sensor_bias(u:v)~1"}) {
        CAPTURE(name);
        CHECK_FALSE(judge(slow, found(name, json::object())).right);
    }
    std::string const turned = "sensor_rotation(x:y)~0.5";
    auto const askew = drawn("askew_xy", {0.05});
    CHECK(judge(askew, found(turned, {{turned + ".a", {-0.06, -0.04}}})).right);
    CHECK(false_proofs(askew, found(turned, {{turned + ".a", {-0.06, -0.04}}})).empty());
    CHECK(false_proofs(askew, found(turned, {{turned + ".a", {0.04, 0.06}}})) == strings{"hull"});
    std::string const drifts = "sensor_drift(u:v)~0.5", arm = "sensor_velocity_arm(u:v:r)~1",
                      lever = "sensor_lever_arm(x:y:psi)~2";
    CHECK(false_proofs(drawn("drift_uv", {0.03}), found(drifts, {{drifts + ".d_u", {0.02, 0.04}},
                                                                 {drifts + ".d_v", {0, 0.02}}})) ==
          strings{"hull"});
    CHECK(false_proofs(drawn("lever_v", {0.2}),
                       found(arm, {{arm + ".a", {0.1, 0.3}}, {arm + ".b", {-0.1, 0.1}}}))
              .empty());
    CHECK(false_proofs(drawn("lever_xy", {0.2, -0.1}),
                       found(lever, {{lever + ".a", {0.1, 0.3}}, {lever + ".b", {-0.2, 0}}}))
              .empty());
    CHECK(judge(drawn("drift_r", {0.03}), found("sensor_drift(r)~1", json::object())).right);
    CHECK(holds(places_of("sensor_lag(u:v)~0.5"), "sensor", "v"));
    CHECK_FALSE(holds(places_of("sensor_velocity_arm(u:v:r)~1"), "sensor", "r"));
    CHECK(places_of("sensor_lever_arm(x:y:psi)~2").sensors == std::set<std::string>{"x", "y"});

    // Witnesses are simulated with them.
    instrument_faults all;
    auto const value = [](std::string const& name) {
        return std::optional{name.ends_with(".b") ? 0.5 : 0.25};
    };
    CHECK(set_fault(all, *fault_in(turned), value));
    CHECK(all.position_turn == -0.25);
    CHECK(set_fault(all, *fault_in(arm), value));
    CHECK(all.velocity_side == 0.5);
    CHECK(set_fault(all, *fault_in(drifts), value));
    CHECK(all.drift == channels{0.25, 0.25});
    CHECK_FALSE(set_fault(all, *fault_in("sensor_bias(u)~1"), value));
    CHECK_FALSE(fault_in("sensor_lag(u)~1@S1"));
    CHECK_FALSE(fault_in("gyro_bias"));
}
