// SPDX-License-Identifier: MIT
// Robots in MuJoCo whose model lacks something, and what a diagnosis says of them:
//     sivid_simulator_cases draw --count N --seed S --out DIR     models, data sets, labels.json
//     sivid_simulator_cases score --out DIR                       of
//     DIR/results/CASE/diagnosis.json
// The program shares no code with sivid. The script `run` does all of it.
#include "records.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace {

namespace fs = std::filesystem;
using namespace simulator;
using nlohmann::json;

std::string exact(double x) {
    std::ostringstream out;
    out.precision(17);
    out << x;
    return out.str();
}

void write(fs::path const& file, std::string const& text) {
    fs::create_directories(file.parent_path());
    std::ofstream out{file};
    if (!(out << text).flush()) throw std::runtime_error("cannot write " + file.string());
}

/// One row a time; with the bounds of channels in columns of their own.
std::string table(std::vector<std::string> const& names, values const& times,
                  std::vector<values> const& rows, values const& bounds) {
    std::string text = "t";
    for (auto const& n : names) text += "," + n + (bounds.empty() ? "" : "," + n + "_err");
    for (std::size_t k = 0; k < times.size(); ++k) {
        text += "\n" + exact(std::round(times[k] * 1e4) / 1e4);
        for (std::size_t i = 0; i < names.size(); ++i)
            text += "," + exact(rows[k][i]) + (bounds.empty() ? "" : "," + exact(bounds[i]));
    }
    return text + "\n";
}

/// Writes a case: three experiments to fit, one that is held out.
void write_case(drawn_case const& c, std::mt19937_64& random, fs::path const& folder) {
    write(folder / "model.toml", c.robot.model);
    std::string scenarios;
    for (std::string const name : {"one", "two", "held"}) {
        double const duration = 3;
        auto const r = simulate(c, random, duration);
        write(folder / "data" / (name + ".inputs.csv"),
              table(c.robot.inputs, r.times, r.commands, {}));
        write(folder / "data" / (name + ".measurements.csv"),
              table(c.robot.channels, r.times, r.readings, r.bounds));
        std::string initial;
        for (auto const& s : c.robot.states) {
            std::string const at = initial.empty() ? exact(r.start) : "0";
            initial += (initial.empty() ? "\"" : ", \"") + s + "\": [" + at + ", " + at + "]";
        }
        scenarios += std::string(scenarios.empty() ? "" : ",\n    ") + R"({"name": ")" + name +
                     R"(", "role": ")" + (name == "held" ? "holdout" : "fit") +
                     R"(", "duration": )" + exact(duration) + R"(, "inputs": ")" + name +
                     R"(.inputs.csv", "interpolation": "hold", "measurements": ")" + name +
                     R"(.measurements.csv", "initial": {)" + initial + "}}";
    }
    write(folder / "data" / "dataset.json",
          R"({"format": "sivid-dataset-1", "id": ")" + c.id + R"(", "model": ")" + c.robot.name +
              R"(", "parameters": {)" + c.robot.parameters +
              R"(}, "max_outlier_fraction": 0, "scenarios": [)" + scenarios + "]}\n");
}

/// Every machine in turn, and of each one case in so many with nothing withheld.
void draw(std::size_t count, unsigned seed, fs::path const& out) {
    machine const robots[] = {lever(), rover(), arm(), turning_arm()};
    json labels = json::array();
    for (std::size_t k = 0; k < count; ++k) {
        std::mt19937_64 random{seed + 1000003 * k};
        drawn_case c{"c" + std::to_string(100 + k), robots[k % std::size(robots)], {}, {}};
        c.constants = c.robot.draw(random);
        std::size_t const kind = k / std::size(robots) % (c.robot.kinds.size() + 1);
        if (kind < c.robot.kinds.size()) {
            auto const& drawn = c.robot.kinds[kind];
            double const size = uniform(random, drawn.lower, drawn.upper);
            c.truth = {drawn.name, std::round(size * 2000) / 2000, drawn.in_catalogue, drawn.by,
                       drawn.where};
        }
        write_case(c, random, out / "cases" / c.id);
        json constants;
        for (std::size_t i = 0; i < c.constants.size(); ++i)
            constants[c.robot.constants[i]] = c.constants[i];
        labels.push_back({{"id", c.id},
                          {"robot", c.robot.name},
                          {"constants", constants},
                          {"withheld", c.truth.name},
                          {"size", c.truth.size},
                          {"in_catalogue", c.truth.in_catalogue}});
    }
    write(out / "labels.json", labels.dump(1));
}

/// What one diagnosis is worth.
struct judgement {
    std::string verdict = "no diagnosis", said;
    std::vector<std::string> false_proofs;
    std::size_t proofs = 0;
    std::optional<double> size_left; ///< width of its proved range over the size
    std::optional<bool> predicted;   ///< held-out data by the fits that explain, within 1.1
};

