// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_REQUIREMENT_IMPL_ROBUSTNESS_IPP
#define SIVID_DECISION_REQUIREMENT_IMPL_ROBUSTNESS_IPP

#include <sivid/decision/requirement/robustness.hpp>

#include <sivid/compiled.hpp>
#include <sivid/number/rounding.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

namespace decision_detail {

inline void both(truth& a, truth const& b) {
    if (b.low < a.low) {
        a.low = b.low;
        a.low_from = b.low_from;
    }
    if (b.high < a.high) {
        a.high = b.high;
        a.high_from = b.high_from;
    }
    a.certain = a.certain && b.certain;
    a.possible = a.possible && b.possible;
}
inline truth opposite(truth const& a) {
    return {-a.high, -a.low, !a.possible, !a.certain, a.high_from, a.low_from};
}
inline void either(truth& a, truth const& b) {
    a = opposite(a);
    both(a, opposite(b));
    a = opposite(a);
}

/// Operands of `both` and `either` that change nothing.
inline truth always_true() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {infinity, infinity, true, true, {}, {}};
}
inline truth always_false() { return opposite(always_true()); }

/// a + b, downward and upward.
struct directed_sum {
    double down, up;
    directed_sum(double a, double b) : down(a + b), up(down) {
        if (!std::isfinite(down)) return;
        double const part = down - a;
        double const lost = (a - (down - part)) + (b - part);
        if (lost < 0) down = detail::next_down(down);
        if (lost > 0) up = detail::next_up(up);
    }
};

class evaluation {
public:
    evaluation(requirement const& what, margin_bounds const& bounds) : what_(&what), b_(&bounds) {}

    /// The truth of a part at the segments first .. last.
    [[nodiscard]] std::vector<truth> operator()(std::size_t index, std::size_t first,
                                                std::size_t last) const {
        using kind = requirement::kind;
        auto const& p = what_->parts[index];
        switch (p.what) {
        case kind::comparison:
            return of_comparison(p, first, last);
        case kind::negation:
            return opposites((*this)(p.first, first, last));
        case kind::conjunction:
        case kind::disjunction:
        case kind::provided:
            return combined(p, first, last);
        case kind::at: {
            auto const s = segment_at(p.from);
            return std::vector(last - first + 1, (*this)(p.first, s, s).front());
        }
        case kind::always:
        case kind::eventually:
            return over_windows(p, first, last);
        case kind::until: {
            std::vector<truth> result;
            auto const to = touched(last, p).second;
            auto const before = (*this)(p.first, first, to);
            auto const after = (*this)(p.second, first, to);
            for (std::size_t s = first; s <= last; ++s)
                result.push_back(until(before, after, first, s, p));
            return result;
        }
        }
        return std::vector<truth>(last - first + 1);
    }

private:
    using range = std::pair<std::size_t, std::size_t>;

    [[nodiscard]] std::vector<truth> of_comparison(requirement::part const& p, std::size_t first,
                                                   std::size_t last) const {
        std::vector<truth> result;
        for (std::size_t s = first; s <= last; ++s) {
            result.push_back(truth_of_margin(b_->low[p.comparison][s], b_->high[p.comparison][s],
                                             p.strict, {p.comparison, s}));
        }
        return result;
    }
    [[nodiscard]] static std::vector<truth> opposites(std::vector<truth> of) {
        for (auto& x : of) x = opposite(x);
        return of;
    }
    /// Of two parts: both, either, or the first one provided that the second holds.
    [[nodiscard]] std::vector<truth> combined(requirement::part const& p, std::size_t first,
                                              std::size_t last) const {
        using kind = requirement::kind;
        auto result = (*this)(p.first, first, last);
        auto const other = (*this)(p.second, first, last);
        for (std::size_t k = 0; k < result.size(); ++k) {
            if (p.what == kind::disjunction)
                either(result[k], other[k]);
            else
                both(result[k], other[k]);
            if (p.what == kind::provided) result[k].kept = result[k].kept && other[k].certain;
        }
        return result;
    }
    /// Always, or not always the contrary.
    [[nodiscard]] std::vector<truth> over_windows(requirement::part const& p, std::size_t first,
                                                  std::size_t last) const {
        bool const some = p.what == requirement::kind::eventually;
        auto const from = touched(first, p).first, to = touched(last, p).second;
        auto of = (*this)(p.first, from, to);
        if (some) of = opposites(std::move(of));
        std::vector<truth> result;
        for (std::size_t s = first; s <= last; ++s) result.push_back(lowest(of, from, s, p));
        return some ? opposites(std::move(result)) : result;
    }

