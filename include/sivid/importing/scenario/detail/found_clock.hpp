// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_SCENARIO_DETAIL_FOUND_CLOCK_HPP
#define SIVID_IMPORTING_SCENARIO_DETAIL_FOUND_CLOCK_HPP

#include <sivid/number/interval.hpp>
#include <sivid/number/interval_traits.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <list>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// One clock shows t + offset + drift t at time t of another, |t| <= ahead.
struct clock_prior {
    interval offset, drift, ahead;
};
/// What one clock is before the other at the first and at the last time; a line is between them.
/// What two signals tell of these two is a box, almost: events at the begin tell of one, those at
/// the end of the other.
struct clock_range {
    interval first, last;
};

/// A reading of what two files recorded, with its error.
struct shared_reading {
    interval time, value;
};

/// Finds how two clocks stand to each other by a signal that both files recorded: set inversion in
/// what one is before the other at both ends. For each reading at time t there are times of the
/// other clock at which the signal, as the other file tells it, cannot have had its value;
/// t + offset + drift t is none of them.
/// @guarantee  the range found is that of each offset and drift of the prior with which both files
///             tell the same, if no reading is beyond its error and the signal is as stated
/// @cost  O(readings^2), of some thousand that are taken evenly out of longer records
class clock_search {
public:
    /// The signal changes by so much a second at most.
    clock_search(std::vector<shared_reading> const& here, std::vector<shared_reading> const& there,
                 clock_prior const& prior, double rate) {
        auto const near = beside(here, there, prior);
        auto const candidates = evenly(near, most_beside);
        for (auto const* r : evenly(here, most_looks)) {
            never_.emplace_back();
            for (auto const* q : candidates) {
                // |value - q's| <= rate |time - q's| at the time of the reading
                double const gap = std::max((interval{r->value.lower()} - q->value).lower(),
                                            (interval{q->value.lower()} - r->value).lower());
                if (!(gap > 0)) continue;
                double const apart = (interval{gap} / interval{rate}).lower();
                add(never_.back(), (interval{q->time.upper()} - interval{apart}).upper(),
                    (interval{q->time.lower()} + interval{apart}).lower());
            }
            joined(never_.back());
            looks_.push_back({r->time, &never_.back()});
        }
    }
    /// The signal is above or below a level; between two readings that follow each other on one
    /// side it stays there.
    clock_search(std::vector<shared_reading> const& here, std::vector<shared_reading> const& there,
                 double level) {
        never_.resize(2); // where it is above, below
        auto const above = runs(there, level, true), below = runs(there, level, false);
        for (auto const& r : above) add(never_.front(), r.first.upper(), r.second.lower());
        for (auto const& r : below) add(never_.back(), r.first.upper(), r.second.lower());
        for (bool const side : {true, false}) {
            auto const seen = runs(here, level, side);
            for (auto const* r : evenly(seen, most_looks))
                for (auto const& time : {r->first, r->second})
                    looks_.push_back({time, side ? &never_.back() : &never_.front()});
        }
    }

    /// @returns nothing where no offset and drift of the prior will do
    [[nodiscard]] std::optional<clock_range> operator()(clock_prior const& prior) const {
        auto const moved = prior.drift * prior.ahead;
        clock_range range{prior.offset - moved, prior.offset + moved};
        for (int round = 0; round < 40; ++round) {
            auto const next = covered(range, prior);
            if (!next) return std::nullopt;
            bool const much = narrower(*next, range, 0.8);
            range = *next;
            if (!much) break;
        }
        return range;
    }

private:
    // Of longer records some readings are taken: four million pairs are a tenth of a second. Parts
    // of a 32nd leave the hull that much too wide, of which the next round begins.
    static constexpr std::size_t most_looks = 1000, most_beside = 4000;
    static constexpr double finest = 1.0 / 32;
    using times = std::vector<interval>;

    struct look {
        interval time;
        times const* never; ///< increasing, disjoint; their ends may be
    };

    static void add(times& to, double from, double until) {
        if (from < until) to.emplace_back(from, until);
    }
    static void joined(times& all) {
        std::sort(all.begin(), all.end(),
                  [](interval const& a, interval const& b) { return a.lower() < b.lower(); });
        times result;
        for (auto const& x : all) {
            if (!result.empty() && x.lower() < result.back().upper())
                result.back() = hull(result.back(), x);
            else
                result.push_back(x);
        }
        all = std::move(result);
    }
    template <class T>
    static std::vector<T const*> evenly(std::vector<T> const& all, std::size_t most) {
        std::vector<T const*> result;
        auto const step = std::max<std::size_t>(1, (all.size() + most - 1) / most);
        for (std::size_t k = 0; k < all.size(); k += step) result.push_back(&all[k]);
        return result;
    }
    /// Those of the other file that may be beside a reading.
    static std::vector<shared_reading> beside(std::vector<shared_reading> const& here,
                                              std::vector<shared_reading> const& there,
                                              clock_prior const& prior) {
        std::vector<shared_reading> near;
        if (here.empty()) return near;
        auto const apart =
            prior.offset + prior.drift * interval(-prior.ahead.upper(), prior.ahead.upper());
        auto const span = hull(here.front().time, here.back().time) + apart;
        for (auto const& r : there)
            if (overlap(r.time, span)) near.push_back(r);
        return near;
    }
    /// From the first to the last of readings that follow each other on one side of the level.
    static std::vector<std::pair<interval, interval>> runs(std::vector<shared_reading> const& all,
                                                           double level, bool above) {
        std::vector<std::pair<interval, interval>> result;
        bool going = false;
        for (auto const& r : all) {
            bool const there = above ? r.value.lower() > level : r.value.upper() < level;
            if (there && going) result.back().second = r.time;
            if (there && !going) result.emplace_back(r.time, r.time);
            going = there;
        }
        return result;
    }

