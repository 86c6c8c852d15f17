// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_MOTION_DETAIL_GAIN_TEST_HPP
#define SIVID_DECISION_MOTION_DETAIL_GAIN_TEST_HPP

#include <sivid/decision/motion/detail/heard_data.hpp>
#include <sivid/decision/motion/detail/idle_parts.hpp>
#include <sivid/decision/motion/detail/judged_motions.hpp>
#include <sivid/decision/motion/detail/open_parts.hpp>
#include <sivid/decision/motion/detail/verification_types.hpp>
#include <sivid/decision/motion/detail/witness_search.hpp>
#include <sivid/decision/prediction_problem.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace sivid::decision_detail {

/// A prediction, what is asked of it, and which of its sides are gains.
class gain_problem {
public:
    gain_problem(prediction_problem const& original, requirement const& asked,
                 std::vector<std::size_t> gains)
        : slim(original, asked),
          gains_(std::move(gains)),
          wide_(original.around()),
          around_(slim.problem.around()) {}

    without_idle_parts slim;

    /// All parameters that have these gains.
    [[nodiscard]] box parameters(box const& gains) const {
        auto result = around_;
        for (std::size_t k = 0; k < gains_.size(); ++k) {
            if (!slim.idle[gains_[k]]) result[gains_[k]] = gains[k];
        }
        return result;
    }
    /// The gains of some parameters; the whole ranges of those that do not matter.
    [[nodiscard]] box gains_of(box const& parameters) const {
        std::vector<interval> own;
        for (auto const g : gains_) own.push_back(slim.idle[g] ? wide_[g] : parameters[g]);
        return box(std::move(own));
    }
    /// Whether a part holds all parameters and starts, whatever its gains.
    [[nodiscard]] bool holds_all(motion_cover::part const& p) const {
        return subset(parameters(gains_of(p.parameters)), p.parameters) &&
               subset(slim.problem.initial, p.initial);
    }
    /// @param side  of a part, starts first
    [[nodiscard]] bool is_gain(std::size_t side) const {
        auto const n = slim.problem.initial.size();
        return side >= n && std::find(gains_.begin(), gains_.end(), side - n) != gains_.end();
    }
    /// A score of each gain, of scores of all sides of the parts.
    [[nodiscard]] std::vector<double> of_gains(std::vector<double> const& scores) const {
        std::vector<double> own;
        for (auto const g : gains_) own.push_back(scores[slim.problem.initial.size() + g]);
        return own;
    }

private:
    std::vector<std::size_t> gains_;
    box wide_, around_; ///< all sets: as they were, and without what is idle
};

/// Whether all gains of a box meet a requirement for all parameters and starts, or none of them
/// does: a test of set inversion.
class gain_test {
public:
    /// What is left of a box: parts that are not proved, by the grid on which they were followed;
    /// beside it the motions of the violating points.
    struct knowledge {
        std::shared_ptr<judged_motions> by;
        std::vector<motion_cover::part> open;
        /// The same for each of `against()`: parts that are not known to violate.
        std::vector<std::vector<motion_cover::part>> points;
    };

    /// @param sides         of the gains among the problem's unknowns
    /// @param direct_sides  among those of `feasible.direct`
    /// @param smallest      widths of boxes that are not halved any more
    gain_test(prediction_problem const& problem, std::vector<std::size_t> const& sides,
              std::vector<std::size_t> direct_sides, requirement const& what,
              feasible_points const& feasible, prediction_options const& options,
              std::vector<double> smallest, work_limit limit)
        : what_(&what),
          feasible_(&feasible),
          direct_sides_(std::move(direct_sides)),
          smallest_(std::move(smallest)),
          run_(options.run),
          limit_(std::move(limit)),
          problem_(problem, what, sides),
          witness_(feasible, what, options.run, limit_),
          data_(problem_.slim, problem.around(), limit_, sides) {
        run_.keep_going = limit_;
        double const cells = static_cast<double>(std::max<std::size_t>(options.cells, 1));
        follow(time_cells(problem, what.times, problem.end / cells));
    }
    gain_test(gain_test const&) = delete;
    gain_test& operator=(gain_test const&) = delete;

    [[nodiscard]] bool cancelled() const { return !limit_(); }

