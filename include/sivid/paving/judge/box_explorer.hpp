// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_BOX_EXPLORER_HPP
#define SIVID_PAVING_JUDGE_BOX_EXPLORER_HPP

#include <sivid/executor.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace sivid {

/// A box of parameters with what is known of the experiments over it.
struct explored_box {
    box set;
    std::vector<std::shared_ptr<response const>> known; ///< of a box around it, or none
    std::vector<bool> stale;   ///< experiments that should be integrated anew
    bool fresh = false;        ///< the stale ones were integrated over exactly this box
    std::vector<double> smear; ///< per parameter: sides with more are split first

    /// Whether integrating over this box would say more of it.
    [[nodiscard]] bool is_blind() const {
        return !fresh && std::find(stale.begin(), stale.end(), true) != stale.end();
    }
    /// Memory that it takes; what is known is shared, and counted by the explorer.
    [[nodiscard]] std::size_t bytes() const {
        return sizeof *this + set.size() * sizeof(interval) + known.size() * sizeof known[0] +
               smear.size() * sizeof(double);
    }
    /// Whether every measurement was reached.
    [[nodiscard]] bool is_complete() const {
        return std::all_of(known.begin(), known.end(),
                           [](auto const& r) { return r && r->outputs() == r->measurements; });
    }
};

/// How many outliers each experiment allows.
[[nodiscard]] inline std::vector<std::size_t>
outlier_budgets(identification_problem const& problem) {
    std::vector<std::size_t> result;
    for (auto const& e : problem.experiments) result.push_back(e.outliers);
    return result;
}

/// Splits boxes of parameters and integrates the experiments over them, to the last measurement
/// that can be reached: violated measurements end nothing.
class box_explorer {
public:
    box_explorer(identification_problem const& problem, feasibility_test_options const& options)
        : everything_(without_limit(problem)),
          test_(everything_, options),
          workers_(options.workers) {}
    box_explorer(box_explorer const&) = delete;
    box_explorer& operator=(box_explorer const&) = delete;

    /// The problem with a budget of outliers that covers all measurements.
    [[nodiscard]] static identification_problem without_limit(identification_problem problem) {
        for (auto& e : problem.experiments) e.outliers = e.measurements.size();
        return problem;
    }

    [[nodiscard]] std::size_t integrations() const { return test_.integrations(); }
    [[nodiscard]] std::size_t at_once() const { return test_.at_once(); }
    /// Bytes of the responses that it found and that somebody still keeps.
    [[nodiscard]] std::size_t bytes() const { return *held_; }

    /// A part of the prior of which nothing is known but what `b` says beside.
    template <std::derived_from<explored_box> Box>
    [[nodiscard]] Box unknown(box set, Box b = {}) const {
        b.set = std::move(set);
        b.known.resize(everything_.experiments.size());
        b.stale.assign(everything_.experiments.size(), true);
        return b;
    }

    /// The two halves, which know what the whole knew; none when no side can be split.
    template <std::derived_from<explored_box> Box>
    [[nodiscard]] std::vector<Box> halves(Box const& b) const {
        auto const side =
            paving_detail::side_to_split(b.set, everything_.prior, b.smear, smallest_share);
        if (!side) return {};
        auto [low, high] = bisect(b.set, *side, mid(b.set[*side]));
        std::vector<Box> result(2, b);
        result[0].set = std::move(low);
        result[1].set = std::move(high);
        for (auto& half : result) {
            half.fresh = false;
            if (!half.smear.empty()) half.smear[*side] /= 4; // about what another look would say
        }
        return result;
    }

    /// Integrates the stale experiments of all boxes. A full pack costs little more than one box:
    /// while there are few boxes their halves take their place.
    /// @param go_on  false ends the work between two experiments; the boxes are not fresh then.
    ///               Called by one thread at a time
    template <std::derived_from<explored_box> Box>
    void learn(std::vector<Box>& boxes, std::function<bool()> const& go_on) {
        while (!boxes.empty() && 2 * boxes.size() <= at_once()) {
            std::vector<Box> parts;
            for (auto const& b : boxes) {
                for (auto& half : halves(b)) parts.push_back(std::move(half));
            }
            if (parts.size() < 2 * boxes.size()) break; // one cannot be split
            boxes = std::move(parts);
        }
        std::mutex asking;
        bool stopped = false;
        workers_(everything_.experiments.size(), [&](std::size_t s) {
            {
                std::lock_guard const alone(asking);
                stopped = stopped || !go_on();
                if (stopped) return;
            }
            std::vector<box> sets;
            std::vector<Box*> whose;
            for (auto& b : boxes) {
                if (!b.stale[s]) continue;
                sets.push_back(b.set);
                whose.push_back(&b);
            }
            if (sets.empty()) return;
            auto answers = test_.run(s, everything_.experiments[s].initial, sets);
            for (std::size_t k = 0; k < whose.size(); ++k) {
                whose[k]->known[s] = counted(std::move(answers[k]));
            }
        });
        if (stopped) return;
        for (auto& b : boxes) b.fresh = true;
    }

private:
    static constexpr double smallest_share = 1e-9; ///< of the prior's side

    /// The same response, counted as long as somebody keeps it.
    [[nodiscard]] std::shared_ptr<response const> counted(std::shared_ptr<response const> r) const {
        if (!r) return r;
        auto const* const plain = r.get();
        auto const bytes = r->bytes();
        *held_ += bytes;
        return {plain, [r = std::move(r), bytes, held = held_](auto const*) { *held -= bytes; }};
    }

    identification_problem everything_;
    feasibility_test test_;
    executor workers_;
    std::shared_ptr<std::atomic<std::size_t>> held_ =
        std::make_shared<std::atomic<std::size_t>>(std::size_t{0});
};

} // namespace sivid

#endif
