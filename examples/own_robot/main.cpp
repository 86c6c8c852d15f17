// SPDX-License-Identifier: MIT
// own_robot FOLDER --out DIR: a whole program to copy. Model, effects and the lines of `run` that
// name them are yours; the rest stays. FOLDER is a data set, such as `sivid-import` writes.
#include "console/diagnosis_output.hpp"
#include "console/number_range.hpp"
#include "console/program.hpp"

#include <sivid/io/dataset.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/model/effects.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace {

/// A geared motor:  theta' = w,  w' = a u - b w.
struct geared_motor {
    static constexpr auto name = "geared_motor"; // "model" in dataset.json
    static constexpr auto states =
        sivid::states({{"theta", "rad", 100, "angle"}, {"w", "rad/s", 50, "torque balance"}});
    static constexpr auto inputs = sivid::inputs({{"u", "V"}});
    static constexpr auto channels = sivid::channels({{"theta", "rad"}});

    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"a", "rad/(s^2 V)", 10_dec}, {"b", "1/s", 5_dec}});
    }();

    template <class T>
    sivid::states_of<geared_motor, T> rate(T const& /*t*/,
                                           sivid::states_of<geared_motor, T> const& state,
                                           sivid::constants_of<geared_motor, T> const& constant,
                                           sivid::inputs_of<geared_motor, T> const& input) const {
        auto const& [theta, w] = state;
        auto const& [a, b] = constant;
        auto const& [u] = input;
        return {w, a * u - b * w};
    }

    template <class T>
    sivid::channels_of<geared_motor, T>
    observe(T const& /*t*/, sivid::states_of<geared_motor, T> const& state,
            sivid::constants_of<geared_motor, T> const& /*constant*/,
            sivid::inputs_of<geared_motor, T> const& /*input*/) const {
        return {state[0]};
    }
};

std::vector<sivid::effect> catalogue() {
    using namespace sivid::literals;
    namespace any = sivid::effects;
    return {any::dry_friction("dry_friction", "w", "rad/s^2", {0_dec, 10_dec}, 0.05_dec),
            any::constant_rate("offset", "w", "rad/s^2", {-5_dec, 5_dec}),
            any::quadratic_damping("quadratic_damping", "w", "1/rad", {0_dec, 1_dec}),
            any::input_dead_band("dead_band", "u", "V", {0_dec, 2_dec}),
            any::sensor_scale("encoder_scale", {"theta"}, {-0.05_dec, 0.05_dec})};
}

int run(std::filesystem::path const& folder, std::filesystem::path const& out, double budget,
        std::string const& command) {
    auto const model = sivid::record_model(geared_motor{});
    auto const data = sivid::read_dataset(folder, sivid::names_of(model.about));
    auto const problem = sivid::problem_from_dataset(data, model);
    console::prepare_folder(out);
    console::progress_line progress(false);
    sivid::diagnosis_options options;
    options.seconds = budget;
    console::watch(options, progress);
    auto run = sivid::diagnose(problem, catalogue(), options);
    progress.finish();
    auto const kept = sivid::holdout_from_dataset(data, model.about);
    sivid::judge_by_holdout(run, kept);
    console::write_diagnosis(run.result, data.id, console::plot_data(run, kept),
                             console::page_options(run, data.id, command), out, [](auto&) {});
    console::print_summary(run.result, data.id, out);
    return console::done;
}

int parse_and_run(int argc, char** argv) {
    std::filesystem::path folder, out;
    double budget = 30;
    CLI::App app{"What a model of a geared motor leaves out of its record"};
    app.add_option("folder", folder, "folder with dataset.json")->required();
    app.add_option("--out", out, "folder for report.html and diagnosis.json")->required();
    app.add_option("--budget", budget, "seconds")
        ->check(console::number_between(0.0, 1e9))
        ->capture_default_str();
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& e) {
        return app.exit(e) == 0 ? 0 : static_cast<int>(console::bad_input);
    }
    return run(folder, out, budget, console::command_line("own_robot", argc, argv));
}

} // namespace

int main(int argc, char** argv) {
    return console::guarded("own_robot", [&] { return parse_and_run(argc, argv); });
}
