// SPDX-License-Identifier: MIT
#include "campaign_files.hpp"
#include "catalogue.hpp"
#include "fit.hpp"
#include "measure.hpp"
#include "recorded.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace withheld {

namespace {

namespace fs = std::filesystem;

void write_file(fs::path const& path, std::string const& text) {
    std::ofstream file{path, std::ios::binary};
    file << text;
    if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

std::string interval_text(range r) {
    return '[' + six_digits(r.lo) + ", " + six_digits(r.hi) + ']';
}

std::string inputs_text(scenario const& s) {
    std::string text = "t,W,delta\n";
    for (std::size_t i = 0; i < s.motor.t.size(); ++i) {
        bool const ends_hold = s.held && i % 2 == 1 && i + 1 < s.motor.t.size();
        if (ends_hold) continue;
        text += decimal_text(s.motor.t[i]) + ',' + decimal_text(s.motor.value[i]) + ',' +
                decimal_text(s.rudder.value[i]) + '\n';
    }
    return text;
}

std::string measurements_text(campaign const& c, measured_scenario const& s) {
    std::string text = "t";
    for (std::size_t const k : c.channels_measured) {
        std::string const name{channel_names[k]};
        text += ',' + name + ',' + name + "_err";
    }
    for (std::size_t i = 0; i < s.value.size(); ++i) {
        text += '\n' + decimal_text(s.plan.sample_times[i]);
        for (std::size_t const k : c.channels_measured)
            text += ',' + decimal_text(s.value[i][k]) + ',' + decimal_text(error_bound[k]);
    }
    return text + '\n';
}

} // namespace

std::string scenario_text(scenario const& s) {
    std::string text =
        R"(    {"name": ")" + s.name + R"(", "role": ")" + (s.holdout ? "holdout" : "fit") +
        R"(", "duration": )" + decimal_text(s.duration) + R"(, "inputs": ")" + s.name +
        R"(.inputs.csv", "interpolation": ")" + (s.held ? "hold" : "linear") +
        R"(", "measurements": ")" + s.name + ".measurements.csv\",\n     \"initial\": {";
    for (std::size_t i = 0; i < channel_count; ++i)
        text += (i == 0 ? "\"" : ", \"") + std::string{channel_names[i]} +
                "\": " + interval_text(s.initial[i]);
    return text + "}}";
}

