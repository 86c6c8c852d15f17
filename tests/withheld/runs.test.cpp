// SPDX-License-Identifier: MIT
// The robot of the story: what it runs is what the files and laws say, and its records hold the
// truth within their bounds.
#include "runs.hpp"
#include "formula_text.hpp"
#include "simulate.hpp"

#include "io/support.hpp"
#include "support/catch.hpp"

#include <sivid/io/dataset.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

using namespace withheld;
using io_support::temporary_folder;
namespace fs = std::filesystem;

namespace {

double at(double t, std::string const& formula) {
    return value_of(formula, [&](std::string const& name) {
        if (name == "t") return t;
        if (name == "psi") return 0.25;
        throw std::invalid_argument("nothing is called " + name);
    });
}

label craft(std::string const& effect, double value) {
    label l;
    l.id = "craft";
    l.effects = {{effect, {value}}};
    l.constants_true = {{"Sv", 0.23}, {"Sg", 0.042}, {"L", 0.31}};
    return l;
}

scenario plan(double duration) {
    scenario s;
    s.name = "plan";
    s.duration = duration;
    s.motor = {{0, duration}, {100, 100}};
    s.rudder = {{0, duration}, {0.1, 0.1}};
    s.initial[0] = {1, 1};
    for (int k = 1; k <= 10 * duration; ++k) s.sample_times.push_back(six_decimals(0.1 * k));
    return s;
}

double largest_difference(measured_scenario const& a, measured_scenario const& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.truth.size(); ++i)
        for (std::size_t k = 0; k < channel_count; ++k)
            most = std::max(most, std::abs(a.truth[i][k] - b.truth[i][k]));
    return most;
}

} // namespace

TEST_CASE("formulas of laws and requirements have the values that they state") {
    CHECK(at(0, "1 + 2 * 3 - 4 / 2") == 5);
    CHECK(at(0, "-psi^2") == -0.0625);
    CHECK(at(0, "(psi - 1)^2") == 0.5625);
    CHECK(at(0, "clamp(5, -1, 2) + abs(-3) + min(1, 2)") == 6);
    CHECK(at(0, "3 * during(0, 1)") == 3);
    CHECK(at(1, "3 * during(0, 1)") == 0);
    CHECK(at(0, "measured(psi)") == 0.25);
    CHECK(at(0, "psi < 1") == 0.75);
    CHECK(at(0, "0 < psi <= 1") == 0.25);
    CHECK(at(0, "psi in [0, 0.5] and psi > 0.125") == 0.125);
    CHECK(at(0, "psi > 1 or psi > 0") == 0.25);
    CHECK_THROWS_AS(at(0, "psi +"), std::invalid_argument);
    CHECK_THROWS_AS(at(0, "phi"), std::invalid_argument);
    CHECK_THROWS_AS(at(0, "tanh(psi)"), std::invalid_argument);
    CHECK_THROWS_AS(at(0, "psi psi"), std::invalid_argument);
    auto const law = commands_in("W = 3 * a; delta = b ");
    CHECK(law.at("W") == "3 * a");
    CHECK(law.at("delta") == "b");
    CHECK_THROWS_AS(commands_in("W"), std::invalid_argument);
}

TEST_CASE("a law that commands what the scenario says changes nothing, with a memory or without") {
    for (auto const& truth : {craft("rudder_lag", 0.2), craft("input_delay", 0.15),
                              craft("payload", 0.2), craft("position_latency", 0.1)}) {
        random_source random{1};
        auto const open = performed(truth, plan(2), random);
        auto const closed = performed(
            truth, plan(2),
            [](double, channels const&) {
                return command{100, 0.1};
            },
            0.05, 0.02, random);
        CHECK(largest_difference(open, closed) < 1e-7);
    }
}

