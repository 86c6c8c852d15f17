// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_DETAIL_MEAN_VALUE_PROGRAM_HPP
#define SIVID_PAVING_STATIC_DETAIL_MEAN_VALUE_PROGRAM_HPP

#include <sivid/paving/contract/detail/cut_program.hpp>
#include <sivid/paving/response/linear_contractor.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/linear_program/minimax_lp.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// Contracts a box by the mean-value forms of many functions together,
///   \f$ g_k(p) \in g_k(m) + \sum_j J_{kj} (p_j - m_j) \f$ and \f$ g_k(p) \in [y_k] \f$.
/// Linear programs propose weights for each side. A weighted sum of the functions is such a form
/// again, with weighted ends of the bounds as its bound: that form proves how far each side can be
/// cut off.
///   When q functions may miss their bounds, q + 1 groups of functions that share none prove a cut
///   each; one of the groups misses none, so what all of them cut off can go. With `most_groups`
///   and more, each function is a group.
/// @guarantee  removes no point at which at most q functions miss their bounds, whatever the
///   weights
/// @cost  2 n (q + 1) linear programs of about n exchanges, each O(functions * n)
class mean_value_program {
    using traits = interval_traits<interval>;

public:
    /// No more groups than this have programs.
    static constexpr std::size_t most_groups = 8;

    /// Forms over a box about a point in it.
    void begin(box const& over, std::vector<double> middle) {
        n_ = over.size();
        middle_ = std::move(middle);
        terms_.clear();
        reach_.clear();
        for (std::size_t j = 0; j < n_; ++j) {
            auto const d = traits::sub(over[j], traits::point(middle_[j]));
            reach_.push_back(traits::mag(d));
        }
        points_.clear();
    }
    [[nodiscard]] std::size_t size() const { return terms_.size() / (n_ + 2); }
    /// A function: its bound, its value at the point, its gradient over the box.
    /// @param slope  (j) -> the derivative by side j
    template <class Slope>
    void add(interval const& bound, interval const& value, Slope const& slope) {
        auto const before = terms_.size();
        terms_.push_back(bound);
        terms_.push_back(value);
        bool finite = std::isfinite(traits::mag(value));
        for (std::size_t j = 0; j < n_; ++j) {
            terms_.push_back(slope(j));
            finite = finite && std::isfinite(traits::mag(terms_.back()));
        }
        if (!finite) terms_.resize(before);
    }

    /// @param x  a part of the box, contracted
    /// @param q  how many functions may miss their bounds
    /// @param middle  `points` are to begin with one deep inside, if q = 0
    /// @returns false when nothing is left (`x` is meaningless then)
    [[nodiscard]] bool operator()(box& x, std::size_t q, bool middle = false) {
        sharp_ = false;
        if (size() <= q) return true;
        if (q >= most_groups) return contract_each(x, q);
        linearise();
        if (middle && q == 0) keep(minimax_solver(n_, blocks_)().point);
        for (std::size_t j = 0; j < n_; ++j) {
            for (bool const upwards : {true, false}) {
                if (!(reach_[j] > 0)) continue;
                if (!contract_side(x, j, upwards, q)) return false;
            }
        }
        return true;
    }
    /// Whether the functions were affine but for a thousandth of their bounds, so that the same
    /// programs over what is left would say no more.
    [[nodiscard]] bool sharp() const { return sharp_; }
    /// Where the programs ended: about the corners of what is left, for who looks for a point.
    [[nodiscard]] std::vector<std::vector<double>> const& points() const { return points_; }

private:
    [[nodiscard]] interval const& bound(std::size_t k) const { return terms_[k * (n_ + 2)]; }
    [[nodiscard]] interval const& value(std::size_t k) const { return terms_[k * (n_ + 2) + 1]; }
    [[nodiscard]] interval const& slope(std::size_t k, std::size_t j) const {
        return terms_[k * (n_ + 2) + 2 + j];
    }

    /// The forms as affine functions of d in [-1, 1]^n with margins, each in a unit of its own:
    /// about how far it goes. Plain doubles.
    void linearise() {
        auto const count = size();
        blocks_.assign(1, {});
        auto& f = blocks_[0];
        for (std::size_t j = 0; j < n_; ++j) f.variable.push_back(j);
        f.slope.assign(n_ * count, 0.0);
        f.offset.assign(count, 0.0);
        f.margin.assign(count, std::numeric_limits<double>::infinity());
        scale_.assign(count, 0.0);
        sharp_ = true;
        for (std::size_t k = 0; k < count; ++k) {
            double spread = 0, rest = rad(value(k));
            for (std::size_t j = 0; j < n_; ++j) {
                double const s = mid(slope(k, j)) * reach_[j];
                f.slope[j * count + k] = s;
                spread += std::abs(s);
                rest += rad(slope(k, j)) * reach_[j];
            }
            // An end that lies beyond all that the form reaches stops nothing, infinite or not.
            double const at = mid(value(k)), far = 2 * (spread + rest);
            double const least = std::max(bound(k).lower(), at - far);
            double const most = std::min(bound(k).upper(), at + far);
            double const scale = 1 / spread;
            if (!(scale > 0) || !std::isfinite(scale) || !std::isfinite(rest * scale)) {
                for (std::size_t j = 0; j < n_; ++j) f.slope[j * count + k] = 0;
                continue;
            }
            for (std::size_t j = 0; j < n_; ++j) f.slope[j * count + k] *= scale;
            scale_[k] = scale;
            sharp_ = sharp_ && rest <= 0.0005 * (most - least);
            f.offset[k] = (at - 0.5 * (least + most)) * scale;
            f.margin[k] = (0.5 * (most - least) + rest) * scale;
        }
    }

