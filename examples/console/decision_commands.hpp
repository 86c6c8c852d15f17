// SPDX-License-Identifier: MIT
// predict, verify and control, for any model: what a stored identification says of a
// scenario.
#ifndef EXAMPLES_CONSOLE_DECISION_COMMANDS_HPP
#define EXAMPLES_CONSOLE_DECISION_COMMANDS_HPP

#include "console.hpp"
#include "decision_task.hpp"
#include "program.hpp"
#include "result_files.hpp"

#include <sivid/decision/gain_search.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/verification.hpp>
#include <sivid/io/decision_json.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/report/decision_page.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace console {

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
    auto const found = task.predicted(*about, detail::options_for(c, c.budget), {});
    auto options = task.page_options();
    detail::add_lines(options, task, *about, {}, std::max(0.2, c.budget - progress.elapsed()));
    progress.finish();
    sivid::file_set files(c.out);
    files.add("tubes.csv", sivid::tubes_csv(found));
    files.add("prediction.html", report::prediction_page(*about, found, options).str());
    files.add("prediction.json", sivid::prediction_json(*about, found, task.json_options()));
    files.commit();
    std::cout << task.scenario() << " for all parameters that " << task.dataset() << " leaves: "
              << (found.complete ? "proved"
                                 : "proved up to t = " + report::exact_text(found.reached) + " " +
                                       about->problem.model.about.time_unit + " only")
              << "\n";
    for (auto const& channel : found.channels) {
        report::range const r{channel.low.back(), channel.high.back()};
        std::cout << "  " << channel.name << " at the end in "
                  << (is_finite(r) ? report::outward_text(r) : "no known bounds")
                  << (channel.unit == "1" ? "" : " " + channel.unit) << "\n";
    }
    if (std::isfinite(found.excess))
        std::cout << "  tubes at most " << report::wider_text(found.excess)
                  << (found.excess < 1 ? " than" : " as") << " what these parameters reach\n";
    std::cout << "  " << report::duration_text(found.seconds) << ", " << found.parts << " parts, "
              << found.integrations
              << " validated integrations\n  written: " << (c.out / "prediction.html").string()
              << " and prediction.json, tubes.csv\n";
    return found.complete ? done : undecided;
}

namespace detail {

/// What an answer rests on, what it took, and what was written.
inline void print_end(sivid::stored_prediction const& about, std::string const& effort,
                      decision_command const& c, std::string const& files) {
    for (auto const& line : report::decision_assumptions(about))
        std::cout << "  - " << line << "\n";
    std::cout << "  " << effort << " validated integrations\n";
    if (!c.out.empty()) std::cout << "  written: " << files << "\n";
}

} // namespace detail

/// `verify`: prints the answer; with `out`, writes verification.html and verification.json.
/// @returns done when proved, refuted, or undecided
inline int run_verify(sivid::recorded_model const& model,
                      std::vector<sivid::effect> const& catalogue, decision_command const& c,
                      scenario_finder const& find) {
    namespace report = sivid::report;
    detail::question const q(model, catalogue, c, find);
    auto const& [task, with_margins, asked, about] = q;
    if (!c.out.empty()) prepare_folder(c.out);
    watch_interrupts();
    progress_line progress(c.quiet);
    progress.note("verifying " + task.scenario() + " for all that " + task.dataset() + " leaves");
    auto const found =
        sivid::verify(about->problem, asked, about->feasible, detail::options_for(c, c.budget, 60));
    progress.finish();
    if (!c.out.empty()) {
        auto page = task.page_options();
        double const left = std::max(0.2, c.budget - progress.elapsed());
        auto const tubes =
            task.predicted(*about, detail::options_for(c, 0.5 * left), asked.margins);
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
    detail::print_end(*about,
                      report::duration_text(found.seconds) + ", " + std::to_string(found.parts) +
                          " parts, " + std::to_string(found.integrations),
                      c, (c.out / "verification.html").string() + " and verification.json");
    return found.answer == sivid::requirement_answer::proved    ? done
           : found.answer == sivid::requirement_answer::refuted ? refuted
                                                                : undecided;
}

/// `control`: prints what is known of the gains; with `out`, writes control.html, control.json and
/// gains.csv. @returns done when some are proved, refuted when none exists, or undecided
inline int run_control(sivid::recorded_model const& model,
                       std::vector<sivid::effect> const& catalogue, decision_command const& c,
                       scenario_finder const& find) {
    namespace report = sivid::report;
    detail::question q(model, catalogue, c, find);
    auto& [task, with_margins, asked, about] = q;
    auto const gains = task.open_gains();
    if (gains.empty())
        throw std::invalid_argument("--gain: give one a range to be searched, such as K=0:50");
    if (!c.out.empty()) prepare_folder(c.out);
    watch_interrupts();
    progress_line progress(c.quiet);
    progress.note("gains for " + task.scenario() + ", for all that " + task.dataset() + " leaves");
    sivid::gain_options options;
    options.motions = detail::options_for(c, 0.7 * c.budget, 60);
    options.boxes = c.boxes;
    auto const found = sivid::find_gains(about->problem, gains, asked, about->feasible, options);
    auto const left = [&] { return std::max(0.2, c.budget - progress.elapsed()); };
    std::optional<sivid::verification> proof;
    std::optional<sivid::prediction> tubes;
    auto page = task.page_options();
    if (found.suggested) {
        about->problem = sivid::with_gains(about->problem, gains, *found.suggested);
        about->direct = sivid::with_gains(about->direct, gains, *found.suggested);
        proof = sivid::verify(about->problem, asked, about->feasible,
                              detail::options_for(c, 0.5 * left(), 60));
        if (!c.out.empty()) {
            tubes = task.predicted(*about, detail::options_for(c, 0.5 * left()), asked.margins);
            detail::add_lines(page, task, *about, asked.margins, 0.5 * left());
        }
    }
    progress.finish();
    auto const* const proved = proof ? &*proof : nullptr;
    if (!c.out.empty()) {
        sivid::file_set files(c.out);
        files.add("gains.csv", sivid::gains_csv(found));
        files.add("control.html", report::control_page(*about, asked, found, proved,
                                                       tubes ? &*tubes : nullptr, page)
                                      .str());
        files.add("control.json",
                  sivid::control_json(*about, asked, found, proved, task.json_options()));
        files.commit();
    }
    std::cout << task.scenario() << ", " << task.dataset() << ": "
              << (found.some_proved()   ? "gains are proved"
                  : found.none_exists() ? "no gain will do"
                                        : "no gain is proved")
              << "\n  " << c.law << "\n  " << asked.text << "\n  " << report::gain_sentence(found)
              << "\n";
    if (proof) std::cout << "  with these: " << report::answer_sentence(*about, *proof) << "\n";
    detail::print_end(*about,
                      report::duration_text(found.seconds) + ", " +
                          std::to_string(found.paving.paving.boxes().size()) + " boxes, " +
                          std::to_string(found.parts) + " parts, " +
                          std::to_string(found.integrations),
                      c, (c.out / "control.html").string() + " and control.json, gains.csv");
    return found.some_proved() ? done : found.none_exists() ? refuted : undecided;
}

} // namespace console

#endif
