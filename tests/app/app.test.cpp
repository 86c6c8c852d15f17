// SPDX-License-Identifier: MIT
// Commands, options, exit codes and files of a robot's program.
#include "app/cup.hpp"

#include "support/catch.hpp"
#include "support/child_program.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace app_test;
using namespace sivid::literals;
using support::text_of;

namespace {

nlohmann::json json_of(fs::path const& file) { return nlohmann::json::parse(text_of(file)); }

std::set<std::string> files_in(fs::path const& folder) {
    std::set<std::string> names;
    for (auto const& f : fs::directory_iterator{folder}) names.insert(f.path().filename().string());
    return names;
}

} // namespace

TEST_CASE("every command explains itself with an example") {
    auto const all = run({"--help"});
    CHECK(all.code == 0);
    CHECK_THAT(all.out, ContainsSubstring("A cup of tea"));
    for (std::string const command :
         {"import", "simulate", "generate", "identify", "online", "confidence", "check",
          "certificate", "diagnose", "predict", "verify", "control", "design", "rank",
          "disturbance", "report", "export", "describe", "fleet"}) {
        CAPTURE(command);
        CHECK_THAT(all.out, ContainsSubstring(command));
        auto const one = run({command, "--help"});
        CHECK(one.code == 0);
        CHECK_THAT(one.out, ContainsSubstring("Example: cup " + command));
    }
}

TEST_CASE("a misspelt command, option or name is answered by the nearest one") {
    served const s;
    auto const refused = [&](std::vector<std::string> const& words, std::string const& message) {
        auto const r = run(words);
        CAPTURE(r.err, message);
        CHECK(r.code == 2);
        CHECK(r.out.empty());
        CHECK_THAT(r.err, ContainsSubstring(message));
        CHECK_FALSE(fs::exists(s.at("out")));
    };
    auto const out = s.at("out");
    refused({"identfy", s.data(), "--out", out}, "Did you mean the command identify?");
    refused({"fly"}, "");
    refused({}, "subcommand");
    refused({"identify", s.data(), "--otu", out}, "Did you mean --out?");
    refused({"identify", s.data(), "--out", out, "--with", "draugth"}, "did you mean 'draught'?");
    refused({"identify", s.data(), "--out", out, "--picture", "t"}, "unknown channel 't'");
    refused({"simulate", "--scenario", "tee", "--out", out}, "did you mean 'tea'?");
    refused({"simulate", "--scenario", "tea", "--out", out, "--set", "gian=2"},
            "did you mean 'gain'?");
    refused({"generate", "--scenario", "tea", "--absolute", "1", "--out", out, "--unknown", "gian"},
            "did you mean 'gain'?");
    refused({"describe", "--unknown", "gian"}, "did you mean 'gain'?");
    refused({"identify", s.at("nowhere"), "--out", out}, "nowhere");
    refused({"identify", s.data(), "--out", ""}, "--out is empty");
    refused({"identify", s.data(), "--out", out, "--outliers", "many"}, "whole number or auto");
    refused({"identify", s.data(), "--out", out, "--outliers", "99"}, "allow fewer");
    refused({"identify", s.data(), "--out", out, "--budget", "nan"}, "nan is not a number");
    refused({"identify", s.data(), "--out", out, "--outliers-for", "0.9"}, "go together");
    refused({"identify", s.data(), "--out", out, "--compare", "--by-bounds"}, "give one of them");
    refused(
        {"identify", s.data(), "--out", out, "--outliers-for", "1.5", "--bound-probability", "0.9"},
        "not within 0 to 1");
    refused({"rank", "--out", out}, "give a data set or --scenario");
    refused({"rank", "--scenario", "tea", "--out", out}, "--measure");
    refused({"disturbance", s.data(), "--out", out}, "name one with its scale");
    refused({"rank", s.data(), "--with", "draugt", "--out", out}, "did you mean 'draught'?");
    refused({"rank", "--scenario", "tea", "--with", "draught", "--out", out}, "--with");
    refused({"disturbance", s.data(), "--on", "U=1", "--out", out}, "no equation 'U'");
    refused({"disturbance", s.data(), "--on", "T=0", "--out", out}, "a number above 0");
    refused({"disturbance", s.data(), "--on", "T", "--out", out}, "write name=value");
    refused({"fleet", "identify", s.data(), "--out", out, "--task", "3/2"}, "K from 1 to N");
    refused({"check", s.at("nowhere")}, "nowhere");
    refused({"report", s.data()}, "*.page.json");
}

