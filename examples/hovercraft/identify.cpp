// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "console/console.hpp"
#include "console/program.hpp"
#include "console/ranks.hpp"
#include "console/result_files.hpp"
#include "console/threads.hpp"
#include "identifiability.hpp"
#include "online.hpp"
#include "posed_problem.hpp"

#ifdef SIVID_HAS_MPI
#include <sivid/cluster/identify.hpp>
#include <sivid/number/text/joined.hpp>
#endif
#include <sivid/diagnosis/identify_remembering.hpp>
#include <sivid/io/checkpoint.hpp>
#include <sivid/io/checkpoint_reader.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/io/identification_json.hpp>
#include <sivid/io/result/problem_digest.hpp>
#include <sivid/io/text/durable_file.hpp>
#include <sivid/paving/outlier_budget.hpp>
#include <sivid/report/draw/time_plot.hpp>
#include <sivid/report/identification_page.hpp>
#include <sivid/report/identification_report.hpp>
#include <sivid/report/identification_words.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <utility>

namespace hovercraft_example {

namespace {

/// Algorithm 1 of the report allows no outlier.
sivid::identification_problem without_outliers(sivid::identification_problem problem) {
    for (auto& e : problem.experiments) e.outliers = 0;
    return problem;
}

std::string words_of(std::string const& algorithm) {
    if (algorithm == "report-1") return "Algorithm 1 of the report";
    if (algorithm == "report-2") return "Algorithm 2 of the report";
    return "contraction (default)";
}

void print_summary(sivid::identification_problem const& problem, sivid::identification const& found,
                   std::string const& id, std::filesystem::path const& out, bool verbose) {
    namespace report = sivid::report;
    auto const view = report::view_of(problem, found, nullptr, {.dataset = id});
    std::cout << id << ": " << to_string(found.verdict) << " (" << to_string(found.reason) << ")\n";
    for (auto const& words : sivid::derivation_words(problem.model, problem.choice))
        std::cout << "  " << words << "\n";
    if (found.verdict == sivid::verdict::inconsistent)
        std::cout
            << "  no parameter in the prior explains the data: all of it is excluded by proof\n";
    for (auto const& p : view.parameters) {
        if (report::is_empty(p.hull)) continue;
        std::cout << "  " << p.name << " in " << report::outward_text_within(p.hull, p.prior) << " "
                  << p.unit;
        auto const note = report::exclusion_note(view, p);
        if (!note.empty()) std::cout << "  (" << note << ")";
        std::cout << "\n";
    }
    for (auto const& c : view.combinations)
        std::cout << "  " << report::formula_text(c.formula) << " in "
                  << report::outward_text(c.hull) << " " << c.unit << "\n";
    std::vector<std::string> combined, idle;
    for (auto const j : found.entangled) {
        bool const stands = std::any_of(found.combinations.begin(), found.combinations.end(),
                                        [j](auto const& c) { return c.what.exponents[j] != 0; });
        (stands ? combined : idle).push_back(problem.choice.unknown[j]);
    }
    if (!combined.empty())
        std::cout << "  " << sivid::enumeration(combined)
                  << " are only known through such combinations on these data\n";
    for (auto const& name : idle)
        std::cout << "  " << name << " stands nowhere in the equations of these data\n";
    std::cout << "  of the prior's volume: inside at least "
              << report::at_least_percent(view.volume_inner.lo) << ", not excluded at most "
              << report::at_most_percent(view.volume_outer.hi) << "\n";
    if (!view.inside_box.empty()) std::cout << "  explained by all of " << view.inside_box << "\n";
    if (found.witness) {
        std::cout << "  verified witness:";
        for (std::size_t j = 0; j < problem.choice.unknown.size(); ++j)
            std::cout << " " << problem.choice.unknown[j] << "="
                      << report::exact_text(found.witness->parameters[j]);
        std::cout << "\n";
    }
    if (!found.forced.empty()) {
        std::cout << "  proved outliers: " << found.forced.size();
        std::size_t const most = 6;
        for (std::size_t k = 0; k < std::min(most, found.forced.size()); ++k) {
            auto const& e = problem.experiments[found.forced[k].experiment];
            auto const m = sorted(e.measurements)[found.forced[k].measurement];
            std::cout << (k == 0 ? ": " : ", ") << e.name << " "
                      << problem.model.about.channels[m.channel].name << " at "
                      << report::given_text(m.time) << " " << problem.model.about.time_unit;
        }
        std::cout << (found.forced.size() > most ? ", ...\n" : "\n");
    }
    if (found.fewest) {
        std::cout << "  outliers needed: " << report::count_text(found.fewest->total.most);
        if (found.fewest->total.exact()) {
            std::cout << ", proved to be the fewest";
        } else {
            std::cout << " suffice, at least " << report::count_text(found.fewest->total.least)
                      << " by proof (" << to_string(found.fewest->reason) << ")";
        }
        for (auto const& e : problem.experiments) {
            if (e.outliers > 0) std::cout << "; " << e.name << " " << e.outliers;
        }
        std::cout << "\n";
    }
    if (verbose) console::print_tried(view.tried);
    for (auto const& words : view.statistics.why) std::cout << "  " << words << "\n";
    std::cout << "  " << report::duration_text(found.seconds);
    if (found.boxes > 0) // else nobody counted
        std::cout << ", " << found.boxes << " boxes, " << found.integrations
                  << " validated integrations";
    std::cout << "\n"
              << "  written: " << (out / "report.html").string()
              << " and result.json, boxes.csv, outputs.csv beside it\n";
}

/// The search's file in the folder of results.
class checkpoint_file {
public:
    /// @throws bad_request, sivid::input_error  when what is there must not be overwritten or
    ///         cannot be resumed
    checkpoint_file(identify_command const& c, std::string problem)
        : file_{c.out / "checkpoint.txt"},
          problem_{std::move(problem)},
          used_{c.checkpoint || c.resume} {
        bool const there = std::filesystem::exists(file_);
        if (there && c.resume) {
            state_ = std::make_shared<sivid::identification_state const>(
                sivid::read_checkpoint(file_, problem_));
        } else if (there && c.checkpoint) {
            throw bad_request(file_.string() + " holds an unfinished search; add --resume to go "
                                               "on with it, or remove it to begin anew");
        }
    }
    [[nodiscard]] bool used() const { return used_; }
    [[nodiscard]] std::shared_ptr<sivid::identification_state const> const& state() const {
        return state_;
    }
    /// A disk that is full must not end the search: it is said once.
    void save(sivid::identification_state const& now) {
        try {
            sivid::write_checkpoint(file_, now, problem_);
        } catch (sivid::output_error const& e) {
            if (!warned_) std::cerr << "warning: no checkpoint: " << e.what() << "\n";
            warned_ = true;
        }
    }
    /// What to do with it once the results are written.
    void finish(sivid::stop_reason why) const {
        if (!used_) return;
        if (is_complete(why)) {
            std::error_code ignored;
            std::filesystem::remove(file_, ignored);
        } else if (std::filesystem::exists(file_)) {
            std::cout << "  to go on from here: --resume and a larger budget\n";
        }
    }

private:
    std::filesystem::path file_;
    std::string problem_;
    bool used_ = false;
    bool warned_ = false;
    std::shared_ptr<sivid::identification_state const> state_;
};

/// One channel of every scenario as a picture of its own: Figure 4.1 of the report.
/// @returns the files
std::vector<std::string> draw_channel(sivid::report::identification_view const& view,
                                      identify_command const& c) {
    std::vector<std::string> files;
    for (auto const& s : view.scenarios) {
        for (auto const& series : s.channels) {
            if (series.name != c.picture) continue;
            auto const drawn =
                sivid::report::draw_time_plot(series, {.width = 900,
                                                       .height = 420,
                                                       .title = s.name + ": " + series.name,
                                                       .legend = true});
            auto const file = c.out / (s.name + "." + series.name + ".svg");
            sivid::write_durably(file, drawn.str());
            files.push_back(file.string());
        }
    }
    return files;
}

int exit_code_of(sivid::verdict v) {
    switch (v) {
    case sivid::verdict::consistent:
        return console::consistent;
    case sivid::verdict::inconsistent:
        return console::inconsistent;
    case sivid::verdict::undecided:
        break;
    }
    return console::undecided;
}

/// What is known where the search for the fewest outliers ended before it found a parameter.
sivid::identification nothing_known(sivid::identification_problem const& problem) {
    sivid::identification result(problem.prior);
    result.paving.add(problem.prior, sivid::box_verdict::pending);
    result.reason =
        console::interrupted() ? sivid::stop_reason::cancelled : sivid::stop_reason::time_budget;
    result.assumptions.push_back(sivid::input_assumption(problem.experiments));
    return result;
}

/// How long what completes a result may take where the budget is spent.
constexpr double completing = 0.2; // [s]
/// What each box of a result takes after the search: decimals, lines of a table.
constexpr double writing_a_box = 1.5e-5; // [s]
/// What the tables of measurements take, with and without the motion; at most half of a budget.
double seconds_of_tables(sivid::identification_problem const& problem, double budget) {
    constexpr double writing_a_sample = 4e-6;
    double seconds = 0;
    for (auto const& e : problem.experiments) {
        seconds += writing_a_sample * static_cast<double>(e.measurements.size());
    }
    return std::min(seconds, 0.5 * budget);
}

/// @throws bad_request  where as many outliers are allowed as there are
///         measurements: then nothing would have to be explained
void require_fewer_outliers(sivid::identification_problem const& problem) {
    for (auto const& e : problem.experiments) {
        auto const count = e.measurements.size();
        if (e.outliers < count) continue;
        throw bad_request("--outliers " + std::to_string(e.outliers) + ": scenario '" + e.name +
                          "' has " + std::to_string(count) +
                          " measurements; allow fewer outliers than that");
    }
}

bool several(identify_command const& c) { return c.ranks != nullptr && c.ranks->several(); }
bool helps(identify_command const& c) { return c.ranks != nullptr && c.ranks->helps(); }

/// By all ranks. @param shared  receives what sharing took, for people
sivid::identification identified(identify_command const& c,
                                 sivid::identification_problem const& problem,
                                 sivid::identify_options const& options, std::string const& digest,
                                 std::string& shared) {
#ifdef SIVID_HAS_MPI
    if (several(c)) {
        sivid::cluster::traffic spent;
        auto found = sivid::cluster::identify(c.ranks->others(), problem, options, digest, &spent);
        shared =
            "  " + std::to_string(c.ranks->size()) + " ranks: " + std::to_string(spent.requests) +
            " requests, " + std::to_string(spent.messages) + " messages, " +
            console::text_of("%.3g MB, ",
                             1e-6 * static_cast<double>(spent.bytes_sent + spent.bytes_received)) +
            console::text_of("%.3g s of work ", spent.worked) +
            console::text_of("in %.3g s\n", spent.asking);
        return found;
    }
#endif
    static_cast<void>(c);
    static_cast<void>(digest);
    static_cast<void>(shared);
    return sivid::identify(problem, options);
}
/// What a rank that helps does.
int help(identify_command const& c, sivid::identification_problem const& problem,
         sivid::identify_options const& options, std::string const& digest) {
#ifdef SIVID_HAS_MPI
    sivid::cluster::help_identify(c.ranks->others(), problem, options, digest);
#else
    static_cast<void>(c);
    static_cast<void>(problem);
    static_cast<void>(options);
    static_cast<void>(digest);
#endif
    return console::done;
}

/// Whether something is asked for that needs a search of boxes.
bool asks_for_more(identify_command const& c) {
    return c.online || c.compare || c.verdict_only || c.checkpoint || c.resume ||
           c.fewest_outliers || c.identifiability || several(c) || c.algorithm != "contracting" ||
           !is_usual(c.how) || c.accuracy || c.memory;
}
/// Slice by slice.
sivid::identification remembered(remembering_problem const& p,
                                 sivid::identify_options const& options) {
    sivid::effect_hull_options slices;
    slices.seconds = options.search.seconds;
    slices.boxes = std::min(slices.boxes, options.search.boxes);
    slices.keep_going = options.search.keep_going;
    slices.test.workers = options.search.workers;
    return sivid::identify_remembering(p.base, p.effects, slices);
}

sivid::online_options online_options_of(identify_command const& c) {
    sivid::online_options options;
    apply(c.how, options.test);
    if (c.accuracy) {
        options.refinement.accuracy = *c.accuracy;
        options.refinement.sufficient_ratio = 1;
    }
    if (c.boxes) options.refinement.boxes = *c.boxes;
    return options;
}

} // namespace

int run(identify_command const& c) {
    namespace report = sivid::report;
    sivid::stopwatch const clock;
    auto const model = sivid::record_model(c.craft);
    auto const data = sivid::read_dataset(c.dataset, sivid::names_of(model.about));
    std::optional<remembering_problem> remembering;
    auto problem = posed(data, model, c.effects, c.outliers, &remembering);
    if (c.algorithm == "report-1") problem = without_outliers(std::move(problem));
    if (remembering && asks_for_more(c))
        throw bad_request(
            "effects that delay, a backlash or a rate limit, and lags that begin where "
            "other effects say, are identified slice by slice, by one process: give a budget and "
            "no other options of a search");
    auto const title = title_of(data, c.effects);
    auto const further = // one that remembers says itself what its effects rest on
        remembering ? data.assumptions : assumptions_of(data, model, c.effects);
    auto const digest = sivid::dataset_digest(c.dataset);
    if (c.online && (c.compare || c.algorithm != "contracting"))
        throw bad_request("--online goes with neither --algorithm nor --compare");
    if (!c.picture.empty())
        static_cast<void>(sivid::index_of(model.about.channels, c.picture, "channel"));
    if (c.online && c.verdict_only) throw bad_request("--online does not go with --verdict-only");
    if (c.online && (c.checkpoint || c.resume))
        throw bad_request("--online goes with neither --checkpoint nor --resume");
    if (c.online && c.fewest_outliers)
        throw bad_request("--outliers auto needs all measurements: it does not go with --online");
    require_fewer_outliers(problem);
    if (c.online && several(c)) throw bad_request("--online is for one process, without mpirun");
    if (!helps(c)) console::prepare_folder(c.out);

    // From here on the first Ctrl-C ends whatever is going on, and what is proved is written.
    if (c.ranks != nullptr) {
        c.ranks->watch_interrupts();
    } else {
        console::watch_interrupts();
    }
    auto const wanted = [] { return !console::interrupted(); };
    double const left = c.budget - clock.spent();
    double const budget = std::max(0.0, left - seconds_of_tables(problem, c.budget));
    sivid::work_limit limit(budget, wanted);
    console::progress_line progress(c.quiet || helps(c));
    sivid::identify_options options;
    apply(c.how, options.test);
    options.search.accuracy = c.accuracy.value_or(0.003);
    if (c.accuracy) options.search.sufficient_ratio = 1;
    if (c.boxes) options.search.boxes = *c.boxes;
    if (c.verdict_only) options.search.sufficient_ratio = 1e-300; // any inside box will do
    if (c.algorithm != "contracting") options = by_bisection(std::move(options));
    options.search.seconds = c.compare ? 0.6 * budget : budget;
    options.search.keep_going = wanted;
    bool full = false; // as many boxes as can be written in what is left of the budget
    options.search.progress = [&](sivid::paving_progress const& p) {
        progress.show(console::paving_words(p));
        auto const rows = static_cast<double>(p.pending) + static_cast<double>(p.tested) / 3;
        full = limit.seconds() < writing_a_box * rows;
        return !full;
    };
    if (c.memory) options.search.memory = static_cast<std::size_t>(1e6 * *c.memory);
    std::optional<sivid::smallest_budget> fewest;
    if (c.fewest_outliers && !helps(c)) {
        progress.note(title + ": how many outliers are needed");
        sivid::outlier_search_options least;
        least.seconds = 0.5 * budget;
        least.memory = options.search.memory;
        least.keep_going = wanted;
        fewest = sivid::smallest_outlier_budget(problem, least);
        for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
            problem.experiments[e].outliers = fewest->budgets[e];
        }
        options.search.seconds = std::max(0.0, options.search.seconds - fewest->seconds);
    }
    options.search.batches = c.batches; // whatever the threads, so that the result is the same
    if (helps(c)) return help(c, problem, options, digest);
    options.search.workers = console::threads_for(c.threads);
    checkpoint_file checkpoint(c, c.checkpoint || c.resume
                                      ? sivid::problem_digest(problem, options, digest)
                                      : std::string{});
    options.resume = checkpoint.state();
    if (checkpoint.used()) {
        options.search.checkpoint_seconds = c.checkpoint.value_or(10);
        options.checkpoint = [&](sivid::identification_state const& s) { checkpoint.save(s); };
    }
    if (auto const& s = options.resume) {
        progress.note("resuming after " + std::to_string(s->search.tested) + " boxes and " +
                      report::duration_text(s->seconds + s->search.seconds));
    } else if (c.resume) {
        std::cerr << "warning: no checkpoint in " << c.out.string() << ": beginning anew\n";
    }
    if (c.online)
        progress.note(title + ", measurement by measurement");
    else
        progress.note(std::string{"identifying "} + title + " (" + words_of(c.algorithm) +
                      ", at most " + report::duration_text(options.search.seconds) +
                      "; Ctrl-C stops early)");
    std::string shared; // how the ranks shared the work
    // Without a witness any number of outliers may be needed: there is nothing to invert.
    auto found = remembering                  ? remembered(*remembering, options)
                 : fewest && !fewest->witness ? nothing_known(problem)
                 : c.online ? identify_online(problem, online_options_of(c), limit,
                                              console::interrupted, std::cout)
                            : identified(c, problem, options, digest, shared);
    progress.finish();
    auto const name_reason = [&full](sivid::identification& of) {
        if (!full || of.reason != sivid::stop_reason::cancelled || console::interrupted()) return;
        of.reason = sivid::stop_reason::time_budget;
        if (of.effort) of.effort->most_seconds = of.effort->seconds; // the rest is for writing
    };
    name_reason(found);

