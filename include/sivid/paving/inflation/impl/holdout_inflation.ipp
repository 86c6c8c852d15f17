// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_INFLATION_IMPL_HOLDOUT_INFLATION_IPP
#define SIVID_PAVING_INFLATION_IMPL_HOLDOUT_INFLATION_IPP

#include <sivid/paving/inflation/detail/holdout_inflation.hpp>

#include <sivid/compiled.hpp>
#include <sivid/number/guard.hpp>
#include <sivid/paving/inflation.hpp>
#include <sivid/paving/inflation/detail/inflation_relaxation.hpp>
#include <sivid/paving/judge/box_explorer.hpp>
#include <sivid/paving/judge/detail/response_search.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/reduction.hpp>
#include <sivid/paving/response/misfit.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
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
    bool fits = true;     ///< perhaps
    bool settled = false; ///< neither this nor whether it fits is worth a closer look
};

/// Which boxes may have the least or the largest hold-out inflation.
class holdout_policy {
public:
    using node = holdout_box;

    std::ptrdiff_t fitted; ///< experiments; the others are held out
    double fit_upper;      ///< of the inflation of all parameters that fit
    double share;          ///< of the range that is worth a closer look
    std::vector<std::size_t> outliers;
    bool from_above = false; ///< which end of the range comes first

    [[nodiscard]] bool before(node const& a, node const& b) const {
        return from_above ? a.most > b.most : a.least < b.least;
    }
    [[nodiscard]] static bool drops(node const& b) { return !b.fits; }
    void judge(node& b) const {
        auto const split = [&](auto const& all) {
            return std::pair{std::vector(all.begin(), all.begin() + fitted),
                             std::vector(all.begin() + fitted, all.end())};
        };
        auto const [fit_known, own_known] = split(b.known);
        auto const [fit_outliers, own_outliers] = split(outliers);
        auto const found = inflation_bounder(fit_known, fit_outliers, b.set)(fit_upper);
        b.fits = !(found.lower > fit_upper);
        if (!b.fits) return;
        auto const own = inflation_bounder(own_known, own_outliers, b.set)(0);
        b.least = std::max(b.least, own.lower);
        b.most = std::min(
            b.most, inflation_from_above(own_known, own_outliers, b.set,
                                         own.starts.empty() ? middles(own_known) : own.starts));
        double const tolerance = share * (std::isfinite(b.most) ? b.most : std::max(b.least, 1.0));
        double const fit_tolerance = share * fit_upper;
        double unclear = found.slack;
        for (double const blur : found.blur) unclear += blur;
        b.settled = b.most - b.least <= tolerance && unclear <= fit_tolerance;
        for (std::size_t s = 0; s < b.known.size(); ++s) {
            auto const& r = *b.known[s];
            bool const cut = r.outputs() < r.measurements;
            bool const is_fit = static_cast<std::ptrdiff_t>(s) < fitted;
            bool const vague = is_fit ? !(found.blur[s] <= 0.3 * fit_tolerance) ||
                                            (cut && found.slack <= 0.5 * fit_tolerance)
                                      : !(r.blur() <= 0.3 * tolerance);
            b.stale[s] = vague && !b.settled;
        }
        b.smear = spread(own_known, b.set);
        for (std::size_t j = 0; j < b.smear.size(); ++j) b.smear[j] += found.smear[j];
    }

private:
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
};

/// The range of the hold-out inflation over all parameters that fit. The boxes at its two ends are
/// split or integrated anew until they are settled.
class holdout_range {
public:
    holdout_range(identification_problem const& both, std::size_t fitted, double fit_upper,
                  box const& start, inflation_options const& options)
        : search_(both, options.test,
                  {static_cast<std::ptrdiff_t>(fitted), fit_upper, options.relative_width,
                   outlier_budgets(both)},
                  start) {}

    /// @param work     boxes looked at and integrations; a step that was begun is ended
    /// @param in_time  false ends it between two experiments
    void narrow(std::size_t work, std::function<bool()> const& in_time) {
        while (tested() + integrations() < work && in_time() && unsettled_end()) {
            search_.step(in_time);
        }
    }
    /// Empty when no box is left.
    [[nodiscard]] interval range() const {
        double least = detail::infinity;
        double most = 0;
        for (auto const* list : {&search_.waiting(), &search_.stuck()}) {
            for (auto const& b : *list) {
                least = std::min(least, b.least);
                most = std::max(most, b.most);
            }
        }
        return interval_traits<interval>::bounds(least, most);
    }
    [[nodiscard]] std::size_t tested() const { return search_.tested(); }
    [[nodiscard]] std::size_t integrations() const { return search_.integrations(); }

private:
    /// Whether a box at one end of the range is worth a closer look; it comes next.
    [[nodiscard]] bool unsettled_end() {
        auto& policy = search_.policy();
        for (bool const above : {true, false}) {
            policy.from_above = above;
            auto const* next = search_.next();
            if (next == nullptr || next->settled) continue;
            if (std::none_of(search_.stuck().begin(), search_.stuck().end(),
                             [&](holdout_box const& b) { return policy.before(b, *next); })) {
                return true;
            }
        }
        return false;
    }

    response_search<holdout_policy> search_;
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
