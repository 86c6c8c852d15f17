// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_CANDIDATE_DETAIL_EPISODE_FIT_HPP
#define SIVID_APPROXIMATE_CANDIDATE_DETAIL_EPISODE_FIT_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/approximate/candidate/detail/candidate_fit.hpp>
#include <sivid/approximate/candidate/detail/deepest_valley.hpp>
#include <sivid/approximate/candidate/detail/soft_switch.hpp>
#include <sivid/approximate/fit/detail/thinned.hpp>
#include <sivid/approximate/fit/fit.hpp>
#include <sivid/model/affected_problem.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Fits when an effect begins or ends in each experiment, at times of its own. Its switch is a
/// smooth step in time (a step up, down, or both), which has a slope to follow, then a sharper one,
/// at last a jump at a time with few digits. A sensor that is late from a time on has no such
/// steps: jumps and all else are fitted in turn. Nothing here is proved.
class episode_fit {
public:
    /// @param base    without effects; outlives this object
    /// @param always  parameters with the effect from the start on
    episode_fit(identification_problem const& base, effect e, std::vector<double> always,
                episode_ends ends, std::function<bool()> go_on)
        : base_(&base),
          effect_(std::move(e)),
          ends_(ends),
          go_on_(std::move(go_on)),
          always_(std::move(always)) {
        for (auto const& x : base_->experiments) {
            names_.push_back(x.name);
            spans_.push_back(x.end() - x.begin);
        }
        known_.parameters = always_;
        auto const& late = affected(*base_, {effect_}).model.channel_delays;
        jumps_only_ = late.size() > base_->model.channel_delays.size();
    }

    [[nodiscard]] std::string const& name() const { return effect_.name; }
    /// How far the step misses the data, so far as was looked; the less, the likelier.
    [[nodiscard]] double squares() const { return known_.squares; }

    /// Where the steps are roughly, by few of the measurements.
    void look_roughly() {
        // Shares of the experiments at which it begins and ends, to start from.
        std::vector<std::pair<double, double>> starts{{0.25, 0.75}, {0.6, 0.4}};
        if (ends_.begins && ends_.ends) starts = {{0.2, 0.6}, {0.4, 0.8}};
        if (jumps_only_) return look_roughly_by_jumps(starts);
        auto const wide = thinned(softened(0.15), few_measurements);
        approximate_fitter descend(wide, go_on_);
        for (auto const& [on, off] : starts) {
            take(descend({placed(always_, on, off), {}}, fit_norm::squares));
            auto const other = awakened(descend, on, off);
            if (!other.empty()) take(descend({other, {}}, fit_norm::squares));
        }
        look_everywhere(0.06, few_measurements);
        follow(0.06, few_measurements, fit_norm::squares);
        follow(0.03, few_measurements, fit_norm::squares);
    }
    /// The same, from where a search with one step of the two ended.
    /// @given  this one has both
    void look_roughly(episode_fit const& one_step) {
        if (one_step.known_.parameters.size() <= always_.size()) return;
        auto from = one_step.known_.parameters;
        auto const place = static_cast<std::ptrdiff_t>(always_.size()) +
                           (one_step.ends_.begins ? std::ssize(names_) : 0);
        from.insert(from.begin() + place, names_.size(), one_step.ends_.begins ? 1.0 : 0.0);
        if (jumps_only_) return settle(std::move(from));
        auto const sharper = thinned(softened(0.06), few_measurements);
        take(approximate_fitter(sharper, go_on_)({std::move(from), {}}, fit_norm::squares));
    }
    /// By all of them, as sharply as it is; then the fit with the effect switched on there.
    void look_closely() {
        if (jumps_only_) {
            known_.squares = detail::infinity; // of few measurements so far
            settle(known_.parameters, many_measurements);
            fit_at_jumps(8);
            better(2, [this] { settle(known_.parameters, many_measurements); });
            return;
        }
        for (double const length : {0.06, 0.03}) {
            look_everywhere(length, many_measurements);
            follow(length, many_measurements, fit_norm::squares);
        }
        for (double const length : {0.015, 0.008, 0.004})
            follow(length, many_measurements, fit_norm::squares);
        follow(0.002, many_measurements, fit_norm::largest);
        fit_at_jumps(4);
        // Jumps fit a little elsewhere than smooth steps do.
        better(5, [this] { move_jumps(); });
        better(1.5, [this] {
            for (int again = 0; again < 3; ++again) {
                move_jumps();
                for (double const width : {0.02, 0.004}) fit_jumps(width, fit_norm::squares);
            }
        });
        for (double const width : {0.02, 0.004, 0.001, 0.0002})
            better(1.5, [this, width] { fit_jumps(width, fit_norm::largest); });
    }

