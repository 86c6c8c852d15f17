// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_INFLATION_SEARCH_HPP
#define SIVID_PAVING_INFLATION_SEARCH_HPP

#include <sivid/paving/data_test.hpp>
#include <sivid/paving/inflation_relaxation.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/problem.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// A box of parameters with what is proved and known of it.
struct inflation_box {
    box set;
    double lower = 0; ///< proved
    inflation_bounder::responses known;
    std::vector<bool> stale; ///< experiments whose response should be computed anew
    bool fresh = false;      ///< the stale ones were computed for exactly this box
    std::vector<double> smear;
};

/// Branch and bound over boxes of parameters, the one with the least proved inflation first.
///   A box hands its responses to its halves, which re-expand them; an experiment is integrated anew
///   for a part when remainders, or an end before all measurements, hold the bound back.
/// @guarantee  every parameter of the prior lies in a waiting box, or its inflation is at least
///             `lower()` and more than the bound above which boxes were dropped
class inflation_search {
public:
    /// Called for every point that promises less than was known; it may lower `above`.
    using proposal = std::function<void(inflation_relaxation const&, bool complete)>;

    /// @param problem  kept by reference; its budgets of outliers count
    inflation_search(identification_problem const& problem, data_test_options const& options)
        : prior_(problem.prior), everything_(without_limit(problem)), test_(everything_, options) {
        for (auto const& e : problem.experiments) outliers_.push_back(e.outliers);
        inflation_box root;
        root.set = problem.prior;
        root.known.resize(outliers_.size());
        root.stale.assign(outliers_.size(), true);
        boxes_.push_back(std::move(root));
    }
    inflation_search(inflation_search const&) = delete;
    inflation_search& operator=(inflation_search const&) = delete;

    /// No integration of this problem ends because measurements are violated.
    [[nodiscard]] static identification_problem without_limit(identification_problem problem) {
        for (auto& e : problem.experiments) e.outliers = e.measurements.size();
        return problem;
    }

    /// Boxes with more are of no interest from now on.
    void drop_above(double bound) { above_ = std::min(above_, bound); }
    /// With outliers, bounds beyond this are not worth extra work.
    void aim_at(double target) { target_ = target; }

    /// Proved: no parameter of the prior has a smaller inflation.
    [[nodiscard]] double lower() const {
        double const waiting = boxes_.empty() ? detail::infinity : boxes_.front().lower;
        return std::min({waiting, stuck_lower_, above_});
    }
    [[nodiscard]] bool exhausted() const { return boxes_.empty() || boxes_.front().lower > above_; }
    [[nodiscard]] std::size_t tested() const { return tested_; }
    [[nodiscard]] std::size_t integrations() const { return test_.integrations(); }

    /// All boxes that may contain parameters with an inflation of at most `above`.
    [[nodiscard]] std::vector<box> cover() const {
        std::vector<box> result;
        for (auto const* list : {&boxes_, &stuck_}) {
            for (auto const& b : *list) {
                if (!(b.lower > above_)) result.push_back(b.set);
            }
        }
        return result;
    }

    /// Splits the box with the least bound, or integrates over several.
    /// @param go_on  false ends an integration between two experiments
    void step(proposal const& propose, std::function<bool()> const& go_on) {
        auto next = pop();
        if (!is_blind(next) || next.fresh) {
            for (auto& half : halves(std::move(next))) {
                judge(half, propose);
                push(std::move(half));
            }
            return;
        }
        auto const wanted = test_.at_once();
        std::vector<inflation_box> blind;
        std::vector<inflation_box> others;
        blind.push_back(std::move(next));
        for (std::size_t looked = 0; looked < 2 * wanted && blind.size() < wanted && !exhausted();
             ++looked) {
            auto other = pop();
            bool const also = is_blind(other) && !other.fresh;
            (also ? blind : others).push_back(std::move(other));
        }
        for (auto& o : others) push(std::move(o));
        while (2 * blind.size() <= wanted) { // a full pack costs little more than one box
            std::vector<inflation_box> parts;
            for (auto& b : blind) {
                for (auto& half : halves(std::move(b))) parts.push_back(std::move(half));
            }
            if (parts.size() <= blind.size()) {
                blind = std::move(parts);
                break;
            }
            blind = std::move(parts);
        }
        learn(blind, go_on);
        for (auto& b : blind) {
            if (b.fresh) judge(b, propose);
            push(std::move(b));
        }
    }

private:
    static bool is_complete(inflation_bounder::responses const& known) {
        return std::all_of(known.begin(), known.end(),
                           [](auto const& r) { return r->outputs() == r->measurements; });
    }
    static bool is_blind(inflation_box const& b) {
        return std::find(b.stale.begin(), b.stale.end(), true) != b.stale.end();
    }
    static bool after(inflation_box const& a, inflation_box const& b) { return a.lower > b.lower; }

