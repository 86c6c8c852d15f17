// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IMPL_HOLDOUT_INFLATION_IPP
#define SIVID_PAVING_IMPL_HOLDOUT_INFLATION_IPP

#include <sivid/paving/holdout_inflation.hpp>

#include <sivid/compiled.hpp>
#include <sivid/number/guard.hpp>
#include <sivid/paving/box_explorer.hpp>
#include <sivid/paving/dependence.hpp>
#include <sivid/paving/inflation.hpp>
#include <sivid/paving/inflation_relaxation.hpp>
#include <sivid/paving/misfit.hpp>
#include <sivid/paving/reduction.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

/// Over a box of parameters, the largest over the experiments of the (q+1)-th largest misfit, from
/// above, when each experiment starts at the given state.
/// @guarantee  an upper bound of \f$ \max_p \min_{x_0} \f$: these starts are some starts
[[nodiscard]] inline double inflation_from_above(inflation_bounder::responses const& known,
                                                 std::vector<std::size_t> const& outliers,
                                                 box const& part,
                                                 std::vector<std::vector<double>> const& starts) {
    constexpr double within = 1 - 1e-12; // in the decimal box, not only in its enclosure
    double worst = 0;
    for (std::size_t s = 0; s < known.size(); ++s) {
        auto const& r = *known[s];
        auto const inner = expand(r, part);
        auto middle = inner.middle;
        auto reach = inner.reach;
        for (std::size_t i = 0; i < r.unknowns.initial.size(); ++i) {
            auto const& side = r.unknowns.initial[i];
            if (side.radius == 0) continue;
            double const q = (starts[s][i] - side.centre) / side.radius;
            middle[side.variable] = std::isfinite(q) ? std::clamp(q, -within, within) : 0;
            reach[side.variable] = 0;
        }
        auto const ranges = output_ranges(r, expand(r, std::move(middle), std::move(reach)));
        std::vector<double> misfits(r.measurements, detail::infinity);
        for (std::size_t y = 0; y < ranges.size(); ++y) {
            misfits[y] = upper(misfit(ranges[y], r.bounds[y]));
        }
        worst = std::max(worst, largest_after(std::move(misfits), outliers[s]));
    }
    return worst;
}

namespace paving_detail {

/// A box that may contain parameters that fit, with the hold-out inflation over it.
struct holdout_box : explored_box {
    double least = 0;
    double most = detail::infinity;
    bool settled = false; ///< neither this nor whether it fits is worth a closer look
};

/// The range of the hold-out inflation over all parameters that fit. The boxes at its two ends are
/// split or integrated anew until they are settled.
class holdout_range {
public:
    holdout_range(identification_problem const& both, std::size_t fitted, double fit_upper,
                  box const& start, inflation_options const& options)
        : explorer_(both, options.test),
          fitted_(static_cast<std::ptrdiff_t>(fitted)),
          fit_upper_(fit_upper),
          share_(options.relative_width) {
        for (auto const& e : both.experiments) outliers_.push_back(e.outliers);
        boxes_.push_back(explorer_.unknown<holdout_box>(start));
    }

    /// @param work     boxes looked at and integrations; a step that was begun is ended
    /// @param in_time  false ends it between two experiments
    template <class InTime>
    void narrow(std::size_t work, InTime const& in_time) {
        while (!boxes_.empty() && tested() + integrations() < work && in_time()) {
            auto low = end([](auto const& a, auto const& b) { return a.least < b.least; });
            auto high = end([](auto const& a, auto const& b) { return a.most > b.most; });
            if (low->settled && high->settled) return;
            look(take(high->settled ? low : high), in_time);
        }
    }
    /// Empty when no box is left.
    [[nodiscard]] interval range() const {
        double least = detail::infinity;
        double most = 0;
        for (auto const& b : boxes_) {
            least = std::min(least, b.least);
            most = std::max(most, b.most);
        }
        return interval_traits<interval>::bounds(least, most);
    }
    [[nodiscard]] std::size_t tested() const { return tested_; }
    [[nodiscard]] std::size_t integrations() const { return explorer_.integrations(); }

private:
    using place = std::vector<holdout_box>::iterator;

    template <class Before>
    [[nodiscard]] place end(Before const& before) {
        return std::min_element(boxes_.begin(), boxes_.end(), before);
    }
    [[nodiscard]] holdout_box take(place at) {
        auto b = std::move(*at);
        *at = std::move(boxes_.back());
        boxes_.pop_back();
        return b;
    }

    template <class InTime>
    void look(holdout_box b, InTime const& in_time) {
        if (!b.is_blind()) {
            auto parts = explorer_.halves(b);
            if (parts.empty()) {
                b.settled = true;
                boxes_.push_back(std::move(b));
            }
            for (auto& half : parts) judge(std::move(half));
            return;
        }
        std::vector<holdout_box> blind;
        blind.push_back(std::move(b));
        for (std::size_t k = boxes_.size(); k-- > 0 && blind.size() < explorer_.at_once();) {
            auto const at = boxes_.begin() + static_cast<std::ptrdiff_t>(k);
            if (at->is_blind() && !at->settled) blind.push_back(take(at));
        }
        explorer_.learn(blind, in_time);
        for (auto& known : blind) {
            if (known.fresh) {
                judge(std::move(known));
            } else {
                boxes_.push_back(std::move(known));
            }
        }
    }

