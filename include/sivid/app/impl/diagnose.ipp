// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_DIAGNOSE_IPP
#define SIVID_APP_IMPL_DIAGNOSE_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/console.hpp>
#include <sivid/app/detail/identification_output.hpp>
#include <sivid/app/detail/other_answers.hpp>
#include <sivid/app/detail/posed_problem.hpp>
#include <sivid/app/program.hpp>
#include <sivid/app/ranks.hpp>
#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/io/diagnosis_json.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/problem_text.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/reduction.hpp>
#include <sivid/paving/strategy/prior_contractor.hpp>
#include <sivid/report/diagnosis_page.hpp>
#include <sivid/report/diagnosis_words.hpp>
#include <sivid/report/stored_page.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace sivid::app {

namespace detail {

inline std::vector<report::missing_rate>
missing_rates(place_estimate const& places, std::vector<relation_finding> const& findings,
              std::string const& time_unit) {
    std::vector<report::missing_rate> result;
    for (auto const& p : places.places) {
        if (p.kind == place_kind::sensor) continue;
        for (auto const& r : p.rates) {
            report::channel_series d{.unit = p.unit, .time_unit = time_unit};
            for (std::size_t k = 0; k < r.times.size(); ++k) {
                double const v = r.values[k], off = r.deviations[k];
                d.after.push_back({r.times[k], v});
                d.band.push_back({r.times[k], r.times[k], {v - off, v + off}});
            }
            for (auto const& f : findings) {
                if (f.name != p.name || !f.place || !f.place->missing) continue;
                auto const& [window, value, unit] = *f.place->missing;
                if (window.scenario != r.scenario) continue;
                d.windows.push_back({window.from, window.to, value});
            }
            result.push_back({p.name, r.scenario, std::move(d)});
        }
    }
    return result;
}

/// A value with its unit.
inline std::string value_words(named_estimate const& e) {
    return e.name + " = " + report::rounded_text(e.value, report::rounding::nearest) +
           (e.unit.empty() || e.unit == "1" ? "" : " " + e.unit);
}

/// The effects' parameters of a cause: at the witness where it explains the data.
inline std::vector<named_estimate> stated_parameters(cause const& c) {
    auto result = c.parameters;
    if (c.verdict != cause_verdict::explains || !c.witness) return result;
    for (auto& p : result) {
        for (auto const& w : c.witness->parameters) {
            if (w.name == p.name) p.value = w.value;
        }
    }
    return result;
}

/// All constants of the model of the answer.
inline void print_constants(diagnosis const& d) {
    if (d.constants.empty()) return;
    bool const answered = d.answer == answer_kind::effects || d.answer == answer_kind::none;
    result_stream() << (d.constants_verified ? "  verified to explain the data:"
                        : answered           ? "  best fit (not proved):"
                                             : "  closest so far (not proved):");
    for (auto const& c : d.constants) result_stream() << " " << value_words(c);
    result_stream() << "\n";
}

/// Products that the data tell better than their factors.
inline void print_combinations(diagnosis const& d) {
    for (auto const& c : d.combinations) {
        auto const& p = c.about;
        result_stream() << "  told together: " << value_words(p) << ", within "
                        << report::outward_text(*p.hull) << " (proved)\n";
    }
}

/// When the effect of the answer begins and ends in each scenario in which it does so midway.
inline void print_times(diagnosis const& d) {
    if (d.answer != answer_kind::effects || d.causes.empty()) return;
    auto const print = [](char const* what, std::vector<named_estimate> const& times) {
        for (auto const& o : times) {
            bool const known = o.hull && o.prior && width(*o.hull) < width(*o.prior);
            result_stream() << what << value_words(o)
                            << (known ? ", within " + report::outward_text(*o.hull) + " " + o.unit +
                                            " (proved)"
                                      : std::string{"; no bound of it is proved"})
                            << "\n";
        }
    };
    print("  it begins in ", d.causes.front().onsets);
    print("  it ends in ", d.causes.front().ends);
}

/// Causes that say as much as the answer with less, which it does not name itself.
inline void print_other_answers(diagnosis const& d) {
    for (auto const* part : parts_that_explain(d))
        result_stream() << "  explains with fewer effects, proved later: "
                        << joined(part->effects, " + ") << "; see identify --with "
                        << joined(part->effects, ",") << "\n";
    if (auto const* closest = closest_without_switches(d))
        result_stream() << "  closest without times and places of its own: "
                        << joined(closest->effects, " + ") << ", with all bounds times "
                        << report::estimate_text(closest->fitted_inflation) << " (estimate)\n";
}

inline void print_holdout(diagnosis const& d, bool kept) {
    if (d.answer != answer_kind::effects || d.causes.empty()) return;
    if (!d.causes.front().holdout) {
        if (kept)
            result_stream() << "  held-out data: not judged, "
                            << (switches(d.effects)
                                    ? "nothing says when the effect acts there\n"
                                    : "no time was left for that or no run went through them\n");
        return;
    }
    auto const& h = *d.causes.front().holdout;
    result_stream() << "  inflation on the held-out data: "
                    << report::inflation_text(h.inflation_before) << " without it, "
                    << report::inflation_text(h.inflation_after) << " with it";
    if (d.shrink_holdout && std::isfinite(d.shrink_holdout->lower()))
        result_stream() << ": the gap shrinks by " << report::shrink_text(*d.shrink_holdout);
    if (d.shrink_over_fits && d.shrink_over_fits->lower() > 0)
        result_stream() << "; for every parameter that explains the other data, by "
                        << report::shrink_text(*d.shrink_over_fits);
    result_stream() << "\n";
}

/// "open: 8 of 36 candidates tried, no pair"
inline std::string answer_words(diagnosis const& d) {
    if (d.answer == answer_kind::effects) return joined(d.effects, " + ");
    auto const tried = report::tried_text(d.tried);
    return std::string{to_string(d.answer)} + (tried.empty() ? "" : ": " + tried);
}

/// Misfits, missing rates and trajectories for the page.
inline report::diagnosis_plot_data plot_data(diagnosis_run const& run, holdout const& kept) {
    report::diagnosis_plot_data data;
    if (run.candidates.empty()) return data;
    auto const& base = run.candidates.front();
    auto const& answer = run.candidates[run.answer];
    bool const improved = run.answer != 0;
    data.scenarios =
        report::compared_scenarios(run.base, base.fit, improved ? answer.fit : approximate_fit{});
    if (run.holdout_before) {
        auto more = report::compared_scenarios(
            kept.judged_by(base, run.base, run.catalogue), run.holdout_before->run,
            run.holdout_after ? run.holdout_after->run : approximate_fit{}, true);
        data.scenarios.insert(data.scenarios.end(), more.begin(), more.end());
    }
    auto const& time_unit = run.base.model.about.time_unit;
    data.missing_rates = missing_rates(run.places, run.findings, time_unit);
    data.remaining_rates = missing_rates(run.remaining_places, {}, time_unit);
    return data;
}

/// What a program ends with: undecided where candidates were left untried, or it was ended early.
inline exit_code exit_code_of(diagnosis const& d) {
    bool const early = d.interrupted || interrupted() || d.answer == answer_kind::open;
    return early ? undecided : done;
}

/// @param kept  whether data are held out
inline void print_summary(diagnosis const& d, std::string const& id,
                          std::filesystem::path const& out, bool kept) {
    result_stream() << id << ": gap " << to_string(d.gap) << ", inflation "
                    << (report::says_something(d.inflation) ? report::inflation_text(d.inflation)
                                                            : std::string{"not bounded"})
                    << "\n";
    for (auto const& words : report::view_of(d).why) result_stream() << "  " << words << "\n";
    for (auto const& c : d.confined) result_stream() << "  " << report::confined_clause(c) << "\n";
    for (auto const& p : d.where) {
        result_stream() << "  where: " << p.kind << " " << p.name << (p.proved ? " (proved)" : "")
                        << (p.law.empty() ? "" : ", like ") << p.law << "\n";
    }
    result_stream() << "  answer: " << answer_words(d);
    if (!d.causes.empty() && d.answer == answer_kind::effects) {
        result_stream() << " (" << to_string(d.causes.front().verdict) << ")";
        for (auto const& p : stated_parameters(d.causes.front())) {
            result_stream() << " " << value_words(p);
        }
    }
    result_stream() << "\n";
    print_other_answers(d);
    print_times(d);
    print_constants(d);
    print_combinations(d);
    for (auto const& e : d.at_ends) {
        result_stream() << "  " << report::end_words(e) << "\n";
    }
    if (d.remainder) {
        result_stream() << "  unexplained remainder: "
                        << (d.remainder->effects.empty()
                                ? std::string{"the model as it is"}
                                : "with " + joined(d.remainder->effects, " + "))
                        << ", inflation " << report::inflation_text(d.remainder->inflation) << "\n";
    }
    for (auto* const clauses : {&report::ladder_clauses, &report::disturbance_clauses})
        for (auto const& words : clauses(d)) result_stream() << "  " << words << "\n";
    for (auto const& other : d.indistinguishable) {
        result_stream() << "  not told apart from it: " << joined(other, " + ") << "\n";
    }
    print_holdout(d, kept);
    for (auto const& line : d.change.lines) result_stream() << "  in a simulator: " << line << "\n";
    if (exit_code_of(d) == undecided)
        result_stream() << "  ended early: what is open may be known with more time (--budget)\n";
    result_stream() << "  " << report::duration_text(d.seconds)
                    << (d.by_clock ? ", ended by the clock: a faster machine may say more" : "")
                    << "; written: " << (out / "report.html").string()
                    << " and diagnosis.json beside it\n";
}

/// Progress and Ctrl-C for a diagnosis. The line outlives it.
inline void watch(diagnosis_options& options, progress_line& progress) {
    options.test = limited(options.test, wanted);
    options.progress = [&progress](std::string const& what) {
        progress.show(what);
        return wanted();
    };
    options.first_sentence = [&progress](std::string const& text) { progress.note(text); };
}

/// The page's options.
inline report::diagnosis_report_options page_options(diagnosis_run const& run, std::string dataset,
                                                     std::string command) {
    report::diagnosis_report_options page;
    page.dataset = std::move(dataset);
    page.model = run.base.model.about.name;
    page.date = today();
    page.machine = machine_text();
    page.command = std::move(command);
    report::describe(run.catalogue, page);
    if (!run.candidates.empty()) page.base_fitted = run.candidates.front().figures.inflation;
    return page;
}

/// The scenarios of a campaign, made once more.
inline std::vector<manoeuvre> recorded_manoeuvres(identification_problem const& p) {
    std::vector<manoeuvre> result;
    for (auto const& e : p.experiments) {
        double last = e.begin;
        for (auto const& m : e.measurements) last = std::max(last, m.time);
        result.push_back(
            {"repeat " + e.name, last, mid(e.initial), {}, [inputs = e.inputs](auto const&) {
                 return inputs;
             }});
    }
    return result;
}

/// One run of `diagnose`.
class diagnosing {
public:
    diagnosing(robot const& r, diagnose_command const& c)
        : of_{r},
          command_{c},
          progress_(c.quiet || (c.job != nullptr && c.job->helps())),
          data_{read_data(r, c.dataset)},
          problem_{problem_from_dataset(data_, r.model)},
          effects_{chosen_effects(r.effects, data_)},
          title_{data_.id + (r.disturbances.empty() ? "" : ", disturbances left out")},
          kept_{holdout_from_dataset(data_, r.model.about)},
          options_{r.effort} {}

