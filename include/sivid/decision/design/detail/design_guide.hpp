// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_DESIGN_DETAIL_DESIGN_GUIDE_HPP
#define SIVID_DECISION_DESIGN_DETAIL_DESIGN_GUIDE_HPP

#include <sivid/decision/design/detail/small_run.hpp>
#include <sivid/decision/design/promise_types.hpp>
#include <sivid/paving/contract/detail/cut_program.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/space/linear_program/constraint_blocks.hpp>
#include <sivid/space/linear_program/minimax_lp.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace sivid::decision_detail {

/// What a manoeuvre may promise, about, from small runs; greater is better. No proof rests on it.
///   Goals: with \f$ \delta \f$ half the difference of two points, in half-widths of the sets, the
/// pairs that data cannot tell apart are \f$ |\sum_v c_{kv} \delta_v| \le \epsilon_k \f$: a linear
/// program for each goal. Two models: how far all pairs of them part, in twice the errors.
class design_guide {
public:
    /// A model, and the limits of its motions, if any.
    struct model {
        prediction_problem const* problem;
        requirement const* limits;
    };

    /// @param models  one, for goals, or two that are to be told apart
    design_guide(std::vector<model> const& models, planned_measurements const& plan,
                 std::vector<node_id> const& goals, run_options run,
                 std::function<bool()> keep_going)
        : plan_(plan), goals_(goals.size()), go_on_(std::move(keep_going)) {
        run.keep_going = go_on_;
        for (auto const& m : models) runs_.emplace_back(*m.problem, plan, goals, m.limits, run);
        auto const& measured = models.front().problem->measured;
        if (measured && models.size() == 1) use(measured(runs_.front().parameters(), go_on_));
    }

    /// Far below 0 where the limits are passed, minus infinity where nothing can be said; else the
    /// logarithm of all factors together with the opposite sign, factors above 1 among them, which
    /// say how far a manoeuvre is from helping.
    [[nodiscard]] double operator()(std::vector<signal> const& inputs) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        if (go_on_ && !go_on_()) return -infinity;
        ++looked_at_;
        double room = infinity;
        for (auto& run : runs_) room = std::min(room, run.follow(inputs));
        if (!(room > 0)) return room == -infinity ? room : -1e6 + std::max(room, -1e6);
        return runs_.size() == 1 ? gain() : distance();
    }
    [[nodiscard]] std::size_t looked_at() const { return looked_at_; }

private:
    /// A measurement: an affine function of the columns, in its error.
    struct linear_row {
        double offset;
        std::vector<double> slope;
    };
    /// What is measured already says the same of every manoeuvre.
    void use(measured_responses const& data) {
        columns_ = runs_.front().unknowns();
        for (auto const& answer : data.known) {
            auto const column = small_run::columns_of(*answer, 0, columns_);
            for (std::size_t y = 0; y < answer->outputs(); ++y) {
                double const error = 0.5 * width(answer->bounds[y]);
                if (error > 0 && std::isfinite(error))
                    known_.push_back(in_errors(
                        0, stretched(small_run::slopes(*answer, y, column, columns_)), error));
            }
        }
    }
    /// Parameters may go beyond the sets: what does not help yet would all look the same.
    [[nodiscard]] std::vector<double> stretched(std::vector<double> slope) const {
        for (std::size_t v = 0; v < runs_.front().unknowns(); ++v) slope[v] *= 30;
        return slope;
    }
    [[nodiscard]] static linear_row in_errors(double offset, std::vector<double> slope,
                                              double error) {
        for (double& x : slope) x /= error;
        return {offset / error, std::move(slope)};
    }
    [[nodiscard]] static minimax_block block_of(std::vector<linear_row> const& rows,
                                                std::size_t columns, double margin) {
        minimax_block block;
        for (std::size_t v = 0; v < columns; ++v) block.variable.push_back(v);
        block.slope.resize(columns * rows.size());
        block.margin.assign(rows.size(), margin);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            block.offset.push_back(rows[k].offset);
            for (std::size_t v = 0; v < rows[k].slope.size(); ++v)
                block.slope[v * rows.size() + k] = rows[k].slope[v];
        }
        return block;
    }

    [[nodiscard]] double gain() const {
        auto const& run = runs_.front();
        auto columns = std::max(columns_, run.unknowns());
        auto const column = small_run::columns_of(run.answer(), 0, columns);
        auto rows = known_;
        plan_.for_each([&](double t, std::size_t c, double error) {
            auto const y = run.place_of(t, c);
            if (y != small_run::none)
                rows.push_back(in_errors(
                    0, stretched(small_run::slopes(run.answer(), y, column, columns)), error));
        });
        std::vector<minimax_block> const blocks{block_of(rows, columns, 1)};
        double sum = 0;
        for (std::size_t g = 0; g < goals_; ++g) {
            auto goal = small_run::slopes(run.answer(), run.place_of_goal(g), column, columns);
            double before = 0, after = 0;
            for (double const x : goal) before += std::abs(x);
            if (!(before > 0)) continue;
            goal = stretched(std::move(goal));
            auto const cut = cut_program(columns, blocks)(goal);
            for (std::size_t v = 0; v < columns && v < cut.point.size(); ++v)
                after += goal[v] * cut.point[v];
            sum -= std::log(std::max(after / before, 1e-12));
        }
        return sum;
    }
    /// Of the closest pair.
    [[nodiscard]] double distance() const {
        auto const &a = runs_.front(), &b = runs_.back();
        auto columns = a.unknowns() + b.unknowns();
        auto const of_a = small_run::columns_of(a.answer(), 0, columns);
        auto const of_b = small_run::columns_of(b.answer(), a.unknowns(), columns);
        std::vector<linear_row> rows;
        plan_.for_each([&](double t, std::size_t c, double error) {
            auto const y = a.place_of(t, c), z = b.place_of(t, c);
            if (y == small_run::none || z == small_run::none) return;
            auto slope = small_run::slopes(a.answer(), y, of_a, columns);
            auto const other = small_run::slopes(b.answer(), z, of_b, columns);
            for (std::size_t v = 0; v < columns; ++v) slope[v] -= other[v];
            double const apart = a.answer().coefficients[y] - b.answer().coefficients[z];
            rows.push_back(in_errors(apart, std::move(slope), 2 * error));
        });
        std::vector<minimax_block> const blocks{block_of(rows, columns, 0)};
        return std::log(std::max(minimax_solver(columns, blocks)().value, 1e-12));
    }

    planned_measurements plan_;
    std::size_t goals_ = 0;
    std::function<bool()> go_on_;
    std::vector<small_run> runs_; ///< one for each model
    std::vector<linear_row> known_;
    std::size_t columns_ = 0; ///< of the parameters, and of the starts of what is measured
    std::size_t looked_at_ = 0;
};

} // namespace sivid::decision_detail

#endif
