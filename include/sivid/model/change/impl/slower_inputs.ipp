// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CHANGE_IMPL_SLOWER_INPUTS_IPP
#define SIVID_MODEL_CHANGE_IMPL_SLOWER_INPUTS_IPP

#include <sivid/model/change/detail/slower_inputs.hpp>

#include <sivid/model/change/detail/driving_products.hpp>
#include <sivid/model/graph/program.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

namespace model_detail {

/// One function over one experiment: its values at both ends of each piece, enclosed.
struct piecewise_lines {
    std::vector<double> times; ///< one more than pieces
    std::vector<interval> begin, end;
};

/// The lines with a knot at each of `knots`: doubles through which the means of w are met up to
/// third differences, so that what they leave adds up to nothing.
inline std::vector<double> lines_through(piecewise_lines const& w,
                                         std::vector<double> const& knots) {
    auto const periods = knots.size() - 1;
    std::vector<double> mean(periods, 0.0);
    for (std::size_t k = 0, piece = 0; k < periods; ++k) {
        while (piece + 1 < w.begin.size() && w.times[piece + 1] <= knots[k]) ++piece;
        for (auto i = piece; i < w.begin.size() && w.times[i] < knots[k + 1]; ++i) {
            double const from = std::max(w.times[i], knots[k]),
                         to = std::min(w.times[i + 1], knots[k + 1]);
            double const length = w.times[i + 1] - w.times[i];
            double const middle = ((from + to) / 2 - w.times[i]) / length;
            mean[k] += (to - from) * (mid(w.begin[i]) * (1 - middle) + mid(w.end[i]) * middle);
        }
        mean[k] /= knots[k + 1] - knots[k];
    }
    auto const at = [&](std::ptrdiff_t k) { // beyond the ends along a line
        auto const last = static_cast<std::ptrdiff_t>(periods) - 1;
        auto const value = [&](std::ptrdiff_t i) { return mean[static_cast<std::size_t>(i)]; };
        if (last == 0) return value(0);
        if (k < 0) return value(0) + static_cast<double>(k) * (value(1) - value(0));
        if (k <= last) return value(k);
        return value(last) + static_cast<double>(k - last) * (value(last) - value(last - 1));
    };
    std::vector<double> values;
    for (std::size_t knot = 0; knot < knots.size(); ++knot) {
        auto const k = static_cast<std::ptrdiff_t>(knot) - 1; // the period before it
        values.push_back((5 * (at(k) + at(k + 1)) - at(k - 1) - at(k + 2)) / 8);
    }
    return values;
}

/// The largest |U| in each period, proved.
inline std::vector<double> integral_bounds(piecewise_lines const& w, sampled_signal const& p) {
    using traits = interval_traits<interval>;
    auto const& knots = p.times();
    std::vector<double> bounds(knots.size(), 0.0);
    interval u(0.0);
    std::size_t piece = 0;
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
        double& most = bounds[k];
        most = mag(u);
        double from = knots[k];
        while (from < knots[k + 1]) {
            while (piece + 1 < w.begin.size() && w.times[piece + 1] <= from) ++piece;
            double const to = piece + 1 < w.begin.size()
                                  ? std::min(w.times[piece + 1], knots[k + 1])
                                  : knots[k + 1];
            auto const left = [&](double t) { // w - p on the line of this piece
                interval value = w.begin[piece];
                if (!(value.lower() == w.end[piece].lower() &&
                      value.upper() == w.end[piece].upper())) {
                    typename traits::mask undefined{};
                    auto const share =
                        traits::div(traits::sub(traits::point(t), traits::point(w.times[piece])),
                                    traits::sub(traits::point(w.times[piece + 1]),
                                                traits::point(w.times[piece])),
                                    undefined);
                    value =
                        traits::add(value, traits::mul(traits::sub(w.end[piece], value), share));
                }
                return traits::sub(value, p.value<interval>(k, traits::point(t)));
            };
            auto const a = left(from), b = left(to);
            auto const h = traits::sub(traits::point(to), traits::point(from));
            auto const before = u;
            u = traits::add(u, traits::mul(traits::mul(h, traits::add(a, b)), traits::point(0.5)));
            // Between both ends U is a parabola, on one side of its chord, h |b - a|/8 away at
            // most.
            auto const bow = traits::mul(traits::mul(h, traits::sub(a, b)), traits::point(0.125));
            auto const reach =
                traits::add(traits::hull(before, u), traits::hull(traits::point(0.0), bow));
            most = std::max(most, mag(reach));
            from = to;
        }
    }
    if (knots.size() > 1) bounds.back() = bounds[knots.size() - 2];
    return bounds;
}

/// What the inputs of all experiments are.
struct kinds_of_inputs {
    std::vector<double> ends;   ///< by experiment
    std::vector<bool> fast;     ///< recorded, with four samples or more a period somewhere
    std::vector<bool> recorded; ///< without errors
    std::vector<bool> held;     ///< between samples
};
inline kinds_of_inputs kinds_of(identification_problem const& problem, double period) {
    auto const inputs = problem.model.about.inputs.size();
    kinds_of_inputs of{{},
                       std::vector<bool>(inputs, false),
                       std::vector<bool>(inputs, true),
                       std::vector<bool>(inputs, true)};
    for (auto const& e : problem.experiments) {
        double const end = e.end();
        of.ends.push_back(end);
        for (std::size_t i = 0; i < inputs; ++i) {
            auto const* const u = std::get_if<sampled_signal>(&e.inputs[i]);
            of.recorded[i] = of.recorded[i] && u != nullptr && u->exact();
            if (u == nullptr) continue;
            of.held[i] = of.held[i] && u->kind() == interpolation::hold;
            auto const knots = std::upper_bound(u->times().begin(), u->times().end(), end) -
                               std::upper_bound(u->times().begin(), u->times().end(), e.begin);
            if (static_cast<double>(knots) * period >= 4 * (end - e.begin) && knots > 4)
                of.fast[i] = true;
        }
    }
    for (std::size_t i = 0; i < inputs; ++i) of.fast[i] = of.fast[i] && of.recorded[i];
    return of;
}

