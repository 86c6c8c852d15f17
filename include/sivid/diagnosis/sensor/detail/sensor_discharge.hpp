// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_SENSOR_DETAIL_SENSOR_DISCHARGE_HPP
#define SIVID_DIAGNOSIS_SENSOR_DETAIL_SENSOR_DISCHARGE_HPP

#include <sivid/diagnosis/sensor/detail/sensor_faults.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/relation/detail/broken_relation.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Proves of equations that they themselves are broken: that no fault of any one sensor of the row,
/// within the ranges, repairs the relation. A sensor's faults enter the equations as unknown
/// coefficients, all at once, its delay in slices. What a single sensor may do at all is first cut
/// to what the model's definitions (kinematic equations) allow, in which the other sensors are
/// right: an offset of a gyro, say, to what the heading bears.
/// @guarantee  see `operator()`
/// @cost  one examination of an equation (some milliseconds for a few hundred samples) for each
///        slice, and some tens of them for each sensor, which serve all equations
class sensor_discharge {
public:
    /// @param problem  outlives this object
    /// @param go_on    asked before each examination; may be empty
    explicit sensor_discharge(identification_problem const& problem,
                              sensor_fault_ranges const& ranges = {}, relation_options options = {},
                              std::function<bool()> go_on = {})
        : problem_(&problem),
          ranges_(ranges),
          options_(std::move(options)),
          go_on_(std::move(go_on)),
          base_(problem, options_) {
        options_.most_windows = std::min<std::size_t>(options_.most_windows, 3000);
        auto& windows = base_.windows();
        for (auto const& m : windows.motions()) laws_[m.name] = m.variation;
        for (std::size_t i = 0; i < base_.equations(); ++i) {
            if (!windows.obstacle(i).empty() || !windows.channels()[i]) continue;
            if (windows.row(i).kinematic) definitions_.push_back(i);
        }
    }

    /// @param f  proved to be broken together with its sensors, by `examine_relations`
    /// @returns nothing where some sensor may be what is wrong, where the definitions show that one
    ///          is, or where the time ended
    /// @guarantee  otherwise the equation does not hold if the assumptions that are listed do, and
    ///             lacks `missing` on the average over its window
    [[nodiscard]] std::optional<proved_place> operator()(relation_finding const& f) {
        auto& windows = base_.windows();
        if (!f.proved || f.definition || !windows.obstacle(f.equation).empty() ||
            !windows.channels()[f.equation] || !definitions_hold()) {
            return std::nullopt;
        }
        // Where something is missing if all sensors are right.
        std::vector<missing_rate> missing;
        auto places = f.windows;
        if (f.missing) places.insert(places.begin(), f.missing->window);
        for (auto const& at : places) {
            auto const found = base_.missing_over(f.equation, at);
            if (found && !contains(*found, 0)) {
                missing.push_back({at, *found, windows.rate_unit(f.equation)});
            }
        }
        auto const suspects = suspects_of(f);
        // The least delays of each first: most sensors that may be wrong show then.
        for (bool const first : {true, false}) {
            for (auto const& s : suspects) {
                auto const [delays, half] = delay_slices(*problem_, s, ranges_.most_slices);
                for (std::size_t k = first ? 0 : 1; k < (first ? 1 : delays.size()); ++k) {
                    if (!refuted(f.equation, s, delays[k], half, missing)) return std::nullopt;
                }
            }
        }
        proved_place result{f.assumptions, std::nullopt};
        add_assumptions(f, suspects, result);
        double clearest = 0;
        for (auto const& m : missing) {
            if (!is_bounded(m.value) || contains(m.value, 0)) continue;
            double const clear = std::abs(mid(m.value)) / (width(m.value) + 1e-300);
            if (!(clear > clearest)) continue;
            clearest = clear;
            result.missing = m;
        }
        return result;
    }

private:
    [[nodiscard]] bool stopped() const { return go_on_ && !go_on_(); }

