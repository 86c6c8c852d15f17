// SPDX-License-Identifier: MIT
// Answers for all disturbances up to a bound: planted ones never break them, and a result with a
// smaller bound than it was found with is refused.
#include "app/cup.hpp"

#include <sivid/app/robot_of_text.hpp>
#include <sivid/text/read_model.hpp>

#include "support/catch.hpp"
#include "support/child_program.hpp"
#include "support/random.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

using namespace app_test;
using support::text_of;

namespace {

using course = std::function<double(double)>;
constexpr double heater = 2, begin = 60, duration = 2;

/// T' = h - k T + d(t) from 60 on, a grid of 2000 steps of fourth order; the steps end where d
/// jumps, at multiples of 0.001.
std::vector<double> temperatures(double k, course const& d, std::vector<double> const& at) {
    constexpr int steps = 2000;
    double const dt = duration / steps;
    double x = begin;
    std::vector<double> result;
    auto next = at.begin();
    for (int n = 0; next != at.end(); ++n) {
        double const t = n * dt;
        while (next != at.end() && *next <= t + 1e-9) {
            result.push_back(x);
            ++next;
        }
        auto const f = [&](double y) { return heater - k * y + d(t + dt / 2); };
        double const k1 = f(x), k2 = f(x + dt / 2 * k1), k3 = f(x + dt / 2 * k2),
                     k4 = f(x + dt * k3);
        x += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return result;
}

/// Shapes within [-1, 1]: at the bound all the time, to and fro, a wave, pieces that are drawn.
std::vector<course> shapes(support::draws& d) {
    std::vector<double> pieces;
    for (int n = 0; n < 10; ++n) pieces.push_back(d.uniform(-1, 1));
    double const speed = d.uniform(1, 12), phase = d.uniform(0, 6), turn = d.uniform(0.2, 1.8);
    return {[](double) { return 1.0; },
            [](double) { return -1.0; },
            [=](double t) { return t < turn ? -1.0 : 1.0; },
            [=](double t) { return std::sin(speed * t + phase) > 0 ? 1.0 : -1.0; },
            [=](double t) { return std::sin(speed * t + phase); },
            [=](double t) { return pieces[std::min<std::size_t>(9, std::size_t(t * 5))]; }};
}

nlohmann::json stored_json(fs::path const& file) { return nlohmann::json::parse(text_of(file)); }

std::vector<std::vector<double>> table(fs::path const& file) {
    std::istringstream lines(text_of(file));
    std::string line, cell;
    std::getline(lines, line);
    std::vector<std::vector<double>> rows;
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        auto& row = rows.emplace_back();
        while (std::getline(cells, cell, ','))
            row.push_back(std::strtod(cell.c_str(), nullptr)); // words: 0
    }
    return rows;
}

/// Readings of a cup that is disturbed, each within 0.2 K.
void plant(served const& s, double k, course const& d, support::draws& draw) {
    std::vector<double> times;
    for (int n = 1; n <= 10; ++n) times.push_back(0.2 * n);
    auto const seen = temperatures(k, d, times);
    std::ostringstream text;
    text.precision(15);
    text << "t,T,T_err\n";
    for (std::size_t n = 0; n < times.size(); ++n)
        text << times[n] << ',' << seen[n] + draw.uniform(-0.199, 0.199) << ",0.2\n";
    s.folder().write("data/tea.measurements.csv", text.str());
}

finished identified(served const& s, std::string const& bound, std::string const& out = "found") {
    return run({"identify", s.data(), "--disturbance", "T=" + bound, "--budget", "5", "--accuracy",
                "0.02", "--quiet", "--out", s.at(out)});
}

finished verified(served const& s, std::string const& what, std::string const& of = "found") {
    return run(
        {"verify", s.at(of), "--scenario", "tea", "--require", what, "--quiet", "--budget", "2"});
}

} // namespace

