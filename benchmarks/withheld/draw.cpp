// SPDX-License-Identifier: MIT
// What is drawn: the family, the effects with their sizes, the constants, the starts.
#include "campaign.hpp"
#include "catalogue.hpp"
#include "instruments.hpp"
#include "measure.hpp"
#include "noise.hpp"
#include "random.hpp"
#include "simulate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace withheld {

std::optional<family> family_named(std::string_view name) {
    for (std::size_t i = 0; i < family_names.size(); ++i)
        if (family_names[i] == name) return static_cast<family>(i);
    return std::nullopt;
}

std::vector<family> families_named(std::string_view list) {
    std::vector<family> all;
    std::istringstream in{std::string{list}};
    for (std::string name; std::getline(in, name, ',');) {
        auto const kind = family_named(name);
        if (!kind) throw std::invalid_argument("unknown family " + name);
        if (std::find(all.begin(), all.end(), *kind) == all.end()) all.push_back(*kind);
    }
    return all;
}

namespace {

constexpr std::uint64_t family_deck = 1, effect_deck = 1000, foreign_deck = 5000,
                        campaigns = 100000;

std::vector<family> const& usual_round() {
    using enum family;
    static std::vector<family> const all{
        single,     single,      weak,   wide,   pose,  pair,  pair,  outliers,
        outside,    none,        alias,  alias,  alias, askew, askew, instrument,
        instrument, experiments, bounds, strong, onset, three};
    return all;
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
std::size_t ordinal(std::uint64_t seed, std::size_t index, family kind,
                    std::vector<family> const& only) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < index; ++i) n += family_of(seed, i, only) == kind ? 1U : 0U;
    return n;
}

} // namespace

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

namespace {

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
        f.swell_force = rounded(random.uniform(0.3, 0.9));
        f.swell_frequency = rounded(random.uniform(1.5, 4));
        c.effects = {"swell"};
        return text("swell", f.swell_force, f.swell_frequency);
    }
}

/// A law of the state that no catalogue has.
void draw_law(std::size_t which, random_source& random, campaign& c) {
    struct law {
        std::string_view name;
        double foreign_values::*member;
        double small, large;
    };
    static std::array<law, 3> const laws{
        {{"cubic_drag", &foreign_values::cubic_drag, 0.02, 0.06},
         {"weathervane", &foreign_values::weathervane, 0.02, 0.08},
         {"cross_coupling", &foreign_values::cross_coupling, 0.05, 0.2}}};
    auto const& one = laws[which];
    c.true_foreign.*one.member = rounded(random.uniform(one.small, one.large));
    c.effects = {std::string{one.name}};
    c.effects_text = c.effects.front() + '(' + six_digits(c.true_foreign.*one.member) + ')';
}

void name_instrument(std::string_view kind, random_source& random, campaign& c) {
    auto const values = draw_instrument(kind, random);
    set_instrument(c.true_instruments, std::string{kind}, values);
    c.effects = {std::string{kind}};
    c.effects_text = kind;
    char separator = '(';
    for (double const x : values) {
        c.effects_text += separator + six_digits(x);
        separator = ',';
    }
    c.effects_text += ')';
}

/// A bound that is stated too small: the noise of a channel reaches farther.
void widen_noise(std::size_t channel, double factor, campaign& c) {
    c.bound_factor[channel] = rounded(factor);
    auto const name = "bounds_" + std::string{channel_names[channel]};
    c.effects = {name};
    c.effects_text = name + '(' + six_digits(c.bound_factor[channel]) + ')';
}

/// The same of noise that goes together for a while: a slow disturbance of the instrument.
void slow_noise(std::size_t channel, random_source& random, campaign& c) {
    widen_noise(channel, random.uniform(1.3, 2), c);
    c.slow[channel] = rounded(random.uniform(0.2, 1));
    auto const name = "slow_" + std::string{channel_names[channel]};
    c.effects = {name};
    c.effects_text =
        name + '(' + six_digits(c.bound_factor[channel]) + ',' + six_digits(c.slow[channel]) + ')';
}

