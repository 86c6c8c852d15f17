// SPDX-License-Identifier: MIT
// Time to an uncertain area, against the figures of Ibex (one thread): the least of several runs.
#include "problems.hpp"

#include <sivid/paving/static_inversion.hpp>

#include <algorithm>
#include <cstdio>
#include <vector>

namespace {

using namespace paving_benchmark;

struct target {
    char const* name;
    sivid::static_problem problem;
    double area; ///< uncertain, that Ibex reached
    double milliseconds;
};

void measure(target const& t) {
    double const whole = 100; // the prior's area
    sivid::static_inversion_options options;
    options.accuracy = 0;
    options.uncertain = t.area / whole;
    double best = 1e9;
    double uncertain = 0, inner = 0;
    std::size_t tested = 0;
    for (int k = 0; k < 15; ++k) {
        auto const found = sivid::invert_static(t.problem, options);
        best = std::min(best, 1e3 * found.seconds);
        uncertain = whole * found.uncertain_volume().upper();
        inner = whole * found.inner_volume().lower();
        tested = found.tested;
    }
    std::printf("%-26s %9.2e %9.5f %9zu %8.2f ms %8.1f ms %6.1f x %6.1f ns/box\n", t.name,
                uncertain, inner, tested, best, t.milliseconds, t.milliseconds / best,
                1e6 * best / static_cast<double>(tested));
}

} // namespace

int main() {
    std::printf("%-26s %9s %9s %9s %11s %11s\n", "", "uncertain", "inner", "tested", "sivid",
                "Ibex");
    for (auto const& t :
         std::vector<target>{{"ring, bisection", ring_problem(), 1.18e-2, 16.7},
                             {"ring, separators", ring_problem(), 3.8e-3, 78},
                             {"decay, bisection", decay_problem(false), 2.2e-5, 13.8},
                             {"decay, separators", decay_problem(false), 3.0e-6, 156},
                             {"two outliers, bisection", decay_problem(true), 2.2e-5, 16},
                             {"two outliers, separators", decay_problem(true), 3.3e-6, 163}})
        measure(t);
}
