// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_LEGEND_HPP
#define SIVID_REPORT_DRAW_LEGEND_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/draw/svg.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The symbols of all plots, drawn by the same functions in a plot and in its legend.
namespace sivid::report {

enum class symbol {
    measured,       ///< a bar with caps: a measured interval
    forced_outlier, ///< cross in a ring: proven to violate its bound
    suspect,        ///< open diamond: violated by the witness only
    tube,           ///< filled band: a proven enclosure
    reference,      ///< dashed line: not validated
    inside,
    undecided,
    pending,
    outside,
    witness,      ///< a star-like cross: a verified point
    measured_box, ///< outlined box
    prior,
    hull,
    heading,          ///< arrowhead: not validated
    window,           ///< dashed outline: what a zoom shows
    line_before,      ///< dashed line: the model as it is, not validated
    line_after,       ///< full line: the model with an effect, not validated
    certified_window, ///< outlined filled box: proved over a window
    bar_to_lower,     ///< solid: up to the proved lower bound
    bar_to_upper,     ///< hatched: between the proved bounds
    estimate          ///< open circle: not proved
};

/// The paint of lines that compare two models.
inline constexpr paint line_before_paint{.stroke = palette::truth, .width = 1.7, .dash = "6 3"};
inline constexpr paint line_after_paint{.stroke = palette::blue, .width = 1.7};

struct legend_entry {
    symbol mark;
    std::string label{};
};

/// Those entries that occur.
[[nodiscard]] inline std::vector<legend_entry>
legend_of(std::initializer_list<std::pair<bool, legend_entry>> all) {
    std::vector<legend_entry> out;
    for (auto const& [occurs, entry] : all)
        if (occurs) out.push_back(entry);
    return out;
}

SIVID_DECL void draw_measured(svg& out, double x, double low, double high, std::string_view colour,
                              std::string_view tip = {});

SIVID_DECL void draw_forced_outlier(svg& out, double x, double y, std::string_view tip = {});

SIVID_DECL void draw_suspect(svg& out, double x, double y, std::string_view tip = {});

/// An arrowhead that points along `angle` [rad], counted against the clock.
SIVID_DECL void add_arrowhead(path_data& d, double x, double y, double angle);

/// Points at something beyond the frame.
SIVID_DECL void draw_beyond(svg& out, double x, double y, bool upward, std::string_view colour);

SIVID_DECL void draw_witness(svg& out, double x, double y, std::string_view tip = {});

/// A number that is not proved.
SIVID_DECL void draw_estimate(svg& out, double x, double y, std::string_view tip = {});

/// The paint of a region of a paving; undecided is hatched, pending dotted.
[[nodiscard]] SIVID_DECL std::string region_fill(svg& out, symbol region);

/// One symbol in a cell of 26 x 14 whose upper left corner is (x, y).
SIVID_DECL void draw_symbol(svg& out, symbol what, double x, double y);

/// Draws a legend in rows no wider than `width`. @returns its height
SIVID_DECL double draw_legend(svg& out, std::vector<legend_entry> const& entries, double x,
                              double y, double width);

/// A symbol alone, for a legend set in HTML.
[[nodiscard]] SIVID_DECL svg symbol_picture(symbol what, std::string_view label);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/legend.ipp>
#endif

#endif
