// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_IDENTIFY_IPP
#define SIVID_APP_IMPL_IDENTIFY_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/console.hpp>
#include <sivid/app/detail/bounds_output.hpp>
#include <sivid/app/detail/identification_output.hpp>
#include <sivid/app/detail/posed_problem.hpp>
#include <sivid/app/program.hpp>
#include <sivid/app/ranks.hpp>
#include <sivid/diagnosis/identify_remembering.hpp>
#include <sivid/io/checkpoint.hpp>
#include <sivid/io/checkpoint_reader.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/paving/bound_influence.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/online_identification.hpp>
#include <sivid/paving/outlier_budget.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace sivid::app {

namespace detail {

/// Algorithm 1 of the report allows no outlier.
inline identification_problem without_outliers(identification_problem problem) {
    for (auto& e : problem.experiments) e.outliers = 0;
    return problem;
}

inline std::string words_of(std::string const& algorithm) {
    if (algorithm == "report-1") return "Algorithm 1 of the report";
    if (algorithm == "report-2") return "Algorithm 2 of the report";
    return "contraction (default)";
}

/// The search's file in the folder of results.
class checkpoint_file {
public:
    /// @throws bad_request, input_error  when what is there must not be overwritten or cannot be
    ///         resumed
    checkpoint_file(identify_command const& c, std::string problem)
        : file_{c.out / "checkpoint.txt"},
          problem_{std::move(problem)},
          used_{c.checkpoint || c.resume} {
        bool const there = std::filesystem::exists(file_);
        if (there && c.resume) {
            state_ = std::make_shared<identification_state const>(read_checkpoint(file_, problem_));
        } else if (there && c.checkpoint) {
            throw bad_request(file_.string() + " holds an unfinished search; add --resume to go "
                                               "on with it, or remove it to begin anew");
        }
    }
    [[nodiscard]] bool used() const { return used_; }
    [[nodiscard]] std::shared_ptr<identification_state const> const& state() const {
        return state_;
    }
    /// A disk that is full must not end the search: it is said once.
    void save(identification_state const& now) {
        try {
            write_checkpoint(file_, now, problem_);
        } catch (output_error const& e) {
            if (!warned_) notice_stream() << "warning: no checkpoint: " << e.what() << "\n";
            warned_ = true;
        }
    }
    /// What to do with it once the results are written.
    void finish(stop_reason why) const {
        if (!used_) return;
        if (is_complete(why)) {
            std::error_code ignored;
            std::filesystem::remove(file_, ignored);
        } else if (std::filesystem::exists(file_)) {
            result_stream() << "  to go on from here: --resume and a larger budget\n";
        }
    }

private:
    std::filesystem::path file_;
    std::string problem_;
    bool used_ = false;
    bool warned_ = false;
    std::shared_ptr<identification_state const> state_;
};

/// What is known where the search for the fewest outliers ended before it found a parameter.
inline identification nothing_known(identification_problem const& problem) {
    identification result(problem.prior);
    result.paving.add(problem.prior, box_verdict::pending);
    result.reason = interrupted() ? stop_reason::cancelled : stop_reason::time_budget;
    result.assumptions.push_back(input_assumption(problem.experiments));
    return result;
}

inline bool several(command const& c) { return c.job != nullptr && c.job->several(); }
inline bool helps(command const& c) { return c.job != nullptr && c.job->helps(); }

/// By all ranks; nothing on those that help. @param shared  what sharing took, for people
inline std::optional<identification> identified(identify_command const& c,
                                                identification_problem const& problem,
                                                identify_options const& options,
                                                std::string const& digest, std::string& shared) {
    if (!several(c)) return identify(problem, options);
    cluster::traffic spent;
    auto found = c.job->all().identify(problem, options, digest, spent);
    shared = "  " + std::to_string(c.job->size()) + " ranks: " + std::to_string(spent.requests) +
             " requests, " + std::to_string(spent.messages) + " messages, " +
             nearest_text(1e-6 * static_cast<double>(spent.bytes_sent + spent.bytes_received), 3) +
             " MB, " + nearest_text(spent.worked, 3) + " s of work in " +
             nearest_text(spent.asking, 3) + " s\n";
    return found;
}

/// Whether something is asked for that needs a search of boxes.
inline bool asks_for_more(identify_command const& c) {
    return c.compare || c.verdict_only || c.checkpoint || c.resume || c.fewest_outliers ||
           c.identifiability || c.by_bounds || several(c) || c.algorithm != "contracting" ||
           !is_usual(c.how) || c.accuracy || c.memory;
}
/// Slice by slice.
inline identification remembered(remembering_problem const& p, identify_options const& options) {
    effect_hull_options slices;
    slices.seconds = options.search.seconds;
    slices.boxes = std::min(slices.boxes, options.search.boxes);
    slices.keep_going = options.search.keep_going;
    slices.test.workers = options.search.workers;
    return identify_remembering(p.base, p.effects, slices);
}

/// One run of `identify`.
class identifying {
public:
    identifying(robot const& r, identify_command const& c)
        : command_{c},
          task_(r, c, &remembering_),
          progress_(c.quiet || helps(c)),
          limit_(0, wanted) {
        auto& problem = task_.problem;
        if (c.algorithm == "report-1") problem = without_outliers(std::move(problem));
        if (c.compare && c.by_bounds)
            throw bad_request("--compare and --by-bounds both spend what the search leaves of the "
                              "budget: give one of them");
        if (remembering_ && asks_for_more(c))
            throw bad_request(
                "effects that delay, a backlash or a rate limit, and lags that begin where "
                "other effects say, are identified slice by slice, by one process: give a budget "
                "and no other options of a search");
        if (remembering_)
            task_.further = task_.data.assumptions; // it says itself what they rest on
    }

