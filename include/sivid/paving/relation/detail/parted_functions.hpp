// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RELATION_DETAIL_PARTED_FUNCTIONS_HPP
#define SIVID_PAVING_RELATION_DETAIL_PARTED_FUNCTIONS_HPP

#include <sivid/model/graph/graph_range.hpp>
#include <sivid/paving/relation/detail/cell_means.hpp>
#include <sivid/paving/relation/detail/observed_motion.hpp>
#include <sivid/paving/relation/integrand_set.hpp>
#include <sivid/paving/relation/time_cell.hpp>
#include <sivid/work_clock.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// Functions along a motion in two parts. One is linear in states q that are sampled and in q' and
/// q'', with factors that are numbers at the samples and straight in between; the other is what is
/// left over, enclosed cell by cell about the middle of what is known,
///   \f[ \psi - \sum_k X_k y_k \in \psi(c) - \sum_k X_k c_k
///      + \sum_k (\partial\psi/\partial y_k - X_k)(y_k - c_k), \f]
/// or from its range, and integrated over each gap between samples.
/// @guarantee  holds for every motion in the cells whose rates lie in `rates`
/// @cost  two evaluations of the graph a cell
class parted_functions {
    using traits = interval_traits<interval>;

public:
    /// A leaf that is q itself, its first or its second rate.
    struct part {
        std::size_t leaf = 0, q = 0, order = 0;
    };
    /// Under the weight 1 and under one that rises from 0 to 1 over the gap: of these each weight
    /// consists, and the second has a small share. What multiplies a part is then linear between
    /// its values at the ends, or the value at the end.
    using two_weights = std::array<interval, 2>;

    /// @param set    functions of states, inputs with the rates behind them, and time: \f$ \psi_1,
    ///               ..., \psi_0 \f$, then \f$ \psi_0 + \sum_j \bar\theta_j \psi_j \f$
    /// @param centre \f$ \bar\theta_j \f$
    /// @param rates  enclose the rates over each cell
    /// @param own    a state that is sampled: at its samples the parts are
    /// @param pairs  \f$ q' = r \f$ with q sampled and r not
    parted_functions(integrand_set const& set, std::vector<double> const& centre,
                     observed_motion const& motion, std::vector<box> const& rates, std::size_t own,
                     std::vector<derivative_pair> const& pairs)
        : motion_(&motion), centre_(centre), states_(set.states), inputs_(set.inputs - set.states) {
        auto const& tube = motion.tubes[own];
        if (!tube || tube->times().size() < 3) return;
        for (double const t : tube->times()) { // lest a cell lie on both sides of a sample
            auto const k = motion.boundary_at(t);
            if (k == motion.boundaries.size() || motion.boundaries[k] != t) return;
        }
        times_ = tube->times();
        for (std::size_t q = 0; q < set.states; ++q) {
            if (motion.sensed[q] && motion.tubes[q]->times() == times_) add_parts(set, q, pairs);
        }
        find_samples();
        enclose(set, rates);
    }

    [[nodiscard]] observed_motion const& motion() const { return *motion_; }
    /// Empty where nothing is known.
    [[nodiscard]] std::vector<double> const& times() const { return times_; }
    [[nodiscard]] std::vector<part> const& parts() const { return parts_; }
    [[nodiscard]] std::size_t functions() const { return rest_.size(); }
    [[nodiscard]] std::size_t states() const { return states_; }
    /// The state whose rate a part of second order is the rate of.
    [[nodiscard]] std::size_t rate_of(part const& p) const { return p.leaf - rate(0); }
    /// What multiplies part p of function j at sample k.
    [[nodiscard]] double factor(std::size_t j, std::size_t p, std::size_t k) const {
        return slope_[j][p][k];
    }
    /// The integral of what is left over in a gap.
    [[nodiscard]] two_weights const& rest(std::size_t j, std::size_t gap) const {
        return rest_[j][gap];
    }
    /// Where a state lies at sample k.
    [[nodiscard]] interval const& sample(std::size_t q, std::size_t k) const {
        return sample_[q][k];
    }

private:
    struct in_cell {
        two_weights mean;              ///< of what is left of a function
        std::array<double, 2> swing{}; ///< at most so far from some number
    };
    /// Of a cell's ends and of its middle, where they lie in the gap.
    struct places {
        interval from, to, middle;
    };

