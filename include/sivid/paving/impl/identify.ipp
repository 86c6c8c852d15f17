// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IMPL_IDENTIFY_IPP
#define SIVID_PAVING_IMPL_IDENTIFY_IPP

#include <sivid/paving/identify.hpp>

#include <sivid/compiled.hpp>
#include <sivid/model/problem_text.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/paving/detail/program_parts.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/judge/detail/core_box.hpp>
#include <sivid/paving/judge/witness.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/detail/drawing.hpp>
#include <sivid/paving/strategy/detail/completion.hpp>
#include <sivid/paving/strategy/detail/resumed_labels.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace sivid {

namespace paving_detail {

/// One call of `identify`: fit, contract, search, complete.
class identify_call {
public:
    identify_call(identification_problem const& problem, identify_options options)
        : problem_(&problem),
          options_(std::move(options)),
          resumed_(options_.resume.get()),
          limit_(options_.search.seconds - worked(), options_.search.keep_going),
          map_(options_.test.contract ? coordinates_of(problem) : std::nullopt),
          asked_(map_ ? map_->problem() : problem, limited(options_.test, limit_), options_.search,
                 limit_),
          result_(problem.prior) {
        if (options_.only_hulls && options_.test.contract && !(options_.search.hull_gain > 0))
            options_.search.hull_gain = 0.02; // of a side
    }

    [[nodiscard]] identification operator()() {
        name_problem();
        auto const before = prepare();
        auto const asking = asked_.integrations() - before; // the search finds what was answered
        result_.journal = asked_.journal();
        auto found = search();
        limit_.allow(options_.completing_seconds);
        find_inside(found);
        tell(found);
        if (result_.excludes_little() && result_.reason != stop_reason::decided &&
            result_.reason != stop_reason::cancelled) {
            limit_.allow(options_.completing_seconds); // the box about the witness may take all
            show_why_little(result_, asked_, *problem_, map_, found.paving.outer_hull());
        }
        require_witness_left(result_, resumed_ != nullptr);
        result_.integrations += asked_.integrations() - asking;
        if (in_parameters_) result_.integrations += in_parameters_->integrations();
        for (auto const& r : result_.journal) result_.integrations += r.integrations;
        result_.seconds = clock_.spent() + earlier();
        result_.by_clock = limit_.late() || found.by_clock;
        return std::move(result_);
    }

private:
    /// Of the runs before: time, and what they spent of the budget.
    [[nodiscard]] double earlier() const {
        return resumed_ ? resumed_->seconds + resumed_->search.seconds : 0;
    }
    [[nodiscard]] double worked() const {
        return resumed_ ? resumed_->work + resumed_->search.work : 0;
    }
    /// Only states know what was asked for.
    void name_problem() {
        if (resumed_ || options_.checkpoint) asked_for_ = sha256(problem_text(*problem_));
        if (!resumed_ || resumed_->problem == asked_for_) return;
        throw std::invalid_argument("identify: the state to resume from is of another problem: "
                                    "other data, another model or prior, or other budgets of "
                                    "outliers; resume with what it was begun with, or begin anew");
    }
    /// Fits and contracts, or takes up what an earlier run found and counted.
    /// @returns integrations until the first contractor
    [[nodiscard]] std::size_t prepare() {
        std::optional<uncounted> again;
        if (resumed_) again.emplace();
        if (options_.test.contract) propose();
        auto const before = asked_.integrations();
        if (resumed_)
            take_up();
        else if (options_.test.contract && limit_())
            contract(options_.strategy, asked_);
        return before;
    }
    /// Fits, or takes a fit up, and verifies it.
    void propose() {
        if (map_) in_parameters_.emplace(*problem_, asked_.options());
        auto& test = map_ ? *in_parameters_ : asked_.test();
        auto const fit = parts_of_program().find_witness;
        if (!resumed_) {
            if (fit != nullptr) fit(test, *problem_, limit_, result_);
        } else if (resumed_->guess && !resumed_->guess->parameters.empty()) {
            auto const& guess = *resumed_->guess;
            result_.witness = verify_witness(test, *problem_, guess.parameters, guess.starts);
            result_.guess = guess;
        }
        if (result_.guess) asked_.propose(*result_.guess, fitted());
    }
    /// In the sides that are searched; the prior without a fit.
    [[nodiscard]] box fitted() const {
        if (!result_.guess) return asked_.whole().prior;
        auto const point = point_box(result_.guess->parameters);
        return map_ ? map_->forward(point) : point;
    }
    void take_up() {
        if (resumed_->left) asked_.narrow(*resumed_->left);
        asked_.journal() = resumed_->journal;
        work_limit const for_labels(0.05 * options_.search.seconds, options_.search.keep_going);
        require_true_state(*resumed_, asked_, options_.test, result_.witness.has_value(), fitted(),
                           for_labels);
    }