TEST_CASE("a region with a stated probability, as page, JSON and table") {
    served const s;
    auto const out = s.at("region");
    auto const r = run({"confidence", s.data(), "--out", out, "--quiet", "--seed", "7"});
    CAPTURE(r.out, r.err);
    CHECK(r.code == 0);
    CHECK_THAT(r.out, ContainsSubstring("probability of 95 % (exactly 1 - 5/100)") &&
                          ContainsSubstring("k in [") && ContainsSubstring("seed 7"));
    CHECK(files_in(out) == std::set<std::string>{"confidence.csv", "confidence.html",
                                                 "confidence.json", "confidence.page.json"});
    auto const stored = json_of(fs::path{out} / "confidence.json");
    CHECK(stored["above"] == 5);
    CHECK(stored["weights"].size() == stored["measured"].size());
    CHECK(stored["hull"]["k"][0] < stored["hull"]["k"][1]);
    CHECK_THAT(text_of(out + "/confidence.csv"), ContainsSubstring("inside,"));
    CHECK_THAT(text_of(out + "/confidence.html"), ContainsSubstring("independent and symmetric"));
    auto const odd = run({"confidence", s.data(), "--out", out, "--probability", "0.12345"});
    CHECK(odd.code == 2);
    CHECK_THAT(odd.err, ContainsSubstring("round it to four digits"));
    auto const short_of_time = run({"confidence", s.data(), "--out", out, "--budget", "0"});
    CHECK(short_of_time.code == 2);
    CHECK_THAT(short_of_time.err, ContainsSubstring("allow more time"));
    CHECK(run({"identify", s.data(), "--out", s.at("out"), "--quiet", "--bound-probability", "0.9",
               "--outliers-for", "0.9"})
              .code == 0);
}

