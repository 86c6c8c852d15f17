// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_OBSERVED_MOTION_HPP
#define SIVID_DIAGNOSIS_OBSERVED_MOTION_HPP

#include <sivid/diagnosis/channel_tube.hpp>
#include <sivid/diagnosis/window_integrals.hpp>
#include <sivid/paving/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// What is assumed of the motion between the samples.
struct motion_options {
    /// Declared bounds on how much the rate of a state varies from one sample to the next, by the
    /// state's name, in its unit per s; states that are not named get the default below.
    std::map<std::string, double> rate_variation;
    std::size_t cells_per_gap = 4; ///< cells of the grid between two samples
};

/// For each state the first channel that shows it as it is.
[[nodiscard]] inline std::vector<std::optional<std::size_t>>
direct_channels(bound_model const& model) {
    std::vector<std::optional<std::size_t>> result(model.state_count());
    for (std::size_t y = model.channel_count(); y-- > 0;) {
        auto const& n = model.g[model.observe[y]];
        if (n.op == operation::state) result[static_cast<std::size_t>(n.index)] = y;
    }
    return result;
}

namespace diagnosis_detail {

struct samples {
    std::vector<double> times;
    std::vector<interval> bounds;

    [[nodiscard]] double period() const {
        std::vector<double> gaps;
        for (std::size_t k = 0; k + 1 < times.size(); ++k) gaps.push_back(times[k + 1] - times[k]);
        if (gaps.empty()) return 1;
        auto const middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
        std::nth_element(gaps.begin(), middle, gaps.end());
        return *middle;
    }
    /// Drops a start of which far less is known than of the samples.
    void drop_vague_start() {
        if (times.size() < 2 || width(bounds[0]) <= 4 * width(bounds[1])) return;
        times.erase(times.begin());
        bounds.erase(bounds.begin());
    }
};

/// The initial side and the measurements of one channel. Where both stand at the same time they are
/// intersected, if they agree.
inline samples samples_of(experiment const& e, std::size_t state, std::size_t channel) {
    samples result;
    result.times.push_back(e.begin);
    result.bounds.push_back(e.initial[state]);
    for (auto const& m : sorted(e.measurements)) {
        if (m.channel != channel) continue;
        if (m.time == result.times.back()) {
            auto const both = intersect(m.bound, result.bounds.back());
            result.bounds.back() = sivid::is_empty(both) ? m.bound : both;
        } else {
            result.times.push_back(m.time);
            result.bounds.push_back(m.bound);
        }
    }
    return result;
}

/// The greatest secant over three gaps (over all of them if there are fewer), errors included.
inline double greatest_secant(samples const& s) {
    std::size_t const reach = std::min<std::size_t>(3, s.times.size() - 1);
    double result = 0;
    for (std::size_t k = 0; reach > 0 && k + reach < s.times.size(); ++k) {
        double const rise = std::max(std::abs(s.bounds[k + reach].upper() - s.bounds[k].lower()),
                                     std::abs(s.bounds[k].upper() - s.bounds[k + reach].lower()));
        result = std::max(result, rise / (s.times[k + reach] - s.times[k]));
    }
    return result;
}

/// Two digits, upward: a declared bound should read well.
inline double two_digits(double x) {
    if (!(x > 0) || !std::isfinite(x)) return x;
    double const unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
    return std::ceil(x / unit) * unit;
}

/// The range of an input over times within one piece.
inline interval input_over(signal const& s, double from, double to) {
    using traits = interval_traits<interval>;
    auto const time = traits::bounds(from, to);
    if (auto const* sampled = std::get_if<sampled_signal>(&s)) {
        return sampled->value<interval>(sampled->piece(from), time);
    }
    auto const& formula = std::get<analytic_signal>(s);
    graph_range range(formula.g, {formula.value});
    range.evaluate({time, {}, {}, {}});
    return range.undefined(formula.value) ? traits::entire() : range.value(formula.value);
}

} // namespace diagnosis_detail

/// What one experiment says about the states at all times: tubes of the states that a channel shows
/// directly, cells on a grid that contains all samples and knots, and the declared variations.
struct observed_motion {
    std::string name;
    std::vector<std::optional<channel_tube>> tubes; ///< one per state; none where unobserved
    std::vector<rate_variation> variation;          ///< declared; of observed states
    std::vector<double> boundaries;
    std::vector<time_cell> cells;

