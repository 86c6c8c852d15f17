// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_INFLATION_IMPL_HOLDOUT_INFLATION_IPP
#define SIVID_PAVING_INFLATION_IMPL_HOLDOUT_INFLATION_IPP

#include <sivid/paving/inflation/detail/holdout_inflation.hpp>

#include <sivid/compiled.hpp>
#include <sivid/number/guard.hpp>
#include <sivid/paving/contract/detail/lp_contractor.hpp>
#include <sivid/paving/contract/detail/predicted_outputs.hpp>
#include <sivid/paving/inflation.hpp>
#include <sivid/paving/inflation/detail/inflation_relaxation.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/judge/box_explorer.hpp>
#include <sivid/paving/judge/detail/response_search.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/products/dependence.hpp>
#include <sivid/paving/products/reduction.hpp>
#include <sivid/paving/response/misfit.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// A box that may contain parameters that fit, with the hold-out inflation over them.
struct holdout_box : explored_box {
    double least = 0;
    double most = detail::infinity;
    std::vector<std::vector<interval>> outputs;        ///< of the held-out experiments
    bool fits = true;                                  ///< perhaps
    bool settled_below = false, settled_above = false; ///< no closer look would say more

    [[nodiscard]] std::size_t bytes() const {
        auto sum = explored_box::bytes();
        for (auto const& list : outputs) sum += list.size() * sizeof(interval);
        return sum;
    }
};

/// The measurements that are met where the inflation is at most `level`.
[[nodiscard]] inline response_list grown(response_list const& known, double level,
                                         std::vector<std::size_t> const& outliers) {
    response_list result;
    for (std::size_t s = 0; s < known.size(); ++s) {
        auto r = std::make_shared<response>(*known[s]);
        r->allowed = outliers[s];
        for (auto& bound : r->bounds) bound = sivid::grown(bound, level);
        result.push_back(std::move(r));
    }
    return result;
}

/// Which boxes may have the least or the largest hold-out inflation.
class holdout_policy {
public:
    using node = holdout_box;

    std::ptrdiff_t fitted; ///< experiments; the others are held out
    double fit_upper;      ///< of the inflation of all parameters that fit
    double share;          ///< of the range that is worth a closer look
    double good;           ///< a larger inflation is looked at five times as closely
    std::vector<std::size_t> outliers;
    bool all_starts;         ///< of the held-out experiments; else only bounds from above hold
    bool from_above = false; ///< which end of the range comes first
    static constexpr bool changes_order = true;

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
        auto const met = grown(fit_known, fit_upper, fit_outliers);
        auto const whole = b.set;
        b.fits = !(found.lower > fit_upper) && contract(met, b.set);
        if (!b.fits) return;
        // Much smaller, it may be integrated once more before it is split.
        for (std::size_t j = 0; j < whole.size(); ++j)
            if (width(b.set[j]) < 0.7 * width(whole[j])) b.fresh = false;
        auto const own = inflation_bounder(own_known, own_outliers, b.set)(0);
        if (all_starts) b.least = std::max(b.least, own.lower);
        double const about = predict(b, met, own_known, own_outliers);
        if (!b.fits) return;
        bool const far = !(b.most <= good);
        double const closely = far ? share / 5 : share;
        double const tolerance =
            closely * (std::isfinite(b.most) ? b.most : std::max(b.least, 1.0));
        double const fit_tolerance = closely * fit_upper;
        double unclear = found.slack, own_unclear = own.slack;
        for (double const blur : found.blur) unclear += blur;
        for (double const blur : own.blur) own_unclear += blur;
        bool const fit_is_clear = unclear <= fit_tolerance;
        // What a run of the fit does not reach may tell more of the parameters.
        bool const all_told = std::all_of(fit_known.begin(), fit_known.end(), [](auto const& r) {
            return r->outputs() == r->measurements;
        });
        b.settled_above = fit_is_clear && b.most - about <= tolerance && (all_told || !far);
        b.settled_below =
            !all_starts ||
            (fit_is_clear && (own_unclear <= tolerance || b.most - b.least <= tolerance));
        for (std::size_t s = 0; s < b.known.size(); ++s) {
            auto const& r = *b.known[s];
            bool const cut = r.outputs() < r.measurements;
            bool const is_fit = static_cast<std::ptrdiff_t>(s) < fitted;
            bool const vague = is_fit ? !(found.blur[s] <= 0.3 * fit_tolerance) ||
                                            (cut && found.slack <= 0.5 * fit_tolerance)
                                      : !(r.blur() <= 0.3 * tolerance);
            b.stale[s] = vague && !(b.settled_above && b.settled_below);
        }
        b.smear = spread(own_known, b.set);
        for (std::size_t j = 0; j < b.smear.size(); ++j) b.smear[j] += found.smear[j];
    }

