// SPDX-License-Identifier: MIT
// rank, for any model: how far each parameter can move the measurements of a data set, and what
// these are worth.
#ifndef EXAMPLES_CONSOLE_RANK_COMMAND_HPP
#define EXAMPLES_CONSOLE_RANK_COMMAND_HPP

#include "console.hpp"
#include "program.hpp"

#include <sivid/decision/measurement_ranking.hpp>
#include <sivid/decision/rank.hpp>
#include <sivid/io/decision_json.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/paving/run_options.hpp>
#include <sivid/report/decision_page.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/version.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

namespace console {

/// What is ranked, by name, and where the answer goes.
struct rank_request {
    std::string dataset, scenario;
    std::filesystem::path out;
    double budget = 10; ///< [s]
    bool quiet = false;
    std::string command_line;
    sivid::run_options run{}; ///< how experiments are enclosed
};

/// Ranks parameters and, of a data set, measurements; prints one line a channel or a group, and
/// writes ranking.html and ranking.json.
/// @returns done, or undecided where bounds are still apart
/// @throws std::invalid_argument, sivid::output_error
inline int run_rank(sivid::identification_problem const& problem, rank_request const& c) {
    namespace report = sivid::report;
    prepare_folder(c.out);
    watch_interrupts();
    progress_line progress(c.quiet);
    progress.note("ranking the parameters of " + (c.scenario.empty() ? c.dataset : c.scenario));
    auto const keep_going = [] { return !interrupted(); };
    sivid::rank_options options;
    options.seconds = c.scenario.empty() ? c.budget / 2 : c.budget;
    options.keep_going = keep_going;
    options.run = c.run;
    auto const found = sivid::rank(problem, options);
    std::optional<sivid::measurement_ranking> measurements;
    if (c.scenario.empty()) { // a scenario has none
        progress.note("ranking the measurements");
        sivid::measurement_ranking_options asked;
        asked.seconds = std::max(0.0, c.budget - found.seconds);
        asked.keep_going = keep_going;
        asked.run = c.run;
        measurements = sivid::rank_measurements(problem, asked);
    }
    auto const* const worth = measurements ? &*measurements : nullptr;
    progress.finish();
    sivid::decision_json_options json;
    json.dataset = c.dataset;
    json.scenario = c.scenario;
    report::decision_page_options page;
    page.dataset = c.dataset;
    page.scenario = c.scenario;
    page.footer = {std::string{"sivid "} + std::string{sivid::version}, today(), machine_text(),
                   c.command_line};
    sivid::file_set files(c.out);
    files.add("ranking.html", report::ranking_page(problem, found, page, worth).str());
    files.add("ranking.json", sivid::ranking_json(problem, found, json, worth));
    files.commit();
    std::cout << "effects in error bounds, over the whole prior, strongest first: "
              << (found.complete ? "proved" : "proved, some bounds still apart") << "\n";
    for (auto const& channel : found.channels) {
        std::cout << "  " << problem.experiments[channel.experiment].name << " "
                  << problem.model.about.channels[channel.channel].name << ":";
        for (auto const j : channel.order()) {
            auto const& e = channel.effects[j];
            if (e.high == 0) continue;
            std::cout << " " << problem.choice.unknown[j] << " " << report::effect_text(e);
        }
        std::cout << "\n";
    }
    for (auto const& line : report::ranking_sentences(problem, found))
        std::cout << "  " << line << "\n";
    std::cout << "  " << report::duration_text(found.seconds) << ", " << found.parts << " parts, "
              << found.integrations << " validated integrations\n";
    if (worth != nullptr) {
        std::cout << "what explains the data grows without some of them: "
                  << (worth->complete ? "proved" : "proved, some bounds still apart") << "\n";
        for (auto const& g : worth->groups)
            std::cout << "  without " << report::group_text(problem, g.what) << " ("
                      << g.measurements << "): " << report::growth_text(g.growth) << "\n";
        if (worth->explained == sivid::verdict::inconsistent)
            std::cout << "  no parameter explains all of the data: nothing can grow\n";
        std::cout << "  " << report::duration_text(worth->seconds) << ", " << worth->integrations
                  << " validated integrations\n";
    }
    std::cout << "  written: " << (c.out / "ranking.html").string() << " and ranking.json\n";
    bool const complete = found.complete && (worth == nullptr || worth->complete);
    return complete ? done : undecided;
}

} // namespace console

#endif