    [[nodiscard]] assessment<knowledge> operator()(box const& gains,
                                                   std::shared_ptr<knowledge const> const& known) {
        assessment<knowledge> says{.rest = gains};
        auto next = std::make_shared<knowledge>();
        if (known && known->by == motions_) next->points = known->points;
        auto open = parts_under(gains, known.get());
        for (int round = 0;; ++round) {
            while (limit_() && open.judge_some()) {
            }
            if (open.items().empty()) {
                says.verdict = box_verdict::inside;
                break;
            }
            bool const any = open.sort();
            auto const& worst = open.items().front();
            if (worst.judged &&
                (excluded(gains, open, *next) || (seek(worst) && excluded(gains, open, *next)))) {
                says.verdict = box_verdict::outside;
                break;
            }
            // A part that violates throughout is not proved by halving.
            auto const leaves = [this](open_parts::item const& i) {
                return i.says.found.hopeless() && !problem_.holds_all(i.what) &&
                       data_.refute(i.what);
            };
            if (worst.says.found.hopeless() && !leaves(worst)) {
                unknown_ = unknown_ || !worst.says.found.kept;
                break;
            }
            bool const lost = worst.says.reached < motions_->cover().times().back();
            if (!limit_() || !any || round == (is_smallest(gains) ? 8 : lost ? 1 : 3)) break;
            // What a gain decides is left to the search, but for what is integrated side by side.
            if (!worst.says.worn && problem_.is_gain(motion_cover::most(worst.says.score))) break;
            open.halve(leaves);
        }
        parts_ += open.judged();
        if (says.verdict != box_verdict::undecided) return says;
        says.smear.assign(gains.size(), 0.0);
        says.knowledge = keep(open, std::move(next), says.smear);
        return says;
    }

    /// Motions that violate, one per feasible parameter and start.
    [[nodiscard]] std::vector<violating_motion> const& against() const { return against_; }
    /// Of some gains nothing can be known: what the requirement is provided for does not hold.
    [[nodiscard]] bool unknown() const { return unknown_; }
    [[nodiscard]] std::size_t parts() const { return parts_; }
    [[nodiscard]] std::size_t integrations() const {
        auto n = earlier_ + motions_->cover().integrations() + witness_.integrations();
        for (auto const& p : points_) n += p->earlier + p->motions->cover().integrations();
        return n;
    }

    [[nodiscard]] std::size_t at_once() const { return motions_->cover().at_once(); }
    /// Bounds of the robustness for one gain each, all parameters taken together; of fewer where
    /// time ends.
    [[nodiscard]] std::vector<truth> robustness(std::vector<box> const& gains) {
        auto& cover = motions_->cover();
        std::vector<truth> result;
        for (std::size_t first = 0; first < gains.size() && limit_(); first += cover.at_once()) {
            auto const last = std::min(first + cover.at_once(), gains.size());
            std::vector<motion_cover::part> parts;
            for (auto k = first; k < last; ++k)
                parts.push_back(cover.within(cover.whole(), problem_.parameters(gains[k])));
            cover.learn(parts);
            for (auto const& p : parts) result.push_back(motions_->judge(p).found);
        }
        return result;
    }

private:
    /// One feasible parameter and start under all gains.
    struct point {
        prediction_problem original;
        gain_problem problem;
        std::unique_ptr<judged_motions> motions{};
        std::size_t earlier = 0;
    };
    static constexpr std::size_t most_points = 8;

    void follow(std::vector<double> const& times) {
        if (motions_) earlier_ += motions_->cover().integrations();
        motions_ = std::make_shared<judged_motions>(problem_.slim.problem, problem_.slim.what,
                                                    times, run_);
        for (auto& p : points_) follow(*p);
    }
    void follow(point& p) {
        if (p.motions) p.earlier += p.motions->cover().integrations();
        p.motions = std::make_unique<judged_motions>(p.problem.slim.problem, p.problem.slim.what,
                                                     motions_->cover().times(), run_);
    }
    /// What is to be proved of gains: what was open, or all of it.
    [[nodiscard]] open_parts parts_under(box const& gains, knowledge const* known) const {
        open_parts open(*motions_, open_parts::aim::proof, true);
        auto const before = known != nullptr ? known->open : std::vector{motions_->cover().whole()};
        for (auto const& p : before) {
            auto own = motions_->cover().within(p, problem_.parameters(gains));
            if (own.sets.empty()) continue;
            if (known == nullptr || known->by != motions_) own.known = nullptr;
            open.add(std::move(own));
        }
        return open;
    }
    /// Keeps what is left of a box for its halves; a grid that hides too much is made finer.
    /// @param smear  0 by gain; receives by which
    [[nodiscard]] std::shared_ptr<knowledge const>
    keep(open_parts& open, std::shared_ptr<knowledge> next, std::vector<double>& smear) {
        std::set<std::size_t> hiding;
        next->by = motions_;
        for (auto& i : open.items()) {
            if (i.says.coarse) hiding.insert(i.says.hiding.begin(), i.says.hiding.end());
            if (!i.says.score.empty()) {
                auto const own = problem_.of_gains(i.says.score);
                for (std::size_t k = 0; k < own.size(); ++k) smear[k] += own[k];
            }
            next->open.push_back(std::move(i.what));
        }
        if (motion_cover::most(smear) == motion_cover::none) smear.clear();
        if (!hiding.empty() && ++refinements_ <= 6)
            follow(finer_grid(motions_->cover().times(), hiding));
        return next;
    }
    [[nodiscard]] bool is_smallest(box const& gains) const {
        for (std::size_t k = 0; k < gains.size(); ++k) {
            if (width(gains[k]) > smallest_[k]) return false;
        }
        return true;
    }

