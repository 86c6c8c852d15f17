// SPDX-License-Identifier: MIT
#include <sivid/verifier/diagnosis_check.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "io/support.hpp"
#include "support/catch.hpp"

#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/io/diagnosis_json.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/result/problem_digest.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

using namespace sivid;
using nlohmann::json;
using outcome = check_finding::outcome;

namespace {

struct campaign {
    identification_problem problem;
    holdout held_out;
    json stored;

    explicit campaign(small_campaign::truth const& real)
        : campaign(small_campaign::problem(real), small_campaign::experiment(2, real)) {}
    campaign(identification_problem const& posed, experiment const& withheld)
        : problem(posed), held_out({withheld}) {
        auto run = diagnose(problem, small_campaign::catalogue(), {});
        judge_by_holdout(run, held_out);
        stored = json::parse(diagnosis_json(run.result, "small",
                                            {.folder = "../data",
                                             .digest = std::string(64, '0'),
                                             .problem = problem_digest(problem)}));
    }
    /// @throws input_error
    [[nodiscard]] std::vector<check_finding> check(json const& what, double seconds = 60) const {
        io_support::temporary_folder const folder;
        folder.write("diagnosis.json", what.dump());
        diagnosis_check_options options;
        options.seconds = seconds;
        options.held_out = &held_out;
        return check_diagnosis(problem, small_campaign::catalogue(), read_diagnosis(folder.path()),
                               options);
    }
    [[nodiscard]] outcome forged(std::function<void(json&)> const& spoil,
                                 double seconds = 60) const {
        auto bad = stored;
        spoil(bad);
        REQUIRE(bad != stored);
        return overall(check(bad, seconds));
    }
};

campaign const& with_drag() {
    static campaign const made(small_campaign::with_drag(0.3));
    return made;
}
std::size_t cause_with(json const& d, std::string const& verdict) {
    std::size_t k = 0;
    while (k < d["causes"].size() && d["causes"][k]["verdict"] != verdict) ++k;
    return k;
}
void scale(json& range, double low, double high) {
    range[0] = range[0].get<double>() * low;
    range[1] = range[1].get<double>() * high;
}

} // namespace

TEST_CASE("a diagnosis is verified, with a gap and without") {
    for (auto const& f : with_drag().check(with_drag().stored)) {
        CAPTURE(f.what, f.detail, to_string(f.found));
        CHECK((f.found == outcome::verified || f.found == outcome::nothing));
    }
    campaign const none{small_campaign::truth{}};
    CHECK(overall(none.check(none.stored)) == outcome::verified);
    // Which it is not of other data, nor in no time.
    campaign const other{small_campaign::with_drag(0.35)};
    CHECK(overall(other.check(with_drag().stored)) == outcome::refuted);
    CHECK(overall(with_drag().check(with_drag().stored, 0)) != outcome::verified);
}

TEST_CASE("an inflation that is forged is refuted or not proved") {
    auto const& c = with_drag();
    auto const gap = [&](double low, double high) {
        return c.forged([&](json& d) { scale(d["gap"]["inflation"], low, high); });
    };
    CHECK(gap(0.5, 0.9) != outcome::verified); // less than the witness shows
    CHECK(gap(1.2, 1.2) == outcome::refuted);  // more than it does
    CHECK(gap(0.5, 0.5) != outcome::verified);
    CHECK(c.forged([](json& d) { d["gap"]["verdict"] = "none"; }) == outcome::refuted);
    CHECK(c.forged([](json& d) { d["gap"]["verdict"] = "undecided"; }) != outcome::refuted);
    CHECK(c.forged([](json& d) { d["gap"]["witness"] = nullptr; }) != outcome::refuted);
    CHECK(c.forged([](json& d) { // moved
        auto& w = d["gap"]["witness"]["parameters"];
        w.begin().value() = w.begin().value().get<double>() * 1.1;
    }) != outcome::verified);
    CHECK(c.forged([](json& d) { d["gap"]["witness"]["initial"].clear(); }) == outcome::refuted);
    CHECK(c.forged([](json& d) { scale(d["gap"]["scenarios"].begin().value(), 1.5, 1.5); }) !=
          outcome::verified);
    CHECK(c.forged([](json& d) {
        d["gap"]["scenarios"]["S9"] = d["gap"]["scenarios"].begin().value();
    }) == outcome::refuted);
    CHECK(c.forged([](json& d) {
        d["gap"]["channels"]["S9"] = d["gap"]["scenarios"].begin().value();
    }) == outcome::refuted);
}

TEST_CASE("a bound that is carried over is proved at the motion that it comes from, only there") {
    auto const& c = with_drag();
    auto const& causes = c.stored["causes"];
    auto const upper = c.stored["gap"]["inflation"][1];
    std::size_t k = 0;
    while (k < causes.size() && causes[k]["inflation"][1] != upper) ++k;
    REQUIRE(k < causes.size());
    CHECK(c.forged([&](json& d) { scale(d["causes"][k]["inflation"], 1, 0.99); }) !=
          outcome::verified);
    CHECK(c.forged([&](json& d) { // the parameters of the effect, too
        for (auto& x : d["causes"][k]["witness"]["parameters"]) x = 1.02 * x.get<double>() + 0.02;
    }) != outcome::verified);
    CHECK(c.forged([&](json& d) { d["time_unit"] = "ms"; }) == outcome::refuted);
}

