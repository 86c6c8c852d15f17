// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_IMPL_VERIFICATION_IPP
#define SIVID_DECISION_IMPL_VERIFICATION_IPP

#include <sivid/decision/verification.hpp>

#include <sivid/compiled.hpp>
#include <sivid/decision/motion/detail/heard_data.hpp>
#include <sivid/decision/motion/detail/idle_parts.hpp>
#include <sivid/decision/motion/detail/judged_motions.hpp>
#include <sivid/decision/motion/detail/open_parts.hpp>
#include <sivid/decision/motion/detail/witness_search.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

namespace decision_detail {

class verification_search {
public:
    verification_search(prediction_problem const& problem, requirement const& what,
                        feasible_points const& feasible, prediction_options const& options)
        : around_(problem.around()),
          slim_(problem, what),
          options_(options),
          limit_(options.seconds, options.keep_going),
          witness_(feasible, what, options.run, limit_),
          data_(slim_, around_, limit_) {
        options_.run.keep_going = limit_;
        double const cells = static_cast<double>(std::max<std::size_t>(options.cells, 1));
        times_ = time_cells(problem, what.times, problem.end / cells);
    }

    verification_search(verification_search const&) = delete;
    verification_search& operator=(verification_search const&) = delete;

    [[nodiscard]] verification operator()() {
        std::vector<motion_cover::part> todo;
        for (int refinement = 0;; ++refinement) {
            motions_.emplace(problem_, what_, times_, options_.run);
            if (refinement == 0) todo.push_back(motions_->cover().whole());
            open_.emplace(*motions_);
            for (auto& p : todo) {
                p.known = nullptr;
                open_->add(std::move(p));
            }
            search();
            integrations_ += motions_->cover().integrations();
            parts_ += open_->judged();
            if (result_.witness || refinement == 6 || !limit_()) break;
            todo = coarse();
            if (todo.empty()) break;
        }
        finish();
        result_.seconds = limit_.spent();
        return std::move(result_);
    }

private:
    using item = open_parts::item;

    [[nodiscard]] bool going() const {
        return limit_() && !result_.witness && parts_ + open_->judged() < options_.parts;
    }

    /// Integrates, halves and judges until nothing is open but what needs other instants, or for
    /// good.
    void search() {
        std::size_t rounds = 0;
        while (going()) {
            if (open_->judge_some([this](item const& i) { note(i.says.found); })) continue;
            if (!open_->sort()) break;
            // Bounds of motions that were not carried to the end suggest little.
            auto const& worst = open_->items().front();
            bool const violated = worst.says.found.refuted();
            bool const telling = worst.says.reached == problem_.end;
            if (violated || rounds == 0 || (telling && (rounds & (rounds - 1)) == 0))
                result_.witness = witness_(*motions_, worst.what, worst.says.found);
            ++rounds;
            if (result_.witness) return;
            open_->halve([this](item const& i) {
                return (i.says.found.refuted() || i.halvings % 3 == 0) && data_.refute(i.what);
            });
        }
    }

    void note(truth const& t) {
        if (t.low < low_.low) low_ = t;
        high_ = std::max(high_, t.high);
    }

    /// What is open since the grid is too coarse, once the grid is finer; empty: nothing is.
    std::vector<motion_cover::part> coarse() {
        std::set<std::size_t> cells;
        for (auto const& i : open_->items()) {
            if (i.says.coarse) cells.insert(i.says.hiding.begin(), i.says.hiding.end());
        }
        if (cells.empty()) return {};
        std::vector<motion_cover::part> todo;
        for (auto& i : open_->items()) {
            if (i.says.coarse)
                todo.push_back(std::move(i.what));
            else
                remember(i);
        }
        times_ = finer_grid(times_, cells);
        return todo;
    }

    void remember(item const& i) {
        auto found = i.says.found;
        if (!found.kept) found.high = -(found.low = -std::numeric_limits<double>::infinity());
        note(found);
        open_box box{i.what.parameters, i.what.initial, found, open_reason::undecided,
                     i.says.reached};
        for (std::size_t j = 0; j < around_.size(); ++j) {
            if (slim_.idle[j]) box.parameters[j] = around_[j];
        }
        if (i.judged && i.says.reached < problem_.end)
            box.why = open_reason::not_enclosed;
        else if (found.hopeless())
            box.why = found.kept ? open_reason::infeasible : open_reason::not_kept;
        left_.push_back(std::move(box));
    }

    void finish() {
        for (auto const& i : open_->items()) remember(i);
        result_.found = low_;
        result_.found.high = high_;
        result_.found.certain = left_.empty() && !result_.witness;
        result_.found.possible = !(result_.witness && left_.empty());
        result_.answer = result_.witness ? requirement_answer::refuted
                         : left_.empty() ? requirement_answer::proved
                                         : requirement_answer::open;
        result_.reached = problem_.end;
        for (auto const& b : left_) result_.reached = std::min(result_.reached, b.reached);
        std::vector<std::pair<double, std::size_t>> order; // the largest first, else as found
        for (std::size_t k = 0; k < left_.size(); ++k)
            order.emplace_back(-relative_volume(left_[k].parameters, around_).upper(), k);
        std::sort(order.begin(), order.end());
        for (auto const& [volume, k] : order) result_.open.push_back(std::move(left_[k]));
        result_.times = times_;
        result_.parts = parts_;
        result_.integrations = integrations_ + witness_.integrations();
    }

    box around_; ///< all sets, idle sides as they are
    without_idle_parts slim_;
    prediction_problem const& problem_ = slim_.problem;
    requirement const& what_ = slim_.what;
    prediction_options options_;
    work_limit limit_;
    witness_search witness_;
    heard_data data_;
    std::vector<double> times_;
    std::optional<judged_motions> motions_;
    std::optional<open_parts> open_;
    std::vector<open_box> left_;
    std::size_t parts_ = 0, integrations_ = 0;
    truth low_{HUGE_VAL, HUGE_VAL, true, true, {}, {}}; // of no motion
    double high_ = -std::numeric_limits<double>::infinity();
    verification result_;
};

} // namespace decision_detail

SIVID_DECL verification verify(prediction_problem const& problem, requirement const& what,
                               feasible_points const& feasible, prediction_options const& options) {
    decision_detail::require_asked(problem, what);
    if (feasible.direct != nullptr) decision_detail::require_asked(*feasible.direct, what);
    return decision_detail::verification_search(problem, what, feasible, options)();
}

} // namespace sivid

#endif