    [[nodiscard]] int operator()() {
        bool const helps = command_.job != nullptr && command_.job->helps();
        if (!helps) prepare_folder(command_.out);
        options_.seconds = of_.diagnosis_share * left();
        apply(command_.how, options_.test);
        options_.test.workers = threads_for(command_.threads);
        options_.menu = recorded_manoeuvres(problem_);
        options_.menu.insert(options_.menu.end(), of_.manoeuvres.begin(), of_.manoeuvres.end());
        for (auto const& words : creeping_words(problem_)) progress_.note(words);
        watch(options_, progress_);
        watch_interrupts();
        if (command_.job != nullptr) command_.job->watch_interrupts();
        auto found = diagnosed();
        if (!found) return done;
        for (auto& words : assumptions_of(of_, data_, {}, {}, problem_))
            found->result.assumptions.push_back(std::move(words));
        source_ = {seen_from(command_.out, command_.dataset), dataset_digest(command_.dataset),
                   problem_digest(problem_)};
        write(*found); // whatever happens to what follows
        remove_earlier_model();
        if (!kept_.empty() && left() > 0 && wanted()) {
            progress_.note("judging by the held-out data");
            auto const boxes = static_cast<std::size_t>(4 * command_.budget);
            judge_by_holdout(*found, kept_, std::min(left(), 0.25 * command_.budget), options_.test,
                             boxes);
            write(*found);
        }
        if (found->result.answer == answer_kind::unexplained && left() > 0 && wanted()) {
            progress_.note("how large a disturbance would explain the data");
            bound_disturbances(*found, std::min(left(), 0.25 * command_.budget), options_.test);
            write(*found);
        }
        progress_.finish();
        print_summary(found->result, title_, command_.out, !kept_.empty());
        bool const explained = found->result.answer == answer_kind::none ||
                               found->result.answer == answer_kind::effects;
        if (explained && left() > 0 && wanted()) bound_parameters(*found);
        return exit_code_of(found->result);
    }

private:
    [[nodiscard]] double left() const {
        return std::max(0.0, command_.budget - progress_.elapsed());
    }

