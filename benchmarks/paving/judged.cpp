// SPDX-License-Identifier: MIT
// The campaigns by which identification is judged, each from a cold start of `identify`:
//     sivid_benchmark_judged [--seconds S] [--halvings N] [--only NAME] CAMPAIGN NINE
// CAMPAIGN: a data set with the scenarios S1, S2, S3 of the report and further ones, of three
// unknown parameters and no effect; NINE: one whose prior has nine, used with CAMPAIGN's data.
// Hulls stand beside those of points that explain the data by simulation, found by fits with one
// side held (N = 0: none); NAME is a part of a campaign's name.
#include "model.hpp"

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/io/dataset.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/paving/identify.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <optional>
#include <string>
#include <vector>

namespace {

using sivid::box;
using sivid::interval;

double processor_seconds() {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

/// The smallest box around points that explain the data by simulation (not proved): each side is
/// held farther and farther out, by bisection, while a fit of all else explains the data.
box reached_hull(sivid::identification_problem const& problem, sivid::approximate_fit const& first,
                 box const& around, std::size_t halvings) {
    auto found = sivid::point_box(first.parameters);
    for (std::size_t j = 0; j < around.size(); ++j) {
        for (double const end : {around[j].lower(), around[j].upper()}) {
            auto best = first;
            double out = end;
            for (std::size_t k = 0; k < halvings; ++k) {
                double const at = k == 0 ? end : (best.parameters[j] + out) / 2;
                auto held = problem;
                held.prior[j] = interval(at);
                auto p = best.parameters;
                p[j] = at;
                auto fit = sivid::approximate_fitter(held)({p, best.starts});
                if (fit.inflation <= 1) {
                    fit.parameters[j] = at;
                    found = hull(found, sivid::point_box(fit.parameters));
                    best = std::move(fit);
                } else {
                    out = at;
                }
            }
        }
    }
    return found;
}

void print_side(std::string const& name, interval const& range, interval const* reached) {
    std::printf("    %-12s [%.7g, %.7g]", name.c_str(), range.lower(), range.upper());
    if (reached != nullptr) {
        std::printf("  reached [%.7g, %.7g], %.1f %% wider", reached->lower(), reached->upper(),
                    100 * (width(range) / width(*reached) - 1));
    }
    std::printf("\n");
}

void judge(char const* what, sivid::identification_problem const& problem,
           sivid::identify_options const& options, std::size_t halvings) {
    for (bool const hulls : {true, false}) {
        auto how = options;
        how.only_hulls = hulls;
        double const begin = processor_seconds();
        auto const found = sivid::identify(problem, how);
        std::printf("%s, %s: %s in %.2f s (processor %.2f s), %s; inner %.3g, outer %.3g; "
                    "%zu integrations\n",
                    what, hulls ? "hulls" : "paving", std::string{to_string(found.verdict)}.c_str(),
                    found.seconds, processor_seconds() - begin,
                    std::string{to_string(found.reason)}.c_str(),
                    found.paving.inner_volume().lower(), found.paving.outer_volume().upper(),
                    found.integrations);
        if (found.verdict == sivid::verdict::inconsistent) continue;
        auto const* const products = found.products ? &*found.products : nullptr;
        auto const left = products ? products->paving.outer_hull() : found.hull;
        std::optional<box> reached;
        if (halvings > 0 && hulls) {
            auto const& posed = products ? products->map.problem() : problem;
            auto const first = sivid::approximate_fitter(posed)();
            if (first.inflation <= 1) reached = reached_hull(posed, first, left, halvings);
        }
        auto const names = products ? products->map.side_names() : problem.choice.unknown;
        for (std::size_t k = 0; k < names.size(); ++k) {
            print_side(names[k], left[k], reached ? &(*reached)[k] : nullptr);
        }
    }
}

sivid::identification_problem report_scenarios(sivid::identification_problem problem) {
    std::erase_if(problem.experiments, [](sivid::experiment const& e) {
        return e.name != "S1" && e.name != "S2" && e.name != "S3";
    });
    return problem;
}

/// Every start of u, v and psi within 0.01 (m/s, rad).
sivid::identification_problem uncertain_starts(sivid::identification_problem problem) {
    using traits = sivid::interval_traits<interval>;
    for (auto& e : problem.experiments) {
        for (std::size_t const i : {0u, 1u, 5u}) {
            e.initial[i] = traits::add(e.initial[i], traits::bounds(-0.01, 0.01));
        }
    }
    return problem;
}

} // namespace

int main(int count, char** arguments) {
    sivid::identify_options options;
    options.search.seconds = 5;
    options.search.accuracy = 0.003;
    std::size_t halvings = 10;
    std::string only; // a part of a campaign's name
    std::vector<std::string> folders;
    std::vector<std::string> const words(arguments + 1, arguments + count);
    try {
        for (std::size_t i = 0; i < words.size(); ++i) {
            auto const value = [&] { return std::strtod(words.at(++i).c_str(), nullptr); };
            if (words[i] == "--seconds") {
                options.search.seconds = value();
            } else if (words[i] == "--halvings") {
                halvings = static_cast<std::size_t>(value());
            } else if (words[i] == "--only") {
                only = words.at(++i);
            } else {
                folders.push_back(words[i]);
            }
        }
        if (folders.size() != 2) {
            std::fprintf(
                stderr,
                "sivid_benchmark_judged [--seconds S] [--halvings N] [--only NAME] CAMPAIGN "
                "NINE\n");
            return 2;
        }
        auto const model = sivid::record_model(hovercraft{});
        auto const read = [&](std::string const& folder) {
            return sivid::problem_from_dataset(
                sivid::read_dataset(folder, sivid::names_of(model.about)), model);
        };
        auto const three = read(folders[0]);
        auto nine = read(folders[1]);
        nine.experiments = three.experiments;
        auto const run = [&](std::string const& what, auto const& problem, std::size_t halve) {
            if (what.find(only) == what.npos) return;
            judge(what.c_str(), problem, options, halve);
        };
        run("three scenarios of the report", report_scenarios(three), halvings);
        run("all scenarios", three, halvings);
        run("all scenarios, nine parameters", nine, halvings);
        run("three scenarios, uncertain starts", uncertain_starts(report_scenarios(three)),
            halvings);
        run("all scenarios, uncertain starts", uncertain_starts(three), halvings);
        run("all scenarios, nine parameters, uncertain starts", uncertain_starts(nine), halvings);
    } catch (std::exception const& fault) {
        std::fprintf(stderr, "%s\n", fault.what());
        return 1;
    }
    return 0;
}