TEST_CASE("commands act when they should, and are held") {
    random_source random{1};
    auto const stops = [](double t, channels const&) { return command{t < 1 ? 100.0 : 0.0, 0.1}; };
    auto const at_once = performed(craft("payload", 0.2), plan(2), stops, 0.02, 0, random);
    auto const late = performed(craft("payload", 0.2), plan(2), stops, 0.02, 0.01, random);
    CHECK(at_once.plan.motor.at(0.9999) == 100);
    CHECK(at_once.plan.motor.at(1) == 0);
    CHECK(late.plan.motor.at(1.0099) == 100);
    CHECK(late.plan.motor.at(1.01) == 0);
    // The same as inputs of a scenario.
    auto same = plan(2);
    same.motor = {{0, 1 - 1e-9, 1, 2}, {100, 100, 0, 0}};
    CHECK(largest_difference(at_once, performed(craft("payload", 0.2), same, random)) < 1e-7);
    // What sensors show of the rudder's effect is what a law sees, within their bounds.
    std::vector<channels> seen;
    auto const watches = [&](double t, channels const& shown) {
        if (std::abs(t - 0.1 * static_cast<double>(seen.size() + 1)) < 1e-9) seen.push_back(shown);
        return command{100, 0.1};
    };
    auto const run = performed(craft("payload", 0.2), plan(2), watches, 0.05, 0, random);
    REQUIRE(seen.size() >= 18);
    for (std::size_t i = 0; i < seen.size(); ++i)
        for (std::size_t k = 0; k < channel_count; ++k)
            CHECK(std::abs(seen[i][k] - run.truth[i][k]) <= error_bound[k] * (1 + 1e-9));
}

TEST_CASE("records are added to a data set, hold the truth and give nothing away") {
    temporary_folder const folder;
    random_source random{1};
    auto const truth = craft("payload", 0.2);
    auto first = performed(truth, plan(1), random);
    auto second = performed(
        truth, plan(2),
        [](double, channels const& y) {
            return command{80, -0.5 * y[5]};
        },
        0.05, 0.01, random);
    second.plan.name = "law";
    second.plan.holdout = true;
    write_records({}, folder.path() / "one", "records", {first});
    write_records(folder.path() / "one", folder.path() / "two", "", {second});
    CHECK_THROWS_AS(write_records(folder.path() / "two", folder.path() / "three", "", {second}),
                    std::invalid_argument);
    auto const read = sivid::read_dataset(folder.path() / "two", io_support::hovercraft_names());
    CHECK(read.id == "records");
    REQUIRE(read.scenarios.size() == 2);
    CHECK(read.scenarios[0].role == sivid::scenario_role::fit);
    CHECK(read.scenarios[1].role == sivid::scenario_role::holdout);
    for (std::size_t s = 0; s < 2; ++s) {
        auto const& run = s == 0 ? first : second;
        for (auto const& m : read.scenarios[s].measurements) {
            auto const i = static_cast<std::size_t>(std::lround(m.time * 10)) - 1;
            CHECK(sivid::contains(m.bound, run.truth[i][m.channel]));
        }
        // What acts is what is recorded.
        for (double const t : {0.0, 0.3001, 0.9})
            CHECK(std::abs(read.scenarios[s].inputs[1].signal.approximate(t) -
                           run.plan.rudder.at(t)) < 2e-6);
    }
    for (auto const& file : fs::directory_iterator(folder.path() / "two")) {
        std::ifstream in(file.path());
        std::string const text{std::istreambuf_iterator<char>{in}, {}};
        CHECK(text.find("payload") == std::string::npos);
    }
}

TEST_CASE("plans are scenarios as files state them") {
    auto const folder = fs::path{SIVID_SOURCE_DIR} / "examples/hovercraft/scenarios";
    auto const s = read_plan(folder / "S3.json", 0.1);
    CHECK(s.name == "S3");
    CHECK(s.duration == 3);
    CHECK(s.initial[0].lo == 2);
    CHECK(s.sample_times.size() == 30);
    CHECK(std::abs(s.motor.at(1) - 250.0 / 3) < 1e-5);
    CHECK(std::abs(s.rudder.at(1) - (M_PI / 12 + M_PI / 12 * std::sin(M_PI / 2))) < 1e-5);
    CHECK_THROWS_AS(read_plan(folder / "nothing.json", 0.1), std::invalid_argument);
}
