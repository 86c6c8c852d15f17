// SPDX-License-Identifier: MIT
#include "recorded.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace withheld {

namespace {

namespace fs = std::filesystem;
using json = nlohmann::json;

struct table {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;
};

std::vector<std::string> split(std::string const& line) {
    std::vector<std::string> cells(1);
    for (char const c : line) {
        if (c == ',')
            cells.emplace_back();
        else if (c != '\r')
            cells.back() += c;
    }
    return cells;
}

table read_table(fs::path const& path) {
    std::ifstream file{path};
    if (!file) throw std::runtime_error("cannot read " + path.string());
    table t;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#') continue;
        if (t.header.empty())
            t.header = split(line);
        else
            t.rows.push_back(split(line));
    }
    for (auto const& row : t.rows)
        if (row.size() != t.header.size())
            throw std::runtime_error("ragged row in " + path.string());
    return t;
}

std::size_t column(table const& t, std::string const& name) {
    auto const place = std::find(t.header.begin(), t.header.end(), name);
    if (place == t.header.end()) throw std::runtime_error("no column " + name);
    return static_cast<std::size_t>(place - t.header.begin());
}

range read_range(json const& j) { return {j.at(0).get<double>(), j.at(1).get<double>()}; }

void read_inputs(table const& t, scenario& s) {
    std::size_t const motor = column(t, "W"), rudder = column(t, "delta");
    for (auto const& row : t.rows) {
        double const time = std::stod(row[0]);
        s.motor.t.push_back(time);
        s.rudder.t.push_back(time);
        s.motor.value.push_back(std::stod(row[motor]));
        s.rudder.value.push_back(std::stod(row[rudder]));
    }
}

void read_measurements(table const& t, recorded_scenario& s) {
    for (std::size_t i = 0; i < t.rows.size(); ++i) {
        s.plan.sample_times.push_back(std::stod(t.rows[i][0]));
        for (std::size_t k = 0; k < channel_count; ++k) {
            std::string const name{channel_names[k]};
            if (std::find(t.header.begin(), t.header.end(), name) == t.header.end()) continue;
            auto const& cell = t.rows[i][column(t, name)];
            if (cell.empty()) continue;
            s.samples.push_back(
                {i, k, std::stod(cell), std::stod(t.rows[i][column(t, name + "_err")])});
        }
    }
}

recorded_scenario read_scenario(json const& j, fs::path const& folder, double fraction) {
    recorded_scenario s;
    s.plan.name = j.at("name").get<std::string>();
    s.plan.holdout = j.at("role").get<std::string>() == "holdout";
    s.plan.duration = j.at("duration").get<double>();
    if (j.at("interpolation") != "linear") throw std::runtime_error("inputs must be linear");
    for (std::size_t k = 0; k < channel_count; ++k)
        s.plan.initial[k] = read_range(j.at("initial").at(std::string{channel_names[k]}));
    read_inputs(read_table(folder / j.at("inputs").get<std::string>()), s.plan);
    read_measurements(read_table(folder / j.at("measurements").get<std::string>()), s);
    s.budget = outlier_budget(fraction, s.samples.size());
    return s;
}

} // namespace

recording read_recording(fs::path const& folder) {
    std::ifstream file{folder / "dataset.json"};
    if (!file) throw std::runtime_error("cannot read " + (folder / "dataset.json").string());
    json const j = json::parse(file);
    recording r;
    r.id = j.at("id").get<std::string>();
    r.outlier_fraction = j.at("max_outlier_fraction").get<double>();
    for (auto const& [name, about] : j.at("parameters").items()) {
        if (constant_named(name) == nullptr) throw std::runtime_error("unknown constant " + name);
        r.unknown.push_back({name, about.value("unit", ""), read_range(about.at("prior"))});
    }
    if (j.contains("fixed"))
        for (auto const& [name, value] : j.at("fixed").items())
            r.fixed.*constant_named(name) = value.get<double>();
    for (auto const& s : j.at("scenarios"))
        r.scenarios.push_back(read_scenario(s, folder, r.outlier_fraction));
    return r;
}

std::vector<double> misfits(recorded_scenario const& s, std::vector<channels> const& model,
                            channels const& modulus) {
    std::vector<double> all;
    all.reserve(s.samples.size());
    for (auto const& m : s.samples)
        all.push_back(std::abs(apart(m.value, model[m.time][m.channel], modulus[m.channel])) /
                      m.error);
    return all;
}

} // namespace withheld
