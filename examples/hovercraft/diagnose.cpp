// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "console/diagnosis_output.hpp"
#include "console/program.hpp"
#include "console/ranks.hpp"
#include "console/result_files.hpp"
#include "console/threads.hpp"
#include "effects.hpp"
#include "manoeuvres.hpp"

#ifdef SIVID_HAS_MPI
#include <sivid/cluster/diagnose.hpp>
#endif
#include <sivid/io/dataset.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/dataset_effects.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/io/result/problem_digest.hpp>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace hovercraft_example {

namespace {

/// By all ranks; nothing on those that help.
std::optional<sivid::diagnosis_run> diagnosed(diagnose_command const& c,
                                              sivid::identification_problem const& problem,
                                              std::vector<sivid::effect> const& effects,
                                              sivid::diagnosis_options const& options) {
#ifdef SIVID_HAS_MPI
    if (c.ranks != nullptr && c.ranks->several()) {
        namespace cluster = sivid::cluster;
        auto const digest = sivid::dataset_digest(c.dataset);
        if (!c.ranks->helps())
            return cluster::diagnose(c.ranks->others(), problem, effects, options, digest);
        cluster::help_diagnose(c.ranks->others(), problem, effects, digest);
        return std::nullopt;
    }
#endif
    static_cast<void>(c);
    return sivid::diagnose(problem, effects, options);
}

} // namespace

int run(diagnose_command const& c) {
    bool const helps = c.ranks != nullptr && c.ranks->helps();
    console::progress_line progress(c.quiet || helps); // its clock is that of the budget
    auto const left = [&] { return std::max(0.0, c.budget - progress.elapsed()); };
    auto const model = sivid::record_model(c.craft);
    auto const data = sivid::read_dataset(c.dataset, sivid::names_of(model.about));
    auto const problem = sivid::problem_from_dataset(data, model);
    if (!helps) console::prepare_folder(c.out);

    sivid::diagnosis_options options;
    options.seconds = 0.8 * left();
    apply(c.how, options.test);
    options.test.workers = console::threads_for(c.threads);
    options.menu = recorded_manoeuvres(problem);
    for (auto& m : new_manoeuvres()) options.menu.push_back(std::move(m));
    console::watch(options, progress);
    if (c.ranks != nullptr) c.ranks->watch_interrupts();
    auto answer = diagnosed(c, problem, sivid::chosen_effects(catalogue(), data), options);
    if (!answer) return console::done;
    auto& run = *answer;
    progress.finish();
    auto const kept = sivid::holdout_from_dataset(data, model.about);
    sivid::diagnosis_source const source{console::seen_from(c.out, c.dataset),
                                         sivid::dataset_digest(c.dataset),
                                         sivid::problem_digest(problem)};
    auto const write = [&] {
        console::write_diagnosis(
            run.result, data.id, console::plot_data(run, kept),
            console::page_options(run, data.id, c.command_line), c.out, [](auto const&) {}, source);
    };
    write(); // whatever happens to what follows
    if (!kept.empty() && left() > 0 && !console::interrupted()) {
        progress.note("judging by the held-out data");
        auto const boxes = static_cast<std::size_t>(4 * c.budget);
        sivid::judge_by_holdout(run, kept, left(), options.test, boxes);
        write();
    }
    console::print_summary(run.result, data.id, c.out);
    return console::exit_code_of(run.result);
}

} // namespace hovercraft_example
