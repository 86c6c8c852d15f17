// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_DESIGN_DETAIL_SMALL_RUN_HPP
#define SIVID_DECISION_DESIGN_DETAIL_SMALL_RUN_HPP

#include <sivid/decision/design/promise_types.hpp>
#include <sivid/decision/motion/detail/motion_cover.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/requirement/robustness.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace sivid::decision_detail {

/// Runs of manoeuvres over a small box about the middle of the parameters and starts: outputs there
/// and their slopes, as if they were linear all over the sets. Nothing of it is proved of the sets.
class small_run {
public:
    /// @param goals  followed besides
    small_run(prediction_problem const& problem, planned_measurements const& plan,
              std::vector<node_id> const& goals, requirement const* limits, run_options run)
        : problem_(problem), plan_(plan), limits_(limits), run_(std::move(run)) {
        run_.degree = 1; // slopes are all that is wanted, over a small box
        run_.tolerance = 1e-4;
        run_.relative_tolerance = 1e-2;
        problem_.initial = shrunk(problem.initial);
        problem_.sets = {shrunk(problem.around())};
        problem_.measured = nullptr;
        if (limits != nullptr) margins_ = limits->margins;
        first_goal_ = margins_.size();
        margins_.insert(margins_.end(), goals.begin(), goals.end());
    }

    /// Follows a manoeuvre.
    /// @returns how well its limits are kept, about, for the whole sets: minus infinity where
    ///          nothing can be followed, infinity without limits
    double follow(std::vector<signal> inputs) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        problem_ = problem_.under(std::move(inputs));
        cover_ = nullptr; // refers to the outputs
        outputs_ = std::make_unique<followed_outputs>(problem_.model, margins_);
        // Limits count between the instants, too.
        double const longest = limits_ == nullptr ? problem_.end : problem_.end / 40;
        cover_ = std::make_unique<motion_cover>(problem_, *outputs_,
                                                time_cells(problem_, plan_.times, longest), run_);
        part_ = cover_->whole();
        cover_->learn({&part_});
        if (part_.known->reached == 0) return -infinity;
        return limits_ == nullptr ? infinity : margin();
    }

    /// What was followed.
    [[nodiscard]] response const& answer() const { return *part_.known->answer; }
    /// The small box of parameters.
    [[nodiscard]] box const& parameters() const { return problem_.sets.front(); }
    [[nodiscard]] std::size_t unknowns() const { return problem_.choice.unknown.size(); }
    /// Where an output stands in the response; nothing (`none`) where it was not reached.
    [[nodiscard]] std::size_t place_of_goal(std::size_t g) const {
        return outputs_->margins[first_goal_ + g];
    }
    static constexpr std::size_t none = ~std::size_t{0};
    [[nodiscard]] std::size_t place_of(double time, std::size_t channel) const {
        auto const k = cover_->instant_of(time);
        return k < part_.known->reached ? k * cover_->outputs() + outputs_->channels[channel]
                                        : none;
    }

    /// The columns of a response's variables, among those of others; its starts are appended.
    /// @param first  column of the first parameter
    [[nodiscard]] static std::vector<std::size_t> columns_of(response const& r, std::size_t first,
                                                             std::size_t& columns) {
        std::vector<std::size_t> column(r.table->variables, 0);
        for (std::size_t j = 0; j < r.unknowns.parameters.size(); ++j) {
            auto const& side = r.unknowns.parameters[j];
            if (side.radius > 0) column[side.variable] = first + j;
        }
        for (auto const& side : r.unknowns.initial) {
            if (side.radius > 0) column[side.variable] = columns++;
        }
        return column;
    }
    /// The slopes of an output, in half-widths of the whole sets.
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
    [[nodiscard]] double margin() const {
        margin_bounds bounds{cover_->times(), {}, {}};
        auto const count = limits_->margins.size();
        bounds.low.resize(count);
        bounds.high.resize(count);
        auto const seen = cover_->look(part_);
        for (std::size_t c = 0; c < count; ++c) {
            cover_->segments(part_, seen, outputs_->margins[c], bounds.low[c], bounds.high[c]);
            widen(bounds.low[c], bounds.high[c]);
        }
        return evaluate(*limits_, bounds).low;
    }

    static constexpr double share = 1.0 / 16; ///< of the box about the middle

    prediction_problem problem_;
    planned_measurements plan_;
    requirement const* limits_;
    run_options run_;
    std::vector<node_id> margins_;
    std::size_t first_goal_ = 0;
    std::unique_ptr<followed_outputs> outputs_;
    std::unique_ptr<motion_cover> cover_;
    motion_cover::part part_;
};

} // namespace sivid::decision_detail

#endif
