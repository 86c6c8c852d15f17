// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_EPISODE_FIT_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_EPISODE_FIT_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/approximate/fit/detail/thinned.hpp>
#include <sivid/approximate/fit/fit.hpp>
#include <sivid/diagnosis/affected_problem.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Which ends of its time of action an effect may have in the midst of an experiment.
struct episode_ends {
    bool begins = true, ends = false;
};

/// Fits when an effect begins or ends in each experiment, at times of its own. Its switch is a
/// smooth step in time (a step up, down, or both), which has a slope to follow, then a sharper one,
/// at last a jump at a time with few digits. Nothing here is proved.
class episode_fit {
public:
    /// @param base    without effects; outlives this object
    /// @param e       without a delay and a state of its own
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
    }

    [[nodiscard]] std::string const& name() const { return effect_.name; }
    /// How far the step misses the data, so far as was looked; the less, the likelier.
    [[nodiscard]] double squares() const { return known_.squares; }

    /// Where the steps are roughly, by few of the measurements.
    void look_roughly() {
        // Shares of the experiments at which it begins and ends, to start from.
        std::vector<std::pair<double, double>> starts{{0.25, 0.75}, {0.6, 0.4}};
        if (ends_.begins && ends_.ends) starts = {{0.2, 0.6}, {0.4, 0.8}};
        auto const wide = thinned(softened(0.15), few_measurements);
        fitter descend(wide, go_on_);
        for (auto const& [on, off] : starts)
            take(descend({placed(on, off), {}}, fit_norm::squares));
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
        auto const sharper = thinned(softened(0.06), few_measurements);
        take(fitter(sharper, go_on_)({std::move(from), {}}, fit_norm::squares));
    }
    /// By all of them, as sharply as it is; then the fit with the effect switched on there.
    void look_closely() {
        for (double const length : {0.06, 0.03}) {
            look_everywhere(length);
            follow(length, many_measurements, fit_norm::squares);
        }
        for (double const length : {0.015, 0.008, 0.004})
            follow(length, many_measurements, fit_norm::squares);
        follow(0.002, many_measurements, fit_norm::largest);
        if (!decide_times()) return;
        problem_ = affected(*base_, {acting()});
        auto from = known_.parameters;
        from.resize(problem_.prior.size());
        fit_ = sivid::fit(problem_, fit_norm::largest, {std::move(from), {}}, go_on_);
        if (!(fit_.inflation > 1 && fit_.inflation < 1.05)) return;
        auto closer =
            sivid::fit(problem_, fit_norm::largest, {fit_.parameters, fit_.starts}, go_on_);
        if (!(closer.inflation < fit_.inflation)) return;
        closer.squares = fit_.squares;
        fit_ = std::move(closer);
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

    /// Parameters with the effect always, and these shares of every experiment.
    [[nodiscard]] std::vector<double> placed(double on, double off) const {
        auto from = always_;
        if (ends_.begins) from.insert(from.end(), names_.size(), on);
        if (ends_.ends) from.insert(from.end(), names_.size(), off);
        return from;
    }
    /// The switch with steps whose length is this share of each experiment; at which share of it
    /// they are made are further parameters: for all experiments where it begins, then where it
    /// ends.
    [[nodiscard]] identification_problem softened(double length) const {
        using namespace literals;
        auto const switched = only_within(effect_, names_);
        auto hard = affected(*base_, {switched});
        effect soft;
        soft.name = "episode";
        auto const share = [&](std::string const& name) {
            soft.parameters.push_back({name, "1", -0.05_dec, 1.05_dec, 0_dec});
        };
        for (std::size_t s = 0; s < names_.size(); ++s) {
            auto const which = static_cast<double>(s); // the experiment
            hard.experiments[s].inputs.back() =
                analytic_signal::from([which](auto const&) { return which; });
            if (ends_.begins) share(names_[s]);
        }
        for (auto const& name : names_)
            if (ends_.ends) share(name + "_end");
        soft.on_inputs = [&](effect_scope& h) {
            auto& on = h.input(switched.name);
            expression begin(0.0), span(0.0);
            std::vector<expression> at(2, expression(0.0));
            for (std::size_t s = 0; s < names_.size(); ++s) {
                auto const here = max(1 - abs(on - static_cast<double>(s)), 0); // folds to 0 or 1
                begin += here * base_->experiments[s].begin;
                span += here * spans_[s];
                for (std::size_t step = 0; step < steps(); ++step)
                    at[step] += here * h.parameter(step * names_.size() + s);
            }
            auto const so_far = (h.time() - begin) / span;
            auto const up = [&](expression const& where) {
                return 0.5 * (1 + tanh((so_far - where) / length));
            };
            if (ends_.begins && ends_.ends)
                on = up(at[0]) * (1 - up(at[1]));
            else
                on = ends_.begins ? up(at[0]) : 1 - up(at[0]);
        };
        return affected(hard, {soft});
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
    /// Each step where it fits its experiment best, all else as it is.
    void look_everywhere(double length) {
        if (known_.parameters.size() <= always_.size()) return;
        auto const soft = thinned(softened(length), many_measurements);
        fitter at(soft, go_on_);
        constexpr int places = 24; // first where they are
        for (std::size_t step = 0; step < steps(); ++step) {
            auto const first = always_.size() + step * names_.size();
            auto probe = known_.parameters;
            std::vector<double> least(names_.size(), detail::infinity);
            for (int k = -1; k <= places; ++k) {
                if (k >= 0)
                    std::fill_n(probe.begin() + static_cast<std::ptrdiff_t>(first), names_.size(),
                                k / double(places));
                auto const residuals = at.at(probe, known_.starts).residuals;
                for (std::size_t s = 0; s < std::min(names_.size(), residuals.size()); ++s) {
                    double sum = 0;
                    for (double const r : residuals[s]) sum += r * r;
                    if (!(sum < least[s])) continue;
                    least[s] = sum;
                    known_.parameters[first + s] = probe[first + s];
                }
            }
        }
    }
    /// In decimals far finer than the samples.
    /// @returns  whether it acts somewhere, but not everywhere from the start to the end
    [[nodiscard]] bool decide_times() {
        if (known_.parameters.size() <= always_.size()) return false;
        auto const* share = known_.parameters.data() + always_.size();
        bool partly = false;
        for (std::size_t s = 0; s < names_.size(); ++s) {
            double const on = ends_.begins ? share[s] : 0;
            double const off = ends_.ends ? share[s + (ends_.begins ? names_.size() : 0)] : 1;
            double const per_second = std::pow(10, 4 - std::floor(std::log10(spans_[s])));
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
    std::vector<double> spans_; ///< how long each experiment is [s]
    approximate_fit known_;     ///< with the steps
    std::vector<std::string> acting_;
    std::vector<double> since_, until_; ///< of those that it acts in
    identification_problem problem_;
    approximate_fit fit_; ///< with the jump
};

} // namespace sivid

#endif
