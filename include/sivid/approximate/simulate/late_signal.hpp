// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_SIMULATE_LATE_SIGNAL_HPP
#define SIVID_APPROXIMATE_SIMULATE_LATE_SIGNAL_HPP

#include <sivid/approximate/simulate/approximate_program.hpp>
#include <sivid/measurement/dead_time.hpp>
#include <sivid/measurement/limited_signal.hpp>
#include <sivid/measurement/played_signal.hpp>
#include <sivid/model/bound_model.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// An input as a model sees it that has a dead time, with u(begin) before, a play or a rate limit.
/// In plain doubles.
class late_signal {
public:
    late_signal(signal const& source, double begin) : begin_(begin) {
        if (auto const* samples = std::get_if<sampled_signal>(&source)) {
            samples_ = *samples;
            return;
        }
        auto const& formula = std::get<analytic_signal>(source);
        formula_ = approximate_program(formula.g, {formula.value}, program_shape{});
        memory_ = formula_.memory();
        formula_.prepare(memory_);
        is_formula_ = true;
    }

    /// Whether the value jumps at knots.
    [[nodiscard]] bool jumps() const {
        return !is_formula_ && samples_.kind() == interpolation::hold;
    }
    /// A sampled signal as it is.
    [[nodiscard]] double recorded_at(double t) const { return samples_.approximate(t); }
    static constexpr double no_limit = std::numeric_limits<double>::infinity();

    /// From now on the input behind this rate limit, then behind a play of this half-width, if
    /// there is one, until `end`.
    void remember(double rate_limit, std::optional<double> half_width, double end) {
        if (is_formula_) {
            std::vector<double> times, values;
            for (int k = 0; k <= fine; ++k) {
                times.push_back(begin_ + (end - begin_) * k / fine);
                values.push_back(at({}, times.back()));
                if (!(end > begin_)) break;
            }
            samples_ = sampled_signal(std::move(times), std::move(values), interpolation::linear);
            is_formula_ = false;
        }
        if (!recorded_) recorded_ = samples_;
        samples_ = recorded_->nominal();
        by_play_.clear();
        if (rate_limit < no_limit) {
            limited_ = rate_limited(samples_, begin_, end, interval(rate_limit));
            samples_ = limited_.within.nominal();
        }
        if (!half_width) return;
        auto behind = played(samples_, begin_, end, interval(*half_width));
        samples_ = std::move(behind.within);
        by_play_ = std::move(behind.slope_by_width);
    }
    /// Appends the knots within (from, to), as late as they are.
    void knots(dead_time const& late, double from, double to, std::vector<double>& out) const {
        // Before the begin a late signal stands still; another one has its own knots.
        double const stands = late.any() ? late.seen(begin_, begin_) : from;
        if (late.any() && stands < to) out.push_back(stands);
        if (is_formula_) return;
        auto const& times = samples_.times();
        double const first = late.any() ? std::max(begin_, late.source(from, begin_)) : from;
        auto k = std::upper_bound(times.begin(), times.end(), first);
        for (; k != times.end(); ++k) {
            double const at = late.any() ? late.seen(*k, begin_) : *k;
            if (!(at < to)) break;
            if (at > from) out.push_back(at);
        }
    }

    /// A straight piece: value at its begin and slope; slope by the half-width of a play; slope by
    /// a rate limit at its begin (behind a play: of what comes before), and its change per second.
    struct line {
        double value = 0, slope = 0, by_play = 0, by_limit = 0, limit_change = 0;
    };
    /// On (from, to), between neighbouring knots.
    [[nodiscard]] line on(dead_time const& late, double from, double to) {
        double const middle = past(late, 0.5 * (from + to));
        if (late.any() && middle <= begin_) return {at({}, begin_), 0};
        if (is_formula_) {
            double const a = at(late, from);
            return {a, to > from ? (at(late, to) - a) / (to - from) : 0};
        }
        auto const k = samples_.piece(middle);
        double const a = samples_.approximate_on(k, past(late, from));
        double const b = samples_.approximate_on(k, past(late, to));
        line result{a, to > from ? (b - a) / (to - from) : 0};
        if (k < by_play_.size()) result.by_play = by_play_[k];
        if (!limited_.slope_change.empty()) {
            auto const j = limited_.within.piece(middle);
            double const change = limited_.slope_change[j];
            result.limit_change = change * (1 - late.drift);
            result.by_limit = limited_.slope_by_limit[j] +
                              change * (past(late, from) - limited_.within.times()[j]);
        }
        return result;
    }
    /// At one time; after a jump.
    [[nodiscard]] double at(dead_time const& late, double t) {
        double const source = late.any() ? late.source(t, begin_) : t;
        if (!is_formula_) return samples_.approximate(source);
        memory_[0] = source;
        formula_.run(memory_);
        return memory_[formula_.output(0)];
    }
    static constexpr int fine = 400; ///< straight pieces of a formula do
    [[nodiscard]] bool is_formula() const { return is_formula_; }

private:
    /// `dead_time::source` without its end at the begin, for lines that begin there.
    [[nodiscard]] double past(dead_time const& late, double t) const {
        return t - late.delay - late.drift * (t - begin_);
    }

    double begin_;
    sampled_signal samples_;
    std::optional<sampled_signal> recorded_; ///< before the limit and the play
    limited_signal limited_;
    std::vector<double> by_play_; ///< slopes by its half-width, by piece
    approximate_program formula_;
    std::vector<double> memory_;
    bool is_formula_ = false;
};

} // namespace sivid

#endif
