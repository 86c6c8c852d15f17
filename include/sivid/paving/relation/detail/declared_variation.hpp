// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_DECLARED_VARIATION_HPP
#define SIVID_PAVING_RELATION_DETAIL_DECLARED_VARIATION_HPP

#include <sivid/model/graph/graph_range.hpp>
#include <sivid/paving/relation/channel_tube.hpp>
#include <sivid/paving/relation/detail/model_variation.hpp>
#include <sivid/paving/relation/input_range.hpp>
#include <sivid/paving/relation/state_samples.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace sivid {

/// What an experiment lets one expect of the rates of the states.
struct rate_scales {
    std::vector<double> size;               ///< of each rate
    std::vector<double> change;             ///< of each rate from one gap to the next
    std::vector<std::vector<double>> slope; ///< \f$ \max |\partial f_i / \partial x_k| \f$
    std::vector<double> period;             ///< of the samples [time]
};

/// Size: what the greatest secant over three gaps or the model over its prior allow, whichever is
/// less. Change: what the bounds allow over three gaps, at least one and a half times what they
/// prove over one (fast motion, of which three gaps say little); infinite where nothing was
/// measured.
///   Only a choice of scales, not a proof.
[[nodiscard]] inline rate_scales
find_rate_scales(bound_model const& model, box const& prior, experiment const& e,
                 std::vector<std::optional<std::size_t>> const& channels) {
    using traits = interval_traits<interval>;
    auto const n = model.state_count();
    rate_scales result{std::vector<double>(n, 0.0), std::vector<double>(n, HUGE_VAL),
                       std::vector<std::vector<double>>(n, std::vector<double>(n, 0.0)),
                       std::vector<double>(n, 1.0)};
    std::vector<std::optional<state_samples>> data(n);
    std::vector<double> times;
    for (std::size_t i = 0; i < n; ++i) {
        if (!channels[i]) continue;
        data[i] = state_samples::of(e, i, *channels[i]).bounded().without_vague_start();
        times.insert(times.end(), data[i]->times.begin(), data[i]->times.end());
        result.period[i] = data[i]->period();
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());

    auto nodes = model.rate;
    for (auto const& row : model.rate_dx) nodes.insert(nodes.end(), row.begin(), row.end());
    graph_range range(model.g, nodes);
    auto const greater = [&range](double& so_far, node_id i) {
        so_far = std::max(so_far, range.undefined(i) ? HUGE_VAL : mag(range.value(i)));
    };
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
        leaf_ranges at{traits::bounds(times[k], times[k + 1]), box(n), prior, box(e.inputs.size())};
        for (std::size_t i = 0; i < n; ++i) {
            auto const seen = data[i] ? data[i]->near(times[k]) : std::nullopt;
            at.states[i] = seen ? *seen : model.about.states[i].limit.range();
        }
        for (std::size_t u = 0; u < e.inputs.size(); ++u) {
            at.inputs[u] = input_across(e.inputs[u], times[k], times[k + 1]);
        }
        range.evaluate(at);
        for (std::size_t i = 0; i < n; ++i) {
            greater(result.size[i], model.rate[i]);
            for (std::size_t j = 0; j < n; ++j) greater(result.slope[i][j], model.rate_dx[i][j]);
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (!data[i]) continue;
        double const seen = data[i]->greatest_secant(3);
        result.size[i] = std::min(result.size[i], seen);
        result.change[i] =
            std::max(data[i]->secant_change(3).first, 1.5 * data[i]->secant_change(1).second);
        if (data[i]->times.size() < 8) result.change[i] = std::max(result.change[i], seen);
    }
    return result;
}

/// A bound that reads well. Itself where it is 0 or infinite.
[[nodiscard]] inline double two_digits_upward(double v) {
    if (!(v > 0) || !std::isfinite(v)) return v;
    double const unit = std::pow(10.0, std::floor(std::log10(v)) - 1);
    return std::ceil(v / unit) * unit;
}