    /// The leaf of \f$ x_k' \f$: input number `inputs + k`.
    [[nodiscard]] std::size_t rate(std::size_t k) const { return states_ + inputs_ + k; }

    void add_parts(integrand_set const& set, std::size_t q,
                   std::vector<derivative_pair> const& pairs) {
        auto const add = [&](std::size_t leaf, std::size_t order) {
            auto const same = [leaf](part const& p) { return p.leaf == leaf; };
            if (std::any_of(parts_.begin(), parts_.end(), same)) return; // of another q with this r
            for (std::size_t j = 0; j < set.functions.size(); ++j) {
                if (!set.uses(j, leaf)) continue;
                parts_.push_back({leaf, q, order});
                return;
            }
        };
        add(q, 0);
        add(rate(q), 1);
        for (auto const& p : pairs) {
            if (p.q != q) continue;
            add(p.r, 1);
            add(rate(p.r), 2);
        }
    }

    [[nodiscard]] leaf_ranges ranges_in(time_cell const& cell, box const& rates) const {
        auto at = cell.at;
        box inputs(inputs_ + rates.size());
        for (std::size_t k = 0; k < inputs_; ++k) inputs[k] = at.inputs[k];
        for (std::size_t k = 0; k < rates.size(); ++k) inputs[inputs_ + k] = rates[k];
        at.inputs = std::move(inputs);
        return at;
    }
    [[nodiscard]] cell_line line_of(time_cell const& cell, box const& rates, std::size_t k) const {
        if (k < states_ + inputs_) return cell.lines[k];
        if (k < rate(0) + rates.size()) return cell_line::still(rates[k - rate(0)]);
        return cell.lines.back();
    }
    /// The leaves at the centres of their lines.
    [[nodiscard]] static leaf_ranges centre_of(leaf_ranges at,
                                               std::vector<cell_line> const& lines) {
        auto const n = at.states.size(), m = at.inputs.size();
        for (std::size_t k = 0; k < n; ++k) at.states[k] = traits::point(lines[k].centre);
        for (std::size_t k = 0; k < m; ++k) at.inputs[k] = traits::point(lines[n + k].centre);
        at.time = traits::point(lines.back().centre);
        return at;
    }

    /// The states at the samples, from those and from what the cells at both sides know.
    void find_samples() {
        sample_.resize(states_);
        for (auto const& p : parts_) {
            auto& own = sample_[p.q];
            if (!own.empty()) continue;
            for (std::size_t k = 0; k < times_.size(); ++k)
                own.push_back(motion_->tubes[p.q]->bound(k));
            for (auto const& cell : motion_->cells) {
                for (double const t : {cell.from, cell.to}) {
                    auto const at = std::lower_bound(times_.begin(), times_.end(), t);
                    if (at == times_.end() || *at != t) continue;
                    auto& known = own[static_cast<std::size_t>(at - times_.begin())];
                    known = agreed(known, cell.at.states[p.q]);
                }
            }
        }
    }

