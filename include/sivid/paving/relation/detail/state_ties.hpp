// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_STATE_TIES_HPP
#define SIVID_PAVING_RELATION_DETAIL_STATE_TIES_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/model/structure/state_sum.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/paving/relation/input_range.hpp>
#include <sivid/paving/relation/integrand_set.hpp>
#include <sivid/paving/relation/state_samples.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// What ties the states of a motion to each other at one time: sums of states, and outputs that are
/// functions of several of them.
class state_ties {
    using traits = interval_traits<interval>;
    using weighted_states = std::vector<std::pair<std::size_t, interval>>;

public:
    /// @param g        of the model, to which derivatives are added; outlives this
    /// @param samples  of states that channels show as they are: an output of such states alone
    ///                 tells nothing here
    state_ties(graph& g, bound_model const& model, box const& prior, experiment const& e,
               std::vector<std::optional<state_samples>> const& samples,
               std::vector<state_sum> const& sums)
        : prior_(prior), inputs_(e.inputs), begin_(e.begin), states_(samples.size()) {
        weigh(g, sums);
        std::vector<node_id> nodes;
        for (std::size_t y = 0; y < model.channel_count(); ++y) {
            auto const value = model.observe[y];
            auto const own = leaves_of(g, {value}, operation::state);
            bool const tells =
                std::any_of(own.begin(), own.end(), [&](std::size_t i) { return !samples[i]; });
            auto seen = state_samples::sensed(e, y);
            if (!tells || seen.times.empty() || g[value].op == operation::state) continue;
            auto const set = integrand_set::of(g, {value}, states_, e.inputs.size());
            if (!set.continuous[0]) continue;
            auto& added = outputs_.emplace_back(output{value, {}, std::move(seen)});
            nodes.push_back(value);
            for (auto const i : own) {
                added.slopes.emplace_back(i, set.slopes[0][i]);
                nodes.push_back(set.slopes[0][i]);
            }
        }
        range_.emplace(g, nodes);
    }

    /// When outputs were measured, and how far apart they mostly are.
    [[nodiscard]] std::vector<double> times() const {
        std::vector<double> result;
        for (auto const& y : outputs_)
            result.insert(result.end(), y.seen.times.begin(), y.seen.times.end());
        return result;
    }
    [[nodiscard]] double spacing() const {
        double result = HUGE_VAL;
        for (auto const& y : outputs_)
            if (y.seen.times.size() > 1) result = std::min(result, y.seen.spacing());
        return result;
    }

    /// Narrows states, and the sums that follow them, by each other.
    void by_sums(box& x) const {
        for (std::size_t s = 0; s < weights_.size(); ++s) {
            auto all = traits::point(0.0);
            for (auto const& [i, a] : weights_[s]) all = traits::add(all, traits::mul(a, x[i]));
            auto& sum = x[states_ + s];
            sum = agreed(sum, all);
            narrow(weights_[s], box(states_), interval(sum), x);
        }
    }
    /// Narrows states by outputs measured at t, by the mean value theorem about a point.
    void by_outputs(double t, box& x) {
        for (auto const& y : outputs_) {
            auto const k = std::lower_bound(y.seen.times.begin(), y.seen.times.end(), t);
            if (k == y.seen.times.end() || *k != t) continue;
            leaf_ranges at{interval(t), x, prior_, box(inputs_.size())};
            for (std::size_t u = 0; u < inputs_.size(); ++u)
                at.inputs[u] = input_around(inputs_[u], t, t, t == begin_);
            range_->evaluate(at);
            bool usable = !range_->undefined(y.value);
            weighted_states slopes;
            for (auto const& [i, slope] : y.slopes) {
                usable = usable && !range_->undefined(slope);
                slopes.emplace_back(i, range_->value(slope));
                auto const& side = x[i];
                at.states[i] = interval(
                    is_bounded(side) ? mid(side) : std::clamp(0.0, side.lower(), side.upper()));
            }
            range_->evaluate(at);
            if (!usable || range_->undefined(y.value)) continue;
            auto const& bound = y.seen.bounds[static_cast<std::size_t>(k - y.seen.times.begin())];
            narrow(slopes, at.states, traits::sub(bound, range_->value(y.value)), x);
        }
    }

private:
    struct output {
        node_id value = 0;
        std::vector<std::pair<std::size_t, node_id>> slopes; ///< by states
        state_samples seen;
    };

    /// Weights over the prior.
    void weigh(graph const& g, std::vector<state_sum> const& sums) {
        std::vector<node_id> values;
        for (auto const& s : sums)
            for (auto const& w : s.weights) values.push_back(w.value);
        graph_range range(g, values);
        range.evaluate({interval(0.0), {}, prior_, {}});
        for (auto const& s : sums) {
            auto& weights = weights_.emplace_back(1, std::pair(s.first, traits::point(1.0)));
            for (auto const& w : s.weights) {
                bool const undefined = range.undefined(w.value);
                if (weights.back().first != w.state)
                    weights.emplace_back(w.state, traits::point(0.0));
                auto& own = weights.back().second;
                own = traits::add(own, undefined ? traits::entire() : range.value(w.value));
            }
        }
    }
    /// By \f$ \sum_j a_j (x_j - c_j) = b \f$.
    static void narrow(weighted_states const& a, box const& c, interval const& b, box& x) {
        std::vector<interval> parts;
        for (auto const& [i, weight] : a)
            parts.push_back(traits::mul(weight, traits::sub(x[i], c[i])));
        for (std::size_t k = 0; k < a.size(); ++k) {
            auto rest = b;
            for (std::size_t j = 0; j < a.size(); ++j)
                if (j != k) rest = traits::sub(rest, parts[j]);
            auto const& [i, weight] = a[k];
            bool undefined = false;
            auto const own = traits::div(rest, weight, undefined);
            if (!undefined) x[i] = agreed(x[i], traits::add(c[i], own));
        }
    }

    box prior_;
    std::vector<signal> inputs_;
    double begin_;
    std::size_t states_;
    std::vector<weighted_states> weights_; ///< of each sum
    std::vector<output> outputs_;
    std::optional<graph_range> range_;
};

} // namespace sivid

#endif
