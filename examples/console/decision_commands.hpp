// SPDX-License-Identifier: MIT
// predict and verify, for any model: what a stored identification says of a scenario.
#ifndef EXAMPLES_CONSOLE_DECISION_COMMANDS_HPP
#define EXAMPLES_CONSOLE_DECISION_COMMANDS_HPP

#include "console.hpp"
#include "decision_command.hpp"
#include "parameter_ranges.hpp"
#include "program.hpp"
#include "result_files.hpp"

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/verification.hpp>
#include <sivid/diagnosis/affected_problem.hpp>
#include <sivid/enclosure/parametric_set.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/dataset_digest.hpp>
#include <sivid/io/dataset_effects.hpp>
#include <sivid/io/decision_json.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/identification_reader.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/io/scenario.hpp>
#include <sivid/io/sha256.hpp>
#include <sivid/io/stored_prediction.hpp>
#include <sivid/io/text_file.hpp>
#include <sivid/paving/work_limit.hpp>
#include <sivid/report/decision_page.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/version.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace console {

/// Finds a scenario by the name that was given. @throws sivid::input_error
using scenario_finder = std::function<sivid::scenario_description(std::string const&)>;

namespace detail {

namespace report = sivid::report;

/// A result, its data set and its scenario.
class decision_task {
public:
    decision_task(sivid::recorded_model const& model, std::vector<sivid::effect> const& catalogue,
                  decision_command const& c, scenario_finder const& find)
        : command_{c} {
        stored_ = sivid::read_identification(c.result);
        if (c.dataset.empty() && stored_.source_folder.empty())
            throw std::invalid_argument(
                "the result does not say where its data set is: give --dataset");
        auto const folder = c.dataset.empty() ? c.result / stored_.source_folder : c.dataset;
        auto const data = sivid::read_dataset(folder, sivid::names_of(model.about));
        problem_ = sivid::problem_from_dataset(data, model);
        auto const effects =
            sivid::effects_named(sivid::chosen_effects(catalogue, data), stored_.effects);
        if (!stored_.source_digest.empty() &&
            sivid::dataset_digest(folder) != stored_.source_digest)
            throw sivid::input_error{{.file = folder.string()},
                                     "this is not the data set that was identified (SHA-256)",
                                     "give the right one by --dataset, or identify it anew"};
        dataset_ = data.id;
        for (auto& e : problem_.experiments) {
            request_.stated_outliers[e.name] = e.outliers;
            auto const own = stored_.budget.find(e.name);
            if (own != stored_.budget.end()) e.outliers = own->second;
        }
        request_.set = ranges_from(c.set, "--set");
        request_.proof_seconds = std::min(request_.proof_seconds, 0.5 * c.budget);
        if (c.scenario.starts_with("data:")) {
            use_recorded(c.scenario.substr(5));
        } else {
            auto const s = find(c.scenario);
            scenario_ = s.name;
            about_ = s.about;
            request_.end = s.duration;
            request_.initial = sivid::box(s.initial.size());
            for (std::size_t i = 0; i < s.initial.size(); ++i)
                request_.initial[i] = s.initial[i].enclosure;
            for (auto const& input : s.inputs)
                request_.inputs.push_back(sivid::exact_signal(input, s.duration));
        }
        if (effects.empty()) return;
        // The scenario as an experiment, so that states which effects add get their starts, and
        // effects of some experiments are switched.
        auto scenario = problem_;
        scenario.experiments.resize(1);
        scenario.experiments[0].name = scenario_;
        scenario.experiments[0].inputs = request_.inputs;
        scenario.experiments[0].initial = request_.initial;
        scenario.experiments[0].begin = 0;
        for (auto const& [name, range] : request_.set) scenario.choice.fixed[name] = range;
        problem_ = sivid::affected(problem_, effects);
        auto const joined = sivid::affected(scenario, effects).experiments[0];
        request_.initial = joined.initial;
        request_.inputs = joined.inputs;
    }

    /// The model, with the effects that the result speaks of.
    [[nodiscard]] sivid::recorded_model const& model() const { return problem_.model; }

    [[nodiscard]] double end() const { return request_.end; }
    [[nodiscard]] std::string const& scenario() const { return scenario_; }
    [[nodiscard]] std::string const& dataset() const { return dataset_; }

    /// @param model  that of the task, with further nodes
    [[nodiscard]] std::unique_ptr<sivid::stored_prediction>
    prediction_for(sivid::recorded_model const& model, std::vector<sivid::node_id> const& margins) {
        auto made = sivid::predict_from(problem_, stored_, model, margins, request_,
                                        command_.result / "result.json");
        for (auto const& words : set_words())
            made->assumptions.push_back(words + " in this scenario, whatever it was in the data");
        return made;
    }

