// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_STRUCTURE_DETAIL_RESTING_STATES_HPP
#define SIVID_MODEL_STRUCTURE_DETAIL_RESTING_STATES_HPP

#include <sivid/model/graph/graph_range.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sivid {

/// States that stay where they start: their rates are 0 as long as they do, whatever the other
/// states do. A craft that coasts straight on does not turn.
///   With the resting states R at their starts \f$ r_0 \f$, \f$ f_R(t, r_0, y, p, u) = 0 \f$ for
///   all y. Then \f$ x_R(t) = r_0 \f$ solves the equations, and it is their only solution since
///   f is locally Lipschitz in \f$ x_R \f$ there: whatever is not Lipschitz at a point (a root at
///   0, a sign, a quotient by 0) must stay away from it.
/// @param at  where the leaves lie in all runs; the states where they start. Only states that start
///            at a point can rest; the others may go anywhere.
/// @returns   whether each state rests
/// @cost      one interval evaluation of the rates a round, at most as many rounds as states
[[nodiscard]] inline std::vector<bool>
resting_states(graph const& g, std::vector<node_id> const& rate, leaf_ranges at) {
    using traits = interval_traits<interval>;
    auto const n = rate.size();
    std::vector<bool> rests(n, false);
    at.time = traits::entire();
    for (std::size_t i = 0; i < n; ++i) {
        rests[i] = is_point(at.states[i]);
        if (!rests[i]) at.states[i] = traits::entire();
    }
    auto const excludes_zero = [](interval const& x) { return x.lower() > 0 || x.upper() < 0; };
    graph_range values(g, rate);
    while (std::find(rests.begin(), rests.end(), true) != rests.end()) {
        values.evaluate(at);
        // What is not Lipschitz in a resting state, or may be undefined.
        auto const size = g.size();
        std::vector<bool> moves(size, false), rough(size, false);
        auto const needed = operands_of(g, rate);
        for (std::size_t k = 0; k < size; ++k) {
            if (!needed[k]) continue;
            auto const& o = g.nodes()[k];
            if (o.op == operation::state) moves[k] = rests[static_cast<std::size_t>(o.index)];
            if (is_leaf(o.op)) continue;
            auto const b = is_binary(o.op) ? o.b : o.a;
            moves[k] = moves[o.a] || moves[b];
            rough[k] = rough[o.a] || rough[b] || values.undefined(static_cast<node_id>(k));
            if (o.op == operation::sqrt || o.op == operation::sign) {
                rough[k] = rough[k] || (moves[k] && !excludes_zero(values.value(o.a)));
            }
        }
        bool same = true;
        for (std::size_t i = 0; i < n; ++i) {
            auto const& f = values.value(rate[i]);
            if (!rests[i] || (f.lower() == 0 && f.upper() == 0 && !rough[rate[i]])) continue;
            rests[i] = same = false;
            at.states[i] = traits::entire();
        }
        if (same) break;
    }
    return rests;
}

} // namespace sivid

#endif
