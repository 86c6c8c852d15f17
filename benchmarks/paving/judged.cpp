// SPDX-License-Identifier: MIT
// The campaigns by which identification is judged, each from a cold start of `identify`:
//     sivid_benchmark_judged [--seconds S] [--samples N] CAMPAIGN NINE
// CAMPAIGN: a data set with the scenarios S1, S2, S3 of the report and further ones, of three
// unknown parameters and no effect; NINE: one whose prior has nine, used with CAMPAIGN's data.
// Hulls stand beside those of points that explain the data by simulation, found by hit and run.
#include "model.hpp"

#include <sivid/io/dataset.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/paving/identify.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace {

using sivid::box;
using sivid::interval;

double processor_seconds() {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

/// The smallest box around points that explain the data by simulation (not proved): from a point of
/// the set along random lines, to points beyond half the distance where explanations end.
box sampled_hull(sivid::identification_problem const& problem, sivid::approximate_fit const& first,
                 box const& around, std::size_t steps) {
    sivid::fitter fit(problem);
    std::mt19937_64 random(1);
    auto const uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    auto const explains = [&](std::vector<double> const& p) {
        return contains(around, p) && fit.at(p, first.starts).inflation <= 1;
    };
    auto at = first.parameters;
    auto found = sivid::point_box(at);
    for (std::size_t step = 0; step < steps; ++step) {
        // Every other line runs along a side, where the extremes of boxes lie.
        std::vector<double> way(at.size(), 0.0);
        for (std::size_t j = 0; j < at.size(); ++j) {
            bool const moves = step % 2 == 0 || j == (step / 2) % at.size();
            if (moves) way[j] = (2 * uniform() - 1) * width(around[j]);
        }
        std::array<double, 2> ends{0, 0};
        for (int side = 0; side < 2; ++side) {
            double inside = 0, outside = side == 0 ? 2 : -2;
            for (int k = 0; k < 12; ++k) {
                double const middle = (inside + outside) / 2;
                auto p = at;
                for (std::size_t j = 0; j < p.size(); ++j) p[j] += middle * way[j];
                if (explains(p)) {
                    inside = middle;
                    found = hull(found, sivid::point_box(p));
                } else {
                    outside = middle;
                }
            }
            ends[static_cast<std::size_t>(side)] = inside;
        }
        double const go = ends[1] + uniform() * (ends[0] - ends[1]);
        for (std::size_t j = 0; j < at.size(); ++j) at[j] += go * way[j];
    }
    return found;
}

void print_side(std::string const& name, interval const& range, interval const* sampled) {
    std::printf("    %-12s [%.7g, %.7g]", name.c_str(), range.lower(), range.upper());
    if (sampled != nullptr) {
        std::printf("  sampled [%.7g, %.7g], %.1f %% wider", sampled->lower(), sampled->upper(),
                    100 * (width(range) / width(*sampled) - 1));
    }
    std::printf("\n");
}

void judge(char const* what, sivid::identification_problem const& problem,
           sivid::identify_options const& options, std::size_t samples) {
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
        std::optional<box> sampled;
        if (samples > 0 && hulls) {
            auto const& posed = products ? products->map.problem() : problem;
            auto const first = sivid::fitter(posed)();
            if (first.inflation <= 1) sampled = sampled_hull(posed, first, left, samples);
        }
        auto const names = products ? products->map.side_names() : problem.choice.unknown;
        for (std::size_t k = 0; k < names.size(); ++k) {
            print_side(names[k], left[k], sampled ? &(*sampled)[k] : nullptr);
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
        for (std::size_t const i : {0, 1, 5}) {
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
    std::size_t samples = 120;
    std::vector<std::string> folders;
    std::vector<std::string> const words(arguments + 1, arguments + count);
    try {
        for (std::size_t i = 0; i < words.size(); ++i) {
            auto const value = [&] { return std::strtod(words.at(++i).c_str(), nullptr); };
            if (words[i] == "--seconds") {
                options.search.seconds = value();
            } else if (words[i] == "--samples") {
                samples = static_cast<std::size_t>(value());
            } else {
                folders.push_back(words[i]);
            }
        }
        if (folders.size() != 2) {
            std::fprintf(stderr,
                         "sivid_benchmark_judged [--seconds S] [--samples N] CAMPAIGN NINE\n");
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
        judge("three scenarios of the report", report_scenarios(three), options, samples);
        judge("all scenarios", three, options, samples);
        judge("all scenarios, nine parameters", nine, options, 0);
        judge("three scenarios, uncertain starts", uncertain_starts(report_scenarios(three)),
              options, 0);
        judge("all scenarios, uncertain starts", uncertain_starts(three), options, 0);
    } catch (std::exception const& fault) {
        std::fprintf(stderr, "%s\n", fault.what());
        return 1;
    }
    return 0;
}