    void push(inflation_box b) {
        if (b.lower > above_) return;
        boxes_.push_back(std::move(b));
        std::push_heap(boxes_.begin(), boxes_.end(), after);
    }
    [[nodiscard]] inflation_box pop() {
        std::pop_heap(boxes_.begin(), boxes_.end(), after);
        auto b = std::move(boxes_.back());
        boxes_.pop_back();
        return b;
    }

    /// The two halves, nothing known of them that is not known of the whole; none when the box
    /// cannot be split, which is kept aside.
    [[nodiscard]] std::vector<inflation_box> halves(inflation_box b) {
        auto const side = paving_detail::side_to_split(b.set, prior_, b.smear, smallest_share);
        if (!side) {
            stuck_lower_ = std::min(stuck_lower_, b.lower);
            stuck_.push_back(std::move(b));
            return {};
        }
        auto [low, high] = bisect(b.set, *side, mid(b.set[*side]));
        if (!b.smear.empty()) b.smear[*side] /= 4; // what it is about after a look
        b.fresh = false;
        std::vector<inflation_box> result(2, b);
        result[0].set = std::move(low);
        result[1].set = std::move(high);
        return result;
    }

    /// Integrates the stale experiments over their boxes.
    void learn(std::vector<inflation_box>& boxes, std::function<bool()> const& go_on) {
        for (std::size_t s = 0; s < outliers_.size(); ++s) {
            if (!go_on()) return;
            std::vector<box> sets;
            std::vector<std::size_t> whose;
            for (std::size_t k = 0; k < boxes.size(); ++k) {
                if (!boxes[k].stale[s]) continue;
                sets.push_back(boxes[k].set);
                whose.push_back(k);
            }
            if (sets.empty()) continue;
            auto answers = test_.run(s, everything_.experiments[s].initial, sets);
            for (std::size_t k = 0; k < whose.size(); ++k) {
                boxes[whose[k]].known[s] = std::move(answers[k]);
            }
        }
        for (auto& b : boxes) b.fresh = true;
    }

    /// Bounds a box by what is known of it.
    void judge(inflation_box& b, proposal const& propose) {
        ++tested_;
        for (auto const& r : b.known) {
            if (!r) return; // nothing is known
        }
        auto const found = inflation_bounder(b.known, outliers_, b.set)(target_);
        b.lower = std::max(b.lower, found.lower);
        b.smear = found.smear;
        propose(found, is_complete(b.known));
        double const missing = std::isfinite(above_) ? above_ - b.lower : std::max(b.lower, 1.0);
        for (std::size_t s = 0; s < b.known.size(); ++s) {
            auto const& r = *b.known[s];
            bool const cut = r.outputs() < r.measurements && found.slack < 0.5 * missing;
            b.stale[s] = cut || !(found.blur[s] <= 0.1 * missing);
        }
    }

    static constexpr double smallest_share = 1e-9; ///< of the prior's side

    box prior_;
    identification_problem everything_;
    data_test test_;
    std::vector<std::size_t> outliers_;
    std::vector<inflation_box> boxes_; ///< a heap
    std::vector<inflation_box> stuck_;
    double stuck_lower_ = detail::infinity;
    double above_ = detail::infinity;
    double target_ = 1;
    std::size_t tested_ = 0;
};

} // namespace sivid

#endif
