// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_DECLARED_VARIATION_HPP
#define SIVID_PAVING_RELATION_DETAIL_DECLARED_VARIATION_HPP

#include <sivid/model/graph/graph_range.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/paving/relation/channel_tube.hpp>
#include <sivid/paving/relation/detail/model_variation.hpp>
#include <sivid/paving/relation/input_range.hpp>
#include <sivid/paving/relation/state_samples.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid {

/// What an experiment lets one expect of the rates of the states.
struct rate_scales {
    std::vector<double> size;               ///< of each rate
    std::vector<double> change;             ///< of each rate from one gap to the next
    std::vector<std::vector<double>> slope; ///< \f$ \max |\partial f_i / \partial x_k| \f$
    std::vector<double> period;             ///< of the samples [s]
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
            double const limit = model.about.states[i].limit;
            auto const seen = data[i] ? data[i]->near(times[k]) : std::nullopt;
            at.states[i] = seen ? *seen : traits::bounds(-limit, limit);
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

/// Declares for each experiment how much each state's rate may vary within one sampling gap: by its
/// change as above, plus a tenth of its size in the experiment where that is greatest. A rate that
/// is a function of states only (a kinematic equation) varies by at most one and a half times what
/// the rates of those states bring about within a gap.
///   A first choice, of which `above_model` makes sure that the model does not contradict it.
///   An assumption, not a theorem: it belongs into the list of assumptions. Smooth motion meets it
///   with room to spare; an actuator that switches, or a gust, shows in the change over three gaps.
///   Not met by what comes and goes between two samples, such as the hard sticking of dry friction:
///   then declare more.
/// @param own  declared by the user for states by name; the rest gets the default
[[nodiscard]] inline std::vector<std::vector<rate_variation>>
declare_variations(bound_model const& model, std::vector<rate_scales> const& scales,
                   std::map<std::string, double> const& own) {
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
            if (law > 0 && std::isfinite(law)) { // two digits, upward, so that it reads well
                double const unit = std::pow(10.0, std::floor(std::log10(law)) - 1);
                law = std::ceil(law / unit) * unit;
            }
            auto const stated = own.find(model.about.states[i].name);
            if (stated != own.end()) law = stated->second;
            laws.push_back({s.period[i], std::min(law, 1e100)});
        }
    }
    return result;
}

/// Declared variations that neither the recorded inputs nor the model contradict: none is less than
/// what the model's own rate may vary by, for any parameter of the prior, over any stretch of the
/// period's length, along any motion of the model that meets the bounds, and along any in the tubes
/// that the declared variations leave. Infinite (1e100) where no such bound is found: the samples
/// are too far apart for the motion.
/// @param own    declared by the user: kept
/// @param go_on  asked now and then; once false, what is not declared by the user has no bound; may
///               be empty
/// @throws std::invalid_argument if the user's declaration is less than what the model's rate
///         varies by for every parameter of the prior
[[nodiscard]] inline std::vector<rate_variation>
above_model(bound_model const& model, box const& prior, experiment const& e,
            std::vector<std::optional<std::size_t>> const& channels,
            std::vector<rate_variation> laws, std::map<std::string, double> const& own,
            std::function<bool()> const& go_on = {}) {
    auto const n = model.state_count();
    std::vector<double> declared, periods;
    std::vector<bool> fixed;
    for (std::size_t i = 0; i < n; ++i) {
        declared.push_back(laws[i].variation);
        periods.push_back(laws[i].period);
        fixed.push_back(!channels[i] || own.count(model.about.states[i].name) > 0);
    }
    auto const open = [&] {
        for (std::size_t i = 0; i < n; ++i)
            if (!fixed[i]) laws[i].variation = 1e100;
        return laws;
    };
    if (go_on && !go_on()) return open();
    model_variation const by_model(model, prior, e, channels);
    auto const whole = by_model.of_model(periods);
    auto const shown = [](double v) { // two digits, upward, so that it reads well
        if (!(v > 0) || !std::isfinite(v)) return v;
        double const unit = std::pow(10.0, std::floor(std::log10(v)) - 1);
        return std::ceil(v / unit) * unit;
    };
    for (std::size_t i = 0; i < n; ++i) {
        if (!fixed[i] && declared[i] < whole[i]) declared[i] = shown(whole[i]);
    }
    constexpr int patience = 25; // then what still grows has no bound
    for (int pass = 0;; ++pass) {
        if (go_on && !go_on()) return open();
        auto const found = by_model.in_tubes(declared, periods);
        bool grew = false;
        for (std::size_t i = 0; i < n; ++i) {
            if (fixed[i]) {
                if (!channels[i] || !(found.least[i] > declared[i])) continue;
                throw std::invalid_argument(
                    "relations: the rate of " + model.about.states[i].name +
                    " is declared to vary by at most " + nearest_text(declared[i], 6) + " within " +
                    nearest_text(periods[i], 6) + " s, but in " + e.name + " the model varies by " +
                    nearest_text(found.least[i], 6) +
                    " or more, whatever the parameters of the prior: declare more");
            }
            if (found.most[i] <= declared[i]) continue;
            grew = true;
            declared[i] = pass < patience ? shown(1.02 * found.most[i]) : HUGE_VAL;
        }
        if (!grew) break;
    }
    for (std::size_t i = 0; i < n; ++i) laws[i].variation = std::min(declared[i], 1e100);
    return laws;
}

/// Declared variations of several experiments and their states: by the data, the user and the
/// model.
/// @throws std::invalid_argument  as above
[[nodiscard]] inline std::vector<std::vector<rate_variation>> laws_above_model(
    bound_model const& model, box const& prior, std::vector<experiment const*> const& experiments,
    std::vector<std::optional<std::size_t>> const& channels,
    std::map<std::string, double> const& own, std::function<bool()> const& go_on = {}) {
    std::vector<rate_scales> scales;
    for (auto const* e : experiments) {
        scales.push_back(find_rate_scales(model, prior, *e, channels));
    }
    auto result = declare_variations(model, scales, own);
    for (std::size_t e = 0; e < experiments.size(); ++e) {
        result[e] = above_model(model, prior, *experiments[e], channels, result[e], own, go_on);
    }
    return result;
}

} // namespace sivid

#endif
