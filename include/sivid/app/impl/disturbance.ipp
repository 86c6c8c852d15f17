// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_DISTURBANCE_IPP
#define SIVID_APP_IMPL_DISTURBANCE_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/console.hpp>
#include <sivid/app/detail/parameter_ranges.hpp>
#include <sivid/app/detail/posed_problem.hpp>
#include <sivid/app/program.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/io/text/json_writer.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/paving/least_disturbance.hpp>
#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace sivid::app {

namespace detail {

inline std::vector<std::pair<std::string, double>> scales_from(std::vector<std::string> const& list,
                                                               std::string const& option) {
    std::vector<std::pair<std::string, double>> result;
    for (auto const& [name, range] : ranges_from(list, option))
        result.emplace_back(name, one_value(option + " " + name, range));
    return result;
}

/// What is disturbed: names, units and scales.
template <class Name, class Unit>
void write_disturbed(json_writer& json, std::string_view what,
                     std::vector<disturbed_quantity> const& all, Name const& name,
                     Unit const& unit) {
    json.list(what, all, [&](disturbed_quantity const& q) {
        json.object("name", name(q.index), "unit", unit(q.index), "scale", q.scale);
    });
}

/// disturbance.json, sivid-disturbance-1: what is a bound is written outward.
inline std::string disturbance_json(identification_problem const& problem,
                                    disturbance_set const& set, disturbance_bound const& found,
                                    std::string const& dataset) {
    auto const& about = problem.model.about;
    json_writer json;
    json.begin_object().members("format", "sivid-disturbance-1", "dataset", dataset);
    json.members("time_unit", about.time_unit)
        .named("prior", problem.choice.unknown, problem.prior);
    write_disturbed(
        json, "equations", set.equations,
        [&](std::size_t i) { return about.states[i].equation_name(); },
        [&](std::size_t i) { return rate_unit(about.states[i].unit, about.time_unit); });
    write_disturbed(
        json, "channels", set.channels, [&](std::size_t i) { return about.channels[i].name; },
        [&](std::size_t i) { return about.channels[i].unit; });
    json.members("size", found.size);
    json.list("needed", found.needed, [&](disturbed_stretch const& s) {
        json.object("experiment", problem.experiments[s.experiment].name, "from", s.from, "to",
                    s.to);
    });
    json.named("hull", problem.choice.unknown, found.hull);
    json.key("witness");
    if (found.witness) {
        json.begin_object().named("parameters", problem.choice.unknown, found.witness->parameters);
        json.key("initial").begin_object();
        for (std::size_t s = 0; s < problem.experiments.size(); ++s)
            json.named(problem.experiments[s].name, about.states, found.witness->starts[s]);
        json.end_object().members("disturbances", "disturbance.csv").end_object();
    } else {
        json.null();
    }
    json.members("assumptions", found.assumptions, "boxes", found.boxes, "seconds", found.seconds);
    return json.end_object().text();
}

/// disturbance.csv: what the witness is disturbed by, in the digits of its doubles.
inline std::string disturbance_csv(identification_problem const& problem,
                                   disturbance_bound const& found) {
    std::string text = "scenario,equation,from,to,value\n";
    for (auto const& p : found.pieces)
        text += io_detail::cell(problem.experiments[p.experiment].name) + "," +
                io_detail::cell(problem.model.about.states[p.equation].equation_name()) + "," +
                nearest_text(p.from) + "," + nearest_text(p.to) + "," + nearest_text(p.value) +
                "\n";
    return text;
}

/// Stretches in which the witness has nine tenths of the size or more, the longest first.
inline std::vector<disturbance_piece> strong_stretches(disturbance_set const& set,
                                                       disturbance_bound const& found) {
    std::vector<disturbance_piece> result;
    for (auto const& p : found.pieces) {
        auto const q = std::find_if(set.equations.begin(), set.equations.end(),
                                    [&](auto const& e) { return e.index == p.equation; });
        if (!(std::abs(p.value) >= 0.9 * found.size.upper() * q->scale) || p.value == 0) continue;
        bool const goes_on = !result.empty() && result.back().to == p.from &&
                             result.back().experiment == p.experiment &&
                             result.back().equation == p.equation &&
                             (result.back().value > 0) == (p.value > 0);
        if (goes_on)
            result.back().to = p.to;
        else
            result.push_back(p);
    }
    std::stable_sort(result.begin(), result.end(),
                     [](auto const& a, auto const& b) { return a.to - a.from > b.to - b.from; });
    return result;
}

inline void print_disturbance(identification_problem const& problem, disturbance_set const& set,
                              disturbance_bound const& found) {
    auto const& about = problem.model.about;
    auto const stretch = [&](disturbed_stretch const& s) {
        return problem.experiments[s.experiment].name + " from " + nearest_text(s.from, 4) +
               " to " + nearest_text(s.to, 4) + " " + about.time_unit;
    };
    if (found.size.upper() == 0) {
        std::cout << "the model explains the data without disturbances (proved)\n";
        return;
    }
    std::cout << "least disturbance: " << to_decimal_lower(found.size.lower(), 4) << " to "
              << (found.witness ? to_decimal_upper(found.size.upper(), 4) : "unknown")
              << " (proved), times";
    for (auto const& q : set.equations)
        std::cout << " " << about.states[q.index].equation_name() << "=" << nearest_text(q.scale)
                  << " " << rate_unit(about.states[q.index].unit, about.time_unit);
    for (auto const& q : set.channels)
        std::cout << " " << about.channels[q.index].name << "=" << nearest_text(q.scale) << " "
                  << about.channels[q.index].unit;
    std::cout << "\n";
    for (auto const& s : found.needed)
        std::cout << "  it is reached somewhere in " << stretch(s) << " (proved"
                  << (found.needed.size() > 1 ? ", of one of these" : "") << ")\n";
    auto strong = strong_stretches(set, found);
    strong.resize(std::min<std::size_t>(strong.size(), 5));
    for (auto const& p : strong)
        std::cout << "  the witness needs it in " << about.states[p.equation].equation_name()
                  << ": " << stretch(p) << ", " << nearest_text(p.value, 3)
                  << " (others may not)\n";
    if (found.witness)
        for (std::size_t j = 0; j < found.hull.size(); ++j)
            std::cout << "  with disturbances up to it " << problem.choice.unknown[j] << " in "
                      << report::outward_text_within(found.hull[j], problem.prior[j])
                      << (subset(problem.prior[j], found.hull[j]) ? " (nothing excluded)\n"
                                                                  : " (proved)\n");
}

} // namespace detail

