// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_CANDIDATE_ORDER_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_CANDIDATE_ORDER_HPP

#include <sivid/approximate/candidate/candidate.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid {

/// Which candidate is the answer, and in which order the others are told.
class candidate_order {
public:
    /// @param all  the model itself first
    candidate_order(std::vector<candidate> all, std::size_t measurements,
                    choice_options const& options)
        : all_(std::move(all)) {
        auto const chosen = choose(all_, measurements, options);
        explained_ = chosen.explained;
        answer_ = chosen.explained ? chosen.best : closest_candidate(all_);
        others_ = chosen.others;
        for (std::size_t i = 1; i < all_.size(); ++i) order_.push_back(i);
        std::stable_sort(order_.begin(), order_.end(),
                         [this](std::size_t a, std::size_t b) { return place(a) < place(b); });
    }

    [[nodiscard]] bool explained() const { return explained_; }
    /// The closest candidate where none explains the data.
    [[nodiscard]] std::size_t answer() const { return answer_; }
    /// What the data cannot tell from the answer, likeliest first.
    [[nodiscard]] std::vector<std::size_t> const& others() const { return others_; }
    /// All but the model itself: the answer, the others, then by inflation; last what only adds to
    /// an answer that explains.
    [[nodiscard]] std::vector<std::size_t> const& order() const { return order_; }

    /// Whether a witness of candidate i is worth a validated run.
    [[nodiscard]] bool of_interest(std::size_t i) const {
        return place(i) < 0 || (all_[i].explains() && !adds_to_answer(i));
    }

private:
    [[nodiscard]] double place(std::size_t i) const {
        if (i == answer_) return -3;
        for (std::size_t k = 0; k < others_.size(); ++k) {
            if (others_[k] == i) return -2 + 0.1 * static_cast<double>(k);
        }
        double const inflation = all_[i].inflation;
        return adds_to_answer(i) ? 1e6 + inflation : std::min(inflation, 1e6);
    }
    [[nodiscard]] bool adds_to_answer(std::size_t i) const {
        auto const& best = all_[answer_];
        auto const& own = all_[i].effects;
        return best.explains() && i != answer_ &&
               std::includes(own.begin(), own.end(), best.effects.begin(), best.effects.end());
    }

    std::vector<candidate> all_;
    bool explained_ = false;
    std::size_t answer_ = 0;
    std::vector<std::size_t> others_, order_;
};

} // namespace sivid

#endif
