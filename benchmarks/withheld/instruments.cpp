// SPDX-License-Identifier: MIT
#include "instruments.hpp"
#include "catalogue.hpp"

#include <algorithm>
#include <array>

namespace withheld {

namespace {

std::string_view head_of(std::string_view name) { return name.substr(0, name.find('_')); }

} // namespace

std::vector<std::size_t> channels_of(std::string_view group) {
    if (group == "uv") return {0, 1};
    if (group == "xy") return {3, 4};
    for (std::size_t k = 0; k < channel_count; ++k)
        if (channel_names[k] == group) return {k};
    return {};
}

std::string instrument_of(std::string_view name) {
    static constexpr std::array<std::string_view, 11> heads{
        "lagging", "late",    "drift", "askew", "lever", "bounds",
        "jitter",  "growing", "slow",  "steps", "wraps"};
    auto const at = name.find('_');
    if (at == std::string_view::npos) return {};
    bool const known = std::find(heads.begin(), heads.end(), head_of(name)) != heads.end();
    std::string group{name.substr(at + 1)};
    return known && !channels_of(group).empty() ? group : std::string{};
}

bool is_noise(std::string_view name) {
    auto const head = head_of(name);
    return !instrument_of(name).empty() && (head == "bounds" || head == "jitter" ||
                                            head == "growing" || head == "slow" || head == "steps");
}

std::vector<std::string_view> const& askew_kinds() {
    static std::vector<std::string_view> const all{"askew_uv", "askew_xy"};
    return all;
}

// Late positions are in the catalogue.
std::vector<std::string_view> const& instrument_kinds() {
    static std::vector<std::string_view> const all{
        "lagging_uv", "lagging_r", "lagging_psi", "lagging_xy", "late_uv", "late_r",
        "late_psi",   "drift_r",   "drift_psi",   "drift_uv",   "lever_v", "lever_xy"};
    return all;
}

bool set_instrument(instrument_faults& all, std::string const& name,
                    std::vector<double> const& values) {
    auto const group = instrument_of(name);
    auto const head = head_of(name);
    if (group.empty() || is_noise(name)) return false;
    for (std::size_t const k : channels_of(group)) {
        if (head == "lagging") all.lag[k] = values.at(0);
        if (head == "late") all.late[k] = values.at(0);
        if (head == "drift") all.drift[k] = values.at(0);
        if (head == "wraps") all.modulus[k] = values.at(0);
    }
    if (name == "askew_uv") all.velocity_turn = values.at(0);
    if (name == "askew_xy") all.position_turn = values.at(0);
    if (name == "lever_v") all.velocity_arm = values.at(0);
    if (name == "lever_xy") {
        all.antenna_x = values.at(0);
        all.antenna_y = values.at(1);
    }
    return true;
}

std::vector<double> draw_instrument(std::string_view kind, random_source& random) {
    auto const either = [&](double small, double large) {
        return rounded(random.sign() * random.uniform(small, large));
    };
    auto const head = head_of(kind);
    if (head == "lagging") return {rounded(random.uniform(0.1, 0.4))};
    if (head == "late") return {rounded(random.uniform(0.06, 0.25))};
    if (head == "askew") return {either(0.02, 0.1)};
    if (head == "drift") return {either(0.02, 0.06)};
    if (kind == "lever_xy") return {either(0.1, 0.3), either(0.02, 0.15)};
    return {either(0.1, 0.3)};
}

std::vector<std::size_t> named_fault::channels() const {
    std::vector<std::size_t> result;
    for (auto const& name : in_brackets)
        for (std::size_t k = 0; k < channel_count; ++k)
            if (channel_names[k] == name) result.push_back(k);
    if (kind.ends_with("_arm") && result.size() == 3) result.pop_back(); // the state
    return result;
}

std::optional<named_fault> fault_in(std::string const& name) {
    auto const opens = name.find('('), closes = name.find(")~");
    if (!name.starts_with("sensor_") || opens == name.npos || closes == name.npos ||
        name.find('@') != name.npos)
        return std::nullopt;
    named_fault f{name.substr(0, opens), {}, {}};
    for (auto begin = opens + 1; begin <= closes;) {
        auto const end = std::min(name.find(':', begin), closes);
        f.in_brackets.push_back(name.substr(begin, end - begin));
        begin = end + 1;
    }
    auto const add = [&](std::string const& parameter) {
        f.parameters.push_back(name + '.' + parameter);
    };
    if (f.kind == "sensor_latency" || f.kind == "sensor_lag") add("tau");
    if (f.kind == "sensor_drift") {
        if (f.in_brackets.size() == 1) add("d");
        for (auto const& y : f.in_brackets)
            if (f.in_brackets.size() > 1) add("d_" + y);
    }
    if (f.kind == "sensor_rotation") add("a");
    if (f.kind == "sensor_wrap") add("T");
    if (f.kind.ends_with("_arm")) {
        add("a");
        add("b");
    }
    return f;
}

std::string drawn_name(std::string const& name) {
    static std::map<std::string, std::string> const heads{{"sensor_latency", "late_"},
                                                          {"sensor_lag", "lagging_"},
                                                          {"sensor_drift", "drift_"},
                                                          {"sensor_rotation", "askew_"},
                                                          {"sensor_wrap", "wraps_"}};
    auto const f = fault_in(name);
    if (!f) return name;
    auto const in = [&f](std::vector<std::string> const& those) { return f->in_brackets == those; };
    if (f->kind == "sensor_velocity_arm" && in({"u", "v", "r"})) return "lever_v";
    if (f->kind == "sensor_lever_arm" && in({"x", "y", "psi"})) return "lever_xy";
    auto const head = heads.find(f->kind);
    if (head == heads.end()) return name;
    std::string group;
    for (auto const& y : f->in_brackets) group += y;
    return channels_of(group).empty() ? name : head->second + group;
}

std::map<std::string, double> fault_values(named_fault const& f, std::vector<double> const& drawn) {
    std::map<std::string, double> result;
    for (std::size_t k = 0; k < f.parameters.size(); ++k) {
        bool const own = f.kind == "sensor_lever_arm" || k == 0 || f.kind == "sensor_drift";
        // What is turned one way sees the other way; an arm of velocities lies ahead.
        double const value = drawn.at(f.kind == "sensor_lever_arm" ? k : 0);
        result[f.parameters[k]] = !own ? 0 : f.kind == "sensor_rotation" ? -value : value;
    }
    return result;
}

bool set_fault(instrument_faults& all, named_fault const& f,
               std::function<std::optional<double>(std::string const&)> const& value) {
    std::vector<double> values;
    for (auto const& name : f.parameters) {
        auto const x = value(name);
        if (!x) return false;
        values.push_back(*x);
    }
    if (values.empty()) return false;
    auto const seen = f.channels();
    for (std::size_t n = 0; n < seen.size(); ++n) {
        if (f.kind == "sensor_latency") all.late[seen[n]] = values[0];
        if (f.kind == "sensor_lag") all.lag[seen[n]] = values[0];
        if (f.kind == "sensor_drift") all.drift[seen[n]] = values[n];
        if (f.kind == "sensor_wrap") all.modulus[seen[n]] = values[0];
    }
    bool const velocities = seen == std::vector<std::size_t>{0, 1};
    if (!velocities && seen != std::vector<std::size_t>{3, 4}) return seen.size() == 1;
    if (f.kind == "sensor_rotation")
        (velocities ? all.velocity_turn : all.position_turn) = -values[0];
    if (f.kind == "sensor_velocity_arm") {
        all.velocity_arm = values[0];
        all.velocity_side = values[1];
    }
    if (f.kind == "sensor_lever_arm") {
        all.antenna_x = values[0];
        all.antenna_y = values[1];
    }
    return true;
}

} // namespace withheld
