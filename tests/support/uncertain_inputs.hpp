// SPDX-License-Identifier: MIT
// True inputs within the error bounds of recorded ones: switching between the bounds, telegraphs,
// oscillations; and the states they cause.
#ifndef SIVID_TESTS_SUPPORT_UNCERTAIN_INPUTS_HPP
#define SIVID_TESTS_SUPPORT_UNCERTAIN_INPUTS_HPP

#include "support/random.hpp"
#include "support/reference.hpp"

#include <sivid/measurement/signal.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace support {

/// The same samples with error bounds.
inline sivid::sampled_signal with_errors(sivid::sampled_signal const& s, std::vector<double> e) {
    return {s.times(), s.values(), s.kind(), std::move(e)};
}

/// u(t) + e(t) sigma(t), one sigma in [-1, 1] per input: a held signal times, if it has a
/// frequency, a sine.
struct admissible_inputs {
    std::vector<sivid::sampled_signal> sigma;
    std::vector<extended> frequency;
    std::vector<extended> phase;
};

/// Constant sigmas.
inline admissible_inputs constant_share(std::size_t inputs, double share) {
    return {std::vector(inputs, sivid::sampled_signal({0}, {share}, sivid::interpolation::hold)),
            std::vector<extended>(inputs, 0), std::vector<extended>(inputs, 0)};
}
/// sigma k in the j-th of the equal parts of [0, end].
inline admissible_inputs switching(std::vector<std::vector<double>> const& sigma, double end) {
    auto result = constant_share(sigma.size(), 0);
    for (std::size_t k = 0; k < sigma.size(); ++k) {
        std::vector<double> times;
        for (std::size_t j = 0; j < sigma[k].size(); ++j) {
            times.push_back(end * static_cast<double>(j) / static_cast<double>(sigma[k].size()));
        }
        result.sigma[k] = {times, sigma[k], sivid::interpolation::hold};
    }
    return result;
}
/// A constant, a telegraph, or a sine for each input.
inline admissible_inputs draw_inputs(draws& d, std::size_t inputs, double end) {
    auto result = constant_share(inputs, 1);
    for (std::size_t k = 0; k < inputs; ++k) {
        std::vector<double> times{0}, values{d.coin() ? 1.0 : -1.0};
        auto const kind = d.below(4);
        while (kind == 1 && times.size() < 40) {
            double const next = times.back() - end / 8 * std::log(d.uniform(1e-3, 1));
            if (!(next > times.back() && next < end)) break;
            times.push_back(next);
            values.push_back(-values.back());
        }
        while (kind == 2 && times.size() < 12) { // any values
            times.push_back(times.back() + end / 12);
            values.push_back(d.uniform(-1, 1));
        }
        if (kind == 3) {
            result.frequency[k] = d.uniform(0.5, 12) / end * 6.3;
            result.phase[k] = d.uniform(0, 6.3);
        }
        result.sigma[k] = {times, values, sivid::interpolation::hold};
    }
    return result;
}

/// States at the `times` under one true input.
/// @param inputs  as recorded, with their error bounds
inline std::vector<extended_state>
states_under(extended_rate const& rate, extended_state x, extended_state const& p,
             std::vector<double> const& times, std::vector<sivid::sampled_signal> const& inputs,
             admissible_inputs const& chosen, extended tolerance = 1e-17L) {
    auto const m = inputs.size();
    std::vector<sivid::sampled_signal> all;
    for (auto const& u : inputs) all.push_back(u.nominal());
    for (auto const& u : inputs) {
        auto const zero = std::vector<double>(u.times().size(), 0.0);
        all.push_back({u.times(), u.exact() ? zero : u.errors(), u.kind()});
    }
    for (auto const& s : chosen.sigma) all.push_back(s);
    auto const perturbed = [&](extended t, extended_state const& state, extended_state const& q,
                               extended_state const& parts) {
        extended_state u;
        for (std::size_t k = 0; k < m; ++k) {
            extended sigma = parts[2 * m + k];
            if (chosen.frequency[k] != 0) {
                sigma *= std::sin(chosen.frequency[k] * t + chosen.phase[k]);
            }
            u.push_back(parts[k] + parts[m + k] * sigma);
        }
        return rate(t, state, q, u);
    };
    return reference_states(perturbed, std::move(x), p, 0, times, all, tolerance);
}

/// Bang-bang inputs that push state i at `end` upward (or downward) about as far as possible: the
/// signs of what each of `parts` equal parts does alone.
inline admissible_inputs worst_inputs(extended_rate const& rate, extended_state const& x,
                                      extended_state const& p, double end,
                                      std::vector<sivid::sampled_signal> const& inputs,
                                      std::size_t i, bool upward, std::size_t parts = 12) {
    auto const m = inputs.size();
    std::vector<std::vector<double>> sigma(m, std::vector<double>(parts, 0.0));
    auto const at_end = [&](std::vector<std::vector<double>> const& s) {
        return states_under(rate, x, p, {end}, inputs, switching(s, end), 1e-9L)[0][i];
    };
    auto const none = at_end(sigma);
    auto worst = sigma;
    for (std::size_t k = 0; k < m; ++k) {
        for (std::size_t j = 0; j < parts; ++j) {
            auto one = sigma;
            one[k][j] = 1;
            worst[k][j] = (at_end(one) >= none) == upward ? 1 : -1;
        }
    }
    return switching(worst, end);
}

} // namespace support

#endif