    static bool narrower(clock_range const& x, clock_range const& than, double share) {
        return width(x.first) < share * width(than.first) ||
               width(x.last) < share * width(than.last);
    }

    /// Takes from both ends of what a clock may show what it never does; false: nothing is left.
    static bool cut(interval& shown, times const& never) {
        double low = shown.lower(), high = shown.upper();
        auto at = std::partition_point(never.begin(), never.end(),
                                       [&](interval const& x) { return x.lower() <= low; });
        if (at != never.begin()) {
            auto const& before = *std::prev(at);
            if (before.lower() < low && low < before.upper()) low = before.upper();
        }
        at = std::partition_point(never.begin(), never.end(),
                                  [&](interval const& x) { return x.upper() < high; });
        if (at != never.end() && at->lower() < high && high < at->upper()) high = at->lower();
        if (low > high) return false;
        shown = interval(low, high);
        return true;
    }
    [[nodiscard]] bool contract(clock_range& c, clock_prior const& prior) const {
        for (int round = 0; round < 20; ++round) {
            auto const before = c;
            if (!as_stated(c, prior)) return false;
            for (auto const& l : looks_)
                if (!as_seen(c, l, prior.ahead)) return false;
            if (!narrower(c, before, 0.95)) break;
        }
        return true;
    }
    /// first + last = 2 offset, last - first = 2 ahead drift.
    static bool as_stated(clock_range& c, clock_prior const& prior) {
        auto const sum = interval(2.0) * prior.offset;
        auto const difference = interval(2.0) * prior.ahead * prior.drift;
        return meet(c.first, sum - c.last) && meet(c.last, sum - c.first) &&
               meet(c.first, c.last - difference) && meet(c.last, c.first + difference);
    }
    /// The other clock never shows what the look excludes.
    static bool as_seen(clock_range& c, look const& l, interval const& ahead) {
        bool const line = ahead.lower() > 0;
        interval const half(0.5), part = line ? l.time / ahead * half : -half;
        auto const early = half - part, late = half + part; // shares of first and of last
        auto const all = l.time + early * c.first + late * c.last;
        auto shown = all;
        if (!cut(shown, *l.never)) return false;
        if (shown.lower() == all.lower() && shown.upper() == all.upper()) return true;
        auto const before = shown - l.time;
        if (early.lower() > 0 && !meet(c.first, (before - late * c.last) / early)) return false;
        return !(late.lower() > 0) || meet(c.last, (before - early * c.first) / late);
    }
    static bool meet(interval& x, interval const& y) {
        double const low = std::max(x.lower(), y.lower()), high = std::min(x.upper(), y.upper());
        if (low > high) return false;
        x = interval(low, high);
        return true;
    }

    /// The hull of what is left of the parts of a range.
    [[nodiscard]] std::optional<clock_range> covered(clock_range const& whole,
                                                     clock_prior const& prior) const {
        std::optional<clock_range> result;
        double const least = finest * std::max(width(whole.first), width(whole.last));
        std::vector<clock_range> open{whole};
        while (!open.empty()) {
            auto c = open.back();
            open.pop_back();
            if (!contract(c, prior)) continue;
            if (result && subset(c.first, result->first) && subset(c.last, result->last)) continue;
            auto const side =
                width(c.first) > width(c.last) ? &clock_range::first : &clock_range::last;
            double const middle = mid(c.*side);
            if (width(c.*side) > least && (c.*side).lower() < middle &&
                middle < (c.*side).upper()) {
                auto other = c;
                other.*side = interval(middle, (c.*side).upper());
                c.*side = interval((c.*side).lower(), middle);
                open.push_back(other);
                open.push_back(c);
            } else if (!result) {
                result = c;
            } else {
                *result = {hull(result->first, c.first), hull(result->last, c.last)};
            }
        }
        return result;
    }

    std::list<times> never_;
    std::vector<look> looks_;
};

} // namespace sivid

#endif // SIVID_IMPORTING_SCENARIO_DETAIL_FOUND_CLOCK_HPP
