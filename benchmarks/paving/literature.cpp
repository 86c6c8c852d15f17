// SPDX-License-Identifier: MIT
// Estimation problems of the literature, each from a cold start of `identify`, beside what was
// published of them:
//     sivid_benchmark_literature [--seconds S] [--runs N]
// Hulls stand beside how far fits with one parameter held reach, volumes beside what random points
// say; neither is proved. Seconds are of the processor, the median of the runs.
#include "classics.hpp"

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/paving/identify.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace paving_benchmark;
using sivid::box;

struct settings {
    double seconds = 10;
    std::size_t runs = 5;
};

double product_of_widths(box const& x) {
    double product = 1;
    for (auto const& side : x) product *= width(side);
    return product;
}

/// Whether some parameters with p_j = value explain the data, by fits (not proved); one descent
/// begins at the truth.
bool fits(classic const& c, std::size_t j, double value) {
    auto pinned = c.problem;
    pinned.prior[j] = sivid::interval(value);
    sivid::approximate_fitter fit(pinned);
    return fit().inflation <= 1 || fit({c.truth}).inflation <= 1;
}

/// How far the set reaches towards `end`, by fits: first some value that fits, then bisection.
double reached(classic const& c, std::size_t j, double end) {
    double const way = c.truth[j] - end;
    double none = 0, some = 1.0 / 1024; // shares of the way
    while (some < 1 && !fits(c, j, end + some * way)) {
        none = some;
        some *= 2;
    }
    for (int k = 0; k < 8; ++k) {
        double const middle = (none + some) / 2;
        (fits(c, j, end + middle * way) ? some : none) = middle;
    }
    return end + some * way;
}

/// The smallest box around parameters that explain the data, by fits.
box fitted_hull(classic const& c, box const& left) {
    auto result = left;
    for (std::size_t j = 0; j < left.size(); ++j) {
        result[j] = sivid::interval_traits<sivid::interval>::bounds(reached(c, j, left[j].lower()),
                                                                    reached(c, j, left[j].upper()));
    }
    return result;
}

/// Of the prior: the inside boxes and the share of random points of all others that explain, by
/// simulation. For known starts.
double sampled_volume(classic const& c, sivid::subpaving const& paving, std::size_t points) {
    std::vector<box const*> open;
    std::vector<double> volumes;
    for (auto const& b : paving.boxes()) {
        if (b.verdict == sivid::box_verdict::outside || b.verdict == sivid::box_verdict::inside) {
            continue;
        }
        open.push_back(&b.set);
        volumes.push_back(product_of_widths(b.set));
    }
    double const inner = paving.inner_volume().lower();
    if (open.empty()) return inner;
    sivid::approximate_fitter fit(c.problem);
    std::mt19937_64 random(1);
    std::discrete_distribution<std::size_t> which(volumes.begin(), volumes.end());
    auto const start = mid(c.problem.experiments[0].initial);
    std::size_t hits = 0;
    for (std::size_t k = 0; k < points; ++k) {
        std::vector<double> p;
        for (auto const& side : *open[which(random)]) {
            double const share = static_cast<double>(random() >> 11) * 0x1p-53;
            p.push_back(side.lower() + share * width(side));
        }
        hits += fit.at(p, {start}).inflation <= 1 ? 1 : 0;
    }
    double const share = static_cast<double>(hits) / static_cast<double>(points);
    return inner + share * (paving.outer_volume().upper() - inner);
}

