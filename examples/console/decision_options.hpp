// SPDX-License-Identifier: MIT
// The command line of predict, verify and control.
#ifndef EXAMPLES_CONSOLE_DECISION_OPTIONS_HPP
#define EXAMPLES_CONSOLE_DECISION_OPTIONS_HPP

#include "console.hpp"
#include "decision_command.hpp"
#include "number_range.hpp"

#include <CLI/CLI.hpp>

#include <string>

namespace console {

[[nodiscard]] inline char const* about(decision d) {
    switch (d) {
    case decision::predict:
        return "tubes of a scenario over all parameters that an identification leaves";
    case decision::verify:
        return "does a requirement hold for all parameters that an identification leaves?";
    case decision::control:
        break;
    }
    return "the gains of a control law that meet a requirement for all parameters that an "
           "identification leaves";
}

/// @param scenarios  what may be given for one
inline void add_options(CLI::App& s, decision d, decision_command& c,
                        std::string const& scenarios) {
    s.add_option("result", c.result, "folder with result.json and boxes.csv, of an identification")
        ->required();
    s.add_option("--dataset", c.dataset, "its data set, if it is not where the result says");
    s.add_option("--scenario", c.scenario, scenarios)->required();
    s.add_option("--set", c.set,
                 "constants of the scenario, such as Ff=0.5, or ranges, such as Ff=0.3:0.7");
    auto* const law =
        s.add_option("--law", c.law,
                     "what commands inputs, such as \"W = clamp(K * (2 - u), 0, 250)\"; several "
                     "inputs are parted by ;");
    auto* const gain = s.add_option("--gain", c.gain, "of the law: K=3, or a range, K=0:50");
    s.add_option("--sensor", c.sensor, "error bounds of measured(...) in the law, such as u=0.02");
    s.add_option(
         "--sampled", c.sampled,
         "the law is computed from samples at most so far apart [s], and held; not given: it "
         "acts at every instant")
        ->check(number_between(0.0, 1e9));
    s.add_option("--delay", c.delay, "samples act at most so long after they were taken [s]")
        ->check(number_between(0.0, 1e9));
    s.add_option(
        "--slew", c.slew,
        "how fast a sampled law may change an input, such as delta=2 [unit/s]; proved with "
        "the rest");
    s.add_option("--budget", c.budget, "seconds")
        ->check(number_between(0.0, 1e9))
        ->capture_default_str();
    auto* const out = s.add_option("--out", c.out, "folder for the report and the JSON file")
                          ->check(folder_name());
    s.add_flag("--quiet", c.quiet, "no progress");
    if (d == decision::predict) {
        out->required();
        return;
    }
    s.add_option("--require", c.requirement,
                 "such as \"eventually(abs(u) < 0.01) and x at end in [3, 7]\"")
        ->required();
    if (d == decision::control) {
        law->required();
        gain->required();
        s.footer("Exit codes: 0 some gains are proved, 2 bad input, 3 none is known, 5 none exist "
                 "in the ranges that were given (proved).");
    } else {
        s.footer("Exit codes: 0 proved for all parameters, 2 bad input, 3 open, 5 refuted by a "
                 "parameter that is proved to explain the data.");
    }
}

} // namespace console

#endif
