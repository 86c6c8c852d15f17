// SPDX-License-Identifier: MIT
#include "runs.hpp"
#include "campaign_files.hpp"
#include "noise.hpp"
#include "simulate.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

namespace withheld {

namespace {

namespace fs = std::filesystem;
using json = nlohmann::json;

json read_json(fs::path const& file) {
    std::ifstream in{file};
    if (!in) throw std::invalid_argument("cannot read " + file.string());
    return json::parse(in);
}

polyline read_shape(json const& j, double duration) {
    auto const shape = j.at("shape").get<std::string>();
    if (shape == "samples")
        return {j.at("t").get<std::vector<double>>(), j.at("values").get<std::vector<double>>()};
    if (shape == "constant") {
        double const value = j.at("value").get<double>();
        return {{0, duration}, {value, value}};
    }
    if (shape != "sine") throw std::invalid_argument("runs know no shape " + shape);
    polyline line;
    auto const number = [&](char const* key) { return j.value(key, 0.0); };
    for (int k = 0; k <= std::lround(20 * duration); ++k) {
        double const angle = 2 * std::numbers::pi * number("frequency") * k / 20;
        line.t.push_back(six_decimals(k / 20.0));
        line.value.push_back(six_decimals(number("offset") +
                                          number("amplitude") * std::sin(angle + number("phase"))));
    }
    return line;
}

/// The times at which either has a knot: tables have one column of times.
void share_knots(scenario& s) {
    auto times = s.motor.t;
    times.insert(times.end(), s.rudder.t.begin(), s.rudder.t.end());
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    for (auto* line : {&s.motor, &s.rudder}) {
        polyline both{times, {}};
        for (double const t : times) both.value.push_back(six_decimals(line->at(t)));
        *line = std::move(both);
    }
}

channels start_of(scenario const& plan) {
    channels start{};
    for (std::size_t k = 0; k < channel_count; ++k) start[k] = plan.initial[k].middle();
    return start;
}

measured_scenario measured(label const& truth, scenario plan, random_source& random) {
    measured_scenario s;
    s.initial = start_of(plan);
    s.truth = readings(true_world(truth, {}, plan), s.initial, plan.sample_times, careful_step);
    s.plan = std::move(plan);
    add_uniform_noise(s, random);
    return s;
}

} // namespace

scenario read_plan(fs::path const& file, double period) {
    auto const j = read_json(file);
    scenario s;
    s.name = j.at("name").get<std::string>();
    s.duration = j.at("duration").get<double>();
    for (std::size_t k = 0; k < channel_count; ++k) {
        auto const& start = j.at("initial").at(std::string{channel_names[k]});
        s.initial[k] = start.is_array()
                           ? range{start.at(0).get<double>(), start.at(1).get<double>()}
                           : range{start.get<double>(), start.get<double>()};
    }
    s.motor = read_shape(j.at("inputs").at("W"), s.duration);
    s.rudder = read_shape(j.at("inputs").at("delta"), s.duration);
    share_knots(s);
    for (int k = 1; k * period <= s.duration * (1 + 1e-12); ++k)
        s.sample_times.push_back(six_decimals(k * period));
    return s;
}

measured_scenario performed(label const& truth, scenario plan, random_source& random) {
    return measured(truth, std::move(plan), random);
}

measured_scenario performed(label const& truth, scenario plan, control_law const& law,
                            double period, double delay, random_source& random) {
    auto const noisy = [&](channels shown) {
        for (std::size_t k = 0; k < channel_count; ++k)
            shown[k] += error_bound[k] * random.uniform(-1, 1);
        return shown;
    };
    constexpr double jump = 1e-9;
    auto const start = start_of(plan);
    plan.held = true;
    plan.motor = plan.rudder = {};
    auto const act = [&](double t, command const& c) {
        for (auto [line, value] : {std::pair{&plan.motor, c.motor}, {&plan.rudder, c.rudder}}) {
            if (!line->t.empty()) {
                line->t.push_back(t - jump);
                line->value.push_back(line->value.back());
            }
            line->t.push_back(t);
            line->value.push_back(six_decimals(value));
        }
    };
    for (int k = 0; k * period + delay < plan.duration; ++k) {
        double const t = k * period;
        // From the start anew each time: delays, lags and latencies need no memory of ours.
        auto const shown =
            k == 0 ? start : readings(true_world(truth, {}, plan), start, {t}, 2e-3).front();
        act(k == 0 ? 0.0 : six_decimals(t + delay), law(t, noisy(shown)));
    }
    for (auto* line : {&plan.motor, &plan.rudder}) {
        line->t.push_back(plan.duration);
        line->value.push_back(line->value.back());
    }
    return measured(truth, std::move(plan), random);
}

std::vector<channels> true_channels(label const& truth, measured_scenario const& run,
                                    std::vector<double> const& times) {
    std::vector<channels> all;
    for (auto const& s :
         states_at(true_world(truth, {}, run.plan), run.initial, times, careful_step)) {
        all.emplace_back();
        std::copy_n(s.begin(), channel_count, all.back().begin());
    }
    return all;
}

void write_records(fs::path const& dataset, fs::path const& out, std::string const& id,
                   std::vector<measured_scenario> const& runs) {
    fs::create_directories(out);
    campaign c;
    c.unknown = unknown_constants(family::single);
    c.channels_measured = {0, 1, 2, 3, 4, 5};
    if (dataset.empty()) {
        c.id = id.empty() ? "runs" : id;
        c.scenarios = runs;
        write_dataset(c, out);
        return;
    }
    auto j = nlohmann::ordered_json::parse(std::ifstream{dataset / "dataset.json"});
    if (!id.empty()) j["id"] = id;
    for (auto const& s : j.at("scenarios")) {
        for (auto const* table : {"inputs", "measurements"}) {
            auto const file = s.at(table).get<std::string>();
            if (!fs::exists(out / file) || !fs::equivalent(out / file, dataset / file))
                fs::copy_file(dataset / file, out / file, fs::copy_options::overwrite_existing);
        }
    }
    for (auto const& run : runs) {
        auto const taken = [&](auto const& s) { return s.at("name") == run.plan.name; };
        auto const& all = j.at("scenarios");
        if (std::any_of(all.begin(), all.end(), taken))
            throw std::invalid_argument("there is a record of " + run.plan.name + " already");
        write_tables(c, run, out);
        j["scenarios"].push_back(nlohmann::ordered_json::parse(scenario_text(run.plan)));
    }
    std::ofstream file{out / "dataset.json"};
    file << j.dump(2) << '\n';
    if (!file.flush()) throw std::runtime_error("cannot write " + out.string());
}

} // namespace withheld
