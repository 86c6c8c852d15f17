// SPDX-License-Identifier: MIT
// The whole program around a model and its effects: PROGRAM FOLDER --out DIR, and then
// PROGRAM predict | verify | control DIR/model --scenario FILE; beside it PROGRAM rank FOLDER --out
// DIR.
#ifndef EXAMPLES_CONSOLE_ROBOT_PROGRAM_HPP
#define EXAMPLES_CONSOLE_ROBOT_PROGRAM_HPP

#include "decision_options.hpp"
#include "design_command.hpp"
#include "diagnosis_output.hpp"
#include "number_range.hpp"
#include "program.hpp"
#include "rank_command.hpp"
#include "result_files.hpp"
#include "thorough_diagnosis.hpp"

#include <sivid/io/dataset.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/dataset_effects.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/identification_json.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/report/identification_page.hpp>
#include <sivid/report/identification_report.hpp>
#include <sivid/report/identification_words.hpp>
#include <sivid/work_limit.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace console {

/// The ranges of all parameters of a model that explains the data, on the terminal, and as
/// model.html and model.json; with its boxes in the folder model, for predict, verify, control.
/// @param effects  joined to the data set's model
/// @param data     what it was identified from
/// @returns  what is proved of the whole prior; `undecided` where nothing was tried, too
/// @throws sivid::output_error
inline sivid::verdict write_identified_model(sivid::identification_problem const& problem,
                                             std::vector<sivid::effect> const& effects,
                                             sivid::dataset const& data,
                                             std::filesystem::path const& folder,
                                             std::filesystem::path const& out, double seconds,
                                             std::string const& command, progress_line& progress,
                                             bool verbose) {
    namespace report = sivid::report;
    if (problem.model.has_memory()) {
        std::cout << "  ranges of its parameters: not proved, the model has a delay, a play or a "
                     "rate limit\n";
        return sivid::verdict::undecided;
    }
    if (sivid::starts_follow_parameters(problem)) {
        std::cout << "  ranges of its parameters: not proved, the effects begin where their "
                     "parameters say\n";
        return sivid::verdict::undecided;
    }
    std::vector<std::string> names;
    for (auto const& e : effects) names.push_back(e.name);
    auto assumptions = data.assumptions;
    for (auto& words : sivid::wrap_assumptions(effects)) assumptions.push_back(std::move(words));
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
                                      {.dataset = data.id,
                                       .further_assumptions = assumptions,
                                       .date = today(),
                                       .machine = machine_text(),
                                       .command = command,
                                       .keep_going = limit});
    std::cout << "  ranges of all parameters (proved: none outside explains the data):\n";
    for (auto const& p : view.parameters) {
        if (report::is_empty(p.hull)) continue;
        std::cout << "    " << p.name << " in " << report::outward_text_within(p.hull, p.prior)
                  << (p.unit == "1" ? "" : " " + p.unit);
        auto const note = report::exclusion_note(view, p);
        std::cout << (note.empty() ? "" : "  (" + note + ")") << "\n";
    }
    if (verbose) print_tried(view.tried);
    sivid::file_set files(out);
    files.add("model.html", report::identification_page(view).str());
    files.add("model.json",
              sivid::identification_json(
                  problem, found,
                  {.dataset = data.id, .effects = names, .further_assumptions = assumptions}));
    files.commit();
    sivid::file_set result(out / "model");
    add_result_tables(result, problem, found);
    result.add("result.json",
               sivid::identification_json(problem, found,
                                          {.dataset = data.id,
                                           .effects = names,
                                           .further_assumptions = assumptions,
                                           .source_folder = seen_from(out / "model", folder),
                                           .source_digest = sivid::dataset_digest(folder)}));
    result.commit();
    std::cout << "  written: " << (out / "model.html").string() << " and model.json; "
              << (out / "model").string() << " for predict, verify, control\n";
    return found.verdict;
}

/// Reads a data set of `model`, says whether the model explains it and what is missing if not, and
/// which parameters the model that explains it may have. Writes report.html, diagnosis.json and,
/// where something explains the data, model.html and model.json.
///   A quarter of the budget is for the ranges of the parameters, a tenth for the hold-out data.
/// @return an exit code: undecided where candidates were left untried or it was ended early, else
///         done, whatever was found
/// @throws sivid::input_error, sivid::output_error, std::invalid_argument
inline int diagnose_folder(sivid::recorded_model const& model,
                           std::vector<sivid::effect> const& catalogue,
                           std::filesystem::path const& folder, std::filesystem::path const& out,
                           double budget, std::string const& command, bool quiet = false,
                           bool verbose = false) {
    progress_line progress(quiet); // its clock is that of the budget
    auto const left = [&] { return std::max(0.0, budget - progress.elapsed()); };
    auto const data = sivid::read_dataset(folder, sivid::names_of(model.about));
    auto const problem = sivid::problem_from_dataset(data, model);
    prepare_folder(out);
    auto options = thorough_diagnosis(0.65 * left());
    watch(options, progress);
    auto run = sivid::diagnose(problem, sivid::chosen_effects(catalogue, data), options);
    auto const kept = sivid::holdout_from_dataset(data, model.about);
    auto const write = [&] {
        write_diagnosis(run.result, data.id, plot_data(run, kept),
                        page_options(run, data.id, command), out, [](auto&) {});
    };
    write(); // whatever happens to what follows
    for (auto const* name : {"model.html", "model.json", "model/result.json"}) { // earlier ones
        std::error_code none;
        std::filesystem::remove(out / name, none);
    }
    if (!kept.empty() && left() > 0 && !interrupted()) {
        progress.note("judging by the held-out data");
        sivid::judge_by_holdout(run, kept, std::min(left(), 0.25 * budget), options.test);
        write();
    }
    progress.finish();
    print_summary(run.result, data.id, out);
    bool const explained = run.result.answer == sivid::answer_kind::none ||
                           run.result.answer == sivid::answer_kind::effects;
    if (explained && left() > 0 && !interrupted()) {
        auto const& answer = run.candidates[run.answer];
        auto const effects = sivid::holdout::effects_of(answer, run.catalogue);
        (void)write_identified_model(answer.problem, effects, data, folder, out,
                                     std::min(left(), 0.25 * budget), command, progress, verbose);
    }
    return exit_code_of(run.result);
}