    /// By all ranks; nothing on those that help.
    [[nodiscard]] std::optional<diagnosis_run> diagnosed() const {
        if (command_.job != nullptr && command_.job->several())
            return command_.job->all().diagnose(problem_, effects_, options_,
                                                dataset_digest(command_.dataset));
        return diagnose(problem_, effects_, options_);
    }

    /// diagnosis.json and report.html with its data, all or none.
    void write(diagnosis_run const& run) const {
        auto const page = report::stored(report::view_of(
            run.result, plot_data(run, kept_), page_options(run, title_, command_.command_line)));
        file_set files(command_.out);
        files.add("diagnosis.json", diagnosis_json(run.result, data_.id, source_));
        page.add_to(files);
        files.commit();
    }

    /// Another diagnosis may have had another answer.
    void remove_earlier_model() const {
        for (auto const* name : {"report.html", "report.page.json", "result.json"}) {
            std::error_code none;
            std::filesystem::remove(command_.out / "model" / name, none);
        }
    }

    /// What is tried before the search: first the ranges that the diagnosis has proved, where they
    /// are of the same model and these data, or a part of them.
    [[nodiscard]] static strategy with_ranges(diagnosis_run const& run,
                                              identification_problem const& problem) {
        auto result = default_strategy();
        auto const& known = run.answer_hull;
        auto const effects = holdout::effects_of(run.candidates[run.answer], run.catalogue);
        auto const of = affected(run.base, effects);
        auto part = problem;
        std::erase_if(part.experiments, [&](experiment const& e) {
            return std::ranges::find(of.experiments, e.name, &experiment::name) ==
                   of.experiments.end();
        });
        if (known.parameters.size() == 0 || problem_text(part) != problem_text(of)) return result;
        auto const map = coordinates_of(problem);
        auto const box = map ? map->forward(known.parameters, known.products) : known.parameters;
        auto const within = [box](auto const& posed, auto const&) {
            return intersect(posed.prior, box);
        };
        auto first = std::make_shared<prior_contractor>("ranges of the diagnosis", within);
        auto const why = [](inquiry&) { return strategy::promise{true, "see diagnosis.json"}; };
        result.steps.insert(result.steps.begin(), {.by = {std::move(first)}, .when = why});
        return result;
    }

