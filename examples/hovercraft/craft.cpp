// SPDX-License-Identifier: MIT
#include "craft.hpp"
#include "effects.hpp"
#include "influence.hpp"
#include "manoeuvres.hpp"
#include "model.hpp"

#include <sivid/app/program.hpp>

#include <CLI/CLI.hpp>

namespace hovercraft_example {

namespace {

/// The misprints of the report that stay selectable.
sivid::recorded_model variant(std::vector<std::string> const& chosen) {
    hovercraft h;
    if (chosen[0] == "rudder") h.lift = hovercraft::lift_area::rudder;
    if (chosen[1] == "as-printed") h.friction = hovercraft::friction_law::as_printed;
    return sivid::record_model(h);
}

/// Table 2.1 of the report.
std::map<std::string, std::string> meanings() {
    return {{"m", "mass"},
            {"Iz", "moment of inertia about the vertical axis"},
            {"rho", "density of the air"},
            {"Cd", "air resistance coefficient"},
            {"CL", "rudder lift coefficient"},
            {"Cdelta", "propulsion coefficient"},
            {"D", "propeller diameter"},
            {"Su", "front area"},
            {"Sv", "side area"},
            {"Sg", "rudder area"},
            {"A", "area swept by the propeller"},
            {"L", "distance between centre of gravity and rudder"},
            {"Ff", "dry friction force"},
            {"eps", "speed below which the dry friction fades"},
            {"D11", "linear damping in surge"},
            {"D22", "linear damping in sway"},
            {"D33", "linear damping in yaw"}};
}

int run_influence(int argc, char** argv) {
    std::filesystem::path out;
    std::vector<std::string> freed;
    std::vector<std::string> chosen{"as-printed", "unit-vector"};
    CLI::App app{"Table 2.2 of the report with proof: how far each constant moves each equation"};
    app.add_option("--out", out, "folder for influence.html and influence.csv")->required();
    app.add_option("--free", freed, "constants to rank although they follow from others, such as A")
        ->delimiter(',');
    app.add_option("--lift", chosen[0])->check(CLI::IsMember({"as-printed", "rudder"}));
    app.add_option("--friction", chosen[1])->check(CLI::IsMember({"unit-vector", "as-printed"}));
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& e) {
        return app.exit(e) == 0 ? sivid::app::done : sivid::app::bad_input;
    }
    return influence(variant(chosen), out, freed,
                     sivid::app::command_line("hovercraft influence", argc, argv));
}

sivid::app::unknown_parameter prior(char const* name, char const* lower, char const* upper) {
    return {name, sivid::app::decimal_of(lower, name), sivid::app::decimal_of(upper, name)};
}

} // namespace

sivid::app::robot craft() {
    auto r = sivid::app::robot_of("hovercraft", "Validated identification of a hovercraft",
                                  hovercraft{}, catalogue());
    r.variants = {
        {"lift", "area in the rudder's lift of equation (2.2b)", {"as-printed", "rudder"}},
        {"friction", "direction of the dry friction", {"unit-vector", "as-printed"}}};
    r.variant = variant;
    r.scenarios = built_in_scenarios();
    for (auto& s : r.scenarios) s.usual = s.name == "S1" || s.name == "S2" || s.name == "S3";
    r.prior = {prior("Sv", "0.20", "0.25"), prior("Sg", "0.0042", "0.0754"),
               prior("L", "0.25", "0.35")};          // of the report
    r.errors = {0.02, 0.02, 0.05, 0.02, 0.02, 0.03}; // as in h3
    r.meanings = meanings();
    r.plane = {"x", "y", "psi"};
    r.manoeuvres = new_manoeuvres();
    r.effort = {}; // its effects are told apart after few boxes (benchmarks/withheld/CAMPAIGNS.md)
    r.diagnosis_share = 0.8;
    r.commands = {
        {"influence", "how far each constant moves each equation (Table 2.2)", run_influence}};
    return r;
}

} // namespace hovercraft_example