TEST_CASE("from a scenario to a result, checked, shown anew and used") {
    served const s;
    CAPTURE(s.made.err);
    REQUIRE(s.made.code == 0);
    CHECK(files_in(s.data()) == std::set<std::string>{"dataset.json", "tea.inputs.csv",
                                                      "tea.measurements.csv", "truth.json"});
    auto const out = s.at("out");
    auto const r = run({"identify", s.data(), "--out", out, "--quiet", "--budget", "20"});
    CHECK(r.code == 0);
    CHECK_THAT(r.out, ContainsSubstring("consistent") && ContainsSubstring("k in ["));
    for (auto const* name : {"report.html", "result.json", "boxes.csv", "outputs.csv"}) {
        CAPTURE(name);
        CHECK(fs::exists(fs::path{out} / name));
    }
    CHECK(json_of(fs::path{out} / "result.json")["verdict"] == "consistent");
    CHECK(run({"check", out, "--all", "--quiet"}).code == 0);
    CHECK(run({"check", out, "--sample", "0", "--quiet"}).code == 3); // nothing is looked at

    SECTION("the page of a result is made anew, beside it or elsewhere") {
        auto const again = run({"report", out, "--out", s.at("page"), "--quiet"});
        CAPTURE(again.err);
        CHECK(again.code == 0);
        CHECK(files_in(s.at("page")) == std::set<std::string>{"report.html"});
        auto const page = text_of(out + "/report.html");
        CHECK_THAT(page, ContainsSubstring("</svg>"));
        CHECK(text_of(s.at("page") + "/report.html") == page);
        fs::remove(fs::path{out} / "report.html");
        CHECK(run({"report", out}).code == 0);
        CHECK(text_of(out + "/report.html") == page);
    }
    SECTION("a file that is cut off is named") {
        auto const whole = text_of(fs::path{out} / "result.json");
        s.folder().write("out/result.json", whole.substr(0, whole.size() / 2));
        for (std::vector<std::string> const& words : std::vector<std::vector<std::string>>{
                 {"check", out}, {"verify", out, "--scenario", "tea", "--require", "T > 0"}}) {
            auto const cut = run(words);
            CHECK(cut.code == 2);
            CHECK_THAT(cut.err, ContainsSubstring("result.json"));
        }
        auto data = text_of(fs::path{out} / "report.page.json");
        s.folder().write("out/report.page.json", data.substr(0, data.size() / 2));
        CHECK(run({"report", out}).code == 2);
        data.insert(data.find("\"shows\": [") + 10, " ");
        s.folder().write("out/report.page.json", data);
        CHECK_THAT(run({"report", out}).err, ContainsSubstring("was changed"));
    }
    auto const asked = [&](std::vector<std::string> more) {
        more.insert(more.begin() + 1, {out, "--scenario", "tea", "--quiet"});
        return run(more).code;
    };
    SECTION("the pages of decisions are made anew, byte for byte") {
        auto const on = [&](std::string const& name, std::vector<std::string> more) {
            more.insert(more.end(), {"--out", s.at(name)});
            CHECK(asked(more) != 2);
        };
        on("prediction", {"predict"});
        on("verification", {"verify", "--require", "T at end in [0, 60]"});
        on("open", {"verify", "--require", "T at end in [0, 30]", "--budget", "1"});
        on("refuted", {"verify", "--require", "T at end > 60"});
        on("control",
           {"control", "--law", "h = K", "--gain", "K=0:9", "--require", "T at end in [0, 90]"});
        on("design",
           {"design", "--vary", "h=0:9", "--halve", "k", "--share", "1", "--budget", "5"});
        CHECK(run({"rank", s.data(), "--out", s.at("ranking"), "--quiet"}).code != 2);
        CHECK(run({"rank", "--scenario", "tea", "--measure", "T=0.1", "--out", s.at("alone"),
                   "--quiet"})
                  .code != 2);
        CHECK(run({"online", s.data(), "--out", s.at("online"), "--quiet"}).code != 2);
        for (auto const& [folder, name] :
             std::vector<std::pair<std::string, std::string>>{{"prediction", "prediction"},
                                                              {"verification", "verification"},
                                                              {"open", "verification"},
                                                              {"refuted", "verification"},
                                                              {"control", "control"},
                                                              {"design", "design"},
                                                              {"ranking", "ranking"},
                                                              {"alone", "ranking"},
                                                              {"online", "report"}}) {
            CAPTURE(folder);
            auto const again = run({"report", s.at(folder), "--out", s.at(folder + "-page")});
            CAPTURE(again.err);
            CHECK(again.code == 0);
            auto const page = text_of(s.at(folder) + "/" + name + ".html");
            CHECK_THAT(page, ContainsSubstring("</html>"));
            CHECK(text_of(s.at(folder + "-page") + "/" + name + ".html") == page);
        }
    }
    SECTION("effects that act in a scenario join those of the result") {
        CHECK(asked({"verify", "--require", "T at end < 23"}) == 5); // 2/k + (60 - 2/k) e^-2k
        CHECK(asked({"verify", "--with", "draught=-2", "--require", "T at end < 23"}) == 0);
        CHECK(asked({"predict", "--with", "draught,bias=0.5", "--out", s.at("predicted")}) == 0);
        CHECK_THAT(text_of(s.at("predicted") + "/prediction.html"),
                   ContainsSubstring("the effect bias=0.5 acts in this scenario"));
        CHECK(asked({"verify", "--with", "draugth", "--require", "T > 0"}) == 2);
        CHECK(asked({"verify", "--with", "draught=warm", "--require", "T > 0"}) == 2);
        CHECK(asked({"verify", "--with", "draught,draught", "--require", "T > 0"}) == 2);
    }
    SECTION("the other commands take it") {
        CHECK(asked({"verify", "--require", "T at end in [0, 60]"}) == 0);
        CHECK(asked({"verify", "--require", "T at end > 60"}) == 5);
        CHECK(asked({"predict", "--out", s.at("predicted")}) == 0);
        CHECK(fs::exists(s.at("predicted") + "/tubes.csv"));
        CHECK(asked({"control", "--law", "h = K", "--gain", "K=0:9", "--require",
                     "T at end in [0, 90]"}) == 0);
        CHECK(asked({"design", "--vary", "h=0:9", "--halve", "k", "--share", "1", "--budget",
                     "5"}) != 2);
    }
}

