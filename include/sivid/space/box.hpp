// SPDX-License-Identifier: MIT
#ifndef SIVID_SPACE_BOX_HPP
#define SIVID_SPACE_BOX_HPP

#include <sivid/number/interval_traits.hpp>
#include <sivid/number/rounding.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// A Cartesian product of intervals, \f$ [x_1] \times \dots \times [x_n] \f$; empty as soon as one
/// factor is empty. With a pack of W intervals, W boxes side by side: lane k of the sides is box k,
/// and what is asked of the box has an answer for each lane (`lane_mask`). What cuts a box, and the
/// boxes of lanes, is in `space/box_lanes.hpp`.
template <class I>
class basic_box {
    using traits = interval_traits<I>;

public:
    basic_box() = default;
    explicit basic_box(std::size_t n) : sides_(n, traits::point(0.0)) {}
    basic_box(std::initializer_list<I> sides) : sides_(sides) {}
    explicit basic_box(std::vector<I> sides) : sides_(std::move(sides)) {}

    [[nodiscard]] std::size_t size() const { return sides_.size(); }
    I& operator[](std::size_t i) { return sides_[i]; }
    I const& operator[](std::size_t i) const { return sides_[i]; }
    [[nodiscard]] auto begin() const { return sides_.begin(); }
    [[nodiscard]] auto end() const { return sides_.end(); }
    [[nodiscard]] I const* data() const { return sides_.data(); }

private:
    std::vector<I> sides_;
};

using box = basic_box<interval>;

/// One truth value for each lane of I: a bool, or the bits of a number.
template <class I>
using lane_mask = typename interval_traits<I>::mask;

/// An interval type of one lane: its boxes can be cut.
template <class I>
concept single_interval = interval_traits<I>::lanes == 1 && std::same_as<lane_mask<I>, bool>;

/// True in every lane.
template <class I>
[[nodiscard]] constexpr lane_mask<I> every_lane() {
    if constexpr (single_interval<I>) {
        return true;
    } else {
        return interval_traits<I>::all_lanes;
    }
}

template <class I>
[[nodiscard]] lane_mask<I> is_empty(basic_box<I> const& x) {
    lane_mask<I> any{};
    for (I const& side : x) any |= interval_traits<I>::is_empty(side);
    return any;
}

/// The box that holds one point.
template <class I = interval>
[[nodiscard]] basic_box<I> point_box(std::vector<double> const& x) {
    basic_box<I> result(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) result[i] = interval_traits<I>::point(x[i]);
    return result;
}

/// So many empty sides.
[[nodiscard]] inline basic_box<interval> empty_box(std::size_t sides) {
    return basic_box<interval>(std::vector<interval>(sides, interval_traits<interval>::empty()));
}

/// The smallest box that contains both; an empty operand adds nothing.
template <class I>
[[nodiscard]] basic_box<I> hull(basic_box<I> const& a, basic_box<I> const& b) {
    using traits = interval_traits<I>;
    if (is_empty(a) == every_lane<I>()) return b;
    if (is_empty(b) == every_lane<I>()) return a;
    basic_box<I> result(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        if constexpr (single_interval<I>) {
            result[i] = traits::hull(a[i], b[i]);
        } else { // a lane that is empty in one side is so in each
            auto const counted = [](I const& side, lane_mask<I> none) {
                return traits::intersect(side, traits::from_lanes(
                                                   [&](std::size_t k) {
                                                       return (none >> k & 1) != 0
                                                                  ? detail::not_a_number
                                                                  : -detail::infinity;
                                                   },
                                                   [](std::size_t) { return detail::infinity; }));
            };
            result[i] = traits::hull(counted(a[i], is_empty(a)), counted(b[i], is_empty(b)));
        }
    }
    return result;
}

template <class I>
[[nodiscard]] basic_box<I> intersect(basic_box<I> const& a, basic_box<I> const& b) {
    basic_box<I> result(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        result[i] = interval_traits<I>::intersect(a[i], b[i]);
    }
    return result;
}

/// What two intervals or boxes have in common; the first where that is nothing.
template <class Set>
[[nodiscard]] Set agreed(Set const& a, Set const& b) {
    auto common = intersect(a, b);
    return is_empty(common) ? a : common;
}

template <class I>
[[nodiscard]] lane_mask<I> subset(basic_box<I> const& a, basic_box<I> const& b) {
    auto all = every_lane<I>();
    for (std::size_t i = 0; i < a.size(); ++i) all &= interval_traits<I>::subset(a[i], b[i]);
    return static_cast<lane_mask<I>>(all | is_empty(a));
}

template <class I>
[[nodiscard]] lane_mask<I> contains(basic_box<I> const& a, std::vector<double> const& x) {
    auto all = every_lane<I>();
    for (std::size_t i = 0; i < a.size(); ++i) all &= interval_traits<I>::contains(a[i], x[i]);
    return all;
}

/// A point of the box close to its centre; finite even for unbounded sides.
template <class I>
[[nodiscard]] std::vector<double> mid(basic_box<I> const& x, std::size_t lane = 0) {
    std::vector<double> result(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) result[i] = interval_traits<I>::mid(x[i], lane);
    return result;
}

/// The point x moved into the box and off its bounds, which may be outward neighbours of the
/// decimals that are meant. A side that has no double off its bounds stays whole: what is proved
/// over the result holds for some point of the box that is meant.
/// @given  finite sides
template <single_interval I>
[[nodiscard]] basic_box<I> point_within(basic_box<I> const& where, std::vector<double> const& x) {
    using traits = interval_traits<I>;
    basic_box<I> result(where.size());
    for (std::size_t i = 0; i < where.size(); ++i) {
        // By a little of the width, lest a bound of 0 give a denormal number.
        double const off = 0x1p-50 * traits::width(where[i]);
        double const lo =
            std::max(traits::lower(where[i]) + off, detail::next_up(traits::lower(where[i])));
        double const hi =
            std::min(traits::upper(where[i]) - off, detail::next_down(traits::upper(where[i])));
        result[i] = lo <= hi ? traits::point(std::clamp(x[i], lo, hi)) : where[i];
    }
    return result;
}

