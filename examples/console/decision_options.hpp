// SPDX-License-Identifier: MIT
// The command line of predict, verify, control and design.
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
        return "the gains of a control law that meet a requirement for all parameters that an "
               "identification leaves";
    case decision::design:
        break;
    }
    return "the experiment whose data narrow down a parameter most, whatever the truth among those "
           "that an identification leaves";
}

namespace detail {

/// What `predict`, `verify` and `control` are told of a control law.
inline void add_law(CLI::App& s, decision d, decision_command& c) {
    auto* const law = s.add_option("--law", c.law,
                                   "what commands inputs, such as \"W = clamp(K * (2 - u), 0, "
                                   "250)\"; separate several inputs by ;");
    auto* const gain = s.add_option("--gain", c.gain, "of the law: K=3, or a range, K=0:50");
    s.add_option("--sensor", c.sensor, "error bounds of measured(...) in the law, such as u=0.02");
    s.add_option("--sampled", c.sampled,
                 "longest time between samples of the law, which holds its value between them, in "
                 "the model's "
                 "unit of time; "
                 "not given: it acts at every instant")
        ->check(number_between(0.0, 1e9));
    s.add_option("--delay", c.delay,
                 "longest time from a sample to its effect on the input, in that unit")
        ->check(number_between(0.0, 1e9));
    s.add_option("--slew", c.slew,
                 "how fast a sampled law may change an input, such as delta=2, in its unit per "
                 "unit of time; proved with "
                 "the rest");
    if (d != decision::control) return;
    law->required();
    gain->required();
    s.add_option("--boxes", c.boxes, "boxes of gains that are tested, at most")
        ->check(number_between(1.0, 1e15))
        ->capture_default_str();
}

/// What `design` is told.
inline void add_design(CLI::App& s, decision_command& c) {
    auto* const halve = s.add_option(
        "--halve", c.goal,
        "what is to become known better: a parameter, or an expression of parameters such "
        "as \"L * Sg\"; several: each of them; volume: all of them together");
    auto* const against =
        s.add_option("--against", c.against,
                     "another result for the same data, with other effects: the experiment is to "
                     "refute one of the two models, whichever it is");
    halve->excludes(against);
    s.add_option("--share", c.target, "the share of its width, or of the volume, that may be left")
        ->check(number_between(0.0, 1.0))
        ->capture_default_str();
    s.add_option("--vary", c.vary, "inputs that may be chosen, and their limits, such as W=0:100")
        ->required();
    s.add_option("--within", c.requirement,
                 "what has to hold of the motion for all parameters, such as \"always(abs(psi) < "
                 "1)\"");
    s.add_option("--name", c.name,
                 "of the experiment, in scenario.json; not given: that of the scenario and "
                 "\"-design\"");
    s.add_option("--measure", c.measure,
                 "what is measured and with which error at most, such as psi=0.01; not given: the "
                 "channels of the data, with their largest error");
    s.add_option("--duration", c.duration,
                 "of the experiment, in the model's unit of time; not given: the scenario's, which "
                 "also gives the start and "
                 "the inputs that are not varied")
        ->check(number_between(0.0, 1e9));
    s.add_option("--period", c.period,
                 "of the measurements, in the model's unit of time; not given: as in the data")
        ->check(number_between(0.0, 1e9));
    s.footer(
        "Exit codes: 0 an experiment with that promise is found, 2 bad input, 3 none is found, "
        "or one that promises less, 5 no experiment can, as the equations hide the goal and the "
        "prior does not help (proved).");
}

} // namespace detail

/// @param scenarios  what may be given for one
inline void add_options(CLI::App& s, decision d, decision_command& c,
                        std::string const& scenarios) {
    s.add_option("result", c.result, "folder with result.json and boxes.csv, of an identification")
        ->required();
    s.add_option("--dataset", c.dataset, "its data set, if it is not where the result says");
    s.add_option("--scenario", c.scenario, scenarios)->required();
    s.add_option("--set", c.set,
                 "constants of the scenario, such as Ff=0.5, or ranges, such as Ff=0.3:0.7");
    s.add_option("--budget", c.budget, "seconds")
        ->check(number_between(0.0, 1e9))
        ->capture_default_str();
    auto* const out = s.add_option("--out", c.out, "folder for the report and the JSON file")
                          ->check(folder_name());
    s.add_flag("--quiet", c.quiet, "no progress");
    if (d == decision::design) {
        detail::add_design(s, c);
        return;
    }
    detail::add_law(s, d, c);
    if (d == decision::predict) {
        out->required();
        return;
    }
    s.add_option("--require", c.requirement,
                 "such as \"eventually(abs(u) < 0.01) and x at end in [3, 7]\"")
        ->required();
    if (d == decision::control) {
        s.footer("Exit codes: 0 some gains are proved, 2 bad input, 3 none is known, 5 none exist "
                 "in the ranges that were given (proved).");
    } else {
        s.footer("Exit codes: 0 proved for all parameters, 2 bad input, 3 open, 5 refuted by a "
                 "parameter that is proved to explain the data.");
    }
}

} // namespace console

#endif
