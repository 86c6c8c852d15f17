// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_MOTION_CELLS_HPP
#define SIVID_PAVING_RELATION_DETAIL_MOTION_CELLS_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/model/structure/state_sum.hpp>
#include <sivid/paving/relation/detail/derivative_bound.hpp>
#include <sivid/paving/relation/detail/kept_range.hpp>
#include <sivid/paving/relation/detail/state_ties.hpp>
#include <sivid/paving/relation/input_range.hpp>
#include <sivid/paving/relation/integrand_set.hpp>
#include <sivid/paving/relation/state_samples.hpp>
#include <sivid/paving/relation/time_cell.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// Where the states, then the sums lie over each cell, and at each end of a cell.
struct motion_reach {
    std::vector<box> over, at;
};

/// One experiment cut into short cells of time, in which no input has a knot, and what its model
/// does there for any parameter of a prior.
class motion_cells {
    using traits = interval_traits<interval>;

public:
    struct cell {
        double from = 0, to = 0;
        box inputs;                  ///< over the whole cell, and before a jump at its begin
        std::vector<interval> moves; ///< of the inputs from any time in it to any later one
    };

    /// @param model     with its inputs as leaves
    /// @param channels  that show the states
    /// @param believed  whether states of which nothing else is known keep their own ranges; else
    ///                  they keep what the model proves that they keep (`kept_sides`)
    /// @param sums      of the model's states; each is carried as a further state
    motion_cells(bound_model const& model, box const& prior, experiment const& e,
                 std::vector<std::optional<std::size_t>> const& channels, bool believed,
                 std::vector<state_sum> const& sums = {})
        : g_(std::make_unique<graph>(model.g)),
          prior_(prior),
          inputs_(e.inputs),
          initial_(e.initial) {
        auto const n = model.state_count();
        std::vector<double> times;
        double spacing = HUGE_VAL;
        samples_.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            if (!channels[i]) continue;
            samples_[i] = state_samples::of(e, i, *channels[i]);
            auto const& own = samples_[i]->times;
            times.insert(times.end(), own.begin(), own.end());
            if (own.size() > 1) spacing = std::min(spacing, samples_[i]->spacing());
        }
        for (auto const& p : pairs_in(*g_, model.rate))
            if (samples_[p.q] && !samples_[p.r]) pairs_.push_back(p);
        auto functions = model.rate;
        for (auto const& s : sums) functions.push_back(s.rate);
        set_ = integrand_set::of(*g_, functions, n, e.inputs.size());
        if (believed) {
            for (auto const& s : model.about.states) limits_.push_back(s.limit.range());
        } else {
            auto const kept = paving_detail::kept_sides(set_, n, model, prior, e)();
            limits_.assign(kept.begin(), kept.end());
        }
        limits_.resize(n + sums.size(), traits::entire());
        ties_.emplace(*g_, prior, n, sums);
        cut(std::move(times), spacing, e);
    }

    [[nodiscard]] std::size_t size() const { return cells_.size(); }
    [[nodiscard]] cell const& operator[](std::size_t c) const { return cells_[c]; }
    [[nodiscard]] std::vector<signal> const& inputs() const { return inputs_; }
    /// The rates with their derivatives.
    [[nodiscard]] integrand_set const& set() const { return set_; }
    /// Of each measured state.
    [[nodiscard]] std::vector<std::optional<state_samples>> const& samples() const {
        return samples_;
    }
    [[nodiscard]] interval length(std::size_t c) const {
        return traits::sub(traits::point(cells_[c].to), traits::point(cells_[c].from));
    }
    [[nodiscard]] interval const& own_range(std::size_t i) const { return limits_[i]; }
    [[nodiscard]] leaf_ranges leaves(std::size_t c, box const& states) const {
        return {traits::bounds(cells_[c].from, cells_[c].to), states, prior_, cells_[c].inputs};
    }
    [[nodiscard]] box rates_in(graph_range& range, std::size_t c, box const& states) const {
        range.evaluate(leaves(c, states));
        box result(set_.functions.size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            auto const f = set_.functions[i];
            result[i] = range.undefined(f) ? traits::entire() : range.value(f);
        }
        return result;
    }
    [[nodiscard]] graph_range range_of_rates() const { return {*g_, set_.functions}; }

    /// What two enclosures say, side by side; the first where they do not agree.
    [[nodiscard]] static box both(box x, box const& known) {
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = agreed(x[i], known[i]);
        return x;
    }

    /// Encloses the model's motions, from the samples before and from those after. A state that is
    /// the rate of a sampled one is told by what that changes by, too (`derivative_bound`).
    [[nodiscard]] motion_reach enclosures() const {
        auto range = range_of_rates();
        auto const n = limits_.size();
        auto const count = cells_.size();
        own_rates own;
        motion_reach result{std::vector<box>(count, box(n)), std::vector<box>(count + 1, box(n))};
        boundary_views views(pairs_.size(),
                             std::vector<std::vector<derivative_bound::view>>(count + 1));
        int passes = pairs_.empty() ? 2 : 3; // once more with what both directions say
        for (int number = 0; number < passes; ++number) {
            auto now = begin_pass(number % 2 == 0, number > 0);
            for (std::size_t s = 0; s < count; ++s) {
                auto const c = now.forward ? s : count - 1 - s;
                arrive(now, now.forward ? c : c + 1, result, views);
                auto over =
                    step(range, own, c, now.at, now.forward, now.again ? &result.over[c] : nullptr);
                auto const rates = rates_in(range, c, over);
                auto const lasting = now.forward ? length(c) : traits::neg(length(c));
                for (std::size_t p = 0; p < pairs_.size(); ++p) {
                    now.derived[p].add(length(c), rates[pairs_[p].r]);
                }
                for (std::size_t i = 0; i < n; ++i) {
                    auto& x = now.at[i];
                    auto const end =
                        agreed(over[i], traits::add(x, traits::mul(lasting, rates[i])));
                    bool const told = i >= samples_.size() || (samples_[i] && !own.needed);
                    x = told ? end : agreed(end, by_itself(own, c, i, x, over, lasting));
                }
                result.over[c] = std::move(over);
            }
            if (count > 0) arrive(now, now.forward ? count : 0, result, views);
            // What later samples tell, and what that does.
            if (number == 1 && own.needed) passes = 4;
        }
        return result;
    }
    /// Takes what `enclosures` say of states that nobody measured for samples of them, and narrows
    /// the samples of the others by it.
    void add_derived_samples(motion_reach const& reach) {
        std::vector<double> times;
        for (auto const& s : samples_) {
            if (s) times.insert(times.end(), s->times.begin(), s->times.end());
        }
        std::sort(times.begin(), times.end());
        times.erase(std::unique(times.begin(), times.end()), times.end());
        for (std::size_t i = 0; i < samples_.size() && !cells_.empty(); ++i) {
            state_samples derived;
            for (std::size_t k = 0; samples_[i] && k < samples_[i]->times.size(); ++k) {
                auto& bound = samples_[i]->bounds[k];
                auto const c = boundary_at(samples_[i]->times[k]);
                if (c) bound = agreed(bound, reach.at[*c][i]);
            }
            for (std::size_t k = 0; !samples_[i] && k < times.size(); ++k) {
                auto const c = boundary_at(times[k]);
                if (!c) continue;
                if (!is_bounded(reach.at[*c][i])) {
                    derived = {}; // samples are without holes
                    break;
                }
                derived.times.push_back(times[k]);
                derived.bounds.push_back(reach.at[*c][i]);
            }
            if (derived.times.size() > 1) samples_[i] = std::move(derived);
        }
    }
    /// What `enclosures` say of a state over any time within the samples.
    [[nodiscard]] interval over(motion_reach const& reach, std::size_t i, double from,
                                double to) const {
        auto c = std::upper_bound(cells_.begin(), cells_.end(), from,
                                  [](double t, cell const& x) { return t < x.to; });
        auto result = traits::empty();
        for (; c != cells_.end() && (c->from < to || is_empty(result)); ++c) {
            result = hull(result, reach.over[static_cast<std::size_t>(c - cells_.begin())][i]);
        }
        bool const covered = !cells_.empty() && cells_.front().from <= from &&
                             to <= cells_.back().to && !is_empty(result);
        return covered ? result : traits::entire();
    }

