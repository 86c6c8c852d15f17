// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_SEARCH_FRONTIER_HPP
#define SIVID_PAVING_SEARCH_FRONTIER_HPP

#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
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

/// A size by which boxes are ordered: to 24 bits, so that halves of a box are of one size, however
/// their bounds are rounded.
[[nodiscard]] inline double rank_of(double size) {
    if (!std::isfinite(size)) return size;
    int e = 0;
    double const m = std::frexp(size, &e);
    return std::ldexp(std::round(std::ldexp(m, 24)), e - 24);
}

/// Waiting boxes as a heap: by volume, or by age.
/// @tparam Load  what waits with a box
template <class Load>
class frontier {
public:
    explicit frontier(search_order order) : order_(order) {}

    struct item {
        box set;
        double volume = 0;
        std::size_t number = 0; ///< in the order of coming
        Load load{};
    };

    void push(box x, double volume, Load load) {
        total_ += volume;
        items_.push_back({std::move(x), volume, pushed_++, std::move(load)});
        std::push_heap(items_.begin(), items_.end(), after());
    }
    [[nodiscard]] item pop() {
        std::pop_heap(items_.begin(), items_.end(), after());
        auto next = std::move(items_.back());
        items_.pop_back();
        total_ -= next.volume;
        return next;
    }
    /// Items as they were when `pushed` had come and `volume()` was `total`.
    void restore(std::vector<item> items, std::size_t pushed, double total) {
        items_ = std::move(items);
        std::make_heap(items_.begin(), items_.end(), after());
        pushed_ = pushed;
        total_ = total;
    }
    struct moment {
        std::size_t pushed;
        double volume;
    };
    [[nodiscard]] moment now() const { return {pushed_, total_}; }
    /// Undoes what was taken, and put back in vain, since.
    /// @param moved  the numbers that items had which were put back, in the order of putting back
    void back_to(moment const& before, std::vector<item> taken,
                 std::vector<std::size_t> const& moved = {}) {
        for (auto& i : items_) {
            if (i.number >= before.pushed) i.number = moved[i.number - before.pushed];
            taken.push_back(std::move(i));
        }
        restore(std::move(taken), before.pushed, before.volume);
    }
    [[nodiscard]] bool empty() const { return items_.empty(); }
    [[nodiscard]] std::size_t size() const { return items_.size(); }
    [[nodiscard]] std::size_t pushed() const { return pushed_; }
    [[nodiscard]] double volume() const { return std::max(0.0, total_); }
    /// As summed up, with its rounding errors.
    [[nodiscard]] double running_volume() const { return total_; }
    /// In no particular order.
    [[nodiscard]] std::vector<item> const& items() const { return items_; }
    /// The next one, which must exist.
    [[nodiscard]] item const& next() const { return items_.front(); }
    /// The next items in their order, at most `count`; valid until the next push or pop.
    [[nodiscard]] std::vector<item*> best(std::size_t count) {
        std::vector<item*> result;
        std::vector<std::size_t> open;
        auto const later = [this](std::size_t a, std::size_t b) {
            return after()(items_[a], items_[b]);
        };
        auto const look_at = [&](std::size_t i) {
            if (i >= items_.size()) return;
            open.push_back(i);
            std::push_heap(open.begin(), open.end(), later);
        };
        look_at(0);
        while (result.size() < count && !open.empty()) {
            std::pop_heap(open.begin(), open.end(), later);
            auto const i = open.back();
            open.pop_back();
            result.push_back(&items_[i]);
            look_at(2 * i + 1);
            look_at(2 * i + 2);
        }
        return result;
    }
    /// The smallest box around `around` and all that waits.
    [[nodiscard]] box hull(box around) const {
        for (auto const& i : items_) around = sivid::hull(around, i.set);
        return around;
    }

private:
    [[nodiscard]] auto after() const {
        return [order = order_](item const& a, item const& b) {
            if (order == search_order::largest_first) {
                double const one = rank_of(a.volume), other = rank_of(b.volume);
                if (one != other) return one < other;
            }
            return a.number > b.number;
        };
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
    double best_rank = -1, best_share = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        double const all = width(whole[i]);
        double const share = all > 0 ? width(x[i]) / all : 0;
        double const middle = mid(x[i]);
        bool const splits = x[i].lower() < middle && middle < x[i].upper();
        if (!(share > accuracy) || !splits) continue;
        double const rank = rank_of(smear.empty()   ? share
                                    : smear[i] >= 0 ? smear[i]
                                                    : 0); // NaN says nothing
        double const own = rank_of(share);
        if (rank > best_rank || (rank == best_rank && own > best_share)) {
            best = i;
            best_rank = rank;
            best_share = own;
        }
    }
    return best;
}

} // namespace paving_detail

} // namespace sivid

#endif
