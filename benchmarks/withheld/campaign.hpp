// SPDX-License-Identifier: MIT
// One campaign: everything that is drawn, the truth and the data.
#ifndef WITHHELD_CAMPAIGN_HPP
#define WITHHELD_CAMPAIGN_HPP

#include "craft.hpp"
#include "manoeuvres.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace withheld {

enum class family {
    single,
    weak,
    wide,
    pose,
    pair,
    outliers,
    outside,
    none,
    alias,
    askew,
    instrument,
    experiments,
    bounds,
    strong,
    onset,
    three,
    backlash,
    friction,
    episode,
    noise,
    slow,
    memory,
    rate,
    state,
    reading
};
inline constexpr std::array<std::string_view, 25> family_names{
    "single", "weak",  "wide",     "pose",       "pair",        "outliers", "outside",
    "none",   "alias", "askew",    "instrument", "experiments", "bounds",   "strong",
    "onset",  "three", "backlash", "friction",   "episode",     "noise",    "slow",
    "memory", "rate",  "state",    "reading"};

/// The first of them are drawn in every round, the others where they are asked for.
inline constexpr std::size_t usual_families = 16;

std::optional<family> family_named(std::string_view name);
/// Names between commas.
/// @throws std::invalid_argument for an unknown one
std::vector<family> families_named(std::string_view list);

/// The family of campaign `index`. Every run of 22 campaigns holds each usual family at least once,
/// in an order that the seed decides; of those in `only`, every run holds each once.
family family_of(std::uint64_t seed, std::size_t index, std::vector<family> const& only = {});

struct unknown_constant {
    std::string name, unit;
    range prior;
};

struct measured_scenario {
    scenario plan;
    channels initial{};            // the true start, within plan.initial
    std::vector<gust_pulse> gusts; // in truth only
    episode acting;                // of the catalogue's effects
    std::vector<channels> truth;   // at plan.sample_times
    std::vector<channels> value;   // what is written
    std::size_t outliers = 0;      // how many values break their bound
};

struct campaign {
    std::string id;
    family kind = family::none;
    std::vector<unknown_constant> unknown;
    double outlier_fraction = 0;
    std::vector<std::size_t> channels_measured;
    std::vector<measured_scenario> scenarios;

    constants true_constants;
    effect_values true_effects;
    foreign_values true_foreign;
    instrument_faults true_instruments;
    channels bound_factor{1, 1, 1, 1, 1, 1}; // noise reaches so many times the stated bound
    channels noise_of_value{};         // noise reaches so much of what is shown besides its bound
    channels jitter{};                 // time stamps are off by so many seconds, at most
    channels slow{};                   // noise goes together for so many seconds
    channels quantum{};                // readings are whole multiples of this; 0: of any size
    double lowest = 0;                 // of what is read modulo something
    std::vector<std::string> effects;  // names, empty for none
    std::string effects_text = "none"; // with parameters, as in the labels
    std::string noise;                 // the shape of the noise
};

/// What a campaign of a family leaves open, with its priors.
std::vector<unknown_constant> unknown_constants(family kind);

inline constexpr channels error_bound{0.02, 0.02, 0.05, 0.02, 0.02, 0.03};

/// floor(fraction n), exact in decimals for fractions of two digits.
std::size_t outlier_budget(double fraction, std::size_t samples);

/// The truth of one scenario, or another model of it, as a simulation.
world world_of(campaign const& c, measured_scenario const& s);
world base_world_of(campaign const& c, measured_scenario const& s);

/// `size` multiplies the effects of the catalogue: below 1 the check becomes harder.
campaign draw_campaign(std::uint64_t seed, std::size_t index, std::vector<family> const& only = {},
                       double size = 1);

} // namespace withheld

#endif
