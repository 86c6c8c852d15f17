// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_PROBLEM_HPP
#define SIVID_MODEL_PROBLEM_HPP

#include <sivid/measurement/record.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/number/text/needed_given.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid {

/// Samples of an input that are missing, and across which goes what holds between the others: an
/// assumption, since nobody knows what the input did there.
struct bridged_input {
    std::string input;
    std::size_t samples = 0;     ///< that are missing
    double longest = 0;          ///< the longest time from a sample to the next one
    bool held = false;           ///< the sample before stands there; otherwise a straight line does
    std::string time_unit = "s"; ///< of `longest`: the model's
};

/// One experiment: what was put in, where it may have started, what was measured.
struct experiment {
    std::string name;
    std::vector<signal> inputs; ///< one per input of the model
    double begin = 0;           ///< time of the initial state, in the model's unit of time
    box initial;                ///< the states at `begin`; every start in the box is possible
    record measurements;
    std::size_t outliers = 0; ///< at most so many of the measurements may violate their bounds
    /// The bounds are no data but a condition that parameters meet (`changed_problem`): none of
    /// them is ever dropped, grown or counted.
    bool constraint = false;
    std::vector<bridged_input> bridged{}; ///< inputs of which samples are missing

    /// Time of the last measurement; `begin` where there is none.
    [[nodiscard]] double end() const {
        double last = begin;
        for (auto const& m : measurements) last = std::max(last, m.time);
        return last;
    }
};

/// What stands where samples of inputs are missing: "; input torque: straight lines over 43 missing
/// samples, longest gap 0.12 s", for each such input of the experiments. Nothing where none is.
[[nodiscard]] inline std::string bridging_words(std::vector<experiment> const& experiments) {
    std::vector<bridged_input> all;
    for (auto const& e : experiments) {
        for (auto const& b : e.bridged) {
            auto const known = std::find_if(all.begin(), all.end(), [&](auto const& other) {
                return other.input == b.input && other.held == b.held;
            });
            if (known == all.end()) {
                all.push_back(b);
                continue;
            }
            known->samples += b.samples;
            known->longest = std::max(known->longest, b.longest);
        }
    }
    std::string text;
    for (auto const& b : all)
        text += "; input " + b.input + ": " + (b.held ? "held" : "straight lines") + " over " +
                std::to_string(b.samples) + " missing sample" + (b.samples == 1 ? "" : "s") +
                ", longest gap " + nearest_text(b.longest, 3) + " " + b.time_unit;
    return text;
}

/// What proofs take for granted of the inputs: that they are the recorded ones, or that they stay
/// within stated errors of them; and what stands where samples of them are missing.
[[nodiscard]] inline std::string input_assumption(std::vector<experiment> const& experiments) {
    bool some = false, all = true;
    for (auto const& e : experiments) {
        for (auto const& u : e.inputs) {
            some = some || is_uncertain(u);
            all = all && is_uncertain(u);
        }
    }
    std::string const words = !some ? "inputs exact"
                              : all
                                  ? "inputs within their stated errors"
                                  : "inputs within their stated errors, exact where none is stated";
    return words + bridging_words(experiments);
}

namespace model_detail {

/// What a choice of unknowns and their prior have to be, with states or without.
/// @param fail  (text), throws
template <class Fail>
void require_prior(parameter_choice const& choice, box const& prior, Fail const& fail) {
    if (choice.unknown.empty()) fail("no unknown parameter");
    if (choice.unknown.size() != prior.size())
        fail("the prior needs one side per parameter" +
             needed_given(choice.unknown.size(), prior.size()));
    for (auto const& name : choice.unknown)
        if (choice.fixed.count(name) != 0)
            fail("'" + name + "' is unknown and has a fixed value; leave one of them out");
    if (is_empty(prior)) fail("the prior is empty");
    for (std::size_t j = 0; j < prior.size(); ++j)
        if (!std::isfinite(mag(prior[j])) || !std::isfinite(width(prior[j])))
            fail("the prior of '" + choice.unknown[j] + "' must be bounded");
}
/// The same of a measurement.
template <class Fail>
void require_reading(measurement const& m, recorded_model const& model, Fail const& fail) {
    if (m.channel >= model.about.channels.size())
        fail("unknown channel: number " + std::to_string(m.channel) + " of " +
             std::to_string(model.about.channels.size()) + ", counted from 0");
    if (!std::isfinite(m.time)) fail("a measurement at no finite time");
    if (is_empty(m.bound) || !std::isfinite(mig(m.bound))) // beyond all doubles
        fail("an empty measurement");
}

} // namespace model_detail

