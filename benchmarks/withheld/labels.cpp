// SPDX-License-Identifier: MIT
#include "labels.hpp"
#include "catalogue.hpp"
#include "instruments.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace withheld {

namespace {

std::vector<std::string> split(std::string const& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream in{text};
    for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
    return parts;
}

/// "name(1,2)" as a name and numbers; what is no number is left out ("gust(lateral)").
std::pair<std::string, std::vector<double>> call(std::string const& text) {
    auto const open = text.find('('), close = text.rfind(')');
    if (open == std::string::npos || close == std::string::npos) return {text, {}};
    std::vector<double> numbers;
    for (auto const& part : split(text.substr(open + 1, close - open - 1), ',')) {
        char* end = nullptr;
        double const value = std::strtod(part.c_str(), &end);
        if (end != part.c_str()) numbers.push_back(value);
    }
    return {text.substr(0, open), numbers};
}

label parsed(std::vector<std::string> const& header, std::vector<std::string> const& cells) {
    label l;
    l.id = cells[0];
    l.family = cells[1];
    l.effects_text = cells[2];
    if (cells[2] != "none")
        for (auto part : split(cells[2], '+')) {
            std::erase(part, ' ');
            l.effects.push_back(call(part));
        }
    for (auto const& part : split(cells[3] == "not kept" ? "" : cells[3], ' ')) {
        auto const equals = part.find('=');
        if (equals == std::string::npos) throw std::runtime_error("no value in " + part);
        l.constants_true[part.substr(0, equals)] = std::stod(part.substr(equals + 1));
    }
    for (std::size_t i = 4; i < cells.size() && i < header.size(); ++i)
        l.more[header[i]] = cells[i];
    return l;
}

/// Those of the column of starts, "S1(0,...) S2(...) H1(...)", that are not held out.
std::vector<std::string> fit_scenarios(std::map<std::string, std::string> const& columns) {
    std::vector<std::string> all;
    auto const place = columns.find("starts");
    if (place == columns.end()) return all;
    for (auto const& part : split(place->second, ' '))
        if (!part.starts_with('H')) all.push_back(part.substr(0, part.find('(')));
    return all;
}

} // namespace

std::set<std::string> label::names() const {
    std::set<std::string> all;
    for (auto const& e : effects) all.insert(e.first);
    return all;
}

std::optional<double> label::number(std::string const& column) const {
    auto const place = more.find(column);
    if (place == more.end()) return std::nullopt;
    char* end = nullptr;
    double const value = std::strtod(place->second.c_str(), &end);
    return end == place->second.c_str() ? std::nullopt : std::optional{value};
}

std::map<std::string, double> label::values(std::string const& column) const {
    std::map<std::string, double> all;
    auto const place = more.find(column);
    if (place == more.end()) return all;
    for (auto const& part : split(place->second, ' '))
        if (auto const equals = part.find('='); equals != std::string::npos)
            all[part.substr(0, equals)] = std::stod(part.substr(equals + 1));
    return all;
}

std::optional<std::vector<std::string>> label::held_by() const {
    std::vector<std::string> result;
    for (auto const& [name, values] : effects) {
        auto const holds = [&values = values](effect const* known) {
            if (known == nullptr) return false;
            for (std::size_t i = 0; i < values.size() && i < known->parameters.size(); ++i)
                if (values[i] < known->parameters[i].lo || values[i] > known->parameters[i].hi)
                    return false;
            return true;
        };
        result.push_back(holds(effect_named(name)) ? name : name + "_wider");
        if (!holds(effect_named(result.back()))) return std::nullopt;
    }
    if (!partial()) return result;
    std::string acting; // where it does, it does all the time
    bool everywhere = true;
    for (auto const& scenario : fit_scenarios(more)) {
        auto const when = true_episode(*this, scenario);
        if (when.begins_later() || when.ends()) return std::nullopt;
        everywhere = everywhere && when.always();
        if (when.always()) acting += (acting.empty() ? "@" : "+") + scenario;
    }
    if (acting.empty()) return std::nullopt;
    for (auto& name : result) name += everywhere ? "" : acting;
    return result;
}

