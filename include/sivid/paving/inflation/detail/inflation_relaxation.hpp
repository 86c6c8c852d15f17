// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_INFLATION_DETAIL_INFLATION_RELAXATION_HPP
#define SIVID_PAVING_INFLATION_DETAIL_INFLATION_RELAXATION_HPP

#include <sivid/paving/contract/detail/misfit_block.hpp>
#include <sivid/paving/contract/detail/weighted_certificate.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/response/misfit.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/linear_program/minimax_lp.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

/// What the responses of several experiments say of the inflation over a box of parameters.
struct inflation_relaxation {
    double lower = 0;          ///< proved: nowhere in the box is the inflation smaller
    double slack = 0;          ///< what the curvature may have cost the bound
    std::vector<double> blur;  ///< per experiment: what its remainders may have cost
    std::vector<double> smear; ///< per parameter
    /// Per parameter: how far it spreads the last outputs of the experiments that ended early; the
    /// width of the sets there is what ended them.
    std::vector<double> ending;
    std::vector<double> point; ///< parameters where the inflation is about least, not proved
    std::vector<std::vector<double>> starts; ///< one initial state per experiment, for `point`
    double approximate_value = std::numeric_limits<double>::infinity(); ///< about, at `point`
};

/// Bounds the inflation \f$ \max_s (q_s+1)\text{-th largest} |y_i - m_i| / e_i \f$ from below over
/// a box of parameters, whatever the starts.
///   For weights w and signs s of measurements of experiments without outliers, \f$ \lambda \ge
///   \min_d \sum_i w_i s_i (y_i(d) - m_i) / \sum_i w_i e_i \f$: nonlinear terms of different
///   measurements cancel. The weights are the multipliers of the linearised minimax problem. An
///   experiment that allows q outliers has q + 1 disjoint groups of measurements each of which
///   proves the bound, since one of the groups contains no outlier.
/// @guarantee  `lower` for any weights; each is evaluated by interval arithmetic
/// @cost  one re-expansion of the responses, some exchanges of the linear program
class inflation_bounder {
    using traits = interval_traits<interval>;

public:
    using responses = response_list;

    /// @param outliers  budget of each experiment
    /// @param part      inside the boxes that the responses were computed for (trusted)
    inflation_bounder(responses const& known, std::vector<std::size_t> const& outliers,
                      box const& part)
        : known_(&known), outliers_(&outliers), part_(&part), unknowns_(known, part) {
        for (std::size_t s = 0; s < known.size(); ++s) linearise(s);
    }

    /// @param target  a bound that is worth more work with outliers; more is of no use
    [[nodiscard]] inflation_relaxation operator()(double target) {
        inflation_relaxation result;
        result.blur.assign(known_->size(), 0.0);
        result.smear.assign(part_->size(), 0.0);
        describe_ends(result);
        bool const strict = std::count(outliers_->begin(), outliers_->end(), 0u) > 0;
        if (strict) {
            auto const solved = minimax_solver(unknowns_.count, strict_blocks())();
            take(result, certified(solved.weights));
            describe(result, solved.weights);
            describe_masked(result);
            describe_hidden(result, solved.point);
            propose(result, solved.point);
        }
        for (std::size_t s = 0; s < known_->size(); ++s) {
            if ((*outliers_)[s] == 0) continue;
            double const bound = relaxed(s, target);
            if (bound > result.lower || !strict) spread(result, s);
            take(result, bound);
        }
        if (std::any_of(outliers_->begin(), outliers_->end(), [](auto q) { return q > 0; })) {
            propose(result, minimax_solver(unknowns_.count, trimmed_blocks())().point);
        }
        return result;
    }

private:
    static constexpr std::size_t last_outputs = 12; ///< of an experiment that ended early

    static void take(inflation_relaxation& result, double bound) {
        if (bound > result.lower) result.lower = std::min(bound, detail::greatest);
    }

    void linearise(std::size_t s) {
        auto const& r = *(*known_)[s];
        auto const& local = locals_.emplace_back(expand(r, *part_));
        auto misfits =
            misfits_of(r, local, unknowns_.places[s], 0, [](std::size_t) { return true; });
        scales_.push_back(std::move(misfits.scale));
        blocks_.push_back(std::move(misfits.functions));
    }

    /// The experiments that allow no outlier.
    [[nodiscard]] std::vector<minimax_block> const& strict_blocks() {
        strict_ = blocks_;
        for (std::size_t s = 0; s < strict_.size(); ++s) {
            if ((*outliers_)[s] > 0) strict_[s] = {};
        }
        return strict_;
    }
    /// All experiments, each without the measurements that are worst in the middle of the box.
    [[nodiscard]] std::vector<minimax_block> const& trimmed_blocks() {
        strict_ = blocks_;
        for (std::size_t s = 0; s < strict_.size(); ++s) {
            auto& block = strict_[s];
            std::vector<double> size;
            for (double const f : block.offset) size.push_back(std::abs(f));
            if ((*outliers_)[s] == 0) continue;
            double const limit = largest_after(size, (*outliers_)[s]);
            for (std::size_t y = 0; y < size.size(); ++y) {
                if (size[y] > limit) remove(block, y);
            }
        }
        return strict_;
    }
    static void remove(minimax_block& block, std::size_t y) {
        block.margin[y] = std::numeric_limits<double>::infinity();
    }