TEST_CASE("online, outliers, effects, checkpoints: the same files as any result") {
    served const s;
    auto const out = s.at("out");
    auto const online = run({"online", s.data(), "--out", out, "--quiet"});
    CHECK(online.code == 0);
    CHECK_THAT(online.out, ContainsSubstring("10 updates, the longest took"));
    CHECK(run({"check", out, "--all", "--quiet"}).code == 0);
    auto const auto_count =
        run({"identify", s.data(), "--out", out, "--outliers", "auto", "--quiet"});
    CHECK(auto_count.code == 0);
    CHECK_THAT(auto_count.out, ContainsSubstring("outliers needed: 0"));
    CHECK(run({"identify", s.data(), "--out", out, "--with", "draught", "--quiet", "--boxes", "50"})
              .code == 0);
    CHECK(json_of(fs::path{out} / "result.json")["effects"] == nlohmann::json{"draught"});
    auto const ranked = run({"rank", s.data(), "--out", s.at("r"), "--with", "draught", "--quiet"});
    CHECK(ranked.code != 2);
    CHECK_THAT(ranked.out, ContainsSubstring("draught"));
    auto const stopped = run({"identify", s.data(), "--out", out, "--quiet", "--checkpoint", "0",
                              "--accuracy", "1e-9", "--boxes", "30"});
    CHECK(stopped.code != 2);
    REQUIRE(fs::exists(fs::path{out} / "checkpoint.txt"));
    CHECK(run({"identify", s.data(), "--out", out, "--quiet", "--checkpoint", "0"}).code == 2);
    auto const more = run({"identify", s.data(), "--out", out, "--quiet", "--resume", "--accuracy",
                           "1e-9", "--boxes", "60"});
    CHECK(more.code != 2);
    CHECK_THAT(more.out, ContainsSubstring("--resume"));
}

TEST_CASE("a diagnosis is written with its model, checked and shown anew") {
    served const s;
    auto const out = s.at("out");
    auto const stated = text_of(s.data() + "/dataset.json");
    std::ofstream(s.data() + "/dataset.json", std::ios::binary)
        << "{ \"assumptions\": [\"clocks agree\"]," << stated.substr(stated.find('{') + 1);
    auto const r = run({"diagnose", s.data(), "--out", out, "--quiet", "--budget", "20"});
    CAPTURE(r.err);
    CHECK(r.code == 0);
    for (auto const* file : {"/diagnosis.json", "/report.html", "/model/result.json"})
        CHECK_THAT(text_of(out + file), ContainsSubstring("clocks agree"));
    CHECK_THAT(r.out, ContainsSubstring("gap none") && ContainsSubstring("ranges of all"));
    CHECK(files_in(out) ==
          std::set<std::string>{"diagnosis.json", "model", "report.html", "report.page.json"});
    CHECK(fs::exists(out + "/model/result.json"));
    CHECK(run({"check", out, "--quiet"}).code == 0);
    CHECK(run({"check", out + "/model", "--all", "--quiet"}).code == 0);
    CHECK(run({"report", out, "--out", s.at("page")}).code == 0);
    CHECK(text_of(s.at("page") + "/report.html") == text_of(out + "/report.html"));
}

