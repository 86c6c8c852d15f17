// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_STATE_SAMPLES_HPP
#define SIVID_PAVING_RELATION_STATE_SAMPLES_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/model/sampling.hpp>
#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// For each state the first channel that shows it as it is (not a function of it) and was measured
/// in some experiment.
[[nodiscard]] inline std::vector<std::optional<std::size_t>>
measured_states(bound_model const& model, std::vector<experiment const*> const& experiments) {
    std::vector<std::optional<std::size_t>> result(model.state_count());
    for (std::size_t y = model.channel_count(); y-- > 0;) {
        auto const& n = model.g[model.observe[y]];
        if (n.op != operation::state) continue;
        bool const seen = std::any_of(experiments.begin(), experiments.end(), [y](auto const* e) {
            return std::any_of(e->measurements.begin(), e->measurements.end(),
                               [y](measurement const& m) { return m.channel == y; });
        });
        if (seen) result[static_cast<std::size_t>(n.index)] = y;
    }
    return result;
}

/// What bounds of one state an experiment gives, in the order of time.
struct state_samples {
    std::vector<double> times;
    std::vector<interval> bounds;

    /// The measurements of one channel. Several at the same time are intersected as far as they
    /// agree; the later one wins where they do not.
    [[nodiscard]] static state_samples sensed(experiment const& e, std::size_t channel) {
        return state_samples{}.with(e, channel);
    }
    /// The initial side of a state and the measurements of the channel that shows it.
    [[nodiscard]] static state_samples of(experiment const& e, std::size_t state,
                                          std::size_t channel) {
        return state_samples{{e.begin}, {e.initial[state]}}.with(e, channel);
    }

    /// The median of the gaps, longer by what stamps of such times are rounded by, so that equal
    /// gaps are one period each; 1 if there is none.
    [[nodiscard]] double period() const {
        std::vector<double> gaps;
        for (std::size_t k = 0; k + 1 < times.size(); ++k) gaps.push_back(times[k + 1] - times[k]);
        if (gaps.empty()) return 1;
        auto const middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
        std::nth_element(gaps.begin(), middle, gaps.end());
        double const latest = std::max(std::abs(times.front()), std::abs(times.back()));
        return *middle + 2 * std::numeric_limits<double>::epsilon() * latest;
    }
    /// How far apart samples mostly are: a period, or a quarter of the mean gap where that is
    /// longer, lest a few that are close together stand for all.
    [[nodiscard]] double spacing() const {
        if (times.size() < 2) return period();
        double const all = times.back() - times.front();
        return std::max(period(), all / static_cast<double>(4 * (times.size() - 1)));
    }
    /// See `sampling`, by `spacing`.
    [[nodiscard]] sampling seen() const {
        return {spacing(), times.empty() ? 0 : times.back() - times.front()};
    }
    /// Without those that have no bound on some side: of them no rate can be told.
    [[nodiscard]] state_samples bounded() const {
        state_samples result;
        for (std::size_t k = 0; k < times.size(); ++k) {
            if (!is_bounded(bounds[k])) continue;
            result.times.push_back(times[k]);
            result.bounds.push_back(bounds[k]);
        }
        return result;
    }
    /// Without a start of which far less is known than of the samples.
    [[nodiscard]] state_samples without_vague_start() const {
        if (times.size() < 2 || width(bounds[0]) <= 4 * width(bounds[1])) return *this;
        auto result = *this;
        result.times.erase(result.times.begin());
        result.bounds.erase(result.bounds.begin());
        return result;
    }
    /// What is known at some time in the gap that contains t, without any assumption; nothing
    /// outside the samples.
    [[nodiscard]] std::optional<interval> near(double t) const {
        auto const after = std::upper_bound(times.begin(), times.end(), t);
        if (after == times.begin() || after == times.end()) return std::nullopt;
        auto const k = static_cast<std::size_t>(after - times.begin());
        return hull(bounds[k - 1], bounds[k]);
    }

    /// The greatest secant over `reach` gaps (over all of them if there are fewer), errors
    /// included.
    [[nodiscard]] double greatest_secant(std::size_t reach) const {
        reach = std::min(reach, times.size() - 1);
        double result = 0;
        for (std::size_t k = 0; reach > 0 && k + reach < times.size(); ++k) {
            result = std::max(result, mag(secant(k, k + reach)));
        }
        return result;
    }
    /// By how much the secants before and after a sample differ, each over `reach` gaps: the
    /// greatest value that the bounds allow, and the greatest one that they prove.
    [[nodiscard]] std::pair<double, double> secant_change(std::size_t reach) const {
        std::pair<double, double> result{0, 0};
        for (std::size_t k = reach; reach > 0 && k + reach < times.size(); ++k) {
            auto const change = secant(k, k + reach) - secant(k - reach, k);
            result.first = std::max(result.first, mag(change));
            result.second = std::max(result.second, mig(change));
        }
        return result;
    }

private:
    [[nodiscard]] state_samples with(experiment const& e, std::size_t channel) && {
        for (auto const& m : sorted(e.measurements)) {
            if (m.channel != channel) continue;
            if (!times.empty() && m.time == times.back()) {
                bounds.back() = agreed(m.bound, bounds.back());
            } else {
                times.push_back(m.time);
                bounds.push_back(m.bound);
            }
        }
        return std::move(*this);
    }
    [[nodiscard]] interval secant(std::size_t a, std::size_t b) const {
        return (bounds[b] - bounds[a]) / (times[b] - times[a]);
    }
};

} // namespace sivid

#endif