TEST_CASE("planted disturbances break no answer that is for all of them") {
    support::draws draw(71);
    served const s;
    double const w = 3, truth = 0.5;
    std::size_t excluding = 0;
    for (std::size_t shape = 0; shape < 6; ++shape) {
        CAPTURE(shape);
        auto const in_data = shapes(draw)[shape];
        plant(
            s, truth, [&](double t) { return w * in_data(t); }, draw);
        auto const found = identified(s, "3");
        CAPTURE(found.out, found.err);
        REQUIRE((found.code == 0 || found.code == 3));
        CHECK_THAT(found.out, ContainsSubstring("for all disturbances of T up to 3 K/s"));
        auto const result = stored_json(fs::path{s.at("found")} / "result.json");
        auto const hull = result["parameters"]["k"]["hull"];
        CHECK(hull[0] <= truth);
        CHECK(hull[1] >= truth);
        if (hull[1].get<double>() - hull[0].get<double>() < 0.4) ++excluding;
        CHECK(result["disturbances"]["equations"]["T"] == 3);
        bool covered = false; // by a box that is not excluded
        for (auto const& row : table(fs::path{s.at("found")} / "boxes.csv"))
            covered = covered || (row[1] <= truth && truth <= row[2]);
        CHECK(covered);
        // A witness holds without a disturbance: simulate it anew.
        if (!result["witness"].is_null()) {
            double const k = result["witness"]["parameters"]["k"];
            auto const rows = table(fs::path{s.data()} / "tea.measurements.csv");
            for (auto const& row : rows)
                CHECK(std::abs(temperatures(k, [](double) { return 0.0; }, {row[0]})[0] - row[1]) <=
                      0.2 + 1e-6);
        }
        auto const checked = run({"check", s.at("found"), "--all", "--quiet"});
        CAPTURE(checked.out, checked.err);
        CHECK(checked.code == 0);

        auto const predicted =
            run({"predict", s.at("found"), "--scenario", "tea", "--quiet", "--out", s.at("tubes")});
        CAPTURE(predicted.out, predicted.err);
        REQUIRE(predicted.code == 0);
        for (auto const& future : shapes(draw)) {
            for (auto const& row : table(fs::path{s.at("tubes")} / "tubes.csv")) {
                double const t = row[0] == row[1] ? row[0] : (row[0] + row[1]) / 2;
                auto const at = std::round(t / 0.001) * 0.001; // of the grid of the simulation
                if (std::abs(at - t) > 1e-9) continue;
                auto const x =
                    temperatures(truth, [&](double u) { return w * future(u); }, {at})[0];
                CHECK(row[2] <= x + 1e-6);
                CHECK(x <= row[3] + 1e-6);
            }
        }
    }
    CHECK(excluding > 3); // or there was nothing to break
}

TEST_CASE("nothing is proved that a worst disturbance breaks") {
    support::draws draw(72);
    served const s;
    double const w = 3, truth = 0.5;
    plant(
        s, truth, [&](double t) { return w * std::sin(4 * t); }, draw);
    REQUIRE(identified(s, "3").code != 2);
    REQUIRE(run({"identify", s.data(), "--error", "T=2", "--quiet", "--out", s.at("exact")}).code !=
            2); // readings are further off, nothing is disturbed
    auto const end = [&](double d) {
        return temperatures(truth, [d](double) { return d; }, {duration})[0];
    };
    auto const above = [](double x) { return "T at end > " + std::to_string(x); };
    for (double const share : {0.001, 0.2, 0.6, 0.99}) {
        CAPTURE(share);
        // Below what the model reaches, above what the worst disturbance does.
        auto const level = end(-w) + share * (end(0) - end(-w));
        CHECK(verified(s, above(level)).code != 0);
        CHECK(verified(s, "always(T > " + std::to_string(level) + ")").code != 0);
    }
    auto const rising = verified(s, "T at end < " + std::to_string(end(w) - 1e-4));
    CHECK(rising.code != 0);
    auto const holds = verified(s, above(10));
    CHECK(holds.code == 0);
    CHECK_THAT(holds.out, ContainsSubstring("unknown disturbances, any function of time: T up to 3 "
                                            "K/s") &&
                              ContainsSubstring("in this scenario disturbances are as large"));
    // The bound decides: without it in the equation the same set of constants may be proved.
    auto const narrow = verified(s, above(end(-w) - 3), "exact");
    CHECK_THAT(narrow.out, ContainsSubstring("readings of T up to 2 K"));
    // A law that would hold without disturbances.
    auto const law = [&](std::string const& goal) {
        return run({"verify", s.at("found"), "--scenario", "tea", "--law", "h = 2 * (30 - T)",
                    "--require", goal, "--quiet", "--budget", "2"});
    };
    auto const kept = law("T at end > 21");
    CAPTURE(kept.out, kept.err);
    CHECK(kept.code == 0);
    // T' = 60 + d - (2 + k) T: with the truth 24.24 + d / 2.5 (1 - exp(-5)) at the end, to 1e-3.
    double const rest = 24 + 36 * std::exp(-5.0), push = 3 / 2.5 * (1 - std::exp(-5.0));
    CHECK(law("T at end > " + std::to_string(rest - push + 1e-3)).code != 0);
    CHECK(law("T at end < " + std::to_string(rest + push - 1e-3)).code != 0);
}

