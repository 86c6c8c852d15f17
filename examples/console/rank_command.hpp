// SPDX-License-Identifier: MIT
// rank, for any model: how far each parameter can move the measurements of a data set.
#ifndef EXAMPLES_CONSOLE_RANK_COMMAND_HPP
#define EXAMPLES_CONSOLE_RANK_COMMAND_HPP

#include "console.hpp"
#include "program.hpp"

#include <sivid/decision/rank.hpp>
#include <sivid/io/decision_json.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/ranking_page.hpp>
#include <sivid/version.hpp>

#include <filesystem>
#include <iostream>
#include <string>

namespace console {

/// What is ranked, by name, and where the answer goes.
struct rank_request {
    std::string dataset, scenario;
    std::filesystem::path out;
    double budget = 10; ///< [s]
    bool quiet = false;
    std::string command_line;
};

/// Ranks, prints one line a channel, and writes ranking.html and ranking.json.
/// @returns done, or undecided where bounds are still apart
/// @throws std::invalid_argument, sivid::output_error
inline int run_rank(sivid::identification_problem const& problem, rank_request const& c) {
    namespace report = sivid::report;
    prepare_folder(c.out);
    watch_interrupts();
    progress_line progress(c.quiet);
    progress.note("ranking the parameters of " + (c.scenario.empty() ? c.dataset : c.scenario));
    sivid::rank_options options;
    options.seconds = c.budget;
    options.keep_going = [] { return !interrupted(); };
    auto const found = sivid::rank(problem, options);
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
    files.add("ranking.html", report::ranking_page(problem, found, page).str());
    files.add("ranking.json", sivid::ranking_json(problem, found, json));
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
              << found.integrations
              << " validated integrations\n  written: " << (c.out / "ranking.html").string()
              << " and ranking.json\n";
    return found.complete ? done : undecided;
}

} // namespace console

#endif
