// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_UNCERTAIN_INPUT_HPP
#define SIVID_ENCLOSURE_UNCERTAIN_INPUT_HPP

#include <sivid/enclosure/series/expansion.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace sivid {

/// Bounds and symmetric widening of the numbers in which sets are written: intervals, and Taylor
/// models in lanes (taylor_expansion.hpp).
template <class T>
struct set_scalar {
    using scalar = double;
    static double upper(T const& a) { return interval_traits<T>::upper(a); }
    static double mag(T const& a) { return interval_traits<T>::mag(a); }
    static double middle(T const& a) { return interval_traits<T>::mid(a); }
    /// Bound of |a - m|.
    static double beside(T const& a, double m) {
        using traits = interval_traits<T>;
        return traits::mag(traits::sub(a, traits::point(m)));
    }
    static T widened(T const& a, double w) {
        using traits = interval_traits<T>;
        return std::isfinite(w) ? traits::add(a, traits::bounds(-w, w)) : traits::entire();
    }
};

/// Bounds of the errors of a flow's uncertain inputs at `t`, on the pieces that govern a step from
/// `start`, in each lane.
template <class C>
[[nodiscard]] std::vector<C> input_errors(flow const& f, C const& start, C const& t) {
    std::vector<C> result;
    for (auto const i : f.uncertain_inputs()) {
        auto const& u = f.input(i);
        result.push_back(each_lane<C>([&](std::size_t l) {
            return u.error_bound(u.piece(lane_traits<C>::get(start, l)), lane_traits<C>::get(t, l));
        }));
    }
    return result;
}

/// The same over all times in [from, to], which no knot of an input parts.
template <class C>
[[nodiscard]] std::vector<C> largest_input_errors(flow const& f, C const& start, C const& from,
                                                  C const& to) {
    auto result = input_errors(f, start, from);
    auto const last = input_errors(f, start, to);
    for (std::size_t k = 0; k < result.size(); ++k) {
        result[k] = lane_traits<C>::max(result[k], last[k]);
    }
    return result;
}

/// The recorded inputs widened by `errors`, one bound per uncertain input.
template <class T, class C>
[[nodiscard]] input_pieces<T> widened(input_pieces<T> inputs, flow const& f,
                                      std::vector<C> const& errors) {
    for (std::size_t k = 0; k < errors.size(); ++k) {
        auto& u = inputs.value[f.uncertain_inputs()[k]];
        u = set_scalar<T>::widened(u, errors[k]);
    }
    return inputs;
}

} // namespace sivid

#endif
