// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_MOTION_DETAIL_MOTION_COVER_HPP
#define SIVID_DECISION_MOTION_DETAIL_MOTION_COVER_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/motion/detail/cell_bounds.hpp>
#include <sivid/decision/prediction_problem.hpp>
#include <sivid/enclosure/flow.hpp>
#include <sivid/measurement/record.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/paving/run/experiment_run.hpp>
#include <sivid/paving/run_options.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// All motions of a prediction, in parts that are split where more has to be known.
///   A part is a box of starts and parameters with those of the problem's sets that meet it. One
/// integration tells the outputs at the instants of a grid as polynomials over a box; its parts
/// inherit them until what is lost to remainders matters.
class motion_cover {
public:
    /// What one integration found.
    struct knowledge {
        box initial, parameters;
        std::shared_ptr<response const> answer;
        std::size_t reached = 0;     ///< instants of the grid, from the first
        std::vector<interval> start; ///< the outputs at the first instant
        /// [cell][output], over the whole box; empty where a cell is too long.
        std::vector<std::vector<output_course>> courses;
        /// Whether every instant and every cell is known.
        bool complete = false;
    };
    struct part {
        box initial, parameters;
        std::vector<std::size_t> sets; ///< of the problem's, that meet `parameters`
        std::shared_ptr<knowledge const> known;
    };
    /// Bounds of the outputs over a part, and how they come about.
    struct view {
        std::size_t reached = 0;
        /// [instant * outputs + output]: within [low, high]; and between them at least
        /// [low + 2 rest, high - 2 rest] is attained by parameters of the sets, if that is not
        /// empty.
        std::vector<double> low, high, rest;
        std::vector<double> slope;     ///< [variable][instant * outputs + output]
        std::vector<double> curvature; ///< [variable]: its share in all rests
    };

    /// @param outputs  states first
    /// @param times    the grid, from 0 to the end
    /// @throws std::invalid_argument
    motion_cover(prediction_problem const& problem, followed_outputs const& outputs,
                 std::vector<double> times, run_options const& options);
    motion_cover(motion_cover const&) = delete;
    motion_cover& operator=(motion_cover const&) = delete;

    [[nodiscard]] std::vector<double> const& times() const { return times_; }
    /// Where a time of the grid stands in it.
    [[nodiscard]] std::size_t instant_of(double time) const {
        auto const at = std::lower_bound(times_.begin(), times_.end(), time);
        return static_cast<std::size_t>(at - times_.begin());
    }
    [[nodiscard]] std::size_t outputs() const { return flow_.channels(); }
    [[nodiscard]] std::size_t integrations() const { return integrations_; }
    [[nodiscard]] std::size_t at_once() const { return run_->at_once(); }

    /// All of it as one part, of which nothing is known.
    [[nodiscard]] part whole() const;
    /// A part of one point, or the smallest box around it: for validated single motions.
    [[nodiscard]] part point(std::vector<double> const& start,
                             std::vector<double> const& parameters) const;

    /// Integrates over each of the parts, those with the same starts side by side.
    void learn(std::vector<part*> const& parts);
    void learn(std::vector<part>& parts) {
        std::vector<part*> all;
        for (auto& p : parts) all.push_back(&p);
        learn(all);
    }
    /// @param roughly  over the part's own box instead of its sets: wider, and cheap
    [[nodiscard]] view look(part const& p, bool roughly = false) const;
    /// Bounds of one output on all segments (see `margin_bounds`): infinite where nothing is known.
    void segments(part const& p, view const& v, std::size_t output, std::vector<double>& low,
                  std::vector<double>& high) const;

    /// Number of sides that can be split: starts first.
    [[nodiscard]] std::size_t sides() const {
        return problem_->initial.size() + problem_->choice.unknown.size();
    }
    /// The variable of a side in what is known of a part; nothing for a side without width.
    [[nodiscard]] std::size_t variable_of(part const& p, std::size_t side) const;
    /// By how much halving each side shortens the terms of highest degree of the states at the last
    /// instant that was reached, each against its own range: those that are cut off, of one degree
    /// more, shrink alike. The side of the greatest is halved where a part gets no further. Empty
    /// when nothing was reached.
    [[nodiscard]] std::vector<double> lost_by_sides(part const& p, view const& v) const;
    /// The share of each side in all rests; 0 where it cannot be cut.
    [[nodiscard]] std::vector<double> curved_by_sides(part const& p, view const& v) const;
    /// The side of the greatest score above 0, or none.
    [[nodiscard]] static std::size_t most(std::vector<double> const& scores);
    static constexpr std::size_t none = ~std::size_t{0};
    /// The width of a side against the whole; 0 where it cannot be cut.
    [[nodiscard]] double share(part const& p, std::size_t side) const;
    /// The greatest of these.
    [[nodiscard]] double widest_share(part const& p) const;
    /// What of a part has its parameters in a box; without sets where no parameter is left.
    [[nodiscard]] part within(part const& p, box const& parameters) const {
        return with_sets(p.initial, intersect(p.parameters, parameters), p.sets, p.known);
    }
    /// The halves of a part along a side that has a variable; a half that meets no set is left out.
    /// Nothing when the side cannot be cut.
    [[nodiscard]] std::vector<part> split(part const& p, std::size_t side) const;
    /// The halves along the side that is widest against the whole; nothing when none can be cut.
    [[nodiscard]] std::vector<part> split(part const& p) const;
    /// The halves along the side of the greatest score, or along the widest where no score is
    /// above 0.
    [[nodiscard]] std::vector<part> split_by(std::vector<double> const& scores,
                                             part const& p) const {
        auto const side = most(scores);
        return side == none ? split(p) : split(p, side);
    }

private:
    [[nodiscard]] part with_sets(box initial, box parameters, std::vector<std::size_t> const& of,
                                 std::shared_ptr<knowledge const> known) const;
    void follow(knowledge& k);

    prediction_problem const* problem_;
    box around_;
    std::vector<double> times_;
    flow flow_;
    record samples_;
    experiment experiment_;
    std::unique_ptr<experiment_run> run_;
    std::unique_ptr<experiment_run> points_; ///< for parts without width, once there are such
    run_options options_;
    cell_bounds cells_;
    std::size_t integrations_ = 0;
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/decision/motion/impl/motion_cover.ipp>
#endif

#endif