TEST_CASE("causes that are forged are refuted or not proved") {
    auto const& c = with_drag();
    auto const explains = cause_with(c.stored, "explains");
    REQUIRE(explains < c.stored["causes"].size());
    auto const excluded = cause_with(c.stored, "excluded");
    REQUIRE(excluded < c.stored["causes"].size());
    CHECK(c.forged([&](json& d) { // what explains is said to be excluded
        auto& k = d["causes"][explains];
        k["verdict"] = "excluded";
        k["inflation"] = {1.5, nullptr};
    }) == outcome::refuted);
    CHECK(c.forged([&](json& d) { // and the contrary, with the witness of another
        auto& k = d["causes"][excluded];
        k["verdict"] = "explains";
        k["excluded_by"] = nullptr;
        k["inflation"] = {0, 0.9};
        k["witness"] = d["causes"][explains]["witness"];
    }) == outcome::refuted);
    CHECK(c.forged([&](json& d) { d["causes"][explains]["witness"] = nullptr; }) !=
          outcome::verified);
    CHECK(c.forged([&](json& d) {
        auto& w = d["causes"][explains]["witness"]["parameters"];
        for (auto& value : w) value = value.get<double>() * 1.2;
    }) != outcome::verified);
    CHECK(c.forged([&](json& d) { scale(d["causes"][explains]["inflation"], 0.5, 0.5); }) !=
          outcome::verified);
    CHECK(c.forged([&](json& d) { d["causes"][explains]["effects"][0] = "unheard of"; }) !=
          outcome::verified);
    for (auto const& entry : c.stored["causes"][explains]["parameters"].items()) {
        if (entry.value().is_null()) continue;
        std::string const name = entry.key();
        CHECK(c.forged([&](json& d) { // shifted
            auto& p = d["causes"][explains]["parameters"][name];
            p[0] = p[1];
            p[1] = p[1].get<double>() * 1.5;
        }) == outcome::refuted);
        CHECK(c.forged([&](json& d) { // shrunk about the witness
            double const at = d["causes"][explains]["witness"]["parameters"][name];
            d["causes"][explains]["parameters"][name] = {at, at};
            d["answer"]["constants"][name]["hull"] = {at, at};
        }) == outcome::refuted);
    }
    for (auto const* const share : {"fit", "holdout", "holdout_over_fits"})
        CHECK(c.forged([&](json& d) { d["shrink"][share] = {0.2, 0.3}; }) == outcome::refuted);
    CHECK(c.forged([&](json& d) { d["answer"]["constants"].begin().value()["value"] = 0.123; }) ==
          outcome::refuted);
}

TEST_CASE("what is said beside the bounds of an answer is compared with them") {
    auto const& c = with_drag();
    auto const explains = cause_with(c.stored, "explains");
    CHECK(c.forged([](json& d) { d["answer"]["formulas"] = {"v' becomes 0"}; }) ==
          outcome::refuted);
    CHECK(c.forged([](json& d) { d["answer"]["symbols"]["drag.k"] = "m"; }) == outcome::refuted);
    CHECK(c.forged([&](json& d) { d["causes"][explains]["excluded_by"] = "x"; }) ==
          outcome::refuted);
    CHECK(c.forged([](json& d) { // the model as it is explains nothing
        d["answer"]["kind"] = "unexplained";
        d["answer"]["effects"] = json::array();
        d["answer"]["formulas"] = json::array();
        d["answer"]["symbols"] = json::object();
    }) == outcome::refuted);
    auto const& constants = c.stored["answer"]["constants"];
    bool any = false;
    for (auto const& entry : constants.items()) {
        if (entry.value()["hull"].is_null()) continue;
        any = true;
        CHECK(c.forged([&](json& d) { // nobody looked there
            d["answer"]["constants"][entry.key()]["prior"] = {0, 1000};
        }) == outcome::refuted);
    }
    CHECK(any);
    CHECK(c.forged([](json& d) { // a place that nobody proved
        d["remainder"] = {{"effects", json::array()},
                          {"inflation", d["gap"]["inflation"]},
                          {"where", {d["where"][0]}},
                          {"disturbances", json::array()}};
        d["remainder"]["where"][0]["proved"] = true;
    }) == outcome::refuted);
    for (auto const* const where : {"", "gap", "answer"}) {
        auto bad = c.stored;
        (*where == 0 ? bad : bad[where])["proved"] = "for all";
        CHECK_THROWS_AS(c.check(bad), input_error);
    }
}