    [[nodiscard]] double certified(std::vector<minimax_weight> const& weights) const {
        std::vector<measurement_weight> measured;
        for (auto const& w : weights) { // the program's functions are in units of e
            measured.push_back({w.block, w.function, w.value * scales_[w.block][w.function]});
        }
        return certified_inflation(*known_, unknowns_, measured);
    }

    /// An experiment with outliers: measurements that prove more than the target one by one, then
    /// groups of the others; without enough of them, the (q+1)-th best measurement.
    [[nodiscard]] double relaxed(std::size_t s, double target) const {
        auto const& r = *(*known_)[s];
        auto const q = (*outliers_)[s];
        auto const ranges = output_ranges(r, locals_[s]);
        std::vector<double> single;
        for (std::size_t y = 0; y < ranges.size(); ++y) {
            single.push_back(lower(misfit(ranges[y], r.bounds[y])));
        }
        double const simple = largest_after(single, q);
        if (simple >= target || single.size() <= q) return simple;
        std::vector<minimax_block> left(blocks_.size());
        left[s] = blocks_[s];
        std::size_t groups = 0;
        for (std::size_t y = 0; y < single.size(); ++y) {
            if (!(single[y] > target)) continue;
            ++groups;
            remove(left[s], y);
        }
        for (; groups <= q; ++groups) {
            auto const solved = minimax_solver(unknowns_.count, left)();
            if (!(certified(solved.weights) > target)) return simple;
            for (auto const& w : solved.weights) remove(left[s], w.function);
        }
        return target;
    }

    /// What loosened the bound, by the measurements that take part in it.
    void describe(inflation_relaxation& result, std::vector<minimax_weight> const& weights) const {
        for (auto const& w : weights) {
            auto const& r = *(*known_)[w.block];
            double const size = std::abs(w.value);
            result.blur[w.block] +=
                size * r.shrinking_radius(w.function) * scales_[w.block][w.function];
            result.slack += size * blocks_[w.block].margin[w.function];
            add_curvature(result, w.block, w.function, size);
        }
    }
    /// Adds the nonlinear terms of a measurement to the smear of the parameters in them.
    void add_curvature(inflation_relaxation& result, std::size_t s, std::size_t y,
                       double size) const {
        auto const& r = *(*known_)[s];
        auto const& table = *r.table;
        auto const& local = locals_[s];
        for (std::size_t m = 0; m < table.size(); ++m) {
            double c = size * scales_[s][y] * std::abs(r.coefficients[m * r.outputs() + y]);
            std::size_t degree = 0;
            for (std::size_t v = 0; v < table.variables; ++v) {
                degree += table.exponents[m][v];
                for (std::size_t k = 0; k < table.exponents[m][v]; ++k) c *= local.reach[v];
            }
            if (degree < 2) continue;
            for (std::size_t v = 0; v < table.variables; ++v) {
                auto const unknown = unknowns_.places[s][v].unknown;
                if (table.exponents[m][v] > 0 && unknown < part_->size()) {
                    result.smear[unknown] += c;
                }
            }
        }
    }
    /// Where the polynomials promise far more than was proved at the very point that the program
    /// ends in, a measurement without weight is hidden by its own curvature: it counts, too.
    void describe_hidden(inflation_relaxation& result, std::vector<double> const& d) const {
        double worst = result.lower + result.slack;
        std::size_t block = blocks_.size(), function = 0;
        for (std::size_t s = 0; s < blocks_.size(); ++s) {
            if ((*outliers_)[s] > 0) continue;
            auto const values = misfits_at(s, d);
            for (std::size_t y = 0; y < values.size(); ++y) {
                if (!(values[y] > worst) || !std::isfinite(blocks_[s].margin[y])) continue;
                worst = values[y];
                block = s;
                function = y;
            }
        }
        if (block < blocks_.size()) add_curvature(result, block, function, 1);
    }
    /// Measurements that would prove more on their own, all over the box, were it not for their
    /// remainders: no program gives them a weight.
    void describe_masked(inflation_relaxation& result) const {
        for (std::size_t s = 0; s < blocks_.size(); ++s) {
            if ((*outliers_)[s] > 0) continue;
            auto const& block = blocks_[s];
            for (std::size_t y = 0; y < block.functions(); ++y) {
                double gain = std::abs(block.offset[y]) - result.lower;
                for (std::size_t v = 0; v < block.variable.size() && gain > 0; ++v) {
                    gain -= std::abs(block.slope[v * block.functions() + y]);
                }
                if (!(gain > 0)) continue;
                double const lost = (*known_)[s]->shrinking_radius(y) * scales_[s][y];
                result.blur[s] = std::max(result.blur[s], std::min(gain, lost));
            }
        }
    }
    /// What ended experiments before all their measurements.
    void describe_ends(inflation_relaxation& result) const {
        result.ending.assign(part_->size(), 0.0);
        for (std::size_t s = 0; s < known_->size(); ++s) {
            auto const& r = *(*known_)[s];
            auto const count = r.outputs();
            if (count == r.measurements) continue;
            for (std::size_t y = count - std::min(count, last_outputs); y < count; ++y) {
                for (std::size_t v = 0; v < blocks_[s].variable.size(); ++v) {
                    auto const unknown = blocks_[s].variable[v];
                    if (unknown >= part_->size()) continue;
                    result.ending[unknown] += std::abs(blocks_[s].slope[v * count + y]);
                }
            }
        }
    }
    /// The smear of an experiment with outliers: how far the parameters spread its outputs.
    void spread(inflation_relaxation& result, std::size_t s) const {
        auto const& block = blocks_[s];
        auto const count = block.functions();
        result.smear.assign(part_->size(), 0.0);
        double slack = 0;
        double blur = 0;
        for (std::size_t v = 0; v < block.variable.size(); ++v) {
            for (std::size_t y = 0; y < count; ++y) {
                double const size = std::abs(block.slope[v * count + y]);
                if (block.variable[v] < part_->size()) result.smear[block.variable[v]] += size;
                slack += size;
            }
        }
        for (std::size_t y = 0; y < count; ++y) {
            blur += (*known_)[s]->shrinking_radius(y) * scales_[s][y];
        }
        double const n = std::max<double>(1, static_cast<double>(count));
        result.slack = slack / n;
        result.blur.assign(known_->size(), 0.0);
        result.blur[s] = blur / n;
    }

