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

namespace approximate_detail {

class sensor_fault_builder {
public:
    explicit sensor_fault_builder(identification_problem const& source,
                                  std::vector<place> const& places)
        : source_(&source),
          places_(&places),
          result_{source, std::vector<std::vector<std::size_t>>(places.size()),
                  source.prior.size()},
          sides_(source.prior.begin(), source.prior.end()),
          low_(source.model.observe.size(), HUGE_VAL),
          high_(source.model.observe.size(), -HUGE_VAL) {
        for (auto const& e : source.experiments) {
            for (auto const& m : e.measurements) {
                low_[m.channel] = std::min(low_[m.channel], m.bound.lower());
                high_[m.channel] = std::max(high_[m.channel], m.bound.upper());
            }
        }
    }

    [[nodiscard]] sensor_problem operator()(double longest_delay) {
        for (std::size_t p = 0; p < places_->size(); ++p) {
            auto const& where = (*places_)[p];
            if (where.kind != place_kind::sensor) continue;
            if (where.askew)
                turn(p);
            else
                distort(p, longest_delay);
        }
        auto& prior = result_.problem.prior;
        prior = box(sides_.size());
        for (std::size_t j = 0; j < sides_.size(); ++j) prior[j] = sides_[j];
        return std::move(result_);
    }

private:
    [[nodiscard]] recorded_model& model() { return result_.problem.model; }
    /// A further parameter, a fault of a place. @returns the constant
    std::size_t add(std::size_t p, std::string const& what, std::string unit,
                    interval const& prior) {
        auto name = "sensor " + (*places_)[p].name + " " + what;
        auto& constants = model().about.constants;
        constants.push_back({name, std::move(unit), literal{interval(0.0), 0.0}});
        result_.problem.choice.unknown.push_back(std::move(name));
        result_.faults[p].push_back(sides_.size());
        sides_.push_back(prior);
        return constants.size() - 1;
    }
    [[nodiscard]] node_id leaf(std::size_t constant) {
        return model().g.leaf(operation::constant, constant);
    }
    /// Each of two channels shows some of the other one.
    void turn(std::size_t p) {
        auto const& members = (*places_)[p].members;
        auto& g = model().g;
        std::array<node_id, 2> share{};
        for (std::size_t m = 0; m < 2; ++m) {
            auto const& own = source_->model.about.channels[members[m]].name;
            share[m] = leaf(add(p, "share in " + own, "1", interval(-0.4, 0.4)));
        }
        // Turned by a, with shares sin a and -sin a, each shows cos a of its own.
        auto const kept = g.add(g.constant(1.0), g.mul(g.constant(0.5), g.mul(share[0], share[1])));
        auto& observe = model().observe;
        for (std::size_t m = 0; m < 2; ++m) {
            auto const own = members[m], other = members[1 - m];
            observe[own] =
                g.add(g.mul(kept, observe[own]), g.mul(share[m], source_->model.observe[other]));
        }
    }
    /// A scale and a latency that channels share, unless they are late already, and offsets within
    /// the range of what each showed.
    void distort(std::size_t p, double longest_delay) {
        auto const& members = (*places_)[p].members;
        auto& delays = model().channel_delays;
        auto& g = model().g;
        auto const& about = source_->model.about;
        auto const scale = leaf(add(p, "scale", "1", interval(-0.6, 0.6)));
        bool const late =
            std::none_of(delays.begin(), delays.end(), [&members](signal_memory const& d) {
                return std::find(members.begin(), members.end(), d.index) != members.end();
            });
        std::size_t delay = 0;
        if (late) delay = add(p, "latency", about.time_unit, interval(0.0, longest_delay));
        for (auto const k : members) {
            double const range = high_[k] > low_[k] ? high_[k] - low_[k] : std::abs(high_[k]);
            auto const offset = leaf(add(p, "offset " + about.channels[k].name,
                                         about.channels[k].unit, interval(-range, range)));
            auto const gain = g.add(g.constant(1.0), scale);
            model().observe[k] = g.add(g.mul(gain, model().observe[k]), offset);
            if (late) delays.push_back({k, delay});
        }
    }

    identification_problem const* source_;
    std::vector<place> const* places_;
    sensor_problem result_;
    std::vector<interval> sides_;    ///< of the prior
    std::vector<double> low_, high_; ///< what each channel showed
};

} // namespace approximate_detail

[[nodiscard]] inline sensor_problem with_sensor_faults(identification_problem const& source,
                                                       std::vector<place> const& places,
                                                       double longest_delay) {
    return approximate_detail::sensor_fault_builder(source, places)(longest_delay);
}

} // namespace sivid

#endif
