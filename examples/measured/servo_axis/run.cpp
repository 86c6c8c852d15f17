// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "console/console.hpp"
#include "console/program.hpp"

#include <sivid/io/explaining_motion.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/io/identification_json.hpp>
#include <sivid/io/result/certificates_csv.hpp>
#include <sivid/report/draw/time_plot.hpp>
#include <sivid/report/identification_page.hpp>
#include <sivid/report/identification_report.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>

namespace servo {

namespace {

namespace report = sivid::report;

using console::in_millimetres;
using console::text_of;

/// What the proofs rest on beside "inputs exact".
std::vector<std::string> assumptions_of(posed_problem const& posed, command const& c) {
    std::vector<std::string> all;
    all.emplace_back("force linear between samples");
    all.push_back("position bound " + in_millimetres(c.bounds.model_error) +
                  " stands for the model error: in each window used, every sample lies so near to "
                  "the model's position");
    all.push_back("each window starts within " + in_millimetres(c.bounds.start_position) +
                  " of the measured position and within " +
                  in_millimetres(c.bounds.start_velocity) +
                  "/s of the velocity from a zero-phase low-pass filter (cubic over " +
                  std::to_string(2 * c.windows.filter_half + 1) +
                  " samples); a parameter is feasible when for every window some such start "
                  "explains the window's samples");
    all.emplace_back("dry friction is F_c v/sqrt(v^2 + eps^2) with eps = 0.001 m/s");
    all.push_back(std::to_string(posed.used.size()) + " windows of " +
                  text_of("%g", c.windows.length) + " s are used (" +
                  text_of("%.0f", 100 * posed.share_used) +
                  " % of the record), with all samples of each; " +
                  std::to_string(posed.kept_back.size()) + " are kept back");
    return all;
}

std::map<std::string, std::string> meanings() {
    return {{"M", "moving mass, with the motor's inertia"},
            {"F_v", "viscous friction"},
            {"F_c", "dry (Coulomb) friction"},
            {"offset", "constant force: drive offset and asymmetry of the friction"}};
}

struct summary_of_misfits {
    double largest = 0, at = 0, root_mean_square = 0;
    std::size_t over = 0; ///< windows beyond the bound
};
summary_of_misfits summarise(std::vector<misfit> const& all, double bound) {
    summary_of_misfits s;
    double sum = 0;
    std::size_t samples = 0;
    for (auto const& m : all) {
        if (m.largest > s.largest) {
            s.largest = m.largest;
            s.at = m.start;
        }
        s.over += m.largest > bound ? 1 : 0;
        sum += m.mean_square * static_cast<double>(m.samples);
        samples += m.samples;
    }
    s.root_mean_square = samples > 0 ? std::sqrt(sum / static_cast<double>(samples)) : 0;
    return s;
}

/// All that was found, for page and console.
struct outcome_of_run {
    sivid::identification found;
    bool literature_refuted = false;
    std::vector<misfit> witness_used{}, witness_kept{}, literature_used{};
};

std::string millimetres(double metres) { return text_of("%.2f mm", 1e3 * metres); }

std::string literature_words(outcome_of_run const& o) {
    auto const lit = summarise(o.literature_used, HUGE_VAL);
    return std::string{"Taken together, the literature's values "} +
           (o.literature_refuted
                ? "are proved not to explain these windows within the stated bounds"
                : "are not excluded by the contraction") +
           ": simulated from the filter's starts they miss by up to " + millimetres(lit.largest) +
           " (window at " + text_of("%g", lit.at) + " s). Each value for itself is compared here.";
}

/// Says what the page's standard sentences cannot know.
void complete(report::identification_view& view, posed_problem const& posed,
              outcome_of_run const& o, command const& c) {
    auto const& names = posed.problem.choice.unknown;
    auto const count = std::to_string(posed.used.size());
    if (o.found.verdict == sivid::verdict::consistent) {
        view.sentence = "A parameter vector explains every sample of " + count + " windows of " +
                        text_of("%g", c.windows.length) + " s (" +
                        text_of("%.0f", 100 * posed.share_used) + " % of the record) within " +
                        in_millimetres(c.bounds.model_error) + "; all that do are enclosed below.";
    }
    if (o.found.verdict != sivid::verdict::inconsistent) {
        std::string within, without;
        auto const values = literature();
        for (std::size_t j = 0; j < names.size(); ++j) {
            auto& list = contains(o.found.hull[j], values[j]) ? within : without;
            list += (list.empty() ? "" : ", ") + names[j] + " = " + text_of("%.7g", values[j]);
        }
        view.proved.push_back("Of the literature's values " + (within.empty() ? "none" : within) +
                              (within.empty() ? " lies" : " lie") + " within the hulls" +
                              (without.empty() ? "." : "; " + without + " do not."));
    }
    if (!o.witness_kept.empty()) {
        auto const kept = summarise(o.witness_kept, *nearest(c.bounds.model_error));
        view.warnings.push_back(
            "The windows kept back are no part of the proof. Simulated there (not proved), the " +
            std::string{o.found.witness ? "witness" : "best fit"} + " misses by up to " +
            millimetres(kept.largest) + ", in " + std::to_string(kept.over) + " of " +
            std::to_string(o.witness_kept.size()) +
            " windows by more than the bound: dry friction and an offset are not all that acts "
            "on this axis.");
    }
    if (posed.filter_difference > *nearest(c.bounds.start_velocity)) {
        view.warnings.push_back("The velocity filter differs from a narrower one by " +
                                text_of("%.2f", 1e3 * posed.filter_difference) +
                                " mm/s, more than the stated bound of a start's velocity.");
    }
}

/// The windows side by side: where the witness lies within the bound.
void add_pictures(report::page& page, report::identification_view const& view,
                  outcome_of_run const& o, command const& c) {
    report::figure f{.panels = {},
                     .title = std::string{"The "} + (o.found.witness ? "witness" : "best fit") +
                              " within each measured interval, window by window.",
                     .caption = "Zero is the measured position, +1 and \xE2\x88\x92"
                                "1 are the ends of the bound of " +
                                in_millimetres(c.bounds.model_error) +
                                ". The line is a proven enclosure of the model's position: between "
                                "the ends it meets the sample for certain."};
    for (auto const& s : view.scenarios) {
        for (auto const& channel : s.channels) {
            f.panels.push_back(report::draw_residual_plot(
                channel, {.height = 200, .title = "window at " + s.name}));
        }
    }
    if (f.panels.empty()) return;
    page.section("Measurements and model");
    page.add(f);
}

void add_literature(report::page& page, posed_problem const& posed, outcome_of_run const& o) {
    page.section("Beside the literature");
    report::table t{.columns = {{"parameter", report::column_kind::symbol},
                                {"unit"},
                                {"prior", report::column_kind::number},
                                {"hull (proved)", report::column_kind::number},
                                {"literature", report::column_kind::number},
                                {"in the hull", report::column_kind::text}},
                    .rows = {},
                    .caption =
                        "Literature: A. Janot, M. Gautier, M. Brunot, Data Set and Reference "
                        "Models of EMPS, 2019. " +
                        literature_words(o)};
    auto const values = literature();
    auto const& problem = posed.problem;
    for (std::size_t j = 0; j < values.size(); ++j) {
        auto const& name = problem.choice.unknown[j];
        auto const k = sivid::index_of(problem.model.about.constants, name, "constant");
        report::range const prior = problem.prior[j];
        report::range const hull = o.found.hull[j];
        t.rows.push_back({name, problem.model.about.constants[k].unit, report::given_text(prior),
                          report::outward_text_within(hull, prior), text_of("%.7g", values[j]),
                          contains(o.found.hull[j], values[j]) ? "yes" : "no"});
    }
    page.add(t);
}

void add_windows(report::page& page, posed_problem const& posed, outcome_of_run const& o,
                 command const& c) {
    if (o.witness_used.empty()) return;
    page.section("Window by window (plain simulation, not proved)");
    double const bound = *nearest(c.bounds.model_error);
    auto const kept = summarise(o.witness_kept, bound);
    auto const used = summarise(o.witness_used, bound);
    page.prose("The " + std::string{o.found.witness ? "witness" : "best fit"} +
               ", simulated from the measured position and the filter's velocity. Windows in use: "
               "root mean square " +
               millimetres(used.root_mean_square) + ", at most " + millimetres(used.largest) +
               ". Windows kept back: root mean square " + millimetres(kept.root_mean_square) +
               ", at most " + millimetres(kept.largest) + " (window at " + text_of("%g", kept.at) +
               " s), " + std::to_string(kept.over) + " of " +
               std::to_string(o.witness_kept.size()) + " beyond the bound.");
    report::table t{.columns = {{"window starts at [s]", report::column_kind::number},
                                {"role", report::column_kind::text},
                                {"largest misfit [mm]", report::column_kind::number},
                                {"RMS misfit [mm]", report::column_kind::number}},
                    .rows = {}};
    std::vector<std::pair<misfit, std::string>> all;
    for (auto const& m : o.witness_used) all.emplace_back(m, "used");
    for (auto const& m : o.witness_kept) all.emplace_back(m, "kept back");
    std::sort(all.begin(), all.end(),
              [](auto const& a, auto const& b) { return a.first.start < b.first.start; });
    for (auto const& [m, role] : all) {
        t.rows.push_back({text_of("%g", m.start), role, text_of("%.2f", 1e3 * m.largest),
                          text_of("%.2f", 1e3 * std::sqrt(m.mean_square))});
    }
    page.add(t);
    page.prose("At the starts the velocity filter differs by at most " +
               text_of("%.2f", 1e3 * posed.filter_difference) +
               " mm/s from one with 3/5 of its width; the stated bound is " +
               in_millimetres(c.bounds.start_velocity) + "/s.");
}

void print_summary(posed_problem const& posed, outcome_of_run const& o, command const& c) {
    auto const& found = o.found;
    std::cout << "servo axis: " << to_string(found.verdict) << " (" << to_string(found.reason)
              << ")\n";
    auto const view = report::view_of(posed.problem, found, nullptr, {.dataset = "servo axis"});
    auto const values = literature();
    for (std::size_t j = 0; j < values.size(); ++j) {
        auto const& p = view.parameters[j];
        std::cout << "  " << p.name << " in " << report::outward_text_within(p.hull, p.prior) << " "
                  << p.unit << "  (prior " << report::given_text(p.prior) << ", literature "
                  << text_of("%.7g", values[j]) << ")\n";
    }
    std::cout << "  not excluded: at most " << report::at_most_percent(view.volume_outer.hi)
              << " of the prior's volume\n";
    if (found.witness) {
        std::cout << "  verified witness:";
        for (std::size_t j = 0; j < values.size(); ++j) {
            std::cout << " " << posed.problem.choice.unknown[j] << "="
                      << report::exact_text(found.witness->parameters[j]);
        }
        std::cout << "\n";
    }
    double const bound = *nearest(c.bounds.model_error);
    auto const kept = summarise(o.witness_kept, bound);
    if (!o.witness_kept.empty()) {
        std::cout << "  windows kept back (plain simulation): misfit RMS "
                  << millimetres(kept.root_mean_square) << ", at most " << millimetres(kept.largest)
                  << "\n";
    }
    std::cout << "  assumed:";
    for (auto const& a : found.assumptions) std::cout << " " << a << ";";
    std::cout << "\n";
    for (auto const& a : assumptions_of(posed, c)) std::cout << "    " << a << "\n";
    std::cout << "  " << report::duration_text(found.seconds) << ", " << found.boxes << " boxes, "
              << found.integrations
              << " validated integrations\n  written: " << (c.out / "report.html").string()
              << " and result.json, boxes.csv, outputs.csv beside it\n";
}

int exit_code_of(sivid::verdict v) {
    if (v == sivid::verdict::consistent) return console::consistent;
    return v == sivid::verdict::inconsistent ? console::inconsistent : console::undecided;
}

} // namespace

int run(command const& c) {
    console::progress_line progress(c.quiet); // its clock is that of the budget
    auto const record = read_recording(c.folder / c.file);
    auto const posed = pose(record, c);
    console::prepare_folder(c.out);

    console::watch_interrupts();
    progress.note("identifying M, F_v, F_c and the offset from " +
                  std::to_string(posed.used.size()) + " windows; Ctrl-C stops early");
    outcome_of_run o{identify_axis(
        posed, c.accuracy, std::max(0.0, c.budget - progress.elapsed()),
        [&](std::string const& text) { progress.note(text); },
        [&](sivid::paving_progress const& p) {
            progress.show(console::paving_words(p));
            return !console::interrupted();
        })};
    progress.finish();
    std::signal(SIGINT, SIG_DFL);

    progress.note("writing the report");
    o.literature_refuted = refutes(posed, literature());
    o.literature_used = approximate_misfits(posed, record, posed.used, literature());
    if (o.found.guess && !o.found.guess->parameters.empty()) {
        auto const& p = o.found.guess->parameters;
        o.witness_used = approximate_misfits(posed, record, posed.used, p);
        o.witness_kept = approximate_misfits(posed, record, posed.kept_back, p);
    }
    auto const further = assumptions_of(posed, c);
    auto const motion = sivid::find_explaining_motion(posed.problem, o.found);
    auto view = report::view_of(posed.problem, o.found, motion ? &*motion : nullptr,
                                {.dataset = "EMPS servo axis, " + c.file,
                                 .meanings = meanings(),
                                 .further_assumptions = further,
                                 .date = console::today(),
                                 .machine = console::machine_text(),
                                 .command = c.command_line});
    complete(view, posed, o, c);
    // A figure of all windows says more than two for each.
    auto short_view = view;
    for (auto& s : short_view.scenarios) s.channels.clear();
    auto page = report::identification_page(short_view);
    add_literature(page, posed, o);
    add_pictures(page, view, o, c);
    add_windows(page, posed, o, c);
    sivid::file_set files(c.out);
    files.add("boxes.csv", sivid::boxes_csv(posed.problem, o.found));
    if (o.found.products) {
        files.add("products.csv", sivid::products_csv(o.found));
    } else {
        files.drop("products.csv"); // of an earlier result
    }
    files.add("certificates.csv", sivid::certificates_csv(o.found.proof));
    auto const* const shown = motion ? &*motion : nullptr;
    auto const outputs = sivid::outputs_csv(posed.problem, o.found, shown);
    files.add("outputs.csv", outputs);
    files.add("report.html", page.str());
    files.add("result.json", sivid::identification_json(posed.problem, o.found,
                                                        {.dataset = c.file,
                                                         .further_assumptions = further,
                                                         .outputs = &outputs,
                                                         .motion = shown}));
    files.commit();
    print_summary(posed, o, c);
    return exit_code_of(o.found.verdict);
}

} // namespace servo