/// From the begin to the end of an experiment: all samples of the recorded inputs, and periods.
struct two_grids {
    std::vector<double> times, knots;
};
inline two_grids grids_of(experiment const& e, double end, std::vector<bool> const& recorded,
                          double period) {
    two_grids of{{e.begin}, {}};
    for (std::size_t i = 0; i < recorded.size(); ++i) {
        if (!recorded[i]) continue;
        for (double const t : std::get<sampled_signal>(e.inputs[i]).times()) {
            if (t > e.begin && t < end) of.times.push_back(t);
        }
    }
    std::sort(of.times.begin(), of.times.end());
    of.times.erase(std::unique(of.times.begin(), of.times.end()), of.times.end());
    auto const count = std::max(1.0, std::ceil((end - e.begin) / period));
    for (double n = 0; n < count; ++n) of.knots.push_back(e.begin + n * period);
    double const last = std::max(end, e.begin + count * period);
    of.knots.push_back(last);
    of.times.push_back(last);
    return of;
}

/// Products of functions of recorded inputs, over one experiment.
/// @param functions  slots of the calculation
/// @returns nothing where a function is not defined
inline std::optional<std::vector<piecewise_lines>>
lines_of_products(std::vector<std::vector<std::size_t>> const& products,
                  std::vector<node_id> const& functions, program const& calculation,
                  std::vector<signal> const& inputs, std::vector<double> const& times) {
    std::vector<piecewise_lines> w(products.size());
    for (auto& product : w) product.times = times;
    auto value = calculation.memory<proven_arithmetic<interval>>();
    for (std::size_t piece = 0; piece + 1 < times.size(); ++piece) {
        for (double const t : {times[piece], times[piece + 1]}) {
            calculation.read(value, [&](operation, std::size_t i) {
                auto const& u = std::get<sampled_signal>(inputs[i]);
                return u.value<interval>(u.piece(times[piece]), interval(t));
            });
            if (calculation.run<proven_arithmetic<interval>>(value)) return std::nullopt;
            for (std::size_t m = 0; m < w.size(); ++m) {
                interval of(1.0);
                for (auto const j : products[m]) of = of * value[functions[j]];
                (t == times[piece] ? w[m].begin : w[m].end).push_back(of);
            }
        }
    }
    return w;
}

/// A line for each product, then the bounds of what it leaves of the integrals.
/// @returns whether all of it is finite
inline bool add_lines(std::vector<signal>& to, std::vector<piecewise_lines> const& products,
                      std::vector<double> const& knots) {
    auto const all_finite = [](std::vector<double> const& x) {
        return std::all_of(x.begin(), x.end(), [](double y) { return std::isfinite(y); });
    };
    std::vector<signal> integrals;
    for (auto const& w : products) {
        auto const values = lines_through(w, knots);
        if (!all_finite(values)) return false;
        sampled_signal const line(knots, values, interpolation::linear);
        auto const bounds = integral_bounds(w, line);
        if (!all_finite(bounds)) return false;
        integrals.emplace_back(sampled_signal(knots, std::vector<double>(knots.size(), 0.0),
                                              interpolation::hold, bounds));
        to.emplace_back(line);
    }
    for (auto& u : integrals) to.push_back(std::move(u));
    return true;
}

} // namespace model_detail

SIVID_DECL std::optional<identification_problem>
with_slower_inputs(identification_problem const& problem, double period) {
    using namespace model_detail;
    if (!(period > 0 && std::isfinite(period))) {
        throw std::invalid_argument("with_slower_inputs: the period must be positive, not " +
                                    nearest_text(period));
    }
    auto const& model = problem.model;
    if (model.has_memory()) return std::nullopt;
    auto const [ends, fast, recorded, held] = kinds_of(problem, period);
    if (std::find(fast.begin(), fast.end(), true) == fast.end()) return std::nullopt;
    auto found = driven_by(model, fast, recorded, held);
    if (!found || found->functions.empty()) return std::nullopt;
    auto const functions = found->functions;
    auto const calculation = program(model.g, functions);
    auto const of_held = found->of_held;
    auto made = in_integrals(model, *std::move(found));
    if (!made || made->products.empty()) return std::nullopt;
    for (auto const& product : made->products) { // a product of lines is no line
        if (product.size() > 1 && !(of_held[product[0]] && of_held[product[1]]))
            return std::nullopt;
    }
    identification_problem result{std::move(made->model), problem.choice, problem.prior, {}};
    for (std::size_t k = 0; k < problem.experiments.size(); ++k) {
        auto const& from = problem.experiments[k];
        auto e = from;
        e.inputs.clear();
        for (std::size_t i = 0; i < fast.size(); ++i) {
            if (!fast[i]) e.inputs.push_back(from.inputs[i]);
        }
        auto const [times, knots] = grids_of(from, ends[k], recorded, period);
        auto const w =
            lines_of_products(made->products, functions, calculation, from.inputs, times);
        if (!w || !add_lines(e.inputs, *w, knots)) return std::nullopt;
        result.experiments.push_back(std::move(e));
    }
    return result;
}

} // namespace sivid

#endif