    /// The ranges of all parameters of the model that explains the data, as `identify` writes them,
    /// in the folder model.
    void bound_parameters(diagnosis_run const& run) {
        auto const& answer = run.candidates[run.answer];
        auto const& problem = answer.problem;
        if (problem.model.has_memory() || starts_follow_parameters(problem)) {
            result_stream() << "  ranges of its parameters: not proved, "
                            << (problem.model.has_memory()
                                    ? "the model has a delay, a play or a rate limit\n"
                                    : "the effects begin where their parameters say\n");
            return;
        }
        search_command told;
        told.out = command_.out / "model";
        told.command_line = command_.command_line;
        told.dataset = command_.dataset;
        told.effects = names_in(holdout::effects_of(answer, run.catalogue));
        told.verbose = command_.verbose;
        told.quiet = true; // what it would note is said already
        auto bare = of_;
        bare.disturbances = {};
        search_task task(bare, told, nullptr);
        work_limit limit(std::min(left(), 0.25 * command_.budget), wanted);
        identify_options options;
        options.strategy = with_ranges(run, task.problem);
        options.search.seconds = limit.seconds();
        options.search.keep_going = wanted;
        options.search.progress = [this](auto const& p) {
            progress_.show(paving_words(p));
            return true;
        };
        auto const found = identify(task.problem, options);
        progress_.finish();
        identification_output output(task, found, limit);
        prepare_folder(told.out);
        static_cast<void>(output.write());
        result_stream() << "  ranges of all parameters (proved: none outside explains the data):\n";
        print_ranges(output.view(), "    ");
        auto const wide = [](auto const& p) {
            return p.hull.lo <= p.prior.lo && p.prior.hi <= p.hull.hi;
        };
        if (found.reason == stop_reason::time_budget &&
            std::any_of(output.view().parameters.begin(), output.view().parameters.end(), wide))
            result_stream() << "    " << to_string(found.reason)
                            << ": a larger --budget, or identify --with these effects, may narrow "
                               "them\n";
        if (command_.verbose) print_tried(output.view().tried);
        result_stream()
            << "  written: " << told.out.string()
            << ": its report.html, and what check, predict, verify, control and design take\n";
    }

    robot const& of_;
    diagnose_command const& command_;
    progress_line progress_; ///< its clock is that of the budget
    dataset data_;
    identification_problem problem_;
    std::vector<effect> effects_;
    std::string title_; ///< what is missing is sought in the model without its disturbances
    holdout kept_;
    diagnosis_options options_;
    diagnosis_source source_;
};

} // namespace detail

SIVID_DECL int run(robot const& r, diagnose_command const& c) { return detail::diagnosing(r, c)(); }

} // namespace sivid::app

#endif
