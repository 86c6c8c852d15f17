// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_DETAIL_DESIGN_GUIDE_HPP
#define SIVID_DECISION_DETAIL_DESIGN_GUIDE_HPP

#include <sivid/decision/design_goal.hpp>
#include <sivid/decision/detail/promise_types.hpp>
#include <sivid/decision/motion_cover.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/robustness.hpp>
#include <sivid/paving/cut_program.hpp>
#include <sivid/paving/response.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/constraint_blocks.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace sivid::decision_detail {

/// What a manoeuvre may promise, about: from one run over a small box about the middle of the
/// parameters and starts, as if outputs were linear all over the sets.
///   With \f$ \delta \f$ half the difference of two points, in half-widths of the sets, the pairs
/// that data cannot tell apart are \f$ |\sum_v c_{kv} \delta_v| \le \epsilon_k \f$, \f$ |\delta|
/// \le 1 \f$: a linear program for each goal. No proof rests on it.
class design_guide {
public:
    design_guide(prediction_problem const& problem, planned_measurements const& plan,
                 std::vector<design_goal> const& goals, requirement const* limits, run_options run,
                 std::function<bool()> keep_going)
        : problem_(problem), plan_(plan), limits_(limits), run_(run), go_on_(keep_going) {
        run_.enclosure.keep_going = std::move(keep_going);
        run_.degree = 1; // slopes are all that is wanted, over a small box
        run_.enclosure.tolerance = 1e-4;
        run_.enclosure.relative_tolerance = 1e-2;
        auto const around = problem.around();
        problem_.initial = shrunk(problem.initial);
        problem_.sets = {shrunk(around)};
        problem_.measured = nullptr;
        if (limits != nullptr) margins_ = limits->margins;
        for (auto const& g : goals) margins_.push_back(g.value);
        goals_ = goals.size();
        if (problem.measured) use(problem.measured(problem_.sets.front(), go_on_));
    }

    /// The logarithm of all factors together with the opposite sign, factors above 1 among them,
    /// which say how far a manoeuvre is from helping; far below 0 where the limits
    /// are passed, minus infinity where nothing can be said.
    [[nodiscard]] double operator()(std::vector<signal> inputs) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        if (go_on_ && !go_on_()) return -infinity;
        ++looked_at_;
        problem_.inputs = std::move(inputs);
        followed_outputs const outputs(problem_.model, margins_);
        // Limits count between the instants, too.
        double const longest = limits_ == nullptr ? problem_.end : problem_.end / 40;
        motion_cover cover(problem_, outputs, time_cells(problem_, plan_.times, longest), run_);
        auto part = cover.whole();
        cover.learn({&part});
        if (part.known->reached == 0) return -infinity;
        double const room = limits_ == nullptr ? infinity : margin(cover, outputs, part);
        if (!(room > 0)) return room == -infinity ? room : -1e6 + std::max(room, -1e6);
        return gain(cover, outputs, part);
    }
    [[nodiscard]] std::size_t looked_at() const { return looked_at_; }

