// SPDX-License-Identifier: MIT
// sivid COMMAND MODEL.toml ...: the program of a robot whose model is a text (docs/formats.md,
// sivid-model-1); nothing is compiled for it.
#include <sivid/app/app.hpp>
#include <sivid/app/program.hpp>
#include <sivid/app/robot_of_text.hpp>
#include <sivid/text/read_model.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr char const* usage =
    "Proved identification and diagnosis with a model that is a text (docs/formats.md):\n"
    "  sivid COMMAND MODEL.toml ...\n"
    "Options and an example of each command: sivid COMMAND --help";

bool asks_for_help(std::string_view word) { return word == "--help" || word == "-h"; }

/// Help needs no model: that of a robot without one. Nor do imports.
int run_without_model(int argc, char** argv, std::string const& file = "MODEL.toml") {
    sivid::text_model none;
    none.about = usage;
    return sivid::app::run(sivid::app::robot_of_text("sivid", file, none), argc, argv,
                           {std::cout, std::cerr});
}
bool is_import(std::vector<std::filesystem::path> const& words) {
    auto const is_model = [](auto const& file) { return file.extension() == ".toml"; };
    return words[0] == "import" && std::ranges::none_of(words, is_model);
}

/// @throws bad_request  for what is none by its name, the word that usually follows
sivid::text_model model_in(std::string const& file) {
    bool const other = std::filesystem::is_directory(file) ||
                       std::filesystem::path(file).extension() == ".json" ||
                       file.compare(0, 1, "-") == 0;
    if (other)
        throw sivid::app::bad_request("'" + file +
                                      "' stands where the model is expected; write sivid COMMAND "
                                      "MODEL.toml ..., or sivid COMMAND --help");
    return sivid::read_model(file);
}

} // namespace

int main(int argc, char** argv) {
    if (argc > 1 && (asks_for_help(argv[1]) || (argc > 2 && asks_for_help(argv[2]))))
        return run_without_model(argc, argv);
    if (argc < 3) { // no model: nothing is run, and what is missing is shown
        std::string help = "--help";
        std::vector<char*> words(argv, argv + argc);
        words.insert(words.end(), {help.data(), nullptr});
        run_without_model(argc + 1, words.data());
        return sivid::app::bad_input;
    }
    if (is_import({argv + 1, argv + argc})) return run_without_model(argc, argv, "");
    std::optional<sivid::app::robot> robot;
    int const code = sivid::app::guarded("sivid", {std::cout, std::cerr}, [&] {
        robot = sivid::app::robot_of_text("sivid", argv[2], model_in(argv[2]));
        return sivid::app::done;
    });
    if (!robot) return code;
    std::vector<char*> rest(argv, argv + argc);
    rest.erase(rest.begin() + 2);
    rest.push_back(nullptr);
    return sivid::app::run(*robot, argc - 1, rest.data(), {std::cout, std::cerr});
}
