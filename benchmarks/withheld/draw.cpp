// SPDX-License-Identifier: MIT
// What is drawn: the family, the effects with their sizes, the constants, the starts.
#include "campaign.hpp"
#include "catalogue.hpp"
#include "measure.hpp"
#include "noise.hpp"
#include "random.hpp"
#include "simulate.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace withheld {

std::optional<family> family_named(std::string_view name) {
    for (std::size_t i = 0; i < family_names.size(); ++i)
        if (family_names[i] == name) return static_cast<family>(i);
    return std::nullopt;
}

namespace {

constexpr std::uint64_t family_deck = 1, effect_deck = 1000, foreign_deck = 5000,
                        campaigns = 100000;

std::vector<family> shuffled_families(std::uint64_t seed, std::size_t round) {
    using enum family;
    std::vector<family> deck{single, single, single,   weak,    wide, pose,
                             pair,   pair,   outliers, outside, none};
    random_source random{derived_seed(derived_seed(seed, family_deck), round)};
    random.shuffle(deck);
    return deck;
}

/// The n-th of `count` things dealt from shuffled decks: all come up equally often.
std::size_t dealt(std::uint64_t seed, std::size_t n, std::size_t count) {
    std::vector<std::size_t> deck(count);
    for (std::size_t i = 0; i < count; ++i) deck[i] = i;
    random_source random{derived_seed(seed, n / count)};
    random.shuffle(deck);
    return deck[n % count];
}

/// How many campaigns of this family come before `index`.
std::size_t ordinal(std::uint64_t seed, std::size_t index, family kind, bool only) {
    if (only) return index;
    std::size_t n = 0;
    for (std::size_t i = 0; i < index; ++i) n += family_of(seed, i) == kind ? 1U : 0U;
    return n;
}

std::vector<unknown_constant> unknown_constants(family kind) {
    std::vector<unknown_constant> all{{"Sv", "m^2", {0.2, 0.25}}, {"Sg", "m^2", {0.0042, 0.0754}}};
    if (kind == family::wide)
        all.insert(all.end(), {{"m", "kg", {1.2, 1.4}},
                               {"Iz", "kg m^2", {0.052, 0.064}},
                               {"D22", "kg/s", {0.15, 0.25}},
                               {"D33", "kg m^2/s", {0.08, 0.12}},
                               {"Ff", "N", {0.4, 0.6}},
                               {"Su", "m^2", {0.11, 0.15}}});
    all.push_back({"L", "m", {0.25, 0.35}});
    return all;
}

/// Truth lies inside its prior, and the rudder is neither useless nor wild.
double drawn_constant(unknown_constant const& u, random_source& random) {
    if (u.name == "Sg") return rounded(random.uniform(0.035, 0.06));
    double const margin = 0.1 * (u.prior.hi - u.prior.lo);
    return rounded(random.uniform(u.prior.lo + margin, u.prior.hi - margin));
}

std::string draw_foreign(std::size_t which, random_source& random, campaign& c) {
    auto& f = c.true_foreign;
    auto const text = [](std::string const& name, double a, double b) {
        return name + '(' + six_digits(a) + ',' + six_digits(b) + ')';
    };
    switch (which) {
    case 0: {
        double const force = rounded(random.sign() * random.uniform(0.5, 1.5));
        for (auto& s : c.scenarios) {
            double const length = rounded(random.uniform(0.5, 1.2));
            double const latest = std::max(0.15, std::min(s.plan.duration, 6.0) - length);
            s.gusts.push_back({rounded(random.uniform(0.1, latest)), length, force});
        }
        c.effects = {"gust"};
        return "gust(lateral)";
    }
    case 1:
        f.tether_stiffness = rounded(random.uniform(0.15, 0.5));
        f.tether_slack = rounded(random.uniform(0, 1));
        c.effects = {"tether"};
        return text("tether", f.tether_stiffness, f.tether_slack);
    case 2:
        f.servo_frequency = rounded(random.uniform(3, 8));
        f.servo_damping = rounded(random.uniform(0.15, 0.45));
        c.effects = {"servo"};
        return text("servo", f.servo_frequency, f.servo_damping);
    default:
        f.stribeck_rise = rounded(random.uniform(0.6, 1.5));
        f.stribeck_speed = rounded(random.uniform(0.3, 0.8));
        c.effects = {"stribeck"};
        return text("stribeck", f.stribeck_rise, f.stribeck_speed);
    }
}

/// With poses only, a bias of the gyro leaves no trace.
bool visible(effect const& e, family kind) { return kind != family::pose || e.name != "gyro_bias"; }

void draw_effects(std::uint64_t seed, std::size_t n, double size, random_source& random,
                  campaign& c) {
    auto const& all = catalogue();
    std::uint64_t const deck = derived_seed(seed, effect_deck + static_cast<std::uint64_t>(c.kind));
    c.true_effects = {};
    c.true_foreign = {};
    c.effects.clear();
    for (auto& s : c.scenarios) s.gusts.clear();
    if (c.kind == family::none) return;
    if (c.kind == family::outside) {
        c.effects_text = draw_foreign(dealt(derived_seed(seed, foreign_deck), n, 4), random, c);
        return;
    }
    double largest = 0;
    for (auto const& s : c.scenarios)
        if (!s.plan.holdout) largest = std::max(largest, s.plan.rudder.largest_magnitude());
    std::size_t const count = c.kind == family::pair ? 2 : 1;
    double const scale = size * (c.kind == family::weak   ? 1.0 / 3
                                 : c.kind == family::pair ? random.uniform(0.6, 1)
                                                          : 1.0);
    c.effects_text.clear();
    std::size_t which = dealt(deck, n, all.size());
    while (c.effects.size() < count) {
        while (!visible(all[which], c.kind) ||
               std::find(c.effects.begin(), c.effects.end(), all[which].name) != c.effects.end())
            which = random.below(all.size());
        draw_size(all[which], random, scale, largest, c.true_effects);
        c.effects.emplace_back(all[which].name);
        c.effects_text += c.effects_text.empty() ? "" : " + ";
        c.effects_text += described(all[which], c.true_effects);
    }
}

/// Each effect must matter: at the true constants the data leave the model without it by some
/// bounds. A constant offset of a sensor shows in hundreds of samples and may be smaller.
bool matters(campaign const& c, double size) {
    auto const needed = [&](std::string const& name) {
        bool const offset = name == "gyro_bias" || name == "heading_bias";
        return std::min(size, 1.0) * (offset ? 1.8 : 3.0) / (c.kind == family::weak ? 3 : 1);
    };
    if (c.kind == family::none) return true;
    if (c.kind == family::outside) return largest_deviation(c, {}, {}) >= 3;
    for (auto const& name : c.effects) {
        effect_values without = c.true_effects;
        for (auto const& p : effect_named(name)->parameters)
            without.*p.member = effect_values{}.*p.member;
        if (largest_deviation(c, without, c.true_foreign) < needed(name)) return false;
    }
    return true;
}

} // namespace

