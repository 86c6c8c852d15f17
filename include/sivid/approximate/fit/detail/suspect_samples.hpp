// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_DETAIL_SUSPECT_SAMPLES_HPP
#define SIVID_APPROXIMATE_FIT_DETAIL_SUSPECT_SAMPLES_HPP

#include <sivid/approximate/fit/detail/approximate_campaign.hpp>
#include <sivid/space/dense.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace sivid {

namespace approximate_detail {

/// By how many half-widths each sample of one channel leaves a parabola through its neighbours,
/// fitted without it and robustly (least absolute values by reweighting).
/// @param over  asked now and then: the samples that come then are not looked at
template <class Over>
[[nodiscard]] std::vector<double> local_misfits(std::vector<double> const& t,
                                                std::vector<double> const& y,
                                                std::vector<double> const& e, Over const& over) {
    std::vector<double> result(t.size(), 0.0);
    std::size_t const side = 4;
    approximate_cholesky factor;
    if (t.size() < 2 * side) return result;
    for (std::size_t k = 0; k < t.size(); ++k) {
        if (k % 256 == 0 && over()) break;
        auto const first = std::min(k > side ? k - side : 0, t.size() - 2 * side);
        auto const last = std::min(t.size(), first + 2 * side + 1);
        Eigen::Vector3d c = Eigen::Vector3d::Zero();
        std::vector<double> weight(last - first, 1.0);
        double const reach = std::max(t[last - 1] - t[first], 1e-300);
        auto const basis = [&](std::size_t i) {
            double const s = (t[i] - t[k]) / reach;
            return Eigen::Vector3d(1, s, s * s);
        };
        for (int round = 0; round < 12; ++round) {
            Eigen::Matrix3d n = 1e-9 * Eigen::Matrix3d::Identity();
            Eigen::Vector3d b = Eigen::Vector3d::Zero();
            for (std::size_t i = first; i < last; ++i) {
                if (i == k) continue;
                double const w = weight[i - first];
                n += w * basis(i) * basis(i).transpose();
                b += w * y[i] * basis(i);
            }
            if (!factor.compute(n)) break;
            c = factor.solve(b);
            for (std::size_t i = first; i < last; ++i) {
                double const r = std::abs(y[i] - basis(i).dot(c)) / e[i];
                weight[i - first] = 1 / std::max(r, 0.3);
            }
        }
        result[k] = std::abs(y[k] - c[0]) / e[k];
    }
    return result;
}

} // namespace approximate_detail

/// Weights for the first descents: 0 for samples that do not go on from their neighbours, at most
/// as many in each experiment as its outlier budget allows. For fitting only: a proof never flags.
[[nodiscard]] inline residual_lists without_suspects(approximate_campaign const& c,
                                                     double limit = 4) {
    residual_lists kept;
    for (std::size_t e = 0; e < c.experiments(); ++e) {
        auto const& requests = c.requests(e);
        auto& own = kept.emplace_back(requests.size(), 1.0);
        auto const budget = c.outliers()[e];
        if (budget == 0) continue;
        std::map<std::size_t, std::vector<std::size_t>> channels;
        for (std::size_t k = 0; k < requests.size(); ++k)
            channels[requests[k].channel].push_back(k);
        std::vector<std::pair<double, std::size_t>> suspects;
        for (auto const& [channel, rows] : channels) {
            std::vector<double> t, y, r;
            for (auto const k : rows) {
                t.push_back(requests[k].time);
                y.push_back(c.centres(e)[k]);
                r.push_back(c.radii(e)[k]);
            }
            auto const misfit =
                approximate_detail::local_misfits(t, y, r, [&c] { return c.cancelled(); });
            for (std::size_t i = 0; i < rows.size(); ++i) {
                if (misfit[i] > limit) suspects.emplace_back(misfit[i], rows[i]);
            }
        }
        std::sort(suspects.rbegin(), suspects.rend());
        for (std::size_t i = 0; i < std::min(budget, suspects.size()); ++i) {
            own[suspects[i].second] = 0;
        }
    }
    return kept;
}

} // namespace sivid

#endif
