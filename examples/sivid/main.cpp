// SPDX-License-Identifier: MIT
// sivid COMMAND MODEL.toml ...: the program of a robot whose model is a text (docs/formats.md,
// sivid-model-1); nothing is compiled for it.
#include <sivid/app/app.hpp>
#include <sivid/app/program.hpp>
#include <sivid/app/robot_of_text.hpp>
#include <sivid/text/read_model.hpp>

#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace {

constexpr char const* usage =
    "sivid COMMAND MODEL.toml ...: proved identification and diagnosis with a model that is a "
    "text\n"
    "(docs/formats.md). Its commands:   sivid --help MODEL.toml\n"
    "Options and an example of each:    sivid COMMAND MODEL.toml --help\n";

} // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::cout << usage;
        return argc == 2 && std::string(argv[1]) == "--help" ? sivid::app::done
                                                             : sivid::app::bad_input;
    }
    std::optional<sivid::app::robot> robot;
    int const code = sivid::app::guarded("sivid", [&] {
        robot = sivid::app::robot_of_text("sivid", argv[2], sivid::read_model(argv[2]));
        return sivid::app::done;
    });
    if (!robot) return code;
    std::vector<char*> rest(argv, argv + argc);
    rest.erase(rest.begin() + 2);
    rest.push_back(nullptr);
    return sivid::app::run(*robot, argc - 1, rest.data());
}
