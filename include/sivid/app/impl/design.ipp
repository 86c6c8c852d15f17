// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_DESIGN_IPP
#define SIVID_APP_IMPL_DESIGN_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/detail/decision_task.hpp>
#include <sivid/app/impl/decide.ipp>
#include <sivid/decision/experiment_design.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/io/decision_json.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/model/manoeuvre.hpp>
#include <sivid/report/decision_page.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/stored_page.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sivid::app {

namespace detail {

/// Whether all that can be told is to be narrowed down together.
/// @throws bad_request
inline bool volume_asked(decision_command const& c) {
    bool const volume = std::find(c.goal.begin(), c.goal.end(), "volume") != c.goal.end();
    if (volume && c.goal.size() > 1)
        throw bad_request("--halve volume is of all parameters: give it alone");
    return volume;
}

/// A result with what is asked of its motions.
struct design_side {
    decision_task task;
    recorded_model model;
    requirement limits;
    std::vector<design_goal> goals;
    std::unique_ptr<stored_prediction> about;

    design_side(robot const& r, decision_command const& c) : task(r, c), model(task.model()) {
        if (!c.requirement.empty()) limits = parse_requirement(c.requirement, model, task.end());
        auto nodes = limits.margins;
        if (volume_asked(c)) {
            goals = all_goals(model, task.data().choice);
        } else {
            for (auto const& text : c.goal) goals.push_back(parse_goal(text, model));
        }
        for (auto const& g : goals) nodes.push_back(g.value);
        about = task.prediction_for(model, nodes);
    }
    design_side(design_side const&) = delete; // the task refers to its command
    design_side& operator=(design_side const&) = delete;

    [[nodiscard]] requirement const* asked() const {
        return limits.text.empty() ? nullptr : &limits;
    }
};

/// The other result that an experiment is to tell from the first; nothing where none is given.
/// @param other  the command for it, which it refers to
inline std::unique_ptr<design_side> rival_of(design_side const& one, robot const& r,
                                             decision_command const& c, decision_command& other) {
    if (c.against.empty() && c.goal.empty())
        throw bad_request("say what the experiment is for: give --halve or --against");
    if (c.against.empty()) return nullptr;
    other = c;
    other.result = c.against;
    auto two = std::make_unique<design_side>(r, other);
    if (two->task.dataset() != one.task.dataset())
        throw bad_request("--against: the two results are of different data sets");
    // The answer rests on both.
    for (auto const& text : two->about->assumptions) {
        auto& all = one.about->assumptions;
        if (std::find(all.begin(), all.end(), text) == all.end())
            all.push_back(text + " (with " + two->task.effects() + ")");
    }
    return two;
}

/// `design`: the search for one experiment, then its page, its file and its words.
class designing {
public:
    designing(robot const& r, decision_command const& c)
        : command_{c},
          one_(r, c),
          two_(rival_of(one_, r, c, other_)),
          names_(names_of(r.model.about)) {
        answer_.target = c.target;
        answer_.jointly = volume_asked(c);
        answer_.limits = c.requirement;
        answer_.plan = planned_from(c.measure, c.period, one_.task.end(), one_.task.data());
        answer_.varied = one_.task.varied();
        answer_.goals = one_.goals;
        if (two_) {
            answer_.first = one_.task.effects();
            answer_.second = two_->task.effects();
        }
        for (auto const& g : answer_.goals) {
            auto const instead = hidden_behind(one_.model, one_.about->direct.choice, g);
            if (!instead || answer_.impossible) continue;
            answer_.hidden = g.text;
            answer_.instead = *instead;
            answer_.impossible = !answer_.jointly && untold_share_of(g) > c.target;
        }
    }

