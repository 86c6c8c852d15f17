// SPDX-License-Identifier: MIT
// The labels, opened after the diagnosis.
#ifndef WITHHELD_LABELS_HPP
#define WITHHELD_LABELS_HPP

#include "craft.hpp"
#include "manoeuvres.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace withheld {

struct label {
    std::string id, family, effects_text;
    std::vector<std::pair<std::string, std::vector<double>>> effects; // name and parameters
    std::map<std::string, double> constants_true;
    std::map<std::string, std::string> more; // further columns by name

    std::set<std::string> names() const;
    std::optional<double> number(std::string const& column) const; // of a further column
    /// "S1=0.9 S2=3" in a further column.
    std::map<std::string, double> values(std::string const& column) const;
    /// The candidate of the catalogue that holds the truth of the fit scenarios, from the start on:
    /// for each effect its name, or "NAME_wider" where its parameters lie beyond their priors, or
    /// "NAME@S4+S5" where it acts in these only. Nothing where none does.
    std::optional<std::vector<std::string>> held_by() const;
    /// Whether one does without wider priors, in all scenarios.
    bool attainable() const;
    /// Whether effects act in some scenarios only, or for some time only.
    bool partial() const { return !values("onsets").empty() || !values("ends").empty(); }
};

/// Any table whose columns are named and begin with case, family, effects, params.
std::vector<label> read_labels(std::filesystem::path const& path);

/// The truth that a label describes, without inputs: constants, effects, foreign effects.
world world_of(label const& l, constants const& fixed);
/// The true start of a scenario, and its gusts, where the label says so.
std::optional<channels> true_start(label const& l, std::string const& scenario);
std::vector<gust_pulse> true_gusts(label const& l, std::string const& scenario);
/// When the catalogue's effects act there: always, where the label does not say otherwise.
episode true_episode(label const& l, std::string const& scenario);
/// All of it, in a scenario with these inputs.
world true_world(label const& l, constants const& fixed, scenario const& plan);

} // namespace withheld

#endif
