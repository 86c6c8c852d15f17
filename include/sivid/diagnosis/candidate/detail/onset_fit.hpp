// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_DETAIL_ONSET_FIT_HPP
#define SIVID_DIAGNOSIS_CANDIDATE_DETAIL_ONSET_FIT_HPP

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

/// Fits when an effect begins in each experiment, at a time of its own. Its switch is a smooth step
/// in time, which has a slope to follow, then a sharper one, at last a jump at a time with few
/// digits. Nothing here is proved.
class onset_fit {
public:
    /// @param base    without effects; outlives this object
    /// @param e       without a delay and a state of its own
    /// @param always  parameters with the effect from the start on
    onset_fit(identification_problem const& base, effect e, std::vector<double> always,
              std::function<bool()> go_on)
        : base_(&base), effect_(std::move(e)), go_on_(std::move(go_on)) {
        known_.parameters = std::move(always);
        for (auto const& x : base_->experiments) {
            names_.push_back(x.name);
            spans_.push_back(x.end() - x.begin);
        }
    }

    [[nodiscard]] std::string const& name() const { return effect_.name; }
    /// How far the step misses the data, so far as was looked; the less, the likelier.
    [[nodiscard]] double squares() const { return known_.squares; }

    /// Where the onsets are roughly, by few of the measurements.
    void look_roughly() {
        auto const wide = thinned(softened(0.15), few_measurements);
        fitter descend(wide, go_on_);
        auto const always = known_.parameters;
        for (double const share : {0.25, 0.6}) {
            auto from = always;
            from.resize(wide.prior.size(), share);
            take(descend({std::move(from), {}}, fit_norm::squares));
        }
        follow(0.03, few_measurements, fit_norm::squares);
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
        decide_onsets();
        if (onsets_.empty()) return;
        problem_ = affected(*base_, {begun()});
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
    /// The effect with its onsets, its problem and fit.
    /// @given  it explains
    [[nodiscard]] effect begun() const { return only_within(effect_, acting_, onsets_); }
    [[nodiscard]] std::vector<double> const& onsets() const { return onsets_; }
    [[nodiscard]] identification_problem const& problem() const { return problem_; }
    [[nodiscard]] approximate_fit const& fit() const { return fit_; }

private:
    static constexpr std::size_t few_measurements = 600;

    /// The switch as a step whose length is this share of each experiment; at which share of it the
    /// step is made is one more parameter for each.
    [[nodiscard]] identification_problem softened(double length) const {
        using namespace literals;
        auto const switched = only_within(effect_, names_);
        auto hard = affected(*base_, {switched});
        effect soft;
        soft.name = "onset";
        for (std::size_t s = 0; s < names_.size(); ++s) {
            auto const which = static_cast<double>(s); // the experiment
            hard.experiments[s].inputs.back() =
                analytic_signal::from([which](auto const&) { return which; });
            soft.parameters.push_back({names_[s], "1", -0.05_dec, 1.05_dec, 0_dec});
        }
        soft.on_inputs = [&](effect_scope& h) {
            auto& on = h.input(switched.name);
            expression at(0.0), span(0.0);
            for (std::size_t s = 0; s < names_.size(); ++s) {
                auto const here = max(1 - abs(on - static_cast<double>(s)), 0); // folds to 0 or 1
                at += here * (base_->experiments[s].begin + spans_[s] * h.parameter(s));
                span += here * spans_[s];
            }
            on = 0.5 * (1 + tanh((h.time() - at) / (length * span)));
        };
        return affected(hard, {soft});
    }
    void take(approximate_fit found) {
        if (found.squares < known_.squares) known_ = std::move(found);
    }
    void follow(double length, std::size_t measurements, fit_norm norm) {
        if (known_.parameters.empty()) return;
        auto const sharper = thinned(softened(length), measurements);
        auto found = sivid::fit(sharper, norm, {known_.parameters, {}}, go_on_);
        if (!found.parameters.empty()) known_ = std::move(found);
    }
    /// Each onset where it fits its experiment best, the parameters as they are.
    void look_everywhere(double length) {
        if (known_.parameters.size() <= names_.size()) return;
        auto const soft = thinned(softened(length), many_measurements);
        fitter at(soft, go_on_);
        auto const first = known_.parameters.size() - names_.size();
        auto probe = known_.parameters;
        std::vector<double> least(names_.size(), detail::infinity);
        constexpr int steps = 24; // first where they are
        for (int k = -1; k <= steps; ++k) {
            if (k >= 0)
                std::fill(probe.begin() + static_cast<std::ptrdiff_t>(first), probe.end(),
                          k / double(steps));
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
    /// In decimals far finer than the samples. Nothing where it begins in no experiment later than
    /// that does.
    void decide_onsets() {
        auto const first = known_.parameters.size() - names_.size();
        for (std::size_t s = 0; s < names_.size(); ++s) {
            double const share = known_.parameters[first + s];
            if (!(share < 1)) continue; // never
            double const per_second = std::pow(10, 4 - std::floor(std::log10(spans_[s])));
            double const at = base_->experiments[s].begin + share * spans_[s];
            acting_.push_back(names_[s]);
            onsets_.push_back(share > 0 ? std::round(at * per_second) / per_second
                                        : effect::from_start);
        }
        bool const later = std::any_of(onsets_.begin(), onsets_.end(),
                                       [](double t) { return t > effect::from_start; });
        if (!later) onsets_.clear();
    }

    identification_problem const* base_;
    effect effect_;
    std::function<bool()> go_on_;
    std::vector<std::string> names_;
    std::vector<double> spans_; ///< how long each experiment is [s]
    approximate_fit known_;     ///< with the step
    std::vector<std::string> acting_;
    std::vector<double> onsets_; ///< of those that it acts in
    identification_problem problem_;
    approximate_fit fit_; ///< with the jump
};

} // namespace sivid

#endif
