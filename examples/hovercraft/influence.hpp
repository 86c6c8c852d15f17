// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_INFLUENCE_HPP
#define HOVERCRAFT_INFLUENCE_HPP

#include <sivid/enclosure/flow.hpp>
#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/number/decimal.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// Table 2.2 of the report with proof: how much can each constant, moved through its prior, change
/// each state equation?
///   \f$ e_{ic} = w_c \max |\partial f_i / \partial c| \f$ over all states and inputs in stated
///   ranges and all constants in their priors, w_c the width of the prior of c. A constant that is
///   a function of others, A = pi D^2/4, moves with them.
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
    effect_bounds(sivid::recorded_model const& model, ranking_ranges const& ranges,
                  std::vector<std::string> const& freed)
        : ranges_{ranges},
          flow_{make_flow(model, ranges, freed)},
          series_{flow_.rate_jacobian(), 0} {
        for (auto const k : flow_.model().parameters) {
            priors_.push_back(ranking_prior(model.about.constants[k]));
        }
        related_ = first_related(model);
    }

    [[nodiscard]] std::vector<ranked_equation> operator()(std::size_t points = 4000) {
        auto const n = flow_.states(), m = flow_.parameters();
        std::vector<double> low(n * m, 0.0);
        // Each cover is the sharper one for some effects.
        auto high = bound_from_above({.speeds = 120});
        if (related_ < m) {
            for (auto const& other : {bound_from_above({.related = 1000}),
                                      bound_from_above({.speeds = 40, .related = 40})}) {
                for (std::size_t k = 0; k < high.size(); ++k) high[k] = std::min(high[k], other[k]);
            }
            for (std::size_t i = 0; i < n; ++i) {
                auto& value = high[i * m + related_];
                value = std::min(value, bound_at_corners(i));
            }
        }
        bound_from_below(low, points);
        std::vector<ranked_equation> result;
        auto const& about = flow_.model().about;
        for (std::size_t i = 0; i < n; ++i) {
            ranked_equation equation{
                about.states[i].name, sivid::rate_unit(about.states[i].unit, about.time_unit), {}};
            for (std::size_t c = 0; c < m; ++c) {
                using traits = sivid::interval_traits<sivid::interval>;
                auto const width = traits::sub(traits::point(priors_[c].upper()),
                                               traits::point(priors_[c].lower()));
                auto const slope = traits::bounds(low[i * m + c], high[i * m + c]);
                auto const& name = about.constants[flow_.model().parameters[c]].name;
                equation.effects.push_back({name, equation.unit, priors_[c],
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
    static sivid::flow make_flow(sivid::recorded_model const& model, ranking_ranges const& ranges,
                                 std::vector<std::string> const& freed) {
        for (auto const& name : freed) {
            auto const k = sivid::index_of(model.about.constants, name, "constant");
            if (model.about.constants[k].formula.empty())
                throw std::invalid_argument("the constant '" + name + "' is free already");
        }
        sivid::parameter_choice all;
        for (auto const& c : model.about.constants) {
            bool const free = std::find(freed.begin(), freed.end(), c.name) != freed.end();
            if (c.formula.empty() || free) all.unknown.push_back(c.name);
        }
        sivid::sampled_signal const speed({0}, {ranges.thrust_speed}, sivid::interpolation::hold);
        auto const rudder = sivid::analytic_signal::from([](auto const& t) { return t; });
        return sivid::flow(model, all, {speed, rudder});
    }

    /// The first constant from which another one is derived; else the number of constants. Ranges
    /// are cut along it, too: it occurs in many places, which interval evaluation cannot relate.
    [[nodiscard]] std::size_t first_related(sivid::recorded_model const& model) const {
        auto const& unknown = flow_.model().parameters;
        std::vector<sivid::node_id> formulas;
        for (auto const& d : model.derived) {
            if (std::find(unknown.begin(), unknown.end(), d.constant) == unknown.end())
                formulas.push_back(d.value);
        }
        auto const needed = sivid::operands_of(model.g, formulas);
        for (std::size_t i = 0; i < needed.size(); ++i) {
            auto const& n = model.g.nodes()[i];
            if (!needed[i] || n.op != sivid::operation::constant) continue;
            auto const at =
                std::find(unknown.begin(), unknown.end(), static_cast<std::size_t>(n.index));
            if (at != unknown.end()) return static_cast<std::size_t>(at - unknown.begin());
        }
        return unknown.size();
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

    [[nodiscard]] static sivid::interval part(sivid::interval const& whole, std::size_t k,
                                              std::size_t parts) {
        auto const share = [&](std::size_t i) {
            if (i == 0) return whole.lower();
            if (i == parts) return whole.upper();
            return whole.lower() + (whole.upper() - whole.lower()) *
                                       (static_cast<double>(i) / static_cast<double>(parts));
        };
        return {share(k), share(k + 1)};
    }

    /// The degree of a node as a polynomial in one leaf; infinite when it is none.
    [[nodiscard]] static double degree(sivid::graph const& g, sivid::node_id root,
                                       sivid::operation leaf, std::size_t index) {
        using sivid::operation;
        double const infinite = std::numeric_limits<double>::infinity();
        std::vector<double> d(root + 1, 0.0);
        for (std::size_t k = 0; k <= root; ++k) {
            auto const& n = g.nodes()[k];
            if (is_leaf(n.op)) {
                d[k] = n.op == leaf && static_cast<std::size_t>(n.index) == index ? 1 : 0;
                continue;
            }
            double const a = d[n.a], b = is_binary(n.op) ? d[n.b] : 0;
            if (n.op == operation::add || n.op == operation::sub || n.op == operation::neg) {
                d[k] = std::max(a, b);
            } else if (n.op == operation::mul) {
                d[k] = a + b;
            } else if (n.op == operation::div && b == 0) {
                d[k] = a;
            } else {
                d[k] = a + b > 0 ? infinite : 0;
            }
        }
        return d[root];
    }

    /// Bounds |d f_i/d c| for the related constant from above. In a constant (or the rudder) in
    /// which f_i is affine, this is convex: it is largest at the ends. So interval evaluation,
    /// which cannot see that the terms of the derivative share such factors, is spared their
    /// ranges.
    [[nodiscard]] double bound_at_corners(std::size_t i) const {
        auto const& model = flow_.model();
        auto const& g = model.g;
        auto const entry = model.rate_dp[i][related_];
        auto const needed = sivid::operands_of(g, {entry});
        std::vector<std::pair<sivid::operation, std::size_t>> ends;
        for (std::size_t k = 0; k < needed.size(); ++k) {
            auto const& n = g.nodes()[k];
            auto const index = static_cast<std::size_t>(n.index);
            bool const ours = n.op == sivid::operation::time ||
                              (n.op == sivid::operation::constant && index != related_);
            if (needed[k] && ours && ends.size() < 8 && degree(g, model.rate[i], n.op, index) <= 1)
                ends.emplace_back(n.op, index);
        }
        sivid::graph_range range(g, {entry});
        sivid::leaf_ranges at;
        at.time = ranges_.rudder;
        at.states = sivid::box(ranges_.states);
        at.constants = sivid::box(priors_);
        at.inputs = sivid::box(std::vector<sivid::interval>(model.about.inputs.size(),
                                                            sivid::interval(ranges_.thrust_speed)));
        double high = 0;
        std::size_t const parts = 2048;
        for (std::size_t corner = 0; corner < (std::size_t{1} << ends.size()); ++corner) {
            for (std::size_t b = 0; b < ends.size(); ++b) {
                auto const [leaf, index] = ends[b];
                bool const constant = leaf == sivid::operation::constant;
                auto const& whole = constant ? priors_[index] : ranges_.rudder;
                bool const upper = (corner >> b & 1) != 0;
                (constant ? at.constants[index] : at.time) =
                    sivid::interval(upper ? whole.upper() : whole.lower());
            }
            for (std::size_t k = 0; k < parts; ++k) {
                at.constants[related_] = part(priors_[related_], k, parts);
                range.evaluate(at);
                if (range.undefined(entry)) return std::numeric_limits<double>::infinity();
                high = std::max(high, mag(range.value(entry)));
            }
        }
        return high;
    }

    /// In how many parts u and v, and the related constant, are cut.
    struct cuts {
        std::size_t speeds = 1, related = 1;
    };

    /// Over all boxes of parts.
    [[nodiscard]] std::vector<double> bound_from_above(cuts const& n) {
        std::vector<double> high(flow_.states() * priors_.size(), 0.0);
        auto const keep = [&](std::size_t i, std::size_t c, sivid::interval const& d) {
            auto& value = high[i * priors_.size() + c];
            value = std::max(value, mag(d));
        };
        auto constants = sivid::box(priors_);
        auto x = ranges_.states;
        for (std::size_t k = 0; k < n.related; ++k) {
            if (n.related > 1) constants[related_] = part(priors_[related_], k, n.related);
            series_.set_parameters(constants);
            for (std::size_t a = 0; a < n.speeds; ++a) {
                x[0] = part(ranges_.states[0], a, n.speeds);
                for (std::size_t b = 0; b < n.speeds; ++b) {
                    x[1] = part(ranges_.states[1], b, n.speeds);
                    evaluate(x, ranges_.rudder, keep);
                }
            }
        }
        return high;
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
    std::vector<sivid::interval> priors_; ///< of the constants that are ranked
    std::size_t related_ = 0;
};

/// The ranking of the constants for every state equation. One that is a function of others is no
/// entry of its own: its part is in their effects.
/// @param freed  derived constants that are taken as independent all the same
/// @guarantee  each effect lies in its interval; a constant whose effect is [0, 0] and which does
///             not `occur` is absent from the equation
[[nodiscard]] inline std::vector<ranked_equation>
rank_constants(sivid::recorded_model const& model, ranking_ranges const& ranges = default_ranges(),
               std::vector<std::string> const& freed = {}) {
    return effect_bounds(model, ranges, freed)();
}

/// `hovercraft influence`: the ranking as a page and a table, beside what the report says.
/// @returns an exit code
[[nodiscard]] int influence(sivid::recorded_model const& model, std::filesystem::path const& out,
                            std::vector<std::string> const& freed, std::string const& command_line);

} // namespace hovercraft_example

#endif
