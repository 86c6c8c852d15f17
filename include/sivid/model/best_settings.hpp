// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_BEST_SETTINGS_HPP
#define SIVID_MODEL_BEST_SETTINGS_HPP

#include <sivid/model/manoeuvre.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

struct chosen_settings {
    std::vector<double> settings;
    double value = -std::numeric_limits<double>::infinity(); ///< no settings: none had a value
};

/// The settings at which a function of them is largest, about: a compass search from the best of a
/// few spread points. The settings are few, and numbers of few digits are chosen.
///   Not a proof.
/// @param value  minus infinity, or no number, where it has none
[[nodiscard]] inline chosen_settings
best_settings(std::vector<manoeuvre_setting> const& limits,
              std::function<double(std::vector<double> const&)> const& value) {
    auto const n = limits.size();
    chosen_settings best;
    auto const consider = [&](std::vector<double> s, double coarseness) {
        for (std::size_t i = 0; i < n; ++i) {
            double const range = limits[i].upper - limits[i].lower;
            s[i] = few_digits(limits[i].lower, limits[i].upper, s[i], coarseness * range);
        }
        double const v = value(s);
        if (!(v > best.value)) return;
        best = {std::move(s), v};
    };
    std::size_t const tries = n == 0 ? 1 : 12;
    for (std::size_t k = 0; k < tries; ++k) {
        std::vector<double> s;
        for (std::size_t i = 0; i < n; ++i) {
            double const share = std::fmod(
                0.5 + static_cast<double>(k) * std::sqrt(static_cast<double>(2 + 3 * i)), 1.0);
            s.push_back(limits[i].lower + share * (limits[i].upper - limits[i].lower));
        }
        consider(std::move(s), 0.02);
    }
    if (!std::isfinite(best.value)) return best;
    for (double step = 0.25; n > 0 && step > 0.05; step /= 2) {
        for (std::size_t i = 0; i < n; ++i) {
            for (double const way : {-1.0, 1.0}) {
                auto s = best.settings;
                s[i] = std::clamp(s[i] + way * step * (limits[i].upper - limits[i].lower),
                                  limits[i].lower, limits[i].upper);
                if (s[i] != best.settings[i]) consider(std::move(s), 0.05 * step);
            }
        }
    }
    return best;
}

} // namespace sivid

#endif
