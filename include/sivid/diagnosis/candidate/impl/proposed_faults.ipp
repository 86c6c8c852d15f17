// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_IMPL_PROPOSED_FAULTS_IPP
#define SIVID_DIAGNOSIS_CANDIDATE_IMPL_PROPOSED_FAULTS_IPP

#include <sivid/diagnosis/candidate/detail/proposed_faults.hpp>

#include <sivid/approximate/place/place.hpp>
#include <sivid/compiled.hpp>
#include <sivid/model/named_effects.hpp>
#include <sivid/model/unit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

/// 1, 2 or 5 times a power of ten, no less than x, as a decimal without exponent; nothing for 0,
/// and for what is not finite.
inline std::string round_size(double x) {
    if (!(x > 0) || !std::isfinite(x)) return {};
    int const about = static_cast<int>(std::floor(std::log10(x)));
    for (int power = about - 1; power < about + 2; ++power) {
        for (int const digit : {1, 2, 5}) {
            if (static_cast<double>(digit) * std::pow(10.0, power) < x * (1 - 1e-9)) continue;
            auto const zeros = static_cast<std::size_t>(std::abs(power));
            if (power >= 0) return std::to_string(digit) + std::string(zeros, '0');
            return "0." + std::string(zeros - 1, '0') + std::to_string(digit);
        }
    }
    return {};
}

class fault_proposals {
public:
    fault_proposals(identification_problem const& problem, place_estimate const& estimate,
                    std::vector<confined_gap> const& confined)
        : problem_(&problem),
          about_(&problem.model.about),
          low_(about_->channels.size(), HUGE_VAL),
          high_(about_->channels.size(), -HUGE_VAL) {
        for (auto const& e : problem.experiments) {
            for (auto const& m : e.measurements) {
                low_[m.channel] = std::min(low_[m.channel], m.bound.lower());
                high_[m.channel] = std::max(high_[m.channel], m.bound.upper());
                longest_ = std::max(longest_, m.time - e.begin);
            }
        }
        for (auto const& p : estimate.places)
            if (p.kind == place_kind::sensor) suspected_.insert(p.name);
        constexpr std::string_view sensor = "sensor ";
        for (auto const& t : estimate.tried) {
            bool const sensors = std::all_of(t.names.begin(), t.names.end(), [&](auto const& name) {
                return name.starts_with(sensor);
            });
            if (t.inflation > 1 || !sensors) continue;
            for (auto const& name : t.names) suspected_.insert(name.substr(sensor.size()));
        }
        for (auto const& c : confined) suspected_.insert(c.channel);
    }

    [[nodiscard]] std::vector<effect> operator()() {
        std::vector<bool> measured;
        for (std::size_t y = 0; y < low_.size(); ++y) measured.push_back(low_[y] <= high_[y]);
        auto const places =
            places_of(problem_->model, measured, std::vector<bool>(about_->inputs.size(), false));
        std::set<std::size_t> channels;
        for (auto const& p : places) {
            if (p.is_sensor() && (suspected_.contains(p.name) || shows_suspected(p)))
                channels.insert(p.members.begin(), p.members.end());
        }
        for (auto const& p : places) {
            if (p.is_sensor() && std::any_of(p.members.begin(), p.members.end(),
                                             [&](auto y) { return channels.contains(y); }))
                add_faults(p);
        }
        return std::move(faults_);
    }

private:
    [[nodiscard]] bool shows_suspected(place const& p) const {
        return !p.askew && std::any_of(p.members.begin(), p.members.end(), [this](auto y) {
            return suspected_.contains(about_->channels[y].name);
        });
    }
    void add_faults(place const& p) {
        std::string names;
        double range = 0;
        for (auto const y : p.members) {
            names += (names.empty() ? "" : ":") + about_->channels[y].name;
            range = std::max(range, high_[y] - low_[y]);
        }
        auto const eighth = round_size(longest_ / 8);
        add("sensor_latency", names, eighth);
        add("sensor_lag", names, eighth);
        add("sensor_scale", names, "2.2"); // beyond a wrong sign
        add("sensor_bias", names, round_size(range));
        add("sensor_drift", names, round_size(range / longest_));
        if (p.members.size() == 1) add("sensor_saturation", names, round_size(range));
        if (!p.askew) return;
        add("sensor_rotation", names, "0.5");
        add("sensor_swap", names, "1.2"); // beyond interchanged plugs
        unit const angle("rad"), time(about_->time_unit);
        auto const rate = [&](std::string const& text, unit const& of) {
            return unit(text).times(time, 1).in(of).has_value();
        };
        bool const moving = rate(about_->channels[p.members[0]].unit, unit("m"));
        for (auto const& s : about_->states) {
            if (s.unit == "rad" && !moving)
                add("sensor_lever_arm", names + ":" + s.name, round_size(range / 2));
            if (rate(s.unit, angle) && moving)
                add("sensor_velocity_arm", names + ":" + s.name, round_size(range / reach_of(s)));
        }
    }
    /// How far a state was seen to go, else how far it may.
    [[nodiscard]] double reach_of(model_description::state const& s) const {
        for (std::size_t y = 0; y < about_->channels.size(); ++y) {
            auto const& shown = problem_->model.g[problem_->model.observe[y]];
            if (low_[y] < high_[y] && shown.op == operation::state &&
                about_->states[static_cast<std::size_t>(shown.index)].name == s.name)
                return high_[y] - low_[y];
        }
        return s.limit;
    }
    /// What cannot be said in a name, or what the model does not take, is left out.
    void add(std::string const& kind, std::string const& names, std::string const& size) {
        if (size.empty()) return;
        try {
            auto fault = sensor_fault(kind + "(" + names + ")~" + size, about_);
            (void)with(problem_->model, {fault});
            faults_.push_back(std::move(fault));
        } catch (std::invalid_argument const&) {
        }
    }

    identification_problem const* problem_;
    model_description const* about_;
    std::vector<double> low_, high_; ///< by channel, of what was measured
    double longest_ = 0;             ///< experiment [time]
    std::set<std::string> suspected_;
    std::vector<effect> faults_;
};

} // namespace diagnosis_detail

SIVID_DECL std::vector<effect> proposed_faults(identification_problem const& problem,
                                               place_estimate const& estimate,
                                               std::vector<confined_gap> const& confined) {
    return diagnosis_detail::fault_proposals(problem, estimate, confined)();
}

} // namespace sivid

#endif
