// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_GRAPH_RANGE_HPP
#define SIVID_MODEL_GRAPH_GRAPH_RANGE_HPP

#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/model/graph/graph.hpp>
#include <sivid/model/graph/program.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_clock.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sivid {

/// Where the leaves of a graph lie: time, states, unknown constants, inputs.
struct leaf_ranges {
    interval time{0.0};
    box states, constants, inputs;
};

/// Ranges of nodes of a graph over a box of leaves, by natural interval evaluation.
/// @guarantee  `value` contains the node's value for every choice of leaves in the box for which it
///             is defined
/// @cost  one interval operation for each needed node
class graph_range {
public:
    graph_range(graph const& g, std::vector<node_id> const& outputs)
        : program_(g, outputs),
          values_(program_.memory<arithmetic>()),
          undefined_(g.size(), 0),
          direction_of_(g.size(), -1) {
        auto const needed = reachable(g, outputs);
        for (std::size_t k = 0; k < needed.size(); ++k) {
            if (needed[k]) add_direction(g, static_cast<node_id>(k));
        }
    }

    void evaluate(leaf_ranges const& at) {
        program_.read(values_, [&at](operation op, std::size_t k) -> interval const& {
            return op == operation::time       ? at.time
                   : op == operation::state    ? at.states[k]
                   : op == operation::constant ? at.constants[k]
                                               : at.inputs[k];
        });
        program_.run<arithmetic>(values_, [this](program::step const& s, bool undefined) {
            undefined_[s.target] = undefined || undefined_[s.a] != 0 || undefined_[s.b] != 0;
            if (direction_of_[s.target] >= 0) sharpen(s.target);
        });
    }

    [[nodiscard]] interval const& value(node_id i) const { return values_[i]; }
    /// Whether the node, or anything it is made of, may be undefined somewhere in the box.
    [[nodiscard]] bool undefined(node_id i) const { return undefined_[i] != 0; }

private:
    using arithmetic = proven_arithmetic<interval>;
    using traits = interval_traits<interval>;

    /// \f$ g x / \sqrt{x^2 + c} \f$ with \f$ c = \sum_k c_k \ge 0 \f$ and factors of g above and
    /// below: dry friction, the direction of a velocity. \f$ x / \sqrt{x^2 + c} \f$ grows with x
    /// from -1 to 1, where the quotient of the ranges may have no bound.
    struct direction {
        node_id of = 0, x = 0;
        std::vector<node_id> rest, above, below;
    };

    void add_direction(graph const& g, node_id i) {
        if (g[i].op != operation::div && g[i].op != operation::mul) return;
        direction factors;
        if (!split(g, i, factors)) return;
        for (auto const root : factors.below) {
            if (g[root].op != operation::sqrt) continue;
            for (auto const x : factors.above) {
                auto found = factors;
                if (!split_square(g, g[root].a, x, found.rest)) continue;
                found.x = x;
                found.of = i;
                found.above.erase(std::find(found.above.begin(), found.above.end(), x));
                found.below.erase(std::find(found.below.begin(), found.below.end(), root));
                if (direction_of_[i] < 0) {
                    direction_of_[i] = static_cast<std::int32_t>(directions_.size());
                }
                directions_.push_back(std::move(found));
            }
        }
    }
    /// Products and sums of more are left as they are: nodes that are shared may stand in them
    /// exponentially often.
    static constexpr std::size_t most_parts = 16;

    /// Factors of a node. @returns false for too many
    [[nodiscard]] static bool split(graph const& g, node_id i, direction& to) {
        std::vector<std::pair<node_id, bool>> open{{i, true}};
        while (!open.empty()) {
            auto const [k, above] = open.back();
            auto const& n = g[k];
            open.pop_back();
            if (n.op == operation::mul || n.op == operation::div) {
                open.emplace_back(n.a, above);
                open.emplace_back(n.b, n.op == operation::mul ? above : !above);
            } else {
                (above ? to.above : to.below).push_back(k);
            }
            if (open.size() + to.above.size() + to.below.size() > most_parts) return false;
        }
        return true;
    }
    /// Whether a sum has the summand \f$ x^2 \f$, and its other summands.
    [[nodiscard]] static bool split_square(graph const& g, node_id sum, node_id x,
                                           std::vector<node_id>& rest) {
        rest.clear();
        bool seen = false;
        for (std::vector<node_id> open{sum}; !open.empty();) {
            auto const k = open.back();
            auto const& n = g[k];
            open.pop_back();
            if (n.op == operation::add) {
                open.insert(open.end(), {n.a, n.b});
            } else if (!seen && n.op == operation::sqr && n.a == x) {
                seen = true;
            } else {
                rest.push_back(k);
            }
            if (open.size() + rest.size() > most_parts) return false;
        }
        return seen;
    }
    /// By each of the directions that a node is.
    void sharpen(node_id target) {
        if (undefined_[target] != 0) return;
        auto k = static_cast<std::size_t>(direction_of_[target]);
        for (; k < directions_.size() && directions_[k].of == target; ++k) sharpen(directions_[k]);
    }
    void sharpen(direction const& d) {
        work_clock::count(8 + d.rest.size(), work_clock::interval);
        auto const& x = values_[d.x];
        auto c = traits::point(0.0);
        for (auto const k : d.rest) c = traits::add(c, values_[k]);
        if (!(c.lower() >= 0) || !is_bounded(x)) return;
        bool undefined = false;
        // The more c, the closer to 0.
        auto const unit = [&](double v, bool up) {
            auto const point = traits::point(v);
            auto const square = traits::point((v < 0) == up ? c.upper() : c.lower());
            auto const length = traits::sqrt(traits::add(traits::sqr(point), square), undefined);
            return traits::div(point, length, undefined);
        };
        auto value = traits::bounds(unit(x.lower(), false).lower(), unit(x.upper(), true).upper());
        for (auto const k : d.above) value = traits::mul(value, values_[k]);
        for (auto const k : d.below) value = traits::div(value, values_[k], undefined);
        auto const both = traits::intersect(values_[d.of], value);
        if (!undefined && !is_empty(both)) values_[d.of] = both;
    }

    program program_;
    std::vector<interval> values_;
    std::vector<char> undefined_;
    std::vector<direction> directions_;
    std::vector<std::int32_t> direction_of_; ///< the first of each node; -1: it is none
};

} // namespace sivid

#endif