    [[nodiscard]] int operator()() {
        if (!helps(command_)) prepare_folder(command_.out);
        // From here on the first Ctrl-C ends whatever is going on, and what is proved is written.
        if (command_.job != nullptr) {
            command_.job->watch_interrupts();
        } else {
            watch_interrupts();
        }
        budget_ = task_.budget_of_search();
        limit_ = work_limit(budget_, wanted);
        set_options();
        count_outliers();
        options_.search.batches = command_.batches; // whatever the threads: one result
        std::string shared;                         // how the ranks shared the work
        if (helps(command_)) {
            (void)identified(command_, task_.problem, options_, task_.digest, shared);
            return done;
        }
        options_.search.workers = threads_for(command_.threads);
        checkpoint_file checkpoint(command_,
                                   command_.checkpoint || command_.resume
                                       ? problem_digest(task_.problem, options_, task_.digest)
                                       : std::string{});
        use(checkpoint);
        auto const found = search(shared);
        identification_output output(task_, found, limit_);
        output.title_of_command = words_of(command_.algorithm);
        compare(output);
        output.draws_motion = !remembering_;
        bool const whole = output.write();
        output.print();
        weigh_bounds();
        result_stream() << shared;
        checkpoint.finish(found.reason);
        return whole ? exit_code_of(found.verdict) : static_cast<int>(bad_input);
    }

private:
    void set_options() {
        auto const& c = command_;
        auto& search = options_.search;
        apply(c.how, options_.test);
        search.accuracy = c.accuracy.value_or(0.003);
        if (c.accuracy) search.sufficient_ratio = 1;
        if (c.boxes) search.boxes = *c.boxes;
        if (c.verdict_only) search.sufficient_ratio = 1e-300; // any inside box will do
        if (c.algorithm != "contracting") options_ = by_bisection(std::move(options_));
        search.seconds = (c.compare ? 0.6 : c.by_bounds ? 0.4 : 1.0) * budget_;
        search.keep_going = wanted;
        search.progress = [this](paving_progress const& p) {
            progress_.show(paving_words(p));
            // No more boxes than can be written in what is left of the budget.
            auto const rows = static_cast<double>(p.pending) + static_cast<double>(p.tested) / 3;
            full_ = limit_.seconds() < search_task::writing_a_box * rows;
            return !full_;
        };
        if (c.memory) search.memory = static_cast<std::size_t>(1e6 * *c.memory);
    }

