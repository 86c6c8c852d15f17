// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_KEPT_RANGE_HPP
#define SIVID_PAVING_RELATION_DETAIL_KEPT_RANGE_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/relation/input_range.hpp>
#include <sivid/paving/relation/integrand_set.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Which sides of a box no motion of an experiment crosses, for any parameter of a prior: a side of
/// its start, the bound 0, or an end of a state's own range.
///   A side alone: beyond it the rate of its state points inward, wherever the other states are.
///   Sides together: on each of them the rate points inward while all states are within them, and
///   the rates are Lipschitz in these states around the box, where they determine the motion
///   (Nagumo).
class kept_sides {
    using traits = interval_traits<interval>;

public:
    /// @param rates  first in the set; outlives this
    kept_sides(integrand_set const& set, std::size_t rates, bound_model const& model,
               box const& prior, experiment const& e)
        : set_(&set), range_(*set.g, all_of(set, rates)) {
        at_ = {traits::bounds(e.begin, e.end()), box(rates), prior, box(e.inputs.size())};
        for (std::size_t u = 0; u < e.inputs.size(); ++u)
            at_.inputs[u] = input_across(e.inputs[u], e.begin, e.end());
        for (std::size_t i = 0; i < rates; ++i) {
            auto const& own = model.about.states[i].limit;
            sides_.push_back({i, true, {e.initial[i].lower(), 0.0, own.lower}});
            sides_.push_back({i, false, {e.initial[i].upper(), 0.0, own.upper}});
            at_.states[i] = traits::entire();
        }
        for (auto& s : sides_) { // away from the start
            std::sort(s.places.begin(), s.places.end());
            if (s.lower) std::reverse(s.places.begin(), s.places.end());
            auto const start = std::find(s.places.begin(), s.places.end(), end_of(e.initial, s));
            s.places.erase(s.places.begin(), start);
        }
    }

    /// Encloses the states from the begin of the experiment to its end.
    [[nodiscard]] box operator()() {
        for (bool again = true; again;) {
            again = false;
            for (auto const& s : sides_) again = keep_alone(s) || again;
        }
        for (auto& s : sides_)
            std::erase_if(s.places, [&](double at) { return !is_closer(s, at); });
        for (bool again = true; again;) {
            while (drop_crossed()) {
            }
            again = drop_undetermined();
        }
        return within();
    }

private:
    struct side {
        std::size_t state;
        bool lower;
        std::vector<double> places; ///< the closest to the start first
    };

    [[nodiscard]] static std::vector<node_id> all_of(integrand_set const& set, std::size_t rates) {
        std::vector<node_id> result(set.functions.begin(),
                                    set.functions.begin() + static_cast<std::ptrdiff_t>(rates));
        for (std::size_t i = 0; i < rates; ++i)
            for (std::size_t k = 0; k < rates; ++k) result.push_back(set.slopes[i][k]);
        return result;
    }
    [[nodiscard]] static double end_of(box const& x, side const& s) {
        return s.lower ? x[s.state].lower() : x[s.state].upper();
    }
    /// Whether a side there says more than those that are kept alone.
    [[nodiscard]] bool is_closer(side const& s, double at) const {
        return s.lower ? at > end_of(at_.states, s) : at < end_of(at_.states, s);
    }
    [[nodiscard]] static interval cut(interval const& x, side const& s, double at) {
        return s.lower ? traits::bounds(at, x.upper()) : traits::bounds(x.lower(), at);
    }
    /// Whether the rate of a side's state points inward where that is in `range`.
    [[nodiscard]] bool inward(side const& s, box states, interval const& range) {
        states[s.state] = range;
        auto at = at_;
        at.states = std::move(states);
        range_.evaluate(at);
        auto const f = set_->functions[s.state];
        if (range_.undefined(f) || !set_->continuous[s.state]) return false;
        return s.lower ? range_.value(f).lower() >= 0 : range_.value(f).upper() <= 0;
    }
    /// @returns whether a side is kept closer than before
    [[nodiscard]] bool keep_alone(side const& s) {
        for (double const at : s.places) {
            if (!is_closer(s, at)) return false;
            auto const beyond =
                s.lower ? traits::bounds(-HUGE_VAL, at) : traits::bounds(at, HUGE_VAL);
            if (!inward(s, at_.states, beyond)) continue;
            at_.states[s.state] = cut(at_.states[s.state], s, at);
            return true;
        }
        return false;
    }
    /// Where the states are if no side is crossed.
    [[nodiscard]] box within() const {
        auto x = at_.states;
        for (auto const& s : sides_) {
            if (!s.places.empty()) x[s.state] = cut(x[s.state], s, s.places.front());
        }
        return x;
    }
    [[nodiscard]] bool drop_crossed() {
        bool dropped = false;
        auto const x = within();
        for (auto& s : sides_) {
            if (s.places.empty() || inward(s, x, traits::point(s.places.front()))) continue;
            s.places.erase(s.places.begin());
            dropped = true;
        }
        return dropped;
    }
    /// Sides of states whose rates are not Lipschitz around the box.
    [[nodiscard]] bool drop_undetermined() {
        auto at = at_;
        at.states = within();
        std::vector<bool> faced(at.states.size(), false);
        for (auto const& s : sides_) faced[s.state] = faced[s.state] || !s.places.empty();
        for (std::size_t i = 0; i < faced.size(); ++i) {
            auto& x = at.states[i];
            double const ends = std::max(std::isfinite(x.lower()) ? std::abs(x.lower()) : 0,
                                         std::isfinite(x.upper()) ? std::abs(x.upper()) : 0);
            double const more = 1e-9 * ends + 1e-100;
            x = traits::add(x, traits::bounds(-more, more));
        }
        range_.evaluate(at);
        bool dropped = false;
        for (auto& s : sides_) {
            if (s.places.empty()) continue;
            bool lipschitz = !range_.undefined(set_->functions[s.state]);
            for (std::size_t k = 0; k < faced.size(); ++k)
                lipschitz = lipschitz && !(faced[k] && range_.undefined(set_->slopes[s.state][k]));
            if (lipschitz) continue;
            s.places.clear();
            dropped = true;
        }
        return dropped;
    }

    integrand_set const* set_;
    graph_range range_;
    leaf_ranges at_; ///< the states within the sides that are kept alone
    std::vector<side> sides_;
};

} // namespace paving_detail

} // namespace sivid

#endif
