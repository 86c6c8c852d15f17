// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_INFLATION_OBSERVER_REFUTATION_HPP
#define SIVID_PAVING_INFLATION_OBSERVER_REFUTATION_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/inflation/observer_effort.hpp>
#include <sivid/paving/observer/detail/observer_bank.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace sivid {

/// Splits a prior until interval observers refute every part at one inflation of the bounds.
///   Its boxes are small, since the observer is of first order, but each costs little, starts need
///   not be split, and long records are met with bounds that do not grow.
class observer_refutation {
public:
    /// @given  a valid problem whose model has no delays (checked)
    explicit observer_refutation(identification_problem const& problem)
        : prior_(problem.prior), cover_{prior_}, observers_(problem) {}

    /// Begins with the boxes that the last proof came to.
    /// @returns  true: proved, no parameter has an inflation of at most `level`
    /// @param go_on  false ends the search without a proof
    [[nodiscard]] bool operator()(double level, std::function<bool()> const& go_on) {
        std::vector<box> open = cover_;
        std::vector<box> refuted;
        while (!open.empty()) {
            if (!go_on()) return false;
            std::vector<box> batch;
            while (!open.empty() && batch.size() < observer_bank::width) {
                batch.push_back(std::move(open.back()));
                open.pop_back();
            }
            // A full pack costs little more than one box.
            while (2 * batch.size() <= observer_bank::width) {
                std::vector<box> halves;
                for (auto const& b : batch) {
                    if (!split(b, {}, halves)) return false;
                }
                batch = std::move(halves);
            }
            if (!judge(batch, level, go_on, refuted, open)) return false;
        }
        cover_ = std::move(refuted);
        return true;
    }
    [[nodiscard]] std::size_t tested() const { return tested_; }

private:
    /// @returns  false when a box is left that is too small to be split
    bool judge(std::vector<box> const& batch, double level, std::function<bool()> const& go_on,
               std::vector<box>& gone, std::vector<box>& open) {
        tested_ += batch.size();
        auto const found = observers_(batch, level, go_on);
        for (std::size_t b = 0; b < batch.size(); ++b) {
            if (found.refuted[b]) {
                gone.push_back(batch[b]);
            } else if (!split(batch[b], found.influence[b], open)) {
                return false;
            }
        }
        return true;
    }
    /// Halves the side of most influence.
    [[nodiscard]] bool split(box const& b, std::vector<double> const& influence,
                             std::vector<box>& to) const {
        double most = -1;
        std::size_t side = b.size();
        for (std::size_t j = 0; j < b.size(); ++j) {
            double const share = width(b[j]) / std::max(width(prior_[j]), 1e-300);
            if (!(share > smallest_share)) continue;
            double const worth = influence.empty() ? share : influence[j] + 1e-9 * share;
            if (worth > most) most = worth, side = j;
        }
        if (side == b.size()) return false;
        auto halves = bisect(b, side, mid(b[side]));
        to.push_back(std::move(halves.first));
        to.push_back(std::move(halves.second));
        return true;
    }

    static constexpr double smallest_share = 1e-6; ///< of the prior's side

    box prior_;
    std::vector<box> cover_; ///< of the prior
    observer_bank observers_;
    std::size_t tested_ = 0;
};

/// Whether a state starts anywhere in a good part of its own range: sets of trajectories are then
/// too wide to be carried far, and observers are of more use.
[[nodiscard]] inline bool has_wide_starts(identification_problem const& problem) {
    auto const& states = problem.model.about.states;
    for (auto const& e : problem.experiments) {
        for (std::size_t i = 0; i < states.size(); ++i) {
            if (width(e.initial[i]) > 0.1 * states[i].limit) return true;
        }
    }
    return false;
}

struct observer_bound {
    double lower = 0; ///< proved: no parameter has a smaller inflation; 0 or above 1
    std::size_t boxes = 0;
};

/// A lower bound of the inflation by interval observers, for problems whose starts are too wide, or
/// whose records are too long, for `bound_inflation`.
/// @param upper    a number that the inflation does not exceed
/// @guarantee  no parameter of the prior has an inflation below `lower`
[[nodiscard]] inline observer_bound
inflation_refuted_by_observers(identification_problem const& problem, double upper,
                               observer_effort const& most = {}) {
    work_limit const limit(most.seconds, most.go_on);
    observer_refutation refuted(problem);
    auto const go_on = [&] { return refuted.tested() < most.boxes && limit(); };
    observer_bound proved;
    double level = std::nextafter(1.0, 2.0);
    while (level < 0.9 * upper) {
        auto const before = refuted.tested();
        if (!refuted(level, go_on)) break;
        proved.lower = level;
        if (most.only_verdict) break;
        level = std::isfinite(upper) ? std::sqrt(level * upper) : 2 * level;
        // A higher level takes more than the last one.
        if (refuted.tested() + (refuted.tested() - before) > most.boxes) break;
    }
    proved.boxes = refuted.tested();
    return proved;
}

} // namespace sivid

#endif
