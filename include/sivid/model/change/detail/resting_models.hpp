// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CHANGE_DETAIL_RESTING_MODELS_HPP
#define SIVID_MODEL_CHANGE_DETAIL_RESTING_MODELS_HPP

#include <sivid/model/change/detail/freed_signs.hpp>
#include <sivid/model/change/detail/with_equations.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// A model while one of its states sticks at 0.
struct resting_model {
    std::size_t state = 0; ///< which
    recorded_model model;  ///< its outputs are conditions, in pairs: the quotient a/b, and b
};

/// For each state y whose sign stands in the model, with \f$ y' = a - b\, \mathrm{sign}(y) \f$ and
/// every rate affine in that sign, with slopes in which no sign stands: the model with y' = 0 and
/// a/b in place of the sign.
///   Theorem: while a solution of the model begins with y = 0 and, on a tube about the solution of
/// the resting model, \f$ |a/b| < 1 \f$ and b > 0, the two are the same. For as long as y is 0, a
/// sign that makes y' = 0 is a/b (the only one, as b > 0), and what y stands in of the other rates
/// is equal; and y cannot leave 0, since beside it y' = a - b < 0 above and a + b > 0 below.
/// Other signs are what they were; where their arguments may be 0 on the tube, the conditions
/// hold for all their values: so they do for a second state that comes to rest, whose sign
/// stands on in the conditions of the first. (With a/b in its place, solutions may leave 0 in a
/// spiral through both signs. Of a product of two signs Filippov's set has values that no pair of
/// signs has: there is no such model.)
/// @param resting  of how many states the model is one already: its outputs are kept as conditions
/// @cost  O(signs * nodes)
/// @ref   Filippov 1988 (sliding motions)
[[nodiscard]] inline std::vector<resting_model> resting_models(recorded_model const& model,
                                                               std::size_t resting = 0) {
    std::vector<resting_model> result;
    freed_signs freed(model);
    auto const signs = freed.signs();
    if (std::any_of(signs.begin(), signs.end(),
                    [&](auto const& s) { return freed.jumps(s.argument); }))
        return result;
    auto const n = static_cast<std::ptrdiff_t>(model.rate.size());
    std::vector<node_id> const rates(freed.outputs().begin(),
                                     freed.outputs().begin() + (signs.empty() ? 0 : n));
    for (std::size_t k = 0; k < signs.size(); ++k) {
        auto const y = freed.nodes()[signs[k].argument];
        if (y.op != operation::state) continue;
        auto const i = static_cast<std::size_t>(y.index);
        auto const slopes = freed.slopes(rates, signs[k]);
        bool const alone =
            std::none_of(slopes.begin(), slopes.end(), [&](node_id x) { return freed.jumps(x); });
        auto const& own = freed.nodes()[slopes[i]];
        bool const never = own.op == operation::literal &&
                           freed.nodes().value(own).enclosure.upper() >= 0; // b <= 0
        if (!alone || never) continue;
        graph to;
        std::vector<node_id> value(signs.size());
        auto const copy = [&](std::vector<node_id> const& nodes) {
            return freed.copy(to, nodes, [&](std::size_t j, graph&) { return value[j]; });
        };
        for (std::size_t j = 0; j < signs.size(); ++j)
            value[j] = to.unary(operation::sign, copy({signs[j].argument})[0]);
        std::vector<node_id> conditions;
        if (resting > 0) conditions = copy({freed.outputs().begin() + n, freed.outputs().end()});
        value[k] = to.constant(0.0);
        auto const a = copy({rates[i]})[0], b = to.neg(copy({slopes[i]})[0]);
        value[k] = to.div(a, b);
        auto all = copy(rates);
        all[i] = to.constant(0.0);
        conditions.push_back(value[k]);
        conditions.push_back(b);
        auto changed = with_equations(model, std::move(to), all, conditions);
        changed.about.channels.assign(conditions.size(), {"condition", ""});
        changed.channel_delays.clear();
        result.push_back({i, std::move(changed)});
    }
    return result;
}

} // namespace sivid

#endif
