// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_PLACE_DETAIL_SENSOR_MODEL_HPP
#define SIVID_APPROXIMATE_PLACE_DETAIL_SENSOR_MODEL_HPP

#include <sivid/approximate/place/place.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// A problem whose model can also have faulty sensors: y = (1 + s) h(x(t - tau)) + b with unknown
/// s, tau (one per sensor) and b (one per channel), or with cross-talk of two channels, all neutral
/// at 0.
struct sensor_problem {
    identification_problem problem;
    /// Per place: which of the problem's parameters are this sensor's faults, s and tau first; of
    /// an instrument askew what each channel shows of the other one.
    std::vector<std::vector<std::size_t>> faults;
    std::size_t original = 0; ///< so many parameters are the model's own
};

[[nodiscard]] inline sensor_problem with_sensor_faults(identification_problem const& source,
                                                       std::vector<place> const& places,
                                                       double longest_delay) {
    sensor_problem result{source, std::vector<std::vector<std::size_t>>(places.size()),
                          source.prior.size()};
    auto& problem = result.problem;
    auto& model = problem.model;
    auto& g = model.g;
    std::vector<interval> sides(source.prior.begin(), source.prior.end());
    auto const add = [&](std::string name, std::string unit, interval const& prior) {
        model.about.constants.push_back({name, std::move(unit), literal{interval(0.0), 0.0}});
        problem.choice.unknown.push_back(std::move(name));
        sides.push_back(prior);
        return model.about.constants.size() - 1;
    };
    // The range of what each channel showed bounds its offset.
    std::vector<double> low(model.observe.size(), HUGE_VAL), high(model.observe.size(), -HUGE_VAL);
    for (auto const& e : source.experiments) {
        for (auto const& m : e.measurements) {
            low[m.channel] = std::min(low[m.channel], m.bound.lower());
            high[m.channel] = std::max(high[m.channel], m.bound.upper());
        }
    }
    for (std::size_t p = 0; p < places.size(); ++p) {
        if (places[p].kind != place_kind::sensor) continue;
        auto const fault = "sensor " + places[p].name;
        if (places[p].askew) {
            std::array<decltype(g.constant(1.0)), 2> share{};
            for (std::size_t m = 0; m < 2; ++m) {
                auto const& own = model.about.channels[places[p].members[m]].name;
                result.faults[p].push_back(sides.size());
                share[m] = g.leaf(operation::constant,
                                  add(fault + " share in " + own, "1", interval(-0.4, 0.4)));
            }
            // Turned by a, with shares sin a and -sin a, each shows cos a of its own.
            auto const kept =
                g.add(g.constant(1.0), g.mul(g.constant(0.5), g.mul(share[0], share[1])));
            for (std::size_t m = 0; m < 2; ++m) {
                auto const own = places[p].members[m], other = places[p].members[1 - m];
                model.observe[own] = g.add(g.mul(kept, model.observe[own]),
                                           g.mul(share[m], source.model.observe[other]));
            }
            continue;
        }
        result.faults[p].push_back(sides.size());
        auto const scale =
            g.leaf(operation::constant, add(fault + " scale", "1", interval(-0.6, 0.6)));
        bool const late = std::none_of(
            model.channel_delays.begin(), model.channel_delays.end(), [&](signal_memory const& d) {
                auto const& own = places[p].members;
                return std::find(own.begin(), own.end(), d.index) != own.end();
            });
        std::size_t delay = 0;
        if (late) {
            result.faults[p].push_back(sides.size());
            delay = add(fault + " latency", model.about.time_unit, interval(0.0, longest_delay));
        }
        for (auto const k : places[p].members) {
            double const range = high[k] > low[k] ? high[k] - low[k] : std::abs(high[k]);
            result.faults[p].push_back(sides.size());
            auto const offset = g.leaf(operation::constant,
                                       add(fault + " offset " + model.about.channels[k].name,
                                           model.about.channels[k].unit, interval(-range, range)));
            auto const gain = g.add(g.constant(1.0), scale);
            model.observe[k] = g.add(g.mul(gain, model.observe[k]), offset);
            if (late) model.channel_delays.push_back({k, delay});
        }
    }
    problem.prior = box(sides.size());
    for (std::size_t j = 0; j < sides.size(); ++j) problem.prior[j] = sides[j];
    return result;
}

} // namespace sivid

#endif