/// The width of the widest side, rounded up.
template <class I>
[[nodiscard]] double width(basic_box<I> const& x, std::size_t lane = 0) {
    double result = 0;
    for (I const& side : x) result = std::max(result, interval_traits<I>::width(side, lane));
    return result;
}

/// The two halves of `x` along side `i`, cut at the double `at`; they share the face at the cut.
/// @throws std::invalid_argument when `at` does not lie in the side
template <single_interval I>
[[nodiscard]] std::pair<basic_box<I>, basic_box<I>> bisect(basic_box<I> const& x, std::size_t i,
                                                           double at) {
    using traits = interval_traits<I>;
    if (!traits::contains(x[i], at))
        throw std::invalid_argument("bisect: the cut is not in the box");
    auto below = x;
    auto above = x;
    below[i] = traits::bounds(traits::lower(x[i]), at);
    above[i] = traits::bounds(at, traits::upper(x[i]));
    return {std::move(below), std::move(above)};
}

namespace detail {
/// The least double of a side, and the largest: its bounds read inward.
template <class I>
[[nodiscard]] double first_double(I const& s) {
    double const lo = interval_traits<I>::lower(s);
    return std::isfinite(lo) && !interval_traits<I>::contains(s, lo) ? detail::next_up(lo) : lo;
}
template <class I>
[[nodiscard]] double last_double(I const& s) {
    double const hi = interval_traits<I>::upper(s);
    return std::isfinite(hi) && !interval_traits<I>::contains(s, hi) ? detail::next_down(hi) : hi;
}
} // namespace detail

/// Boxes that cover the closure of `outer` without `inner`; neighbours share faces only.
/// @returns at most 2n boxes; `{outer}` when `inner` is empty.
template <single_interval I>
[[nodiscard]] std::vector<basic_box<I>> difference(basic_box<I> const& outer,
                                                   basic_box<I> const& inner) {
    using traits = interval_traits<I>;
    if (is_empty(outer)) return {};
    if (is_empty(inner)) return {outer};
    std::vector<basic_box<I>> pieces;
    auto rest = outer;
    for (std::size_t i = 0; i < outer.size(); ++i) {
        double const lo = traits::lower(rest[i]);
        double const hi = traits::upper(rest[i]);
        double const a = std::max(lo, detail::first_double(inner[i]));
        double const b = std::min(hi, detail::last_double(inner[i]));
        if (a > b) return {outer};
        if (lo < a) {
            pieces.push_back(rest);
            pieces.back()[i] = traits::bounds(lo, a);
        }
        if (b < hi) {
            pieces.push_back(rest);
            pieces.back()[i] = traits::bounds(b, hi);
        }
        rest[i] = traits::bounds(a, b);
    }
    return pieces;
}

/// A box around `part`, at most as large as `whole`, whose sides end at multiples of 2^-16 of the
/// sides of `whole`: what is decided by it next hangs on no rounding, for instance on none that
/// other units bring. A bound that is such a multiple but for 2^-10 of one stays as it is.
/// @given  part in whole, not empty; sides without bounds stay as they are
[[nodiscard]] inline basic_box<interval> rounded_within(basic_box<interval> const& part,
                                                        basic_box<interval> const& whole) {
    constexpr double cells = 0x1p16, near = 0x1p-10;
    std::vector<interval> sides(part.begin(), part.end());
    for (std::size_t i = 0; i < sides.size(); ++i) {
        double const least = whole[i].lower(), most = whole[i].upper();
        double const cell = (most - least) / cells;
        if (!(cell > 0 && std::isfinite(cell))) continue;
        double const low = sides[i].lower(), high = sides[i].upper();
        double const below = least + std::floor((low - least) / cell + near) * cell;
        double const above = most - std::floor((most - high) / cell + near) * cell;
        sides[i] =
            interval(std::max(least, std::min(below, low)), std::min(most, std::max(above, high)));
    }
    return basic_box<interval>(std::move(sides));
}

/// Volume of `x` relative to `whole`, as an interval; sides of zero width in `whole` are left out.
/// @guarantee contains \f$ \prod_i w(x_i) / w(whole_i) \f$ in exact arithmetic.
template <single_interval I>
[[nodiscard]] I relative_volume(basic_box<I> const& x, basic_box<I> const& whole) {
    using traits = interval_traits<I>;
    if (is_empty(x)) return traits::point(0.0);
    auto const length = [](I const& s) {
        I const w = traits::sub(
            traits::hull(traits::point(detail::last_double(s)), traits::point(traits::upper(s))),
            traits::hull(traits::point(traits::lower(s)), traits::point(detail::first_double(s))));
        return traits::max(w, traits::point(0.0));
    };
    typename traits::mask undefined{};
    I result = traits::point(1.0);
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (traits::is_point(whole[i])) continue;
        result = traits::mul(result, traits::div(length(x[i]), length(whole[i]), undefined));
    }
    return result;
}

/// The ends of all sides in order: equal for equal boxes, and a key in maps.
[[nodiscard]] inline std::vector<double> ends_of(basic_box<interval> const& x) {
    std::vector<double> ends;
    ends.reserve(2 * x.size());
    for (auto const& side : x) {
        ends.push_back(side.lower());
        ends.push_back(side.upper());
    }
    return ends;
}

} // namespace sivid

#endif
