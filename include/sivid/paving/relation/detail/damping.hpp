// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_DAMPING_HPP
#define SIVID_PAVING_RELATION_DETAIL_DAMPING_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/differentiate.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/paving/relation/detail/observed_motion.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sivid {

/// By what a state damps itself, \f$ -\partial f_i/\partial x_i \f$, at the middle of the prior and
/// of the tubes: the median over all cells, at least 0 [1/s]. Weights that grow by it are numbers
/// along each motion. It proves nothing and need not.
/// @param model  to whose graph the derivative is added
[[nodiscard]] inline double damping_of(bound_model& model, std::size_t state,
                                       std::vector<observed_motion> const& motions) {
    auto const own = model.g.leaf(operation::state, state);
    auto const slope = differentiate(model.g, {model.rate[state]}, {own})[0][0];
    graph_range range(model.g, {slope});
    std::vector<double> all;
    double longest = 1e-100;
    for (auto const& m : motions) {
        for (auto const& c : m.cells) {
            auto at = c.at;
            for (auto* x : {&at.states, &at.constants}) {
                for (std::size_t k = 0; k < x->size(); ++k) (*x)[k] = interval(mid((*x)[k]));
            }
            range.evaluate(at);
            auto const& value = range.value(slope);
            if (!range.undefined(slope) && is_bounded(value)) all.push_back(-mid(value));
        }
        if (!m.cells.empty()) longest = std::max(longest, m.cells.back().to - m.cells[0].from);
    }
    if (all.empty()) return 0;
    auto const middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return std::clamp(*middle, 0.0, 300 / longest);
}

} // namespace sivid

#endif