    /// The segment that holds an instant.
    [[nodiscard]] std::size_t segment_at(double t) const {
        auto const& times = b_->times;
        auto const next = std::lower_bound(times.begin(), times.end(), t);
        if (next == times.end()) return b_->segments() - 1;
        auto const k = static_cast<std::size_t>(next - times.begin());
        return *next == t || k == 0 ? 2 * k : 2 * k - 1;
    }
    /// All segments that the window of some instant of s meets.
    [[nodiscard]] range touched(std::size_t s, requirement::part const& p) const {
        auto const from = segment_at(directed_sum(b_->begin_of(s), p.from).down);
        auto const to = segment_at(directed_sum(b_->end_of(s), p.to).up);
        return {std::min(from, to), to};
    }
    /// The segments that the windows of all instants of s meet: first > last when there are none.
    [[nodiscard]] range met(std::size_t s, requirement::part const& p) const {
        double const low = directed_sum(b_->end_of(s), p.from).up;
        double const high = std::min(directed_sum(b_->begin_of(s), p.to).down, b_->times.back());
        auto const meets = [&](std::size_t k) {
            double const begin = b_->begin_of(k), end = b_->end_of(k);
            if (k % 2 == 0) return low <= begin && begin <= high;
            bool const between = s % 2 == 1; // then the instants lie strictly inside, too
            return (between ? begin <= high && low <= end : begin < high && low < end);
        };
        auto first = segment_at(low), last = segment_at(high);
        if (first > 0) --first;
        while (first <= last && !meets(first)) ++first;
        while (last > first && !meets(last)) --last;
        if (first > last || !meets(last)) return {1, 0};
        return {first, last};
    }

    /// The infimum over the window. What lies in some window bounds it from below, what meets every
    /// window bounds it from above.
    [[nodiscard]] truth lowest(std::vector<truth> const& of, std::size_t offset, std::size_t s,
                               requirement::part const& p) const {
        auto result = always_true();
        auto const [from, to] = touched(s, p);
        for (auto k = from; k <= to; ++k) {
            auto const& x = of[k - offset];
            if (x.low < result.low) {
                result.low = x.low;
                result.low_from = x.low_from;
            }
            result.certain = result.certain && x.certain;
        }
        auto const [first, last] = met(s, p);
        for (auto k = first; k <= last; ++k) {
            auto const& x = of[k - offset];
            if (x.high < result.high) {
                result.high = x.high;
                result.high_from = x.high_from;
            }
            result.possible = result.possible && x.possible;
        }
        return result;
    }

    [[nodiscard]] truth until(std::vector<truth> const& before, std::vector<truth> const& after,
                              std::size_t offset, std::size_t s, requirement::part const& p) const {
        auto result = always_false();
        { // from below: g in a segment that all windows meet, f up to its end; at an instant f may
          // end there, and now needs no f at all
            auto const [first, last] = met(s, p);
            auto so_far = always_true();
            for (auto k = s; first <= last && k <= last; ++k) {
                auto here = after[k - offset];
                if (k % 2 == 0) both(here, so_far);
                both(so_far, before[k - offset]);
                if (k % 2 == 1 && !(k == s && p.from == 0)) both(here, so_far);
                if (k < first) continue;
                if (here.low > result.low) {
                    result.low = here.low;
                    result.low_from = here.low_from;
                }
                result.certain = result.certain || here.certain;
            }
        }
        // from above: f certainly counts where it stands before the segment of g
        auto const [from, to] = touched(s, p);
        auto so_far = always_true();
        for (auto k = s; k <= to; ++k) {
            if (k >= from) {
                auto here = after[k - offset];
                both(here, so_far);
                if (here.high > result.high) {
                    result.high = here.high;
                    result.high_from = here.high_from;
                }
                result.possible = result.possible || here.possible;
            }
            both(so_far, before[k - offset]);
        }
        return result;
    }

    requirement const* what_;
    margin_bounds const* b_;
};

} // namespace decision_detail

SIVID_DECL truth truth_of_margin(double low, double high, bool strict, decisive_place where) {
    truth result;
    result.low_from = result.high_from = where;
    if (!(low <= high)) return result; // NaN: nothing is known
    result.low = low;
    result.high = high;
    result.certain = strict ? low > 0 : low >= 0;
    result.possible = strict ? high > 0 : high >= 0;
    return result;
}

SIVID_DECL truth evaluate(requirement const& what, margin_bounds const& bounds) {
    if (what.parts.empty() || bounds.times.size() < 2)
        throw std::invalid_argument("evaluate: a formula and two times are needed");
    if (bounds.low.size() < what.margins.size() || bounds.high.size() < what.margins.size())
        throw std::invalid_argument("evaluate: bounds of every comparison are needed");
    for (std::size_t c = 0; c < what.margins.size(); ++c) {
        if (bounds.low[c].size() != bounds.segments() || bounds.high[c].size() != bounds.segments())
            throw std::invalid_argument("evaluate: bounds of every segment are needed");
    }
    return decision_detail::evaluation(what, bounds)(what.parts.size() - 1, 0, 0).front();
}

} // namespace sivid

#endif