/// Noise that grows with what a channel shows, or with how fast that changes: the time stamps of
/// one instrument are off.
void grow_noise(std::size_t channel, bool jitters, random_source& random, campaign& c) {
    auto& size = (jitters ? c.jitter : c.noise_of_value)[channel];
    size = rounded(random.uniform(0.02, 0.1));
    auto const name = (jitters ? "jitter_" : "growing_") + std::string{channel_names[channel]};
    c.effects = {name};
    c.effects_text = name + '(' + six_digits(size) + ')';
}

/// Readings that are too coarse for their bound.
void coarsen(std::size_t channel, random_source& random, campaign& c) {
    c.quantum[channel] = rounded(error_bound[channel] * random.uniform(1.2, 4));
    auto const name = "steps_" + std::string{channel_names[channel]};
    c.effects = {name};
    c.effects_text = name + '(' + six_digits(c.quantum[channel]) + ')';
}

/// A heading that is read within one turn, from some angle on.
void wrap_heading(random_source& random, campaign& c) {
    c.true_instruments.modulus[5] = 2 * std::numbers::pi;
    c.lowest = rounded(random.uniform(-1.2, -0.4));
    c.effects = {"wraps_psi"};
    c.effects_text = "wraps_psi(" + six_digits(c.true_instruments.modulus[5]) + ')';
}

/// Beyond the prior that it is diagnosed over.
void draw_excess(effect const& which, random_source& random, effect_values& e) {
    bool first = true;
    for (auto const& p : which.parameters) {
        double size = 0;
        if (p.member == &effect_values::rudder_limit)
            size = p.lo * random.uniform(0.3, 0.8);
        else if (p.member == &effect_values::battery_sag)
            size = p.hi * random.uniform(1.03, 1.1); // beyond 1/6 s the motor would turn round
        else if (p.member == &effect_values::friction_anisotropy)
            size = p.hi * random.uniform(1.1, 1.6);
        else if (first)
            size = p.hi * random.uniform(1.1, 1.6) * (p.either_sign ? random.sign() : 1);
        else
            size = random.uniform(p.lo, p.hi);
        e.*p.member = rounded(size);
        first = false;
    }
}

std::size_t index_of(std::string_view name) {
    return static_cast<std::size_t>(effect_named(name) - catalogue().data());
}

/// Effects that depend on the past.
constexpr std::array<std::string_view, 6> memories{"rudder_lag",      "input_delay",
                                                   "motor_lag",       "position_latency",
                                                   "rudder_backlash", "rudder_rate_limit"};
bool has_memory(effect const& e) {
    return std::find(memories.begin(), memories.end(), e.name) != memories.end();
}

/// With poses only, a bias of the gyro leaves no trace. What has a memory and begins later has a
/// family of its own.
bool possible(effect const& e, family kind) {
    if (kind == family::pose) return e.name != "gyro_bias";
    return (kind != family::onset && kind != family::episode) || !has_memory(e);
}

/// Of the family `episode`, every other campaign has effects from the start on.
void draw_times(random_source& random, campaign& c, std::size_t n) {
    for (auto& s : c.scenarios) {
        auto const share = [&](double least, double most) {
            return six_decimals(random.uniform(least, most) * s.plan.duration);
        };
        s.acting = {};
        if (c.kind == family::onset || c.kind == family::memory) s.acting.from = share(0.15, 0.7);
        if (c.kind == family::experiments && !random.coin()) s.acting.from = for_ever;
        if (c.kind != family::episode) continue;
        bool const begins = n % 2 == 1;
        s.acting.from = begins ? share(0.1, 0.4) : 0;
        s.acting.to = begins ? s.acting.from + share(0.25, 0.45) : share(0.3, 0.75);
    }
}