    [[nodiscard]] std::size_t boundary_at(double t) const {
        return static_cast<std::size_t>(std::lower_bound(boundaries.begin(), boundaries.end(), t) -
                                        boundaries.begin());
    }
};

/// Declares how much each observed state's rate may vary within one sampling gap, in each
/// experiment: as much as the rate's own size there, R, and a quarter of its size in the experiment
/// where it is greatest. R is what the greatest secant over three gaps or the model over its prior
/// allow, whichever is less. A rate that is a function of states only (a kinematic equation) varies
/// by at most one and a half times what the rates of those states bring about within a gap.
///   An assumption, not a theorem: it stands in the list of assumptions. It is met by whatever does
/// not switch more than the whole acceleration on or off between two samples.
[[nodiscard]] inline std::vector<std::vector<rate_variation>>
declare_variations(bound_model const& model, box const& prior,
                   std::vector<experiment const*> const& experiments,
                   motion_options const& options) {
    using traits = interval_traits<interval>;
    auto const channels = direct_channels(model);
    auto const n = model.state_count();
    graph_range rates(model.g, model.rate);
    std::vector<node_id> all;
    for (auto const& row : model.rate_dx) all.insert(all.end(), row.begin(), row.end());
    graph_range slopes(model.g, all);
    std::vector<std::vector<double>> size(experiments.size(), std::vector<double>(n, HUGE_VAL));
    std::vector<std::vector<std::vector<double>>> slope(
        experiments.size(), std::vector<std::vector<double>>(n, std::vector<double>(n, 0.0)));
    std::vector<std::vector<double>> period(experiments.size(), std::vector<double>(n, 1.0));
    std::vector<double> greatest(n, 0.0);
    for (std::size_t e = 0; e < experiments.size(); ++e) {
        std::vector<diagnosis_detail::samples> data(n);
        std::vector<double> times;
        double last = experiments[e]->begin;
        for (auto const& m : experiments[e]->measurements) last = std::max(last, m.time);
        for (std::size_t i = 0; i < n; ++i) {
            if (!channels[i]) continue;
            data[i] = diagnosis_detail::samples_of(*experiments[e], i, *channels[i]);
            data[i].drop_vague_start();
            times.insert(times.end(), data[i].times.begin(), data[i].times.end());
            period[e][i] = data[i].period();
        }
        std::sort(times.begin(), times.end());
        times.erase(std::unique(times.begin(), times.end()), times.end());
        std::vector<double> by_model(n, 0.0);
        for (std::size_t k = 0; k + 1 < times.size(); ++k) {
            leaf_ranges at{traits::bounds(times[k], times[k + 1]), box(n), prior, {}};
            for (std::size_t i = 0; i < n; ++i) {
                double const limit = model.about.states[i].limit;
                at.states[i] = traits::bounds(-limit, limit);
                auto const& s = data[i];
                auto const after = std::upper_bound(s.times.begin(), s.times.end(), times[k]);
                if (after == s.times.begin() || after == s.times.end()) continue;
                auto const j = static_cast<std::size_t>(after - s.times.begin());
                at.states[i] = hull(s.bounds[j - 1], s.bounds[j]);
            }
            std::vector<interval> inputs;
            for (auto const& u : experiments[e]->inputs) {
                inputs.push_back(hull(diagnosis_detail::input_over(u, times[k], times[k]),
                                      diagnosis_detail::input_over(u, times[k + 1], times[k + 1])));
            }
            at.inputs = box(std::move(inputs));
            rates.evaluate(at);
            slopes.evaluate(at);
            for (std::size_t i = 0; i < n; ++i) {
                auto const& f = rates.value(model.rate[i]);
                by_model[i] =
                    std::max(by_model[i], rates.undefined(model.rate[i]) ? HUGE_VAL : mag(f));
                for (std::size_t k2 = 0; k2 < n; ++k2) {
                    auto const d = model.rate_dx[i][k2];
                    slope[e][i][k2] = std::max(
                        slope[e][i][k2], slopes.undefined(d) ? HUGE_VAL : mag(slopes.value(d)));
                }
            }
        }
        for (std::size_t i = 0; i < n; ++i) {
            double const seen = channels[i] ? diagnosis_detail::greatest_secant(data[i]) : HUGE_VAL;
            size[e][i] = std::min(seen, by_model[i]);
            greatest[i] = std::max(greatest[i], size[e][i]);
        }
    }
    std::vector<std::vector<rate_variation>> result(experiments.size(),
                                                    std::vector<rate_variation>(n));
    for (std::size_t e = 0; e < experiments.size(); ++e) {
        for (std::size_t i = 0; i < n; ++i) {
            double law = size[e][i] + greatest[i] / 4;
            if ((model.g.depends(model.rate[i]) & ~on_state) == 0) {
                double change = 0;
                for (std::size_t k = 0; k < n; ++k) {
                    if (slope[e][i][k] == 0) continue;
                    change += slope[e][i][k] * (size[e][k] + greatest[k] / 4);
                }
                law = std::min(law, 1.5 * period[e][i] * change);
            }
            auto const own = options.rate_variation.find(model.about.states[i].name);
            if (own != options.rate_variation.end()) law = own->second;
            law = own != options.rate_variation.end() ? law : diagnosis_detail::two_digits(law);
            result[e][i] = {period[e][i], std::isfinite(law) ? law : 1e300};
        }
    }
    return result;
}

