// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_VALUE_HPP
#define SIVID_IO_DATASET_VALUE_HPP

#include <sivid/io/dataset/outlier_rule.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/measurement/record.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/number/interval.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// [lower, upper] as stated, and the tightest interval of doubles around it.
struct stated_range {
    exact_decimal lower, upper;
    interval enclosure;
};

/// A constant of the model that is unknown.
struct dataset_parameter {
    std::size_t constant = 0; ///< index into the model's constants
    std::string name, unit;
    stated_range prior;
};

/// A constant of the model whose value the data set overrides.
struct fixed_constant {
    std::size_t constant = 0; ///< index into the model's constants
    exact_decimal stated;
    interval value;     ///< encloses it, in the model's unit
    std::string unit{}; ///< of `stated`; empty: the model's
};

/// The state at t = 0: what the data set states, or else the model's own range.
struct initial_range {
    interval range;
    std::optional<stated_range> stated; ///< nothing: the state was left out
    std::string unit{}; ///< of what an import states; empty, and once it is read: the model's
};

/// value +/- error of one measurement as stated.
struct stated_measurement {
    exact_decimal value, error;
};

/// One input over time.
struct dataset_input {
    sampled_signal signal;     ///< the stated samples (nearest doubles) and what holds between them
    std::vector<double> error; ///< bound for each sample, rounded up; empty: the samples are exact
    std::vector<exact_decimal> stated_error; ///< as stated, same length as error
    std::size_t missing{};                   ///< samples that `bridged` goes across
    /// From a sample to the next one, where others between them are missing.
    std::vector<std::pair<double, double>> bridged{};
};

/// fit: used for identification. holdout: not used before the final figures are taken.
enum class scenario_role { fit, holdout };

/// Constants and states beyond this are refused: computing with their squares and products would
/// leave the doubles.
inline constexpr double farthest_range = 1e100;

/// One recorded manoeuvre.
struct scenario {
    std::string name;
    scenario_role role = scenario_role::fit;
    double duration = 0;               ///< in the model's unit of time
    std::vector<dataset_input> inputs; ///< one for each input of the model
    record measurements;               ///< by time, then channel; bound encloses value +/- error
    std::vector<stated_measurement> stated; ///< of the same measurements
    std::vector<initial_range> initial;     ///< one for each state of the model
};

/// What a data set says of an effect that a diagnosis may try (`chosen_effects`).
struct dataset_effect {
    struct prior {
        std::string parameter, lower, upper; ///< decimals
    };
    std::string name;
    bool off = false; ///< it is not tried
    std::vector<prior> priors;
    input_place place; ///< for messages
};

/// A campaign: what is known before, and what was recorded. A value; read_dataset makes it,
/// write_dataset stores it. Everything is in the model's units, whatever units the files are in.
struct dataset {
    std::string id, model;
    std::vector<dataset_parameter> parameters; ///< in the order of the file
    std::vector<fixed_constant> fixed;
    exact_decimal max_outlier_fraction;
    std::vector<scenario> scenarios;
    std::vector<dataset_effect> effects;  ///< those of which something is said
    std::vector<std::string> assumptions; ///< what bounds, starts and times rest on, in words

    /// \f$ q_s = \lfloor f\, n_s \rfloor \f$, exact in decimals: so many measurements of s may
    /// violate their bounds.
    [[nodiscard]] std::size_t outlier_budget(scenario const& s) const {
        return outlier_rule::share(max_outlier_fraction).of(s.measurements.size());
    }
};

} // namespace sivid

#endif // SIVID_IO_DATASET_VALUE_HPP
