// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "console/diagnosis_output.hpp"
#include "console/program.hpp"
#include "console/threads.hpp"
#include "effects.hpp"
#include "manoeuvres.hpp"

#include <sivid/io/dataset.hpp>
#include <sivid/io/problem_from_dataset.hpp>

namespace hovercraft_example {

int run(diagnose_command const& c) {
    auto const model = sivid::record_model(c.craft);
    auto const data = sivid::read_dataset(c.dataset, sivid::names_of(model.about));
    auto const problem = sivid::problem_from_dataset(data, model);
    console::prepare_folder(c.out);

    console::progress_line progress(c.quiet);
    sivid::diagnosis_options options;
    options.seconds = c.budget;
    options.test.workers = console::threads_for(c.threads);
    options.menu = recorded_manoeuvres(problem);
    for (auto& m : new_manoeuvres()) options.menu.push_back(std::move(m));
    console::watch(options, progress);
    auto run = sivid::diagnose(problem, catalogue(), options);
    progress.finish();
    progress.note("judging by data that chose nothing");
    auto const kept = sivid::holdout_from_dataset(data, model.about);
    sivid::judge_by_holdout(run, kept, 6, options.test);
    auto& d = run.result;
    console::write_diagnosis(d, data.id, console::plot_data(run, kept),
                             console::page_options(run, data.id, c.command_line), c.out,
                             [](auto const&) {});
    console::print_summary(d, data.id, c.out);
    return 0;
}

} // namespace hovercraft_example
