// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_DETAIL_BOUNDS_OUTPUT_HPP
#define SIVID_APP_DETAIL_BOUNDS_OUTPUT_HPP

#include <sivid/app/console.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/number/text/nearest_text.hpp>
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
            csv += io_detail::cell(whose(line, problem)) + "," + report::exact_text(line.scale) +
                   "," + std::string{to_string(line.found)} + "," + (line.ended ? "1," : "0,") +
                   io_detail::cell(problem.choice.unknown[j]) + ",";
            csv += is_empty(line.hull) ? std::string{","}
                                       : to_decimal_lower(line.hull[j].lower()) + "," +
                                             to_decimal_upper(line.hull[j].upper());
            csv += "\n";
        }
    }
    return csv;
}

/// What one line says: how wide the ranges would be, in shares of those with the stated bounds,
/// where any of these are known.
inline std::string bounds_words(identification_problem const& problem, bound_influence const& line,
                                box const& stated) {
    if (is_empty(line.hull)) return "no parameter explains the data";
    std::string text;
    for (std::size_t j = 0; j < line.hull.size() && !is_empty(stated); ++j)
        text += (j == 0 ? "" : ", ") + problem.choice.unknown[j] + " " +
                nearest_text(width(line.hull[j]) / width(stated[j]), 3);
    if (is_empty(stated))
        text = line.found == verdict::consistent ? "some parameter explains the data" : "undecided";
    return text + (line.ended         ? ""
                   : is_empty(stated) ? " (the budget ended)"
                                      : " (at most: the budget ended)");
}
/// A line for each search but that with the stated bounds, the first.
inline std::string bounds_text(identification_problem const& problem,
                               std::vector<bound_influence> const& lines) {
    auto const& stated = lines.front().hull;
    std::string text = "  with other error bounds, ";
    text += is_empty(stated) ? "whether any parameter explains the data (bounds.csv):\n"
                             : "ranges as shares of those with the stated ones (bounds.csv):\n";
    for (std::size_t k = 1; k < lines.size(); ++k)
        text += "    " + whose(lines[k], problem) + " x " + report::given_text(lines[k].scale) +
                ": " + bounds_words(problem, lines[k], stated) + "\n";
    return text;
}

} // namespace sivid::app::detail

#endif