SIVID_DECL int run(robot const& r, disturbance_command const& c) {
    auto const data = read_data(r, c.dataset);
    auto const problem = posed(r, data, c.effects, {});
    disturbance_set set;
    least_disturbance_options options;
    disturbance_bound found;
    watch_interrupts();
    progress_line progress(c.quiet);
    try {
        set = disturbance_on(r.model, detail::scales_from(c.on, "--on"),
                             detail::scales_from(c.errors, "--error"));
        require_valid(set, problem.model);
        progress.note("bounding the least disturbance of " + data.id);
        options.seconds = c.budget;
        options.keep_going = wanted;
        found = least_disturbance(problem, set, options);
    } catch (std::invalid_argument const& e) {
        throw bad_request(e.what());
    }
    progress.finish();
    for (auto const& words : assumptions_of(r, data, c.effects, {}, problem.model))
        found.assumptions.push_back(words);
    prepare_folder(c.out);
    file_set files(c.out);
    files.add("disturbance.json", detail::disturbance_json(problem, set, found, data.id));
    files.add("disturbance.csv", detail::disturbance_csv(problem, found));
    files.commit();
    detail::print_disturbance(problem, set, found);
    std::cout << "  " << report::duration_text(found.seconds) << ", " << found.boxes
              << " boxes; written: " << (c.out / "disturbance.json").string()
              << " and disturbance.csv\n";
    return found.witness && found.size.lower() >= 0.5 * found.size.upper() ? done : undecided;
}

} // namespace sivid::app

#endif
