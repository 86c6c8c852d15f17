// SPDX-License-Identifier: MIT
// The whole program around a model and its effects: PROGRAM FOLDER --out DIR.
#ifndef EXAMPLES_CONSOLE_ROBOT_PROGRAM_HPP
#define EXAMPLES_CONSOLE_ROBOT_PROGRAM_HPP

#include "diagnosis_output.hpp"
#include "number_range.hpp"
#include "program.hpp"
#include "thorough_diagnosis.hpp"

#include <sivid/io/dataset.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/identification_json.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/work_limit.hpp>
#include <sivid/report/identification_page.hpp>
#include <sivid/report/identification_report.hpp>
#include <sivid/report/identification_words.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace console {

/// The ranges of all parameters of a model that explains the data, on the terminal, and as
/// model.html and model.json.
/// @throws sivid::output_error
inline void write_identified_model(sivid::identification_problem const& problem,
                                   std::string const& id, std::filesystem::path const& out,
                                   double seconds, std::string const& command,
                                   progress_line& progress) {
    namespace report = sivid::report;
    if (problem.model.has_delays()) {
        std::cout << "  ranges of its parameters: not proved, the model has a delay\n";
        return;
    }
    sivid::identify_options options;
    options.search.seconds = seconds;
    options.search.keep_going = [] { return !interrupted(); };
    options.search.progress = [&](auto const& p) {
        progress.show(paving_words(p));
        return true;
    };
    auto const found = sivid::identify(problem, options);
    progress.finish();
    sivid::work_limit limit(0, options.search.keep_going);
    limit.allow(0.2);
    auto const motion = sivid::find_explaining_motion(problem, found, 240, limit);
    auto const view = report::view_of(problem, found, motion ? &*motion : nullptr,
                                      {.dataset = id,
                                       .date = today(),
                                       .machine = machine_text(),
                                       .command = command,
                                       .keep_going = limit});
    std::cout << "  ranges of all parameters (proved: none outside explains the data):\n";
    for (auto const& p : view.parameters) {
        if (report::is_empty(p.hull)) continue;
        std::cout << "    " << p.name << " in " << report::outward_text_within(p.hull, p.prior)
                  << " " << p.unit
                  << (report::share_of_prior(p) > 0.999 ? "  (nothing excluded)" : "") << "\n";
    }
    sivid::file_set files(out);
    files.add("model.html", report::identification_page(view).str());
    files.add("model.json", sivid::identification_json(problem, found, {.dataset = id}));
    files.commit();
    std::cout << "  written: " << (out / "model.html").string() << " and model.json\n";
}

/// Reads a data set of `model`, says whether the model explains it and what is missing if not, and
/// which parameters the model that explains it may have. Writes report.html, diagnosis.json and,
/// where something explains the data, model.html and model.json.
///   A quarter of the budget is for the ranges of the parameters, a tenth for the hold-out data.
/// @return an exit code: done where something explains the data, inconsistent where nothing does
///         and a gap is proved, else undecided
/// @throws sivid::input_error, sivid::output_error, std::invalid_argument
inline int diagnose_folder(sivid::recorded_model const& model,
                           std::vector<sivid::effect> const& catalogue,
                           std::filesystem::path const& folder, std::filesystem::path const& out,
                           double budget, std::string const& command, bool quiet = false) {
    auto const data = sivid::read_dataset(folder, sivid::names_of(model.about));
    auto const problem = sivid::problem_from_dataset(data, model);
    prepare_folder(out);
    progress_line progress(quiet);
    auto options = thorough_diagnosis(0.65 * budget);
    watch(options, progress);
    auto run = sivid::diagnose(problem, catalogue, options);
    auto const kept = sivid::holdout_from_dataset(data, model.about);
    if (!kept.empty() && !interrupted()) {
        progress.note("judging by the hold-out data");
        sivid::judge_by_holdout(run, kept, 0.1 * budget, options.test, 120);
    }
    progress.finish();
    write_diagnosis(run.result, data.id, plot_data(run, kept), page_options(run, data.id, command),
                    out, [](auto&) {});
    print_summary(run.result, data.id, out);
    for (auto const* name : {"model.html", "model.json"}) { // of an earlier result
        std::error_code none;
        std::filesystem::remove(out / name, none);
    }
    if (run.result.gap != sivid::gap_verdict::none && run.result.causes.empty()) return undecided;
    if (run.result.answer == sivid::answer_kind::unexplained) {
        return run.result.gap == sivid::gap_verdict::certified ? inconsistent : undecided;
    }
    if (!interrupted()) {
        write_identified_model(run.candidates[run.answer].problem, data.id, out, 0.25 * budget,
                               command, progress);
    }
    return done;
}

/// `main` of such a program.
/// @param about      what the program does, for --help
/// @param model      a functor with names, rate and observe
/// @param catalogue  effects that may be missing in it
template <class Model>
int robot_program(std::string const& name, std::string const& about, Model const& model,
                  std::vector<sivid::effect> const& catalogue, int argc, char** argv) {
    return guarded(name, [&] {
        std::filesystem::path folder, out;
        double budget = 60;
        bool quiet = false;
        CLI::App app{about};
        app.add_option("folder", folder, "folder with dataset.json")->required();
        app.add_option("--out", out, "folder for report.html, model.html and JSON files")
            ->required();
        app.add_option("--budget", budget, "seconds; it ends earlier when nothing is left to do")
            ->check(number_between(0.0, 1e9))
            ->capture_default_str();
        app.add_flag("--quiet", quiet, "no progress");
        try {
            app.parse(argc, argv);
        } catch (CLI::ParseError const& e) {
            return app.exit(e) == 0 ? 0 : static_cast<int>(bad_input);
        }
        return diagnose_folder(sivid::record_model(model), catalogue, folder, out, budget,
                               command_line(name, argc, argv), quiet);
    });
}

} // namespace console

#endif