    /// The fewest outliers, where they are asked for: the search is with these.
    void count_outliers() {
        if (!command_.fewest_outliers || helps(command_)) return;
        progress_.note(task_.title + ": how many outliers are needed");
        outlier_search_options least;
        least.seconds = 0.5 * budget_;
        least.memory = options_.search.memory;
        least.keep_going = wanted;
        fewest_ = smallest_outlier_budget(task_.problem, least);
        for (std::size_t e = 0; e < task_.problem.experiments.size(); ++e)
            task_.problem.experiments[e].outliers = fewest_->budgets[e];
        options_.search.seconds = std::max(0.0, options_.search.seconds - fewest_->seconds);
    }

    void use(checkpoint_file& checkpoint) {
        options_.resume = checkpoint.state();
        if (checkpoint.used()) {
            options_.search.checkpoint_seconds = command_.checkpoint.value_or(10);
            options_.checkpoint = [&](identification_state const& s) { checkpoint.save(s); };
        }
        if (auto const& s = options_.resume) {
            progress_.note("resuming after " + std::to_string(s->search.tested) + " boxes and " +
                           report::duration_text(s->seconds + s->search.seconds));
        } else if (command_.resume) {
            notice_stream() << "warning: no checkpoint in " << command_.out.string()
                            << ": beginning anew\n";
        }
    }

    [[nodiscard]] identification search(std::string& shared) {
        progress_.note("identifying " + task_.title + " (" + words_of(command_.algorithm) +
                       ", at most " + report::duration_text(options_.search.seconds) +
                       "; Ctrl-C stops early)");
        // Without a witness any number of outliers may be needed: there is nothing to invert.
        auto found = remembering_ ? remembered(*remembering_, options_)
                     : fewest_ && !fewest_->witness
                         ? nothing_known(task_.problem)
                         : *identified(command_, task_.problem, options_, task_.digest, shared);
        progress_.finish();
        name_reason(found);
        if (!fewest_) return found;
        found.fewest = *fewest_;
        if (!found.witness && fewest_->witness) { // of the same budgets
            found.witness = fewest_->witness;
            found.verdict = verdict::consistent;
        }
        return found;
    }

    /// A search that ended because the rest of the time is for writing has spent its budget.
    void name_reason(identification& of) const {
        if (!full_ || of.reason != stop_reason::cancelled || interrupted()) return;
        of.reason = stop_reason::time_budget;
        if (of.effort) of.effort->most_seconds = of.effort->seconds;
    }

    /// The same by Algorithm 1 of the report, where that is asked for.
    void compare(identification_output& output) {
        if (!command_.compare || interrupted()) return;
        auto other = by_bisection(options_);
        other.search.seconds = limit_.seconds();
        other.checkpoint = nullptr;
        other.resume = nullptr;
        progress_.note("the same by Algorithm 1 of the report, for comparison");
        output.baseline = identify(without_outliers(task_.problem), other);
        name_reason(*output.baseline);
        progress_.finish();
    }

    /// What other error bounds would leave: in lines, and in bounds.csv.
    void weigh_bounds() {
        std::error_code none;
        std::filesystem::remove(command_.out / "bounds.csv", none); // of an earlier result
        if (!command_.by_bounds || interrupted()) return;
        auto how = options_;
        how.search.seconds = limit_.seconds();
        how.checkpoint = nullptr;
        how.resume = nullptr;
        progress_.note("half and twice the error bounds");
        auto const lines = influence_of_bounds(task_.problem, {0.5, 2}, how);
        progress_.finish();
        write_durably(command_.out / "bounds.csv", bounds_csv(task_.problem, lines));
        result_stream() << bounds_text(task_.problem, lines);
    }

