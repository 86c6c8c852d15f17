// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_INFLATION_SEARCH_HPP
#define SIVID_PAVING_INFLATION_SEARCH_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/box_explorer.hpp>
#include <sivid/paving/inflation_relaxation.hpp>
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

/// A box of parameters with a proved bound of the inflation.
struct inflation_box : explored_box {
    double lower = 0;
};

/// Branch and bound over boxes of parameters, the one with the least proved inflation first.
///   A box hands its responses to its halves, which re-expand them; an experiment is integrated
///   anew for a part when remainders, or an end before all measurements, hold the bound back.
/// @guarantee  every parameter of the prior lies in a waiting box, or its inflation is at least
///             `lower()` and more than the bound above which boxes were dropped
class inflation_search {
public:
    /// Called with a point of each box that was bounded.
    using proposal = std::function<void(inflation_relaxation const&, bool complete)>;

    inflation_search(identification_problem const& problem, data_test_options const& options)
        : explorer_(problem, options) {
        for (auto const& e : problem.experiments) outliers_.push_back(e.outliers);
        boxes_.push_back(explorer_.unknown<inflation_box>(problem.prior));
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
    [[nodiscard]] std::size_t integrations() const { return explorer_.integrations(); }

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
        if (!next.is_blind()) {
            auto parts = explorer_.halves(next);
            if (parts.empty()) {
                stuck_lower_ = std::min(stuck_lower_, next.lower);
                stuck_.push_back(std::move(next));
            }
            for (auto& half : parts) {
                judge(half, propose);
                push(std::move(half));
            }
            return;
        }
        auto const wanted = explorer_.at_once();
        std::vector<inflation_box> blind;
        std::vector<inflation_box> others;
        blind.push_back(std::move(next));
        for (std::size_t looked = 0; looked < 2 * wanted && blind.size() < wanted && !exhausted();
             ++looked) {
            auto other = pop();
            (other.is_blind() ? blind : others).push_back(std::move(other));
        }
        for (auto& o : others) push(std::move(o));
        explorer_.learn(blind, go_on);
        for (auto& b : blind) {
            if (b.fresh) judge(b, propose);
            push(std::move(b));
        }
    }

private:
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

    /// Bounds a box by what is known of it.
    void judge(inflation_box& b, proposal const& propose) {
        ++tested_;
        for (auto const& r : b.known) {
            if (!r) return; // nothing is known
        }
        auto const found = inflation_bounder(b.known, outliers_, b.set)(target_);
        b.lower = std::max(b.lower, found.lower);
        b.smear = found.smear;
        propose(found, b.is_complete());
        double const missing = std::isfinite(above_) ? above_ - b.lower : std::max(b.lower, 1.0);
        bool ended = false; // early, and that holds the bound back
        for (std::size_t s = 0; s < b.known.size(); ++s) {
            auto const& r = *b.known[s];
            bool const cut = r.outputs() < r.measurements && found.slack < 0.5 * missing;
            b.stale[s] = cut || !(found.blur[s] <= 0.1 * missing);
            ended = ended || cut;
        }
        if (ended) b.smear = found.ending;
    }

    box_explorer explorer_;
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