/// PROGRAM predict | verify | control RESULT ...
inline int decide_by_result(std::string const& name, sivid::recorded_model const& model,
                            std::vector<sivid::effect> const& catalogue, decision what, int argc,
                            char** argv) {
    decision_command c;
    c.command_line = command_line(name, argc, argv);
    CLI::App app{about(what)};
    add_options(app, what, c,
                "a JSON file (sivid-scenario-1), or data:NAME for one of the data set");
    try {
        app.parse(argc - 1, argv + 1);
    } catch (CLI::ParseError const& e) {
        return app.exit(e) == 0 ? 0 : static_cast<int>(bad_input);
    }
    auto const names = sivid::names_of(model.about);
    auto const find = [&](std::string const& file) { return sivid::read_scenario(file, names); };
    return run_decision(what, model, catalogue, c, find);
}

/// PROGRAM rank FOLDER ...: how far each parameter can move the measurements.
inline int rank_folder(std::string const& name, sivid::recorded_model const& model, int argc,
                       char** argv) {
    rank_request c;
    std::filesystem::path folder;
    c.command_line = command_line(name, argc, argv);
    CLI::App app{"How far can each parameter alone move the measurements, over the whole prior?"};
    app.add_option("folder", folder, "folder with dataset.json")->required();
    app.add_option("--out", c.out, "folder for ranking.html and ranking.json")->required();
    app.add_option("--budget", c.budget, "seconds; it ends earlier when all bounds are close")
        ->check(number_between(0.0, 1e9))
        ->capture_default_str();
    app.add_flag("--quiet", c.quiet, "no progress");
    try {
        app.parse(argc - 1, argv + 1);
    } catch (CLI::ParseError const& e) {
        return app.exit(e) == 0 ? 0 : static_cast<int>(bad_input);
    }
    auto const data = sivid::read_dataset(folder, sivid::names_of(model.about));
    c.dataset = data.id;
    return run_rank(sivid::problem_from_dataset(data, model), c);
}

/// `main` of such a program, for a model that is recorded already, inside `guarded`.
/// @param about      what the program does, for --help
/// @param catalogue  effects that may be missing in the model
inline int recorded_robot_program(std::string const& name, std::string const& about,
                                  sivid::recorded_model const& model,
                                  std::vector<sivid::effect> const& catalogue, int argc,
                                  char** argv) {
    std::string const first = argc > 1 ? argv[1] : "";
    for (auto const& [word, what] :
         {std::pair("predict", decision::predict), std::pair("verify", decision::verify),
          std::pair("control", decision::control), std::pair("design", decision::design)}) {
        if (first == word) return decide_by_result(name, model, catalogue, what, argc, argv);
    }
    if (first == "rank") return rank_folder(name, model, argc, argv);
    std::filesystem::path folder, out;
    double budget = 60;
    bool quiet = false, verbose = false;
    CLI::App app{about + "\n\nThen: predict OUT/model ..., verify OUT/model ..., control "
                         "OUT/model ..., design OUT/model ...; and: rank FOLDER ... (--help)"};
    app.add_option("folder", folder, "folder with dataset.json")->required();
    app.add_option("--out", out, "folder for report.html, model.html and JSON files")->required();
    app.add_option("--budget", budget, "seconds; it ends earlier when nothing is left to do")
        ->check(number_between(0.0, 1e9))
        ->capture_default_str();
    app.add_flag("--quiet", quiet, "no progress");
    app.add_flag("--verbose", verbose, "what was tried to bound the parameters, and why");
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& e) {
        return app.exit(e) == 0 ? 0 : static_cast<int>(bad_input);
    }
    return diagnose_folder(model, catalogue, folder, out, budget, command_line(name, argc, argv),
                           quiet, verbose);
}

/// The same for a functor with names, rate and observe.
template <class Model>
int robot_program(std::string const& name, std::string const& about, Model const& model,
                  std::vector<sivid::effect> const& catalogue, int argc, char** argv) {
    return guarded(name, [&] {
        return recorded_robot_program(name, about, sivid::record_model(model), catalogue, argc,
                                      argv);
    });
}

} // namespace console

#endif
