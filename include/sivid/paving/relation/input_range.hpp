// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_INPUT_RANGE_HPP
#define SIVID_PAVING_RELATION_INPUT_RANGE_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

namespace sivid {

/// Adds the knots of inputs that lie between two times.
inline void add_knots(std::vector<double>& times, std::vector<signal> const& inputs, double from,
                      double to) {
    for (auto const& u : inputs) {
        auto const* sampled = std::get_if<sampled_signal>(&u);
        if (sampled == nullptr) continue;
        for (double const t : sampled->times()) {
            if (from < t && t < to) times.push_back(t);
        }
    }
}

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

/// The range of an input over any stretch, its error included.
[[nodiscard]] inline interval input_across(signal const& s, double from, double to) {
    auto const* sampled = std::get_if<sampled_signal>(&s);
    if (sampled == nullptr) return input_over(s, from, to);
    auto result = input_over(s, to, to);
    for (double t = from; t < to;) {
        double const next = std::min(sampled->next_knot(t), to);
        result = hull(result, input_over(s, t, next));
        t = next;
    }
    return result;
}

/// What an input moves by over a stretch within one piece, its error included; a held one by what
/// it jumps at the begin of the stretch. What may turn on the way moves by its range either way.
[[nodiscard]] inline interval input_move(signal const& s, double from, double to, bool at_begin) {
    using traits = interval_traits<interval>;
    auto const* sampled = std::get_if<sampled_signal>(&s);
    if (sampled == nullptr) {
        auto const range = input_over(s, from, to);
        if (!is_bounded(range)) return traits::entire();
        double const most = width(range);
        return traits::bounds(-most, most);
    }
    auto const piece = sampled->piece(from);
    auto const h = traits::sub(traits::point(to), traits::point(from));
    auto move = traits::mul(sampled->slope<interval>(piece), h);
    double e = std::max(sampled->error_bound(piece, from), sampled->error_bound(piece, to));
    if (sampled->kind() == interpolation::hold && !at_begin && piece > 0 &&
        sampled->times()[piece] == from) {
        move = traits::sub(traits::point(sampled->values()[piece]),
                           traits::point(sampled->values()[piece - 1]));
        e = std::max(e, sampled->error_bound(piece - 1, from));
    }
    // Between two later times it may stand still, and move by its errors alone.
    if (e > 0) move = traits::hull(move, traits::point(0.0));
    return traits::add(move, traits::mul(traits::point(2.0), traits::bounds(-e, e)));
}

/// The range of an input over a stretch within one piece, and where it jumps from at the begin.
[[nodiscard]] inline interval input_around(signal const& s, double from, double to, bool at_begin) {
    auto const range = input_over(s, from, to);
    auto const* sampled = std::get_if<sampled_signal>(&s);
    if (sampled == nullptr || sampled->kind() == interpolation::linear || at_begin) return range;
    auto const piece = sampled->piece(from);
    if (piece == 0 || sampled->times()[piece] != from) return range;
    double const last = sampled->values()[piece - 1];
    double const e = sampled->error_bound(piece - 1, from);
    return hull(range, interval(last) + interval_traits<interval>::bounds(-e, e));
}

} // namespace sivid

#endif
