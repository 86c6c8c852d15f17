// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_IMPL_GAIN_SEARCH_IPP
#define SIVID_DECISION_IMPL_GAIN_SEARCH_IPP

#include <sivid/decision/gain_search.hpp>

#include <sivid/compiled.hpp>
#include <sivid/decision/motion/detail/gain_test.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace decision_detail {

inline std::vector<std::size_t> sides_of(prediction_problem const& p,
                                         std::vector<std::string> const& gains) {
    std::vector<std::size_t> sides;
    for (auto const& name : gains) {
        auto const& all = p.choice.unknown;
        auto const at = std::find(all.begin(), all.end(), name);
        if (at == all.end())
            throw std::invalid_argument("find_gains: '" + name + "' is no unknown of the problem");
        sides.push_back(static_cast<std::size_t>(at - all.begin()));
    }
    return sides;
}

inline box ranges_of(prediction_problem const& p, std::vector<std::size_t> const& sides) {
    auto const around = p.around();
    std::vector<interval> ranges;
    for (auto const s : sides) {
        ranges.push_back(around[s]);
        for (auto const& set : p.sets) {
            if (set[s].lower() != around[s].lower() || set[s].upper() != around[s].upper())
                throw std::invalid_argument(
                    "find_gains: every set must hold the whole range of each gain");
        }
    }
    return box(std::move(ranges));
}

/// The best of single gains, by what is proved of each for all parameters taken together.
class best_gain {
public:
    best_gain(gain_test& test, box ranges, work_limit limit)
        : test_(&test), ranges_(std::move(ranges)), limit_(std::move(limit)) {}

    /// Points that fill the ranges, then what lies around the best ones, closer and closer.
    void search() {
        try_around(centre(), 1, 4 * test_->at_once());
        double reach = 0.25;
        double const until = 0.7 * limit_.seconds(); // the rest is the paving's
        for (int round = 0; round < 12 && limit_.seconds() > until && !(best_ && found_.proved());
             ++round) {
            try_around(best_ ? *best_ : centre(), reach, test_->at_once());
            reach *= 0.7;
        }
    }
    /// Middles of the largest boxes that are proved.
    void try_inside(subpaving const& paving) {
        std::vector<std::pair<double, box const*>> inside;
        for (auto const& b : paving.boxes()) {
            if (b.verdict == box_verdict::inside)
                inside.emplace_back(-relative_volume(b.set, paving.prior()).upper(), &b.set);
        }
        std::stable_sort(inside.begin(), inside.end(),
                         [](auto const& a, auto const& b) { return a.first < b.first; });
        inside.resize(std::min<std::size_t>(inside.size(), 2 * test_->at_once()));
        std::vector<std::vector<double>> gains;
        for (auto const& [volume, set] : inside) {
            auto& g = gains.emplace_back();
            for (auto const& side : *set)
                g.push_back(few_digits(side.lower(), side.upper(), mid(side), width(side)));
        }
        judge(gains);
    }
    [[nodiscard]] std::optional<std::vector<double>> const& gain() const { return best_; }
    [[nodiscard]] truth const& found() const { return found_; }

private:
    [[nodiscard]] std::vector<double> centre() const { return mid(ranges_); }

    /// So many points of a Halton sequence, in a share of the ranges around a point.
    void try_around(std::vector<double> const& point, double share, std::size_t count) {
        static constexpr std::array<unsigned, 8> primes{2, 3, 5, 7, 11, 13, 17, 19};
        std::vector<std::vector<double>> gains;
        for (std::size_t k = 0; k < count; ++k) {
            auto& g = gains.emplace_back();
            ++drawn_;
            for (std::size_t j = 0; j < ranges_.size(); ++j) {
                double x = 0, digit = 1;
                auto const base = primes[j % primes.size()];
                for (auto n = drawn_; n > 0; n /= base) x += (digit /= base) * (n % base);
                auto const& range = ranges_[j];
                double const reach = share * width(range);
                double const at =
                    std::clamp(point[j] + (x - 0.5) * reach, range.lower(), range.upper());
                g.push_back(few_digits(range.lower(), range.upper(), at, 0.02 * reach));
            }
        }
        judge(gains);
    }
    void judge(std::vector<std::vector<double>> const& gains) {
        std::vector<box> points;
        for (auto const& g : gains) {
            std::vector<interval> sides(g.begin(), g.end());
            points.emplace_back(std::move(sides));
        }
        auto const says = test_->robustness(points);
        for (std::size_t k = 0; k < says.size(); ++k) { // fewer where time ended
            if (best_ && !(says[k].low > found_.low)) continue;
            best_ = gains[k];
            found_ = says[k];
        }
    }

