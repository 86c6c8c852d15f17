// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_DETAIL_PLACE_RESULTS_HPP
#define SIVID_DIAGNOSIS_DETAIL_PLACE_RESULTS_HPP

#include <sivid/diagnosis/place.hpp>
#include <sivid/paving/approximate_fit.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace sivid {

/// A missing rate d(t) of one equation in one scenario, with its uncertainty.
struct estimated_rate {
    std::string scenario;
    std::vector<double> times, values, deviations;
};

/// A place where model and data part, estimated and not proved.
struct estimated_place {
    place_kind kind = place_kind::equation;
    std::vector<std::size_t> members; ///< states, channels or the input
    std::string name;
    double loss = 0;         ///< what the score loses without it
    std::string scenario;    ///< where it is seen best
    double from = 0, to = 0; ///< [s]
    double missing = 0;      ///< mean missing rate there, or the sensor's fault
    double deviation = 0;    ///< its standard deviation; 0 when not known
    std::string unit;
    std::string law;    ///< "" when none stands out
    std::string regime; ///< "" when everywhere
    std::vector<estimated_rate> rates;
    std::vector<std::string> sensors{}; ///< of a definition: channels, its own state's first
};

/// One set of places that was allowed to be wrong.
struct tried_places {
    std::vector<std::string> names; ///< sensors as "sensor r"
    double inflation = 0, score = 0, cost = 0;
};

/// Where a model departs from its data.
struct place_estimate {
    approximate_fit base;                ///< without anything missing
    std::vector<estimated_place> places; ///< most important first; empty when nothing is missing
    double inflation = 0;                ///< that is left with these places
    std::vector<tried_places> tried;
    std::vector<std::vector<std::string>> alternatives; ///< sets that do as well
    double seconds = 0;
};

} // namespace sivid

#endif
