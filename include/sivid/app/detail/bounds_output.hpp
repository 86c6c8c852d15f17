// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_BOUNDS_OUTPUT_HPP
#define SIVID_APP_DETAIL_BOUNDS_OUTPUT_HPP

#include <sivid/app/console.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/paving/bound_influence.hpp>
#include <sivid/report/number_text.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace sivid::app::detail {

/// Whose bounds a line is about.
inline std::string whose(bound_influence const& line, identification_problem const& problem) {
    return line.channel ? std::string{problem.model.about.channels[*line.channel].name}
                        : "all channels";
}

/// A line for each parameter of each search.
inline std::string bounds_csv(identification_problem const& problem,
                              std::vector<bound_influence> const& lines) {
    std::string csv = "bounds_of,scale,verdict,complete,parameter,lower,upper\n";
    for (auto const& line : lines) {
        for (std::size_t j = 0; j < line.hull.size(); ++j) {
            csv += whose(line, problem) + "," + report::exact_text(line.scale) + "," +
                   std::string{to_string(line.found)} + "," + (line.ended ? "1," : "0,") +
                   problem.choice.unknown[j] + ",";
            csv += is_empty(line.hull) ? std::string{","}
                                       : to_decimal_lower(line.hull[j].lower()) + "," +
                                             to_decimal_upper(line.hull[j].upper());
            csv += "\n";
        }
    }
    return csv;
}

/// How wide the ranges would be, in shares of those with the stated bounds (the first line).
inline std::string bounds_text(identification_problem const& problem,
                               std::vector<bound_influence> const& lines) {
    auto const& stated = lines.front().hull;
    if (is_empty(stated)) return {};
    std::string text = "  ranges with other error bounds, as shares of those with the stated "
                       "ones (bounds.csv):\n";
    for (std::size_t k = 1; k < lines.size(); ++k) {
        auto const& line = lines[k];
        text += "    " + whose(line, problem) + " x " + report::given_text(line.scale) + ": ";
        if (is_empty(line.hull)) {
            text += "no parameter explains the data\n";
            continue;
        }
        for (std::size_t j = 0; j < line.hull.size(); ++j)
            text += (j == 0 ? "" : ", ") + problem.choice.unknown[j] +
                    text_of(" %.3g", width(line.hull[j]) / width(stated[j]));
        text += line.ended ? "\n" : " (at most: the budget ended)\n";
    }
    return text;
}

} // namespace sivid::app::detail

#endif
