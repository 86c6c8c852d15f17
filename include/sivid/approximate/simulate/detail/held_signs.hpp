// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_DETAIL_HELD_SIGNS_HPP
#define SIVID_APPROXIMATE_SIMULATE_DETAIL_HELD_SIGNS_HPP

#include <sivid/model/graph/differentiate.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// Replaces sign(y), where y depends on states, by what a simulation in doubles can follow and
/// what has a slope for fits. With y' = a - b sign(y), and H half the width of a layer about 0,
///   \f$ \mathrm{sign}(y) \to c(c(a/b) + y/H), \quad c(s) = \max(-1, \min(1, s)). \f$
/// Beyond the layer that is the sign. Within it, where b > |a|, y' = -b y/H: what sticks rests,
/// while a smoothed sign, y/sqrt(y^2 + H^2), lets it creep by H a/b. Several signs that act on
/// each other take one another's plain c(y/H) first, and creep by a part of H.
/// @cost  O(signs * nodes)
class held_signs {
public:
    explicit held_signs(recorded_model const& model) : model_(&model) {
        outputs_ = model.rate;
        outputs_.insert(outputs_.end(), model.observe.begin(), model.observe.end());
        auto const free = [this](node const& n, node_id a, node_id b, graph& to) {
            bool const jumps = n.op == operation::sign && (to.depends(a) & on_state) != 0;
            if (!jumps) return same_operation()(n, a, b, to);
            for (auto const& s : signs_)
                if (s.argument == a) return s.leaf;
            auto const leaf =
                to.leaf(operation::input, model_->about.inputs.size() + signs_.size());
            signs_.push_back({a, leaf});
            return leaf;
        };
        outputs_ = copy_into(g_, model.g, outputs_, same_leaf{}, free);
    }

    /// The model as it is where nothing in it jumps.
    [[nodiscard]] recorded_model result() {
        auto changed = *model_;
        if (signs_.empty()) return changed;
        for (auto& s : signs_) study(s);
        graph to;
        for (auto const& s : signs_) held_.push_back(clamped(to, layers(to, s)));
        for (std::size_t k = 0; k < signs_.size(); ++k) {
            auto const& s = signs_[k];
            auto const resting = clamped(to, copy(to, {s.resting})[0]);
            held_[k] = clamped(to, to.add(resting, layers(to, s)));
        }
        auto const images = copy(to, outputs_);
        auto image = images.begin();
        for (auto* list : {&changed.rate, &changed.observe})
            for (auto& node : *list) node = *image++;
        for (auto& a : changed.added_states)
            a.at_begin = copy_into(to, model_->g, {a.at_begin}, same_leaf{}).front();
        for (auto& d : changed.derived)
            d.value = copy_into(to, model_->g, {d.value}, same_leaf{}).front();
        changed.g = std::move(to);
        changed.stated.reset();
        return changed;
    }

private:
    struct jump {
        node_id argument, leaf; ///< y, and what stands for its sign
        node_id resting{};      ///< a/b
        double half_width{};    ///< H
    };

    void study(jump& s) {
        std::vector<node_id> states;
        for (std::size_t i = 0; i < model_->rate.size(); ++i)
            states.push_back(g_.leaf(operation::state, i));
        auto const slopes = differentiate(g_, {s.argument}, states)[0];
        auto rate = g_.constant(0.0);
        for (std::size_t i = 0; i < states.size(); ++i)
            rate = g_.add(rate, g_.mul(slopes[i], outputs_[i]));
        auto const b = g_.neg(differentiate(g_, {rate}, {s.leaf})[0][0]);
        auto const a = g_.add(rate, g_.mul(b, s.leaf));
        // a/b that is finite where b is 0, and has finite slopes there
        auto const square = [&](node_id x) { return g_.unary(operation::sqr, x); };
        auto const some = g_.add(square(b), g_.mul(g_.constant(1e-12), square(a)));
        s.resting = g_.div(g_.mul(a, b), g_.add(some, g_.constant(1e-300)));
        s.half_width = 5e-5 * largest(s.argument);
    }
    /// Of y, with states within their own ranges.
    /// @returns 1 where that has no bound
    [[nodiscard]] double largest(node_id y) const {
        using traits = interval_traits<interval>;
        auto const& about = model_->about;
        leaf_ranges at{traits::point(0), box(about.states.size()), box(about.constants.size()),
                       box(about.inputs.size() + signs_.size())};
        for (std::size_t i = 0; i < about.states.size(); ++i)
            at.states[i] = traits::bounds(-about.states[i].limit, about.states[i].limit);
        for (std::size_t i = 0; i < about.constants.size(); ++i)
            at.constants[i] = traits::point(about.constants[i].nominal.nearest);
        for (std::size_t i = 0; i < at.inputs.size(); ++i) at.inputs[i] = traits::bounds(-1, 1);
        graph_range range(g_, {y});
        range.evaluate(at);
        double const most = mag(range.value(y));
        return std::isfinite(most) && most > 0 ? most : 1;
    }
    [[nodiscard]] std::vector<node_id> copy(graph& to, std::vector<node_id> const& nodes) const {
        auto const leaf = [this](node const& n, graph& into) {
            auto const k = static_cast<std::size_t>(n.index), inputs = model_->about.inputs.size();
            return n.op == operation::input && k >= inputs ? held_[k - inputs]
                                                           : same_leaf()(n, into);
        };
        return copy_into(to, g_, nodes, leaf);
    }
    /// y/H
    [[nodiscard]] node_id layers(graph& to, jump const& s) const {
        return to.mul(to.constant(1 / s.half_width), copy(to, {s.argument})[0]);
    }
    [[nodiscard]] static node_id clamped(graph& to, node_id x) {
        return to.binary(operation::max, to.constant(-1.0),
                         to.binary(operation::min, to.constant(1.0), x));
    }

    recorded_model const* model_;
    graph g_; ///< of the model, signs as leaves
    std::vector<node_id> outputs_;
    std::vector<jump> signs_;
    std::vector<node_id> held_;
};

} // namespace sivid

#endif