/// What is wrong when no effect of the catalogue is.
bool draw_other(std::uint64_t seed, std::size_t n, random_source& random, campaign& c) {
    auto const deck = derived_seed(seed, foreign_deck + static_cast<std::uint64_t>(c.kind));
    switch (c.kind) {
    case family::none:
        return true;
    case family::outside:
        c.effects_text = draw_foreign(dealt(deck, n, 4), random, c);
        return true;
    case family::state:
        draw_law(dealt(deck, n, 3), random, c);
        return true;
    case family::askew:
        name_instrument(askew_kinds()[dealt(deck, n, askew_kinds().size())], random, c);
        return true;
    case family::instrument:
        name_instrument(instrument_kinds()[dealt(deck, n, instrument_kinds().size())], random, c);
        return true;
    case family::bounds:
        widen_noise(dealt(deck, n, channel_count), random.uniform(1.3, 2), c);
        return true;
    case family::noise:
        grow_noise(dealt(deck, n / 2, channel_count), n % 2 == 0, random, c);
        return true;
    case family::slow:
        slow_noise(dealt(deck, n, channel_count), random, c);
        return true;
    case family::reading:
        if (n % 2 == 0)
            coarsen(dealt(deck, n / 2, channel_count), random, c);
        else
            wrap_heading(random, c);
        return true;
    case family::alias: // the fourth has no effect of the catalogue
        if (n % 4 != 3) return false;
        if (n % 8 == 7) widen_noise(dealt(deck, n / 8, channel_count), random.uniform(1.3, 1.7), c);
        return true;
    default:
        return false;
    }
}

void draw_effects(std::uint64_t seed, std::size_t n, double size, random_source& random,
                  campaign& c) {
    auto const& all = catalogue();
    std::uint64_t const deck = derived_seed(seed, effect_deck + static_cast<std::uint64_t>(c.kind));
    c.true_effects = {};
    c.true_foreign = {};
    c.true_instruments = {};
    c.bound_factor.fill(1);
    c.noise_of_value.fill(0);
    c.jitter.fill(0);
    c.slow.fill(0);
    c.quantum.fill(0);
    c.effects.clear();
    c.effects_text = "none";
    for (auto& s : c.scenarios) s.gusts.clear();
    if (draw_other(seed, n, random, c)) return;
    double largest = 0;
    for (auto const& s : c.scenarios)
        if (!s.plan.holdout) largest = std::max(largest, s.plan.rudder.largest_magnitude());
    std::size_t const count = c.kind == family::three ? 3 : c.kind == family::pair ? 2 : 1;
    double const scale = size * (c.kind == family::weak ? 1.0 / 3
                                 : count > 1            ? random.uniform(0.6, 1)
                                                        : 1.0);
    c.effects_text.clear();
    std::size_t which = dealt(deck, n, first_effects);
    // Half of the campaigns with an unseen rudder leave the equations as they are.
    if (c.kind == family::alias && n % 4 != 0) {
        std::array<std::string_view, 4> const of_sensors{"position_scale", "gyro_bias",
                                                         "position_latency", "heading_bias"};
        auto const name = of_sensors[dealt(deck, n / 4 * 2 + n % 4 - 1, of_sensors.size())];
        which = index_of(name);
    } else if (c.kind == family::alias) {
        which = dealt(deck, n / 4, first_effects);
    }
    if (c.kind == family::backlash) which = index_of("rudder_backlash");
    if (c.kind == family::friction) which = index_of("stribeck");
    if (c.kind == family::rate) which = index_of("rudder_rate_limit");
    if (c.kind == family::memory) which = index_of(memories[dealt(deck, n, memories.size())]);
    while (c.effects.size() < count) {
        while (!possible(all[which], c.kind) ||
               std::find(c.effects.begin(), c.effects.end(), all[which].name) != c.effects.end())
            which = random.below(first_effects);
        if (c.kind == family::strong)
            draw_excess(all[which], random, c.true_effects);
        else
            draw_size(all[which], random, scale, largest, c.true_effects);
        c.effects.emplace_back(all[which].name);
        c.effects_text += c.effects_text.empty() ? "" : " + ";
        c.effects_text += described(all[which], c.true_effects);
    }
    draw_times(random, c, n);
}