namespace {

std::string dataset_text(campaign const& c) {
    std::string text = "{\n  \"format\": \"sivid-dataset-1\",\n  \"id\": \"" + c.id +
                       "\",\n  \"model\": \"hovercraft\",\n  \"parameters\": {";
    char const* separator = "\n";
    for (auto const& u : c.unknown) {
        text += separator;
        text += "    \"" + u.name + R"(": {"prior": )" + interval_text(u.prior) + R"(, "unit": ")" +
                u.unit + "\"}";
        separator = ",\n";
    }
    text += "\n  },\n  \"max_outlier_fraction\": " + decimal_text(c.outlier_fraction) +
            ",\n  \"scenarios\": [";
    separator = "\n";
    for (auto const& s : c.scenarios) {
        text += separator + scenario_text(s.plan);
        separator = ",\n";
    }
    return text + "\n  ]\n}\n";
}

std::string true_starts(campaign const& c) {
    std::string text;
    for (auto const& s : c.scenarios) {
        text += (text.empty() ? "" : " ") + s.plan.name + '(';
        for (std::size_t i = 0; i < channel_count; ++i)
            text += (i == 0 ? "" : ",") + decimal_text(s.initial[i]);
        text += ')';
    }
    return text;
}

std::string true_gusts(campaign const& c) {
    std::string text;
    for (auto const& s : c.scenarios)
        for (auto const& g : s.gusts)
            text += (text.empty() ? "" : " ") + s.plan.name + '(' + six_digits(g.begin) + ',' +
                    six_digits(g.length) + ',' + six_digits(g.force) + ')';
    return text.empty() ? "-" : text;
}

/// When effects begin, or end, where that is not `usual`.
std::string true_times(campaign const& c, double episode::*time, double usual) {
    std::string text;
    for (auto const& s : c.scenarios) {
        double const t = s.acting.*time;
        if (t == usual) continue;
        text += (text.empty() ? "" : " ") + s.plan.name + '=' +
                (std::isinf(t) ? "inf" : decimal_text(t));
    }
    return text.empty() ? "-" : text;
}

/// What is attained is held against what is proved: no digit of it may be lost.
std::string all_digits(double x) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", x);
    return text;
}

/// The data of one scenario of the fit, or of one channel in all of them.
recording restricted(recording const& data, std::string const& scenario, std::size_t channel) {
    recording part = data;
    std::erase_if(part.scenarios, [&](recorded_scenario const& s) {
        return s.plan.holdout || (!scenario.empty() && s.plan.name != scenario);
    });
    for (auto& s : part.scenarios) {
        if (channel < channel_count)
            std::erase_if(s.samples, [&](sample const& m) { return m.channel != channel; });
        s.budget = outlier_budget(data.outlier_fraction, s.samples.size());
    }
    return part;
}

struct best_fit {
    double inflation = 0;
    std::vector<std::pair<std::string, double>> values;
};

/// The least inflation of the model without effects that a fit finds; `closer` takes several times
/// as long.
best_fit fit_without_effects(recording const& data, bool closer) {
    fit_problem const problem{data, {}};
    auto result = fit(problem, {}, {});
    double const inflation = closer ? problem.tighten(result.x) : result.inflation;
    return {inflation, problem.values(result.x)};
}

/// For every scenario and every channel alone: what a fit finds, to it or to all of the data.
std::string best_of_parts(campaign const& c, recording const& data, best_fit const& whole) {
    std::string text;
    auto const add = [&](std::string const& name, recording const& part, bool closer) {
        fit_problem const problem{part, {}};
        double const best = std::min(fit_without_effects(part, closer).inflation,
                                     problem.inflation(problem.start(whole.values)));
        text += (text.empty() ? "" : " ") + name + '=' + all_digits(best);
    };
    for (auto const& s : c.scenarios)
        if (!s.plan.holdout) add(s.plan.name, restricted(data, s.plan.name, channel_count), true);
    for (std::size_t const k : c.channels_measured)
        add(std::string{channel_names[k]}, restricted(data, "", k), false);
    return text;
}

} // namespace

void write_tables(campaign const& c, measured_scenario const& s, fs::path const& folder) {
    write_file(folder / (s.plan.name + ".inputs.csv"), inputs_text(s.plan));
    write_file(folder / (s.plan.name + ".measurements.csv"), measurements_text(c, s));
}

void write_dataset(campaign const& c, fs::path const& folder) {
    fs::create_directories(folder);
    write_file(folder / "dataset.json", dataset_text(c));
    for (auto const& s : c.scenarios) write_tables(c, s, folder);
}

std::string labels_header() {
    return "case\tfamily\teffects\tparams\tnoise\toutliers\tstarts\tgusts\tfit_base\tfit_true"
           "\tholdout_base\tholdout_true\tfit_base_best\tonsets\tbest_fit\tbest_of_parts\tends";
}

std::string label_of(campaign const& c, fs::path const& folder) {
    std::ostringstream line;
    line << c.id << '\t' << family_names[static_cast<std::size_t>(c.kind)] << '\t' << c.effects_text
         << '\t';
    char const* separator = "";
    for (auto const& u : c.unknown) {
        line << separator << u.name << '=' << six_digits(c.true_constants.*constant_named(u.name));
        separator = " ";
    }
    std::size_t outliers = 0;
    for (auto const& s : c.scenarios) outliers += s.outliers;
    line << '\t' << c.noise << '\t' << outliers << '\t' << true_starts(c) << '\t' << true_gusts(c);
    for (part const which : {part::fit, part::holdout})
        for (bool const with : {false, true})
            line << '\t' << all_digits(inflation_at_truth(c, with, which));
    auto const data = read_recording(folder);
    auto const best = fit_without_effects(data, true);
    line << '\t' << all_digits(best.inflation) << '\t' << true_times(c, &episode::from, 0) << '\t';
    separator = "";
    for (auto const& [name, value] : best.values) {
        line << separator << name << '=' << all_digits(value);
        separator = " ";
    }
    line << '\t' << best_of_parts(c, data, best) << '\t' << true_times(c, &episode::to, for_ever);
    return line.str();
}

} // namespace withheld