    /// Whether the sensors do not contradict each other already.
    [[nodiscard]] bool definitions_hold() {
        if (!definitions_hold_) {
            definitions_hold_ = std::none_of(definitions_.begin(), definitions_.end(), [&](auto i) {
                // Between the sensors, and with the initial states, too.
                faulty_channel const none{i,
                                          *base_.windows().channels()[i],
                                          interval(0.0),
                                          interval(0.0),
                                          interval(0.0),
                                          {},
                                          0};
                return stopped() || base_.examine(i).proved || impossible(none, 0, 0);
            });
        }
        return *definitions_hold_;
    }
    [[nodiscard]] std::vector<faulty_channel> suspects_of(relation_finding const& f) {
        auto const& channels = base_.windows().channels();
        std::vector<faulty_channel> result;
        for (std::size_t s = 0; s < channels.size(); ++s) {
            if (!channels[s]) continue;
            auto const& name = problem_->model.about.channels[*channels[s]].name;
            if (std::find(f.channels.begin(), f.channels.end(), name) == f.channels.end()) continue;
            result.push_back(faults_of(*problem_, channels, s, ranges_));
        }
        return result;
    }
    /// Whether a definition excludes all faults in some ranges.
    [[nodiscard]] bool impossible(faulty_channel const& s, double delay, double half) const {
        auto const faulty = suspect_of(*problem_, s, laws_, delay, half);
        if (faulty.problem.experiments.empty()) return false;
        relation_examiner examiner(faulty.problem, options_, &faulty.sensor);
        return std::any_of(definitions_.begin(), definitions_.end(),
                           [&](auto i) { return examiner.examine(i).proved; });
    }
    /// Cuts off what no fault in the ranges can be, half of a side at a time. Nothing where none is
    /// possible; ended early, the ranges are what is known by then.
    [[nodiscard]] std::optional<faulty_channel> possible(faulty_channel s, double delay,
                                                         double half) {
        std::pair<std::size_t, double> const key{s.state, delay};
        if (auto const known = cut_.find(key); known != cut_.end()) return known->second;
        if (stopped()) return s;
        if (impossible(s, delay, half)) return cut_[key] = std::nullopt;
        constexpr int halvings = 6;
        for (std::size_t k = 0; k < s.size(); ++k) {
            for (bool const above : {true, false}) {
                for (int n = 0; n < halvings; ++n) {
                    if (stopped()) return s;
                    auto const whole = s.range(k);
                    double const end = above ? whole.upper() : whole.lower();
                    if (!(above ? end > 0 : end < 0)) break;
                    auto part = s;
                    part.range(k) = above ? interval(end / 2, end) : interval(end, end / 2);
                    if (!impossible(part, delay, half)) break;
                    s.range(k) =
                        above ? interval(whole.lower(), end / 2) : interval(end / 2, whole.upper());
                }
            }
        }
        return cut_[key] = s;
    }
    /// @param missing  becomes wide enough for these faults
    [[nodiscard]] bool refuted(std::size_t equation, faulty_channel const& s, double delay,
                               double half, std::vector<missing_rate>& missing) {
        auto const left = possible(s, delay, half);
        if (!left) return true;
        if (stopped()) return false;
        auto const faulty = suspect_of(*problem_, *left, laws_, delay, half);
        if (faulty.problem.experiments.empty()) return false;
        relation_examiner examiner(faulty.problem, options_, &faulty.sensor);
        if (!examiner.examine(equation).proved) return false;
        for (auto& m : missing) {
            auto const found = examiner.missing_over(equation, m.window);
            m.value = found ? hull(m.value, *found) : interval_traits<interval>::entire();
        }
        return true;
    }
    void add_assumptions(relation_finding const& f, std::vector<faulty_channel> const& suspects,
                         proved_place& result) {
        auto const add = [&result](std::string const& text) {
            auto& all = result.assumptions;
            if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(text);
        };
        auto& windows = base_.windows();
        std::map<std::size_t, double> since;
        for (auto const& m : windows.motions()) since.emplace(since.size(), m.begin);
        relation_finding all;
        windows.describe(f.equation, window_way::direct, since, all);
        std::string names;
        for (auto const i : definitions_) {
            windows.describe(i, window_way::direct, since, all);
            names += (names.empty() ? "" : ", ") + problem_->model.about.states[i].name;
        }
        for (auto const& a : all.assumptions) add(a);
        if (!names.empty()) add("the definitions of " + names + " hold");
        add(fault_assumption(*problem_, suspects));
    }

    identification_problem const* problem_;
    sensor_fault_ranges ranges_;
    relation_options options_;
    std::function<bool()> go_on_;
    relation_examiner base_;
    std::map<std::string, std::vector<rate_variation>> laws_;
    std::vector<std::size_t> definitions_;
    std::optional<bool> definitions_hold_;
    /// What faults of (state, delay) are possible.
    std::map<std::pair<std::size_t, double>, std::optional<faulty_channel>> cut_;
};

} // namespace sivid

#endif
