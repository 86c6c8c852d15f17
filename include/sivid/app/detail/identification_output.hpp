// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_IDENTIFICATION_OUTPUT_HPP
#define SIVID_APP_DETAIL_IDENTIFICATION_OUTPUT_HPP

#include <sivid/app/commands.hpp>
#include <sivid/app/console.hpp>
#include <sivid/app/detail/posed_problem.hpp>
#include <sivid/app/program.hpp>
#include <sivid/executor.hpp>
#include <sivid/io/dataset/dataset_digest.hpp>
#include <sivid/io/explaining_motion.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/io/identification_json.hpp>
#include <sivid/io/result/certificates_csv.hpp>
#include <sivid/io/text/durable_file.hpp>
#include <sivid/io/text/printable_text.hpp>
#include <sivid/paving/identifiability.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/report/draw/time_plot.hpp>
#include <sivid/report/identification_page.hpp>
#include <sivid/report/identification_report.hpp>
#include <sivid/report/identification_view.hpp>
#include <sivid/report/stored_page.hpp>
#include <sivid/work_limit.hpp>
#ifdef SIVID_HAS_TBB
#include <sivid/parallel/tbb_executor.hpp>
#endif

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sivid::app::detail {

/// What was tried before a search, a line each.
inline void print_tried(contraction_journal const& journal) {
    for (auto const& row : report::tried_table(journal).rows) {
        auto const &by = row[0], &ended = row[1], &why = row[2], &effort = row[3];
        result_stream() << "  " << by << ": " << ended;
        if (!effort.empty()) result_stream() << " (" << effort << ")";
        result_stream() << (why.empty() ? "\n" : "; " + why + "\n");
    }
}

/// The tables that make an identification a result that others can read (check, predict, verify):
/// boxes.csv, products.csv and certificates.csv; result.json is for the caller to add last.
inline void add_result_tables(file_set& files, identification_problem const& problem,
                              identification const& found) {
    files.add("boxes.csv", boxes_csv(problem, found));
    if (found.products) {
        files.add("products.csv", products_csv(found));
    } else {
        files.drop("products.csv"); // of an earlier result
    }
    if (found.proof.empty()) {
        files.drop("certificates.csv");
    } else {
        files.add("certificates.csv", certificates_csv(found.proof));
    }
}

/// @param threads  0: as many as the machine has; without oneTBB that is one
/// @throws bad_request where more are asked for than the program can have
[[nodiscard]] inline executor threads_for(std::size_t threads) {
    if (threads == 1) return {};
#ifdef SIVID_HAS_TBB
    return tbb_executor(threads);
#else
    if (threads == 0) return {};
    throw bad_request("--threads: this program was built without oneTBB; install it "
                      "(Debian: libtbb-dev), configure and build anew, or leave the "
                      "option out");
#endif
}

/// What a search works on, and what its results say of that.
struct search_task {
    /// What each box of a result takes after the search: decimals, lines of a table.
    static constexpr double writing_a_box = 1.5e-5; // [s]

    robot const& of;
    search_command const& told;
    stopwatch clock{};
    dataset data;
    allowed_disturbances disturbances;
    identification_problem problem;
    std::string title, digest;
    std::vector<std::string> further; ///< assumptions besides what is proved

    /// @throws bad_request  where as many outliers are allowed as there are measurements: then
    ///         nothing would have to be explained
    search_task(robot const& r, search_command const& c,
                std::optional<remembering_problem>* remembering)
        : of{r},
          told{c},
          data{read_data(r, c.dataset)},
          disturbances{disturbances_from(r, c.disturbed, c.errors)},
          problem{posed(r, data, c.effects, disturbances, c.outliers, remembering)},
          title{title_of(data, c.effects, disturbances, problem.model)},
          digest{dataset_digest(c.dataset)},
          further{assumptions_of(r, data, c.effects, disturbances, problem)} {
        for (auto const& words : creeping_words(problem)) progress_line(c.quiet).note(words);
        if (!c.picture.empty())
            require_known(c.picture, names_in(r.model.about.channels), "channel");
        for (auto const& e : problem.experiments) {
            auto const count = e.measurements.size();
            if (e.outliers < count) continue;
            throw bad_request("--outliers " + std::to_string(e.outliers) + ": scenario '" + e.name +
                              "' has " + std::to_string(count) +
                              " measurements; allow fewer outliers than that");
        }
    }

    /// What is left for the search: the tables of measurements take their time, with and without
    /// the motion; at most half of a budget.
    [[nodiscard]] double budget_of_search() const {
        constexpr double writing_a_sample = 4e-6; // [s]
        double tables = 0;
        for (auto const& e : problem.experiments)
            tables += writing_a_sample * static_cast<double>(e.measurements.size());
        return std::max(0.0, told.budget - clock.spent() - std::min(tables, 0.5 * told.budget));
    }
};

inline int exit_code_of(verdict v) {
    return v == verdict::consistent     ? consistent
           : v == verdict::inconsistent ? inconsistent
                                        : undecided;
}

/// The ranges that an identification leaves, a line each.
inline void print_ranges(report::identification_view const& view, std::string const& indent) {
    for (auto const& p : view.parameters) {
        if (report::is_empty(p.hull)) continue;
        result_stream() << indent << p.name << " in "
                        << report::outward_text_within(p.hull, p.prior)
                        << (p.unit == "1" ? "" : " " + p.unit);
        auto const note = report::exclusion_note(view, p);
        result_stream() << (note.empty() ? "" : "  (" + note + ")") << "\n";
    }
}

/// Writes and prints what was found: report.html, result.json, outputs.csv, boxes.csv and the
/// tables beside it.
class identification_output {
public:
    /// @param limit  that of the search; what completes a result gets a little more time
    identification_output(search_task const& task, identification const& found, work_limit& limit)
        : task_{task}, problem_{task.problem}, found_{found}, limit_{limit} {}

    std::optional<identification> baseline; ///< by Algorithm 1, to be shown beside it
    std::string title_of_command = "contraction (default)";
    /// Nobody integrates what remembers along a line of times that it does not know.
    bool draws_motion = true;

    /// What is proved comes first, whole; then what has to be integrated once more for pictures.
    /// @returns whether all files are written
    /// @throws output_error  where not even the result is
    [[nodiscard]] bool write() {
        limit_.allow(completing);
        if (task_.told.identifiability) told_ = identifiability_of_found();
        view_ = viewed(nullptr);
        {
            file_set files(out());
            add_result_tables(files, problem_, found_);
            add_result(files, nullptr);
            files.commit();
        }
        limit_.allow(completing);
        auto const motion = draws_motion
                                ? find_explaining_motion(problem_, found_, motion_pieces, limit_)
                                : std::nullopt;
        bool whole = true;
        if (motion) {
            view_ = viewed(&*motion);
            try {
                file_set files(out());
                add_result(files, &*motion);
                files.commit();
            } catch (output_error const& e) {
                notice_stream() << task_.of.name << ": no pictures of the motion in the report: "
                                << printable_text(e.what(), 1000) << "\n";
                whole = false;
            }
        }
        draw_channel();
        return whole;
    }
    [[nodiscard]] report::identification_view const& view() const { return view_; }

    void print() const {
        print_verdict();
        print_combinations();
        result_stream() << "  of the prior's volume: inside at least "
                        << report::at_least_percent(view_.volume_inner.lo)
                        << ", not excluded at most "
                        << report::at_most_percent(view_.volume_outer.hi) << "\n";
        if (!view_.inside_box.empty())
            result_stream() << "  explained by all of " << view_.inside_box << "\n";
        if (found_.witness) {
            result_stream() << "  verified witness:";
            for (std::size_t j = 0; j < problem_.choice.unknown.size(); ++j)
                result_stream() << " " << problem_.choice.unknown[j] << "="
                                << report::exact_text(found_.witness->parameters[j]);
            result_stream() << "\n";
        }
        print_outliers();
        if (task_.told.verbose) print_tried(view_.tried);
        for (auto const& words : view_.statistics.why) result_stream() << "  " << words << "\n";
        print_effort();
    }

private:
    /// How long what completes a result may take where the budget is spent.
    static constexpr double completing = 0.2; // [s]

    [[nodiscard]] std::filesystem::path const& out() const { return task_.told.out; }

    /// What data like these can tell about the unknowns: at the witness, or in the middle of what
    /// was not excluded.
    [[nodiscard]] identifiability identifiability_of_found() const {
        identifiability_options options;
        options.enclosure.keep_going = limit_;
        auto at = is_empty(found_.hull) ? mid(problem_.prior) : mid(found_.hull);
        if (found_.witness) {
            at = found_.witness->parameters;
            for (auto const& start : found_.witness->starts)
                options.at_starts.push_back(point_box(start));
        }
        return identifiability_of(problem_, point_box(at), options);
    }

    [[nodiscard]] report::identification_view viewed(explaining_motion const* motion) const {
        auto view = report::view_of(problem_, found_, motion,
                                    {.dataset = task_.title,
                                     .meanings = task_.of.meanings,
                                     .further_assumptions = task_.further,
                                     .plane = task_.of.plane,
                                     .date = today(),
                                     .machine = machine_text(),
                                     .command = task_.told.command_line,
                                     .keep_going = limit_});
        if (told_) {
            view.identifiability = report::identifiability_words(*told_);
            view.identifiability_at =
                found_.witness ? "at the witness" : "at the middle of what is left";
        }
        if (baseline) {
            view.comparison = {report::comparison_of(title_of_command, found_, true),
                               report::comparison_of("Algorithm 1 of the report", *baseline, false,
                                                     "bisection alone; " +
                                                         std::string{to_string(baseline->reason)})};
            view.comparison_note =
                "Both volumes are proved; the smaller the outer one, the more was "
                "excluded. Same machine, same problem, one after the other.";
        }
        return view;
    }

    /// result.json names the motion of outputs.csv: both come together.
    void add_result(file_set& files, explaining_motion const* motion) const {
        auto const outputs = outputs_csv(problem_, found_, motion);
        files.add("outputs.csv", outputs);
        report::stored(view_).add_to(files);
        files.add("result.json",
                  identification_json(problem_, found_,
                                      {.dataset = task_.data.id,
                                       .effects = task_.told.effects,
                                       .disturbances = task_.disturbances,
                                       .further_assumptions = task_.further,
                                       .source_folder = seen_from(out(), task_.told.dataset),
                                       .source_digest = task_.digest,
                                       .identifiability = told_ ? &*told_ : nullptr,
                                       .outputs = &outputs,
                                       .motion = motion}));
    }

    /// One channel of every scenario as a picture of its own.
    void draw_channel() const {
        for (auto const& s : view_.scenarios) {
            for (auto const& series : s.channels) {
                if (series.name != task_.told.picture) continue;
                auto const drawn =
                    report::draw_time_plot(series, {.width = 900,
                                                    .height = 420,
                                                    .title = s.name + ": " + series.name,
                                                    .legend = true});
                auto const file = out() / (s.name + "." + series.name + ".svg");
                write_durably(file, drawn.str());
                result_stream() << "picture: " << file.string() << "\n";
            }
        }
    }

    void print_verdict() const {
        result_stream() << task_.title << ": " << to_string(found_.verdict) << " ("
                        << to_string(found_.reason) << ")\n";
        for (auto const& words : derivation_words(problem_.model, problem_.choice))
            result_stream() << "  " << words << "\n";
        if (found_.verdict == verdict::inconsistent)
            result_stream()
                << "  no parameter in the prior explains the data: all of it is excluded by "
                   "proof\n";
        print_ranges(view_, "  ");
    }

    void print_combinations() const {
        for (auto const& c : view_.combinations)
            result_stream() << "  " << report::formula_text(c.formula) << " in "
                            << report::outward_text(c.hull) << " " << c.unit << "\n";
        std::vector<std::string> combined, idle;
        for (auto const j : found_.entangled) {
            bool const stands =
                std::any_of(found_.combinations.begin(), found_.combinations.end(),
                            [j](auto const& c) { return c.what.exponents[j] != 0; });
            (stands ? combined : idle).push_back(problem_.choice.unknown[j]);
        }
        if (!combined.empty())
            result_stream() << "  " << enumeration(combined)
                            << " are only known through such combinations on these data\n";
        for (auto const& name : idle)
            result_stream() << "  " << name << " stands nowhere in the equations of these data\n";
    }

    void print_outliers() const {
        if (!found_.forced.empty()) {
            result_stream() << "  proved outliers: " << found_.forced.size();
            std::size_t const most = 6;
            for (std::size_t k = 0; k < std::min(most, found_.forced.size()); ++k) {
                auto const& e = problem_.experiments[found_.forced[k].experiment];
                auto const m = sorted(e.measurements)[found_.forced[k].measurement];
                result_stream() << (k == 0 ? ": " : ", ") << e.name << " "
                                << problem_.model.about.channels[m.channel].name << " at "
                                << report::given_text(m.time) << " "
                                << problem_.model.about.time_unit;
            }
            result_stream() << (found_.forced.size() > most ? ", ...\n" : "\n");
        }
        if (!found_.fewest) return;
        auto const& total = found_.fewest->total;
        result_stream() << "  outliers needed: " << report::count_text(total.most);
        if (total.exact()) {
            result_stream() << ", proved to be the fewest";
        } else {
            result_stream() << " suffice, at least " << report::count_text(total.least)
                            << " by proof (" << to_string(found_.fewest->reason) << ")";
        }
        for (auto const& e : problem_.experiments) {
            if (e.outliers > 0) result_stream() << "; " << e.name << " " << e.outliers;
        }
        result_stream() << "\n";
    }

    void print_effort() const {
        result_stream() << "  " << report::duration_text(found_.seconds)
                        << (found_.by_clock ? ", ended by the clock: a faster machine may say more"
                                            : "");
        if (found_.boxes > 0) // else nobody counted
            result_stream() << ", " << found_.boxes << " boxes, " << found_.integrations
                            << " validated integrations";
        result_stream() << "\n  written: " << (out() / "report.html").string()
                        << " and result.json, boxes.csv, outputs.csv beside it\n";
        if (baseline)
            result_stream() << "  beside it, Algorithm 1 of the report: not excluded at most "
                            << report::at_most_percent(view_.comparison[1].outer_volume.hi)
                            << " after " << report::duration_text(baseline->seconds) << ", "
                            << baseline->boxes << " boxes\n";
        if (!told_) return;
        result_stream() << "  what such data tell, " << view_.identifiability_at << ":\n";
        for (auto const& line : view_.identifiability) result_stream() << "    " << line << "\n";
    }

    search_task const& task_;
    identification_problem const& problem_;
    identification const& found_;
    work_limit& limit_;
    std::optional<identifiability> told_;
    report::identification_view view_;
};

} // namespace sivid::app::detail

#endif
