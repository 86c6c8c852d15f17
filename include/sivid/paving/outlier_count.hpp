// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_OUTLIER_COUNT_HPP
#define SIVID_PAVING_OUTLIER_COUNT_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/cut_contraction.hpp>
#include <sivid/paving/data_test.hpp>
#include <sivid/paving/detail/fewest_outliers.hpp>
#include <sivid/paving/detail/outlier_search_options.hpp>
#include <sivid/paving/frontier.hpp>
#include <sivid/paving/local_response.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace sivid {

/// Bounds from below how many measurements every parameter of the prior violates, all experiments
/// together, by branch and bound.
///   Over a box, experiment e violates at least as many as the least q for which the q-relaxed
///   tests do not refute it; the sum over the experiments, and one more when all together refute
///   that distribution, is the box's bound. The box with the least bound is looked at first. Boxes
///   that cannot violate fewer than `goal` are dropped, and contracted by that.
/// @guarantee  `bound` outliers are needed: for every parameter and all starts at least so many
///             measurements fail
class outlier_count_search {
public:
    /// @param problem  its budgets of outliers do not matter
    /// @param least    by experiment: what is known to be violated at least, or empty
    outlier_count_search(identification_problem problem, std::vector<std::size_t> least,
                         outlier_search_options options)
        : problem_(tolerant(std::move(problem))),
          options_(std::move(options)),
          test_(problem_, options_.test) {
        least.resize(problem_.experiments.size(), 0);
        waiting_.push_back({.set = problem_.prior, .least = least});
        waiting_[0].bound = std::accumulate(least.begin(), least.end(), std::size_t{0});
    }
    outlier_count_search(outlier_count_search const&) = delete; // the test refers to the problem
    outlier_count_search& operator=(outlier_count_search const&) = delete;

    /// At least so many measurements are violated, or `goal` when that is less.
    [[nodiscard]] std::size_t bound() const {
        std::size_t least = goal_;
        for (auto const& n : waiting_) least = std::min(least, n.bound);
        for (auto const& n : stuck_) least = std::min(least, n.bound);
        return least;
    }
    [[nodiscard]] std::size_t boxes() const { return judged_; }
    [[nodiscard]] std::size_t integrations() const { return test_.integrations(); }

    /// Searches until no parameter is left that may violate fewer than `goal`.
    /// @param promising  called with a parameter that may do with fewer; returns the new goal
    /// @returns bound()
    template <class Promising>
    std::size_t operator()(std::size_t goal, Promising&& promising) {
        goal_ = goal;
        auto const begin = std::chrono::steady_clock::now();
        auto const over = [&] {
            return cancelled() || judged_ >= options_.boxes ||
                   std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() >
                       options_.seconds;
        };
        while (!waiting_.empty() && bound() < goal_ && !over()) {
            auto const at = std::min_element(waiting_.begin(), waiting_.end(), before);
            auto next = std::move(*at);
            waiting_.erase(at);
            if (next.bound >= goal_) continue;
            if (next.blind) {
                learn(std::move(next));
                continue;
            }
            auto const hope = hopeful(next);
            if (hope < goal_) goal_ = std::min(goal_, promising(mid(next.set)));
            split(std::move(next));
        }
        return bound();
    }

private:
    struct node {
        box set;
        response_list known = {};            ///< of a box around it
        std::vector<std::size_t> least = {}; ///< by experiment, violated all over the box
        std::size_t bound = 0;
        double volume = 1;
        std::vector<double> smear = {};
        bool blind = true;
    };
    [[nodiscard]] bool cancelled() const { return options_.keep_going && !options_.keep_going(); }
    static bool before(node const& a, node const& b) {
        return a.bound < b.bound || (a.bound == b.bound && a.volume > b.volume);
    }
    /// Runs shall not end early: any number of measurements may fail.
    static identification_problem tolerant(identification_problem problem) {
        for (auto& e : problem.experiments) e.outliers = e.measurements.size();
        return problem;
    }
    static std::size_t sum(std::vector<std::size_t> const& all) {
        return std::accumulate(all.begin(), all.end(), std::size_t{0});
    }

    [[nodiscard]] static response_list allowing(response_list const& known,
                                                std::vector<std::size_t> const& outliers) {
        response_list result;
        for (std::size_t e = 0; e < known.size(); ++e) {
            auto own = std::make_shared<response>(*known[e]);
            own->allowed = outliers[e];
            result.push_back(std::move(own));
        }
        return result;
    }