/// Which parameters in `prior` can explain all experiments?
///   p is feasible when for every experiment there are an initial state in its box and inputs
///   within their error bounds for which at most `outliers` of its measurements are violated.
struct identification_problem {
    recorded_model model;
    parameter_choice choice; ///< `choice.unknown` names the sides of `prior`
    box prior;
    std::vector<experiment> experiments;

    /// For what drops, grows, counts or weighs measurements: not for `identify`.
    /// @throws std::invalid_argument as `require_valid`, and where an experiment is a constraint
    void require_data() const {
        require_valid();
        for (auto const& e : experiments)
            if (e.constraint)
                throw std::invalid_argument("identification problem: experiment '" + e.name +
                                            "' is a condition and no data; ask this of the problem "
                                            "without it (of the original one, before a change of "
                                            "variables)");
    }
    /// For what knows experiments and equations by their names: a diagnosis, windows of equations.
    /// @throws std::invalid_argument  as `require_data`, and where two have one name
    void require_valid_campaign() const {
        require_data();
        auto const whose = std::string("identification problem");
        model_detail::require_own_names(whose, "experiments", experiments,
                                        [](auto const& e) { return e.name; });
        model_detail::require_own_names(whose, "equations", model.about.states,
                                        [](auto const& s) { return s.equation_name(); });
    }
    /// @throws std::invalid_argument  where an experiment has not one signal for each input and one
    ///         initial range for each state
    void require_all_inputs_and_states() const {
        for (auto const& e : experiments) {
            auto const fail = [&e](std::string const& what) {
                throw std::invalid_argument("identification problem: experiment '" + e.name +
                                            "': " + what);
            };
            auto const wanted = model.about.inputs.size(), given = e.inputs.size();
            if (given != wanted)
                fail("the model '" + model.about.name + "' has " + std::to_string(wanted) +
                     " inputs, but " + std::to_string(given) + " signals were given");
            if (e.initial.size() != model.about.states.size())
                fail("the initial box needs one side per state" +
                     needed_given(model.about.states.size(), e.initial.size()));
        }
    }
    /// @throws std::invalid_argument that names what does not fit
    void require_valid() const {
        auto const fail = [](std::string const& what) {
            throw std::invalid_argument("identification problem: " + what);
        };
        model_detail::require_prior(choice, prior, fail);
        require_own_memory(model, choice);
        if (experiments.empty()) fail("no experiment");
        require_all_inputs_and_states();
        for (auto const& s : experiments) {
            auto const where = "experiment '" + s.name + "': ";
            if (is_empty(s.initial)) fail(where + "the initial box is empty");
            for (std::size_t i = 0; i < s.initial.size(); ++i)
                if (!std::isfinite(mag(s.initial[i])))
                    fail(where + "the initial box must be bounded, in '" +
                         model.about.states[i].name + "', too");
            if (!std::isfinite(s.begin)) fail(where + "it begins at no finite time");
            if (s.measurements.empty()) fail(where + "no measurement");
            if (s.outliers > s.measurements.size()) {
                fail(where + "more outliers allowed than there are measurements: " +
                     std::to_string(s.outliers) + " of " + std::to_string(s.measurements.size()));
            }
            if (s.constraint && s.outliers > 0) fail(where + "a condition allows no outliers");
            for (auto const& m : s.measurements) {
                model_detail::require_reading(m, model,
                                              [&](std::string const& what) { fail(where + what); });
                if (!(m.time >= s.begin))
                    fail(where + "a measurement before the begin: at " + nearest_text(m.time) +
                         ", it begins at " + nearest_text(s.begin));
            }
        }
    }
};

/// How many measurements all experiments have together.
[[nodiscard]] inline std::size_t measurement_count(identification_problem const& problem) {
    std::size_t count = 0;
    for (auto const& e : problem.experiments) count += e.measurements.size();
    return count;
}

} // namespace sivid

#endif
