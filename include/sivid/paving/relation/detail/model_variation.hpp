// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_MODEL_VARIATION_HPP
#define SIVID_PAVING_RELATION_DETAIL_MODEL_VARIATION_HPP

#include <sivid/model/bound_model.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/relation/channel_tube.hpp>
#include <sivid/paving/relation/detail/motion_cells.hpp>
#include <sivid/paving/relation/detail/rate_stretch.hpp>
#include <sivid/paving/relation/state_samples.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// How much a model's own rates may vary within a sampling gap of one experiment, for any
/// parameter of a prior: a proof of what else is declared, and what a declared variation must not
/// be below, or the model contradicts it.
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
    /// @param believed  whether states of which nothing else is known keep their own ranges; else
    ///                  nothing is assumed
    /// @param sums      of states of the model, by which they are enclosed, too
    model_variation(bound_model const& model, box const& prior, experiment const& e,
                    std::vector<std::optional<std::size_t>> const& channels, bool believed = true,
                    std::vector<state_sum> const& sums = {})
        : cells_(model, prior, e, channels, believed, sums) {}

    [[nodiscard]] motion_cells const& cells() const { return cells_; }
    /// Encloses the motions, which are known at the samples of all states from now on.
    [[nodiscard]] motion_reach enclose() {
        auto result = cells_.enclosures();
        cells_.add_derived_samples(result);
        return result;
    }

    /// For each measured state something for each of its gaps, or one thing.
    using amounts = std::vector<std::vector<double>>;

    /// Over all motions of the model that keep the bounds of the measured states, for any parameter
    /// of the prior; by enclosures over each gap from both of its ends. States of which nothing is
    /// known stay within their own range.
    /// @param periods  one per state: the length of the windows
    [[nodiscard]] std::vector<double> of_model(std::vector<double> const& periods) const {
        auto const measure = [&](std::vector<box> const& states, std::vector<box> const& rates) {
            amounts result;
            for (double const v : variations(states, rates, periods)) result.push_back({v});
            return result;
        };
        auto const in_gaps = [&](amounts const& of_states) {
            std::vector<double> most;
            for (auto const& v : of_states) most.push_back(v[0]);
            return in_gaps_of(most, periods);
        };
        std::vector<double> result;
        for (auto const& v : settled(cells_.enclosures().over, measure, in_gaps))
            result.push_back(v[0]);
        return result;
    }
    /// The same in each gap between two samples of a state; infinite where not known.
    [[nodiscard]] amounts of_gaps(std::vector<box> const& reach) const {
        auto const measure = [&](std::vector<box> const& states, std::vector<box> const& rates) {
            auto const all = stretches(states, rates);
            amounts result(cells_.samples().size());
            for (std::size_t i = 0; i < result.size(); ++i) {
                if (!cells_.samples()[i]) continue;
                auto const& t = cells_.samples()[i]->times;
                for (std::size_t k = 0; k + 1 < t.size(); ++k) {
                    result[i].push_back(most_change(all[i], t[k], t[k + 1]));
                }
            }
            return result;
        };
        return settled(
            reach, measure, [](amounts const& of_gaps) { return of_gaps; }, 1);
    }
    /// For each state whose rate is another state, where the rate of that lies in each gap between
    /// two samples; nothing for the others.
    [[nodiscard]] std::vector<std::vector<interval>>
    curvatures(std::vector<box> const& reach) const {
        auto const& set = cells_.set();
        std::vector<std::vector<interval>> result(cells_.samples().size());
        struct bent {
            std::size_t q, r, gap = 0;
        };
        std::vector<bent> all;
        for (std::size_t q = 0; q < result.size(); ++q) {
            auto const& rate = (*set.g)[set.functions[q]];
            if (rate.op != operation::state || !cells_.samples()[q]) continue;
            result[q].assign(cells_.samples()[q]->times.size() - 1, traits::empty());
            all.push_back({q, static_cast<std::size_t>(rate.index)});
        }
        auto range = cells_.range_of_rates();
        for (std::size_t c = 0; c < cells_.size() && !all.empty(); ++c) {
            auto const rates = cells_.rates_in(range, c, reach[c]);
            for (auto& [q, r, gap] : all) {
                auto const& t = cells_.samples()[q]->times;
                if (cells_[c].from < t.front() || t.back() < cells_[c].to) continue;
                while (t[gap + 1] <= cells_[c].from) ++gap;
                result[q][gap] = hull(result[q][gap], rates[r]);
            }
        }
        return result;
    }
    /// Over all states of the tubes that declared variations leave, whose rates are as far from the
    /// secants as those allow: whatever the other equations do.
    [[nodiscard]] std::vector<double> in_tubes(std::vector<double> const& declared,
                                               std::vector<double> const& periods) const {
        std::vector<box> rates;
        auto range = cells_.range_of_rates();
        auto const in_gaps = in_gaps_of(declared, periods);
        auto const tube = within({}, in_gaps);
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            auto r = slopes_of_data(c, in_gaps);
            auto const own = cells_.rates_in(range, c, tube[c]);
            for (std::size_t i = 0; i < r.size(); ++i) {
                if (!cells_.samples()[i] || !is_bounded(r[i])) r[i] = own[i];
            }
            rates.push_back(std::move(r));
        }
        return variations(tube, rates, periods);
    }

