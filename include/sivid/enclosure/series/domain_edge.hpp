// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_SERIES_DOMAIN_EDGE_HPP
#define SIVID_ENCLOSURE_SERIES_DOMAIN_EDGE_HPP

#include <sivid/enclosure/failure.hpp>
#include <sivid/enclosure/flow.hpp>
#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/model/graph/detail/formula_text.hpp>
#include <sivid/model/graph/program.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

namespace enclosure_detail {
/// What the leaves of a flow's graph are called in its model.
[[nodiscard]] inline leaf_names names_in(bound_model const& model) {
    leaf_names names;
    for (auto const c : model.parameters) names.constants.push_back(model.about.constants[c].name);
    for (auto const& x : model.about.states) names.states.push_back(x.name);
    for (auto const& u : model.about.inputs) names.inputs.push_back(u.name);
    return names;
}
/// Longer formulas are no help in a message.
inline constexpr double longest_formula = 24;
} // namespace enclosure_detail

/// The first function, in the order of the states and of evaluation, that is not defined on a set
/// of states: in a rate, or else in a derivative of one. Its argument leaves the domain both as a
/// value of T and as an interval, which knows that a square or an exponential is never negative.
/// @tparam T      intervals or Taylor models: sees what a series in T sees
/// @param start   selects the pieces of sampled inputs
/// @param times   the times that belong to the states
/// @param is_set  whether the flag of one value, or lane, is set
/// @param bounds  (value) -> its lower and upper bound
/// @cost  O(size of the graph); for messages
template <class T, class Start, class States, class Parameters, class IsSet, class Bounds>
[[nodiscard]] std::optional<domain_edge>
find_domain_edge(flow const& f, Start const& start, T const& times, States const& x,
                 Parameters const& parameters, IsSet const& is_set, Bounds const& bounds) {
    using A = arithmetic_of<T>;
    auto const& model = f.model();
    auto const& g = model.g;
    input_pieces<T> const inputs(f, start, times);
    auto const all = program::marked(g, std::vector<bool>(g.size(), true));
    auto const leaf = [&](operation op, std::size_t index) -> T {
        return op == operation::time       ? times
               : op == operation::state    ? T(x[index])
               : op == operation::constant ? T(parameters[index])
                                           : T(inputs(index, 0));
    };
    auto value = all.template memory<A>();
    all.read(value, leaf);
    using plain = proven_arithmetic<interval>;
    auto natural = all.template memory<plain>();
    all.read(natural, [&](operation op, std::size_t index) {
        auto const [lower, upper] = bounds(leaf(op, index));
        return lower <= upper ? plain::bounds(lower, upper) : plain::entire(); // NaN
    });
    std::vector<bool> leaves(g.size(), false); // its domain
    all.template run<plain>(
        natural, [&](program::step const& s, bool undefined) { leaves[s.target] = undefined; });
    all.template run<A>(value, [&](program::step const& s, typename A::mask const& undefined) {
        leaves[s.target] = leaves[s.target] && is_set(undefined);
    });
    for (bool const derivative : {false, true}) {
        for (std::size_t i = 0; i < f.states(); ++i) {
            std::vector<node_id> of{model.rate[i]};
            if (derivative) {
                for (auto const* d : {&model.rate_dx[i], &model.rate_dp[i]})
                    of.insert(of.end(), d->begin(), d->end());
            }
            auto const needed = reachable(g, of);
            for (std::size_t k = 0; k < g.size(); ++k) {
                if (!needed[k] || !leaves[k]) continue;
                auto const& n = g[static_cast<node_id>(k)];
                auto const argument = n.op == operation::div ? n.b : n.a;
                auto const [lower, upper] = bounds(value[argument]);
                auto const& plainly = natural[argument];
                auto const names = enclosure_detail::names_in(model);
                return domain_edge{i,
                                   derivative,
                                   n.op,
                                   std::max(plainly.lower(), lower),
                                   std::min(plainly.upper(), upper),
                                   is_short(g, argument, names, enclosure_detail::longest_formula)
                                       ? formula_text(g, argument, names)
                                       : ""};
            }
        }
    }
    return std::nullopt;
}

/// The same on a box.
template <class I>
[[nodiscard]] std::optional<domain_edge> find_domain_edge(flow const& f, double start,
                                                          I const& times, basic_box<I> const& x,
                                                          basic_box<I> const& parameters) {
    using traits = interval_traits<I>;
    return find_domain_edge(
        f, start, times, x, parameters, [](bool flag) { return flag; },
        [](I const& a) {
            return std::pair{traits::lower(a), traits::upper(a)};
        });
}

} // namespace sivid

#endif