    [[nodiscard]] sivid::decision_json_options json_options() const {
        sivid::decision_json_options o;
        o.dataset = dataset_;
        if (!command_.out.empty()) o.source_folder = seen_from(command_.out, command_.result);
        o.source_digest = sivid::sha256(sivid::read_text(command_.result / "result.json"));
        o.scenario = scenario_;
        o.set = request_.set;
        return o;
    }
    [[nodiscard]] report::decision_page_options page_options() const {
        report::decision_page_options o;
        o.dataset = dataset_;
        o.scenario = scenario_;
        o.about = about_;
        for (auto const& words : set_words()) o.set.push_back(words + ", in this scenario.");
        o.footer = {std::string{"sivid "} + std::string{sivid::version}, today(), machine_text(),
                    command_.command_line};
        return o;
    }

    /// The motion at one point, in plain doubles; empty where it cannot be simulated.
    [[nodiscard]] report::simulated_line simulated(sivid::stored_prediction const& about,
                                                   std::vector<sivid::node_id> const& margins,
                                                   std::vector<double> const& parameters,
                                                   std::vector<double> const& start) const {
        report::simulated_line line;
        auto const& direct = about.direct;
        auto choice = direct.choice;
        choice.unknown.clear();
        for (std::size_t j = 0; j < direct.choice.unknown.size(); ++j)
            choice.fixed[direct.choice.unknown[j]] = sivid::interval(parameters[j]);
        sivid::followed_outputs const outputs(direct.model, margins);
        for (int k = 0; k <= 400; ++k) line.times.push_back(direct.end * k / 400);
        try {
            auto inputs = sivid::nominal(direct.inputs);
            auto const all = sivid::simulate(
                std::make_shared<sivid::approximate_model const>(outputs.model, choice, inputs),
                inputs, start, {}, 0, line.times, {1e-9});
            line.states = all.states;
            for (auto const& y : all.outputs) {
                auto& c = line.channels.emplace_back();
                auto& f = line.further.emplace_back();
                for (auto const k : outputs.channels) c.push_back(y[k]);
                for (auto const k : outputs.margins) f.push_back(y[k]);
            }
        } catch (std::exception const&) {
            return {}; // a missing line is no loss: nothing rests on it
        }
        return line;
    }
    /// The point of least squares, and the middle of what is set.
    [[nodiscard]] std::optional<std::vector<double>> least_squares(double seconds) const {
        sivid::work_limit const limit(seconds, [] { return !console::interrupted(); });
        auto fit = sivid::fit(problem_, sivid::fit_norm::squares, {}, limit);
        if (fit.parameters.size() != problem_.choice.unknown.size()) return std::nullopt;
        return with_set(std::move(fit.parameters));
    }
    [[nodiscard]] std::optional<std::vector<double>> witness() const {
        if (!stored_.witness) return std::nullopt;
        std::vector<double> point;
        for (auto const& name : problem_.choice.unknown) {
            auto const own = stored_.witness->parameters.find(name);
            if (own == stored_.witness->parameters.end()) return std::nullopt;
            point.push_back(own->second);
        }
        return with_set(std::move(point));
    }

private:
    [[nodiscard]] std::vector<double> with_set(std::vector<double> point) const {
        for (auto const& [name, range] : request_.set) {
            if (width(range) > sivid::normalised_unknowns::negligible * mag(range))
                point.push_back(mid(range));
        }
        return point;
    }
    [[nodiscard]] std::vector<std::string> set_words() const {
        std::vector<std::string> words;
        for (auto const& [name, range] : request_.set)
            words.push_back(name + " in " + report::given_text({range.lower(), range.upper()}));
        return words;
    }
    void use_recorded(std::string const& name) {
        auto const found = std::find_if(problem_.experiments.begin(), problem_.experiments.end(),
                                        [&](auto const& e) { return e.name == name; });
        if (found == problem_.experiments.end()) {
            std::string known;
            for (auto const& e : problem_.experiments)
                known += (known.empty() ? "" : ", ") + e.name;
            throw std::invalid_argument("the data set has no scenario " + sivid::in_quotes(name) +
                                        " of the role fit; it has: " + known);
        }
        scenario_ = found->name;
        about_ = "As recorded in " + dataset_ + ".";
        request_.initial = found->initial;
        request_.inputs = found->inputs;
        for (auto const& m : found->measurements) request_.end = std::max(request_.end, m.time);
    }

    decision_command const& command_;
    sivid::stored_identification stored_;
    sivid::identification_problem problem_;
    sivid::prediction_request request_;
    std::string dataset_, scenario_, about_;
};

inline sivid::prediction_options options_for(double seconds) {
    sivid::prediction_options o;
    o.seconds = seconds;
    o.keep_going = [] { return !console::interrupted(); };
    return o;
}

/// The lines of a page: least squares, and a single motion.
inline void add_lines(report::decision_page_options& o, decision_task const& task,
                      sivid::stored_prediction const& about,
                      std::vector<sivid::node_id> const& margins, double seconds) {
    auto const start = mid(about.direct.initial);
    if (auto const p = task.least_squares(seconds))
        o.least_squares = task.simulated(about, margins, *p, start);
    if (auto const p = task.witness()) o.single = task.simulated(about, margins, *p, start);
}

} // namespace detail