    /// Keeps the box unless nothing in it fits.
    void judge(holdout_box b) {
        ++tested_;
        if (std::find(b.known.begin(), b.known.end(), nullptr) != b.known.end()) {
            boxes_.push_back(std::move(b));
            return;
        }
        auto const split = [&](auto const& all) {
            return std::pair{std::vector(all.begin(), all.begin() + fitted_),
                             std::vector(all.begin() + fitted_, all.end())};
        };
        auto const [fit_known, own_known] = split(b.known);
        auto const [fit_outliers, own_outliers] = split(outliers_);
        auto const fits = inflation_bounder(fit_known, fit_outliers, b.set)(fit_upper_);
        if (fits.lower > fit_upper_) return;
        auto const own = inflation_bounder(own_known, own_outliers, b.set)(0);
        b.least = std::max(b.least, own.lower);
        b.most = std::min(
            b.most, inflation_from_above(own_known, own_outliers, b.set,
                                         own.starts.empty() ? middles(own_known) : own.starts));
        double const tolerance = share_ * (std::isfinite(b.most) ? b.most : std::max(b.least, 1.0));
        double const fit_tolerance = share_ * fit_upper_;
        double unclear = fits.slack;
        for (double const blur : fits.blur) unclear += blur;
        b.settled = b.most - b.least <= tolerance && unclear <= fit_tolerance;
        for (std::size_t s = 0; s < b.known.size(); ++s) {
            auto const& r = *b.known[s];
            bool const cut = r.outputs() < r.measurements;
            bool const is_fit = static_cast<std::ptrdiff_t>(s) < fitted_;
            b.stale[s] = is_fit ? !(fits.blur[s] <= 0.3 * fit_tolerance) ||
                                      (cut && fits.slack <= 0.5 * fit_tolerance)
                                : !(r.blur() <= 0.3 * tolerance);
        }
        b.smear = spread(own_known, b.set);
        for (std::size_t j = 0; j < b.smear.size(); ++j) b.smear[j] += fits.smear[j];
        boxes_.push_back(std::move(b));
    }

    [[nodiscard]] static std::vector<std::vector<double>>
    middles(inflation_bounder::responses const& known) {
        std::vector<std::vector<double>> starts;
        for (auto const& r : known) {
            auto& x0 = starts.emplace_back();
            for (auto const& side : r->unknowns.initial) x0.push_back(side.centre);
        }
        return starts;
    }
    /// How far each parameter moves the misfit that it moves most.
    [[nodiscard]] static std::vector<double> spread(inflation_bounder::responses const& known,
                                                    box const& part) {
        std::vector<double> most(part.size(), 0.0);
        for (auto const& r : known) {
            auto const local = expand(*r, part);
            for (std::size_t j = 0; j < part.size(); ++j) {
                auto const& side = r->unknowns.parameters[j];
                if (side.radius == 0) continue;
                for (std::size_t y = 0; y < r->outputs(); ++y) {
                    double const slope = local.slope[side.variable * r->outputs() + y];
                    most[j] = std::max(most[j], 2 * std::abs(slope) / width(r->bounds[y]));
                }
            }
        }
        return most;
    }

    box_explorer explorer_;
    std::ptrdiff_t fitted_;
    double fit_upper_;
    double share_;
    std::vector<std::size_t> outliers_;
    std::vector<holdout_box> boxes_;
    std::size_t tested_ = 0;
};

} // namespace paving_detail

SIVID_DECL holdout_bound holdout_inflation(identification_problem const& fit,
                                           inflation_bound const& fitted,
                                           identification_problem const& holdout,
                                           inflation_options const& options) {
    require_sound_environment();
    fit.require_valid();
    holdout.require_valid();
    if (fit.choice.unknown != holdout.choice.unknown) {
        throw std::invalid_argument("holdout_inflation: the problems have other parameters");
    }
    auto const begin = std::chrono::steady_clock::now();
    auto const elapsed = [&begin] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    auto const in_time = [&] {
        return elapsed() < options.seconds && !options.test.run.enclosure.cancelled();
    };
    auto timely = options;
    timely.test = limited(options.test, in_time);
    holdout_bound result;
    if (fitted.witness) {
        auto there = holdout;
        there.prior = point_box(fitted.witness->parameters);
        auto brief = options;
        brief.only_verdict = false;
        brief.seconds = 0.3 * options.seconds;
        brief.work = options.work / 3;
        auto const found = bound_inflation(there, nullptr, brief);
        result.at_witness = found.value;
        result.boxes += found.boxes;
        result.integrations += found.integrations;
    }
    auto both = fit;
    both.experiments.insert(both.experiments.end(), holdout.experiments.begin(),
                            holdout.experiments.end());
    auto const map = reduction::find(both, dependence_of(both));
    auto const start =
        fitted.hull.size() == fit.prior.size() ? intersect(fitted.hull, fit.prior) : fit.prior;
    paving_detail::holdout_range search(map ? map->problem() : both, fit.experiments.size(),
                                        fitted.value.upper(), map ? map->forward(start) : start,
                                        timely);
    search.narrow(options.work,
                  [&] { return in_time() && (!options.keep_going || options.keep_going()); });
    result.over_fits = search.range();
    if (is_empty(result.over_fits)) result.over_fits = result.at_witness;
    result.boxes += search.tested();
    result.integrations += search.integrations();
    result.seconds = elapsed();
    return result;
}

} // namespace sivid

#endif
