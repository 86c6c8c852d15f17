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
#include <sivid/report/decision_page.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace console {

namespace detail {

/// Whether all that can be told is to be narrowed down together.
/// @throws std::invalid_argument
inline bool volume_asked(decision_command const& c) {
    bool const volume = std::find(c.goal.begin(), c.goal.end(), "volume") != c.goal.end();
    if (volume && c.goal.size() > 1)
        throw std::invalid_argument("--halve volume is of all parameters: give it alone");
    return volume;
}

/// A result with what is asked of its motions.
struct design_side {
    decision_task task;
    sivid::recorded_model model;
    sivid::requirement limits;
    std::vector<sivid::design_goal> goals;
    std::unique_ptr<sivid::stored_prediction> about;

    design_side(sivid::recorded_model const& open, std::vector<sivid::effect> const& catalogue,
                decision_command const& c, scenario_finder const& find)
        : task(open, catalogue, c, find), model(task.model()) {
        if (!c.requirement.empty()) limits = parse_requirement(c.requirement, model, task.end());
        auto nodes = limits.margins;
        if (volume_asked(c)) {
            goals = sivid::all_goals(model, task.data().choice);
        } else {
            for (auto const& text : c.goal) goals.push_back(sivid::parse_goal(text, model));
        }
        for (auto const& g : goals) nodes.push_back(g.value);
        about = task.prediction_for(model, nodes);
    }
    design_side(design_side const&) = delete; // the task refers to its command
    design_side& operator=(design_side const&) = delete;

    [[nodiscard]] sivid::requirement const* asked() const {
        return limits.text.empty() ? nullptr : &limits;
    }
};

/// The other result that an experiment is to tell from the first; nothing where none is given.
/// @param other  the command for it, which it refers to
inline std::unique_ptr<design_side> rival_of(design_side const& one,
                                             sivid::recorded_model const& open,
                                             std::vector<sivid::effect> const& catalogue,
                                             decision_command const& c, decision_command& other,
                                             scenario_finder const& find) {
    if (c.against.empty() && c.goal.empty())
        throw std::invalid_argument("say what the experiment is for: give --halve or --against");
    if (c.against.empty()) return nullptr;
    other = c;
    other.result = c.against;
    auto two = std::make_unique<design_side>(open, catalogue, other, find);
    if (two->task.dataset() != one.task.dataset())
        throw std::invalid_argument("--against: the two results are of different data sets");
    // The answer rests on both.
    for (auto const& text : two->about->assumptions) {
        auto& all = one.about->assumptions;
        if (std::find(all.begin(), all.end(), text) == all.end())
            all.push_back(text + " (with " + two->task.effects() + ")");
    }
    return two;
}

/// How much of its width a hidden goal keeps, whatever is measured: where the witness is proved to
/// explain the data, and the scenario has their constants.
inline double untold_share_of(decision_task const& task, sivid::stored_prediction const& about,
                              sivid::design_goal const& goal, decision_command const& c) {
    auto const witness = task.witness(about);
    bool const proved =
        witness && c.set.empty() && about.feasible.proved && about.feasible.proved(*witness);
    return proved ? sivid::untold_share(about.problem, about.direct, *witness, goal) : 0;
}

} // namespace detail

/// `design`: prints the experiment; with `out`, writes design.html, design.json and scenario.json.
/// @returns done when it promises what was asked, refuted when none can, or undecided
inline int run_design(sivid::recorded_model const& open,
                      std::vector<sivid::effect> const& catalogue, decision_command const& c,
                      scenario_finder const& find) {
    namespace report = sivid::report;
    detail::design_side one(open, catalogue, c, find);
    decision_command other;
    auto const two = detail::rival_of(one, open, catalogue, c, other, find);
    auto const& [task, model, limits, goals, about] = one;
    sivid::design_answer answer;
    answer.target = c.target;
    answer.jointly = detail::volume_asked(c);
    answer.limits = c.requirement;
    answer.plan = planned_from(c.measure, c.period, task.end(), task.data());
    answer.varied = task.varied();
    answer.goals = goals;
    if (two) {
        answer.first = task.effects();
        answer.second = two->task.effects();
    }
    for (auto const& g : answer.goals) {
        auto const instead = sivid::hidden_behind(model, about->direct.choice, g);
        if (!instead || answer.impossible) continue;
        answer.hidden = g.text;
        answer.instead = *instead;
        answer.impossible =
            !answer.jointly && detail::untold_share_of(task, *about, g, c) > c.target;
    }
    if (!c.out.empty()) prepare_folder(c.out);
    watch_interrupts();
    progress_line progress(c.quiet);
    progress.note("an experiment after " + task.dataset());
    auto page = task.page_options();
    std::optional<sivid::prediction> tubes;
    std::optional<std::string> scenario;
    if (!answer.impossible) {
        auto const menu = sivid::manoeuvre_shapes(answer.varied, about->problem.inputs,
                                                  mid(about->problem.initial), about->problem.end,
                                                  about->problem.model.about.time_unit);
        sivid::design_options options;
        options.seconds = 0.8 * c.budget;
        options.target = answer.jointly
                             ? std::pow(c.target, 1.0 / static_cast<double>(answer.goals.size()))
                             : c.target;
        options.keep_going = [] { return !console::interrupted(); };
        options.run = c.run;
        answer.found =
            two ? sivid::design_separation(about->problem, two->about->problem, menu, answer.plan,
                                           one.asked(), two->asked(), options)
                : sivid::design_experiment(about->problem, menu, answer.plan, answer.goals,
                                           one.asked(), options);
        auto const* const best = answer.found.best();
        if (best != nullptr && (answer.met() || !two)) {
            about->problem = about->problem.under(best->inputs);
            about->direct = about->direct.under(best->inputs);
            if (task.described())
                scenario = scenario_with(*task.described(), c.name, report::design_sentence(answer),
                                         answer.varied, best->inputs, names_of(model.about));
            double const left = std::max(0.2, c.budget - progress.elapsed());
            if (!c.out.empty()) {
                tubes = task.predicted(*about, detail::options_for(c, 0.5 * left), {});
                detail::add_lines(page, task, *about, {}, 0.3 * left);
            }
        }
    }
    progress.finish();
    if (!c.out.empty()) {
        sivid::file_set files(c.out);
        files.add("design.html",
                  report::design_page(*about, answer, tubes ? &*tubes : nullptr, page).str());
        auto options = task.json_options();
        if (two) options.against_digest = two->task.json_options().source_digest;
        files.add("design.json", sivid::design_json(*about, answer, options));
        if (scenario) files.add("scenario.json", *scenario);
        files.commit();
    }
    std::cout << task.scenario() << ", " << task.dataset() << ": "
              << report::design_headline(answer) << "\n";
    if (auto const* const best = answer.found.best(); best != nullptr && (answer.met() || !two)) {
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
    return answer.impossible ? refuted : answer.met() ? done : undecided;
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
