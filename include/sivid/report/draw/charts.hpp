// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DRAW_CHARTS_HPP
#define SIVID_REPORT_DRAW_CHARTS_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/report/draw/axes.hpp>
#include <sivid/report/draw/svg.hpp>
#include <sivid/report/draw/time_plot.hpp>
#include <sivid/report/number_text.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sivid::report {

/// One bar: a non-negative quantity known within an interval. The bar is full up to the lower
/// bound and hatched up to the upper one; an infinite upper bound runs to the frame.
struct bar {
    std::string label{};
    range value{};
};

struct bar_chart_options {
    double width = 740;
    std::string title{};
    std::string quantity{}; ///< the axis label
    std::string unit{};
    std::optional<double> threshold{}; ///< a dashed line, e.g. inflation 1
    std::string threshold_label{};
};

/// Horizontal bars of bounded quantities, with their numbers, and a threshold line.
[[nodiscard]] SIVID_DECL svg draw_bar_chart(std::vector<bar> const& bars,
                                            bar_chart_options const& o = {});

/// One row: what is left of the gap after the candidate is joined.
struct candidate_bar {
    std::string label{};
    cause_verdict state = cause_verdict::undecided;
    range proved{};    ///< of the inflation; empty or [0, infinity): nothing proved
    double fitted = 0; ///< of the best fit found, not proved; unless positive and finite: no fit
    bool answer = false;
};

[[nodiscard]] SIVID_DECL std::string_view state_sign(cause_verdict s);
[[nodiscard]] SIVID_DECL std::string_view state_words(cause_verdict s);

[[nodiscard]] SIVID_DECL std::vector<legend_entry>
candidate_legend(std::vector<candidate_bar> const& bars);

/// For each candidate the inflation that is left: proved bounds as a bar, solid to the lower and
/// hatched to the upper one, the best fit as an open circle; the threshold at 1; sign and words for
/// what is proved.
[[nodiscard]] SIVID_DECL svg draw_candidate_chart(std::vector<candidate_bar> const& bars);

/// Values of channels over time windows, for example by how much each window misses its bounds.
struct heat_map {
    std::vector<std::string> rows{};           ///< channel names
    std::vector<double> times{};               ///< the windows' ends, one more than columns
    std::vector<std::vector<double>> values{}; ///< [row][column]; NaN: nothing known
    std::string quantity{};
    double threshold = 1; ///< above it a value is painted orange and crossed
    std::string time_unit = "s";
};

struct heat_map_options {
    double width = 740;
    std::string title{};
    double largest = 0; ///< the colours' end is not below it: lets maps share their colours
    bool key = true;    ///< draw the colour bar
};

/// The largest finite value of a map; 0 when there is none.
[[nodiscard]] SIVID_DECL double largest_value(heat_map const& m);

/// How far the channels miss their bounds, over time: each cell holds the largest misfit of the
/// samples in it; a sample of a slow channel reaches half way to its neighbours.
[[nodiscard]] SIVID_DECL heat_map misfit_map(std::vector<channel_series> const& channels,
                                             bool after, std::size_t most_columns = 60);

/// Channels against time in colour: blue up to the threshold, orange with a cross above it, hatched
/// where nothing is known; with a colour bar.
[[nodiscard]] SIVID_DECL svg draw_heat_map(heat_map const& m, heat_map_options const& o = {});

/// One parameter: what was known before, and what is left.
struct interval_row {
    std::string name{};
    std::string unit{};
    range prior{};
    range hull{};
    std::optional<double> witness{};
};

/// For each parameter its prior as a grey bar and its hull as a coloured bar on it, each row on its
/// own scale, with the numbers of both.
[[nodiscard]] SIVID_DECL svg draw_interval_chart(std::vector<interval_row> const& rows);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/draw/impl/charts.ipp>
#endif

#endif
