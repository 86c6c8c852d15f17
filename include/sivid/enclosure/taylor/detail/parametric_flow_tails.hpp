// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_FLOW_TAILS_HPP
#define SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_FLOW_TAILS_HPP

/// @file
/// A step proved without a tube, from the sizes of the series' coefficients
/// (`docs/taylor_models.md`, section 3.0).

#include <sivid/enclosure/taylor/detail/parametric_flow_class.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sivid {

template <class Model, class Centre>
typename parametric_flow<Model, Centre>::mask
parametric_flow<Model, Centre>::bound_tails(C const& h, std::size_t order, std::size_t flow_order) {
    mask const proved = centre_tail_.bound_states(centre_, h, order, false);
    for (std::size_t i = 0; i < truncation_.size(); ++i) truncation_[i] = centre_tail_.state(i);
    if (!side_by_side::any(proved)) return proved;
    return proved & derivative_tail_.bound_variations(derivative_, h, flow_order);
}

/// The lanes in which what V has beyond its coefficients does not add much to the reach; the others
/// try again with more of them or, if there are no more, with a shorter step.
template <class Model, class Centre>
typename parametric_flow<Model, Centre>::mask
parametric_flow<Model, Centre>::carries_well(mask trying, C const& h, std::size_t flow_order) {
    auto const n = flow_->states();
    C most{};
    for (std::size_t i = 0; i < n; ++i) {
        C added{};
        for (std::size_t c = 0; c < n; ++c)
            added += derivative_tail_.variation(i, c) * set_.reach[c];
        most = side_by_side::max(added / side_by_side::max(allowed(i), set_.reach[i] * 0.01), most);
    }
    mask const poor = trying & (most > C(1.0)) & (h > C(4 * options_.shortest_step()));
    if (!side_by_side::any(poor)) return trying;
    if (flow_order < std::min(options_.order, order_)) {
        flow_order_ = flow_order + 1;
        return trying & !poor;
    }
    reject(poor, failure_reason::minimum_step, each_lane<C>([&](std::size_t l) {
               double const x = side_by_side::get(most, l);
               if (!std::isfinite(x)) return 0.5;
               return std::clamp(0.9 * std::pow(x, -1.0 / static_cast<double>(flow_order)), 0.3,
                                 0.9);
           }));
    return trying & !poor;
}

} // namespace sivid

#endif
