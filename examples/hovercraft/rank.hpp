// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_RANK_HPP
#define HOVERCRAFT_RANK_HPP

#include "model.hpp"

#include <sivid/enclosure/expansion.hpp>
#include <sivid/enclosure/flow.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/number/decimal.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

/// Table 2.2 of the report with proof: how much can each constant, moved through its prior, change
/// each state equation?
///   \f$ e_{ic} = w_c \max |\partial f_i / \partial c| \f$ over all states and inputs in stated
///   ranges and all constants in their priors, w_c the width of the prior of c.
namespace hovercraft_example {

/// The effect of one constant on one state equation, within proved bounds.
struct partial_effect {
    std::string constant;
    std::string unit;      ///< of the equation's left side
    sivid::interval prior; ///< of the constant
    /// Contains the exact effect; exactly [0, 0] when the constant does not occur in the equation.
    sivid::interval effect;
    bool occurs = false;
};

struct ranked_equation {
    std::string state, unit;
    std::vector<partial_effect> effects; ///< strongest upper bound first
};

/// What the effects are bounded over.
struct ranking_ranges {
    std::vector<sivid::interval> states;
    double thrust_speed = 83.333333;                                    ///< W [1/s]
    sivid::interval rudder = sivid::hull(sivid::interval(0.0), 0.5236); ///< delta [rad]
};

/// Ranges around what scenario 3 visits over the priors of S_v, S_g and L (simulated, then
/// widened).
[[nodiscard]] inline ranking_ranges default_ranges() {
    return {.states = {{-3, 3}, {-2, 4}, {-3, 1}, {-1, 9}, {-1, 5}, {-6, 1}}};
}

/// The prior of a constant for the ranking: the report's for S_v, S_g and L, else 10 % about the
/// nominal value; D11 in [0, 0.1].
[[nodiscard]] inline sivid::interval ranking_prior(sivid::model_description::constant const& c) {
    using namespace sivid::literals;
    using sivid::enclose;
    if (c.name == "Sv") return hull(enclose(0.20_dec), enclose(0.25_dec));
    if (c.name == "Sg") return hull(enclose(0.0042_dec), enclose(0.0754_dec));
    if (c.name == "L") return hull(enclose(0.25_dec), enclose(0.35_dec));
    if (c.name == "D11") return hull(sivid::interval(0.0), enclose(0.1_dec));
    return c.nominal.enclosure * hull(enclose(0.9_dec), enclose(1.1_dec));
}

/// Bounds |d f_i / d c| over boxes: from above by interval evaluation on a grid of parts, from
/// below by evaluation at points (corners and random ones).
class effect_bounds {
public:
    effect_bounds(sivid::recorded_model const& model, ranking_ranges const& ranges)
        : ranges_{ranges}, flow_{make_flow(model, ranges)}, series_{flow_.rate_jacobian(), 0} {
        for (auto const& c : model.about.constants) priors_.push_back(ranking_prior(c));
    }

    [[nodiscard]] std::vector<ranked_equation> operator()(std::size_t parts = 120,
                                                          std::size_t points = 4000) {
        auto const n = flow_.states(), m = flow_.parameters();
        std::vector<double> high(n * m, 0.0), low(n * m, 0.0);
        bound_from_above(high, parts);
        bound_from_below(low, points);
        std::vector<ranked_equation> result;
        auto const& about = flow_.model().about;
        for (std::size_t i = 0; i < n; ++i) {
            ranked_equation equation{
                about.states[i].name,
                sivid::unit(about.states[i].unit).times(sivid::unit("s"), -1).text(),
                {}};
            for (std::size_t c = 0; c < m; ++c) {
                using traits = sivid::interval_traits<sivid::interval>;
                auto const width = traits::sub(traits::point(priors_[c].upper()),
                                               traits::point(priors_[c].lower()));
                auto const slope = traits::bounds(low[i * m + c], high[i * m + c]);
                equation.effects.push_back({about.constants[c].name, equation.unit, priors_[c],
                                            traits::mul(width, slope), high[i * m + c] > 0});
            }
            std::stable_sort(equation.effects.begin(), equation.effects.end(),
                             [](partial_effect const& a, partial_effect const& b) {
                                 return a.effect.upper() > b.effect.upper();
                             });
            result.push_back(std::move(equation));
        }
        return result;
    }

private:
    // The rudder angle is put in as the time, so that it can range over an interval.
    static sivid::flow make_flow(sivid::recorded_model const& model, ranking_ranges const& ranges) {
        sivid::parameter_choice all;
        for (auto const& c : model.about.constants) all.unknown.push_back(c.name);
        sivid::sampled_signal const speed({0}, {ranges.thrust_speed}, sivid::interpolation::hold);
        auto const rudder = sivid::analytic_signal::from([](auto const& t) { return t; });
        return sivid::flow(model, all, {speed, rudder});
    }

