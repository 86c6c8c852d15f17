// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_PALETTE_HPP
#define SIVID_REPORT_DRAW_PALETTE_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

/// Colours by meaning. The hues are those of Okabe and Ito, which stay apart for every common form
/// of colour blindness; they also differ in lightness, and each meaning has a second mark beside
/// its colour (a hatch, a symbol, a dash), so that a grey print can be read.
/// @ref  M. Okabe, K. Ito, Color Universal Design, 2008
namespace sivid::report {

namespace palette {

inline constexpr std::string_view black = "#1a1d21";
inline constexpr std::string_view orange = "#e69f00";
inline constexpr std::string_view sky_blue = "#56b4e9";
inline constexpr std::string_view bluish_green = "#009e73";
inline constexpr std::string_view yellow = "#f0e442";
inline constexpr std::string_view blue = "#0072b2";
inline constexpr std::string_view vermillion = "#d55e00";
inline constexpr std::string_view reddish_purple = "#cc79a7";

inline constexpr std::string_view inside = "#00805d";      // bluish green, darker: solid
inline constexpr std::string_view undecided = "#f2b93b";   // orange, lighter: hatched
inline constexpr std::string_view pending = "#d9a3c2";     // reddish purple, lighter: dotted
inline constexpr std::string_view outside = "#eceef1";     // plain light grey
inline constexpr std::string_view outlier = vermillion;    // cross in a ring
inline constexpr std::string_view outlier_ink = "#b34e00"; // for letters
inline constexpr std::string_view suspect = "#a0447a";     // open diamond
inline constexpr std::string_view tube = "#56b4e9";        // filled band
inline constexpr std::string_view tube_edge = "#2b86bd";
inline constexpr std::string_view measurement = "#1a1d21"; // bar with caps
inline constexpr std::string_view truth = vermillion;      // dashed line
inline constexpr std::string_view prior = "#d5d9df";

inline constexpr std::string_view ink = "#1a1d21";
inline constexpr std::string_view muted_ink = "#5b6470";
inline constexpr std::string_view grid = "#e6e8ec";
inline constexpr std::string_view frame = "#8b94a0";
inline constexpr std::string_view paper = "#ffffff";

} // namespace palette

/// A light-to-dark ramp of one hue; `at` is clamped to [0, 1].
struct colour_ramp {
    std::array<std::array<double, 3>, 4> stops;

    [[nodiscard]] std::string at(double share) const {
        double const place = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) * 3 : 0.0;
        auto const left = std::min<std::size_t>(static_cast<std::size_t>(place), 2);
        double const part = place - static_cast<double>(left);
        std::string out = "#";
        for (std::size_t i = 0; i < 3; ++i) {
            double const value = stops[left][i] * (1 - part) + stops[left + 1][i] * part;
            auto const level = static_cast<unsigned>(std::lround(value));
            constexpr std::string_view digits = "0123456789abcdef";
            out += digits[level / 16];
            out += digits[level % 16];
        }
        return out;
    }
};

/// Blue for what is in order, orange to red-brown for what is not: told apart by hue for every
/// reader, and each ramp is ordered by lightness.
inline constexpr colour_ramp blue_ramp{
    {{{247, 251, 255}, {198, 219, 239}, {107, 174, 214}, {8, 81, 156}}}};
inline constexpr colour_ramp orange_ramp{
    {{{253, 224, 178}, {253, 174, 97}, {224, 102, 20}, {140, 45, 4}}}};

} // namespace sivid::report

#endif
