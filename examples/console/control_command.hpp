// SPDX-License-Identifier: MIT
// control, for any model: which gains of a law meet a requirement, whatever the data leave open.
#ifndef EXAMPLES_CONSOLE_CONTROL_COMMAND_HPP
#define EXAMPLES_CONSOLE_CONTROL_COMMAND_HPP

#include "console.hpp"
#include "decision_task.hpp"
#include "program.hpp"

#include <sivid/decision/gain_search.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/verification.hpp>
#include <sivid/io/decision_json.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/report/control_page.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace console {

/// `control`: prints what is known of the gains; with `out`, writes control.html, control.json and
/// gains.csv. @returns done when some are proved, refuted when none exists, or undecided
inline int run_control(sivid::recorded_model const& model,
                       std::vector<sivid::effect> const& catalogue, decision_command const& c,
                       scenario_finder const& find) {
    namespace report = sivid::report;
    detail::decision_task task(model, catalogue, c, find);
    auto asked_model = task.model();
    auto const asked = sivid::parse_requirement(task.requirement(), asked_model, task.end());
    auto const about = task.prediction_for(asked_model, asked.margins);
    auto const gains = task.open_gains();
    if (gains.empty())
        throw std::invalid_argument("--gain: give one a range to be searched, such as K=0:50");
    if (!c.out.empty()) prepare_folder(c.out);
    watch_interrupts();
    progress_line progress(c.quiet);
    progress.note("gains for " + task.scenario() + ", for all that " + task.dataset() + " leaves");
    sivid::gain_options options;
    options.motions.seconds = 0.7 * c.budget;
    options.motions.keep_going = [] { return !console::interrupted(); };
    options.motions.cells = 60;
    auto const found = sivid::find_gains(about->problem, gains, asked, about->feasible, options);
    auto const left = [&] { return std::max(0.2, c.budget - progress.elapsed()); };
    std::optional<sivid::verification> proof;
    std::optional<sivid::prediction> tubes;
    auto page = task.page_options();
    if (found.suggested) {
        about->problem = sivid::with_gains(about->problem, gains, *found.suggested);
        about->direct = sivid::with_gains(about->direct, gains, *found.suggested);
        auto trying = detail::options_for(0.5 * left());
        trying.cells = 60;
        proof = sivid::verify(about->problem, asked, about->feasible, trying);
        if (!c.out.empty()) {
            tubes =
                sivid::predict(about->problem, detail::options_for(0.5 * left()), asked.margins);
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
    for (auto const& line : report::decision_assumptions(*about))
        std::cout << "  - " << line << "\n";
    std::cout << "  " << report::duration_text(found.seconds) << ", "
              << found.paving.paving.boxes().size() << " boxes, " << found.parts << " parts, "
              << found.integrations << " validated integrations\n";
    if (!c.out.empty())
        std::cout << "  written: " << (c.out / "control.html").string()
                  << " and control.json, gains.csv\n";
    return found.some_proved() ? done : found.none_exists() ? refuted : undecided;
}

} // namespace console

#endif