TEST_CASE("simulate, rank and describe work for any model") {
    served const s;
    auto const out = s.at("out");
    CHECK(run({"simulate", "--scenario", "all", "--validated", "--set", "k=0.4:0.6", "--out", out})
              .code == 0);
    CHECK(files_in(out) ==
          std::set<std::string>{"simulation.html", "tea.trajectory.csv", "tea.tube.csv"});
    // T' = 2 + d - 0.5 T from 60 on is (2 + d)/0.5 (1 - 1/e) + 60/e at 2 s.
    auto const simulated = [&](std::vector<std::string> const& more) {
        std::vector<std::string> words{"simulate",    "--scenario", "tea",
                                       "--validated", "--out",      s.at("with")};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    CHECK_THAT(simulated({}).out, ContainsSubstring("T = 24.6"));
    CHECK_THAT(simulated({"--with", "draught=1"}).out, ContainsSubstring("T = 25.87"));
    CHECK_THAT(simulated({"--with", "draught=1,bias=0.5"}).out, ContainsSubstring("T = 26.37"));
    CHECK_THAT(simulated({"--with", "draught", "--set", "draught.a=1"}).out,
               ContainsSubstring("T = 25.87"));
    CHECK_THAT(simulated({"--with", "draught"}).out, ContainsSubstring("T = 24.6"));
    auto late = cup();
    late.effects.push_back(sivid::effects::sensor_latency("late", {"T"}, {0_dec, 1_dec}));
    auto const plain =
        run({"simulate", "--scenario", "tea", "--with", "late=1", "--out", s.at("late")}, late);
    CHECK_THAT(plain.out, ContainsSubstring("T = 37.9")); // of 1 s before: 4 + 56/sqrt(e)
    CHECK_THAT(run({"simulate", "--scenario", "tea", "--with", "late=1", "--validated", "--out",
                    s.at("late")},
                   late)
                   .err,
               ContainsSubstring("without it the model is simulated"));
    CHECK_THAT(simulated({"--with", "draugth"}).err, ContainsSubstring("did you mean 'draught'?"));
    CHECK_THAT(simulated({"--with", "draught@tea"}).err, ContainsSubstring("from its begin to"));
    CHECK(run({"rank", s.data(), "--out", s.at("ranked"), "--quiet"}).code != 2);
    auto const ranked = run(
        {"rank", "--scenario", "tea", "--measure", "T=0.1", "--out", s.at("ranked"), "--quiet"});
    CHECK(ranked.code == 0);
    CHECK_THAT(ranked.out, ContainsSubstring("tea T: k"));
    CHECK_THAT(run({"describe"}).out, StartsWith("model cup\n"));
    CHECK_THAT(run({"describe", "--dot"}).out, StartsWith("digraph \"cup\""));
}

TEST_CASE("the least disturbance of a data set is bounded from both sides") {
    served const s;
    auto const asked = [&] {
        return run({"disturbance", s.data(), "--on", "T=2", "--quiet", "--out", s.at("out")});
    };
    auto const none = asked();
    CHECK(none.code == 0);
    CHECK_THAT(none.out, ContainsSubstring("without disturbances (proved)"));
    CHECK(files_in(s.at("out")) == std::set<std::string>{"disturbance.csv", "disturbance.html",
                                                         "disturbance.json",
                                                         "disturbance.page.json"});
    CHECK(json_of(fs::path{s.at("out")} / "disturbance.json")["size"][1] == 0);

    // One reading more than the cup can explain.
    auto const file = fs::path{s.data()} / "tea.measurements.csv";
    auto rows = text_of(file);
    auto const last = rows.rfind('\n', rows.size() - 2) + 1;
    auto const comma = rows.find(',', last) + 1;
    rows.insert(comma, "1");
    s.folder().write("data/tea.measurements.csv", rows);
    auto const some = asked();
    CAPTURE(some.out, some.err);
    CHECK(some.code == 0);
    CHECK_THAT(some.out, ContainsSubstring("least disturbance: ") &&
                             ContainsSubstring("it is reached somewhere in tea from"));
    auto const json = json_of(fs::path{s.at("out")} / "disturbance.json");
    CHECK(json["format"] == "sivid-disturbance-1");
    CHECK(json["size"][0] > 1);
    CHECK(json["size"][1] < 2 * json["size"][0].get<double>());
    CHECK(json["equations"][0]["scale"] == 2);
    CHECK_THAT(text_of(fs::path{s.at("out")} / "disturbance.csv"),
               StartsWith("scenario,equation,from,to,value\ntea,T,0,"));

    // The printed command poses the problem in which that much is allowed.
    auto const at = some.out.find("cup identify ");
    REQUIRE(at != std::string::npos);
    auto const line = some.out.substr(at, some.out.find(" --out DIR", at) - at);
    auto const option = line.find(" --disturbance T=");
    REQUIRE(option != std::string::npos);
    auto const next = run({"identify", s.data(), "--disturbance", line.substr(option + 15),
                           "--quiet", "--out", s.at("next")});
    CAPTURE(line, next.out, next.err);
    CHECK((next.code == 0 || next.code == 3));

    auto const traded = run({"disturbance", s.data(), "--on", "T=2", "--error", "T=0.1", "--curve",
                             "3", "--quiet", "--out", s.at("out")});
    CAPTURE(traded.out, traded.err);
    CHECK(traded.code != 2);
    CHECK_THAT(traded.out, ContainsSubstring(", curve.csv"));
    CHECK_THAT(text_of(fs::path{s.at("out")} / "curve.csv"),
               StartsWith("equations_lower,equations_upper,channels_lower,channels_upper\n"));
    auto const curve = text_of(fs::path{s.at("out")} / "curve.csv");
    CHECK(std::count(curve.begin(), curve.end(), '\n') == 4);
    CHECK(std::count(curve.begin(), curve.end(), ',') == 12);
    CHECK_THAT(text_of(fs::path{s.at("out")} / "disturbance.html"),
               ContainsSubstring("What the witness is disturbed by") &&
                   ContainsSubstring("Sizes that are enough together"));
    CHECK(asked().code == 0);
    CHECK_FALSE(fs::exists(fs::path{s.at("out")} / "curve.csv"));
    CHECK_THAT(run({"disturbance", s.data(), "--on", "T=2", "--curve", "3", "--quiet", "--out",
                    s.at("out")})
                   .err,
               ContainsSubstring("equations and channels"));
}

TEST_CASE("a table is imported, and a log that is none is refused whole") {
    served const s;
    s.folder().write("log.csv", "t,h,T\n0,2,60\n0.5,2,48\n1,2,38\n");
    s.folder().write("mapping.json", R"({ "format": "sivid-mapping-1", "id": "tea", "model": "cup",
        "parameters": { "k": { "prior": [0.2, 1], "unit": "1/s" } }, "max_outlier_fraction": 0,
        "scenarios": [ { "name": "tea", "role": "fit", "file": "log.csv",
          "time": { "column": "t", "unit": "s", "offset": 0 }, "interpolation": "hold",
          "inputs": { "h": { "column": "h", "unit": "K/s" } },
          "channels": { "T": { "column": "T", "unit": "K", "error": 2 } },
          "initial": { "T": [59, 61] } } ] })");
    auto const r = run({"import", s.at("mapping.json"), "--out", s.at("imported")});
    CAPTURE(r.err);
    CHECK(r.code == 0);
    CHECK(fs::exists(s.at("imported") + "/dataset.json"));
    CHECK(run({"identify", s.at("imported"), "--out", s.at("out"), "--quiet"}).code != 2);
    s.folder().write("log.csv", "t,h,T\n0,2,60\n0.5,2\n");
    CHECK(run({"import", s.at("mapping.json"), "--out", s.at("torn")}).code == 2);
    CHECK_FALSE(fs::exists(s.at("torn")));
}

