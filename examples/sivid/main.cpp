// SPDX-License-Identifier: MIT
// sivid COMMAND MODEL.toml ...: identify, diagnose and decide with a model that is a text
// (docs/formats.md); nothing is compiled for it.
#include "console/robot_program.hpp"

#include <sivid/model/describe.hpp>
#include <sivid/text/read_model.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

constexpr char const* about =
    "sivid: validated identification and diagnosis with a model that is a text\n\n"
    "  sivid describe MODEL.toml              the model as it was read\n"
    "  sivid identify MODEL.toml FOLDER ...   which parameters explain the data\n"
    "  sivid diagnose MODEL.toml FOLDER ...   whether the model explains them, and what is "
    "missing\n"
    "  sivid rank MODEL.toml FOLDER ...       how far each parameter moves the measurements\n"
    "  sivid predict|verify|control|design MODEL.toml RESULT ...\n\n"
    "FOLDER is a data set, such as sivid-import writes. More: sivid COMMAND MODEL.toml --help\n";

/// sivid identify MODEL.toml FOLDER --out DIR
int identify(std::string const& command, sivid::recorded_model const& model, int argc,
             char** argv) {
    std::filesystem::path folder, out;
    double budget = 60;
    bool quiet = false, verbose = false;
    CLI::App app{"Which parameters of the prior explain the data?", "sivid identify MODEL.toml"};
    app.add_option("folder", folder, "folder with dataset.json")->required();
    app.add_option("--out", out, "folder for model.html, model.json and model")->required();
    app.add_option("--budget", budget, "seconds; it ends earlier when nothing is left to do")
        ->check(console::number_between(0.0, 1e9))
        ->capture_default_str();
    app.add_flag("--quiet", quiet, "no progress");
    app.add_flag("--verbose", verbose, "what was tried to bound the parameters, and why");
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& e) {
        return app.exit(e) == 0 ? 0 : static_cast<int>(console::bad_input);
    }
    console::progress_line progress(quiet);
    auto const data = sivid::read_dataset(folder, sivid::names_of(model.about));
    console::prepare_folder(out);
    auto const verdict =
        console::write_identified_model(sivid::problem_from_dataset(data, model), {}, data, folder,
                                        out, budget, command, progress, verbose);
    std::cout << data.id << ": " << to_string(verdict) << "\n";
    return verdict == sivid::verdict::consistent     ? console::consistent
           : verdict == sivid::verdict::inconsistent ? console::inconsistent
                                                     : console::undecided;
}

int run(int argc, char** argv) {
    // Reports of results name the model first, as a program of its own.
    if (argc > 2 && std::string_view(argv[1]).ends_with(".toml")) std::swap(argv[1], argv[2]);
    std::string const command = argc > 1 ? argv[1] : "";
    if (argc < 3 || command == "--help") {
        std::cout << about;
        return argc > 1 && command == "--help" ? console::done : console::bad_input;
    }
    auto const text = sivid::read_model(argv[2]);
    auto const whole = console::command_line("sivid", argc, argv);
    // The rest is what a program of this model alone would be given.
    std::vector<char*> rest{argv[0]};
    if (command != "diagnose" && command != "identify" && command != "describe")
        rest.push_back(argv[1]);
    rest.insert(rest.end(), argv + 3, argv + argc);
    auto const count = static_cast<int>(rest.size());
    rest.push_back(nullptr);
    if (command == "describe") {
        std::cout << sivid::describe(text.model);
        for (auto const& e : text.effects)
            std::cout << "effect " << e.name << (e.about.empty() ? "" : ": ") << e.about << "\n";
        return console::done;
    }
    if (command == "identify") return identify(whole, text.model, count, rest.data());
    bool known = command == "diagnose" || command == "rank";
    for (auto const* word : {"predict", "verify", "control", "design"})
        known = known || command == word;
    if (!known) throw std::invalid_argument("unknown command '" + command + "'; run sivid --help");
    auto const name = std::string("sivid ") + argv[2];
    return console::recorded_robot_program(name, text.about.empty() ? name : text.about, text.model,
                                           text.effects, count, rest.data());
}

} // namespace

int main(int argc, char** argv) {
    return console::guarded("sivid", [&] { return run(argc, argv); });
}
