// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_DECISION_TASK_HPP
#define SIVID_APP_DETAIL_DECISION_TASK_HPP

#include <sivid/app/commands.hpp>
#include <sivid/app/console.hpp>
#include <sivid/app/detail/parameter_ranges.hpp>
#include <sivid/app/detail/posed_problem.hpp>
#include <sivid/approximate/fit/fit.hpp>
#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/decision/control_law.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/promised_width.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/enclosure/set/parametric_set.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/decision_json.hpp>
#include <sivid/io/identification_reader.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/io/scenario.hpp>
#include <sivid/io/text/text_file.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/closed_loop.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/manoeuvre.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/report/decision_page.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/verifier/predict_from.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid::app {

/// Inputs that may be chosen, with their limits as they were written, as near as doubles are.
/// @throws bad_request
[[nodiscard]] inline std::vector<varied_input>
varied_inputs(std::vector<std::string> const& told,
              std::vector<model_description::item> const& inputs) {
    std::vector<varied_input> result;
    for (auto const& [name, range] : ranges_from(told, "--vary")) {
        auto const index = index_of(inputs, name, "input");
        if (is_one_value(range))
            throw bad_request("--vary " + name + ": give limits, such as " + name + "=0:100");
        auto const written = [](double end) {
            return few_digits(-HUGE_VAL, HUGE_VAL, end, 1e-15 * std::abs(end));
        };
        result.push_back(
            {index, name, inputs[index].unit, written(range.lower()), written(range.upper())});
    }
    return result;
}

/// What is measured, when, with which errors: as it is told, or as in the data.
/// @param errors  such as psi=0.01; none: the largest of each channel
/// @param period  [s]; 0: that of the first experiment
/// @throws bad_request
[[nodiscard]] inline planned_measurements planned_from(std::vector<std::string> const& errors,
                                                       double period, double end,
                                                       identification_problem const& data) {
    auto const& channels = data.model.about.channels;
    std::vector<double> bounds(channels.size(), 0.0);
    auto const told = ranges_from(errors, "--measure");
    for (auto const& [name, bound] : told) {
        double const error = one_value("--measure " + name, bound);
        if (!(error > 0)) throw bad_request("--measure " + name + ": the error must be above 0");
        bounds[index_of(channels, name, "channel")] = error;
    }
    std::set<double> times;
    for (auto const& e : data.experiments) {
        for (auto const& m : e.measurements) {
            double const half = 0.5 * width(m.bound);
            if (told.empty() && std::isfinite(half))
                bounds[m.channel] = std::max(bounds[m.channel], half);
            if (&e == &data.experiments.front()) times.insert(m.time);
        }
    }
    // Half the width of a rounded interval is no decimal any more; what is told stays as it is.
    auto const readable = [](double x) { return few_digits(0, HUGE_VAL, x, 1e-9 * std::abs(x)); };
    for (auto& b : bounds)
        if (told.empty()) b = readable(b);
    if (period == 0)
        period = times.size() < 2 ? end / 30
                                  : readable((*times.rbegin() - *times.begin()) /
                                             static_cast<double>(times.size() - 1));
    return planned_measurements::every(period, end, std::move(bounds));
}

/// A scenario with other inputs, as a file.
/// @param name    empty: that of the scenario and "-design"
/// @param inputs  lines between samples, where they vary
[[nodiscard]] inline std::string scenario_with(scenario_description s, std::string const& name,
                                               std::string const& about,
                                               std::vector<varied_input> const& varied,
                                               std::vector<signal> const& inputs,
                                               model_names const& names) {
    s.name = name.empty() ? s.name + "-design" : name;
    s.about = about;
    for (auto const& u : varied) {
        auto const& samples = std::get<sampled_signal>(inputs[u.index]);
        auto& shape = s.inputs[u.index];
        shape = {};
        shape.shape = input_shape::kind::samples;
        shape.times = samples.times();
        shape.values = samples.values();
    }
    return scenario_json(s, names);
}

namespace detail {

/// What predict, verify, control and design work on: a stored identification, its data set and a
/// scenario, perhaps under a control law.
class decision_task {
public:
    decision_task(robot const& r, decision_command const& c) : command_{c} {
        stored_ = read_identification(c.result);
        auto const folder = data_of_result(c.result, c.dataset, stored_.source_folder);
        auto const data = read_data(r, folder);
        problem_ = problem_from_dataset(data, r.model);
        auto const effects = effects_of(r, data, stored_.effects);
        if (!stored_.source_digest.empty() && dataset_digest(folder) != stored_.source_digest)
            throw input_error{{.file = folder.string()},
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
            if (c.duration > 0) throw bad_request("--duration: a recorded scenario has its own");
            use_recorded(c.scenario.substr(5));
        } else {
            auto s = find_scenario(r, c.scenario);
            if (c.duration > 0) s.duration = c.duration;
            described_ = s;
            scenario_ = s.name;
            about_ = s.about;
            request_.end = s.duration;
            request_.initial = box(s.initial.size());
            for (std::size_t i = 0; i < s.initial.size(); ++i)
                request_.initial[i] = s.initial[i].enclosure;
            for (auto const& input : s.inputs)
                request_.inputs.push_back(exact_signal(input, s.duration));
        }
        if (!effects.empty()) add_effects(effects);
        own_inputs_ = request_.inputs.size();
        if (!stored_.disturbances.empty()) add_disturbances();
        if (!c.effects.empty()) add_scenario_effects(chosen_effects(r.effects, data));
        close_the_loop();
        vary_inputs();
    }