    /// Integrates over the box and others that are blind too, as many as cost one.
    void learn(node first) {
        std::vector<node> blind{std::move(first)};
        auto const limit = test_.at_once();
        while (blind.size() < limit) {
            auto at = waiting_.end();
            for (auto i = waiting_.begin(); i != waiting_.end(); ++i) {
                if (i->blind && i->bound < goal_ && (at == waiting_.end() || before(*i, *at))) {
                    at = i;
                }
            }
            if (at == waiting_.end()) break;
            blind.push_back(std::move(*at));
            waiting_.erase(at);
        }
        std::vector<box> sets;
        for (auto& n : blind) {
            sets.push_back(n.set);
            n.known.clear();
        }
        for (std::size_t e = 0; e < problem_.experiments.size(); ++e) {
            auto const answers = test_.run(e, problem_.experiments[e].initial, sets);
            for (std::size_t k = 0; k < blind.size(); ++k) blind[k].known.push_back(answers[k]);
        }
        for (auto& n : blind) {
            judge(n);
            n.blind = false; // about this box no more can be learnt
            keep(std::move(n));
        }
    }
    void keep(node n) {
        if (!is_empty(n.set) && n.bound < goal_) waiting_.push_back(std::move(n));
    }

    /// Raises the bound of a box, and contracts it to what may violate fewer than the goal.
    void judge(node& n) {
        ++judged_;
        auto const none = [&] { n.bound = goal_; };
        std::size_t const most = goal_ - 1;
        auto const spare = [&](std::size_t e) { return most - (sum(n.least) - n.least[e]); };
        for (std::size_t e = 0; e < n.known.size(); ++e) {
            if (sum(n.least) > most) return none();
            auto r = std::make_shared<response>(*n.known[e]);
            for (r->allowed = n.least[e]; r->allowed <= spare(e); ++r->allowed) {
                auto part = n.set;
                if (cancelled()) break; // so many are proved, perhaps more are needed
                if (!assess(*r, part).refuted && cut_contraction()({r}, part)) break;
            }
            n.least[e] = r->allowed;
        }
        n.bound = std::max(n.bound, sum(n.least));
        if (n.bound > most) return none();
        auto joint = n.set;
        if (n.known.size() > 1 && !cut_contraction()(allowing(n.known, n.least), joint)) {
            n.bound = std::max(n.bound, sum(n.least) + 1);
            if (n.bound > most) return none();
        }
        auto cap = n.least;
        for (std::size_t e = 0; e < cap.size(); ++e) cap[e] = spare(e);
        auto const known = allowing(n.known, cap);
        n.smear.assign(n.set.size(), 0.0);
        double share = 0;
        for (auto const& r : known) {
            auto const says = assess(*r, n.set);
            if (says.refuted) return none();
            for (std::size_t j = 0; j < n.set.size(); ++j) n.smear[j] += says.smear[j];
            share = std::max(share, says.sharpness);
            if (r->outputs() < r->measurements) share = HUGE_VAL;
        }
        if (!cut_contraction()(known, n.set)) return none();
        n.volume = relative_volume(n.set, problem_.prior).upper();
        n.blind = !(share <= options_.test.sharp_enough);
    }

    void split(node n) {
        auto const side =
            paving_detail::side_to_split(n.set, problem_.prior, n.smear, options_.accuracy);
        if (!side) {
            stuck_.push_back(std::move(n));
            return;
        }
        auto halves = bisect(n.set, *side, mid(n.set[*side]));
        for (auto* half : {&halves.first, &halves.second}) {
            auto part = n;
            part.set = std::move(*half);
            judge(part);
            keep(std::move(part));
        }
    }

    /// How many measurements seem to be violated in the middle.
    [[nodiscard]] static std::size_t hopeful(node const& n) {
        std::size_t failed = 0;
        auto const middle = point_box(mid(n.set));
        for (auto const& r : n.known) {
            auto const values = output_ranges(*r, middle);
            for (std::size_t y = 0; y < values.size(); ++y) {
                failed += disjoint(values[y], r->bounds[y]) ? 1 : 0;
            }
            failed += r->measurements - values.size();
        }
        return failed;
    }

    identification_problem problem_;
    outlier_search_options options_;
    data_test test_;
    std::vector<node> waiting_, stuck_; ///< stuck: too small to be split
    std::size_t goal_ = 0;
    std::size_t judged_ = 0;
};

} // namespace sivid

#endif