    /// The normalised variables of a response at a point of the unknowns.
    [[nodiscard]] std::vector<double> variables_at(std::size_t s,
                                                   std::vector<double> const& d) const {
        auto const& local = locals_[s];
        std::vector<double> q(local.middle.size());
        for (std::size_t v = 0; v < q.size(); ++v) {
            q[v] = local.middle[v] + local.reach[v] * d[unknowns_.places[s][v].unknown];
        }
        return q;
    }
    /// What the polynomials say at a point: |y - m| / e of each measurement.
    [[nodiscard]] std::vector<double> misfits_at(std::size_t s,
                                                 std::vector<double> const& d) const {
        auto const& r = *(*known_)[s];
        auto const q = variables_at(s, d);
        std::vector<double> values(r.outputs(), 0.0);
        for (std::size_t m = 0; m < r.table->size(); ++m) {
            double factor = 1;
            for (std::size_t v = 0; v < q.size(); ++v) {
                for (std::size_t k = 0; k < r.table->exponents[m][v]; ++k) factor *= q[v];
            }
            double const* const row = r.coefficients.data() + m * r.outputs();
            for (std::size_t y = 0; y < values.size(); ++y) values[y] += factor * row[y];
        }
        for (std::size_t y = 0; y < values.size(); ++y) {
            values[y] = std::abs(values[y] - mid(r.bounds[y])) * scales_[s][y];
        }
        return values;
    }

    /// Keeps a point of the unknowns when the polynomials promise less there.
    void propose(inflation_relaxation& result, std::vector<double> const& d) const {
        double worst = 0;
        std::vector<std::vector<double>> starts;
        for (std::size_t s = 0; s < known_->size(); ++s) {
            worst = std::max(worst, largest_after(misfits_at(s, d), (*outliers_)[s]));
            auto const q = variables_at(s, d);
            std::vector<double> x0;
            for (auto const& side : (*known_)[s]->unknowns.initial) {
                x0.push_back(side.centre + (side.radius > 0 ? side.radius * q[side.variable] : 0));
            }
            starts.push_back(std::move(x0));
        }
        if (!(worst < result.approximate_value)) return;
        result.approximate_value = worst;
        result.starts = std::move(starts);
        result.point.clear();
        for (std::size_t j = 0; j < part_->size(); ++j) {
            auto const& side = (*part_)[j];
            result.point.push_back(
                std::clamp(mid(side) + rad(side) * d[j], side.lower(), side.upper()));
        }
    }

    responses const* known_;
    std::vector<std::size_t> const* outliers_;
    box const* part_;
    shared_unknowns unknowns_;
    std::vector<local_response> locals_;
    std::vector<std::vector<double>> scales_; ///< 1 / e
    std::vector<minimax_block> blocks_;       ///< in units of e
    std::vector<minimax_block> strict_;
};

} // namespace sivid

#endif
