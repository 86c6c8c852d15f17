// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_BROKEN_RELATION_HPP
#define SIVID_PAVING_RELATION_DETAIL_BROKEN_RELATION_HPP

#include <sivid/paving/relation/detail/relation_windows.hpp>
#include <sivid/paving/relation/linear_refutation.hpp>
#include <sivid/paving/relation/relation_finding.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Examines the state equations of a problem one by one, each with the sensors in its row.
///   Integrated over a window, \f$ x_i' = \phi_0 + \sum_j \theta_j \phi_j \f$ says
///   \f$ x_i(t_b) - x_i(t_a) = a_0 + \sum_j \theta_j a_j \f$ with \f$ a_j = \int \phi_j dt \f$,
///   which the tubes of the measured states enclose without any integration of the model. Every
///   window gives two linear inequalities on \f$ \theta \f$; if those of all windows contradict
///   each other and the prior, which `proved_margin` checks in intervals, the equation and its
///   sensors cannot both hold.
class relation_examiner {
public:
    /// @param problem  outlives this object
    /// @throws std::invalid_argument if the problem is not valid, or experiments share a name
    /// @param suspect  a sensor that may be faulty, see `sensor_discharge.hpp`
    explicit relation_examiner(identification_problem const& problem,
                               relation_options const& options = {},
                               suspected_sensor const* suspect = nullptr)
        : windows_(problem, options, suspect), options_(options) {
        problem.require_valid_campaign();
    }

    [[nodiscard]] relation_windows& windows() { return windows_; }
    [[nodiscard]] std::size_t equations() const { return windows_.about().states.size(); }

    /// Tries to refute equation i (the rate of state i).
    [[nodiscard]] relation_finding examine(std::size_t i) {
        relation_finding result;
        result.equation = i;
        result.name = windows_.about().states.at(i).equation_name();
        result.reason = windows_.obstacle(i);
        if (!result.reason.empty()) return result;
        result.definition = windows_.row(i).kinematic;
        for (auto const way : windows_.ways(i)) {
            auto const list = windows_.all(i, way);
            if (list.empty()) {
                result.reason = "no window with all its sensors";
                continue;
            }
            result.reason.clear();
            attempt(i, way, list, result);
            if (result.proved) break;
        }
        return result;
    }

    /// The rate that equation i lacks on the average over one window, as far as it is covered.
    [[nodiscard]] std::optional<interval> missing_over(std::size_t i, relation_window const& at) {
        std::optional<interval> result;
        if (!windows_.obstacle(i).empty()) return result;
        for (auto const way : windows_.ways(i)) {
            auto const w = windows_.over(i, way, at);
            if (!w) continue;
            auto const found = missing_rate_in(windows_.row(i), *w);
            auto const both = result ? intersect(*result, found) : found;
            if (!is_empty(both)) result = both;
        }
        return result;
    }

private:
    [[nodiscard]] missing_rate missing(std::size_t i, window_row const& w) const {
        return {{windows_.motion(w.motion).name, w.from, w.to},
                missing_rate_in(windows_.row(i), w),
                windows_.rate_unit(i)};
    }

    void attempt(std::size_t i, window_way way, std::vector<window_row> const& list,
                 relation_finding& result) {
        if (windows_.stopped()) return;
        auto const system = system_of(windows_.row(i), list);
        auto const relaxed = least_relaxation(system);
        result.margin = proved_margin(system, relaxed.multipliers);
        double best = -1;
        for (auto const& w : list) {
            auto const found = missing(i, w);
            double const clear = std::abs(mid(found.value)) / (width(found.value) + 1e-300);
            if (!(clear > best)) continue;
            best = clear;
            result.missing = found;
        }
        if (!(result.margin > 0) || result.margin < options_.least_margin) return;
        result.proved = true;
        std::map<std::size_t, double> since;
        for (auto const& [k, factor] : relaxed.multipliers.multipliers) {
            if (k >= 2 * list.size()) continue; // between coefficients
            auto const& w = list[k / 2];
            relation_window const window{windows_.motion(w.motion).name, w.from, w.to};
            if (std::find(result.windows.begin(), result.windows.end(), window) !=
                result.windows.end()) {
                continue;
            }
            result.windows.push_back(window);
            auto& first = since.emplace(w.motion, w.from).first->second;
            first = std::min(first, w.from);
        }
        windows_.describe(i, way, since, result);
    }

    relation_windows windows_;
    relation_options options_;
};

/// Examines every state equation; those of which nothing could be tried have a reason.
/// @throws std::invalid_argument if the problem is not valid
/// @cost  some tens of milliseconds for a thousand samples and six equations
[[nodiscard]] inline std::vector<relation_finding>
examine_relations(identification_problem const& problem, relation_options const& options = {}) {
    relation_examiner examiner(problem, options);
    std::vector<relation_finding> result;
    for (std::size_t i = 0; i < examiner.equations(); ++i) result.push_back(examiner.examine(i));
    return result;
}

/// The equations that are proved not to hold together with their sensors, clearest first.
[[nodiscard]] inline std::vector<relation_finding>
find_broken_relations(identification_problem const& problem, relation_options const& options = {}) {
    auto result = examine_relations(problem, options);
    std::erase_if(result, [](relation_finding const& f) { return !f.proved; });
    std::stable_sort(result.begin(), result.end(),
                     [](auto const& a, auto const& b) { return a.margin > b.margin; });
    return result;
}

} // namespace sivid

#endif