double processor_seconds() {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

/// Runs `identify` several times; the seconds of the result are the median of the processor's.
sivid::identification measured(classic const& c, sivid::identify_options const& options,
                               std::size_t runs) {
    std::vector<double> seconds;
    std::optional<sivid::identification> result;
    while (seconds.size() < runs) {
        double const begin = processor_seconds();
        result = sivid::identify(c.problem, options);
        seconds.push_back(processor_seconds() - begin);
    }
    std::sort(seconds.begin(), seconds.end());
    result->seconds = seconds[seconds.size() / 2];
    return *result;
}

bool truth_is_left(classic const& c, sivid::identification const& found) {
    return contains(found.hull, c.truth) &&
           std::any_of(found.paving.boxes().begin(), found.paving.boxes().end(),
                       [&](sivid::paved_box const& b) {
                           return b.verdict != sivid::box_verdict::outside &&
                                  contains(b.set, c.truth);
                       });
}

void print_run(char const* what, classic const& c, sivid::identification const& found) {
    double const whole = product_of_widths(c.problem.prior);
    double const inner = found.paving.inner_volume().lower();
    double const outer = found.paving.outer_volume().upper();
    bool const in_time = found.reason != sivid::stop_reason::time_budget;
    std::printf(
        "  %-24s %8.4f s%s, %s: %zu boxes, %zu integrations; of the prior inner %.4g, outer "
        "%.4g (uncertain volume %.4g); truth %s\n",
        what, found.seconds, in_time ? "" : " (budget)",
        std::string{to_string(found.verdict)}.c_str(), found.boxes, found.integrations, inner,
        outer, whole * (outer - inner), truth_is_left(c, found) ? "contained" : "LOST");
}

void print_hulls(classic const& c, sivid::identification const& found, box const& fitted) {
    for (std::size_t j = 0; j < found.hull.size(); ++j) {
        auto const& side = found.hull[j];
        std::printf("    %-4s [%.6g, %.6g]  fits reach [%.6g, %.6g], %.1f %% wider\n",
                    c.problem.choice.unknown[j].c_str(), side.lower(), side.upper(),
                    fitted[j].lower(), fitted[j].upper(),
                    100 * (width(side) / width(fitted[j]) - 1));
    }
}

/// @param volume  of the uncertain boxes that was published, 0: none
void compare(char const* title, classic const& c, std::vector<char const*> const& published,
             double volume, settings const& s) {
    std::printf("%s\n", title);
    for (auto const* line : published) std::printf("  published: %s\n", line);
    sivid::identify_options options;
    options.search.seconds = s.seconds;
    options.search.accuracy = 0.01;
    auto const paved = measured(c, options, s.runs);
    auto const fitted = fitted_hull(c, paved.hull);

    auto how = options;
    how.only_hulls = true;
    auto const hulls = measured(c, how, s.runs);
    print_run("hulls", c, hulls);
    print_hulls(c, hulls, fitted);
    if (volume > 0) {
        double const share = volume / product_of_widths(c.problem.prior);
        how = options;
        how.search.progress = [&](sivid::paving_progress const& now) {
            return now.outer - now.inner > share;
        };
        print_run("to the published volume", c, measured(c, how, s.runs));
    }
    print_run("paving", c, paved);
    print_hulls(c, paved, fitted);
    auto const& start = c.problem.experiments[0].initial;
    bool const known =
        std::all_of(start.begin(), start.end(), [](auto const& x) { return width(x) == 0; });
    if (known) {
        std::printf("    volume by random points: %.4g of the prior\n",
                    sampled_volume(c, paved.paving, 10000));
    }
}

} // namespace

int main(int count, char** arguments) {
    settings s;
    std::vector<std::string> const words(arguments + 1, arguments + count);
    for (std::size_t i = 0; i < words.size(); i += 2) { // an option and its value
        bool const more = i + 1 < words.size();
        double const value = more ? std::strtod(words[i + 1].c_str(), nullptr) : 0;
        if (more && words[i] == "--seconds" && value > 0) {
            s.seconds = value;
        } else if (more && words[i] == "--runs" && value >= 1) {
            s.runs = static_cast<std::size_t>(value);
        } else {
            std::fprintf(stderr, "sivid_benchmark_literature [--seconds S] [--runs N]\n");
            return 2;
        }
    }
    compare("Two compartments (Kieffer and Walter 2011), prior [0.01, 1]^3, errors 0.005",
            two_compartments_problem(),
            {"documentation of mc::ODEGPE in MC++ (2012 to 2014; machine and options not stated):",
             "42.77 s, 848 boxes, uncertain volume 9.991e-06 in 804 boxes, nothing inside"},
            9.990558e-6, s);
    compare("The same, x2(0) in [0, 0.1] (a test of MC++, no figures published)",
            two_compartments_problem(true), {}, 0, s);
    compare("Two exponentials (Milanese and Vicino 1991), prior [2, 60] x [0, 1] x [-30, -1] x "
            "[0, 0.5], errors 0.1 + 5 %",
            two_exponentials_problem(),
            {"the smallest box, as we remember it: p1 [17.2, 26.9], p2 [0.30, 0.49], p3 [-16.1, "
             "-5.4], p4 [0.077, 0.136]"},
            0, s);
    compare("Lotka and Volterra, prior [0, 0.1]^2, errors 1", lotka_volterra_problem(), {}, 0, s);
    return 0;
}