/// Each effect must matter: at the true constants the data leave the model without it by some
/// bounds. A constant offset of a sensor shows in hundreds of samples and may be smaller.
bool matters(campaign const& c, double size) {
    auto const needed = [&](std::string const& name) {
        bool const offset = name == "gyro_bias" || name == "heading_bias";
        return std::min(size, 1.0) * (offset ? 1.8 : 3.0) / (c.kind == family::weak ? 3 : 1);
    };
    if (c.kind == family::noise) return largest_growth(c) >= 2;
    if (c.kind == family::reading) return c.quantum != channels{} || heading_passes(c, c.lowest);
    // Nothing to wait for: the model is right, and noise alone may break bounds.
    bool const right = c.effects.empty() || c.bound_factor != channels{1, 1, 1, 1, 1, 1};
    if (right) return true;
    if (effect_named(c.effects.front()) == nullptr) return largest_deviation(c, {}, {}) >= 3;
    // Nor does it matter everywhere and always.
    bool const partial = c.kind == family::onset || c.kind == family::experiments ||
                         c.kind == family::episode || c.kind == family::memory;
    if (partial && largest_deviation(c, c.true_effects, c.true_foreign) < 3) return false;
    for (auto const& name : c.effects) {
        effect_values without = c.true_effects;
        for (auto const& p : effect_named(name)->parameters)
            without.*p.member = effect_values{}.*p.member;
        if (largest_deviation(c, without, c.true_foreign) < needed(name)) return false;
    }
    return true;
}

/// Samples at 2 to 5 Hz and a rudder that moves between them; half of the time with their period.
sampling draw_sampling(random_source& random) {
    sampling how;
    std::array<double, 4> const periods{0.5, 0.4, 0.25, 0.2};
    how.period = periods[random.below(periods.size())];
    how.dither = rounded(random.uniform(0.1, 0.4));
    how.dither_period = random.coin() ? how.period : rounded(random.uniform(0.5, 0.9));
    how.phase = random.coin() ? 0 : random.uniform(0, 6);
    how.calm_start = random.coin(0.3);
    return how;
}

} // namespace

family family_of(std::uint64_t seed, std::size_t index, std::vector<family> const& only) {
    auto deck = only.empty() ? usual_round() : only;
    random_source random{derived_seed(derived_seed(seed, family_deck), index / deck.size())};
    random.shuffle(deck);
    return deck[index % deck.size()];
}

campaign draw_campaign(std::uint64_t seed, std::size_t index, std::vector<family> const& only,
                       double size) {
    campaign c;
    c.kind = family_of(seed, index, only);
    random_source random{derived_seed(derived_seed(seed, campaigns), index)};
    c.unknown = unknown_constants(c.kind);
    c.channels_measured = {0, 1, 2, 3, 4, 5};
    if (c.kind == family::pose) c.channels_measured = {3, 4, 5};
    if (c.kind == family::outliers) c.outlier_fraction = 0.07;
    for (auto const& u : c.unknown)
        c.true_constants.*constant_named(u.name) = drawn_constant(u, random);

    // Half of the campaigns fly the standard manoeuvres, half a variation of them.
    double const variation = random.coin() ? 0.1 : 0.0;
    sampling const how = c.kind == family::alias ? draw_sampling(random) : sampling{};
    for (auto& plan : draw_manoeuvres(random, variation, how)) {
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
    std::size_t const n = ordinal(seed, index, c.kind, only);
    int attempts = 0;
    do {
        if (++attempts > 200) throw std::runtime_error("no size of the effect matters");
        draw_effects(seed, n, size, random, c);
    } while (!matters(c, size));
    measure(c, random);
    return c;
}

} // namespace withheld
