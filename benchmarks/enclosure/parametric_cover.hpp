// SPDX-License-Identifier: MIT
#ifndef SIVID_BENCHMARKS_ENCLOSURE_PARAMETRIC_COVER_HPP
#define SIVID_BENCHMARKS_ENCLOSURE_PARAMETRIC_COVER_HPP

#include <sivid/enclosure/taylor/parametric_flow.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace benchmark {
using namespace sivid;

/// A part of a box of starts and parameters with the family that it leads to.
struct covered_part {
    box initial;
    box parameters;
    parametric_set<taylor_model<double>> set; ///< at the end, in the part's own unknowns
    std::size_t steps = 0;
};

struct parametric_cover {
    std::vector<covered_part> parts;
    std::size_t failed = 0; ///< parts that were tried and split
    /// Why it stopped before all was covered.
    std::optional<enclosure_failure> failure;

    [[nodiscard]] bool complete() const { return !failure; }
    /// A box that contains all trajectories' ends.
    [[nodiscard]] box hull() const {
        box result;
        for (auto const& p : parts) {
            auto const h = p.set.hull();
            if (result.size() == 0) result = h;
            for (std::size_t i = 0; i < h.size(); ++i) {
                result[i] = interval_traits<interval>::hull(result[i], h[i]);
            }
        }
        return result;
    }
};

struct cover_options {
    /// Halve so many times before the first run, in turn along the sides with a width: as many
    /// parts as there are lanes keep all of them busy.
    std::size_t first_halvings = 0;
    std::size_t most_parts = 10'000;
};

/// The side, of the starts and then of the parameters, along which the states of a lane vary most:
/// by the linear terms, each state measured against its own range.
template <class Model>
[[nodiscard]] std::size_t steepest_side(parametric_flow<Model> const& run, std::size_t lane) {
    using C = typename Model::scalar;
    auto const& u = run.unknowns(lane);
    auto const& about = run.equations().model().about.states;
    std::size_t best = 0;
    double most = -1;
    auto const look = [&](normalised_unknowns::side const& s, std::size_t side) {
        if (s.radius == 0) return;
        double slope = 0;
        for (std::size_t i = 0; i < about.size(); ++i) {
            auto const& p = run.set().centre[i];
            double const c = lane_traits<C>::get(p.c()[p.space().variable(s.variable)], lane);
            slope += std::abs(c) / about[i].limit;
        }
        if (!(slope > most)) return;
        most = slope;
        best = side;
    };
    for (std::size_t i = 0; i < u.initial.size(); ++i) look(u.initial[i], i);
    for (std::size_t j = 0; j < u.parameters.size(); ++j) {
        look(u.parameters[j], u.initial.size() + j);
    }
    if (most >= 0) return best;
    // Nothing is finite: the widest side.
    double widest = -1;
    auto const width_of = [&](normalised_unknowns::side const& s, std::size_t side) {
        if (s.radius > widest) {
            widest = s.radius;
            best = side;
        }
    };
    for (std::size_t i = 0; i < u.initial.size(); ++i) width_of(u.initial[i], i);
    for (std::size_t j = 0; j < u.parameters.size(); ++j) {
        width_of(u.parameters[j], u.initial.size() + j);
    }
    return best;
}

/// Encloses a family over a box that is too wide for one set: parts are carried side by side in
/// the lanes of one flow; where a part fails it is halved, along the unknown on which its states
/// depended most when it failed, and a lane that is free takes the next part.
/// @guarantee  if complete, the parts cover the box, and each part's set contains all its ends
/// @tparam C  `double`, or `lanes<W>` for W parts at a time
template <class C = double>
[[nodiscard]] parametric_cover cover(std::size_t variables, std::size_t degree, flow const& f,
                                     enclosure_options const& options, box const& initial,
                                     box const& parameters, double begin, double end,
                                     cover_options const& choice = {}) {
    using side_by_side = lane_traits<C>;
    constexpr std::size_t width = side_by_side::count;
    using part = std::pair<box, box>;
    parametric_cover result;
    std::deque<part> waiting{{initial, parameters}};
    auto const halve = [&](part const& whole, std::size_t side) {
        std::array<part, 2> halves{whole, whole};
        bool const start = side < whole.first.size();
        auto const place = start ? side : side - whole.first.size();
        auto const& x = start ? whole.first[place] : whole.second[place];
        double const middle = mid(x);
        for (std::size_t h = 0; h < 2; ++h) {
            auto& target = start ? halves[h].first[place] : halves[h].second[place];
            target = h == 0 ? interval(x.lower(), middle) : interval(middle, x.upper());
        }
        for (auto& h : halves) waiting.push_back(std::move(h));
    };
    auto const widths = [](part const& p) {
        std::vector<std::size_t> sides;
        normalised_unknowns const u(p.first, p.second);
        for (std::size_t i = 0; i < u.initial.size(); ++i) {
            if (u.initial[i].radius > 0) sides.push_back(i);
        }
        for (std::size_t j = 0; j < u.parameters.size(); ++j) {
            if (u.parameters[j].radius > 0) sides.push_back(u.initial.size() + j);
        }
        return sides;
    };
    auto const sides = widths(waiting.front());
    for (std::size_t k = 0; k < choice.first_halvings && !sides.empty(); ++k) {
        for (std::size_t n = waiting.size(); n > 0; --n) {
            auto const whole = waiting.front();
            waiting.pop_front();
            halve(whole, sides[k % sides.size()]);
        }
    }
    parametric_flow<taylor_model<C>> run(f, options, variables, degree);
    std::array<std::optional<part>, width> lane;
    std::size_t in_work = 0;
    while (!waiting.empty() || in_work > 0) {
        for (std::size_t l = 0; l < width && !waiting.empty(); ++l) {
            if (lane[l]) continue;
            run.begin(l, begin, waiting.front().first, waiting.front().second);
            lane[l] = std::move(waiting.front());
            waiting.pop_front();
            ++in_work;
        }
        (void)run.advance(C(end));
        for (std::size_t l = 0; l < width; ++l) {
            if (!lane[l]) continue;
            if (run.failure(l)) {
                ++result.failed;
                if (result.parts.size() + waiting.size() + in_work >= choice.most_parts ||
                    widths(*lane[l]).empty()) {
                    result.failure = run.failure(l);
                    return result;
                }
                halve(*lane[l], steepest_side(run, l));
            } else if (!(run.time(l) < end)) {
                result.parts.push_back(
                    {lane[l]->first, lane[l]->second, lane_of(run.set(), l), run.steps(l)});
                run.end(l);
            } else {
                continue;
            }
            lane[l].reset();
            --in_work;
        }
    }
    return result;
}

} // namespace benchmark

#endif