    [[nodiscard]] int operator()() {
        if (!command_.out.empty()) prepare_folder(command_.out);
        watch_interrupts();
        progress_line progress(command_.quiet);
        progress.note("an experiment after " + one_.task.dataset());
        auto page = one_.task.page_options();
        std::optional<prediction> tubes;
        if (!answer_.impossible) {
            search();
            if (found()) follow(progress, page, tubes);
        }
        progress.finish();
        if (!command_.out.empty()) write(page, tubes);
        print();
        return answer_.impossible ? refuted : answer_.met() ? done : undecided;
    }

private:
    /// How much of its width a hidden goal keeps, whatever is measured: where the witness is proved
    /// to explain the data, and the scenario has their constants.
    [[nodiscard]] double untold_share_of(design_goal const& goal) const {
        auto const& about = *one_.about;
        auto const witness = one_.task.witness(about);
        bool const proved = witness && command_.set.empty() && about.feasible.proved &&
                            about.feasible.proved(*witness);
        return proved ? untold_share(about.problem, about.direct, *witness, goal) : 0;
    }
    /// An experiment to show: between two models only one that does what was asked.
    [[nodiscard]] bool found() const {
        return answer_.found.best() != nullptr && (answer_.met() || !two_);
    }

    void search() {
        auto const& problem = one_.about->problem;
        auto const menu = manoeuvre_shapes(answer_.varied, problem.inputs, mid(problem.initial),
                                           problem.end, problem.model.about.time_unit);
        design_options options;
        options.seconds = 0.8 * command_.budget;
        options.target = answer_.jointly ? std::pow(command_.target,
                                                    1.0 / static_cast<double>(answer_.goals.size()))
                                         : command_.target;
        options.keep_going = wanted;
        options.run = command_.run;
        answer_.found = two_ ? design_separation(problem, two_->about->problem, menu, answer_.plan,
                                                 one_.asked(), two_->asked(), options)
                             : design_experiment(problem, menu, answer_.plan, answer_.goals,
                                                 one_.asked(), options);
    }

    /// The motions of the experiment that was found.
    void follow(progress_line const& progress, report::decision_page_options& page,
                std::optional<prediction>& tubes) {
        auto const& task = one_.task;
        auto& about = *one_.about;
        auto const* const best = answer_.found.best();
        about.problem = about.problem.under(best->inputs);
        about.direct = about.direct.under(best->inputs);
        if (task.described())
            scenario_ =
                scenario_with(*task.described(), command_.name, report::design_sentence(answer_),
                              answer_.varied, best->inputs, names_);
        double const left = std::max(0.2, command_.budget - progress.elapsed());
        if (command_.out.empty()) return;
        tubes = task.predicted(about, options_for(command_, 0.5 * left), {});
        add_lines(page, task, about, {}, 0.3 * left);
    }

    void write(report::decision_page_options const& page,
               std::optional<prediction> const& tubes) const {
        file_set files(command_.out);
        report::design_page(*one_.about, answer_, tubes, page).add_to(files);
        auto options = one_.task.json_options();
        if (two_) options.against_digest = two_->task.json_options().source_digest;
        files.add("design.json", design_json(*one_.about, answer_, options));
        if (scenario_) files.add("scenario.json", *scenario_);
        files.commit();
    }

    void print() const {
        result_stream() << one_.task.scenario() << ", " << one_.task.dataset() << ": "
                        << report::design_headline(answer_) << "\n";
        if (found()) {
            auto const* const best = answer_.found.best();
            result_stream() << "  " << best->name;
            for (std::size_t k = 0; k < best->settings.size(); ++k)
                result_stream() << (k == 0 ? ": " : ", ") << best->about[k].name << " "
                                << report::given_text(best->settings[k]);
            result_stream() << "\n";
        }
        result_stream() << "  " << report::design_sentence(answer_) << "\n";
        print_end(*one_.about,
                  report::duration_text(answer_.found.seconds) + ", " +
                      std::to_string(answer_.found.simulated) + " settings, " +
                      std::to_string(answer_.found.integrations),
                  command_,
                  (command_.out / "design.html").string() + " and design.json" +
                      (scenario_ ? ", scenario.json" : ""));
    }

    decision_command const& command_;
    decision_command other_; ///< of the second side
    design_side one_;
    std::unique_ptr<design_side> two_;
    model_names names_;
    design_answer answer_;
    std::optional<std::string> scenario_;
};

} // namespace detail

SIVID_DECL int run(robot const& r, decision what, decision_command const& c) {
    switch (what) {
    case decision::predict:
        return detail::run_predict(r, c);
    case decision::verify:
        return detail::run_verify(r, c);
    case decision::control:
        return detail::run_control(r, c);
    case decision::design:
        break;
    }
    return detail::designing(r, c)();
}

} // namespace sivid::app

#endif