TEST_CASE("a result with another bound than it was found with is refused") {
    support::draws draw(73);
    served const s;
    plant(
        s, 0.5, [](double t) { return t < 1 ? 3.0 : -3.0; }, draw);
    REQUIRE(identified(s, "3").code != 2);
    CHECK(identified(s, "0.5", "small").code == 4); // too small to explain
    auto const file = fs::path{s.at("found")} / "result.json";
    auto const text = text_of(file);
    auto const forge = [&](std::string const& from, std::string const& to) {
        auto forged = text;
        auto const at = forged.find(from);
        REQUIRE(at != std::string::npos);
        forged.replace(at, from.size(), to);
        s.folder().write("found/result.json", forged);
        auto const checked = run({"check", s.at("found"), "--all"});
        CAPTURE(to, checked.out, checked.err);
        CHECK((checked.code == 5 || checked.code == 2));
        CHECK(verified(s, "T at end > 0").code == 2);
        CHECK(run({"certificate", s.at("found")}).code == 2);
    };
    forge("\"T\": 3", "\"T\": 2");
    forge("\"T\": 3", "\"T\": 3.5");
    forge("\"T\": 3", "\"T\": -3");
    forge("\"T\": 3", "\"T\": 1e999");
    forge("\"T\": 3", "\"T\": \"3\"");
    forge("\"T\": 3", "\"U\": 3");
    forge("\"disturbances\"", "\"remarks\"");
    forge("T up to 3 K/s", "T up to 2 K/s");
    s.folder().write("found/result.json", text);
    CHECK(run({"check", s.at("found"), "--all"}).code == 0);
}

TEST_CASE("a model in text says itself what it is disturbed by") {
    support::draws draw(75);
    served const s;
    plant(
        s, 0.5, [](double t) { return t < 1 ? 3.0 : -3.0; }, draw);
    auto const written = [](std::string const& more) {
        auto r = sivid::app::robot_of_text(
            "cup", "cup.toml",
            sivid::model_from_text("format = \"sivid-model-1\"\nname = \"cup\"\n[states]\n"
                                   "T = { range = \"1000 K\", equation = \"heat\" }\n[inputs]\n"
                                   "h = \"K/s\"\n[constants]\nk = \"[0.2, 1] 1/s\"\ngain = 1\n"
                                   "[outputs]\nT = \"T\"\n[equations]\nT = \"gain*h - k*T\"\n" +
                                       more,
                                   "cup.toml"));
        r.file.clear(); // it is no word of the commands here
        return r;
    };
    auto const stated = written("[disturbance]\nT = \"3 K/s\"\n");
    auto const asked = [&](sivid::app::robot r, std::string const& out,
                           std::vector<std::string> const& more = {}) {
        std::vector<std::string> words{"identify", s.data(),  "--budget", "5",      "--accuracy",
                                       "0.02",     "--quiet", "--out",    s.at(out)};
        words.insert(words.end(), more.begin(), more.end());
        auto const said = run(words, r);
        CAPTURE(said.out, said.err);
        REQUIRE(said.code != 2);
        return stored_json(fs::path{s.at(out)} / "result.json");
    };
    // As the option: the same boxes and the same file but for time and words of the command.
    auto const by_text = asked(stated, "text");
    auto const by_option = asked(written(""), "option", {"--disturbance", "T=3"});
    for (auto const* key : {"problem", "disturbances", "parameters", "assumptions", "verdict"})
        CHECK(by_text[key] == by_option[key]);
    CHECK(text_of(fs::path{s.at("text")} / "boxes.csv") ==
          text_of(fs::path{s.at("option")} / "boxes.csv"));
    // An option takes its place, by either name; 0 takes it away.
    for (auto const* name : {"T=4", "heat=4"}) {
        auto const larger = asked(stated, "larger", {"--disturbance", name})["disturbances"];
        CHECK(larger["equations"].size() == 1);
        CHECK(larger["equations"].begin().value() == 4);
    }
    CHECK_FALSE(asked(stated, "none", {"--disturbance", "T=0"}).contains("disturbances"));
    auto const both = asked(stated, "both", {"--error", "T=0.1"})["disturbances"];
    CHECK((both["equations"]["T"] == 3 && both["channels"]["T"] == 0.1));

    // What follows takes it from the result, whatever the model says by then.
    auto r = stated;
    CHECK(run({"check", s.at("text"), "--all", "--quiet"}, r).code == 0);
    r.disturbances = {};
    CHECK(run({"check", s.at("text"), "--all", "--quiet"}, r).code == 0);
    r = stated;
    auto const predicted = run(
        {"verify", s.at("text"), "--scenario", "data:tea", "--require", "T at end > 10", "--quiet"},
        r);
    CAPTURE(predicted.err);
    CHECK_THAT(predicted.out, ContainsSubstring("heat up to 3 K/s"));
    CHECK_THAT(run({"describe"}, r).out, ContainsSubstring("allowed for: heat up to 3 K/s"));
    for (auto const& words : {std::vector<std::string>{"online", s.data()}, {"rank", s.data()}}) {
        auto all = words;
        all.insert(all.end(), {"--quiet", "--budget", "2", "--out", s.at("other")});
        auto const said = run(all, r);
        CAPTURE(said.out, said.err);
        CHECK_THAT(said.out, ContainsSubstring("up to 3 K/s"));
    }
    CHECK_THAT(run({"confidence", s.data(), "--out", s.at("other")}, r).err,
               ContainsSubstring("[disturbance]"));
    // The least one of the equation is beside what else is stated.
    r = written("[error]\nT = \"10 K\"\n");
    auto const least =
        run({"disturbance", s.data(), "--on", "T=1", "--quiet", "--out", s.at("least")}, r);
    CHECK_THAT(least.out, ContainsSubstring("explains the data without disturbances"));
    auto const diagnosed =
        run({"diagnose", s.data(), "--budget", "5", "--quiet", "--out", s.at("gap")}, stated);
    CHECK_THAT(diagnosed.out + diagnosed.err, ContainsSubstring("disturbances left out"));
}