    [[nodiscard]] inversion search() {
        auto& test = asked_.search_test();
        auto const& prior = asked_.whole().prior;
        auto const left = asked_.narrowed() ? std::optional{asked_.left()} : std::nullopt;
        // A fit that was cut short is not what an uninterrupted run would go on from.
        bool const prepared = resumed_ || limit_();
        double const spent = clock_.spent() + (resumed_ ? resumed_->seconds : 0);
        double const work = limit_.spent() + (resumed_ ? resumed_->work : 0);
        auto& how = options_.search;
        how.seconds = std::max(0.0, how.seconds - work);
        auto search = how;
        if (map_) search.keep_outside = true; // what is drawn is told from them
        search.checkpoint = nullptr;
        if (options_.checkpoint && prepared) {
            search.checkpoint = [&, spent, work](search_state const& now) {
                options_.checkpoint(
                    {result_.guess, spent, work, left, result_.journal, now, asked_for_});
            };
        }
        search.resume = nullptr;
        if (resumed_) search.resume = {options_.resume, &resumed_->search};
        auto const integrated = asked_.integrations();
        auto found = options_.invert_by
                         ? options_.invert_by(test, prior, search, result_.guess, left)
                         : invert(test, prior, search);
        // Not what was integrated but what the result stands on: resuming repeats some.
        result_.integrations = found.cost + integrated - asked_.integrations();
        if (left) found.paving = within(found.paving, left->parameters); // boxes that wait, too
        return found;
    }
    /// A box about the witness where the search has found none.
    void find_inside(inversion& found) {
        if (!result_.witness || options_.only_hulls || found.reason == stop_reason::cancelled ||
            found.paving.count(box_verdict::inside) > 0)
            return;
        auto const left = found.paving.outer_hull();
        auto const& at = result_.witness->parameters;
        auto const point = map_ ? mid(map_->forward(point_box(at))) : at;
        if (!contains(left, point)) return;
        if (auto const core = core_about(asked_.search_test(), left, point))
            found.paving = with_inside(found.paving, *core);
    }
    void tell(inversion& found) {
        auto const& how = options_.search;
        result_.assumptions.push_back(input_assumption(problem_->experiments));
        result_.reason = found.reason;
        result_.proof = std::move(found.proof);
        result_.run = options_.test;
        result_.run.keep_going = nullptr; // it is this call's
        result_.boxes = found.tested;
        result_.effort = effort_of(found, how);
        auto const left = found.paving.outer_hull();
        if (map_) {
            auto drawing = how;
            drawing.seconds = limit_.seconds();
            drawing.keep_going = limit_;
            draw(result_, *map_, found.paving, problem_->prior, drawing, options_.drawn_boxes);
        } else {
            result_.paving = found.paving;
            result_.hull = left;
        }
        result_.verdict = result_.witness ? verdict::consistent : proved_verdict(result_.paving);
        if (!result_.paving.has_outer()) return;
        auto const structure = dependence_of(*problem_);
        result_.entangled = structure.entangled;
        result_.combinations =
            combinations_left(structure, map_ ? &*map_ : nullptr, left, result_.paving);
        result_.forced = find_forced(asked_.search_test(), asked_.searched(), left);
    }
    identification_problem const* problem_;
    identify_options options_;
    identification_state const* resumed_;
    stopwatch clock_;
    work_limit limit_;
    std::optional<reduction> map_; ///< to the sides that are searched
    inquiry asked_;
    std::optional<feasibility_test> in_parameters_; ///< where others are searched
    std::string asked_for_;
    identification result_;
};

} // namespace paving_detail

SIVID_DECL identification identify(identification_problem const& problem,
                                   identify_options options) {
    problem.require_valid();
    return paving_detail::identify_call(problem, std::move(options))();
}

} // namespace sivid

#endif
