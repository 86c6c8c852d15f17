// SPDX-License-Identifier: MIT
// Problems of the ARCH-COMP competition (category AFF/NLN, nonlinear systems, 2023 and 2025), each
// by one call with default options: `verify` where a bound is to be shown, `predict` where a width
// is scored.
//   sivid_benchmark_arch_comp [SECONDS] [NAME...]   SECONDS: limit of each call (60); NAME: part of
//   a name
// A line each: verdict, the figure that is scored, how far motions were enclosed, integrations,
// seconds. CVDP23 also stands with what a person would choose, in the same run: degree 6 and four
// boxes.
#include "../enclosure/problems.hpp"

#include <sivid/decision/prediction.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/verification.hpp>
#include <sivid/model/model.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace sivid;

prediction_problem posed(recorded_model model, box initial, double end,
                         parameter_choice choice = {}, box sides = box(0)) {
    prediction_problem p;
    p.model = std::move(model);
    p.choice = std::move(choice);
    p.sets = {std::move(sides)};
    p.initial = std::move(initial);
    p.end = end;
    return p;
}
prediction_problem oscillators() {
    auto const x = hull(1.25_dec, 1.55_dec), y = hull(2.35_dec, 2.45_dec);
    return posed(record_model<problems::coupled_oscillators>(), {x, y, x, y}, 7, {{"b"}, {}},
                 {interval(1, 3)});
}
/// @param halfwidth  of each state, in hundredths
prediction_problem enzymes_about(int halfwidth) {
    int const centres[] = {120, 105, 150, 240, 100, 10, 45};
    box starts(std::size(centres));
    for (std::size_t i = 0; i < starts.size(); ++i)
        starts[i] = interval(centres[i] - halfwidth, centres[i] + halfwidth) / interval(100);
    return posed(record_model<problems::laub_loomis>(), std::move(starts), 20);
}

void line(std::string const& name, std::string const& verdict, double scored, char const* of,
          double reached, std::size_t integrations, double seconds) {
    std::printf("%-34s %-10s %-22s %10.4g   to t = %-6.4g %6zu integrations %8.2f s\n",
                name.c_str(), verdict.c_str(), of, scored, reached, integrations, seconds);
    std::fflush(stdout);
}
void show(std::string const& name, prediction_problem p, char const* wanted,
          prediction_options const& options) {
    auto const what = parse_requirement(wanted, p.model, p.end);
    auto const found = verify(p, what, {}, options);
    line(name, std::string(to_string(found.answer)), found.found.low, "least margin", found.reached,
         found.integrations, found.seconds);
}
/// @param of  the first channel, or the sum of the states
void width_at_end(std::string const& name, prediction_problem p, char const* of,
                  prediction_options const& options, bool sum = false) {
    std::vector<node_id> further;
    if (sum) further.push_back(problems::sum_of_states(p.model));
    auto const found = predict(p, options, further);
    auto const& tube = sum ? found.further.front() : found.channels.front();
    line(name, found.complete ? "complete" : "ends early", tube.high.back() - tube.low.back(), of,
         found.reached, found.integrations, found.seconds);
}

/// Degree 6 and halves of b, each in two along x1: what a person would choose.
void oscillators_by_hand(double seconds) {
    stopwatch const clock;
    double least = 1e300, reached = 7;
    std::size_t integrations = 0;
    bool proved = true;
    for (auto const& b : {interval(1, 2), interval(2, 3)}) {
        for (auto const& x : {hull(1.25_dec, 1.4_dec), hull(1.4_dec, 1.55_dec)}) {
            auto p = oscillators();
            p.sets = {{b}};
            p.initial[0] = x;
            prediction_options options{.seconds = seconds};
            options.run.degree = 6;
            auto const what = parse_requirement("always(y1 < 2.75 and y2 < 2.75)", p.model, p.end);
            auto const found = verify(p, what, {}, options);
            least = std::min(least, found.found.low);
            reached = std::min(reached, found.reached);
            integrations += found.integrations;
            proved = proved && found.answer == requirement_answer::proved;
        }
    }
    line("CVDP23, degree 6, 4 boxes by hand", proved ? "proved" : "open", least, "least margin",
         reached, integrations, clock.spent());
}

} // namespace

int main(int argc, char** argv) {
    double const seconds = argc > 1 ? std::atof(argv[1]) : 60;
    auto const asked = [&](std::string const& name) {
        if (argc <= 2) return true;
        return std::any_of(argv + 2, argv + argc,
                           [&](char const* part) { return name.find(part) != name.npos; });
    };
    prediction_options const options{.seconds = seconds};
    if (asked("CVDP23")) {
        show("CVDP23", oscillators(), "always(y1 < 2.75 and y2 < 2.75)", options);
        oscillators_by_hand(seconds);
    }
    for (auto const& [name, halfwidth, bound] :
         {std::tuple{"LALO20, +-0.01", 1, "always(x4 < 4.5)"},
          std::tuple{"LALO20, +-0.05", 5, "always(x4 < 4.5)"},
          std::tuple{"LALO20, +-0.1", 10, "always(x4 < 5)"}}) {
        if (!asked(name)) continue;
        show(name, enzymes_about(halfwidth), bound, options);
        width_at_end(name, enzymes_about(halfwidth), "width of x4 at 20", options);
    }
    for (auto const& [name, b, g] : {std::tuple{"ROBE25, b 1e2, g 1e3", 1e2, 1e3},
                                     std::tuple{"ROBE25, b 1e3, g 1e5", 1e3, 1e5},
                                     std::tuple{"ROBE25, b 1e3, g 1e7", 1e3, 1e7}}) {
        if (!asked(name)) continue;
        auto const p =
            posed(record_model<problems::robertson>(), {interval(1), interval(0), interval(0)}, 40,
                  {{}, {{"beta", interval(b)}, {"gamma", interval(g)}}});
        width_at_end(name, p, "width of x+y+z at 40", options, true);
    }
    if (asked("LOVO25"))
        width_at_end("LOVO25, without its guard",
                     posed(record_model<problems::lotka_volterra>(),
                           {hull(1.288_dec, 1.312_dec), interval(1)}, 3.64),
                     "width of x at 3.64", options);
}