private:
    /// @returns  false where nothing is left
    [[nodiscard]] static bool contract(response_list const& met, box& set) {
        for (int round = 0; round < 4; ++round) {
            auto const before = set;
            if (!lp_contractor{}(met, set)) return false;
            bool moved = false;
            for (std::size_t j = 0; j < set.size(); ++j)
                moved |= width(set[j]) < 0.9 * width(before[j]);
            if (!moved) break;
        }
        return true;
    }
    /// What the parameters of the box that fit say of the held-out outputs.
    /// @returns  about the largest inflation among them
    [[nodiscard]] static double predict(node& b, response_list const& met, response_list const& own,
                                        std::vector<std::size_t> const& budgets) {
        // Of a part of a box, the outputs are known as they are of the whole.
        auto const predicted = output_prediction(met, own, b.set, b.outputs)();
        if (predicted.none) {
            b.fits = false;
            return 0;
        }
        double most = 0, about = 0;
        for (std::size_t s = 0; s < own.size(); ++s) {
            auto const& r = *own[s];
            auto ranges = predicted.ranges[s];
            std::vector<double> misfits(r.measurements, detail::infinity), likely = misfits;
            for (std::size_t y = 0; y < ranges.size(); ++y) {
                misfits[y] = upper(misfit(ranges[y], r.bounds[y]));
                likely[y] = predicted.about[s][y];
            }
            most = std::max(most, largest_after(std::move(misfits), budgets[s]));
            about = std::max(about, largest_after(std::move(likely), budgets[s]));
            bool const known_start =
                std::all_of(r.unknowns.initial.begin(), r.unknowns.initial.end(),
                            [](auto const& side) { return side.radius == 0; });
            if (s == b.outputs.size()) {
                b.outputs.push_back(std::move(ranges));
            } else if (known_start || b.outputs[s].size() < ranges.size()) {
                b.outputs[s] = std::move(ranges);
            } // else those of the whole stay, from starts of their own
        }
        b.most = std::min(b.most, most);
        return about;
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
    /// @param good        a larger inflation is worth a closer look
    /// @param all_starts  `both` has all of the held-out experiments; else 0 bounds from below
    holdout_range(identification_problem const& both, std::size_t fitted, double fit_upper,
                  box const& start, double good, bool all_starts, inflation_options const& options)
        : search_(both, options.test,
                  {static_cast<std::ptrdiff_t>(fitted), fit_upper, options.relative_width, good,
                   outlier_budgets(both), all_starts},
                  start) {}

    /// @param most     of its boxes (with integrations) and bytes; a step that was begun is ended
    /// @param in_time  false ends it between two experiments
    void narrow(inflation_options const& most, std::function<bool()> const& in_time) {
        while (tested() + integrations() < most.boxes && search_.bytes() <= most.memory &&
               in_time() && unsettled_end()) {
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
    /// The outputs of the held-out experiments over all parameters that fit, in the order of time;
    /// empty where they are not known.
    [[nodiscard]] std::vector<std::vector<interval>> outputs() const {
        std::vector<std::vector<interval>> all;
        bool first = true;
        for (auto const* list : {&search_.waiting(), &search_.stuck()}) {
            for (auto const& b : *list) {
                if (first) all = b.outputs;
                first = false;
                if (b.outputs.size() != all.size()) return {};
                for (std::size_t s = 0; s < all.size(); ++s) {
                    all[s].resize(std::min(all[s].size(), b.outputs[s].size()));
                    for (std::size_t y = 0; y < all[s].size(); ++y)
                        all[s][y] = hull(all[s][y], b.outputs[s][y]);
                }
            }
        }
        return all;
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
            if (next == nullptr || (above ? next->settled_above : next->settled_below)) continue;
            if (std::none_of(search_.stuck().begin(), search_.stuck().end(),
                             [&](holdout_box const& b) { return policy.before(b, *next); })) {
                return true;
            }
        }
        return false;
    }

    response_search<holdout_policy> search_;
};

/// The held-out experiments with less of their starts: this share, about likely ones.
[[nodiscard]] inline identification_problem
started_near(identification_problem posed, std::size_t fitted,
             std::vector<std::vector<double>> const& likely, double share) {
    for (std::size_t s = fitted; share < 1 && s < posed.experiments.size(); ++s) {
        auto& initial = posed.experiments[s].initial;
        for (std::size_t i = 0; i < initial.size(); ++i) {
            double const far = 0.5 * share * width(initial[i]), at = likely[s - fitted][i];
            auto const near =
                intersect(initial[i], interval_traits<interval>::bounds(at - far, at + far));
            if (!is_empty(near)) initial[i] = near;
        }
    }
    return posed;
}

/// What a search leaves of a box by the measurements of the fit alone, in the coordinates of the
/// problem: products of parameters are told apart from their factors here.
/// @guarantee  every parameter of the start whose fit inflation is at most `level` stays
[[nodiscard]] inline box contracted_by_fit(identification_problem posed, std::size_t fitted,
                                           double level, box const& start,
                                           inflation_options const& options, double seconds) {
    if (!std::isfinite(level) || start.size() == 0) return start;
    posed.experiments.resize(fitted);
    posed.prior = start;
    work_limit const limit(seconds, options.test.keep_going);
    inquiry asked(with_bounds_grown(std::move(posed), level), limited(options.test, limit), {},
                  limit);
    contract(options.strategy, asked);
    if (asked.empty()) return start; // all is worse than the level
    inversion_options search{.accuracy_of_hull = true, .hull_gain = 0.02, .keep_outside = false};
    search.seconds = limit.left();
    search.boxes = options.boxes;
    search.memory = options.memory;
    search.keep_going = options.test.keep_going;
    auto const paving = invert(asked.test(), asked.problem().prior, search).paving;
    return paving.has_outer() ? intersect(paving.outer_hull(), start) : start;
}

/// The hold-out inflation at the witness of a fit.
[[nodiscard]] inline inflation_bound bound_at_witness(identification_problem holdout,
                                                      verified_witness const& witness,
                                                      inflation_options options) {
    holdout.prior = point_box(witness.parameters);
    options.only_verdict = false;
    options.seconds *= 0.3;
    options.boxes /= 3;
    return bound_inflation(holdout, nullptr, options);
}

/// Whether starts are uncertain, and likely ones are known.
[[nodiscard]] inline bool may_start_near(identification_problem const& holdout,
                                         std::vector<std::vector<double>> const& likely_starts) {
    return has_uncertain_starts(holdout) &&
           std::equal(holdout.experiments.begin(), holdout.experiments.end(), likely_starts.begin(),
                      likely_starts.end(), [](experiment const& e, auto const& likely) {
                          return e.initial.size() == likely.size();
                      });
}

/// Takes over what a search proved. @returns false when no parameter fits after all: what holds at
/// the witness holds at all that do
[[nodiscard]] inline bool take(holdout_bound& result, holdout_range const& search) {
    auto const found = search.range();
    result.boxes += search.tested();
    result.integrations += search.integrations();
    if (!is_empty(found)) {
        if (result.outputs.empty() || found.upper() < result.over_fits.upper())
            result.outputs = search.outputs();
        result.over_fits = intersect(result.over_fits, found);
        if (!is_empty(result.over_fits)) return true;
    }
    result.over_fits = result.at_witness;
    return false;
}

} // namespace paving_detail

