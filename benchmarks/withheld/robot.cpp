// SPDX-License-Identifier: MIT
// Plays the robot: makes the runs of scenarios as the craft that a label describes, adds what its
// sensors show to a data set, and says nothing of what is withheld.
#include "labels.hpp"
#include "runs.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

int main(int argc, char** argv) {
    using namespace withheld;
    CLI::App app{"Makes runs of a hovercraft whose effect is withheld, and records them."};
    std::string labels, name, dataset, out, id;
    std::vector<std::string> scenarios;
    std::uint64_t seed = 1;
    double period = 0.1;
    app.add_option("--labels", labels, "file that says what the craft is")->required();
    app.add_option("--case", name, "its case; not given: the first");
    app.add_option("--scenario", scenarios, "JSON files of inputs and starts")->required();
    app.add_option("--dataset", dataset, "records to which these are added; not given: a new set");
    app.add_option("--out", out, "folder of the data set")->required();
    app.add_option("--id", id, "name of the data set");
    app.add_option("--period", period, "of the measurements [s]")->check(CLI::PositiveNumber);
    app.add_option("--seed", seed, "of the noise");
    CLI11_PARSE(app, argc, argv);
    try {
        auto const all = read_labels(labels);
        auto const truth = std::find_if(all.begin(), all.end(), [&](label const& l) {
            return name.empty() || l.id == name;
        });
        if (truth == all.end()) throw std::invalid_argument(labels + " has no case " + name);
        std::vector<measured_scenario> runs;
        random_source random{seed};
        for (auto const& file : scenarios)
            runs.push_back(performed(*truth, read_plan(file, period), random));
        write_records(dataset, out, id, runs);
    } catch (std::invalid_argument const& e) {
        std::cerr << e.what() << '\n';
        return 2;
    } catch (std::exception const& e) {
        std::cerr << e.what() << '\n';
        return 70;
    }
    return 0;
}
