// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_DECIDE_IPP
#define SIVID_APP_IMPL_DECIDE_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/console.hpp>
#include <sivid/app/detail/decision_task.hpp>
#include <sivid/app/program.hpp>
#include <sivid/decision/gain_search.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/verification.hpp>
#include <sivid/io/decision_json.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/report/decision_page.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/stored_page.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sivid::app::detail {

/// `predict`: writes prediction.html, prediction.json and tubes.csv. @returns an exit code
inline int run_predict(robot const& r, decision_command const& c) {
    decision_task task(r, c);
    auto const about = task.prediction_for(task.model(), {});
    prepare_folder(c.out); // nothing is written when the input is bad
    watch_interrupts();
    progress_line progress(c.quiet);
    progress.note("predicting " + task.scenario() + " for all that " + task.dataset() + " leaves");
    auto const found = task.predicted(*about, options_for(c, c.budget), {});
    auto options = task.page_options();
    add_lines(options, task, *about, {}, std::max(0.2, c.budget - progress.elapsed()));
    progress.finish();
    file_set files(c.out);
    files.add("tubes.csv", tubes_csv(found));
    report::prediction_page(*about, found, options).add_to(files);
    files.add("prediction.json", prediction_json(*about, found, task.json_options()));
    files.commit();
    result_stream() << task.scenario() << " for all parameters that " << task.dataset()
                    << " leaves: "
                    << (found.complete ? "proved"
                                       : "proved up to t = " + report::exact_text(found.reached) +
                                             " " + about->problem.model.about.time_unit + " only")
                    << "\n";
    for (auto const& channel : found.channels) {
        report::range const last{channel.low.back(), channel.high.back()};
        result_stream() << "  " << channel.name << " at the end in "
                        << (is_finite(last) ? report::outward_text(last) : "no known bounds")
                        << (channel.unit == "1" ? "" : " " + channel.unit) << "\n";
    }
    if (!found.complete)
        result_stream()
            << "  fewer parameters (an identification that excludes more), a narrower start or "
               "a shorter scenario reach farther; --budget only if it was spent\n";
    if (std::isfinite(found.excess))
        result_stream() << "  tubes at most " << report::wider_text(found.excess)
                        << (found.excess < 1 ? " than" : " as") << " what these parameters reach\n";
    result_stream() << "  " << report::duration_text(found.seconds) << ", " << found.parts
                    << " parts, " << found.integrations << " validated integrations\n  written: "
                    << (c.out / "prediction.html").string() << " and prediction.json, tubes.csv\n";
    return found.complete ? done : undecided;
}

/// What an answer rests on, what it took, and what was written.
inline void print_end(stored_prediction const& about, std::string const& effort,
                      decision_command const& c, std::string const& files) {
    for (auto const& line : report::decision_assumptions(about))
        result_stream() << "  - " << line << "\n";
    result_stream() << "  " << effort << " validated integrations\n";
    if (!c.out.empty()) result_stream() << "  written: " << files << "\n";
}

/// `verify`: prints the answer; with `out`, writes verification.html and verification.json.
/// @returns done when proved, refuted, or undecided
inline int run_verify(robot const& r, decision_command const& c) {
    question const q(r, c);
    auto const& [task, with_margins, asked, about] = q;
    if (!c.out.empty()) prepare_folder(c.out);
    watch_interrupts();
    progress_line progress(c.quiet);
    progress.note("verifying " + task.scenario() + " for all that " + task.dataset() + " leaves");
    auto const found = verify(about->problem, asked, about->feasible, options_for(c, c.budget, 60));
    double const answered = progress.elapsed();
    if (!c.out.empty()) {
        progress.note("tubes for the page");
        auto page = task.page_options();
        double const left = std::max(0.2, c.budget - progress.elapsed());
        auto const tubes = task.predicted(*about, options_for(c, 0.5 * left), asked.margins);
        add_lines(page, task, *about, asked.margins, 0.3 * left);
        if (found.witness) {
            page.single = task.simulated(*about, asked.margins, found.witness->parameters,
                                         found.witness->start);
            page.single_is = "the witness that violates it, simulated";
        }
        file_set files(c.out);
        report::verification_page(*about, asked, found, tubes, page).add_to(files);
        files.add("verification.json",
                  verification_json(*about, asked, found, task.json_options()));
        files.commit();
    }
    progress.finish();
    auto const page_time =
        c.out.empty() ? ""
                      : " (the page " + report::duration_text(progress.elapsed() - answered) + ")";
    result_stream() << task.scenario() << ", " << task.dataset() << ": " << to_string(found.answer)
                    << "\n  " << asked.text << "\n  " << report::answer_sentence(*about, found)
                    << "\n";
    print_end(*about,
              report::duration_text(found.seconds) + page_time + ", " +
                  std::to_string(found.parts) + " parts, " + std::to_string(found.integrations),
              c, (c.out / "verification.html").string() + " and verification.json");
    return found.answer == requirement_answer::proved    ? done
           : found.answer == requirement_answer::refuted ? refuted
                                                         : undecided;
}

