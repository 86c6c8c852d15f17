// SPDX-License-Identifier: MIT
// Opens the labels after the diagnosis and prints how far it was right. Ends with 1 when anything
// that was called proved is false or a file contradicts itself, so that a script cannot overlook
// it.
#include "summary.hpp"

#include <CLI/CLI.hpp>

#include <exception>
#include <fstream>
#include <iostream>
#include <string>

int main(int argc, char** argv) {
    using namespace withheld;
    CLI::App app{"Scores diagnoses against labels."};
    std::string labels, results, baseline, data, table;
    app.add_option("--labels", labels, "labels.tsv of the generator")->required();
    app.add_option("--results", results, "folder with <case>/diagnosis.json")->required();
    app.add_option("--baseline", baseline, "the same from sivid_withheld_baseline");
    app.add_option("--data", data, "the data sets: proved witnesses are simulated");
    app.add_option("--csv", table, "one line for each campaign goes here");
    CLI11_PARSE(app, argc, argv);
    try {
        std::vector<judgement> all, base;
        for (auto const& l : read_labels(labels)) {
            all.push_back(judge_case(l, results, data, baseline));
            if (!baseline.empty()) base.push_back(judge_case(l, baseline, {}));
        }
        std::cout << "True effects and answers\n"
                  << confusion(all) << '\n'
                  << complaints(all) << '\n'
                  << family_table(all, base) << '\n'
                  << measures(all);
        if (!table.empty()) {
            std::ofstream file{table};
            file << csv(all);
            if (!file.flush()) throw std::runtime_error("cannot write " + table);
        }
        for (auto const& j : all)
            if (!j.false_proofs.empty() || !j.contradictions.empty()) return 1;
    } catch (std::exception const& e) {
        std::cerr << e.what() << '\n';
        return 2;
    }
    return 0;
}
