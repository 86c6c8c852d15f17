// SPDX-License-Identifier: MIT
// The scorer on diagnoses made by hand: right, wrong, and false proofs of every kind.
#include "judge.hpp"
#include "places.hpp"
#include "summary.hpp"

#include "io/support.hpp"
#include "support/catch.hpp"

#include <nlohmann/json.hpp>

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
    CHECK(j.proofs == 5);
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
    CHECK_FALSE(judge(labelled("outside", {"gust"}), answering({"wind"})).right);
    CHECK(judge(labelled("outside", {"servo"}), answering({"rudder_lag"})).right);
    CHECK_FALSE(judge(labelled("outside", {"tether"}), answering({"rudder_lag"})).right);
    CHECK_FALSE(judge(labelled("none", {}), unexplained).right);

    // The parameters' priors swallow the effect: both answers are true.
    auto absorbed = lag;
    absorbed.more["fit_base_best"] = "0.9";
    CHECK(judge(absorbed, none()).right);
    CHECK(judge(absorbed, none()).false_proofs.empty());
}

TEST_CASE("false proofs, each kind") {
    auto const lag = labelled("single", {"rudder_lag"});
    CHECK(judge(labelled("none", {}), good()).false_proofs ==
          strings{"gap", "inflation", "relation", "place", "excluded", "inflation"});

    json d = good();
    d["causes"][0]["verdict"] = "excluded";
    CHECK(judge(lag, d).false_proofs == strings{"excluded"});
    d["causes"][0]["effects"] = {"rudder_lag", "wind"}; // more effects explain no less
    CHECK(judge(lag, d).false_proofs == strings{"excluded"});
    d["causes"][0]["effects"] = {"input_delay"};
    CHECK(judge(lag, d).false_proofs.empty());
    CHECK(judge(labelled("outside", {"gust"}), d).false_proofs == strings{"relation", "place"});

    d = good();
    d["gap"]["inflation"] = {4.1, 5};
    CHECK(judge(lag, d).false_proofs == strings{"inflation"});
    d = good();
    d["causes"][0]["inflation"] = {1.1, 1.2}; // the truth needs 0.95 only
    CHECK(judge(lag, d).false_proofs == strings{"inflation"});

    d = good();
    d["relations"][0] = {{"equation", "surge"}, {"sensors", {"u", "v", "r"}}, {"proved", true}};
    CHECK(judge(lag, d).false_proofs == strings{"relation"});
    d["relations"][0]["proved"] = false;
    CHECK(judge(lag, d).false_proofs.empty());

    d = good();
    d["where"][0] = {{"kind", "sensor"}, {"name", "r"}, {"proved", true}};
    CHECK(judge(lag, d).false_proofs == strings{"place"});
    CHECK(judge(lag, d).place_right == false);
    d["where"][0]["proved"] = false;
    CHECK(judge(lag, d).false_proofs.empty());

    auto absorbed = lag;
    absorbed.more["fit_base_best"] = "0.9";
    d = good();
    d["gap"]["inflation"] = {nullptr, 4};
    CHECK(judge(absorbed, d).false_proofs ==
          strings{"gap", "relation", "place", "excluded", "inflation"});
}

TEST_CASE("a relation holds its sensors responsible too") {
    json d = good();
    d["where"] = json::array();
    CHECK(judge(labelled("single", {"gyro_bias"}), d).false_proofs.empty());
    CHECK(judge(labelled("single", {"heading_bias"}), d).false_proofs.empty());
    CHECK(judge(labelled("single", {"position_scale"}), d).false_proofs == strings{"relation"});
    d["relations"][0]["sensors"] = {"position"};
    CHECK(judge(labelled("single", {"position_latency"}), d).false_proofs.empty());
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

TEST_CASE("witnesses are simulated again") {
    temporary_folder const folder;
    auto const at = folder.path().string();
    auto const run = [](std::string const& command) { return std::system(command.c_str()); };
    REQUIRE(run("\"" WITHHELD_GENERATE "\" --seed 4 --count 1 --family single --out \"" + at +
                "/data\" --labels \"" + at + "/labels.tsv\"") == 0);
    REQUIRE(run("\"" WITHHELD_BASELINE "\" \"" + at + "/data/w0000\" --out \"" + at + "/base\"") ==
            0);
    auto const labels = read_labels(folder.path() / "labels.tsv");
    auto const found = judge_case(labels.at(0), folder.path() / "base", folder.path() / "data");
    CAPTURE(found.truth, found.answer, found.trouble);
    CHECK(found.right);
    CHECK(found.witnesses_checked == 0); // least squares claims no proof

    std::ifstream file{folder.path() / "base" / "w0000" / "diagnosis.json"};
    json d = json::parse(file);
    auto& cause = d["causes"][0];
    cause["verdict"] = "explains";
    auto const data = read_recording(folder.path() / "data" / "w0000");
    auto const witness_proofs = [&] {
        auto j = judge(labels.at(0), d);
        check_witnesses(data, d, j);
        CHECK(j.witnesses_checked == 1);
        return j.false_proofs;
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
    CHECK_THAT(text_of("score.csv"), ContainsSubstring(",1.500,0\n"));
    folder.write("results/b/diagnosis.json", good().dump());
    CHECK(score() != 0);
    CHECK_THAT(text_of("out.txt"), ContainsSubstring("FALSE PROOF  b  gap"));
}
