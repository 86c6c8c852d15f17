// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_SEARCH_SEARCH_STATE_HPP
#define SIVID_PAVING_SEARCH_SEARCH_STATE_HPP

#include <sivid/paving/search/exclusion_proof.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/paving/verdict.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/box_cover.hpp>

#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid {

/// Everything that a paving search needs to go on where it was, as plain numbers.
///   What a test learnt about boxes is not in it: it holds the boxes of each call of `learn`
///   instead, and the resumed search learns from them again when it needs to, which gives the same.
struct search_state {
    /// Where a waiting box's knowledge came from.
    struct origin {
        std::size_t lesson = 0; ///< which call of `learn`
        std::size_t place = 0;  ///< which of its boxes
        std::size_t bytes = 0;  ///< that the knowledge takes
    };
    struct waiting_box {
        box set;
        double volume = 0;      ///< relative to the prior
        std::size_t number = 0; ///< in the order in which boxes began to wait
        std::optional<origin> known = std::nullopt;
    };

    box prior;
    std::vector<paved_box> paved;
    std::vector<waiting_box> waiting;
    std::vector<std::vector<box>> lessons;
    std::size_t pushed = 0; ///< boxes that have waited so far
    double waiting_volume = 0;
    std::size_t tested = 0;
    std::size_t cost = 0;
    std::size_t batches = 1;
    bool accuracy_reached = false; ///< some box was left because it is small
    box whole;                     ///< what the accuracy is a fraction of, and when it was measured
    std::size_t measured_at = 0;
    box last_hull; ///< at the last look, whether it rested then, and when the next one is due
    bool rested = false;
    std::size_t next_look = 0;
    double seconds = 0;
    double work = 0; ///< of the budget, by the `work_clock`
    /// Whether `paved` holds the boxes proved outside, too. Without them nobody can tell whether a
    /// box is missing.
    bool outside_kept = true;
    /// How what was excluded is proved; told on, trusted by nobody.
    exclusion_proof proof = {};

    /// All that is open to inspection, the covering included: where the outside boxes were kept,
    /// paved and waiting boxes together are the prior, exactly on the doubles of their bounds, and
    /// no two share volume.
    /// @throws std::invalid_argument  when it cannot be the state of a search
    void require_valid() const {
        auto const n = prior.size();
        auto const in_prior = [&](box const& x) {
            return x.size() == n && !is_empty(x) && subset(x, prior);
        };
        require(n > 0 && !is_empty(prior), "empty prior");
        for (auto const& side : prior) require(std::isfinite(width(side)), "unbounded prior");
        require(in_prior(whole) && in_prior(last_hull), "a hull outside the prior");
        for (auto const& b : paved) {
            require(in_prior(b.set), "a paved box outside the prior");
        }
        for (auto const& list : lessons) {
            for (auto const& x : list) require(in_prior(x), "a learnt box outside the prior");
        }
        for (auto const& w : waiting) {
            require(in_prior(w.set), "a waiting box outside the prior");
            require(w.volume >= 0 && w.number < pushed, "a waiting box that never began to wait");
            if (!w.known) continue;
            require(w.known->lesson < lessons.size() &&
                        w.known->place < lessons[w.known->lesson].size(),
                    "knowledge of nowhere");
        }
        require(seconds >= 0 && waiting_volume == waiting_volume && batches > 0, "wrong counters");
        require_volumes();
        std::vector<box> all;
        for (auto const& b : paved) all.push_back(b.set);
        for (auto const& w : waiting) all.push_back(w.set);
        auto const found = cover(prior, all);
        require(found.overlaps.empty(), "boxes that overlap");
        require(!outside_kept || found.gaps.empty(), "the boxes do not cover the prior");
    }

private:
    static void require(bool holds, char const* what) {
        if (!holds) throw std::invalid_argument(std::string{"search state: "} + what);
    }
    /// Volumes are redundant, but they decide which box is next and when a search ends.
    void require_volumes() const {
        double sum = 0;
        for (auto const& w : waiting) {
            double const own = relative_volume(w.set, prior).upper();
            require(std::abs(w.volume - own) <= 1e-9 * own, "a volume that is not the box's");
            sum += w.volume;
        }
        double const room = 1e-12 * (1 + static_cast<double>(pushed));
        require(std::abs(waiting_volume - sum) <= room, "a volume that is not that of what waits");
    }
};

} // namespace sivid

#endif
