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
#include <sivid/number/text/joined.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/paving/least_disturbance.hpp>
#include <sivid/report/number_text.hpp>
#include <sivid/report/stored_page.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
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

/// What was asked, posed, and found.
struct least_disturbance_answer {
    using scales = std::vector<std::pair<std::string, double>>;
    dataset data;
    allowed_disturbances others; ///< of the model, beside what is asked for
    identification_problem problem{};
    disturbance_set set{};
    disturbance_bound found{};
    std::vector<disturbance_share> curve{};

    /// @throws bad_request
    least_disturbance_answer(robot const& r, disturbance_command const& c, scales const& on,
                             scales const& errors)
        : data{read_data(r, c.dataset)}, others{r.disturbances} {
        for (auto const& asked : on) (void)take_out(r, others.equations, asked.first);
        for (auto const& asked : errors) (void)take_out(r, others.channels, asked.first);
        problem = posed(r, data, c.effects, others);
        for (auto const& words : creeping_words(problem)) progress_line(c.quiet).note(words);
        least_disturbance_options options;
        options.seconds = c.budget / static_cast<double>(c.curve + 1);
        options.keep_going = wanted;
        try {
            set = disturbance_on(r.model, on, errors);
            require_valid(set, problem.model);
            found = least_disturbance(problem, set, options);
            options.seconds *= static_cast<double>(c.curve);
            if (c.curve > 0) curve = least_disturbance_curve(problem, set, c.curve, options);
        } catch (std::invalid_argument const& e) {
            throw bad_request(e.what());
        }
        for (auto const& words : assumptions_of(r, data, c.effects, others, problem))
            found.assumptions.push_back(words);
    }
};

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
inline std::string disturbance_json(disturbance_command const& c,
                                    least_disturbance_answer const& a) {
    auto const& problem = a.problem;
    auto const& found = a.found;
    auto const& about = problem.model.about;
    json_writer json;
    json.begin_object().members("format", "sivid-disturbance-1", "dataset", a.data.id);
    write_source(json, c, problem).members("curve", c.curve);
    json.members("time_unit", about.time_unit)
        .named("prior", problem.choice.unknown, problem.prior);
    write_disturbed(
        json, "equations", a.set.equations,
        [&](std::size_t i) { return about.states[i].equation_name(); },
        [&](std::size_t i) { return rate_unit(about.states[i].unit, about.time_unit); });
    write_disturbed(
        json, "channels", a.set.channels, [&](std::size_t i) { return about.channels[i].name; },
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

/// What was found, a sentence each, the bounds first.
inline std::vector<std::string> disturbance_words(identification_problem const& problem,
                                                  disturbance_set const& set,
                                                  disturbance_bound const& found) {
    auto const& about = problem.model.about;
    auto const stretch = [&](disturbed_stretch const& s) {
        return problem.experiments[s.experiment].name + " from " + nearest_text(s.from, 4) +
               " to " + nearest_text(s.to, 4) + " " + about.time_unit;
    };
    if (found.size.upper() == 0)
        return {"the model explains the data without disturbances (proved)"};
    std::string sizes;
    auto const add = [&](std::string const& name, double scale, std::string const& unit) {
        auto const of = interval_traits<interval>::mul(interval(scale), found.size);
        sizes += (sizes.empty() ? "" : ", ") + name + " " + to_decimal_lower(of.lower(), 4) +
                 " to " + (found.witness ? to_decimal_upper(of.upper(), 4) : "unknown") + " " +
                 unit;
    };
    for (auto const& q : set.equations)
        add(about.states[q.index].equation_name(), q.scale,
            rate_unit(about.states[q.index].unit, about.time_unit));
    for (auto const& q : set.channels)
        add(about.channels[q.index].name, q.scale, about.channels[q.index].unit);
    std::vector<std::string> words{"least disturbance: " + sizes + " (proved)"};
    for (auto const& s : found.needed)
        words.push_back("it is reached somewhere in " + stretch(s) + " (proved" +
                        (found.needed.size() > 1 ? ", of one of these)" : ")"));
    auto strong = strong_stretches(set, found);
    strong.resize(std::min<std::size_t>(strong.size(), 5));
    for (auto const& p : strong)
        words.push_back("the witness needs it in " + about.states[p.equation].equation_name() +
                        ": " + stretch(p) + ", " + nearest_text(p.value, 3) + " (others may not)");
    for (std::size_t j = 0; found.witness && j < found.hull.size(); ++j) {
        auto const& name = problem.choice.unknown[j];
        auto const& unit = about.constants[index_of(about.constants, name, "constant")].unit;
        words.push_back(
            "with disturbances up to it " + name + " in " +
            report::outward_text_within(found.hull[j], problem.prior[j]) +
            (unit == "1" ? "" : " " + unit) +
            (subset(problem.prior[j], found.hull[j]) ? " (nothing excluded)" : " (proved)"));
    }
    return words;
}

/// The command that identifies with disturbances a fifth larger than the witness's; "" without one.
inline std::string next_command(robot const& r, disturbance_command const& c,
                                disturbance_set const& set, disturbance_bound const& found) {
    if (!found.witness || found.size.upper() == 0) return {};
    auto const& about = r.model.about;
    std::string text = r.name + " identify " + (r.file.empty() ? "" : r.file + " ") +
                       c.dataset.string() + (c.effects.empty() ? "" : " --with ") +
                       joined(c.effects, ",");
    auto const value = [&](double scale) {
        return "=" + to_decimal_upper(1.2 * found.size.upper() * scale, 4);
    };
    for (auto const& q : set.equations)
        text += " --disturbance " + about.states[q.index].name + value(q.scale);
    for (auto const& q : set.channels)
        text += " --error " + about.channels[q.index].name + value(q.scale);
    return text;
}

inline std::string curve_csv(std::vector<disturbance_share> const& curve) {
    std::string text = "equations_lower,equations_upper,channels_lower,channels_upper\n";
    auto const cells = [](double share, interval const& size) {
        auto const both = interval_traits<interval>::mul(interval(share), size);
        bool const bounded = std::isfinite(both.upper());
        return to_decimal_lower(both.lower()) + "," +
               (bounded ? to_decimal_upper(both.upper()) : std::string{});
    };
    for (auto const& p : curve)
        text += cells(p.equations, p.found.size) + "," + cells(p.channels, p.found.size) + "\n";
    return text;
}

inline report::size_curve curve_of(std::vector<disturbance_share> const& curve) {
    report::size_curve lines;
    for (auto const& p : curve) {
        auto const add = [&p](std::vector<report::point>& line, double size) {
            if (std::isfinite(size)) line.push_back({p.equations * size, p.channels * size});
        };
        add(lines.first, p.found.size.lower());
        add(lines.second, p.found.size.upper());
    }
    return lines;
}

/// What the witness is disturbed by, over time.
inline std::vector<std::pair<std::string, report::channel_series>>
witness_series(identification_problem const& problem, disturbance_set const& set,
               disturbance_bound const& found) {
    auto const& about = problem.model.about;
    std::vector<std::pair<std::string, report::channel_series>> all;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        for (auto const& q : set.equations) {
            auto const& state = about.states[q.index];
            report::channel_series line{.name = state.equation_name(),
                                        .unit = rate_unit(state.unit, about.time_unit),
                                        .time_unit = about.time_unit,
                                        .zero = true};
            for (auto const& p : found.pieces)
                if (p.experiment == e && p.equation == q.index)
                    line.after.insert(line.after.end(), {{p.from, p.value}, {p.to, p.value}});
            if (!line.after.empty()) all.emplace_back(problem.experiments[e].name, line);
        }
    }
    return all;
}

} // namespace detail

