// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_RELATION_DETAIL_MODEL_VARIATION_HPP
#define SIVID_DIAGNOSIS_RELATION_DETAIL_MODEL_VARIATION_HPP

#include <sivid/diagnosis/relation/channel_tube.hpp>
#include <sivid/diagnosis/relation/detail/rate_stretch.hpp>
#include <sivid/diagnosis/relation/input_range.hpp>
#include <sivid/diagnosis/relation/integrand_set.hpp>
#include <sivid/diagnosis/relation/state_samples.hpp>
#include <sivid/diagnosis/relation/time_grid.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/graph_range.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// How much a model's own rates may vary within a sampling gap of one experiment, for any
/// parameter of a prior: what a declared variation must not be below, or the model contradicts it.
///   Over a cell of time \f$ f_i \f$ moves by at most the sum of \f$ |\partial f_i/\partial x_k|
///   \f$ times what \f$ x_k \f$ moves, the same for inputs (their whole range between samples,
///   jumps of held ones included) and time, all with signs; over a window, by what its cells add up
///   to in one direction, and by no more than the width of the range of \f$ f_i \f$ there. Windows
///   are all those of one length, wherever they begin.
/// @cost  some ten evaluations of the graph with its derivatives for each cell
class model_variation {
    using traits = interval_traits<interval>;

public:
    /// @param model     with its inputs as leaves
    /// @param channels  that show the states
    model_variation(bound_model const& model, box const& prior, experiment const& e,
                    std::vector<std::optional<std::size_t>> const& channels)
        : g_(model.g), prior_(prior), inputs_(e.inputs) {
        auto const n = model.state_count();
        for (auto const& s : model.about.states) limits_.push_back(s.limit);
        std::vector<double> times;
        double period = HUGE_VAL;
        samples_.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            if (!channels[i]) continue;
            samples_[i] = state_samples::of(e, i, *channels[i]);
            auto const& own = samples_[i]->times;
            times.insert(times.end(), own.begin(), own.end());
            if (own.size() > 1) period = std::min(period, samples_[i]->period());
        }
        set_ = integrand_set::of(g_, model.rate, n, e.inputs.size());
        cut(std::move(times), period, e);
    }

    /// How much rates vary over windows of their length, per measured state.
    struct bounds {
        std::vector<double> most;  ///< at most, for every parameter; infinite where not known
        std::vector<double> least; ///< at least, for every parameter: proved where the model holds
    };

    /// Over all motions of the model that keep the bounds of the measured states, for any parameter
    /// of the prior; by enclosures over each gap from both of its ends. States of which nothing is
    /// known stay within their own range.
    /// @param periods  one per state: the length of the windows
    [[nodiscard]] std::vector<double> of_model(std::vector<double> const& periods) const {
        auto const reach = enclosures();
        std::vector<box> rates;
        graph_range range(g_, set_.functions);
        for (std::size_t c = 0; c < cells_.size(); ++c)
            rates.push_back(rates_in(range, c, reach[c]));
        auto result = variations(reach, rates, periods).most;
        for (int pass = 0; pass < 4; ++pass) {
            auto const tube = within(reach, result, periods);
            for (std::size_t c = 0; c < cells_.size(); ++c) {
                rates[c] = both(rates_in(range, c, tube[c]), slopes_of_data(c, result, periods));
            }
            auto const better = variations(tube, rates, periods).most;
            bool gained = false;
            for (std::size_t i = 0; i < result.size(); ++i) {
                gained = gained || better[i] < 0.95 * result[i];
                result[i] = std::min(result[i], better[i]);
            }
            if (!gained) break;
        }
        return result;
    }

    /// Over all states of the tubes that declared variations leave, whose rates are as far from the
    /// secants as those allow: whatever the other equations do.
    [[nodiscard]] bounds in_tubes(std::vector<double> const& declared,
                                  std::vector<double> const& periods) const {
        std::vector<box> rates;
        graph_range range(g_, set_.functions);
        auto const tube = within({}, declared, periods);
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            auto r = slopes_of_data(c, declared, periods);
            auto const own = rates_in(range, c, tube[c]);
            for (std::size_t i = 0; i < r.size(); ++i) {
                if (!samples_[i] || !is_bounded(r[i])) r[i] = own[i];
            }
            rates.push_back(std::move(r));
        }
        return variations(tube, rates, periods);
    }

