// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_ESTIMATED_PLACE_HPP
#define SIVID_APPROXIMATE_PLACE_ESTIMATED_PLACE_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/approximate/place/place.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
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
    double from = 0, to = 0; ///< [time]
    double missing = 0;      ///< mean missing rate there, or the sensor's fault
    double deviation = 0;    ///< its standard deviation; 0 when not known
    std::string unit;
    std::string law;    ///< "" when none stands out
    std::string regime; ///< "" when everywhere
    std::vector<estimated_rate> rates;
    /// What an equation may lack, best first, as names of `missing_term`s.
    std::vector<std::string> terms{};
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

/// The stretch, of any length, over which the mean of a missing rate stands out most from its
/// uncertainty.
/// @param covariances  per experiment, of `count` alternating targets, of which this is number `c`
inline void locate(estimated_place& p, std::vector<Eigen::MatrixXd> const& covariances,
                   std::size_t count, std::size_t c) {
    double most = -1;
    for (std::size_t e = 0; e < std::min(p.rates.size(), covariances.size()); ++e) {
        auto const& r = p.rates[e];
        auto const n = static_cast<Eigen::Index>(r.times.size());
        Eigen::VectorXd weight = Eigen::VectorXd::Zero(n); // of the trapezoidal rule
        for (Eigen::Index k = 0; k + 1 < n; ++k) {
            auto const i = static_cast<std::size_t>(k);
            weight[k] += 0.5 * (r.times[i + 1] - r.times[i]);
            weight[k + 1] += 0.5 * (r.times[i + 1] - r.times[i]);
        }
        auto const at = [&](Eigen::Index k) {
            return k * static_cast<Eigen::Index>(count) + static_cast<Eigen::Index>(c);
        };
        for (Eigen::Index first = 0; first < n; ++first) {
            double length = 0, sum = 0, variance = 0;
            for (Eigen::Index last = first; last < n; ++last) {
                double cross = 0;
                for (Eigen::Index k = first; k < last; ++k) {
                    cross += weight[k] * covariances[e](at(k), at(last));
                }
                variance +=
                    weight[last] * (2 * cross + weight[last] * covariances[e](at(last), at(last)));
                length += weight[last];
                sum += weight[last] * r.values[static_cast<std::size_t>(last)];
                if (last == first || !(variance > 0)) continue;
                double const clear = std::abs(sum) / std::sqrt(variance);
                if (!(clear > most)) continue;
                most = clear;
                p.scenario = r.scenario;
                p.from = r.times[static_cast<std::size_t>(first)];
                p.to = r.times[static_cast<std::size_t>(last)];
                p.missing = sum / length;
                p.deviation = std::sqrt(variance) / length;
            }
        }
    }
}

} // namespace sivid

#endif
