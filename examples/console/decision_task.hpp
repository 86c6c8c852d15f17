// SPDX-License-Identifier: MIT
// What predict, verify, control and design work on: a stored identification and a scenario, perhaps
// under a control law.
#ifndef EXAMPLES_CONSOLE_DECISION_TASK_HPP
#define EXAMPLES_CONSOLE_DECISION_TASK_HPP

#include "console.hpp"
#include "decision_command.hpp"
#include "parameter_ranges.hpp"
#include "planned_experiment.hpp"
#include "result_files.hpp"

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/decision/control_law.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/enclosure/set/parametric_set.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/dataset_effects.hpp>
#include <sivid/io/decision_json.hpp>
#include <sivid/io/identification_reader.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/io/scenario.hpp>
#include <sivid/io/text/text_file.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/closed_loop.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/manoeuvre.hpp>
#include <sivid/model/named_effects.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/report/decision_page.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/verifier/predict_from.hpp>
#include <sivid/version.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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
        auto const effects = sivid::effects_named(sivid::chosen_effects(catalogue, data),
                                                  stored_.effects, &model.about);
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
            if (c.duration > 0)
                throw std::invalid_argument("--duration: a recorded scenario has its own");
            use_recorded(c.scenario.substr(5));
        } else {
            auto s = find(c.scenario);
            if (c.duration > 0) s.duration = c.duration;
            described_ = s;
            scenario_ = s.name;
            about_ = s.about;
            request_.end = s.duration;
            request_.initial = sivid::box(s.initial.size());
            for (std::size_t i = 0; i < s.initial.size(); ++i)
                request_.initial[i] = s.initial[i].enclosure;
            for (auto const& input : s.inputs)
                request_.inputs.push_back(sivid::exact_signal(input, s.duration));
        }
        if (!effects.empty()) add_effects(effects);
        close_the_loop();
        vary_inputs();
    }

    /// The model, with the effects that the result speaks of, under the law.
    [[nodiscard]] sivid::recorded_model const& model() const {
        return closed_ ? closed_->model : problem_.model;
    }

    [[nodiscard]] double end() const { return request_.end; }
    /// What was asked, and what has to hold for a sampled law.
    [[nodiscard]] std::string requirement() const {
        return closed_ ? closed_->with_slews(command_.requirement) : command_.requirement;
    }
    /// Tubes, as long as a sampled law keeps the limits of its slew: they hold no longer.
    [[nodiscard]] sivid::prediction predicted(sivid::stored_prediction const& about,
                                              sivid::prediction_options const& options,
                                              std::vector<sivid::node_id> const& margins) const {
        auto found = sivid::predict(about.problem, options, margins);
        if (about.starts_follow) found.excess = HUGE_VAL; // not all of these motions are possible
        if (!closed_) return found;
        for (auto const& s : closed_->slews) sivid::end_where_reached(found, s.channel, s.limit);
        return found;
    }
    /// Names of the gains that have a range.
    [[nodiscard]] std::vector<std::string> open_gains() const {
        std::vector<std::string> names;
        for (auto const& [name, range] : gains_) {
            if (!is_one_value(range)) names.push_back(name);
        }
        return names;
    }
    [[nodiscard]] std::string const& scenario() const { return scenario_; }
    [[nodiscard]] std::string const& dataset() const { return dataset_; }

    /// The data, with the model and effects that the result speaks of.
    [[nodiscard]] sivid::identification_problem const& data() const { return problem_; }
    /// Unless the scenario is one of the data.
    [[nodiscard]] std::optional<sivid::scenario_description> const& described() const {
        return described_;
    }
    /// The effects that the result speaks of.
    [[nodiscard]] std::string effects() const {
        return stored_.effects.empty() ? "the model as it is" : sivid::joined(stored_.effects);
    }
    [[nodiscard]] std::vector<sivid::varied_input> const& varied() const { return varied_; }

    /// @param model  that of the task, with further nodes
    [[nodiscard]] std::unique_ptr<sivid::stored_prediction>
    prediction_for(sivid::recorded_model const& model, std::vector<sivid::node_id> const& margins) {
        auto made = sivid::predict_from(problem_, stored_, model, margins, request_,
                                        command_.result / "result.json");
        for (auto const& [name, range] : request_.set) {
            if (gains_.count(name) == 0)
                made->assumptions.push_back(in_words(name, range) +
                                            " in this scenario, whatever it was in the data");
        }
        if (closed_) made->assumptions.push_back("the law " + command_.law + " acts " + when());
        for (auto const& [channel, bound] : sensors_)
            made->assumptions.push_back("the law sees " + channel + " with an error of at most " +
                                        report::given_text(bound) +
                                        ", which may change at every instant");
        return made;
    }

    [[nodiscard]] sivid::decision_json_options json_options() const {
        sivid::decision_json_options o;
        o.dataset = dataset_;
        if (!command_.out.empty()) o.source_folder = seen_from(command_.out, command_.result);
        o.source_digest = sivid::sha256(sivid::read_text(command_.result / "result.json"));
        o.scenario = scenario_;
        o.set = request_.set;
        o.law = command_.law;
        o.sensors = sensors_;
        o.sampled = command_.sampled;
        o.delay = command_.delay;
        return o;
    }
    [[nodiscard]] report::decision_page_options page_options() const {
        report::decision_page_options o;
        o.dataset = dataset_;
        o.scenario = scenario_;
        o.about = about_;
        o.law = command_.law;
        for (auto const& [name, range] : request_.set)
            o.set.push_back(in_words(name, range) +
                            (gains_.count(name) == 0 ? ", in this scenario." : ", of the law."));
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
    /// The point of least squares, and the middle of what else is open.
    [[nodiscard]] std::optional<std::vector<double>>
    least_squares(sivid::stored_prediction const& about, double seconds) const {
        sivid::work_limit const limit(seconds, [] { return !console::interrupted(); });
        auto fit = sivid::fit(problem_, sivid::fit_norm::squares, {}, limit);
        if (fit.parameters.size() != problem_.choice.unknown.size()) return std::nullopt;
        return with_others(std::move(fit.parameters), about);
    }
    [[nodiscard]] std::optional<std::vector<double>>
    witness(sivid::stored_prediction const& about) const {
        if (!stored_.witness) return std::nullopt;
        std::vector<double> point;
        for (auto const& name : problem_.choice.unknown) {
            auto const own = stored_.witness->parameters.find(name);
            if (own == stored_.witness->parameters.end()) return std::nullopt;
            point.push_back(own->second);
        }
        return with_others(std::move(point), about);
    }

private:
    [[nodiscard]] std::string when() const {
        auto const unit = " " + problem_.model.about.time_unit;
        if (command_.sampled == 0) return "at every instant, without a delay";
        return "on samples at most " + report::given_text(command_.sampled) + unit +
               " apart, each at most " + report::given_text(command_.delay) + unit +
               " after it was taken, and is held";
    }
    /// The point, and the middle of what else is open.
    [[nodiscard]] static std::vector<double> with_others(std::vector<double> point,
                                                         sivid::stored_prediction const& about) {
        auto const around = about.direct.around();
        while (point.size() < around.size()) point.push_back(mid(around[point.size()]));
        return point;
    }
    [[nodiscard]] static std::string in_words(std::string const& name,
                                              sivid::interval const& range) {
        auto const low = report::given_text(range.lower());
        return low == report::given_text(range.upper())
                   ? name + " = " + low
                   : name + " in " + report::given_text({range.lower(), range.upper()});
    }
    /// The scenario as an experiment, so that states which effects add get their starts, and
    /// effects of some experiments are switched.
    void add_effects(std::vector<sivid::effect> const& effects) {
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
    void close_the_loop() {
        auto const& c = command_;
        gains_ = ranges_from(c.gain, "--gain");
        if (c.law.empty()) {
            if (!c.gain.empty() || !c.sensor.empty() || c.sampled > 0 || c.delay > 0 ||
                !c.slew.empty())
                throw std::invalid_argument(
                    "--gain, --sensor, --sampled, --delay and --slew belong to a law: give --law");
            return;
        }
        sivid::closed_loop loop(problem_.model);
        for (auto const& [name, bound] : ranges_from(c.sensor, "--sensor")) {
            sensors_[name] = one_value("--sensor " + name, bound);
            loop.sensor(name, sensors_[name]);
        }
        if (c.sampled > 0) loop.sampled(c.sampled, c.delay);
        if (c.sampled == 0 && (c.delay > 0 || !c.slew.empty()))
            throw std::invalid_argument("--delay and --slew are of a sampled law: give --sampled");
        for (auto const& [name, limit] : ranges_from(c.slew, "--slew"))
            loop.slew(name, one_value("--slew " + name, limit));
        for (auto const& [name, range] : gains_) {
            if (request_.set.count(name) != 0)
                throw std::invalid_argument("--gain " + name + " is given by --set, too");
            loop.gain(name, "");
        }
        sivid::command_by(c.law, loop, request_.end);
        for (auto const& [name, bound] : sensors_) {
            if (!loop.reads(name))
                throw std::invalid_argument("--sensor " + name +
                                            ": the law does not read measured(" + name + ")");
        }
        closed_ = loop.finish();
        require_used_gains();
        for (auto const& [name, range] : gains_) request_.set[name] = range;
        request_.inputs = closed_->inputs(request_.inputs);
        auto choice = problem_.choice;
        for (auto const& [name, range] : request_.set) choice.fixed[name] = range;
        request_.initial =
            closed_->initial(request_.initial, request_.inputs,
                             sivid::constant_ranges(closed_->model, choice, problem_.prior));
    }
    /// Inputs to be chosen are signals that take no term of the equations with them, so that what
    /// is proved of products holds for each of them.
    void vary_inputs() {
        varied_ = varied_inputs(command_.vary, problem_.model.about.inputs);
        for (auto const& u : varied_) {
            request_.inputs[u.index] = sivid::sampled_signal(
                {0, request_.end},
                {std::lerp(u.lower, u.upper, 0.3), std::lerp(u.lower, u.upper, 0.7)},
                sivid::interpolation::linear);
        }
    }
    void require_used_gains() const {
        auto const& m = closed_->model;
        auto outputs = m.rate;
        outputs.insert(outputs.end(), m.observe.begin(), m.observe.end());
        auto const needed = sivid::operands_of(m.g, outputs);
        for (auto const& [name, range] : gains_) {
            auto const own = sivid::index_of(m.about.constants, name, "constant");
            bool used = false;
            for (std::size_t k = 0; k < needed.size(); ++k) {
                auto const& n = m.g.nodes()[k];
                used = used || (needed[k] && n.op == sivid::operation::constant &&
                                static_cast<std::size_t>(n.index) == own);
            }
            if (!used) throw std::invalid_argument("--gain " + name + ": the law does not use it");
        }
    }
    void use_recorded(std::string const& name) {
        auto const found = std::find_if(problem_.experiments.begin(), problem_.experiments.end(),
                                        [&](auto const& e) { return e.name == name; });
        if (found == problem_.experiments.end()) {
            throw std::invalid_argument(
                "the data set has no scenario " + sivid::in_quotes(name) +
                " of the role fit; it has: " + sivid::joined_names(problem_.experiments));
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
    std::optional<sivid::scenario_description> described_; ///< unless it is one of the data
    std::vector<sivid::varied_input> varied_;
    std::optional<sivid::closed_model> closed_; ///< with a law
    std::map<std::string, sivid::interval> gains_;
    std::map<std::string, double> sensors_;
};

/// @param cells  of the grid in time, at least; `verify` refines it where a verdict hangs on it
inline sivid::prediction_options options_for(decision_command const& c, double seconds,
                                             std::size_t cells = 120) {
    sivid::prediction_options o;
    o.run = c.run;
    o.seconds = seconds;
    o.cells = cells;
    o.keep_going = [] { return !console::interrupted(); };
    return o;
}

/// A task with what is asked of it. The folder is prepared once all of the input is good.
struct question {
    decision_task task;
    sivid::recorded_model model;
    sivid::requirement asked;
    std::unique_ptr<sivid::stored_prediction> about;

    question(sivid::recorded_model const& open, std::vector<sivid::effect> const& catalogue,
             decision_command const& c, scenario_finder const& find)
        : task(open, catalogue, c, find), model(task.model()) {
        asked = sivid::parse_requirement(task.requirement(), model, task.end());
        about = task.prediction_for(model, asked.margins);
    }
    question(question const&) = delete;
    question& operator=(question const&) = delete;
};

/// The lines of a page: least squares, and a single motion.
inline void add_lines(report::decision_page_options& o, decision_task const& task,
                      sivid::stored_prediction const& about,
                      std::vector<sivid::node_id> const& margins, double seconds) {
    auto const start = mid(about.direct.initial);
    if (auto const p = task.least_squares(about, seconds))
        o.least_squares = task.simulated(about, margins, *p, start);
    if (auto const p = task.witness(about)) o.single = task.simulated(about, margins, *p, start);
}

} // namespace detail

} // namespace console

#endif
