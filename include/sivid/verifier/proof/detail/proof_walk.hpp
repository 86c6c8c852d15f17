// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_PROOF_DETAIL_PROOF_WALK_HPP
#define SIVID_VERIFIER_PROOF_DETAIL_PROOF_WALK_HPP

#include <sivid/paving/response/response.hpp>
#include <sivid/paving/search/exclusion_proof.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/box_cover.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// Walks along a proof of what is excluded: keeps the current box, what is known of it, and what no
/// step has proved. Steps that make no sense change nothing, so that whatever the proof says the
/// boxes that are left open hold all that is neither proved nor in a row.
class proof_walk {
public:
    /// @param rows  boxes of which nothing is claimed
    /// @param keep_going  once false, rows may be in what is left open; may be empty
    proof_walk(box const& prior, std::vector<box> rows, std::size_t experiments,
               std::function<bool()> keep_going = nullptr)
        : rows_(std::move(rows)), keep_going_(std::move(keep_going)) {
        std::vector<std::size_t> all(rows_.size());
        for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
        waiting_.push_back({prior, response_list(experiments), std::move(all)});
    }

    [[nodiscard]] bool done() const { return waiting_.empty(); }
    /// The current box. @given  not `done()`
    [[nodiscard]] box const& cell() const { return waiting_.back().set; }

    /// @param found  of an experiment over the current box
    void learn(std::size_t experiment, std::shared_ptr<response const> found) {
        waiting_.back().known[experiment] = std::move(found);
    }

    /// @param excluded  whether what is known proves that a part of the current box holds nothing:
    ///   (response_list, box) -> bool
    template <class Excluded>
    void take(proof_step const& step, Excluded const& excluded) {
        using kind = proof_step::kind;
        auto& now = waiting_.back();
        bool const has_side = step.index < now.set.size();
        if (step.what == kind::cut && has_side) {
            auto const part = beyond(now.set, step);
            if (is_empty(part)) return;
            if (!excluded(now.known, part)) leave(part, now.rows);
            now.set = before(now.set, step);
            if (is_empty(now.set)) waiting_.pop_back();
        } else if (step.what == kind::split && has_side) {
            if (!contains(now.set[step.index], step.at)) return;
            auto [low, high] = bisect(now.set, step.index, step.at);
            auto upper = now;
            for (auto* const half : {&low, &high}) {
                auto& to = half == &low ? now : upper;
                to.set = std::move(*half);
                std::erase_if(to.rows,
                              [&](std::size_t k) { return is_empty(intersect(rows_[k], to.set)); });
            }
            std::swap(now, upper); // the lower half is next
            waiting_.push_back(std::move(upper));
        } else if (step.what == kind::empty || step.what == kind::leaf) {
            if (step.what == kind::leaf || !excluded(now.known, now.set)) leave(now.set, now.rows);
            waiting_.pop_back();
        }
    }

    /// What is in no row and was not proved, that to which no step came included.
    [[nodiscard]] std::vector<box> open() && {
        for (auto const& w : waiting_) leave(w.set, w.rows);
        return std::move(open_);
    }

private:
    struct place {
        box set;
        response_list known; ///< by experiment, null where nothing is known
        std::vector<std::size_t> rows;
    };

    void leave(box const& part, std::vector<std::size_t> const& rows) {
        std::vector<box> meeting;
        if (keep_going_ && !keep_going_()) {
            open_.push_back(part);
            return;
        }
        for (auto const k : rows) {
            auto common = intersect(rows_[k], part);
            if (subset(part, common)) return;
            if (!is_empty(common)) meeting.push_back(std::move(common));
        }
        for (auto& gap : cover(part, meeting, 2e-15, keep_going_).gaps)
            open_.push_back(std::move(gap));
    }

    std::vector<box> rows_;
    std::function<bool()> keep_going_;
    std::vector<place> waiting_; ///< the current one last
    std::vector<box> open_;
};

} // namespace sivid

#endif