private:
    struct cell {
        double from = 0, to = 0;
        box inputs;                  ///< over the whole cell, and before a jump at its begin
        std::vector<interval> moves; ///< of the inputs from any time in it to any later one
    };

    void cut(std::vector<double> times, double period, experiment const& e) {
        if (times.empty() || !std::isfinite(period)) return;
        std::sort(times.begin(), times.end());
        double const end = times.back();
        if (!(end > e.begin)) return;
        auto const gaps = static_cast<double>(times.size());
        double const pieces = gaps > 20000 ? 1 : gaps > 5000 ? 2 : 4;
        for (auto const& u : e.inputs) {
            auto const* sampled = std::get_if<sampled_signal>(&u);
            if (sampled == nullptr) continue;
            for (double const t : sampled->times()) {
                if (t > e.begin && t < end) times.push_back(t);
            }
        }
        auto const grid = refined_times(std::move(times), period / pieces);
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

    [[nodiscard]] interval own_range(std::size_t i) const {
        return traits::bounds(-limits_[i], limits_[i]);
    }
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
    /// The secant of the gap in which cell c lies, and what the rate may be off it.
    [[nodiscard]] box slopes_of_data(std::size_t c, std::vector<double> const& declared,
                                     std::vector<double> const& periods) const {
        box result(samples_.size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i] = traits::entire();
            if (!samples_[i] || !std::isfinite(declared[i])) continue;
            auto const& t = samples_[i]->times;
            auto const after = std::upper_bound(t.begin(), t.end(), cells_[c].from);
            if (after == t.begin() || after == t.end()) continue;
            auto const k = static_cast<std::size_t>(after - t.begin());
            double const gap = t[k] - t[k - 1];
            double const off =
                declared[i] * std::max(1.0, std::ceil(gap / periods[i] * (1 - 1e-9)));
            auto const& b = samples_[i]->bounds;
            result[i] = (b[k] - b[k - 1]) / gap + traits::bounds(-off, off);
        }
        return result;
    }
    /// Where both say something that agrees; the second one where they do not.
    [[nodiscard]] static box both(box const& a, box const& b) {
        box result = b;
        for (std::size_t i = 0; i < b.size(); ++i) {
            auto const common = intersect(a[i], b[i]);
            if (!is_empty(common)) result[i] = common;
        }
        return result;
    }

    /// The tubes of measured states over each cell; where there is none, `reach`, or the state's
    /// own range without one.
    [[nodiscard]] std::vector<box> within(std::vector<box> const& reach,
                                          std::vector<double> const& declared,
                                          std::vector<double> const& periods) const {
        auto const n = samples_.size();
        std::vector<std::optional<channel_tube>> tubes(n);
        for (std::size_t i = 0; i < n; ++i) {
            if (!samples_[i] || !std::isfinite(declared[i])) continue;
            tubes[i].emplace(samples_[i]->times, samples_[i]->bounds,
                             rate_variation{periods[i], declared[i]});
        }
        std::vector<box> result;
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            double const from = cells_[c].from;
            double const to = cells_[c].to;
            box x(n);
            for (std::size_t i = 0; i < n; ++i) {
                x[i] = reach.empty() ? own_range(i) : reach[c][i];
                if (!tubes[i] || !tubes[i]->covers(from, to)) continue;
                auto const seen = tubes[i]->over(from, to);
                auto const common = reach.empty() ? seen : intersect(seen, x[i]);
                x[i] = is_empty(common) ? seen : common;
            }
            result.push_back(std::move(x));
        }
        return result;
    }

    /// Encloses the model's motions over each cell, from the samples before and from those after.
    [[nodiscard]] std::vector<box> enclosures() const {
        graph_range range(g_, set_.functions);
        auto const n = samples_.size();
        auto const count = cells_.size();
        std::vector<box> result(count, box(n));
        for (bool const forward : {true, false}) {
            box at(n);
            for (std::size_t i = 0; i < n; ++i) at[i] = own_range(i);
            for (std::size_t s = 0; s < count; ++s) {
                auto const c = forward ? s : count - 1 - s;
                double const t = forward ? cells_[c].from : cells_[c].to;
                for (std::size_t i = 0; i < n; ++i) {
                    if (auto const seen = sample_at(i, t)) {
                        auto const common = intersect(at[i], *seen);
                        at[i] = is_empty(common) ? *seen : common;
                    }
                }
                auto const over = step(range, c, at, forward ? 1.0 : -1.0);
                auto const rates = rates_in(range, c, over);
                auto const length = signed_length(c, forward);
                for (std::size_t i = 0; i < n; ++i) {
                    auto const moved = traits::add(at[i], traits::mul(length, rates[i]));
                    auto const common = intersect(moved, over[i]);
                    at[i] = is_empty(common) ? over[i] : common;
                    auto& known = result[c][i];
                    auto const agreed = forward ? over[i] : intersect(known, over[i]);
                    known = is_empty(agreed) ? hull(known, over[i]) : agreed;
                }
            }
        }
        return result;
    }
    [[nodiscard]] interval signed_length(std::size_t c, bool forward) const {
        auto const h = traits::sub(traits::point(cells_[c].to), traits::point(cells_[c].from));
        return forward ? h : traits::neg(h);
    }
    /// By Picard's iteration; what does not settle is the state's own range.
    [[nodiscard]] box step(graph_range& range, std::size_t c, box const& at, double sign) const {
        auto const n = at.size();
        auto const time = traits::mul(traits::bounds(0.0, 1.0), signed_length(c, sign > 0));
        box guess = at;
        for (int k = 0; k < 12; ++k) {
            auto const rates = rates_in(range, c, guess);
            bool inside = true;
            for (std::size_t i = 0; i < n; ++i) {
                auto next = traits::add(at[i], traits::mul(time, rates[i]));
                auto const most = hull(own_range(i), at[i]);
                auto const clipped = intersect(next, most);
                next = is_empty(clipped) ? most : clipped;
                if (subset(next, guess[i])) continue;
                inside = false;
                auto const wide = hull(next, guess[i]);
                double const more = 0.1 * width(wide) + 1e-12;
                guess[i] = k > 8 ? most : intersect(wide + traits::bounds(-more, more), most);
            }
            if (inside) break;
        }
        // One step inward.
        auto const rates = rates_in(range, c, guess);
        for (std::size_t i = 0; i < n; ++i) {
            auto const common =
                intersect(guess[i], traits::add(at[i], traits::mul(time, rates[i])));
            if (!is_empty(common)) guess[i] = common;
        }
        return guess;
    }
    [[nodiscard]] std::optional<interval> sample_at(std::size_t i, double t) const {
        if (!samples_[i]) return std::nullopt;
        auto const& times = samples_[i]->times;
        auto const at = std::lower_bound(times.begin(), times.end(), t);
        if (at == times.end() || *at != t) return std::nullopt;
        return samples_[i]->bounds[static_cast<std::size_t>(at - times.begin())];
    }

    [[nodiscard]] bounds variations(std::vector<box> const& states, std::vector<box> const& rates,
                                    std::vector<double> const& periods) const {
        auto const n = samples_.size();
        auto nodes = set_.functions;
        for (auto const& row : set_.slopes) nodes.insert(nodes.end(), row.begin(), row.end());
        graph_range range(g_, nodes);
        std::vector<std::vector<rate_stretch>> all(n);
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            range.evaluate(leaves(c, states[c]));
            for (std::size_t i = 0; i < n; ++i) {
                // A state's own samples are among the ends of cells.
                bool const seen = samples_[i] && samples_[i]->times.front() <= cells_[c].from &&
                                  cells_[c].to <= samples_[i]->times.back();
                if (seen) all[i].push_back(stretch_of(range, i, c, rates[c]));
            }
        }
        bounds result{std::vector<double>(n, HUGE_VAL), std::vector<double>(n, 0.0)};
        for (std::size_t i = 0; i < n && !cells_.empty(); ++i) {
            if (!samples_[i]) continue;
            result.most[i] = most_change(all[i], periods[i]);
            result.least[i] = least_change(all[i], periods[i]);
        }
        return result;
    }
    [[nodiscard]] rate_stretch stretch_of(graph_range const& range, std::size_t i, std::size_t c,
                                          box const& rates) const {
        auto const n = samples_.size();
        auto const f = set_.functions[i];
        rate_stretch result{cells_[c].from, cells_[c].to};
        result.range = range.undefined(f) ? traits::entire() : range.value(f);
        bool smooth = set_.continuous[i] && !range.undefined(f);
        auto const h = signed_length(c, true);
        auto steady = traits::point(0.0), sudden = traits::point(0.0);
        for (std::size_t k = 0; smooth && k < set_.slopes[i].size(); ++k) {
            auto const d = set_.slopes[i][k];
            if (g_.is(d, 0)) continue;
            auto const& slope = range.value(d);
            smooth = !range.undefined(d) && is_bounded(slope);
            if (k < n) {
                smooth = smooth && is_bounded(rates[k]);
                steady = traits::add(steady, traits::mul(slope, traits::mul(h, rates[k])));
            } else if (k < n + inputs_.size()) {
                auto const u = k - n;
                auto const* sampled = std::get_if<sampled_signal>(&inputs_[u]);
                bool const straight = sampled != nullptr && sampled->exact() &&
                                      sampled->kind() == interpolation::linear;
                auto const moved = traits::mul(slope, cells_[c].moves[u]);
                (straight ? steady : sudden) = traits::add(straight ? steady : sudden, moved);
            } else {
                steady = traits::add(steady, traits::mul(slope, h));
            }
        }
        result.net = smooth ? traits::add(steady, sudden) : traits::entire();
        if (!smooth) {
            result.up = result.down = HUGE_VAL;
            return result;
        }
        auto const above = [](interval const& x) { return std::max(x.upper(), 0.0); };
        auto const below = [](interval const& x) { return std::max(-x.lower(), 0.0); };
        result.rise = above(steady);
        result.fall = below(steady);
        result.up = above(sudden);
        result.down = below(sudden);
        return result;
    }
    graph g_;
    box prior_;
    std::vector<signal> inputs_;
    std::vector<double> limits_;
    std::vector<std::optional<state_samples>> samples_;
    integrand_set set_;
    std::vector<cell> cells_;
};

} // namespace sivid

#endif