SIVID_DECL holdout_bound holdout_inflation(identification_problem const& fit,
                                           inflation_bound const& fitted,
                                           identification_problem const& holdout,
                                           inflation_options const& options,
                                           std::vector<std::vector<double>> const& likely_starts) {
    require_sound_environment();
    fit.require_data();
    holdout.require_data();
    if (fit.choice.unknown != holdout.choice.unknown) {
        throw std::invalid_argument("holdout_inflation: the problems have other parameters");
    }
    stopwatch const clock;
    work_limit const limit(options.seconds, options.test.keep_going);
    auto timely = options;
    timely.test = limited(options.test, limit);
    holdout_bound result;
    if (fitted.witness) {
        auto const found = paving_detail::bound_at_witness(holdout, *fitted.witness, timely);
        result.at_witness = found.value;
        result.boxes += found.boxes;
        result.integrations += found.integrations;
    }
    auto both = fit;
    both.experiments.insert(both.experiments.end(), holdout.experiments.begin(),
                            holdout.experiments.end());
    auto const map = reduction::find(both, dependence_of(both), sums_in(both));
    auto const whole =
        fitted.hull.size() == fit.prior.size() ? intersect(fitted.hull, fit.prior) : fit.prior;
    auto const& posed = map ? map->problem() : both;
    auto const start = paving_detail::contracted_by_fit(
        posed, fit.experiments.size(), fitted.value.upper(),
        map ? map->forward(whole, fitted.products) : whole, timely, 0.25 * options.seconds);
    auto const go_on = [&] { return limit() && (!options.keep_going || options.keep_going()); };
    // Of fewer starts enclosures are narrower; what holds from some start holds.
    bool const some_starts = paving_detail::may_start_near(holdout, likely_starts);
    double const good = 1.2 * std::max(result.at_witness.lower(), fitted.value.upper());
    for (double const share : {0.3, 1.0}) {
        bool const last = share == 1;
        if (!last && !some_starts) continue;
        work_limit const own((last ? 1 : 0.6) * limit.seconds(), limit);
        paving_detail::holdout_range search(
            paving_detail::started_near(posed, fit.experiments.size(), likely_starts, share),
            fit.experiments.size(), fitted.value.upper(), start, good, last, timely);
        search.narrow(options, [&] { return own() && go_on(); });
        if (!paving_detail::take(result, search)) break;
        if (result.over_fits.upper() <= good || !go_on()) break;
    }
    result.seconds = clock.spent();
    return result;
}

} // namespace sivid

#endif
