// SPDX-License-Identifier: MIT
// predict, verify and control, for any model: what a stored identification says of a scenario.
#ifndef EXAMPLES_CONSOLE_DECISION_COMMANDS_HPP
#define EXAMPLES_CONSOLE_DECISION_COMMANDS_HPP

#include "console.hpp"
#include "control_command.hpp"
#include "decision_task.hpp"
#include "program.hpp"
#include "result_files.hpp"

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
    auto found = sivid::predict(about->problem, detail::options_for(c.budget));
    if (about->starts_follow) found.excess = HUGE_VAL; // not all of these motions are possible
    if (!task.keeps_slews(found)) { // then the law may act later than was taken into account
        found.complete = false;
        found.reached = 0;
        about->assumptions.push_back(
            "the sampled law keeps the limits of its slew: NOT proved, "
            "the tubes pass them or end before, so that nothing is proved here");
    }
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
    auto const asked = sivid::parse_requirement(task.requirement(), asked_model, task.end());
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

/// @returns an exit code
inline int run_decision(decision what, sivid::recorded_model const& model,
                        std::vector<sivid::effect> const& catalogue, decision_command const& c,
                        scenario_finder const& find) {
    switch (what) {
    case decision::predict:
        return run_predict(model, catalogue, c, find);
    case decision::verify:
        return run_verify(model, catalogue, c, find);
    case decision::control:
        break;
    }
    return run_control(model, catalogue, c, find);
}

} // namespace console

#endif
