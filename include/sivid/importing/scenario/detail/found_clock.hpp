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

/// What one clock shows at time t of another: t + offset + drift t.
struct clock_range {
    interval offset, drift;
};

/// A reading of what two files recorded, with its error.
struct shared_reading {
    interval time, value;
};

/// Finds how two clocks stand to each other by a signal that both files recorded: set inversion in
/// offset and drift. For each reading at time t there are times of the other clock at which the
/// signal, as the other file tells it, cannot have had its value; t + offset + drift t is none of
/// them.
/// @guarantee  the range found holds each offset and drift of the prior with which both files tell
///             the same, if no reading is beyond its error and the signal is as stated
/// @cost  O(readings^2), of some thousand that are taken evenly out of longer records
class clock_search {
public:
    /// The signal changes by so much a second at most.
    clock_search(std::vector<shared_reading> const& here, std::vector<shared_reading> const& there,
                 clock_range const& prior, double rate) {
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
    [[nodiscard]] std::optional<clock_range> operator()(clock_range range) const {
        for (int round = 0; round < 40; ++round) {
            auto const next = covered(range);
            if (!next) return std::nullopt;
            bool const much = width(next->offset) < 0.8 * width(range.offset) ||
                              width(next->drift) < 0.8 * width(range.drift);
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
                                              clock_range const& prior) {
        std::vector<shared_reading> near;
        if (here.empty()) return near;
        auto const span = hull(shown(here.front().time, prior), shown(here.back().time, prior));
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

    static interval shown(interval const& t, clock_range const& c) {
        return t + c.offset + c.drift * t;
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
    [[nodiscard]] bool contract(clock_range& c) const {
        for (int round = 0; round < 20; ++round) {
            auto const before = c;
            for (auto const& l : looks_) {
                auto time = shown(l.time, c);
                auto const all = time;
                if (!cut(time, *l.never)) return false;
                if (time.lower() == all.lower() && time.upper() == all.upper()) continue;
                if (!meet(c.offset, time - l.time - c.drift * l.time)) return false;
                if (l.time.lower() > 0 || l.time.upper() < 0)
                    if (!meet(c.drift, (time - l.time - c.offset) / l.time)) return false;
            }
            bool const much = width(c.offset) < 0.95 * width(before.offset) ||
                              width(c.drift) < 0.95 * width(before.drift);
            if (!much) break;
        }
        return true;
    }
    static bool meet(interval& x, interval const& y) {
        double const low = std::max(x.lower(), y.lower()), high = std::min(x.upper(), y.upper());
        if (low > high) return false;
        x = interval(low, high);
        return true;
    }

    /// The hull of what is left of the parts of a range.
    [[nodiscard]] std::optional<clock_range> covered(clock_range const& whole) const {
        std::optional<clock_range> result;
        auto const share = [](interval const& x, interval const& of) {
            return width(of) > 0 ? width(x) / width(of) : 0.0;
        };
        std::vector<clock_range> open{whole};
        while (!open.empty()) {
            auto c = open.back();
            open.pop_back();
            if (!contract(c)) continue;
            if (result && subset(c.offset, result->offset) && subset(c.drift, result->drift))
                continue;
            double const a = share(c.offset, whole.offset), b = share(c.drift, whole.drift);
            auto& side = a > b ? c.offset : c.drift;
            double const middle = mid(side);
            if (std::max(a, b) > finest && side.lower() < middle && middle < side.upper()) {
                auto other = c;
                (a > b ? other.offset : other.drift) = interval(middle, side.upper());
                side = interval(side.lower(), middle);
                open.push_back(other);
                open.push_back(c);
            } else if (!result) {
                result = c;
            } else {
                *result = {hull(result->offset, c.offset), hull(result->drift, c.drift)};
            }
        }
        return result;
    }

    std::list<times> never_;
    std::vector<look> looks_;
};

} // namespace sivid

#endif // SIVID_IMPORTING_SCENARIO_DETAIL_FOUND_CLOCK_HPP
