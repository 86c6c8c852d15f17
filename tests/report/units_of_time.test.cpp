// SPDX-License-Identifier: MIT
// Models whose unit of time is not the second: what is printed names theirs.
#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/diagnosis/sensor/detail/sensor_faults.hpp>
#include <sivid/io/diagnosis_json.hpp>
#include <sivid/model/describe.hpp>
#include <sivid/model/named_effects.hpp>
#include <sivid/report/diagnosis_page.hpp>
#include <sivid/report/identification_page.hpp>

#include "diagnosis/small_catalogue.hpp"
#include "support/catch.hpp"

#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace sivid;
using Catch::Matchers::ContainsSubstring;

namespace {

/// The cart with its numbers as they are, but counted in milliseconds.
identification_problem in_milliseconds(identification_problem p) {
    auto& about = p.model.about;
    about.time_unit = "ms";
    about.states[1].unit = about.channels[1].unit = "m/ms";
    about.constants[1].unit = "1/ms";
    return p;
}

struct fast : small_campaign::cart {
    static constexpr auto time_unit = "us";
};
struct tired : small_campaign::cart {
    static constexpr auto time_unit = "hours of sleep";
};

/// What stands around an s that is a unit: "3 s", "m/s", "[s]", "\"unit\": \"s\""; empty: none
/// does.
std::string seconds_in(std::string_view text) {
    auto const is_word = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    };
    for (std::size_t i = 1; i < text.size(); ++i) {
        if (text[i] != 's' || (i + 1 < text.size() && is_word(text[i + 1]))) continue;
        auto const before = text.substr(0, i);
        auto const digit = [&](std::size_t back) {
            return i >= back && std::isdigit(static_cast<unsigned char>(text[i - back])) != 0;
        };
        bool const unit = before.ends_with('/') ||
                          (before.ends_with('[') && text.substr(i + 1).starts_with(']')) ||
                          before.ends_with("/(") || (before.ends_with(' ') && digit(2)) ||
                          (before.ends_with("\xC2\xA0") && digit(3)) ||
                          before.ends_with("unit\": \"") || before.ends_with("unit=\"");
        if (unit) return std::string(text.substr(i < 60 ? 0 : i - 60, 80));
    }
    return {};
}

std::vector<effect> effects_in_time() {
    using namespace literals;
    namespace any = effects;
    model_description about = in_milliseconds(small_campaign::problem()).model.about;
    return {any::input_delay("late", "u", {0_dec, 0.5_dec}),
            any::input_lag("lag", "u", "N", {0_dec, 0.8_dec}, 5),
            any::input_clock_drift("clock", "u", {0_dec, 0.4_dec}),
            any::sensor_latency("latency", {"p"}, {0_dec, 0.6_dec}),
            any::sensor_clock_drift("stamps", {"p"}, {0_dec, 0.4_dec}),
            any::drift("wear", "k", {0_dec, 0.1_dec}),
            any::linear_damping("damping", "v", {0_dec, 1_dec}),
            sensor_fault("sensor_drift(v)~0.5", &about)};
}

} // namespace

TEST_CASE("seconds are found where they are") {
    for (auto const* text : {"for 3 s, say", "in m/s", "m/s^2", "time [s]", "\"unit\": \"s\"",
                             "3\xC2\xA0s", "rad/(s V)"})
        CHECK(!seconds_in(text).empty());
    for (auto const* text : {"3 ms", "m/ms", "its u's", "[ms]", "</span>", "3 samples", "1/(ms V)"})
        CHECK(seconds_in(text) == "");
}

TEST_CASE("parameters of effects are in the unit of time of their model") {
    auto const p = in_milliseconds(small_campaign::problem());
    auto const all = with(p.model, effects_in_time());
    auto const unit_of = [&](std::string const& name) {
        return all.about.constants[index_of(all.about.constants, name, "constant")].unit;
    };
    CHECK(unit_of("late.tau") == "ms");
    CHECK(unit_of("lag.tau") == "ms");
    CHECK(unit_of("clock.r") == "1");
    CHECK(unit_of("latency.tau") == "ms");
    CHECK(unit_of("wear.k") == "1/ms");
    CHECK(unit_of("damping.k") == "1/ms");
    CHECK(unit_of("sensor_drift(v)~0.5.d") == "m/ms^2");
    CHECK(seconds_in(describe(all)) == "");
    CHECK_THAT(describe(p.model), ContainsSubstring("model cart, time in ms\n"));
    // In a model that says nothing they are in seconds.
    auto const plain = with(small_campaign::problem().model, effects_in_time());
    CHECK(plain.about.constants[index_of(plain.about.constants, "late.tau", "constant")].unit ==
          "s");
}

TEST_CASE("a functor declares its unit of time") {
    CHECK(record_model(fast{}).about.time_unit == "us");
    CHECK(record_model(small_campaign::cart{}).about.time_unit == "s");
    CHECK_THROWS_WITH(record_model(tired{}),
                      ContainsSubstring("'hours of sleep' is no unit of time"));
}

TEST_CASE("a diagnosis of a model in ms never speaks of seconds") {
    auto const problem = in_milliseconds(small_campaign::problem(small_campaign::with_delay(0.2)));
    diagnosis_options options;
    options.seconds = 12;
    auto const run = diagnose(problem, effects_in_time(), options);
    auto found = run.result;
    found.seconds = 0; // those are of the computer
    CHECK(found.time_unit == "ms");
    auto const json = diagnosis_json(found, "cart");
    CHECK(seconds_in(json) == "");
    CHECK_THAT(json, ContainsSubstring("\"time_unit\": \"ms\""));
    report::diagnosis_report_options about;
    about.dataset = "cart";
    about.model = "cart";
    report::describe(effects_in_time(), about);
    report::diagnosis_plot_data plots;
    plots.scenarios = report::compared_scenarios(run.base, run.candidates.front().fit,
                                                 run.candidates[run.answer].fit);
    auto const page = report::diagnosis_page(report::view_of(found, plots, about)).str();
    CHECK(seconds_in(page) == "");
    CHECK_THAT(page, ContainsSubstring("ms"));
    for (auto const& c : found.causes)
        for (auto const& a : c.assumptions) CHECK(seconds_in(a) == "");
    for (auto const& a : found.assumptions) CHECK(seconds_in(a) == "");
}

TEST_CASE("further texts name the unit of time of the model") {
    auto const problem = in_milliseconds(small_campaign::problem());
    std::vector<faulty_channel> faults(1);
    faults[0].latency = 0.2;
    auto const assumed = fault_assumption(problem, faults);
    CHECK_THAT(assumed, ContainsSubstring("delay 0.2 ms") && ContainsSubstring("m/ms"));
    CHECK(seconds_in(assumed) == "");

    effect late = effects::input_delay("late", "u", {decimal(), decimal()});
    late = only_within(late, {"E1"}, {1.5}, {4.0});
    auto const formulas = formulas_of(problem.model, {late}).lines;
    REQUIRE_FALSE(formulas.empty());
    CHECK_THAT(formulas.back(), ContainsSubstring("from 1.5 ms on until 4 ms"));

    report::identification_view v;
    v.time_unit = "ms";
    report::channel_series p{.name = "p"};
    p.measured = {{.time = 1.5, .value = {0, 1}, .state = report::sample_state::forced_outlier}};
    v.scenarios = {{.name = "E1", .channels = {p}}};
    CHECK_THAT(report::identification_page(v).str(), ContainsSubstring("time [ms]"));
}