    /// Whether a feasible parameter violates for all of these gains: any, where parts of all
    /// parameters do; or one of the points, where parameters count as much as gains.
    [[nodiscard]] bool excluded(box const& gains, open_parts const& open, knowledge& known) {
        if (against_.empty()) return false;
        std::vector<box> violated_for_all;
        double by_gains = 0, by_others = 0;
        for (auto const& i : open.items()) {
            if (!i.judged) continue;
            if (i.says.found.refuted() && problem_.holds_all(i.what))
                violated_for_all.push_back(problem_.gains_of(i.what.parameters));
            if (i.says.score.empty()) continue;
            for (double const x : problem_.of_gains(i.says.score)) by_gains += x;
            for (double const x : i.says.score) by_others += x;
        }
        by_others -= by_gains;
        if (covered(gains, violated_for_all)) return true;
        return (by_others > 0.25 * by_gains || is_smallest(gains)) && violated(gains, known);
    }
    /// Whether boxes cover another one.
    [[nodiscard]] static bool covered(box const& x, std::vector<box> const& by) {
        for (auto const& b : by) {
            if (subset(x, b)) return true;
        }
        for (auto const& b : by) {
            if (is_empty(intersect(x, b))) continue;
            for (std::size_t k = 0; k < x.size(); ++k) {
                for (double const at : {b[k].lower(), b[k].upper()}) {
                    if (!(x[k].lower() < at && at < x[k].upper())) continue;
                    auto const [below, above] = bisect(x, k, at);
                    return covered(below, by) && covered(above, by);
                }
            }
        }
        return false;
    }

    /// Whether one of the points violates for all of these gains.
    [[nodiscard]] bool violated(box const& gains, knowledge& known) {
        known.points.resize(points_.size());
        for (std::size_t k = 0; k < points_.size() && limit_(); ++k) {
            auto& at = *points_[k];
            auto& cover = at.motions->cover();
            open_parts open(*at.motions, open_parts::aim::refutation);
            if (known.points[k].empty()) known.points[k] = {cover.whole()};
            for (auto const& p : known.points[k]) {
                auto own = cover.within(p, at.problem.parameters(gains));
                if (!own.sets.empty()) open.add(std::move(own));
            }
            for (int round = 0;; ++round) {
                while (limit_() && open.judge_some()) {
                }
                if (open.items().empty()) return true;
                bool const any = open.sort();
                if (!limit_() || !any || round == 2 || open.is_hopeless(open.items().front()))
                    break;
                open.halve();
            }
            known.points[k].clear();
            for (auto& i : open.items()) known.points[k].push_back(std::move(i.what));
        }
        return false;
    }

    /// Looks for a point that violates, near what a part tells: at once while none is known, then
    /// now and then. @returns whether there is a new one
    [[nodiscard]] bool seek(open_parts::item const& worst) {
        if (against_.size() == most_points) return false;
        bool const refuted = worst.says.found.refuted();
        if (!against_.empty() && refuted && problem_.holds_all(worst.what)) return false;
        ++asked_;
        if (!(against_.empty() && refuted) && (asked_ & (asked_ - 1)) != 0) return false;
        auto const found = witness_(*motions_, worst.what, worst.says.found);
        return found && add(*found);
    }
    bool add(violating_motion const& found) {
        auto original = *feasible_->direct;
        auto const around = original.around();
        auto set = point_within(around, found.parameters);
        for (auto const g : direct_sides_) set[g] = around[g];
        auto const start = point_within(original.initial, found.start);
        for (auto const& p : points_) {
            if (ends_of(p->original.sets.front()) == ends_of(set) &&
                ends_of(p->original.initial) == ends_of(start))
                return false;
        }
        original.sets = {set};
        original.initial = start;
        original.measured = nullptr;
        against_.push_back(found);
        points_.push_back(std::make_unique<point>(
            point{original, gain_problem(original, *what_, direct_sides_)}));
        follow(*points_.back());
        return true;
    }

    requirement const* what_;
    feasible_points const* feasible_;
    std::vector<std::size_t> direct_sides_;
    std::vector<double> smallest_;
    run_options run_;
    work_limit limit_;
    gain_problem problem_;
    witness_search witness_;
    heard_data data_;
    std::shared_ptr<judged_motions> motions_;
    std::vector<std::unique_ptr<point>> points_; ///< as `against_`
    std::vector<violating_motion> against_;
    std::size_t asked_ = 0; ///< for points
    bool unknown_ = false;
    int refinements_ = 0;
    std::size_t parts_ = 0, earlier_ = 0;
};

} // namespace sivid::decision_detail

#endif
