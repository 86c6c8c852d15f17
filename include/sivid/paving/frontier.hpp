// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_FRONTIER_HPP
#define SIVID_PAVING_FRONTIER_HPP

#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Order in which waiting boxes are taken.
enum class search_order {
    largest_first, ///< anytime: the outer volume falls fastest
    first_in       ///< the queue of the report's Algorithm 1
};

namespace paving_detail {

/// Waiting boxes as a heap: by volume, or by age.
template <class Knowledge>
class frontier {
public:
    explicit frontier(search_order order) : order_(order) {}

    struct item {
        box set;
        std::shared_ptr<Knowledge const> known;
        double volume = 0;
        double rank = 0;
        double age = 0;
    };

    void push(box x, double volume, std::shared_ptr<Knowledge const> known) {
        total_ += volume;
        double const age = static_cast<double>(pushed_++);
        double const rank = order_ == search_order::first_in ? -age : volume;
        items_.push_back({std::move(x), std::move(known), volume, rank, -age});
        std::push_heap(items_.begin(), items_.end(), after);
    }
    [[nodiscard]] item pop() {
        std::pop_heap(items_.begin(), items_.end(), after);
        auto next = std::move(items_.back());
        items_.pop_back();
        total_ -= next.volume;
        return next;
    }
    [[nodiscard]] bool empty() const { return items_.empty(); }
    [[nodiscard]] std::size_t size() const { return items_.size(); }
    [[nodiscard]] double volume() const { return std::max(0.0, total_); }
    /// The smallest box around `around` and all that waits.
    [[nodiscard]] box hull(box around) const {
        for (auto const& i : items_) around = sivid::hull(around, i.set);
        return around;
    }

private:
    static bool after(item const& a, item const& b) {
        return a.rank < b.rank || (a.rank == b.rank && a.age < b.age);
    }

    search_order order_;
    std::vector<item> items_;
    std::size_t pushed_ = 0;
    double total_ = 0;
};

/// The side to split: strongest smear, else widest against `whole`, among the sides that are wider
/// than the accuracy; nothing when there is none.
[[nodiscard]] inline std::optional<std::size_t>
side_to_split(box const& x, box const& whole, std::vector<double> const& smear, double accuracy) {
    std::optional<std::size_t> best;
    double best_rank = -1;
    for (std::size_t i = 0; i < x.size(); ++i) {
        double const all = width(whole[i]);
        double const share = all > 0 ? width(x[i]) / all : 0;
        double const middle = mid(x[i]);
        bool const splits = x[i].lower() < middle && middle < x[i].upper();
        if (!(share > accuracy) || !splits) continue;
        double const rank = smear.empty()   ? share
                            : smear[i] >= 0 ? smear[i]
                                            : 0; // NaN says nothing
        if (rank > best_rank ||
            (rank == best_rank && share > width(x[*best]) / width(whole[*best]))) {
            best = i;
            best_rank = rank;
        }
    }
    return best;
}

} // namespace paving_detail

} // namespace sivid

#endif