TEST_CASE("what cannot be disturbed is refused, with the remedy") {
    served const s;
    auto const refused = [&](std::vector<std::string> words, std::string const& message,
                             sivid::app::robot const& r = cup()) {
        words.insert(words.begin(), {"identify", s.data(), "--out", s.at("out"), "--quiet"});
        auto const said = run(words, r);
        CAPTURE(said.err, message);
        CHECK(said.code == 2);
        CHECK_THAT(said.err, ContainsSubstring(message));
        CHECK_FALSE(fs::exists(s.at("out")));
    };
    refused({"--disturbance", "U=1"}, "no equation 'U'");
    refused({"--disturbance", "T=0"}, "a number above 0");
    refused({"--disturbance", "T=-1"}, "a number above 0");
    refused({"--disturbance", "T"}, "write name=value");
    refused({"--disturbance", "T=many"}, "--disturbance T");
    refused({"--disturbance", "T=1e999"}, "not a decimal number");
    refused({"--disturbance", "T=1,T=2"}, "named twice");
    refused({"--error", "U=1"}, "no channel 'U'");
    auto late = cup();
    using namespace sivid::literals;
    late.effects.push_back(sivid::effects::sensor_latency("late", {"T"}, {0_dec, 1_dec}));
    refused({"--disturbance", "T=1", "--with", "late"}, "cannot be joined here", late);
}

TEST_CASE("online, rank and design take disturbances") {
    support::draws draw(74);
    served const s;
    plant(
        s, 0.5, [](double t) { return t < 1 ? 3.0 : -3.0; }, draw);
    auto const online = run({"online", s.data(), "--disturbance", "T=3", "--quiet", "--budget", "3",
                             "--out", s.at("on")});
    CAPTURE(online.out, online.err);
    CHECK((online.code == 0 || online.code == 3));
    auto const hull = stored_json(fs::path{s.at("on")} / "result.json")["parameters"]["k"]["hull"];
    CHECK((hull[0] <= 0.5 && hull[1] >= 0.5));
    CHECK(run({"check", s.at("on"), "--all"}).code == 0);
    CHECK(run({"online", s.data(), "--disturbance", "T=0.5", "--quiet", "--budget", "3", "--out",
               s.at("on")})
              .code == 4);
    auto const ranked =
        run({"rank", s.data(), "--disturbance", "T=3", "--quiet", "--out", s.at("ranked")});
    CAPTURE(ranked.out, ranked.err);
    CHECK(ranked.code != 2);
    CHECK_THAT(ranked.out, ContainsSubstring("T up to 3 K/s"));

    auto const planned = run({"rank", "--scenario", "tea", "--measure", "T=0.1", "--disturbance",
                              "T=3", "--quiet", "--out", s.at("ranked")});
    CAPTURE(planned.out, planned.err);
    CHECK(planned.code != 2);
    CHECK_THAT(planned.out, ContainsSubstring("T up to 3 K/s"));

    // Less is promised of an experiment with disturbances than of one without.
    REQUIRE(identified(s, "3").code != 2);
    auto const promised = [](served const& of, std::string const& result) {
        auto const said =
            run({"design", of.at(result), "--scenario", "tea", "--vary", "h=0:60", "--halve", "k",
                 "--measure", "T=0.2", "--quiet", "--budget", "5", "--out", of.at("next")});
        CAPTURE(said.out, said.err);
        CHECK(said.code != 2);
        return said.out;
    };
    CHECK_THAT(promised(s, "found"), ContainsSubstring("as large as in the data"));
    CHECK(run({"design", s.at("found"), "--scenario", "tea", "--vary", "disturbance of T=0:60",
               "--halve", "k"})
              .code == 2);
}
