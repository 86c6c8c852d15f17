// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_SENSOR_DISCHARGE_HPP
#define SIVID_DIAGNOSIS_SENSOR_DISCHARGE_HPP

#include <sivid/diagnosis/broken_relation.hpp>
#include <sivid/paving/problem.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A sensor that shows \f$ y = (1 + s) h + b \f$ instead of h, with unknown s and b in ranges.
struct sensor_fault {
    interval scale{0.0}; ///< s, above -1
    interval bias{0.0};  ///< b, in the channel's unit
};

/// Whether a faulty sensor could repair a broken relation.
struct sensor_verdict {
    std::string channel;
    /// Proved: whatever s and b in their ranges, the equation and the sensors in its row, this one
    /// corrected, cannot hold together. The fault is elsewhere in the row, or there are two.
    bool discharged = false;
    /// Otherwise: a fault (s, b) that was not refuted, if one was found.
    std::optional<std::pair<double, double>> repair;
    std::size_t examined = 0; ///< how many boxes of (s, b)
};

/// The problem whose channel is corrected: \f$ h \in (y - b)/(1 + s) \f$.
/// @throws std::invalid_argument if there is no such channel or the scale reaches -1
[[nodiscard]] inline identification_problem corrected(identification_problem const& problem,
                                                      std::string const& channel,
                                                      sensor_fault const& fault) {
    using traits = interval_traits<interval>;
    auto const index = index_of(problem.model.about.channels, channel, "channel");
    auto const factor = traits::add(traits::point(1.0), fault.scale);
    if (!(factor.lower() > 0) || !is_bounded(factor) || !is_bounded(fault.bias)) {
        throw std::invalid_argument("sensor fault: the scale has to stay above -1, all bounded");
    }
    auto result = problem;
    for (auto& e : result.experiments) {
        for (auto& m : e.measurements) {
            bool undefined = false;
            if (m.channel != index) continue;
            m.bound = traits::div(traits::sub(m.bound, fault.bias), factor, undefined);
        }
    }
    return result;
}

/// Tries to prove that no fault of one sensor in the given ranges repairs the relation of equation
/// i: the box of faults is cut until every part is refuted, or a point in it is not.
/// @guarantee  `discharged` only if the parts cover the ranges and each was refuted as in
///             `relation_examiner`, under the assumptions stated there for the corrected channel
/// @cost  one examination of an equation (some milliseconds) for each part and for each centre
[[nodiscard]] inline sensor_verdict
discharge_sensor(identification_problem const& problem, std::size_t equation,
                 std::string const& channel, sensor_fault const& ranges,
                 relation_options const& options = {}, std::size_t most_boxes = 64) {
    sensor_verdict result;
    result.channel = channel;
    auto const refuted = [&](sensor_fault const& fault) {
        ++result.examined;
        auto const changed = corrected(problem, channel, fault);
        return relation_examiner(changed, options).examine(equation).proved;
    };
    box const whole{ranges.scale, ranges.bias};
    std::vector<box> open{whole};
    while (!open.empty()) {
        auto const part = open.back();
        open.pop_back();
        if (result.examined + 2 > most_boxes) return result;
        auto const centre = mid(part);
        if (!refuted({interval(centre[0]), interval(centre[1])})) {
            result.repair = {centre[0], centre[1]};
            return result;
        }
        if (is_point(part[0]) && is_point(part[1])) continue;
        if (refuted({part[0], part[1]})) continue;
        // Cut where the part is wider, relative to the ranges.
        auto const share = [&](std::size_t k) {
            return is_point(whole[k]) ? 0.0 : width(part[k]) / width(whole[k]);
        };
        auto const side = share(0) > share(1) ? std::size_t{0} : std::size_t{1};
        auto [below, above] = bisect(part, side, centre[side]);
        open.push_back(std::move(below));
        open.push_back(std::move(above));
    }
    result.discharged = true;
    return result;
}

} // namespace sivid

#endif