    if (fewest) {
        found.fewest = *fewest;
        if (!found.witness && fewest->witness) { // of the same budgets
            found.witness = fewest->witness;
            found.verdict = sivid::verdict::consistent;
        }
    }

    std::optional<sivid::identification> baseline;
    if (c.compare && !console::interrupted()) {
        auto other = by_bisection(options);
        other.search.seconds = limit.seconds();
        other.checkpoint = nullptr;
        other.resume = nullptr;
        progress.note("the same by Algorithm 1 of the report, for comparison");
        baseline = sivid::identify(without_outliers(problem), other);
        name_reason(*baseline);
        progress.finish();
    }
    limit.allow(completing);
    std::optional<sivid::identifiability> told;
    if (c.identifiability) told = identifiability_at(problem, found, limit);
    report::identification_report_options about{.dataset = title,
                                                .meanings = constant_meanings(),
                                                .further_assumptions = further,
                                                .plane = report::plane_channels{"x", "y", "psi"},
                                                .date = console::today(),
                                                .machine = console::machine_text(),
                                                .command = c.command_line,
                                                .keep_going = limit};
    auto const viewed = [&](sivid::explaining_motion const* motion) {
        auto view = report::view_of(problem, found, motion, about);
        if (told) {
            view.identifiability = report::identifiability_words(*told);
            view.identifiability_at = place_of_identifiability(found);
        }
        if (baseline) {
            view.comparison = {report::comparison_of(words_of(c.algorithm), found, true),
                               report::comparison_of(words_of("report-1"), *baseline, false,
                                                     std::string{"bisection alone; "} +
                                                         std::string{to_string(baseline->reason)})};
            view.comparison_note =
                "Both volumes are proved; the smaller the outer one, the more was "
                "excluded. Same machine, same problem, one after the other.";
        }
        return view;
    };
    // What is proved comes first, whole; then what has to be integrated once more for pictures.
    // result.json names the motion of outputs.csv: both come together.
    auto const add_result = [&](sivid::file_set& files, auto const& page_view,
                                sivid::explaining_motion const* motion) {
        auto const outputs = sivid::outputs_csv(problem, found, motion);
        files.add("outputs.csv", outputs);
        files.add("report.html", report::identification_page(page_view).str());
        files.add("result.json",
                  sivid::identification_json(problem, found,
                                             {.dataset = data.id,
                                              .effects = c.effects,
                                              .further_assumptions = further,
                                              .source_folder = console::seen_from(c.out, c.dataset),
                                              .source_digest = digest,
                                              .identifiability = told ? &*told : nullptr,
                                              .outputs = &outputs,
                                              .motion = motion}));
    };
    auto view = viewed(nullptr);
    bool whole = true; // all files are written
    {
        sivid::file_set files(c.out);
        console::add_result_tables(files, problem, found);
        add_result(files, view, nullptr);
        files.commit();
    }
    limit.allow(completing);
    // Nobody integrates what remembers along a line of times that it does not know.
    auto const motion =
        remembering ? std::nullopt : sivid::find_explaining_motion(problem, found, 240, limit);
    if (motion) {
        view = viewed(&*motion);
        try {
            sivid::file_set files(c.out);
            add_result(files, view, &*motion);
            files.commit();
        } catch (sivid::output_error const& e) {
            std::cerr << "hovercraft: no pictures of the motion in the report: "
                      << sivid::printable_text(e.what(), 1000) << "\n";
            whole = false;
        }
    }
    for (auto const& file : draw_channel(view, c)) std::cout << "picture: " << file << "\n";
    print_summary(problem, found, title, c.out, c.verbose);
    if (baseline) {
        std::cout << "  beside it, Algorithm 1 of the report: not excluded at most "
                  << report::at_most_percent(view.comparison[1].outer_volume.hi) << " after "
                  << report::duration_text(baseline->seconds) << ", " << baseline->boxes
                  << " boxes\n";
    }
    if (told) {
        std::cout << "  what such data tell, " << view.identifiability_at << ":\n";
        for (auto const& line : view.identifiability) std::cout << "    " << line << "\n";
    }
    std::cout << shared;
    checkpoint.finish(found.reason);
    return whole ? exit_code_of(found.verdict) : static_cast<int>(console::bad_input);
}

} // namespace hovercraft_example
