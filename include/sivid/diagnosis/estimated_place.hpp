// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_ESTIMATED_PLACE_HPP
#define SIVID_DIAGNOSIS_ESTIMATED_PLACE_HPP

#include <sivid/diagnosis/detail/place_results.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sivid {

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
