// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_UNTOUCHED_RELATION_HPP
#define SIVID_PAVING_RELATION_DETAIL_UNTOUCHED_RELATION_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>
#include <sivid/paving/relation/relation_finding.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Compares expressions of two graphs node by node. What is one node in the first must be one node
/// in the second, so that equal enclosures of a literal stand for one number where they did before.
class same_expressions {
public:
    same_expressions(graph const& a, graph const& b) : a_(&a), b_(&b) {}

    [[nodiscard]] bool operator()(node_id a, node_id b) {
        if (auto const known = image_.find(a); known != image_.end()) return known->second == b;
        auto const& m = (*a_)[a];
        auto const& n = (*b_)[b];
        if (m.op != n.op || different_.count({a, b}) > 0) return false;
        if (m.op == operation::literal) {
            auto const& x = a_->value(m).enclosure;
            auto const& y = b_->value(n).enclosure;
            if (x.lower() != y.lower() || x.upper() != y.upper()) return false;
        } else if (m.index != n.index) {
            return false;
        }
        if (!is_leaf(m.op)) {
            if (!operands(m, n.a, n.b) && !(commutes(m.op) && operands(m, n.b, n.a)))
                return different_.insert({a, b}), false;
        }
        image_[a] = b;
        return true;
    }

private:
    [[nodiscard]] bool operands(node const& m, node_id a, node_id b) {
        return (*this)(m.a, a) && (!is_binary(m.op) || (*this)(m.b, b));
    }
    /// Graphs put operands in the order in which they were made.
    [[nodiscard]] static bool commutes(operation op) {
        return op == operation::add || op == operation::mul || op == operation::min ||
               op == operation::max;
    }

    graph const* a_;
    graph const* b_;
    std::map<node_id, node_id> image_;
    std::set<std::pair<node_id, node_id>> different_; ///< found so: each pair is tried once
};

} // namespace paving_detail

/// Whether a model with effects still contains all that the refutation of a relation is about: the
/// same equations, as functions of time, states, inputs and constants, and the same functions in
/// the sensors of its row, none of them late.
///   Such effects may act anywhere else: any of their trajectories that met all bounds would fulfil
///   the equation with all bounds of its sensors, which is refuted. Delays and lags need no
///   enclosure for that.
/// @param base     the model that the relation was examined in
/// @param changed  made of it by `with`: its leaves keep their places
/// @guarantee  true: what is proved of the relation holds in `changed`, under the same assumptions,
///             where the parameters of `base` have the same prior and its states the same starts
[[nodiscard]] inline bool keeps_relation(recorded_model const& base, recorded_model const& changed,
                                         relation_finding const& f) {
    if (base.has_memory() || changed.rate.size() < base.rate.size()) return false;
    paving_detail::same_expressions same(base.g, changed.g);
    auto equations = f.further;
    equations.push_back(f.equation);
    std::vector<node_id> rates;
    for (auto const i : equations) {
        if (!same(base.rate.at(i), changed.rate.at(i))) return false;
        rates.push_back(changed.rate[i]);
    }
    auto const late = [](std::vector<signal_memory> const& delays, std::size_t index) {
        return std::any_of(delays.begin(), delays.end(),
                           [index](signal_memory const& d) { return d.index == index; });
    };
    for (auto const u : leaves_of(changed.g, rates, operation::input)) {
        if (late(changed.input_memory, u)) return false;
    }
    for (auto const& name : f.channels) {
        auto const y = index_of(base.about.channels, name, "channel");
        if (!same(base.observe.at(y), changed.observe.at(y))) return false;
        if (late(changed.channel_delays, y)) return false;
    }
    return true;
}

} // namespace sivid

#endif
