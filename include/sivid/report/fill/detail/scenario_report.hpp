// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_FILL_DETAIL_SCENARIO_REPORT_HPP
#define SIVID_REPORT_FILL_DETAIL_SCENARIO_REPORT_HPP

#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/enclosure/tube.hpp>
#include <sivid/io/explaining_motion.hpp>
#include <sivid/report/fill/plane_channels.hpp>
#include <sivid/report/identification_view.hpp>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

namespace detail {

/// What the page shows of one experiment: its measurements, the tube, the motion in the plane.
class scenario_filler {
public:
    scenario_filler(identification_problem const& problem, identification const& found,
                    explaining_motion const* motion, std::optional<plane_channels> names,
                    std::size_t experiment, std::function<bool()> keep_going = {})
        : problem_{problem},
          found_{found},
          motion_{motion},
          names_{std::move(names)},
          keep_going_{std::move(keep_going)},
          e_{experiment} {}

    [[nodiscard]] scenario_view view() const {
        experiment const& s = problem_.experiments[e_];
        record const samples = sorted(s.measurements);
        scenario_view out{
            .name = s.name, .measurements = samples.size(), .outlier_budget = s.outliers};
        auto const outputs = motion_ != nullptr ? motion_->outputs[e_] : std::vector<interval>{};
        std::vector<channel_series> all(about().channels.size());
        for (std::size_t c = 0; c < all.size(); ++c) {
            all[c].name = about().channels[c].name;
            all[c].unit = about().channels[c].unit;
            all[c].time_unit = about().time_unit;
        }
        for (std::size_t i = 0; i < samples.size(); ++i) {
            measured_sample m{.time = samples[i].time, .value = samples[i].bound};
            if (i < outputs.size()) {
                range const output = outputs[i];
                if (is_finite(output)) m.enclosure = output;
            }
            m.state = state_of(i);
            all[samples[i].channel].measured.push_back(m);
        }
        std::vector<std::size_t> measured;
        for (std::size_t c = 0; c < all.size(); ++c) {
            if (!all[c].measured.empty()) measured.push_back(c);
        }
        add_tube(all);
        auto const line = add_reference(all);
        if (names_) out.plane = plane(all, samples, line);
        for (std::size_t const c : measured) out.channels.push_back(std::move(all[c]));
        return out;
    }

private:
    [[nodiscard]] model_description const& about() const { return problem_.model.about; }

    [[nodiscard]] sample_state state_of(std::size_t i) const {
        for (forced_outlier const& f : found_.forced) {
            if (f.experiment == e_ && f.measurement == i) return sample_state::forced_outlier;
        }
        bool const violated = found_.witness && e_ < found_.witness->violated.size() &&
                              i < found_.witness->violated[e_].size() &&
                              found_.witness->violated[e_][i];
        return violated ? sample_state::suspect : sample_state::regular;
    }

    void add_tube(std::vector<channel_series>& all) const {
        if (motion_ == nullptr) return;
        auto const& tube = *motion_->tubes[e_];
        observer<interval> look(*motion_->flows[e_]);
        ensemble<interval> const family(motion_->starts[e_], motion_->parameters);
        look.set_ensemble(family);
        for (auto const& step : tube.steps()) {
            if (keep_going_ && !keep_going_()) return;
            auto const y = look.over(step.from, interval(step.from, step.to), step.swept);
            for (std::size_t c = 0; c < all.size(); ++c) {
                if (is_finite(range{y[c]})) all[c].tube.push_back({step.from, step.to, y[c]});
            }
        }
    }

    /// The non-validated line. @returns its times and channels
    [[nodiscard]] approximate_trajectory add_reference(std::vector<channel_series>& all) const {
        approximate_trajectory line;
        auto const point = reference_point();
        if (point == nullptr || motion_ == nullptr) return line;
        auto const& s = problem_.experiments[e_];
        double const end = s.end();
        std::vector<double> times;
        for (int k = 0; k <= 240; ++k) times.push_back(s.begin + (end - s.begin) * k / 240);
        auto const start = found_.witness ? found_.witness->starts[e_] : found_.guess->starts[e_];
        try {
            auto const& f = *motion_->flows[e_];
            line = simulate(std::make_shared<approximate_model const>(f.model()), f.inputs(), start,
                            *point, s.begin, times, {1e-9, keep_going_});
        } catch (std::exception const&) {
            return {}; // a missing line is no loss: nothing rests on it
        }
        for (std::size_t k = 0; k < line.outputs.size(); ++k) {
            for (std::size_t c = 0; c < all.size(); ++c) {
                all[c].reference.push_back({line.times[k], line.outputs[k][c]});
            }
        }
        return line;
    }
    [[nodiscard]] std::vector<double> const* reference_point() const {
        if (found_.witness) return &found_.witness->parameters;
        return found_.guess && !found_.guess->parameters.empty() ? &found_.guess->parameters
                                                                 : nullptr;
    }

    [[nodiscard]] std::optional<plane_series> plane(std::vector<channel_series> const& all,
                                                    record const& samples,
                                                    approximate_trajectory const& line) const {
        auto const channel = [&](std::string const& name) {
            auto const found = std::find_if(
                all.begin(), all.end(), [&](channel_series const& c) { return c.name == name; });
            return static_cast<std::size_t>(found - all.begin());
        };
        auto const x = channel(names_->x), y = channel(names_->y);
        if (x == all.size() || y == all.size()) return std::nullopt;
        plane_series out{.x_name = all[x].name, .y_name = all[y].name, .unit = all[x].unit};
        for (std::size_t k = 0; k < std::min(all[x].tube.size(), all[y].tube.size()); ++k) {
            out.tube.push_back({all[x].tube[k].value, all[y].tube[k].value});
        }
        for (std::size_t i = 0; i < samples.size(); ++i) {
            for (std::size_t k = i + 1; samples[i].channel == x && k < samples.size() &&
                                        samples[k].time == samples[i].time;
                 ++k) {
                if (samples[k].channel == y) {
                    out.measured.push_back({samples[i].bound, samples[k].bound});
                }
            }
        }
        auto const heading = channel(names_->heading);
        for (std::size_t k = 0; k < line.outputs.size(); ++k) {
            auto const& now = line.outputs[k];
            out.reference.push_back({now[x], now[y]});
            if (heading < all.size() && k % 30 == 15) {
                out.poses.push_back({now[x], now[y], now[heading]});
            }
        }
        bool const nothing = out.measured.empty() && out.tube.empty();
        return nothing ? std::nullopt : std::optional{std::move(out)};
    }

    identification_problem const& problem_;
    identification const& found_;
    explaining_motion const* motion_;
    std::optional<plane_channels> names_;
    std::function<bool()> keep_going_;
    std::size_t e_;
};

} // namespace detail

} // namespace sivid::report

#endif