/// `predict`: writes prediction.html, prediction.json and tubes.csv. @returns an exit code
inline int run_predict(sivid::recorded_model const& model,
                       std::vector<sivid::effect> const& catalogue, decision_command const& c,
                       scenario_finder const& find) {
    namespace report = sivid::report;
    detail::decision_task task(model, catalogue, c, find);
    auto const about = task.prediction_for(task.model(), {});
    prepare_folder(c.out); // nothing is written when the input is bad
    watch_interrupts();
    progress_line progress(c.quiet);
    progress.note("predicting " + task.scenario() + " for all that " + task.dataset() + " leaves");
    auto found = sivid::predict(about->problem, detail::options_for(c.budget));
    if (about->starts_follow) found.excess = HUGE_VAL; // not all of these motions are possible
    auto options = task.page_options();
    detail::add_lines(options, task, *about, {}, std::max(0.2, c.budget - progress.elapsed()));
    progress.finish();
    sivid::file_set files(c.out);
    files.add("tubes.csv", sivid::tubes_csv(found));
    files.add("prediction.html", report::prediction_page(*about, found, options).str());
    files.add("prediction.json", sivid::prediction_json(*about, found, task.json_options()));
    files.commit();
    std::cout << task.scenario() << " for all parameters that " << task.dataset() << " leaves: "
              << (found.complete
                      ? "proved"
                      : "proved up to t = " + report::exact_text(found.reached) + " s only")
              << "\n";
    for (auto const& channel : found.channels) {
        report::range const r{channel.low.back(), channel.high.back()};
        std::cout << "  " << channel.name << " at the end in "
                  << (is_finite(r) ? report::outward_text(r) : "no known bounds")
                  << (channel.unit == "1" ? "" : " " + channel.unit) << "\n";
    }
    if (std::isfinite(found.excess))
        std::cout << "  tubes at most "
                  << report::rounded_text(std::max(0.0, found.excess), report::rounding::up,
                                          {.significant = 2, .shift = 2})
                  << " % wider than what these parameters reach\n";
    std::cout << "  " << report::duration_text(found.seconds) << ", " << found.parts << " parts, "
              << found.integrations
              << " validated integrations\n  written: " << (c.out / "prediction.html").string()
              << " and prediction.json, tubes.csv\n";
    return found.complete ? done : undecided;
}

/// `verify`: prints the answer; with `out`, writes verification.html and verification.json.
/// @returns done when proved, refuted, or undecided
inline int run_verify(sivid::recorded_model const& model,
                      std::vector<sivid::effect> const& catalogue, decision_command const& c,
                      scenario_finder const& find) {
    namespace report = sivid::report;
    detail::decision_task task(model, catalogue, c, find);
    auto asked_model = task.model();
    auto const asked = sivid::parse_requirement(c.requirement, asked_model, task.end());
    auto const about = task.prediction_for(asked_model, asked.margins);
    if (!c.out.empty()) prepare_folder(c.out);
    watch_interrupts();
    progress_line progress(c.quiet);
    progress.note("verifying " + task.scenario() + " for all that " + task.dataset() + " leaves");
    auto options = detail::options_for(c.budget);
    options.cells = 60; // refined where a verdict hangs on it
    auto const found = sivid::verify(about->problem, asked, about->feasible, options);
    progress.finish();
    if (!c.out.empty()) {
        auto page = task.page_options();
        double const left = std::max(0.2, c.budget - progress.elapsed());
        auto const tubes =
            sivid::predict(about->problem, detail::options_for(0.5 * left), asked.margins);
        detail::add_lines(page, task, *about, asked.margins, 0.3 * left);
        if (found.witness) {
            page.single = task.simulated(*about, asked.margins, found.witness->parameters,
                                         found.witness->start);
            page.single_is = "the witness that violates it, simulated";
        }
        sivid::file_set files(c.out);
        files.add("verification.html",
                  report::verification_page(*about, asked, found, tubes, page).str());
        files.add("verification.json",
                  sivid::verification_json(*about, asked, found, task.json_options()));
        files.commit();
    }
    std::cout << task.scenario() << ", " << task.dataset() << ": " << to_string(found.answer)
              << "\n  " << asked.text << "\n  " << report::answer_sentence(*about, found) << "\n";
    for (auto const& line : report::decision_assumptions(*about))
        std::cout << "  - " << line << "\n";
    std::cout << "  " << report::duration_text(found.seconds) << ", " << found.parts << " parts, "
              << found.integrations << " validated integrations\n";
    if (!c.out.empty())
        std::cout << "  written: " << (c.out / "verification.html").string()
                  << " and verification.json\n";
    return found.answer == sivid::requirement_answer::proved    ? done
           : found.answer == sivid::requirement_answer::refuted ? refuted
                                                                : undecided;
}

} // namespace console

#endif
