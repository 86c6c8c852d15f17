// SPDX-License-Identifier: MIT
// sivid COMMAND MODEL.toml ...: the program of a robot whose model is a text (docs/formats.md,
// sivid-model-1); nothing is compiled for it.
#include <sivid/app/app.hpp>
#include <sivid/app/program.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/text/read_model.hpp>

#include <cstddef>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr char const* usage =
    "sivid COMMAND MODEL.toml ...: proved identification and diagnosis with a model that is a "
    "text\n"
    "(docs/formats.md). Its commands:   sivid --help MODEL.toml\n"
    "Options and an example of each:    sivid COMMAND MODEL.toml --help\n";

sivid::app::robot robot_from(std::string const& file) {
    auto text = sivid::read_model(file);
    auto const about =
        text.about.empty() ? text.model.about.name + ", a model in " + file : text.about;
    sivid::app::robot result{"sivid", about, std::move(text.model), std::move(text.effects), file};
    for (std::size_t j = 0; j < text.unknown.size(); ++j)
        result.prior.push_back({text.unknown[j], sivid::exact_decimal::of(text.prior[j].lower()),
                                sivid::exact_decimal::of(text.prior[j].upper())});
    return result;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::cout << usage;
        return argc == 2 && std::string(argv[1]) == "--help" ? sivid::app::done
                                                             : sivid::app::bad_input;
    }
    std::optional<sivid::app::robot> robot;
    int const code = sivid::app::guarded("sivid", [&] {
        robot = robot_from(argv[2]);
        return sivid::app::done;
    });
    if (!robot) return code;
    std::vector<char*> rest(argv, argv + argc);
    rest.erase(rest.begin() + 2);
    rest.push_back(nullptr);
    return sivid::app::run(*robot, argc - 1, rest.data());
}
