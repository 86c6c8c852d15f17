// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "console/console.hpp"
#include "effects.hpp"
#include "manoeuvres.hpp"

#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/diagnosis_json.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/io/text_file.hpp>

#include <iostream>

namespace hovercraft_example {

int run(diagnose_command const& c) {
    auto const model = sivid::record_model(c.craft);
    auto const data = sivid::read_dataset(c.dataset, sivid::names_of(model.about));
    auto const problem = sivid::problem_from_dataset(data, model);
    auto const further = sivid::assumptions_of(data);
    prepare_folder(c.out);

    console::watch_interrupts();
    console::progress_line progress(c.quiet);
    sivid::diagnosis_options options;
    options.seconds = c.budget;
    options.menu = recorded_manoeuvres(problem);
    for (auto& m : new_manoeuvres()) options.menu.push_back(std::move(m));
    options.progress = [&](std::string const& what) {
        progress.show(what);
        return !console::interrupted();
    };
    auto run = sivid::diagnose(problem, catalogue(), options);
    progress.finish();
    progress.note("judging by data that chose nothing");
    sivid::judge_by_holdout(run, sivid::holdout_from_dataset(data, model.about));
    auto& d = run.result;
    d.assumptions.insert(d.assumptions.end(), further.begin(), further.end());
    sivid::write_atomically(c.out / "diagnosis.json", sivid::diagnosis_json(d, data.id));
    return 0;
}

} // namespace hovercraft_example