/// The tubes and cells of one experiment under declared variations.
/// @param states  those whose tubes the cells carry; the grid ends where one of them ends
[[nodiscard]] inline observed_motion observe_motion(bound_model const& model, box const& prior,
                                                    experiment const& e,
                                                    std::vector<rate_variation> const& variation,
                                                    std::size_t cells_per_gap) {
    using traits = interval_traits<interval>;
    auto const channels = direct_channels(model);
    auto const n = model.state_count();
    observed_motion result;
    result.name = e.name;
    result.variation = variation;
    result.tubes.resize(n);
    double period = HUGE_VAL;
    double end = e.begin;
    for (std::size_t i = 0; i < n; ++i) {
        if (!channels[i]) continue;
        auto const s = diagnosis_detail::samples_of(e, i, *channels[i]);
        result.tubes[i].emplace(s.times, s.bounds, variation[i]);
        result.boundaries.insert(result.boundaries.end(), s.times.begin(), s.times.end());
        if (s.times.size() > 1) period = std::min(period, s.period());
        end = std::max(end, s.times.back());
    }
    if (!(end > e.begin)) return result;
    for (auto const& input : e.inputs) {
        auto const* sampled = std::get_if<sampled_signal>(&input);
        if (sampled == nullptr) continue;
        for (double const t : sampled->times()) {
            if (t > e.begin && t < end) result.boundaries.push_back(t);
        }
    }
    auto& grid = result.boundaries;
    std::sort(grid.begin(), grid.end());
    grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
    std::vector<double> finer;
    for (std::size_t k = 0; k + 1 < grid.size(); ++k) {
        double const gap = grid[k + 1] - grid[k];
        auto const pieces = static_cast<std::size_t>(std::clamp(
            std::ceil(gap / period * static_cast<double>(cells_per_gap) - 1e-6), 1.0, 1e3));
        for (std::size_t p = 0; p < pieces; ++p) {
            double const t = grid[k] + gap * static_cast<double>(p) / static_cast<double>(pieces);
            if (finer.empty() || finer.back() < t) finer.push_back(t);
        }
    }
    finer.push_back(grid.back());
    grid = std::move(finer);
    for (std::size_t c = 0; c + 1 < grid.size(); ++c) {
        time_cell cell{grid[c], grid[c + 1], {}};
        cell.at.time = traits::bounds(cell.from, cell.to);
        cell.at.states = box(n);
        for (std::size_t i = 0; i < n; ++i) {
            bool const known = result.tubes[i] && result.tubes[i]->covers(cell.from, cell.to);
            cell.at.states[i] =
                known ? result.tubes[i]->over(cell.from, cell.to) : traits::entire();
        }
        cell.at.constants = prior;
        std::vector<interval> inputs;
        for (auto const& u : e.inputs) {
            inputs.push_back(diagnosis_detail::input_over(u, cell.from, cell.to));
        }
        cell.at.inputs = box(std::move(inputs));
        result.cells.push_back(std::move(cell));
    }
    return result;
}

} // namespace sivid

#endif