    [[nodiscard]] bool contract_side(box& x, std::size_t j, bool upwards, std::size_t q) {
        auto& margin = blocks_[0].margin;
        std::vector<std::pair<std::size_t, double>> taken; // functions of former groups
        box left;
        bool helps = true;
        for (std::size_t group = 0; group <= q && helps; ++group) {
            auto const cut = cut_program(n_, blocks_)(j, upwards);
            if (group == 0 && !cut.empty) keep(cut.point);
            helps = !cut.weights.empty();
            if (!helps) break;
            auto part = x;
            if (contract_by(cut.weights, part)) {
                left = left.size() == 0 ? part : hull(left, part);
                helps = left[j].lower() > x[j].lower() || left[j].upper() < x[j].upper();
            }
            if (group == q) continue;
            for (auto const& w : cut.weights) {
                taken.emplace_back(w.function, margin[w.function]);
                margin[w.function] = std::numeric_limits<double>::infinity();
            }
        }
        for (auto const& [k, own] : taken) margin[k] = own;
        if (!helps) return true;
        if (left.size() == 0) return false;
        x = left; // parts of x
        return true;
    }

    /// By \f$ \sum_k w_k g_k(p) \le \sum_k w_k e_k \f$ with the ends e_k of the bounds, upper ones
    /// where w is positive.
    [[nodiscard]] bool contract_by(std::vector<minimax_weight> const& weights, box& x) const {
        interval most{0.0};
        std::vector<interval> gradient(n_, interval(0.0));
        for (auto const& w : weights) {
            auto const k = w.function;
            auto const size = traits::point(w.value * scale_[k]);
            double const end = w.value > 0 ? bound(k).upper() : bound(k).lower();
            if (!std::isfinite(traits::mag(size)) || !std::isfinite(end)) return true;
            most = traits::add(most, traits::mul(size, traits::sub(traits::point(end), value(k))));
            for (std::size_t j = 0; j < n_; ++j) {
                gradient[j] = traits::add(gradient[j], traits::mul(size, slope(k, j)));
            }
        }
        if (!std::isfinite(most.upper())) return true;
        auto deviation = deviations(x);
        auto const below = traits::bounds(-std::numeric_limits<double>::infinity(), most.upper());
        return contract(deviation, constraint(gradient, below, deviation)) && place(deviation, x);
    }

    /// Each function by itself, when too many may miss their bounds for programs: what q + 1 of
    /// them exclude.
    [[nodiscard]] bool contract_each(box& x, std::size_t q) const {
        auto deviation = deviations(x);
        std::vector<linear_constraint> rows;
        std::vector<interval> gradient(n_);
        for (std::size_t k = 0; k < size(); ++k) {
            for (std::size_t j = 0; j < n_; ++j) gradient[j] = slope(k, j);
            rows.push_back(constraint(gradient, traits::sub(bound(k), value(k)), deviation));
        }
        return relaxed_contract(deviation, rows, q) && place(deviation, x);
    }

    [[nodiscard]] box deviations(box const& x) const {
        box result(n_);
        for (std::size_t j = 0; j < n_; ++j) {
            result[j] = traits::sub(x[j], traits::point(middle_[j]));
        }
        return result;
    }
    /// What holds for numbers near the middles of the slopes, if `target` does for some slopes.
    [[nodiscard]] static linear_constraint constraint(std::vector<interval> const& gradient,
                                                      interval target, box const& deviation) {
        linear_constraint row;
        for (std::size_t j = 0; j < gradient.size(); ++j) {
            row.gradient.push_back(mid(gradient[j]));
            auto const rest = traits::sub(gradient[j], traits::point(row.gradient[j]));
            target = traits::sub(target, traits::mul(rest, deviation[j]));
        }
        row.target = target;
        return row;
    }
    [[nodiscard]] bool place(box const& deviation, box& x) const {
        for (std::size_t j = 0; j < n_; ++j) {
            x[j] = traits::intersect(x[j], traits::add(deviation[j], traits::point(middle_[j])));
            if (is_empty(x[j])) return false;
        }
        return true;
    }

    void keep(std::vector<double> const& d) {
        std::vector<double> at(n_);
        for (std::size_t j = 0; j < n_; ++j) at[j] = middle_[j] + reach_[j] * d[j];
        points_.push_back(std::move(at));
    }

    std::size_t n_ = 0;
    std::vector<double> middle_, reach_;
    std::vector<interval> terms_; ///< by function: bound, value, slopes
    std::vector<minimax_block> blocks_;
    std::vector<double> scale_; ///< the unit of a function is 1 / scale; 0: not used
    std::vector<std::vector<double>> points_;
    bool sharp_ = false;
};

} // namespace sivid

#endif
