// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_RANK_IPP
#define SIVID_APP_IMPL_RANK_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/console.hpp>
#include <sivid/app/detail/parameter_ranges.hpp>
#include <sivid/app/detail/posed_problem.hpp>
#include <sivid/app/names.hpp>
#include <sivid/app/program.hpp>
#include <sivid/decision/measurement_ranking.hpp>
#include <sivid/decision/rank.hpp>
#include <sivid/io/decision_json.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/report/decision_page.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/stored_page.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sivid::app {

namespace detail {

/// The error bounds of what a scenario is measured with.
inline std::vector<double> errors_of(robot const& r, rank_command const& c) {
    auto const& channels = r.model.about.channels;
    if (c.measure.empty() && r.errors.empty())
        throw bad_request(
            "--measure: say with which error bounds a scenario is measured, such as " +
            channels.front().name + "=0.01");
    if (c.measure.empty()) return r.errors;
    std::vector<double> errors(channels.size(), 0.0);
    for (auto const& [name, bound] : ranges_from(c.measure, "--measure")) {
        require_known(name, names_in(channels), "channel");
        errors[index_of(channels, name, "channel")] = one_value("--measure " + name, bound);
    }
    return errors;
}

/// Constants of scenarios in their priors, seen at regular times within error bounds.
inline identification_problem measured(robot const& r, rank_command const& c) {
    identification_problem problem{r.model, {}, {}, {}};
    std::vector<interval> prior;
    for (auto const& u : c.unknown) {
        problem.choice.unknown.push_back(u.name);
        prior.push_back(*enclose(u.lower, u.upper));
    }
    problem.prior = box(prior);
    auto const errors = errors_of(r, c);
    for (auto const& s : find_scenarios(r, c.scenario)) {
        experiment e;
        e.name = s.name;
        e.initial = box(s.initial.size());
        for (std::size_t i = 0; i < s.initial.size(); ++i) e.initial[i] = s.initial[i].enclosure;
        for (auto const& input : s.inputs) e.inputs.push_back(exact_signal(input, s.duration));
        auto const instants = static_cast<int>(c.rate * s.duration + 1e-9);
        for (int n = 1; n <= instants; ++n) {
            for (std::size_t k = 0; k < errors.size(); ++k) {
                if (errors[k] > 0)
                    e.measurements.push_back({n / c.rate, k, {-errors[k], errors[k]}});
            }
        }
        problem.experiments.push_back(std::move(e));
    }
    return problem;
}

inline void print_channels(identification_problem const& problem, ranking const& found) {
    result_stream() << "effects in error bounds, over the whole prior, strongest first: "
                    << (found.complete ? "proved" : "proved, some bounds still apart") << "\n";
    for (auto const& channel : found.channels) {
        result_stream() << "  " << problem.experiments[channel.experiment].name << " "
                        << problem.model.about.channels[channel.channel].name << ":";
        for (auto const j : channel.order()) {
            auto const& e = channel.effects[j];
            if (e.high == 0) continue;
            result_stream() << " " << problem.choice.unknown[j] << " " << report::effect_text(e);
        }
        result_stream() << "\n";
    }
    for (auto const& line : report::ranking_sentences(problem, found))
        result_stream() << "  " << line << "\n";
    result_stream() << "  " << report::duration_text(found.seconds) << ", " << found.parts
                    << " parts, " << found.integrations << " validated integrations\n";
}

inline void print_worth(identification_problem const& problem, measurement_ranking const& worth) {
    result_stream() << "what explains the data grows without some of them: "
                    << (worth.complete ? "proved" : "proved, some bounds still apart") << "\n";
    for (auto const& g : worth.groups)
        result_stream() << "  without " << report::group_text(problem, g.what) << " ("
                        << g.measurements << "): " << report::growth_text(g.growth) << "\n";
    if (worth.explained == verdict::inconsistent)
        result_stream() << "  no parameter explains all of the data: nothing can grow\n";
    result_stream() << "  " << report::duration_text(worth.seconds) << ", " << worth.integrations
                    << " validated integrations\n";
}

} // namespace detail

/// Ranks parameters and, of a data set, measurements; prints one line a channel or a group, and
/// writes ranking.html and ranking.json. Undecided where bounds are still apart.
SIVID_DECL int run(robot const& r, rank_command const& c) {
    if (c.scenario.empty() == c.dataset.empty())
        throw bad_request("give a data set or --scenario, one of the two");
    bool const of_data = c.scenario.empty();
    auto const disturbances = disturbances_from(r, c.disturbed, c.errors);
    std::optional<dataset> data;
    if (of_data) data = read_data(r, c.dataset);
    auto const name = data ? data->id : std::string{};
    auto const problem = data ? posed(r, *data, c.effects, disturbances)
                              : disturbed(detail::measured(r, c), disturbances);
    rank_options options;
    apply(c.how, options.run);
    prepare_folder(c.out);
    watch_interrupts();
    progress_line progress(c.quiet);
    progress.note("ranking the parameters of " + (of_data ? name : c.scenario));
    options.seconds = of_data ? c.budget / 2 : c.budget;
    options.keep_going = wanted;
    auto const found = rank(problem, options);
    std::optional<measurement_ranking> measurements;
    if (of_data) { // a scenario has none
        progress.note("ranking the measurements");
        measurement_ranking_options asked;
        asked.seconds = std::max(0.0, c.budget - found.seconds);
        asked.keep_going = wanted;
        asked.run = options.run;
        measurements = rank_measurements(problem, asked);
    }
    auto const* const worth = measurements ? &*measurements : nullptr;
    progress.finish();
    decision_json_options json;
    report::decision_page_options page;
    json.dataset = name;
    page.scenario = json.scenario = c.scenario;
    if (data)
        page.dataset = title_of(*data, c.effects, disturbances, problem.model);
    else if (!disturbances.empty())
        page.scenario += " for all disturbances of " + in_words(disturbances, problem.model);
    page.footer = page_footer(c.command_line);
    file_set files(c.out);
    report::ranking_page(problem, found, page, measurements).add_to(files);
    files.add("ranking.json", ranking_json(problem, found, json, worth));
    files.commit();
    detail::print_channels(problem, found);
    if (worth != nullptr) detail::print_worth(problem, *worth);
    for (auto const& words : data ? assumptions_of(r, *data, c.effects, disturbances, problem)
                                  : assumptions_of(disturbances, problem.model))
        result_stream() << "  - " << words << "\n";
    result_stream() << "  written: " << (c.out / "ranking.html").string() << " and ranking.json\n";
    return found.complete && (worth == nullptr || worth->complete) ? done : undecided;
}

} // namespace sivid::app

#endif