    gain_test* test_;
    box ranges_;
    work_limit limit_;
    std::optional<std::vector<double>> best_;
    truth found_;
    unsigned drawn_ = 0;
};

/// The largest of some boxes around a gain that is proved; empty where none is.
inline box tolerance_of(gain_test& test, std::vector<double> const& gain, box const& ranges) {
    for (double const share : {0.1, 0.05, 0.02, 0.01, 0.005, 0.002}) {
        std::vector<interval> sides;
        for (std::size_t k = 0; k < gain.size(); ++k) {
            double const reach = 0.5 * share * width(ranges[k]);
            sides.push_back(
                interval_traits<interval>::bounds(std::max(gain[k] - reach, ranges[k].lower()),
                                                  std::min(gain[k] + reach, ranges[k].upper())));
        }
        box const around(std::move(sides));
        if (test(around, nullptr).verdict == box_verdict::inside) return around;
        if (test.cancelled()) break;
    }
    return {};
}

} // namespace decision_detail

SIVID_DECL bool gain_set::some_proved() const {
    return paving.paving.count(box_verdict::inside) > 0 || (suggested && found.proved());
}
SIVID_DECL bool gain_set::none_exists() const { return !paving.paving.has_outer(); }

SIVID_DECL gain_set find_gains(prediction_problem const& problem,
                               std::vector<std::string> const& gains, requirement const& what,
                               feasible_points const& feasible, gain_options const& options) {
    stopwatch const clock;
    decision_detail::require_asked(problem, what);
    if (feasible.direct != nullptr) decision_detail::require_asked(*feasible.direct, what);
    if (gains.empty()) throw std::invalid_argument("find_gains: no gain is named");
    auto const sides = decision_detail::sides_of(problem, gains);
    auto const direct_sides =
        feasible.direct == nullptr ? sides : decision_detail::sides_of(*feasible.direct, gains);
    auto const ranges = decision_detail::ranges_of(problem, sides);
    std::vector<double> smallest;
    for (auto const& r : ranges) smallest.push_back(options.accuracy * width(r));
    work_limit const limit(options.motions.seconds, options.motions.keep_going);
    decision_detail::gain_test test(problem, sides, direct_sides, what, feasible, options.motions,
                                    smallest, limit);
    inversion_options inverting;
    inverting.accuracy = options.accuracy;
    inverting.sufficient_ratio = 1;
    inverting.boxes = options.boxes;
    inverting.keep_going = limit;
    decision_detail::best_gain best(test, ranges, limit);
    best.search();
    inverting.seconds = 0.85 * limit.seconds();
    gain_set result{gains, invert(test, ranges, inverting)};
    best.try_inside(result.paving.paving);
    if (best.gain() && best.found().proved()) {
        result.suggested = best.gain();
        result.found = best.found();
        result.tolerance = decision_detail::tolerance_of(test, *best.gain(), ranges);
    }
    result.against = test.against();
    result.unknown = test.unknown();
    result.parts = test.parts();
    result.integrations = test.integrations();
    result.seconds = clock.spent();
    return result;
}

SIVID_DECL prediction_problem with_gains(prediction_problem problem,
                                         std::vector<std::string> const& gains,
                                         std::vector<double> const& values) {
    auto const sides = decision_detail::sides_of(problem, gains);
    for (auto& set : problem.sets) {
        for (std::size_t k = 0; k < sides.size(); ++k) set[sides[k]] = interval(values.at(k));
    }
    return problem;
}

} // namespace sivid

#endif