    /// The model, with the effects that the result speaks of, under the law.
    [[nodiscard]] recorded_model const& model() const {
        return closed_ ? closed_->model : scenario_model();
    }

    [[nodiscard]] double end() const { return request_.end; }
    /// What was asked, and what has to hold for a sampled law.
    [[nodiscard]] std::string requirement() const {
        return closed_ ? closed_->with_slews(command_.requirement) : command_.requirement;
    }
    /// Tubes, as long as a sampled law keeps the limits of its slew: they hold no longer.
    [[nodiscard]] prediction predicted(stored_prediction const& about,
                                       prediction_options const& options,
                                       std::vector<node_id> const& margins) const {
        auto found = predict(about.problem, options, margins);
        // Not all of these motions are possible, or no parameter narrows them.
        if (about.starts_follow || !stored_.disturbances.empty()) found.excess = HUGE_VAL;
        if (!closed_) return found;
        for (auto const& s : closed_->slews) end_where_reached(found, s.channel, s.limit);
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
    [[nodiscard]] identification_problem const& data() const { return problem_; }
    /// Unless the scenario is one of the data.
    [[nodiscard]] std::optional<scenario_description> const& described() const {
        return described_;
    }
    /// The effects that the result speaks of.
    [[nodiscard]] std::string effects() const {
        return stored_.effects.empty() ? "the model as it is" : joined(stored_.effects);
    }
    [[nodiscard]] std::vector<varied_input> const& varied() const { return varied_; }

    /// @param model  that of the task, with further nodes
    [[nodiscard]] std::unique_ptr<stored_prediction>
    prediction_for(recorded_model const& model, std::vector<node_id> const& margins) {
        auto made = predict_from(problem_, stored_, model, margins, request_,
                                 command_.result / "result.json");
        for (auto const& [name, range] : request_.set) {
            if (gains_.count(name) == 0)
                made->assumptions.push_back(in_words(name, range) +
                                            " in this scenario, whatever it was in the data");
        }
        if (!stored_.disturbances.empty())
            made->assumptions.push_back("in this scenario disturbances are as large as in the "
                                        "data, at every time: " +
                                        sivid::in_words(stored_.disturbances, problem_.model));
        for (auto const& e : command_.effects)
            made->assumptions.push_back("the effect " + e + " acts in this scenario");
        if (closed_) made->assumptions.push_back("the law " + command_.law + " acts " + when());
        for (auto const& [channel, bound] : sensors_)
            made->assumptions.push_back("the law sees " + channel + " with an error of at most " +
                                        report::given_text(bound) +
                                        ", which may change at every instant");
        return made;
    }

    [[nodiscard]] decision_json_options json_options() const {
        decision_json_options o;
        o.dataset = dataset_;
        if (!command_.out.empty()) o.source_folder = seen_from(command_.out, command_.result);
        o.source_digest = sha256(read_text(command_.result / "result.json"));
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
        o.footer = page_footer(command_.command_line);
        return o;
    }

    /// The motion at one point, in plain doubles; empty where it cannot be simulated.
    [[nodiscard]] report::simulated_line simulated(stored_prediction const& about,
                                                   std::vector<node_id> const& margins,
                                                   std::vector<double> const& parameters,
                                                   std::vector<double> const& start) const {
        report::simulated_line line;
        auto const& direct = about.direct;
        auto choice = direct.choice;
        choice.unknown.clear();
        for (std::size_t j = 0; j < direct.choice.unknown.size(); ++j)
            choice.fixed[direct.choice.unknown[j]] = interval(parameters[j]);
        followed_outputs const outputs(direct.model, margins);
        for (int k = 0; k <= 400; ++k) line.times.push_back(direct.end * k / 400);
        try {
            auto inputs = nominal(direct.inputs);
            auto const all =
                simulate(std::make_shared<approximate_model const>(outputs.model, choice, inputs),
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
    [[nodiscard]] std::optional<std::vector<double>> least_squares(stored_prediction const& about,
                                                                   double seconds) const {
        work_limit const limit(seconds, wanted);
        auto best = fit(problem_, fit_norm::squares, {}, limit);
        if (best.parameters.size() != problem_.choice.unknown.size()) return std::nullopt;
        return with_others(std::move(best.parameters), about);
    }
    [[nodiscard]] std::optional<std::vector<double>> witness(stored_prediction const& about) const {
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
                                                         stored_prediction const& about) {
        auto const around = about.direct.around();
        while (point.size() < around.size()) point.push_back(mid(around[point.size()]));
        return point;
    }
    [[nodiscard]] static std::string in_words(std::string const& name, interval const& range) {
        auto const low = report::given_text(range.lower());
        return low == report::given_text(range.upper())
                   ? name + " = " + low
                   : name + " in " + report::given_text({range.lower(), range.upper()});
    }
    /// The scenario as an experiment, so that states which effects add get their starts, and
    /// effects of some experiments are switched.
    void add_effects(std::vector<effect> const& effects) {
        auto scenario = problem_;
        scenario.experiments.resize(1);
        scenario.experiments[0].name = scenario_;
        scenario.experiments[0].inputs = request_.inputs;
        scenario.experiments[0].initial = request_.initial;
        scenario.experiments[0].begin = 0;
        for (auto const& [name, range] : request_.set) scenario.choice.fixed[name] = range;
        problem_ = affected(problem_, effects);
        auto const joined = affected(scenario, effects).experiments[0];
        request_.initial = joined.initial;
        request_.inputs = joined.inputs;
    }
    /// The disturbances that the result is for act in the scenario, too, as large all the time.
    void add_disturbances() {
        problem_ = disturbed(std::move(problem_), stored_.disturbances);
        for (auto const& words : assumptions_of(stored_.disturbances, problem_.model))
            if (std::find(stored_.assumptions.begin(), stored_.assumptions.end(), words) ==
                stored_.assumptions.end())
                throw input_error{{.file = (command_.result / "result.json").string()},
                                  "the result contradicts itself: it does not assume '" + words +
                                      "'",
                                  "identify the data anew"};
        auto const& all = problem_.experiments.front().inputs;
        for (std::size_t k = own_inputs_; k < all.size(); ++k)
            request_.inputs.push_back(sampled_signal({0.0}, {0.0}, interpolation::hold,
                                                     std::get<sampled_signal>(all[k]).errors()));
        about_ += (about_.empty() ? "For all disturbances of " : " For all disturbances of ") +
                  sivid::in_words(stored_.disturbances, problem_.model) + ", here as in the data.";
    }
    /// Effects that act in the scenario, whatever the data know of them.
    void add_scenario_effects(std::vector<effect> const& catalogue) {
        auto further = join_effects(problem_.model, catalogue, command_.effects);
        request_.set.insert(further.set.begin(), further.set.end()); // what is told stays
        auto choice = problem_.choice;
        for (auto const& [name, range] : request_.set) choice.fixed[name] = range;
        auto const known = request_.initial.size();
        auto const constants = constant_ranges(further.model, choice, problem_.prior);
        request_.initial =
            start_with_added(further.model, constants, request_.inputs, 0, request_.initial);
        for (auto i = known; i < request_.initial.size(); ++i)
            if (!is_one_value(request_.initial[i]))
                throw bad_request("--with: the state '" + further.model.about.states[i].name +
                                  "' of an effect begins at more than one value; where parameters "
                                  "say where, give them one value each");
        further_ = std::move(further.model);
        if (further_->has_memory() && !stored_.disturbances.empty())
            throw bad_request("--with: delays, plays and rate limits are not covered beside the "
                              "disturbances of this result; leave them out");
    }
    [[nodiscard]] recorded_model const& scenario_model() const {
        return further_ ? *further_ : problem_.model;
    }
    void close_the_loop() {
        auto const& c = command_;
        gains_ = ranges_from(c.gain, "--gain");
        if (c.law.empty()) {
            if (!c.gain.empty() || !c.sensor.empty() || c.sampled > 0 || c.delay > 0 ||
                !c.slew.empty())
                throw bad_request(
                    "--gain, --sensor, --sampled, --delay and --slew belong to a law: give --law");
            return;
        }
        closed_loop loop(scenario_model());
        for (auto const& [name, bound] : ranges_from(c.sensor, "--sensor")) {
            sensors_[name] = one_value("--sensor " + name, bound);
            loop.sensor(name, sensors_[name]);
        }
        if (c.sampled > 0) loop.sampled(c.sampled, c.delay);
        if (c.sampled == 0 && (c.delay > 0 || !c.slew.empty()))
            throw bad_request("--delay and --slew are of a sampled law: give --sampled");
        for (auto const& [name, limit] : ranges_from(c.slew, "--slew"))
            loop.slew(name, one_value("--slew " + name, limit));
        for (auto const& [name, range] : gains_) {
            if (request_.set.count(name) != 0)
                throw bad_request("--gain " + name + " is given by --set, too");
            loop.gain(name, "");
        }
        command_by(c.law, loop, request_.end);
        for (auto const& [name, bound] : sensors_) {
            if (!loop.reads(name))
                throw bad_request("--sensor " + name + ": the law does not read measured(" + name +
                                  ")");
        }
        closed_ = loop.finish();
        require_used_gains();
        for (auto const& [name, range] : gains_) request_.set[name] = range;
        request_.inputs = closed_->inputs(request_.inputs);
        auto choice = problem_.choice;
        for (auto const& [name, range] : request_.set) choice.fixed[name] = range;
        request_.initial =
            closed_->initial(request_.initial, request_.inputs,
                             constant_ranges(closed_->model, choice, problem_.prior));
    }
    /// Inputs to be chosen are signals that take no term of the equations with them, so that what
    /// is proved of products holds for each of them.
    void vary_inputs() {
        auto items = problem_.model.about.inputs;
        items.resize(std::min(items.size(), own_inputs_)); // nobody chooses a disturbance
        varied_ = varied_inputs(command_.vary, items);
        for (auto const& u : varied_) {
            request_.inputs[u.index] =
                sampled_signal({0, request_.end},
                               {std::lerp(u.lower, u.upper, 0.3), std::lerp(u.lower, u.upper, 0.7)},
                               interpolation::linear);
        }
    }
    void require_used_gains() const {
        auto const& m = closed_->model;
        auto outputs = m.rate;
        outputs.insert(outputs.end(), m.observe.begin(), m.observe.end());
        auto const needed = operands_of(m.g, outputs);
        for (auto const& [name, range] : gains_) {
            auto const own = index_of(m.about.constants, name, "constant");
            bool used = false;
            for (std::size_t k = 0; k < needed.size(); ++k) {
                auto const& n = m.g.nodes()[k];
                used = used || (needed[k] && n.op == operation::constant &&
                                static_cast<std::size_t>(n.index) == own);
            }
            if (!used) throw bad_request("--gain " + name + ": the law does not use it");
        }
    }
    void use_recorded(std::string const& name) {
        auto const found = std::find_if(problem_.experiments.begin(), problem_.experiments.end(),
                                        [&](auto const& e) { return e.name == name; });
        if (found == problem_.experiments.end()) {
            throw bad_request("the data set has no scenario " + in_quotes(name) +
                              " of the role fit; it has: " + joined_names(problem_.experiments) +
                              ". For another motion write a scenario file (sivid-scenario-1)");
        }
        scenario_ = found->name;
        about_ = "As recorded in " + dataset_ + ".";
        request_.initial = found->initial;
        request_.inputs = found->inputs;
        for (auto const& m : found->measurements) request_.end = std::max(request_.end, m.time);
    }

    decision_command const& command_;
    stored_identification stored_;
    identification_problem problem_;
    prediction_request request_;
    std::string dataset_, scenario_, about_;
    std::optional<scenario_description> described_; ///< unless it is one of the data
    std::size_t own_inputs_ = 0;                    ///< those before disturbances
    std::vector<varied_input> varied_;
    std::optional<recorded_model> further_; ///< with effects of the scenario
    std::optional<closed_model> closed_;    ///< with a law
    std::map<std::string, interval> gains_;
    std::map<std::string, double> sensors_;
};

/// @param cells  of the grid in time, at least; `verify` refines it where a verdict hangs on it
inline prediction_options options_for(decision_command const& c, double seconds,
                                      std::size_t cells = 120) {
    prediction_options o;
    o.run = c.run;
    o.seconds = seconds;
    o.cells = cells;
    o.keep_going = wanted;
    return o;
}

/// A task with what is asked of it. The folder is prepared once all of the input is good.
struct question {
    decision_task task;
    recorded_model model;
    requirement asked;
    std::unique_ptr<stored_prediction> about;

    question(robot const& r, decision_command const& c) : task(r, c), model(task.model()) {
        asked = parse_requirement(task.requirement(), model, task.end());
        about = task.prediction_for(model, asked.margins);
    }
    question(question const&) = delete;
    question& operator=(question const&) = delete;
};

/// The lines of a page: least squares, and a single motion.
inline void add_lines(report::decision_page_options& o, decision_task const& task,
                      stored_prediction const& about, std::vector<node_id> const& margins,
                      double seconds) {
    auto const start = mid(about.direct.initial);
    if (auto const p = task.least_squares(about, seconds))
        o.least_squares = task.simulated(about, margins, *p, start);
    if (auto const p = task.witness(about)) o.single = task.simulated(about, margins, *p, start);
}

} // namespace detail

} // namespace sivid::app

#endif