    identify_command const& command_;
    std::optional<remembering_problem> remembering_;
    search_task task_;
    progress_line progress_;
    work_limit limit_;
    identify_options options_;
    std::optional<smallest_budget> fewest_;
    double budget_ = 0; ///< [s] of the search
    bool full_ = false;
};

inline void print_update(double time, online_update const& now,
                         identification_problem const& problem) {
    result_stream() << "  t = " << report::given_text(time) << " " << problem.model.about.time_unit
                    << ", " << now.samples << " samples, " << report::duration_text(now.seconds)
                    << ": " << to_string(now.verdict);
    for (std::size_t j = 0; j < now.hull.size() && now.live > 0; ++j)
        result_stream() << ", " << problem.choice.unknown[j] << " "
                        << report::outward_text(now.hull[j]);
    for (auto const& c : now.combinations)
        result_stream() << ", " << c.what.formula << " " << report::outward_text(c.hull);
    if (now.integrations > 0)
        result_stream() << " (" << now.integrations << " runs from the begin)";
    result_stream() << std::endl; // as it happens
}

/// Feeds the measurements of a problem in the order of their times, those of one time together, and
/// prints a line for each update: the time of the samples, how long the update took, what is known
/// then. When the limit is reached the measurements that are left come all at once, so that the
/// result is of all of them.
[[nodiscard]] inline identification identify_online(identification_problem problem,
                                                    online_options options, work_limit limit) {
    options.test = limited(std::move(options.test), limit);
    std::vector<online_sample> samples;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        for (auto const& m : std::exchange(problem.experiments[e].measurements, {}))
            samples.push_back({e, m});
    }
    std::stable_sort(samples.begin(), samples.end(),
                     [](auto const& a, auto const& b) { return a.what.time < b.what.time; });
    online_identification online(std::move(problem), options);
    double longest = 0, total = 0;
    std::size_t updates = 0;
    std::optional<stop_reason> cut;
    for (auto from = samples.begin(); from != samples.end();) {
        double time = from->what.time;
        if (!limit()) {
            // What is said at the end is of all measurements: the others come together.
            cut = interrupted() ? stop_reason::cancelled : stop_reason::time_budget;
            result_stream() << "  " << to_string(*cut) << ": the other " << samples.end() - from
                            << " measurements at once" << std::endl;
            limit.allow(0.4);
            time = samples.back().what.time;
        }
        auto const until = std::find_if(from, samples.end(),
                                        [&](auto const& s) { return !cut && s.what.time != time; });
        auto const& now = online.add({from, until});
        print_update(time, now, online.problem());
        longest = std::max(longest, now.seconds);
        total += now.seconds;
        ++updates;
        from = until;
    }
    result_stream() << "  " << updates << " updates, the longest took "
                    << report::duration_text(longest) << ", all together "
                    << report::duration_text(total) << std::endl;
    auto found = online.result();
    if (cut && found.verdict != verdict::inconsistent) found.reason = *cut;
    return found;
}

} // namespace detail

SIVID_DECL int run(robot const& r, identify_command const& c) {
    return detail::identifying(r, c)();
}

SIVID_DECL int run(robot const& r, online_command const& c) {
    detail::search_task const task(r, c, nullptr);
    prepare_folder(c.out);
    watch_interrupts();
    progress_line progress(c.quiet);
    work_limit limit(task.budget_of_search(), wanted);
    online_options options;
    apply(c.how, options.test);
    if (c.accuracy) {
        options.refinement.accuracy = *c.accuracy;
        options.refinement.sufficient_ratio = 1;
    }
    if (c.boxes) options.refinement.boxes = *c.boxes;
    progress.note(task.title + ", measurement by measurement");
    auto const found = detail::identify_online(task.problem, options, limit);
    progress.finish();
    detail::identification_output output(task, found, limit);
    bool const whole = output.write();
    output.print();
    return whole ? detail::exit_code_of(found.verdict) : static_cast<int>(bad_input);
}

} // namespace sivid::app

#endif