    [[nodiscard]] bool explains() const { return fit_.inflation <= 1; }
    /// The effect with its times, its problem and fit.
    /// @given  it explains
    [[nodiscard]] effect acting() const { return only_within(effect_, acting_, since_, until_); }
    /// How many times were chosen.
    [[nodiscard]] std::size_t times() const { return since_.size() + until_.size(); }
    [[nodiscard]] identification_problem const& problem() const { return problem_; }
    [[nodiscard]] approximate_fit const& fit() const { return fit_; }

private:
    static constexpr std::size_t few_measurements = 600;

    /// Sums of each experiment; infinite where nothing was simulated.
    [[nodiscard]] std::vector<double>
    squares_of(std::vector<std::vector<double>> const& residuals) const {
        std::vector<double> sums(names_.size(),
                                 residuals.size() == names_.size() ? 0.0 : detail::infinity);
        for (std::size_t s = 0; s < std::min(sums.size(), residuals.size()); ++s)
            for (double const r : residuals[s]) sums[s] += r * r;
        return sums;
    }
    /// These parameters, and these shares of every experiment.
    [[nodiscard]] std::vector<double> placed(std::vector<double> from, double on,
                                             double off) const {
        if (ends_.begins) from.insert(from.end(), names_.size(), on);
        if (ends_.ends) from.insert(from.end(), names_.size(), off);
        return from;
    }
    /// The same with another value of the effect's only parameter, where that fits better: all the
    /// time it may fit best where it sleeps. Else nothing.
    [[nodiscard]] std::vector<double> awakened(approximate_fitter& at, double on,
                                               double off) const {
        if (effect_.parameters.size() != 1) return {};
        auto const misfit = [&](std::vector<double> const& parameters) {
            auto const sums = squares_of(at.roughly_at(parameters, {}).residuals);
            return std::accumulate(sums.begin(), sums.end(), 0.0);
        };
        double least = misfit(placed(always_, on, off));
        std::vector<double> best;
        for (double const share : {0.1, 0.2, 0.35, 0.5, 0.75}) {
            auto other = always_;
            auto const all = effect_.parameters[0].prior();
            other.back() = all.lower() + share * (all.upper() - all.lower());
            other = placed(std::move(other), on, off);
            double const squares = misfit(other);
            if (!(squares < least)) continue;
            least = squares;
            best = std::move(other);
        }
        return best;
    }
    /// Fits with the effect switched on and off where the shares say.
    void fit_at_jumps(int digits) {
        if (!decide_times(known_.parameters, digits)) return;
        problem_ = jumping();
        fit_start from{known_.parameters, {}};
        from.parameters.resize(problem_.prior.size());
        auto const fitted = off_limits(problem_);
        approximate_fitter descend(fitted, go_on_);
        fit_ = descend(from, fit_norm::largest);
        if (fit_.inflation > 1 && fit_.inflation < 5) leave_corners(fitted, descend, fit_);
        if (!(fit_.inflation > 1 && fit_.inflation < 1.05)) return;
        auto closer = descend({fit_.parameters, fit_.starts}, fit_norm::largest);
        if (!(closer.inflation < fit_.inflation)) return;
        closer.squares = fit_.squares;
        fit_ = std::move(closer);
    }
    /// Moves the jumps of a fit that nearly explains, and keeps that where it fits better.
    /// @param nearly  the inflation up to which it does
    template <class Move>
    void better(double nearly, Move const& move) {
        if (!(fit_.inflation > 1 && fit_.inflation < nearly) || !go_on_()) return;
        auto const before = *this;
        std::copy_n(fit_.parameters.begin(), always_.size(), known_.parameters.begin());
        known_.starts = fit_.starts;
        move();
        fit_at_jumps(4);
        if (fit_.inflation > 1) fit_at_jumps(8);
        if (!(fit_.inflation < before.fit_.inflation)) *this = before;
    }
    void look_roughly_by_jumps(std::vector<std::pair<double, double>> const& starts) {
        for (auto const& [on, off] : starts) {
            for (double const share : {0.0, 0.2, 0.5, 0.8}) { // 0: as it is all the time
                auto from = always_;
                auto const all = effect_.parameters.front().prior();
                auto& first = from[base_->prior.size()];
                if (share > 0) first = all.lower() + share * (all.upper() - all.lower());
                settle(placed(std::move(from), on, off));
            }
        }
    }
    /// Moves jumps and fits all else in turn, from there on; kept where that is better.
    void settle(std::vector<double> from, std::size_t measurements = few_measurements) {
        auto best = std::move(known_);
        known_ = {};
        known_.parameters = std::move(from);
        for (int again = 0; again < 3 && go_on_(); ++again) {
            move_jumps(measurements);
            if (!decide_times(known_.parameters, 8)) break;
            auto const now = thinned(off_limits(jumping()), measurements);
            std::vector<double> own(known_.parameters.begin(),
                                    known_.parameters.begin() + std::ssize(always_));
            auto const found =
                approximate_fitter(now, go_on_)({std::move(own), {}}, fit_norm::squares);
            if (found.parameters.empty() || !(found.squares < known_.squares)) break;
            std::copy(found.parameters.begin(), found.parameters.end(), known_.parameters.begin());
            known_.starts = found.starts;
            known_.squares = found.squares;
        }
        if (!(known_.squares < best.squares)) known_ = std::move(best);
    }
    /// Puts jumps where they fit best.
    void move_jumps(std::size_t measurements = many_measurements) {
        if (jumps_only_) return place_between_samples(measurements);
        auto const misfits = [&](std::vector<double> const& parameters) {
            if (!go_on_() || !decide_times(parameters, 8)) return squares_of({});
            auto const now = thinned(off_limits(jumping()), measurements);
            auto own = parameters;
            own.resize(always_.size());
            return squares_of(approximate_fitter(now, go_on_).at(own, known_.starts).residuals);
        };
        place_steps(misfits, 32, 1e-4);
    }
    /// The same for a sensor, of which each sample alone is late or not: between the samples where
    /// that fits best.
    void place_between_samples(std::size_t measurements) {
        auto const on_time = thinned(*base_, measurements);
        auto const late = thinned(affected(*base_, {effect_}), measurements);
        auto own = known_.parameters;
        own.resize(always_.size());
        auto const behind = approximate_fitter(late, go_on_).at(own, known_.starts).residuals;
        own.resize(base_->prior.size());
        auto const ahead = approximate_fitter(on_time, go_on_).at(own, known_.starts).residuals;
        if (ahead.size() != names_.size() || behind.size() != names_.size()) return;
        auto* const own_steps = known_.parameters.data() + always_.size();
        for (std::size_t s = 0; s < names_.size(); ++s) {
            std::vector<double> gains, shares;
            for (auto const& m : sorted(on_time.experiments[s].measurements)) {
                auto const k = gains.size();
                gains.push_back(ahead[s][k] * ahead[s][k] - behind[s][k] * behind[s][k]);
                shares.push_back((m.time - base_->experiments[s].begin) / spans_[s]);
            }
            auto const [on, off] = best_window(gains, shares, ends_);
            if (ends_.begins) own_steps[s] = on;
            if (ends_.ends) own_steps[s + (steps() - 1) * names_.size()] = off;
        }
    }
    /// Puts each step where it fits its experiment best, all else as it is (`deepest_valley`).
    /// @param misfits  of each experiment, with all parameters
    /// @param finest   share of an experiment
    template <class Misfits>
    void place_steps(Misfits const& misfits, int places, double finest) {
        for (std::size_t step = 0; step < steps(); ++step) {
            auto const first = static_cast<std::ptrdiff_t>(always_.size() + step * names_.size());
            auto const own = known_.parameters.begin() + first;
            auto const at = [&](std::vector<double> const& shares) {
                auto probe = known_.parameters;
                std::copy(shares.begin(), shares.end(), probe.begin() + first);
                return misfits(probe);
            };
            auto const best = deepest_valley(at, {own, own + std::ssize(names_)}, places, finest);
            std::copy(best.begin(), best.end(), own);
        }
    }
    /// Fits the jumps and all else together (`with_soft_jumps`).
    void fit_jumps(double width, fit_norm norm) {
        std::vector<double> const places(known_.parameters.begin() + std::ssize(always_),
                                         known_.parameters.end());
        auto const soft = off_limits(with_soft_jumps(*base_, effect_, ends_, places, width));
        auto from = known_.parameters;
        std::fill(from.begin() + std::ssize(always_), from.end(), 0.5);
        auto const found = sivid::fit(soft, norm, {std::move(from), known_.starts}, go_on_);
        if (found.parameters.size() != known_.parameters.size()) return;
        for (std::size_t k = 0; k < known_.parameters.size(); ++k) {
            auto& now = known_.parameters[k];
            bool const begins = ends_.begins && k < always_.size() + names_.size();
            double const later = (begins ? 1 : -1) * width * (1 - 2 * found.parameters[k]);
            now = k < always_.size() ? found.parameters[k] : now + later;
        }
    }
    /// See `with_soft_switch`.
    [[nodiscard]] identification_problem softened(double length) const {
        return off_limits(with_soft_switch(*base_, effect_, ends_, length));
    }
    /// The effect switched on and off as was decided.
    [[nodiscard]] identification_problem jumping() const { return affected(*base_, {acting()}); }
    /// Fits keep a little away from lags of no time.
    [[nodiscard]] identification_problem off_limits(identification_problem p) const {
        return effect_.lags ? away_from_zero(std::move(p), base_->prior.size()) : p;
    }
    [[nodiscard]] std::size_t steps() const { return ends_.begins && ends_.ends ? 2 : 1; }
    void take(approximate_fit found) {
        if (found.squares < known_.squares) known_ = std::move(found);
    }
    void follow(double length, std::size_t measurements, fit_norm norm) {
        if (known_.parameters.empty()) return;
        auto const sharper = thinned(softened(length), measurements);
        auto found = sivid::fit(sharper, norm, {known_.parameters, {}}, go_on_);
        if (!found.parameters.empty()) known_ = std::move(found);
    }
    /// Puts steps of this length where they fit best.
    void look_everywhere(double length, std::size_t measurements) {
        if (known_.parameters.size() <= always_.size()) return;
        auto const soft = thinned(softened(length), measurements);
        approximate_fitter at(soft, go_on_);
        auto const misfits = [&](std::vector<double> const& parameters) {
            return squares_of(at.roughly_at(parameters, known_.starts).residuals);
        };
        place_steps(misfits, 24, 1);
    }
    /// In decimals far finer than the samples.
    /// @param digits  of the times, about
    /// @returns  whether it acts somewhere, but not everywhere from the start to the end
    [[nodiscard]] bool decide_times(std::vector<double> const& parameters, int digits) {
        if (parameters.size() <= always_.size()) return false;
        acting_.clear();
        since_.clear();
        until_.clear();
        auto const* share = parameters.data() + always_.size();
        bool partly = false;
        for (std::size_t s = 0; s < names_.size(); ++s) {
            double const on = ends_.begins ? share[s] : 0;
            double const off = ends_.ends ? share[s + (ends_.begins ? names_.size() : 0)] : 1;
            double const per_second = std::pow(10, digits - std::floor(std::log10(spans_[s])));
            auto const time = [&](double part) {
                double const at = base_->experiments[s].begin + part * spans_[s];
                return std::round(at * per_second) / per_second;
            };
            double const since = on > 0 ? time(on) : effect::from_start;
            double const until = off < 1 ? time(off) : effect::for_ever;
            bool const acts = on < 1 && off > 0 && since < until;
            partly |= !acts || on > 0 || off < 1;
            if (!acts) continue;
            acting_.push_back(names_[s]);
            if (ends_.begins) since_.push_back(since);
            if (ends_.ends) until_.push_back(until);
        }
        auto const inside = acting(); // whole experiments are another question
        return partly && (inside.begins_later() || inside.ends());
    }

    identification_problem const* base_;
    effect effect_;
    episode_ends ends_;
    std::function<bool()> go_on_;
    std::vector<double> always_; ///< parameters with the effect all the time
    std::vector<std::string> names_;
    std::vector<double> spans_; ///< how long each experiment is [time]
    approximate_fit known_;     ///< with the steps
    std::vector<std::string> acting_;
    std::vector<double> since_, until_; ///< of those that it acts in
    identification_problem problem_;
    approximate_fit fit_; ///< with the jump
    bool jumps_only_ = false;
};

} // namespace sivid

#endif