    void enclose(integrand_set const& set, std::vector<box> const& rates) {
        auto const count = set.functions.size();
        auto nodes = set.functions;
        for (auto const& row : set.slopes) nodes.insert(nodes.end(), row.begin(), row.end());
        graph_range natural(*set.g, nodes), centred(*set.g, nodes);
        auto const gaps = times_.size() - 1;
        rest_.assign(count,
                     std::vector<two_weights>(gaps, {traits::point(0.0), traits::point(0.0)}));
        slope_.assign(count, std::vector<std::vector<double>>(
                                 parts_.size(), std::vector<double>(times_.size(), 0.0)));
        auto const& cells = motion_->cells;
        auto const lines_in = [&](std::size_t c) {
            std::vector<cell_line> result;
            for (std::size_t k = 0; k < rate(0) + rates[c].size() + 1; ++k)
                result.push_back(line_of(cells[c], rates[c], k));
            return result;
        };
        // What multiplies the parts at the samples.
        std::size_t c = 0;
        for (std::size_t k = 0; k < times_.size(); ++k) {
            while (c + 1 < cells.size() && cells[c].from < times_[k]) ++c;
            auto const at = ranges_in(cells[c], rates[c]);
            natural.evaluate(at);
            for (std::size_t p = 0; p < parts_.size(); ++p) {
                auto& sum = slope_[count - 1][p][k];
                for (std::size_t j = 0; j + 1 < count; ++j) {
                    // Where a function is steep for a moment its range says more.
                    auto const leaf = parts_[p].leaf;
                    auto const& slope = natural.value(set.slopes[j][leaf]);
                    double const open = rad(leaf_over(at, leaf, set.states, set.inputs));
                    bool const steep = rad(slope) * open > rad(natural.value(set.functions[j]));
                    if (is_bounded(slope) && !steep) slope_[j][p][k] = mid(slope);
                    sum += (j < centre_.size() ? centre_[j] : 1.0) * slope_[j][p][k];
                }
            }
        }
        std::size_t gap = 0;
        for (c = 0; c < cells.size(); ++c) {
            auto const& cell = cells[c];
            if (cell.from < times_.front() || times_.back() < cell.to) continue;
            while (times_[gap + 1] <= cell.from) ++gap;
            auto const at = ranges_in(cell, rates[c]);
            auto const own = lines_in(c);
            natural.evaluate(at);
            centred.evaluate(centre_of(at, own));
            std::vector<in_cell> found;
            for (std::size_t j = 0; j < count; ++j)
                found.push_back(left_over(set, j, gap, cell, at, own, natural, centred));
            sharpen_sum(set, gap, at, found);
            add_cell(gap, cell, found);
        }
    }

    [[nodiscard]] places places_of(std::size_t gap, time_cell const& cell) const {
        bool undefined = false;
        auto const whole = traits::sub(traits::point(times_[gap + 1]), traits::point(times_[gap]));
        auto const place = [&](double t) {
            auto const since = traits::sub(traits::point(t), traits::point(times_[gap]));
            return traits::intersect(traits::div(since, whole, undefined),
                                     traits::bounds(0.0, 1.0));
        };
        auto const from = place(cell.from), to = place(cell.to);
        return {from, to, traits::mul(traits::point(0.5), traits::add(from, to))};
    }

    [[nodiscard]] in_cell left_over(integrand_set const& set, std::size_t j, std::size_t gap,
                                    time_cell const& cell, leaf_ranges const& at,
                                    std::vector<cell_line> const& lines, graph_range const& natural,
                                    graph_range const& centred) const {
        work_clock::count(4 * (lines.size() + 2), work_clock::interval);
        auto const f = set.functions[j];
        bool smooth = set.continuous[j] && !natural.undefined(f);
        auto mean = centred.value(f);
        auto swing = traits::point(width(mean));
        auto const range_of_leaf = [&](std::size_t k) -> interval const& {
            return leaf_over(at, k, set.states, set.inputs);
        };
        auto const is_part = [&](std::size_t k) {
            return std::any_of(parts_.begin(), parts_.end(),
                               [k](part const& p) { return p.leaf == k; });
        };
        auto const moved = [&](interval const& slope, std::size_t k) {
            auto const off = traits::sub(range_of_leaf(k), traits::point(lines[k].centre));
            return traits::mul(traits::point(mag(slope)), traits::point(mag(off)));
        };
        for (std::size_t k = 0; k < lines.size() && smooth; ++k) {
            if (!set.uses(j, k)) continue;
            auto const& slope = natural.value(set.slopes[j][k]);
            smooth = !natural.undefined(set.slopes[j][k]) && is_bounded(slope) &&
                     is_bounded(range_of_leaf(k));
            if (!smooth || is_part(k)) continue;
            mean = traits::add(mean, mean_product(slope, lines[k]));
            swing = traits::add(swing, moved(slope, k));
        }
        auto const [from, to, middle] = places_of(gap, cell);
        in_cell result;
        for (std::size_t const rising : {0U, 1U}) {
            auto plain = natural.undefined(f) ? traits::entire() : natural.value(f);
            auto fine = mean;
            auto swung = swing;
            for (std::size_t p = 0; p < parts_.size(); ++p) {
                auto const k = parts_[p].leaf;
                bool const taken = slope_[j][p][gap] != 0 || slope_[j][p][gap + 1] != 0;
                if (!set.uses(j, k) && !taken) continue; // terms may cancel, numbers not quite
                smooth = smooth && is_bounded(range_of_leaf(k));
                auto const first = traits::point(slope_[j][p][gap + rising]);
                auto const change = traits::sub(traits::point(slope_[j][p][gap + 1]), first);
                auto const at_from = traits::add(first, traits::mul(change, from));
                auto const at_to = traits::add(first, traits::mul(change, to));
                auto const between = traits::hull(at_from, at_to);
                plain = traits::sub(plain, traits::mul(between, range_of_leaf(k)));
                if (!smooth) continue;
                auto const left = traits::sub(natural.value(set.slopes[j][k]), between);
                auto const known = traits::add(first, traits::mul(change, middle));
                auto const centre = traits::mul(known, traits::point(lines[k].centre));
                fine = traits::add(fine, traits::sub(mean_product(left, lines[k]), centre));
                swung = traits::add(swung, moved(left, k));
            }
            result.mean[rising] = smooth ? agreed(plain, fine) : plain;
            result.swing[rising] = smooth ? std::min(rad(plain), swung.upper()) : rad(plain);
        }
        return result;
    }

