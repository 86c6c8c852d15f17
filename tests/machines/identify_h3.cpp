// SPDX-License-Identifier: MIT
// A small identification of the reference campaign h3, whose true constants are known.
//     identify_h3 FOLDER_OF_H3 [ANSWER]
// Prints the verdict and the hulls, and keeps them in the file ANSWER; what another machine left there
// has to be the same: machines contract plain arithmetic in their own way, so hulls agree to 1e-5.
#include <sivid/number/decimal.hpp>
#include <sivid/paving/identify.hpp>

#include "../../examples/hovercraft/model.hpp"

#include <cmath>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace sivid;
using traits = interval_traits<interval>;

/// The cells of a file below its heading.
std::vector<std::vector<std::string>> table(std::string const& file) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error("cannot read " + file);
    std::vector<std::vector<std::string>> rows;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::istringstream cells(line);
        rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
    }
    return rows;
}

double number(std::string const& text) { return *parse_nearest(text); }

identification_problem problem_of(std::string const& folder) {
    experiment turn;
    turn.name = "S3";
    turn.initial = box(6);
    turn.initial[0] = interval(2.0); // all else from zero
    std::vector<double> times, speed, rudder;
    for (auto const& row : table(folder + "/S3.inputs.csv")) {
        times.push_back(number(row[0]));
        speed.push_back(number(row[1]));
        rudder.push_back(number(row[2]));
    }
    turn.inputs = {sampled_signal(times, speed, interpolation::linear),
                   sampled_signal(times, rudder, interpolation::linear)};
    for (auto const& row : table(folder + "/S3.measurements.csv"))
        for (std::size_t channel = 0; channel < 6; ++channel) {
            interval const value = *parse_decimal(row[1 + 2 * channel]),
                           error = *parse_decimal(row[2 + 2 * channel]);
            turn.measurements.push_back({number(row[0]), channel,
                                         traits::bounds(traits::sub(value, error).lower(),
                                                        traits::add(value, error).upper())});
        }
    box const prior{hull(0.2_dec, 0.25_dec), hull(0.0042_dec, 0.0754_dec),
                    hull(0.25_dec, 0.35_dec)};
    return {record_model<hovercraft>(), {{"Sv", "Sg", "L"}, {}}, prior, {turn}};
}

constexpr double truth[] = {0.22, 0.04, 0.30}; // examples/hovercraft/data/h3/truth.json

bool agrees(std::string const& file, std::string const& verdict, box const& hull) {
    std::ifstream in(file);
    std::string known;
    std::getline(in, known);
    bool same = known == verdict;
    for (auto const& side : hull)
        for (double const end : {side.lower(), side.upper()}) {
            double other = 0;
            same = same && in >> other && std::abs(end - other) <= 1e-5 * std::abs(other);
        }
    return same;
}

} // namespace

int main(int count, char** arguments) {
    if (count < 2) return 2;
    identify_options options;
    options.search.boxes = 20;
    options.search.seconds = 1e6; // the result must not depend on the clock
    auto const found = identify(problem_of(arguments[1]), options);
    std::string const verdict{to_string(found.verdict)};
    std::ostringstream text;
    text.precision(17);
    text << verdict << '\n';
    bool right = found.hull.size() == std::size(truth);
    for (std::size_t j = 0; j < found.hull.size(); ++j) {
        right = right && contains(found.hull[j], truth[j]);
        text << found.hull[j].lower() << ' ' << found.hull[j].upper() << '\n';
    }
    std::cout << text.str();
    if (count > 2 && std::ifstream(arguments[2]))
        right = right && agrees(arguments[2], verdict, found.hull);
    else if (count > 2)
        std::ofstream(arguments[2]) << text.str();
    return right ? 0 : 1;
}
