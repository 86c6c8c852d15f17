// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_DECLARED_VARIATION_HPP
#define SIVID_DIAGNOSIS_DECLARED_VARIATION_HPP

#include <sivid/diagnosis/channel_tube.hpp>
#include <sivid/diagnosis/graph_range.hpp>
#include <sivid/diagnosis/state_samples.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sivid {

/// The range of an input over times within one piece, its error included.
[[nodiscard]] inline interval input_over(signal const& s, double from, double to) {
    using traits = interval_traits<interval>;
    auto const time = traits::bounds(from, to);
    if (auto const* sampled = std::get_if<sampled_signal>(&s)) {
        auto const piece = sampled->piece(from);
        double const e =
            std::max(sampled->error_bound(piece, from), sampled->error_bound(piece, to));
        return traits::add(sampled->value<interval>(piece, time), traits::bounds(-e, e));
    }
    auto const& formula = std::get<analytic_signal>(s);
    graph_range range(formula.g, {formula.value});
    range.evaluate({time, {}, {}, {}});
    return range.undefined(formula.value) ? traits::entire() : range.value(formula.value);
}

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
///   Only a choice of scales, not a proof: the inputs are taken at the samples.
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
        data[i] = state_samples::of(e, i, *channels[i]).without_vague_start();
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
            at.inputs[u] = hull(input_over(e.inputs[u], times[k], times[k]),
                                input_over(e.inputs[u], times[k + 1], times[k + 1]));
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

} // namespace sivid

#endif