private:
    /// Rates of single states with their slopes by themselves, made when they are asked for.
    struct own_rates {
        std::map<std::size_t, graph_range> of;
        bool needed = false; ///< Picard's iteration did not settle everywhere
    };
    /// One way through all cells.
    struct pass {
        bool forward, again;
        box at; ///< states where it is
        std::vector<derivative_bound> derived;
    };
    /// What the marks of the pass before say at each boundary: [pair][boundary]
    using boundary_views = std::vector<std::vector<std::vector<derivative_bound::view>>>;

    [[nodiscard]] pass begin_pass(bool forward, bool again) const {
        pass result{forward, again, box(limits_.size()),
                    std::vector<derivative_bound>(pairs_.size())};
        for (std::size_t i = 0; i < result.at.size(); ++i) {
            result.at[i] = forward && i < initial_.size() ? initial_[i] : own_range(i);
        }
        ties_->by_sums(result.at);
        return result;
    }
    /// Narrows the states at a boundary by samples, by the pass before and by what derivatives
    /// tell.
    void arrive(pass& now, std::size_t boundary, motion_reach& result,
                boundary_views& views) const {
        auto& at = now.at;
        double const t = boundary == cells_.size() ? cells_.back().to : cells_[boundary].from;
        for (std::size_t i = 0; i < at.size(); ++i) {
            if (auto const seen = sample_at(i, t)) at[i] = agreed(*seen, at[i]);
            if (now.again) at[i] = agreed(at[i], result.at[boundary][i]);
        }
        ties_->by_sums(at);
        for (std::size_t p = 0; p < pairs_.size(); ++p) {
            if (!sample_at(pairs_[p].q, t)) continue;
            now.derived[p].mark(t, at[pairs_[p].q]);
            auto& r = at[pairs_[p].r];
            auto told = now.derived[p].told();
            r = agreed(r, told.rate);
            auto& others = views[p][boundary];
            if (now.again) {
                r = agreed(r, now.forward ? derivative_bound::between(told.views, others)
                                          : derivative_bound::between(others, told.views));
            }
            others = std::move(told.views);
        }
        result.at[boundary] = at;
    }

    [[nodiscard]] std::optional<std::size_t> boundary_at(double t) const {
        auto const c = static_cast<std::size_t>(
            std::lower_bound(cells_.begin(), cells_.end(), t,
                             [](cell const& x, double v) { return x.from < v; }) -
            cells_.begin());
        double const at = c < cells_.size() ? cells_[c].from : cells_.back().to;
        return at == t ? std::optional(c) : std::nullopt;
    }
    void cut(std::vector<double> times, double spacing, experiment const& e) {
        if (times.empty() || !std::isfinite(spacing)) return;
        std::sort(times.begin(), times.end());
        double const end = times.back();
        if (!(end > e.begin)) return;
        auto const gaps = static_cast<double>(times.size());
        double const pieces = gaps > 20000 ? 1 : gaps > 5000 ? 2 : 4;
        add_knots(times, e.inputs, e.begin, end);
        auto const grid = refined_times(std::move(times), spacing / pieces);
        for (std::size_t k = 0; k + 1 < grid.size(); ++k) {
            cell c{grid[k], grid[k + 1], box(e.inputs.size()), {}};
            for (std::size_t u = 0; u < e.inputs.size(); ++u) {
                auto const& s = e.inputs[u];
                c.inputs[u] = input_around(s, c.from, c.to, k == 0);
                c.moves.push_back(input_move(s, c.from, c.to, k == 0));
            }
            cells_.push_back(std::move(c));
        }
    }

    /// Encloses a state at the end of a cell (or up to there), from its own equation as one that is
    /// linear in it, \f$ y' = g(t) + J(t) y \f$ for \f$ y = x_i - c \f$: what damps itself does
    /// not spread. Where needed, c is each end of the own range, too: what is proportional to
    /// itself does not reach 0.
    /// @param start  at the begin, @param over  all states over the cell
    /// @param lasting  how long it takes, or all times up to there
    [[nodiscard]] interval by_itself(own_rates& rates, std::size_t c, std::size_t i,
                                     interval const& start, box over,
                                     interval const& lasting) const {
        auto const f = set_.functions[i];
        auto const slope = set_.slopes[i][i];
        auto result = traits::entire();
        if (!set_.continuous[i] || !is_bounded(start)) return result;
        auto& range = rates.of.try_emplace(i, *g_, std::vector<node_id>{f, slope}).first->second;
        auto const own = over[i];
        for (double const c0 : {mid(start), own_range(i).lower(), own_range(i).upper()}) {
            if (!std::isfinite(c0)) continue;
            auto const centre = traits::point(c0);
            over[i] = hull(own, centre);
            range.evaluate(leaves(c, over));
            auto const growth = range.value(slope);
            if (range.undefined(f) || range.undefined(slope)) break;
            over[i] = centre;
            range.evaluate(leaves(c, over));
            if (range.undefined(f)) break;
            auto const carried = traits::exp(traits::mul(growth, lasting));
            auto const since = traits::mul(lasting, traits::hull(traits::point(1.0), carried));
            auto const moved = traits::add(traits::mul(carried, traits::sub(start, centre)),
                                           traits::mul(since, range.value(f)));
            result = agreed(result, traits::add(centre, moved));
            if (!rates.needed) break;
        }
        return result;
    }
    /// By Picard's iteration, into a box whose faces no motion reaches: that needs no Lipschitz
    /// condition. What does not settle is the state's own range, and what follows from that.
    /// @param known  encloses the motion over the cell, too, or nothing
    [[nodiscard]] box step(graph_range& range, own_rates& own, std::size_t c, box const& at,
                           bool forward, box const* known) const {
        auto const n = at.size();
        auto const h = forward ? length(c) : traits::neg(length(c));
        auto const time = traits::mul(traits::bounds(0.0, 1.0), h);
        box guess = at, most(n);
        for (std::size_t i = 0; i < n; ++i) {
            most[i] = hull(own_range(i), at[i]);
            guess[i] = grown(at[i], most[i]);
        }
        // A round carries what moves one state on to those that it drives. In the end each round
        // gives up one state at least.
        auto const patience = 8 + 2 * n;
        bool settled = false, given_up = false;
        for (std::size_t k = 0; !settled && k < patience + n + 2; ++k) {
            auto const rates = rates_in(range, c, guess);
            settled = true;
            given_up = k > patience;
            for (std::size_t i = 0; i < n; ++i) {
                auto const next = agreed(most[i], traits::add(at[i], traits::mul(time, rates[i])));
                auto const& g = guess[i];
                bool const below = g.lower() < next.lower() || g.lower() <= most[i].lower();
                bool const above = next.upper() < g.upper() || most[i].upper() <= g.upper();
                if (below && above) continue;
                settled = false;
                guess[i] = k > patience ? most[i] : grown(hull(next, guess[i]), most[i]);
            }
        }
        if (!settled) guess = most;
        own.needed = own.needed || given_up;
        // One step inward; more where the guess is not by Picard's iteration.
        for (int round = given_up ? 3 : 1; round > 0; --round) {
            if (known != nullptr) guess = both(guess, *known);
            auto const rates = rates_in(range, c, guess);
            for (std::size_t i = 0; i < n; ++i) {
                guess[i] = agreed(guess[i], traits::add(at[i], traits::mul(time, rates[i])));
                if (given_up && i < samples_.size())
                    guess[i] = agreed(guess[i], by_itself(own, c, i, at[i], guess, time));
            }
            ties_->by_sums(guess);
        }
        return guess;
    }
    /// By a tenth, and by more than rounding moves it: at rest at 0, by hardly anything.
    [[nodiscard]] static interval grown(interval const& x, interval const& most) {
        double const more = 0.1 * width(x) + 1e-12 * mag(x) + 1e-290;
        return agreed(most, traits::add(x, traits::bounds(-more, more)));
    }
    [[nodiscard]] std::optional<interval> sample_at(std::size_t i, double t) const {
        if (i >= samples_.size() || !samples_[i]) return std::nullopt;
        auto const& times = samples_[i]->times;
        auto const at = std::lower_bound(times.begin(), times.end(), t);
        if (at == times.end() || *at != t) return std::nullopt;
        return samples_[i]->bounds[static_cast<std::size_t>(at - times.begin())];
    }

    std::unique_ptr<graph> g_; ///< to which the set refers
    box prior_;
    std::vector<signal> inputs_;
    box initial_;
    std::vector<interval> limits_; ///< of states, then sums
    std::optional<state_ties> ties_;
    std::vector<std::optional<state_samples>> samples_;
    std::vector<derivative_pair> pairs_; ///< q is sampled, r is not
    integrand_set set_;
    std::vector<cell> cells_;
};

} // namespace sivid

#endif
