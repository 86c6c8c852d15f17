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
    static constexpr std::array<std::string_view, 6> heads{"lagging", "late",  "drift",
                                                           "askew",   "lever", "bounds"};
    auto const at = name.find('_');
    if (at == std::string_view::npos) return {};
    bool const known = std::find(heads.begin(), heads.end(), head_of(name)) != heads.end();
    std::string group{name.substr(at + 1)};
    return known && !channels_of(group).empty() ? group : std::string{};
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
    if (group.empty() || head == "bounds") return false;
    for (std::size_t const k : channels_of(group)) {
        if (head == "lagging") all.lag[k] = values.at(0);
        if (head == "late") all.late[k] = values.at(0);
        if (head == "drift") all.drift[k] = values.at(0);
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

} // namespace withheld