/// Gains that were suggested, with what was proved of them.
struct proved_gains {
    std::optional<verification> proof;
    std::optional<prediction> tubes;
};

/// Follows the suggested gains, if there are any: the task is of them then.
inline proved_gains prove_gains(question& q, std::vector<std::string> const& gains,
                                gain_set const& found, decision_command const& c,
                                std::function<double()> const& left,
                                report::decision_page_options& page) {
    proved_gains result;
    if (!found.suggested) return result;
    auto& [task, with_margins, asked, about] = q;
    about->problem = with_gains(about->problem, gains, *found.suggested);
    about->direct = with_gains(about->direct, gains, *found.suggested);
    result.proof = verify(about->problem, asked, about->feasible, options_for(c, 0.5 * left(), 60));
    if (c.out.empty()) return result;
    result.tubes = task.predicted(*about, options_for(c, 0.5 * left()), asked.margins);
    add_lines(page, task, *about, asked.margins, 0.5 * left());
    return result;
}

inline void print_gains(question const& q, gain_set const& found,
                        std::optional<verification> const& proof, decision_command const& c) {
    auto const& [task, with_margins, asked, about] = q;
    result_stream() << task.scenario() << ", " << task.dataset() << ": "
                    << (found.some_proved()   ? "gains are proved"
                        : found.none_exists() ? "no gain will do"
                                              : "no gain is proved")
                    << "\n  " << c.law << "\n  " << asked.text << "\n  "
                    << report::gain_sentence(found) << "\n";
    if (proof)
        result_stream() << "  with these: " << report::answer_sentence(*about, *proof) << "\n";
    print_end(*about,
              report::duration_text(found.seconds) + ", " +
                  std::to_string(found.paving.paving.boxes().size()) + " boxes, " +
                  std::to_string(found.parts) + " parts, " + std::to_string(found.integrations),
              c, (c.out / "control.html").string() + " and control.json, gains.csv");
}

/// `control`: prints what is known of the gains; with `out`, writes control.html, control.json and
/// gains.csv. @returns done when some are proved, refuted when none exists, or undecided
inline int run_control(robot const& r, decision_command const& c) {
    question q(r, c);
    auto& [task, with_margins, asked, about] = q;
    auto const gains = task.open_gains();
    if (gains.empty()) throw bad_request("--gain: give one a range to be searched, such as K=0:50");
    if (!c.out.empty()) prepare_folder(c.out);
    watch_interrupts();
    progress_line progress(c.quiet);
    progress.note("gains for " + task.scenario() + ", for all that " + task.dataset() + " leaves");
    gain_options options;
    options.motions = options_for(c, 0.7 * c.budget, 60);
    options.boxes = c.boxes;
    auto const found = find_gains(about->problem, gains, asked, about->feasible, options);
    auto const left = [&] { return std::max(0.2, c.budget - progress.elapsed()); };
    auto page = task.page_options();
    auto const [proof, tubes] = prove_gains(q, gains, found, c, left, page);
    progress.finish();
    if (!c.out.empty()) {
        file_set files(c.out);
        files.add("gains.csv", gains_csv(found));
        report::control_page(*about, asked, found, proof, tubes, page).add_to(files);
        files.add("control.json", control_json(*about, asked, found, proof ? &*proof : nullptr,
                                               task.json_options()));
        files.commit();
    }
    print_gains(q, found, proof, c);
    return found.some_proved() ? done : found.none_exists() ? refuted : undecided;
}

} // namespace sivid::app::detail

#endif