family family_of(std::uint64_t seed, std::size_t index) {
    return shuffled_families(seed, index / 11)[index % 11];
}

campaign draw_campaign(std::uint64_t seed, std::size_t index, std::optional<family> only,
                       double size) {
    campaign c;
    c.kind = only ? *only : family_of(seed, index);
    random_source random{derived_seed(derived_seed(seed, campaigns), index)};
    c.unknown = unknown_constants(c.kind);
    c.channels_measured = {0, 1, 2, 3, 4, 5};
    if (c.kind == family::pose) c.channels_measured = {3, 4, 5};
    if (c.kind == family::outliers) c.outlier_fraction = 0.07;
    for (auto const& u : c.unknown)
        c.true_constants.*constant_named(u.name) = drawn_constant(u, random);

    // Half of the campaigns fly the standard manoeuvres, half a variation of them.
    for (auto& plan : draw_manoeuvres(random, random.coin() ? 0.1 : 0.0)) {
        measured_scenario s;
        s.plan = std::move(plan);
        for (std::size_t i = 0; i < 3; ++i) {
            double const half = c.kind == family::weak ? (i == 2 ? 0.03 : 0.02) : 0;
            auto& box = s.plan.initial[i];
            box = {six_decimals(box.lo - half), six_decimals(box.hi + half)};
        }
        for (std::size_t i = 0; i < channel_count; ++i) {
            auto const box = s.plan.initial[i];
            s.initial[i] = std::clamp(six_decimals(random.uniform(box.lo, box.hi)), box.lo, box.hi);
        }
        c.scenarios.push_back(std::move(s));
    }
    std::size_t const n = ordinal(seed, index, c.kind, only.has_value());
    int attempts = 0;
    do {
        if (++attempts > 200) throw std::runtime_error("no size of the effect matters");
        draw_effects(seed, n, size, random, c);
    } while (!matters(c, size));
    measure(c, random);
    return c;
}

} // namespace withheld
