// SPDX-License-Identifier: MIT
// design, for any model: the experiment that tells most.
#ifndef EXAMPLES_CONSOLE_DESIGN_COMMAND_HPP
#define EXAMPLES_CONSOLE_DESIGN_COMMAND_HPP

#include "console.hpp"
#include "decision_commands.hpp"
#include "decision_task.hpp"
#include "planned_experiment.hpp"
#include "program.hpp"
#include "result_files.hpp"

#include <sivid/decision/experiment_design.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/io/decision_json.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/model/manoeuvre.hpp>
#include <sivid/report/design_page.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace console {

/// `design`: prints the experiment; with `out`, writes design.html, design.json and scenario.json.
/// @returns done when it promises what was asked, refuted when none can, or undecided
inline int run_design(sivid::recorded_model const& open,
                      std::vector<sivid::effect> const& catalogue, decision_command const& c,
                      scenario_finder const& find) {
    namespace report = sivid::report;
    detail::decision_task task(open, catalogue, c, find);
    auto model = task.model();
    sivid::design_answer answer;
    answer.target = c.target;
    answer.limits = c.requirement;
    answer.plan = planned_from(c.measure, c.period, task.end(), task.data());
    answer.varied = task.varied();
    sivid::requirement limits;
    if (!c.requirement.empty()) limits = parse_requirement(c.requirement, model, task.end());
    auto margins = limits.margins;
    for (auto const& text : c.goal) {
        answer.goals.push_back(sivid::parse_goal(text, model));
        margins.push_back(answer.goals.back().value);
    }
    auto const about = task.prediction_for(model, margins);
    if (!c.out.empty()) prepare_folder(c.out);
    watch_interrupts();
    progress_line progress(c.quiet);
    progress.note("an experiment after " + task.dataset());
    for (auto const& g : answer.goals) {
        auto const instead = sivid::hidden_behind(model, about->direct.choice.unknown, g);
        if (!instead) continue;
        answer.hidden = g.text;
        answer.instead = *instead;
        break;
    }
    auto page = task.page_options();
    std::optional<sivid::prediction> tubes;
    std::optional<std::string> scenario;
    if (answer.hidden.empty()) {
        auto const menu = sivid::manoeuvre_shapes(answer.varied, about->problem.inputs,
                                                  mid(about->problem.initial), about->problem.end);
        sivid::design_options options;
        options.seconds = 0.8 * c.budget;
        options.target = c.target;
        options.keep_going = [] { return !console::interrupted(); };
        answer.found = sivid::design_experiment(about->problem, menu, answer.plan, answer.goals,
                                                c.requirement.empty() ? nullptr : &limits, options);
        auto const* const best = answer.found.best();
        if (best != nullptr) {
            about->problem.inputs = about->direct.inputs = best->inputs;
            if (task.described())
                scenario = scenario_with(*task.described(), report::design_sentence(answer),
                                         answer.varied, best->inputs, names_of(model.about));
            double const left = std::max(0.2, c.budget - progress.elapsed());
            if (!c.out.empty()) {
                tubes = task.predicted(*about, detail::options_for(0.5 * left), {});
                detail::add_lines(page, task, *about, {}, 0.3 * left);
            }
        }
    }
    progress.finish();
    if (!c.out.empty()) {
        sivid::file_set files(c.out);
        files.add("design.html",
                  report::design_page(*about, answer, tubes ? &*tubes : nullptr, page).str());
        files.add("design.json", sivid::design_json(*about, answer, task.json_options()));
        if (scenario) files.add("scenario.json", *scenario);
        files.commit();
    }
    std::cout << task.scenario() << ", " << task.dataset() << ": "
              << report::design_headline(answer) << "\n";
    if (auto const* const best = answer.found.best()) {
        std::cout << "  " << best->name;
        for (std::size_t k = 0; k < best->settings.size(); ++k)
            std::cout << (k == 0 ? ": " : ", ") << best->about[k].name << " "
                      << report::given_text(best->settings[k]);
        std::cout << "\n";
    }
    std::cout << "  " << report::design_sentence(answer) << "\n";
    detail::print_end(*about,
                      report::duration_text(answer.found.seconds) + ", " +
                          std::to_string(answer.found.simulated) + " settings, " +
                          std::to_string(answer.found.integrations),
                      c,
                      (c.out / "design.html").string() + " and design.json" +
                          (scenario ? ", scenario.json" : ""));
    return !answer.hidden.empty() ? refuted : answer.met() ? done : undecided;
}

/// @returns an exit code
inline int run_decision(decision what, sivid::recorded_model const& model,
                        std::vector<sivid::effect> const& catalogue, decision_command const& c,
                        scenario_finder const& find) {
    switch (what) {
    case decision::predict:
        return run_predict(model, catalogue, c, find);
    case decision::verify:
        return run_verify(model, catalogue, c, find);
    case decision::control:
        return run_control(model, catalogue, c, find);
    case decision::design:
        break;
    }
    return run_design(model, catalogue, c, find);
}

} // namespace console

#endif