SIVID_DECL int run(robot const& r, disturbance_command const& c) {
    watch_interrupts();
    progress_line progress(c.quiet);
    progress.note("bounding the least disturbance");
    detail::least_disturbance_answer const a(r, c, detail::scales_from(c.on, "--on"),
                                             detail::scales_from(c.errors, "--error"));
    auto const& [data, others, problem, set, found, curve] = a;
    progress.finish();
    prepare_folder(c.out);
    file_set files(c.out);
    files.add("disturbance.json", detail::disturbance_json(c, a));
    files.add("disturbance.csv", detail::disturbance_csv(problem, found));
    auto words = detail::disturbance_words(problem, set, found);
    if (auto const next = detail::next_command(r, c, set, found); !next.empty())
        words.push_back("which constants remain with 1.2 times that: " + next + " --out DIR");
    report::disturbance_page(title_of(data, c.effects, others, problem.model), words,
                             found.witness.has_value(), detail::witness_series(problem, set, found),
                             detail::curve_of(curve), found.assumptions,
                             page_footer(c.command_line))
        .add_to(files);
    if (c.curve > 0)
        files.add("curve.csv", detail::curve_csv(curve));
    else
        files.drop("curve.csv"); // of an earlier result
    files.commit();
    auto indent = "";
    for (auto const& line : words) result_stream() << std::exchange(indent, "  ") << line << "\n";
    result_stream() << "  " << report::duration_text(found.seconds) << ", " << found.boxes
                    << " boxes; written: " << (c.out / "disturbance.html").string()
                    << " and disturbance.json, disturbance.csv"
                    << (c.curve > 0 ? ", curve.csv\n" : "\n");
    return found.witness && found.size.lower() >= 0.5 * found.size.upper() ? done : undecided;
}

} // namespace sivid::app

#endif
