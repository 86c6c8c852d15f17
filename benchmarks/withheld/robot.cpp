// SPDX-License-Identifier: MIT
// Plays the robot: makes runs as the craft that a label describes, of scenarios or under a control
// law, and adds what its sensors show to a data set. It says nothing of what is withheld.
#include "formula_text.hpp"
#include "runs.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace withheld;

struct options {
    std::string labels, which, dataset, out, id, law, at_end, always;
    std::vector<std::string> scenarios, gains;
    double period = 0.1, sampled = 0.02, delay = 0;
    std::uint64_t seed = 1;
    bool holdout = false;
};

std::map<std::string, double> gains_of(options const& o) {
    std::map<std::string, double> all;
    for (auto const& text : o.gains) {
        auto const equals = text.find('=');
        if (equals == std::string::npos)
            throw std::invalid_argument("--gain " + text + ": NAME=VALUE is wanted");
        all[text.substr(0, equals)] = std::stod(text.substr(equals + 1));
    }
    return all;
}

control_law law_of(options const& o, scenario const& plan) {
    return [commands = commands_in(o.law), gains = gains_of(o), plan](double t,
                                                                      channels const& shown) {
        auto const value = [&](std::string const& name) {
            if (name == "t") return t;
            for (std::size_t k = 0; k < channel_count; ++k)
                if (channel_names[k] == name) return shown[k];
            auto const gain = gains.find(name);
            if (gain == gains.end()) throw std::invalid_argument("the law needs --gain " + name);
            return gain->second;
        };
        auto const told = [&](char const* input, polyline const& otherwise) {
            auto const own = commands.find(input);
            return own == commands.end() ? otherwise.at(t) : value_of(own->second, value);
        };
        return command{told("W", plan.motor), told("delta", plan.rudder)};
    };
}

/// The least margin of a formula over the run, or that at its end; of the truth, not of sensors.
double margin_of(std::string const& formula, label const& truth, measured_scenario const& run,
                 bool whole) {
    auto times = run.plan.sample_times;
    if (whole)
        for (int k = 0; k * 1e-3 < run.plan.duration; ++k) times.push_back(k * 1e-3);
    times.push_back(run.plan.duration);
    std::sort(times.begin(), times.end());
    auto const path = true_channels(truth, run, times);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = whole ? 0 : times.size() - 1; i < times.size(); ++i) {
        least = std::min(least, value_of(formula, [&](std::string const& name) {
                             if (name == "t") return times[i];
                             if (name == "W") return run.plan.motor.at(times[i]);
                             if (name == "delta") return run.plan.rudder.at(times[i]);
                             for (std::size_t k = 0; k < channel_count; ++k)
                                 if (channel_names[k] == name) return path[i][k];
                             throw std::invalid_argument("nothing is called " + name);
                         }));
    }
    return least;
}

/// Says whether the truth obeys. @returns whether it does
bool obeys(options const& o, label const& truth, measured_scenario const& run) {
    bool all = true;
    for (auto const& [formula, whole] : {std::pair{o.at_end, false}, {o.always, true}}) {
        if (formula.empty()) continue;
        double const margin = margin_of(formula, truth, run, whole);
        std::printf("%s: %s %s, by %.4g\n", run.plan.name.c_str(), formula.c_str(),
                    margin > 0 ? (whole ? "always" : "at the end") : "is violated", margin);
        all = all && margin > 0;
    }
    return all;
}

int play(options const& o) {
    auto const all = read_labels(o.labels);
    auto const truth = std::find_if(
        all.begin(), all.end(), [&](label const& l) { return o.which.empty() || l.id == o.which; });
    if (truth == all.end()) throw std::invalid_argument(o.labels + " has no case " + o.which);
    std::vector<measured_scenario> runs;
    random_source random{o.seed};
    bool good = true;
    for (auto const& file : o.scenarios) {
        auto plan = read_plan(file, o.period);
        plan.holdout = o.holdout;
        runs.push_back(o.law.empty()
                           ? performed(*truth, plan, random)
                           : performed(*truth, plan, law_of(o, plan), o.sampled, o.delay, random));
        good = obeys(o, *truth, runs.back()) && good;
    }
    if (!o.out.empty()) write_records(o.dataset, o.out, o.id, runs);
    return good ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app{"Makes runs of a hovercraft whose effect is withheld, and records them."};
    options o;
    app.add_option("--labels", o.labels, "file that says what the craft is")->required();
    app.add_option("--case", o.which, "its case; not given: the first");
    app.add_option("--scenario", o.scenarios, "JSON files of inputs and starts")->required();
    app.add_option("--dataset", o.dataset, "records to which these are added; not given: none");
    app.add_option("--out", o.out, "folder of the data set");
    app.add_option("--id", o.id, "name of the data set");
    app.add_option("--period", o.period, "of the measurements [s]")->check(CLI::PositiveNumber);
    app.add_option("--seed", o.seed, "of the noise");
    app.add_flag("--holdout", o.holdout, "the records are not for the fit");
    app.add_option("--law", o.law, "what commands inputs, such as \"delta = P * psi\"");
    app.add_option("--gain", o.gains, "of the law, such as P=2");
    app.add_option("--sampled", o.sampled, "between samples of the law [s]")
        ->check(CLI::PositiveNumber);
    app.add_option("--delay", o.delay, "from a sample to its command [s]")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--at-end", o.at_end, "what is to hold of the truth at the end");
    app.add_option("--always", o.always, "what is to hold of the truth at every millisecond");
    app.footer("Exit codes: 0 done, 1 what was to hold does not, 2 bad input, 70 cannot write.");
    CLI11_PARSE(app, argc, argv);
    try {
        return play(o);
    } catch (std::invalid_argument const& e) {
        std::cerr << e.what() << '\n';
        return 2;
    } catch (std::exception const& e) {
        std::cerr << e.what() << '\n';
        return 70;
    }
}
