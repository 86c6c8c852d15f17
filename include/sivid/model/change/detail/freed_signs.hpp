// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CHANGE_DETAIL_FREED_SIGNS_HPP
#define SIVID_MODEL_CHANGE_DETAIL_FREED_SIGNS_HPP

#include <sivid/model/graph/differentiate.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// A model in which each sign(y) of what depends on states is an unknown s of its own, as one more
/// input: with \f$ y' = a - b s \f$, dry friction sticks where \f$ |a| < b \f$ at y = 0.
/// @cost  O(nodes)
class freed_signs {
public:
    struct sign_of {
        node_id argument, leaf; ///< y, and s
    };

    explicit freed_signs(recorded_model const& model) : inputs_(model.about.inputs.size()) {
        bool const any = std::any_of(model.g.nodes().begin(), model.g.nodes().end(),
                                     [](node const& n) { return n.op == operation::sign; });
        if (!any) return; // nothing is copied
        outputs_ = model.rate;
        outputs_.insert(outputs_.end(), model.observe.begin(), model.observe.end());
        auto const free = [this](node const& n, node_id a, node_id b, graph& to) {
            bool const jumps = n.op == operation::sign && (to.depends(a) & on_state) != 0;
            if (!jumps) return same_operation()(n, a, b, to);
            for (auto const& s : signs_)
                if (s.argument == a) return s.leaf;
            auto const leaf = to.leaf(operation::input, inputs_ + signs_.size());
            signs_.push_back({a, leaf});
            return leaf;
        };
        outputs_ = copy_into(g_, model.g, outputs_, same_leaf{}, free);
        for (std::size_t i = 0; i < model.rate.size(); ++i)
            states_.push_back(g_.leaf(operation::state, i));
    }

    [[nodiscard]] graph const& nodes() const { return g_; }
    [[nodiscard]] graph& nodes() { return g_; }
    [[nodiscard]] std::vector<sign_of> const& signs() const { return signs_; }
    /// Rates, then outputs; none where there are no signs.
    [[nodiscard]] std::vector<node_id> const& outputs() const { return outputs_; }
    /// Whether a node is made of signs.
    [[nodiscard]] bool jumps(node_id i) const {
        auto const all = leaves_of(g_, {i}, operation::input);
        return std::any_of(all.begin(), all.end(), [this](auto k) { return k >= inputs_; });
    }
    /// y', in which s stands.
    [[nodiscard]] node_id rate_of(sign_of const& s) {
        auto const slopes = differentiate(g_, {s.argument}, states_)[0];
        auto rate = g_.constant(0.0);
        for (std::size_t i = 0; i < states_.size(); ++i)
            rate = g_.add(rate, g_.mul(slopes[i], outputs_[i]));
        return rate;
    }
    /// The slopes of nodes along s.
    [[nodiscard]] std::vector<node_id> slopes(std::vector<node_id> const& of, sign_of const& s) {
        std::vector<node_id> result;
        for (auto const& row : differentiate(g_, of, {s.leaf})) result.push_back(row[0]);
        return result;
    }
    /// Copies nodes with other ones in place of the signs.
    /// @param value  (k, to) -> the node for the sign k
    template <class Value>
    [[nodiscard]] std::vector<node_id> copy(graph& to, std::vector<node_id> const& nodes,
                                            Value const& value) const {
        auto const leaf = [&](node const& n, graph& into) {
            auto const k = static_cast<std::size_t>(n.index);
            return n.op == operation::input && k >= inputs_ ? value(k - inputs_, into)
                                                            : same_leaf()(n, into);
        };
        return copy_into(to, g_, nodes, leaf);
    }

private:
    std::size_t inputs_;
    graph g_;
    std::vector<node_id> outputs_, states_;
    std::vector<sign_of> signs_;
};

} // namespace sivid

#endif