    /// Calls back with the row, the constant and the partial derivative over a box.
    template <class Use>
    void evaluate(std::vector<sivid::interval> const& x, sivid::interval const& rudder,
                  Use const& use) {
        sivid::input_pieces<sivid::interval> const inputs(flow_, 0, rudder);
        series_.start(rudder);
        series_.advance(
            0, [&x](std::size_t i, std::size_t) { return x[i]; }, inputs);
        auto const n = flow_.states();
        for (auto const& e : flow_.entries()) {
            if (e.column >= n) use(e.row, e.column - n, series_.output(e.output, 0));
        }
    }

    void bound_from_above(std::vector<double>& high, std::size_t parts) {
        series_.set_parameters(sivid::box(priors_));
        auto const part = [parts](sivid::interval const& whole, std::size_t k) {
            auto const share = [&](std::size_t i) {
                if (i == 0) return whole.lower();
                if (i == parts) return whole.upper();
                return whole.lower() + (whole.upper() - whole.lower()) *
                                           (static_cast<double>(i) / static_cast<double>(parts));
            };
            return sivid::interval(share(k), share(k + 1));
        };
        auto x = ranges_.states;
        for (std::size_t a = 0; a < parts; ++a) {
            x[0] = part(ranges_.states[0], a);
            for (std::size_t b = 0; b < parts; ++b) {
                x[1] = part(ranges_.states[1], b);
                evaluate(x, ranges_.rudder,
                         [&](std::size_t i, std::size_t c, sivid::interval const& d) {
                             auto& value = high[i * priors_.size() + c];
                             value = std::max(value, mag(d));
                         });
            }
        }
    }

    void bound_from_below(std::vector<double>& low, std::size_t points) {
        std::mt19937_64 random(1);
        // Ends of ranges are likely extremes; other points in between.
        auto const pick = [&random](sivid::interval const& range) {
            auto const r = random();
            if (r % 8 < 3) return range.lower();
            if (r % 8 < 6) return range.upper();
            double const s = static_cast<double>(r >> 11) * 0x1p-53;
            return std::clamp(range.lower() + s * (range.upper() - range.lower()), range.lower(),
                              range.upper());
        };
        for (std::size_t k = 0; k < points; ++k) {
            sivid::box constants(priors_.size());
            for (std::size_t c = 0; c < priors_.size(); ++c)
                constants[c] = sivid::interval(pick(priors_[c]));
            series_.set_parameters(constants);
            std::vector<sivid::interval> x;
            // Friction acts most sharply near rest: every other point has small speeds.
            double const scale =
                k % 2 == 0 ? 1.0 : std::ldexp(1.0, -static_cast<int>(random() % 10));
            for (auto const& range : ranges_.states)
                x.emplace_back(contains(range, 0.0) ? scale * pick(range) : pick(range));
            evaluate(x, sivid::interval(pick(ranges_.rudder)),
                     [&](std::size_t i, std::size_t c, sivid::interval const& d) {
                         auto& value = low[i * priors_.size() + c];
                         value = std::max(value, mig(d));
                     });
        }
    }

    ranking_ranges ranges_;
    sivid::flow flow_;
    sivid::series<sivid::interval> series_;
    std::vector<sivid::interval> priors_;
};

/// The ranking of all constants for every state equation.
/// @guarantee  each effect lies in its interval; a constant whose effect is [0, 0] and which does
///             not `occur` is absent from the equation
[[nodiscard]] inline std::vector<ranked_equation>
rank_constants(sivid::recorded_model const& model,
               ranking_ranges const& ranges = default_ranges()) {
    return effect_bounds(model, ranges)();
}

} // namespace hovercraft_example

#endif