    /// The last function is a sum of the others: what is left of them bounds it too, the better
    /// where one of them is steep.
    void sharpen_sum(integrand_set const& set, std::size_t gap, leaf_ranges const& at,
                     std::vector<in_cell>& found) const {
        auto const last = found.size() - 1;
        for (std::size_t const rising : {0U, 1U}) {
            auto sum = traits::point(0.0), swing = sum;
            for (std::size_t j = 0; j < last; ++j) {
                auto const share = traits::point(j < centre_.size() ? centre_[j] : 1.0);
                sum = traits::add(sum, traits::mul(share, found[j].mean[rising]));
                auto const own = traits::point(found[j].swing[rising]);
                swing = traits::add(swing, traits::mul(traits::abs(share), own));
            }
            for (std::size_t p = 0; p < parts_.size(); ++p) {
                auto const off = traits::hull(rounding_of(p, gap), rounding_of(p, gap + 1));
                if (mag(off) == 0) continue;
                auto const& range = leaf_over(at, parts_[p].leaf, set.states, set.inputs);
                auto const moved = traits::mul(off, range);
                sum = traits::add(sum, moved);
                swing = traits::add(swing, traits::point(mag(moved)));
            }
            auto& own = found[last];
            own.mean[rising] = agreed(own.mean[rising], sum);
            own.swing[rising] = std::min(own.swing[rising], swing.upper());
        }
    }
    /// What multiplies a part in the sum, by its terms, less what is taken for it.
    [[nodiscard]] interval rounding_of(std::size_t p, std::size_t sample) const {
        auto const last = slope_.size() - 1;
        auto off = traits::neg(traits::point(slope_[last][p][sample]));
        for (std::size_t j = 0; j < last; ++j) {
            auto const share = traits::point(j < centre_.size() ? centre_[j] : 1.0);
            off = traits::add(off, traits::mul(share, traits::point(slope_[j][p][sample])));
        }
        return off;
    }

    void add_cell(std::size_t gap, time_cell const& cell, std::vector<in_cell> const& found) {
        auto const [from, to, middle] = places_of(gap, cell);
        auto const h = traits::sub(traits::point(cell.to), traits::point(cell.from));
        // The place is off its mean by a quarter of what it changes by, on the average.
        auto const off = traits::mul(traits::point(0.25), traits::sub(to, from));
        for (std::size_t j = 0; j < found.size(); ++j) {
            auto const& [mean, swing] = found[j];
            auto const open = traits::mul(off, traits::bounds(-swing[1], swing[1]));
            auto const rising = traits::add(traits::mul(middle, mean[1]), open);
            auto& sums = rest_[j][gap];
            sums[0] = traits::add(sums[0], traits::mul(h, mean[0]));
            sums[1] = traits::add(sums[1], traits::mul(h, rising));
        }
    }

    observed_motion const* motion_;
    std::vector<double> centre_;
    std::size_t states_, inputs_;
    std::vector<double> times_;
    std::vector<part> parts_;
    std::vector<std::vector<interval>> sample_;           ///< [state][sample]
    std::vector<std::vector<two_weights>> rest_;          ///< [function][gap]
    std::vector<std::vector<std::vector<double>>> slope_; ///< [function][part][sample]
};

} // namespace sivid

#endif
