// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_ROBOT_HPP
#define SIVID_APP_ROBOT_HPP

#include <sivid/diagnosis/diagnosis_run.hpp>
#include <sivid/diagnosis/manoeuvre.hpp>
#include <sivid/io/allowed_disturbances.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/model.hpp>
#include <sivid/report/identification_report.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid::app {

/// A choice between ways to write the model: an option of every command.
struct model_variant {
    std::string option; ///< "friction" for --friction
    std::string about;
    std::vector<std::string> choices; ///< the first one unless told
};

/// A scenario that is part of the program (text: sivid-scenario-1).
struct built_in_scenario {
    std::string name, text;
    bool usual = true; ///< one of those that `--scenario all` stands for
};

/// A constant that is to be identified, with its prior.
struct unknown_parameter {
    std::string name;
    exact_decimal lower, upper;
};

/// A command that only this robot has; it reads its own command line, its name included.
struct own_command {
    std::string name, about;
    std::function<int(int, char**)> run;
};

/// Efforts of a diagnosis for a machine of which nothing is known: whatever is still open may use
/// most of the time, since on an unknown model nobody can say after how many boxes it pays. Each
/// step ends after so many boxes of parameters, or this share of the time, whichever is less.
[[nodiscard]] inline diagnosis_options thorough_diagnosis() {
    diagnosis_options options;
    options.gap.bound = {300, 0.12};
    options.gap.further_boxes = 900;
    options.answer = {60, 0.05};
    options.hulls = {20000, 1};
    options.exclusion = {60, 0.04};
    options.exclusions = {600, 0.37};
    options.part = {20, 0.02};
    options.screening.most_effects = 3;
    return options;
}

/// What a program knows of its robot: all of it values, made at run time by whatever means, by
/// `record_model` from a functor or by a reader of files. Name, title and model are needed.
struct robot {
    std::string name;  ///< of the program
    std::string title; ///< what the program does, for --help
    recorded_model model;
    std::vector<effect> effects; ///< that may be missing in the model
    std::string file{};          ///< of the model, where it stands behind each command

    std::vector<model_variant> variants{};
    /// The model for a choice of each variant, in their order; empty where there are none.
    std::function<recorded_model(std::vector<std::string> const&)> variant{};
    std::vector<built_in_scenario> scenarios{};
    /// What `generate` and `rank` take for unknown unless told. Of other constants it is 10 % about
    /// the nominal value.
    std::vector<unknown_parameter> prior{};
    /// Error bounds of the channels, in their units, for `rank --scenario`; empty: told by
    /// --measure.
    std::vector<double> errors{};
    /// What answers allow for unless told otherwise: unknown functions of time.
    allowed_disturbances disturbances{};
    std::map<std::string, std::string> meanings{};   ///< of constants, for reports
    std::optional<report::plane_channels> plane{};   ///< a position, for pictures from above
    std::vector<manoeuvre> manoeuvres{};             ///< that a diagnosis may propose
    diagnosis_options effort = thorough_diagnosis(); ///< of `diagnose`; time and threads are told
    double diagnosis_share = 0.65; ///< of a budget; what is left proves ranges of the parameters
    std::vector<own_command> commands{};
};

/// @param model  a functor with names, rate and observe
template <class Model>
[[nodiscard]] robot robot_of(std::string name, std::string title, Model const& model,
                             std::vector<effect> effects) {
    return {std::move(name), std::move(title), record_model(model), std::move(effects)};
}

} // namespace sivid::app

#endif
