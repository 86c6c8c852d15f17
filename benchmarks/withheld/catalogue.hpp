// SPDX-License-Identifier: MIT
// The catalogue's effects by name: their parameters, the prior each is diagnosed over, and the size
// that counts as normal here.
#ifndef WITHHELD_CATALOGUE_HPP
#define WITHHELD_CATALOGUE_HPP

#include "craft.hpp"
#include "random.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace withheld {

struct effect_parameter {
    std::string_view name;
    double effect_values::*member;
    double lo, hi;       // the catalogue's prior
    double small, large; // a normal size, as a magnitude
    bool either_sign;
};

struct effect {
    std::string_view name;
    std::vector<effect_parameter> parameters;
};

std::vector<effect> const& catalogue();
/// How many of them, from the first on, the older families are drawn from: those that came later
/// have families of their own, so that a seed keeps its campaigns.
inline constexpr std::size_t first_effects = 21;
/// Null for an unknown name. "NAME_wider" is NAME over a prior four times as wide: ends at 0, or
/// where the effect vanishes, stay. "NAME@S4+S5" is NAME in these scenarios only,
/// "NAME@S4>=1.5<4+S5" one that begins in S4 at 1.5 s and ends there at 4 s.
effect const* effect_named(std::string_view name);
/// Without "_wider" and "@S4+S5".
std::string plain_name(std::string_view name);
/// When an effect of this name acts in a scenario.
episode episode_in(std::string_view name, std::string_view scenario);

/// Draws a size into `e`; `scale` 1 is normal, 1/3 weak. `largest_rudder` is the largest angle that
/// is commanded: a limit above it has no effect.
void draw_size(effect const& which, random_source& random, double scale, double largest_rudder,
               effect_values& e);

/// Six significant digits, so that what a label says is exactly what was simulated.
double rounded(double value);
std::string six_digits(double value);

/// "wind(0.454645,0.435881)"
std::string described(effect const& which, effect_values const& e);

} // namespace withheld

#endif