TEST_CASE("results that cannot be written are an error, and leave nothing half written") {
    served const s;
    for (std::vector<std::string> const& words : std::vector<std::vector<std::string>>{
             {"identify", s.data(), "--quiet", "--budget", "2"},
             {"diagnose", s.data(), "--quiet", "--budget", "1"},
             {"simulate", "--scenario", "tea"},
             {"generate", "--scenario", "tea", "--absolute", "1"}}) {
        auto all = words;
        all.insert(all.end(), {"--out", "/dev/full"});
        auto const r = run(all);
        CAPTURE(words.front(), r.err);
        CHECK(r.code == 2);
        CHECK_THAT(r.err, ContainsSubstring("is a file"));
        all.back() = s.at("log") + "/out";
        s.folder().write("log", "a file");
        CHECK(run(all).code == 2);
    }
}

TEST_CASE("variants, own commands and the usual scenarios are of the robot") {
    auto r = cup();
    r.variants = {{"lid", "whether there is one", {"none", "on"}}};
    std::vector<std::string> chosen;
    r.variant = [&](std::vector<std::string> const& c) {
        chosen = c;
        return cup().model;
    };
    r.commands = {{"drink", "empties it", [](int argc, char**) { return 10 + argc; }}};
    CHECK(run({"describe"}, r).code == 0);
    CHECK(chosen == std::vector<std::string>{"none"});
    CHECK(run({"describe", "--lid", "on"}, r).code == 0);
    CHECK(chosen == std::vector<std::string>{"on"});
    CHECK(run({"describe", "--lid", "off"}, r).code == 2);
    CHECK(run({"drink", "up"}, r).code == 12);
    CHECK_THAT(run({"--help"}, r).out, ContainsSubstring("empties it"));
    r.scenarios.push_back(r.scenarios.front());
    r.scenarios.back().name = "other";
    r.scenarios.back().usual = false;
    served const s;
    CHECK(run({"simulate", "--scenario", "all", "--out", s.at("out")}, r).code == 0);
    CHECK(files_in(s.at("out")).size() == 2);
}