/// Declares for each experiment how much each state's rate may vary within one sampling gap: by its
/// change as above, plus a tenth of its size in the experiment where that is greatest. A rate that
/// is a function of states only (a kinematic equation) varies by at most one and a half times what
/// the rates of those states bring about within a gap.
///   A first choice, of which `above_model` makes sure that the model does not contradict it.
///   An assumption, not a theorem: it belongs into the list of assumptions. Smooth motion meets it
///   with room to spare; an actuator that switches, or a gust, shows in the change over three gaps.
///   Not met by what comes and goes between two samples, such as the hard sticking of dry friction.
[[nodiscard]] inline std::vector<std::vector<rate_variation>>
declare_variations(bound_model const& model, std::vector<rate_scales> const& scales) {
    auto const n = model.state_count();
    std::vector<double> greatest(n, 0.0);
    for (auto const& s : scales) {
        for (std::size_t i = 0; i < n; ++i) greatest[i] = std::max(greatest[i], s.size[i]);
    }
    std::vector<std::vector<rate_variation>> result;
    for (auto const& s : scales) {
        auto& laws = result.emplace_back();
        for (std::size_t i = 0; i < n; ++i) {
            double law = s.change[i] + greatest[i] / 10;
            if ((model.g.depends(model.rate[i]) & ~on_state) == 0) {
                double turn = 0;
                for (std::size_t k = 0; k < n; ++k) {
                    if (s.slope[i][k] == 0) continue;
                    turn += s.slope[i][k] * (s.size[k] + greatest[k] / 4);
                }
                law = std::min(law, 1.5 * s.period[i] * turn);
            }
            laws.push_back({s.period[i], std::min(two_digits_upward(law), 1e100)});
        }
    }
    return result;
}

/// Declared variations that neither the recorded inputs nor the model contradict: none is less than
/// what the model's own rate may vary by, for any parameter of the prior, over any stretch of the
/// period's length, along any motion of the model that meets the bounds, and along any in the tubes
/// that the declared variations leave. Infinite (1e100) where no such bound is found: the samples
/// are too far apart for the motion.
/// @param go_on  asked now and then; once false, no measured state has a bound; may be empty
[[nodiscard]] inline std::vector<rate_variation>
above_model(bound_model const& model, box const& prior, experiment const& e,
            std::vector<std::optional<std::size_t>> const& channels,
            std::vector<rate_variation> laws, std::function<bool()> const& go_on = {}) {
    auto const n = model.state_count();
    std::vector<double> declared, periods;
    for (std::size_t i = 0; i < n; ++i) {
        declared.push_back(laws[i].variation);
        periods.push_back(laws[i].period);
    }
    auto const open = [&] {
        for (std::size_t i = 0; i < n; ++i)
            if (channels[i]) laws[i].variation = 1e100;
        return laws;
    };
    if (go_on && !go_on()) return open();
    model_variation const by_model(model, prior, e, channels);
    auto const whole = by_model.of_model(periods);
    for (std::size_t i = 0; i < n; ++i) {
        if (channels[i] && declared[i] < whole[i]) declared[i] = two_digits_upward(whole[i]);
    }
    constexpr int patience = 25; // then what still grows has no bound
    for (int pass = 0;; ++pass) {
        if (go_on && !go_on()) return open();
        auto const found = by_model.in_tubes(declared, periods);
        bool grew = false;
        for (std::size_t i = 0; i < n; ++i) {
            if (!channels[i] || found[i] <= declared[i]) continue;
            grew = true;
            declared[i] = pass < patience ? two_digits_upward(1.02 * found[i]) : HUGE_VAL;
        }
        if (!grew) break;
    }
    for (std::size_t i = 0; i < n; ++i) laws[i].variation = std::min(declared[i], 1e100);
    return laws;
}

/// Declared variations of several experiments and their states: by the data and the model.
[[nodiscard]] inline std::vector<std::vector<rate_variation>>
laws_above_model(bound_model const& model, box const& prior,
                 std::vector<experiment const*> const& experiments,
                 std::vector<std::optional<std::size_t>> const& channels,
                 std::function<bool()> const& go_on = {}) {
    std::vector<rate_scales> scales;
    for (auto const* e : experiments) {
        scales.push_back(find_rate_scales(model, prior, *e, channels));
    }
    auto result = declare_variations(model, scales);
    for (std::size_t e = 0; e < experiments.size(); ++e) {
        result[e] = above_model(model, prior, *experiments[e], channels, result[e], go_on);
    }
    return result;
}

} // namespace sivid

#endif
