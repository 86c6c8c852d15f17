// SPDX-License-Identifier: MIT
// Whole identifications, each from a cold start of `identify`, fit included:
//     sivid_benchmark_identification [--seconds S] [--boxes N] [--accuracy A] [--outliers Q]
//                                    [--threads N] [--batches N] [--report-1] FOLDER...
// For each data set of the hovercraft first the hulls alone, then the paving. With --threads each
// runs with one thread, too, and how much sooner N threads were done is printed; --batches is 4
// then unless told.
#include "model.hpp"

#include <sivid/io/dataset.hpp>
#include <sivid/io/problem_from_dataset.hpp>
#include <sivid/paving/identify.hpp>
#ifdef SIVID_HAS_TBB
#include <sivid/parallel/tbb_executor.hpp>
#endif

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

double processor_seconds() {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

void print(std::string const& name, sivid::interval const& range) {
    std::printf("    %-12s [%.7g, %.7g]  width %.4g\n", name.c_str(), range.lower(), range.upper(),
                range.upper() - range.lower());
}

/// @returns what was found, and the seconds of the processor
std::pair<sivid::identification, double> measure(sivid::identification_problem const& problem,
                                                 std::string const& what,
                                                 sivid::identify_options const& options) {
    double const begin = processor_seconds();
    auto const found = sivid::identify(problem, options);
    double const spent = processor_seconds() - begin;
    std::printf("  %s: %.3f s (processor %.3f s), %s, %s\n", what.c_str(), found.seconds, spent,
                std::string{to_string(found.verdict)}.c_str(),
                std::string{to_string(found.reason)}.c_str());
    std::printf("    %zu integrations, %zu boxes, %zu drawn; inner %.5g, outer %.5g of the prior\n",
                found.integrations, found.boxes, found.paving.boxes().size(),
                found.paving.inner_volume().lower(), found.paving.outer_volume().upper());
    for (std::size_t j = 0; j < found.hull.size(); ++j) {
        print(problem.choice.unknown[j], found.hull[j]);
    }
    for (auto const& c : found.combinations) print(c.what.formula, c.hull);
    return {found, spent};
}

/// Whether two runs say the same: threads must not matter unless time ended one of them.
bool same(sivid::identification const& a, sivid::identification const& b) {
    bool equal = a.boxes == b.boxes && a.integrations == b.integrations &&
                 a.paving.boxes().size() == b.paving.boxes().size();
    for (std::size_t k = 0; equal && k < a.paving.boxes().size(); ++k) {
        auto const &one = a.paving.boxes()[k], &other = b.paving.boxes()[k];
        equal = one.verdict == other.verdict && subset(one.set, other.set) &&
                subset(other.set, one.set);
    }
    return equal;
}

/// With one thread, and where there are more with those.
void compare(sivid::identification_problem const& problem, std::string const& what,
             sivid::identify_options options, sivid::executor const& workers) {
    auto const alone = measure(problem, what, options);
    auto const threads = workers.threads;
    if (threads < 2) return;
    options.search.workers = workers;
    auto const [found, spent] =
        measure(problem, what + ", " + std::to_string(threads) + " threads", options);
    std::printf("  %s: %zu threads were done %.2f times as soon (processor %.2f times as much); "
                "results %s\n",
                what.c_str(), threads, alone.first.seconds / found.seconds, spent / alone.second,
                same(alone.first, found) ? "equal" : "DIFFER");
}

} // namespace

int main(int count, char** arguments) {
    sivid::identify_options options;
    options.search.seconds = 5;
    options.search.accuracy = 0.003;
    std::optional<std::size_t> outliers;
    sivid::executor workers;
    bool batches = false;
    std::vector<std::string> const words(arguments + 1, arguments + count);
    auto const model = sivid::record_model(hovercraft{});
    try {
        for (std::size_t i = 0; i < words.size(); ++i) {
            auto const value = [&] { return std::strtod(words.at(++i).c_str(), nullptr); };
            if (words[i] == "--seconds") {
                options.search.seconds = value();
            } else if (words[i] == "--accuracy") {
                options.search.accuracy = value();
            } else if (words[i] == "--outliers") {
                outliers = static_cast<std::size_t>(value());
            } else if (words[i] == "--boxes") {
                options.search.boxes = static_cast<std::size_t>(value());
            } else if (words[i] == "--batches") {
                options.search.batches = static_cast<std::size_t>(value());
                batches = true;
            } else if (words[i] == "--report-1") {
                options = by_bisection(std::move(options));
                outliers = 0;
            } else if (words[i] == "--threads") {
#ifdef SIVID_HAS_TBB
                workers = sivid::tbb_executor(static_cast<std::size_t>(value()));
                if (!batches) options.search.batches = 4;
#else
                throw std::invalid_argument("--threads: built without oneTBB (libtbb-dev)");
#endif
            } else {
                auto const data = sivid::read_dataset(words[i], sivid::names_of(model.about));
                auto const problem = sivid::problem_from_dataset(data, model, outliers);
                std::printf("%s: %zu parameters, %zu experiments\n", data.id.c_str(),
                            problem.prior.size(), problem.experiments.size());
                if (options.test.contract) {
                    auto hulls = options;
                    hulls.only_hulls = true;
                    compare(problem, "hulls", hulls, workers);
                }
                compare(problem, "paving", options, workers);
            }
        }
    } catch (std::exception const& fault) {
        std::fprintf(stderr, "%s\n", fault.what());
        return 1;
    }
    return 0;
}