bool label::attainable() const {
    auto const names = held_by();
    return names && std::none_of(names->begin(), names->end(),
                                 [](auto const& n) { return n != plain_name(n); });
}

std::vector<label> read_labels(std::filesystem::path const& path) {
    std::ifstream file{path};
    if (!file) throw std::runtime_error("cannot read " + path.string());
    std::string line;
    std::getline(file, line);
    auto const header = split(line, '\t');
    if (header.size() < 4 || header[0] != "case" || header[3] != "params")
        throw std::runtime_error(path.string() + ": columns case, family, effects, params wanted");
    std::vector<label> all;
    while (std::getline(file, line)) {
        if (line.empty()) continue;
        auto const cells = split(line, '\t');
        if (cells.size() < 4) throw std::runtime_error(path.string() + ": short line: " + line);
        all.push_back(parsed(header, cells));
    }
    return all;
}

world world_of(label const& l, constants const& fixed) {
    world w;
    w.c = fixed;
    for (auto const& [name, value] : l.constants_true) {
        auto const member = constant_named(name);
        if (member == nullptr) throw std::runtime_error("unknown constant " + name);
        w.c.*member = value;
    }
    for (auto const& [name, values] : l.effects) {
        if (auto const* known = effect_named(name)) {
            for (std::size_t i = 0; i < known->parameters.size(); ++i)
                w.e.*known->parameters[i].member = values.at(i);
        } else if (name == "tether") {
            w.f.tether_stiffness = values.at(0);
            w.f.tether_slack = values.at(1);
        } else if (name == "servo") {
            w.f.servo_frequency = values.at(0);
            w.f.servo_damping = values.at(1);
        } else if (name == "swell") {
            w.f.swell_force = values.at(0);
            w.f.swell_frequency = values.at(1);
        } else if (name == "cubic_drag") {
            w.f.cubic_drag = values.at(0);
        } else if (name == "weathervane") {
            w.f.weathervane = values.at(0);
        } else if (name == "cross_coupling") {
            w.f.cross_coupling = values.at(0);
        } else if (!set_instrument(w.instruments, name, values) && name != "gust" &&
                   !is_noise(name)) {
            throw std::runtime_error("unknown effect " + name);
        }
    }
    return w;
}

std::optional<channels> true_start(label const& l, std::string const& scenario) {
    auto const place = l.more.find("starts");
    if (place == l.more.end()) return std::nullopt;
    for (auto const& part : split(place->second, ' ')) {
        auto const [name, values] = call(part);
        if (name != scenario || values.size() != channel_count) continue;
        channels start{};
        std::copy(values.begin(), values.end(), start.begin());
        return start;
    }
    return std::nullopt;
}

std::vector<gust_pulse> true_gusts(label const& l, std::string const& scenario) {
    std::vector<gust_pulse> all;
    auto const place = l.more.find("gusts");
    if (place == l.more.end()) return all;
    for (auto const& part : split(place->second, ' ')) {
        auto const [name, values] = call(part);
        if (name == scenario && values.size() == 3)
            all.push_back({values[0], values[1], values[2]});
    }
    return all;
}

episode true_episode(label const& l, std::string const& scenario) {
    auto const time = [&](char const* column, double usual) {
        auto const all = l.values(column);
        auto const place = all.find(scenario);
        return place == all.end() ? usual : place->second;
    };
    return {time("onsets", 0), time("ends", for_ever)};
}

world true_world(label const& l, constants const& fixed, scenario const& plan) {
    world w = world_of(l, fixed);
    w.motor = plan.motor;
    w.rudder = plan.rudder;
    w.gusts = true_gusts(l, plan.name);
    act_within(w, true_episode(l, plan.name));
    return w;
}

} // namespace withheld