private:
    /// What variations over windows of one length say of the gaps.
    [[nodiscard]] amounts in_gaps_of(std::vector<double> const& declared,
                                     std::vector<double> const& periods) const {
        amounts result(cells_.samples().size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            if (!cells_.samples()[i]) continue;
            result[i] =
                channel_tube::in_gaps({periods[i], declared[i]}, cells_.samples()[i]->times);
        }
        return result;
    }
    /// Variations as `measure` finds them in the enclosures, then again and again in the tubes that
    /// they leave.
    /// @param in_gaps  what they say of each gap
    template <class Measure, class InGaps>
    [[nodiscard]] amounts settled(std::vector<box> const& reach, Measure const& measure,
                                  InGaps const& in_gaps, int passes = 4) const {
        std::vector<box> rates;
        auto range = cells_.range_of_rates();
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            rates.push_back(cells_.rates_in(range, c, reach[c]));
        }
        auto result = measure(reach, rates);
        for (int pass = 0; pass < passes; ++pass) {
            auto const known = in_gaps(result);
            auto const tube = within(reach, known);
            for (std::size_t c = 0; c < cells_.size(); ++c) {
                rates[c] = motion_cells::both(slopes_of_data(c, known),
                                              cells_.rates_in(range, c, tube[c]));
            }
            auto const better = measure(tube, rates);
            bool gained = false;
            for (std::size_t i = 0; i < result.size(); ++i) {
                for (std::size_t k = 0; k < result[i].size(); ++k) {
                    gained = gained || better[i][k] < 0.95 * result[i][k];
                    result[i][k] = std::min(result[i][k], better[i][k]);
                }
            }
            if (!gained) break;
        }
        return result;
    }
    /// The secant of the gap in which cell c lies, and what the rate may be off it.
    [[nodiscard]] box slopes_of_data(std::size_t c, amounts const& in_gaps) const {
        box result(cells_.samples().size());
        for (std::size_t i = 0; i < result.size(); ++i) {
            result[i] = traits::entire();
            if (!cells_.samples()[i]) continue;
            auto const& t = cells_.samples()[i]->times;
            auto const after = std::upper_bound(t.begin(), t.end(), cells_[c].from);
            if (after == t.begin() || after == t.end()) continue;
            auto const k = static_cast<std::size_t>(after - t.begin());
            double const off = in_gaps[i][k - 1];
            if (!std::isfinite(off)) continue;
            auto const& b = cells_.samples()[i]->bounds;
            bool undefined = false;
            auto const gap = traits::sub(traits::point(t[k]), traits::point(t[k - 1]));
            result[i] = traits::add(traits::div(traits::sub(b[k], b[k - 1]), gap, undefined),
                                    traits::bounds(-off, off));
        }
        return result;
    }
    /// The tubes of measured states over each cell; where there is none, `reach`, or the state's
    /// own range without one.
    [[nodiscard]] std::vector<box> within(std::vector<box> const& reach,
                                          amounts const& in_gaps) const {
        auto const n = cells_.samples().size();
        std::vector<std::optional<channel_tube>> tubes(n);
        for (std::size_t i = 0; i < n; ++i) {
            if (cells_.samples()[i])
                tubes[i] = channel_tube::of_gaps(cells_.samples()[i]->times,
                                                 cells_.samples()[i]->bounds, in_gaps[i]);
        }
        std::vector<box> result;
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            double const from = cells_[c].from;
            double const to = cells_[c].to;
            box x(n);
            for (std::size_t i = 0; i < n; ++i) {
                x[i] = reach.empty() ? cells_.own_range(i) : reach[c][i];
                if (!tubes[i] || !tubes[i]->covers(from, to)) continue;
                auto const seen = tubes[i]->over(from, to);
                if (!is_bounded(seen)) continue;
                x[i] = reach.empty() ? seen : agreed(seen, x[i]);
            }
            result.push_back(std::move(x));
        }
        return result;
    }

    /// How much the rate of each measured state varies at most over windows of its length, for
    /// every parameter; infinite where that is not known.
    [[nodiscard]] std::vector<double> variations(std::vector<box> const& states,
                                                 std::vector<box> const& rates,
                                                 std::vector<double> const& periods) const {
        auto const n = cells_.samples().size();
        auto const all = stretches(states, rates);
        std::vector<double> result(n, HUGE_VAL);
        for (std::size_t i = 0; i < n && cells_.size() > 0; ++i) {
            if (cells_.samples()[i]) result[i] = most_change(all[i], periods[i]);
        }
        return result;
    }
    /// What the rate of each measured state may do in the cells between its samples.
    [[nodiscard]] std::vector<std::vector<rate_stretch>>
    stretches(std::vector<box> const& states, std::vector<box> const& rates) const {
        auto const n = cells_.samples().size();
        auto nodes = cells_.set().functions;
        for (auto const& row : cells_.set().slopes)
            nodes.insert(nodes.end(), row.begin(), row.end());
        graph_range range(*cells_.set().g, nodes);
        std::vector<std::vector<rate_stretch>> all(n);
        for (std::size_t c = 0; c < cells_.size(); ++c) {
            range.evaluate(cells_.leaves(c, states[c]));
            for (std::size_t i = 0; i < n; ++i) {
                // A state's own samples are among the ends of cells.
                bool const seen = cells_.samples()[i] &&
                                  cells_.samples()[i]->times.front() <= cells_[c].from &&
                                  cells_[c].to <= cells_.samples()[i]->times.back();
                if (seen) all[i].push_back(stretch_of(range, i, c, rates[c]));
            }
        }
        return all;
    }
    [[nodiscard]] rate_stretch stretch_of(graph_range const& range, std::size_t i, std::size_t c,
                                          box const& rates) const {
        auto const n = cells_.samples().size();
        auto const f = cells_.set().functions[i];
        rate_stretch result{cells_[c].from, cells_[c].to};
        result.range = range.undefined(f) ? traits::entire() : range.value(f);
        bool smooth = cells_.set().continuous[i] && !range.undefined(f);
        auto const h = cells_.length(c);
        auto steady = traits::point(0.0), sudden = traits::point(0.0);
        for (std::size_t k = 0; smooth && k < cells_.set().slopes[i].size(); ++k) {
            auto const d = cells_.set().slopes[i][k];
            if (cells_.set().g->is(d, 0)) continue;
            auto const& slope = range.value(d);
            smooth = !range.undefined(d) && is_bounded(slope);
            if (k < n) {
                smooth = smooth && is_bounded(rates[k]);
                steady = traits::add(steady, traits::mul(slope, traits::mul(h, rates[k])));
            } else if (k < n + cells_.inputs().size()) {
                auto const u = k - n;
                auto const* sampled = std::get_if<sampled_signal>(&cells_.inputs()[u]);
                bool const straight = sampled != nullptr && sampled->exact() &&
                                      sampled->kind() == interpolation::linear;
                auto const moved = traits::mul(slope, cells_[c].moves[u]);
                (straight ? steady : sudden) = traits::add(straight ? steady : sudden, moved);
            } else {
                steady = traits::add(steady, traits::mul(slope, h));
            }
        }
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
    motion_cells cells_;
};

} // namespace sivid

#endif
