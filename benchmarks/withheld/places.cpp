// SPDX-License-Identifier: MIT
#include "places.hpp"
#include "catalogue.hpp"
#include "instruments.hpp"

#include <algorithm>
#include <map>

namespace withheld {

places places_of(std::string const& effect) {
    places const rudder{{"sway", "yaw"}, {}, {"delta"}};
    places const thrust{{"surge", "sway", "yaw"}, {}, {"W"}};
    places const force{{"surge", "sway"}, {}, {}};
    places const yaw{{"yaw"}, {}, {}};
    places const position{{}, {"x", "y"}, {}};
    static std::map<std::string, places> const table{
        {"rudder_lag", rudder},
        {"input_delay", rudder},
        {"rudder_trim", rudder},
        {"rudder_saturation", rudder},
        {"rudder_deadband", rudder},
        {"wind", force},
        {"ground_slope", force},
        {"payload", force},
        {"battery_sag", thrust},
        {"motor_lag", thrust},
        {"thrust_loss_with_speed", thrust},
        {"rudder_backlash", rudder},
        {"rudder_rate_limit", rudder},
        {"stribeck", force},
        {"cg_offset", {{"surge", "sway", "yaw"}, {}, {}}},
        {"thrust_offset", yaw},
        {"quadratic_yaw_damping", yaw},
        {"dry_yaw_friction", yaw},
        {"linear_surge_damping", {{"surge"}, {}, {}}},
        {"friction_anisotropy", {{"sway"}, {}, {}}},
        {"gyro_bias", {{}, {"r"}, {}}},
        {"heading_bias", {{}, {"psi"}, {}}},
        {"position_scale", position},
        {"position_latency", position},
        // No catalogue has these.
        {"gust", {{"sway"}, {}, {}}},
        {"tether", force},
        {"swell", {{"sway"}, {}, {}}},
        {"cubic_drag", {{"surge"}, {}, {}}},
        {"weathervane", yaw},
        {"cross_coupling", {{"sway"}, {}, {}}},
        {"servo", rudder}};
    auto const name = plain_name(effect);
    // A term that an equation lacks, by its state.
    if (auto const mark = name.find("'~"); mark != name.npos) {
        static std::map<std::string, std::string> const equation{
            {"u", "surge"}, {"v", "sway"}, {"r", "yaw"}};
        auto const of = equation.find(name.substr(0, mark));
        return of == equation.end() ? places{} : places{{of->second}, {}, {}};
    }
    auto const fault = fault_in(name);
    auto const group = instrument_of(name);
    if (fault || !group.empty()) {
        places at;
        for (std::size_t const k : fault ? fault->channels() : channels_of(group))
            at.sensors.insert(std::string{channel_names[k]});
        return at;
    }
    auto const found = table.find(name);
    return found == table.end() ? places{} : found->second;
}

places places_of(std::set<std::string> const& effects) {
    places all;
    for (auto const& e : effects) {
        auto const p = places_of(e);
        all.equations.insert(p.equations.begin(), p.equations.end());
        all.sensors.insert(p.sensors.begin(), p.sensors.end());
        all.inputs.insert(p.inputs.begin(), p.inputs.end());
    }
    return all;
}

bool holds(places const& all, std::string const& kind, std::string const& name) {
    if (kind == "equation") return all.equations.contains(name);
    if (kind == "input") return all.inputs.contains(name);
    if (kind != "sensor") return false;
    if (name == "position") return all.sensors.contains("x") || all.sensors.contains("y");
    return all.sensors.contains(name);
}

bool holds_instrument(places const& all, std::string const& kind, std::string const& name) {
    bool const position = kind == "sensor" && (name == "x" || name == "y");
    return holds(all, kind, position ? "position" : name);
}

bool touches(places const& all, std::string const& equation, std::set<std::string> const& sensors) {
    return holds(all, "equation", equation) ||
           std::any_of(sensors.begin(), sensors.end(),
                       [&](std::string const& s) { return holds(all, "sensor", s); });
}

} // namespace withheld