class judge {
public:
    judge(json const& label, json const& d)
        : d_(d), name_(label["withheld"]), size_(label["size"]) {
        bool const withheld = !name_.empty(), known = label["in_catalogue"];
        auto const& answer = d["answer"];
        std::string const kind = answer["kind"], gap = d["gap"]["verdict"];
        std::vector<std::string> const effects = answer["effects"];
        for (auto const& e : effects) j_.said += (j_.said.empty() ? "" : "+") + e;
        if (j_.said.empty()) j_.said = gap == "none" ? "no gap" : kind;
        if (!withheld) proof(gap != "certified", "a gap where there is none");
        if (!withheld) proof(lower(d["gap"]["inflation"]) <= 1, "an inflation where there is none");
        if (!withheld || (known && effects == std::vector{name_})) constants(label["constants"]);
        bool const explains = causes(known && withheld);
        bool const named = std::find(effects.begin(), effects.end(), name_) != effects.end();
        if (!withheld)
            j_.verdict = gap == "none" ? "right" : gap == "undecided" ? "open" : "wrong";
        else if (gap == "none")
            j_.verdict = "absorbed";
        else if (named || explains)
            j_.verdict = "right";
        else if (!known)
            j_.verdict = effects.empty() ? "right" : "ambiguous";
        else
            j_.verdict = kind == "open" || gap == "undecided" ? "open" : "wrong";
        if (j_.verdict == "right" && !named && withheld && known) j_.verdict = "ambiguous";
    }
    [[nodiscard]] judgement const& result() const { return j_; }

private:
    static double lower(json const& range) {
        return range.is_array() && range[0].is_number() ? range[0].get<double>() : 0;
    }
    static double upper(json const& range) {
        return range.is_array() && range[1].is_number() ? range[1].get<double>() : INFINITY;
    }
    static bool holds(json const& range, double x) {
        double const margin = 1e-9 * std::abs(x);
        return !range.is_array() || (lower_or(range) <= x + margin && upper(range) >= x - margin);
    }
    static double lower_or(json const& range) {
        return range[0].is_number() ? range[0].get<double>() : -INFINITY;
    }
    void proof(bool right, std::string const& about) {
        ++j_.proofs;
        if (!right) j_.false_proofs.push_back(about);
    }
    void constants(json const& truth) {
        for (auto const& [name, value] : d_["answer"]["constants"].items())
            if (truth.contains(name) && value["hull"].is_array())
                proof(holds(value["hull"], truth[name]), "range of " + name);
    }
    /// Every cause that has the truth in it can explain the data; whether the truth alone is proved
    /// to.
    bool causes(bool judged) {
        bool explains = false;
        for (auto const& c : d_["causes"]) {
            std::vector<std::string> const effects = c["effects"];
            if (!judged || std::find(effects.begin(), effects.end(), name_) == effects.end())
                continue;
            proof(c["verdict"] != "excluded", "excluded: the truth");
            proof(lower(c["inflation"]) <= 1, "inflation with the truth");
            if (effects.size() > 1) continue;
            explains = c["verdict"] == "explains";
            for (auto const& [name, hull] : c["parameters"].items()) {
                if (!hull.is_array() || !name.starts_with(name_ + ".")) continue;
                proof(holds(hull, size_), "range of " + name);
                j_.size_left = (upper(hull) - lower_or(hull)) / size_;
            }
            if (!c.contains("holdout") || c["holdout"].is_null()) continue;
            auto const& all = c["holdout"]["over_fits_after"];
            proof(lower(all) <= 1, "held-out data by the truth");
            if (explains) j_.predicted = upper(c["holdout"]["inflation_after"]) <= 1.1;
        }
        return explains;
    }

    json const& d_;
    std::string name_;
    double size_;
    judgement j_;
};

int score(fs::path const& out) {
    auto const labels = json::parse(std::ifstream{out / "labels.json"});
    std::map<std::string, std::size_t> count;
    std::size_t proofs = 0, false_proofs = 0, predicted = 0, asked = 0;
    std::printf("%-6s%-13s%-18s%-11s%-12s%s\n", "case", "robot", "withheld", "size", "verdict",
                "answer");
    for (auto const& label : labels) {
        std::string const id = label["id"];
        std::ifstream file{out / "results" / id / "diagnosis.json"};
        judgement j;
        if (file) j = judge(label, json::parse(file)).result();
        std::string const name = label["withheld"];
        std::printf("%-6s%-13s%-18s%-11.4g%-12s%s", id.c_str(),
                    label["robot"].get<std::string>().c_str(),
                    name.empty() ? "nothing" : name.c_str(), label["size"].get<double>(),
                    j.verdict.c_str(), j.said.c_str());
        if (j.size_left) std::printf(", size within %.2g %%", 100 * *j.size_left);
        if (j.predicted) std::printf(", held out %s", *j.predicted ? "predicted" : "not predicted");
        std::printf("\n");
        for (auto const& f : j.false_proofs) std::printf("      FALSE: %s\n", f.c_str());
        ++count[j.verdict];
        proofs += j.proofs;
        false_proofs += j.false_proofs.size();
        asked += j.predicted.has_value();
        predicted += j.predicted.value_or(false);
    }
    for (auto const& [verdict, n] : count) std::printf("%zu %s, ", n, verdict.c_str());
    std::printf("of %zu; held-out records predicted: %zu of %zu; false proofs: %zu of %zu\n",
                labels.size(), predicted, asked, false_proofs, proofs);
    return false_proofs > 0;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app{"Robots in MuJoCo whose model lacks something"};
    app.require_subcommand(1);
    std::size_t count = 88;
    unsigned seed = 1;
    std::string out;
    auto* const drawing = app.add_subcommand("draw", "models, data sets and labels");
    drawing->add_option("--count", count);
    drawing->add_option("--seed", seed);
    auto* const scoring = app.add_subcommand("score", "of what diagnoses say");
    for (auto* c : {drawing, scoring}) c->add_option("--out", out)->required();
    CLI11_PARSE(app, argc, argv);
    try {
        if (drawing->parsed()) draw(count, seed, out);
        return scoring->parsed() ? score(out) : 0;
    } catch (std::exception const& e) {
        std::cerr << "sivid_simulator_cases: " << e.what() << '\n';
        return 2;
    }
}