TEST_CASE("relations and places that are forged are not proved") {
    auto const& c = with_drag();
    REQUIRE_FALSE(c.stored["relations"].empty());
    for (auto const* const key : {"from", "to"}) {
        CHECK(c.forged([&](json& d) {
            auto& at = d["relations"][0]["windows"][0][key];
            at = at.get<double>() + 0.1;
        }) != outcome::verified);
    }
    CHECK(c.forged([](json& d) { d["relations"][0]["equation"] = "p"; }) != outcome::verified);
    CHECK(c.forged([](json& d) { d["relations"][0]["sensors"] = {"p"}; }) != outcome::verified);
    CHECK(c.forged([](json& d) { d["relations"][0]["assumptions"].clear(); }) != outcome::verified);
    CHECK(c.forged([](json& d) { d["assumptions"].clear(); }) == outcome::refuted);
    for (std::size_t k = 0; k < c.stored["where"].size(); ++k) {
        if (!c.stored["where"][k]["proved"].get<bool>()) continue;
        CHECK(c.forged([&](json& d) { d["where"][k]["name"] = "p"; }) != outcome::verified);
        CHECK(c.forged([&](json& d) { d["where"][k]["kind"] = "sensor"; }) == outcome::refuted);
        CHECK(c.forged([&](json& d) {
            for (auto* const of : {&d, &d["where"][k]})
                (*of)["assumptions"].push_back("a calm day");
        }) != outcome::verified);
        if (c.stored["where"][k]["missing"].is_null()) continue;
        CHECK(c.forged([&](json& d) {
            auto& at = d["where"][k]["from"];
            at = at.get<double>() + 0.1;
        }) != outcome::verified);
        CHECK(c.forged([&](json& d) { d["where"][k]["unit"] = "furlong"; }) != outcome::verified);
        CHECK(c.forged([&](json& d) {
            auto& m = d["where"][k]["missing"];
            double const middle = 0.5 * (m[0].get<double>() + m[1].get<double>());
            m = {middle, middle};
            d["where"][k]["estimate"] = middle;
        }) != outcome::verified);
    }
}

TEST_CASE("when an effect begins is proved again, as it is stated alone") {
    auto const pushed_from = [](double begin) {
        small_campaign::truth real;
        real.missing = [begin](double t, double, double) { return t < begin ? 0 : -0.6; };
        return real;
    };
    auto posed = small_campaign::problem();
    posed.experiments = {small_campaign::experiment(0, pushed_from(1.5)),
                         small_campaign::experiment(1, pushed_from(2.2))};
    campaign const c(posed, small_campaign::experiment(2, pushed_from(1)));
    auto const answer = cause_with(c.stored, "explains");
    REQUIRE(answer < c.stored["causes"].size());
    REQUIRE(c.stored["causes"][answer]["onsets"].size() == 2);
    CHECK(overall(c.check(c.stored)) == outcome::verified);
    auto const onset = [&](char const* key, json const& is) {
        return c.forged([&](json& d) { d["causes"][answer]["onsets"].begin().value()[key] = is; });
    };
    CHECK(onset("value", 1.45) != outcome::verified);
    CHECK(onset("hull", {1.49, 1.51}) != outcome::verified);
    CHECK(onset("prior", {0, 9}) != outcome::verified);
    CHECK(onset("hull", nullptr) != outcome::refuted);
    CHECK(c.forged([&](json& d) {
        auto& all = d["causes"][answer]["onsets"];
        all["E9"] = all.begin().value();
    }) != outcome::verified);
}

TEST_CASE("held-out figures that are forged are not proved") {
    auto const& c = with_drag();
    REQUIRE_FALSE(c.stored["causes"][0]["holdout"].is_null());
    CHECK(c.forged([](json& d) {
        auto& h = d["causes"][0]["holdout"];
        h["inflation_after"] = {0, 0.01};
    }) == outcome::refuted);
    CHECK(c.forged([](json& d) { scale(d["causes"][0]["holdout"]["inflation_before"], 2, 2); }) ==
          outcome::refuted);
}

TEST_CASE("a diagnosis that lacks a key, or another format, is bad input") {
    auto const& c = with_drag();
    for (auto const* const key : {"format", "dataset", "gap", "relations", "where", "causes",
                                  "answer", "shrink", "assumptions", "unobservable"}) {
        auto bad = c.stored;
        bad.erase(key);
        CAPTURE(key);
        CHECK_THROWS_AS(c.check(bad), input_error);
    }
    for (auto const* const key : {"effects", "verdict", "inflation", "witness", "assumptions",
                                  "untouched", "excluded_by", "parameters"}) {
        auto bad = c.stored;
        bad["causes"][0].erase(key);
        CAPTURE(key);
        CHECK_THROWS_AS(c.check(bad), input_error);
    }
    auto bad = c.stored;
    bad["format"] = "sivid-diagnosis-9";
    CHECK_THROWS_AS(c.check(bad), input_error);
    bad = c.stored;
    bad.erase("problem");
    CHECK(overall(c.check(bad)) == outcome::undecided);
}
