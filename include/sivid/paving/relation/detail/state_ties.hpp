// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_STATE_TIES_HPP
#define SIVID_PAVING_RELATION_DETAIL_STATE_TIES_HPP

#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/structure/state_sum.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// What ties the states of a motion to each other at one time: sums of them.
class state_ties {
    using traits = interval_traits<interval>;
    using weighted_states = std::vector<std::pair<std::size_t, interval>>;

public:
    /// @param states  so many come before the sums
    state_ties(graph const& g, box const& prior, std::size_t states,
               std::vector<state_sum> const& sums)
        : states_(states) {
        weigh(g, prior, sums);
    }

    /// Narrows states, and the sums that follow them, by each other.
    void by_sums(box& x) const {
        for (std::size_t s = 0; s < weights_.size(); ++s) {
            auto all = traits::point(0.0);
            for (auto const& [i, a] : weights_[s]) all = traits::add(all, traits::mul(a, x[i]));
            auto& sum = x[states_ + s];
            sum = agreed(sum, all);
            narrow(weights_[s], interval(sum), x);
        }
    }

private:
    /// Weights over the prior.
    void weigh(graph const& g, box const& prior, std::vector<state_sum> const& sums) {
        std::vector<node_id> values;
        for (auto const& s : sums)
            for (auto const& w : s.weights) values.push_back(w.value);
        graph_range range(g, values);
        range.evaluate({interval(0.0), {}, prior, {}});
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
    /// By \f$ \sum_j a_j x_j = b \f$.
    static void narrow(weighted_states const& a, interval const& b, box& x) {
        std::vector<interval> parts;
        for (auto const& [i, weight] : a) parts.push_back(traits::mul(weight, x[i]));
        for (std::size_t k = 0; k < a.size(); ++k) {
            auto rest = b;
            for (std::size_t j = 0; j < a.size(); ++j)
                if (j != k) rest = traits::sub(rest, parts[j]);
            auto const& [i, weight] = a[k];
            bool undefined = false;
            auto const own = traits::div(rest, weight, undefined);
            if (!undefined) x[i] = agreed(x[i], own);
        }
    }

    std::size_t states_;
    std::vector<weighted_states> weights_; ///< of each sum
};

} // namespace sivid

#endif