private:
    /// A box about the middle.
    [[nodiscard]] static box shrunk(box x) {
        for (std::size_t i = 0; i < x.size(); ++i) {
            double const middle = mid(x[i]), radius = share * rad(x[i]);
            if (radius > 0 && middle - radius < middle)
                x[i] = interval_traits<interval>::bounds(std::max(x[i].lower(), middle - radius),
                                                         std::min(x[i].upper(), middle + radius));
        }
        return x;
    }
    /// The rows of measurements in \f$ \delta \f$; starts get columns of their own.
    [[nodiscard]] static std::vector<double> slopes(response const& r, std::size_t y,
                                                    std::vector<std::size_t> const& column,
                                                    std::size_t columns) {
        std::vector<double> row(columns, 0.0);
        for (std::size_t m = 0; m < r.table->size(); ++m) {
            std::size_t degree = 0, v = 0;
            for (std::size_t k = 0; k < r.table->variables; ++k) {
                degree += r.table->exponents[m][k];
                if (r.table->exponents[m][k] != 0) v = k;
            }
            if (degree == 1) row[column[v]] += r.coefficients[m * r.outputs() + y] / share;
        }
        return row;
    }
    /// The columns of a response's variables; its starts are appended.
    [[nodiscard]] static std::vector<std::size_t> columns_of(response const& r,
                                                             std::size_t& columns) {
        std::vector<std::size_t> column(r.table->variables, 0);
        for (std::size_t j = 0; j < r.unknowns.parameters.size(); ++j) {
            auto const& side = r.unknowns.parameters[j];
            if (side.radius > 0) column[side.variable] = j;
        }
        for (auto const& side : r.unknowns.initial) {
            if (side.radius > 0) column[side.variable] = columns++;
        }
        return column;
    }
    /// Rows that bound the difference, each over its error.
    struct linear_row {
        std::vector<double> slope;
        double error;
    };
    /// What is measured already says the same of every manoeuvre.
    void use(measured_responses const& data) {
        columns_ = problem_.choice.unknown.size();
        for (auto const& answer : data.known) {
            auto const column = columns_of(*answer, columns_);
            for (std::size_t y = 0; y < answer->outputs(); ++y) {
                double const error = 0.5 * width(answer->bounds[y]);
                if (error > 0 && std::isfinite(error))
                    known_.push_back({slopes(*answer, y, column, columns_), error});
            }
        }
    }
    /// As far as the whole sets move what the small box moves.
    static void widen(std::vector<double>& low, std::vector<double>& high) {
        std::vector<double> more(low.size(), 0.0);
        for (std::size_t s = 0; s < low.size(); s += 2)
            more[s] = 0.5 * (high[s] - low[s]) * (1 / share - 1);
        for (std::size_t s = 1; s + 1 < low.size(); s += 2)
            more[s] = std::max(more[s - 1], more[s + 1]);
        for (std::size_t s = 0; s < low.size(); ++s) {
            low[s] -= more[s];
            high[s] += more[s];
        }
    }
    [[nodiscard]] double margin(motion_cover const& cover, followed_outputs const& outputs,
                                motion_cover::part const& part) const {
        margin_bounds bounds{cover.times(), {}, {}};
        auto const count = limits_->margins.size();
        bounds.low.resize(count);
        bounds.high.resize(count);
        auto const seen = cover.look(part);
        for (std::size_t c = 0; c < count; ++c) {
            cover.segments(part, seen, outputs.margins[c], bounds.low[c], bounds.high[c]);
            widen(bounds.low[c], bounds.high[c]);
        }
        return evaluate(*limits_, bounds).low;
    }
    [[nodiscard]] double gain(motion_cover const& cover, followed_outputs const& outputs,
                              motion_cover::part const& part) const {
        auto const& answer = *part.known->answer;
        auto columns = std::max(columns_, problem_.choice.unknown.size());
        auto const column = columns_of(answer, columns);
        auto rows = known_;
        auto const& grid = cover.times();
        for (double const t : plan_.times) {
            auto const at = std::lower_bound(grid.begin(), grid.end(), t);
            auto const k = static_cast<std::size_t>(at - grid.begin());
            if (k >= part.known->reached) break;
            for (std::size_t c = 0; c < plan_.errors.size(); ++c) {
                if (!(plan_.errors[c] > 0)) continue;
                auto const y = k * cover.outputs() + outputs.channels[c];
                rows.push_back({slopes(answer, y, column, columns), plan_.errors[c]});
            }
        }
        // Parameters may go beyond the sets here: what does not help yet would all look the same.
        auto const scale = [&](std::size_t v) {
            return v < problem_.choice.unknown.size() ? beyond : 1.0;
        };
        minimax_block block;
        for (std::size_t v = 0; v < columns; ++v) block.variable.push_back(v);
        block.slope.resize(columns * rows.size());
        block.offset.assign(rows.size(), 0.0);
        block.margin.assign(rows.size(), 1.0);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            for (std::size_t v = 0; v < rows[k].slope.size(); ++v)
                block.slope[v * rows.size() + k] = scale(v) * rows[k].slope[v] / rows[k].error;
        }
        std::vector<minimax_block> const blocks{std::move(block)};
        double sum = 0;
        for (std::size_t g = 0; g < goals_; ++g) {
            auto const y = outputs.margins[outputs.margins.size() - goals_ + g];
            auto goal = slopes(answer, y, column, columns);
            double before = 0, after = 0;
            for (std::size_t v = 0; v < columns; ++v) {
                before += std::abs(goal[v]);
                goal[v] *= scale(v);
            }
            if (!(before > 0)) continue;
            auto const cut = cut_program(columns, blocks)(goal);
            for (std::size_t v = 0; v < columns && v < cut.point.size(); ++v)
                after += goal[v] * cut.point[v];
            sum -= std::log(std::max(after / before, 1e-12));
        }
        return sum;
    }

    static constexpr double share = 1.0 / 16; ///< of the box about the middle
    static constexpr double beyond = 30;

    prediction_problem problem_;
    planned_measurements plan_;
    requirement const* limits_;
    run_options run_;
    std::function<bool()> go_on_;
    std::vector<node_id> margins_;
    std::size_t goals_ = 0;
    std::vector<linear_row> known_;
    std::size_t columns_ = 0; ///< of the parameters, and of the starts of what is measured
    std::size_t looked_at_ = 0;
};

} // namespace sivid::decision_detail

#endif
