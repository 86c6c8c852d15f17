// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_IMPL_MEASUREMENT_RANKING_IPP
#define SIVID_DECISION_IMPL_MEASUREMENT_RANKING_IPP

#include <sivid/decision/measurement_ranking.hpp>

#include <sivid/compiled.hpp>
#include <sivid/decision/ranking/detail/others_leave.hpp>
#include <sivid/paving/identify.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/products/detail/drawing.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sivid {

namespace decision_detail {

/// Each channel that is measured, each experiment if there are several, and parts of the time.
inline std::vector<measurement_group> usual_groups(identification_problem const& problem,
                                                   std::size_t times) {
    std::vector<measurement_group> result;
    for (std::size_t c = 0; c < problem.model.about.channels.size(); ++c)
        result.push_back({.experiment = {}, .channel = c});
    for (std::size_t e = 0; problem.experiments.size() > 1 && e < problem.experiments.size(); ++e)
        result.push_back({.experiment = e, .channel = {}});
    std::vector<double> instants;
    for (auto const& e : problem.experiments)
        for (auto const& m : e.measurements) instants.push_back(m.time);
    std::sort(instants.begin(), instants.end());
    auto const end_of = [&](std::size_t k) { // of part k: the first instant of the next one
        double const first = instants.front(), last = instants.back();
        double const at =
            first + (last - first) * static_cast<double>(k) / static_cast<double>(times);
        return *std::lower_bound(instants.begin(), instants.end(), std::min(at, last));
    };
    for (std::size_t k = 1; times > 1 && k <= times; ++k) {
        measurement_group part;
        if (k > 1) part.from = end_of(k - 1);
        if (k < times) part.to = end_of(k);
        result.push_back(part);
    }
    return result;
}

inline std::size_t count(identification_problem const& problem, measurement_group const& group) {
    std::size_t n = 0;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        for (auto const& m : problem.experiments[e].measurements) n += group.holds(e, m) ? 1 : 0;
    }
    return n;
}

/// 1 + |more| / |set|.
inline interval growth_of(subpaving const& set, subpaving const& more) {
    using traits = interval_traits<interval>;
    if (!more.has_outer()) return interval(1.0);
    auto const ratio = [](interval const& a, interval const& b) {
        bool undefined = false;
        auto const share = traits::div(a, b, undefined);
        return undefined ? traits::entire() : traits::add(traits::point(1.0), share);
    };
    double const least = ratio(more.inner_volume(), set.outer_volume()).lower();
    double const inside = set.inner_volume().lower();
    double const most = inside > 0 ? ratio(more.outer_volume(), interval(inside)).upper()
                                   : std::numeric_limits<double>::infinity();
    return {std::max(1.0, least), std::max(1.0, most)};
}

/// Of a paving of products what parameters may reach, with the volumes of these parameters.
inline subpaving reached_of(subpaving const& products, reduction const& map, box const& prior) {
    subpaving result(products.prior());
    for (auto const& b : products.boxes()) {
        auto const near = map.backward(prior, b.set);
        if (!is_empty(near) && !is_empty(map.backward(near, b.set))) result.add(b.set, b.verdict);
    }
    auto const [inner, outer] = paving_detail::preimage_volumes(map, result, prior);
    result.set_volumes(inner, outer);
    return result;
}

/// Compares what parameters explain all measurements, and what explain all but a group.
class measurement_ranker {
public:
    measurement_ranker(identification_problem const& problem,
                       measurement_ranking_options const& options)
        : problem_(&problem),
          options_(&options),
          limit_(options.seconds, options.keep_going),
          all_(identify(problem, asking())) {
        for (std::size_t e = 0; all_.guess && e < all_.guess->starts.size(); ++e)
            starts_.push_back(point_within(posed().experiments[e].initial, all_.guess->starts[e]));
    }

    [[nodiscard]] measurement_ranking operator()(std::vector<measurement_group> groups) {
        measurement_ranking result;
        result.explained = all_.verdict;
        result.coordinates = all_.products && shared() == nullptr ? all_.products->map.side_names()
                                                                  : problem_->choice.unknown;
        result.volume = {set().inner_volume().lower(), set().outer_volume().upper()};
        result.integrations = all_.integrations;
        result.complete = true;
        if (all_.verdict == verdict::inconsistent) groups.clear();
        for (std::size_t k = 0; k < groups.size(); ++k) {
            measurement_worth worth{.what = groups[k], .measurements = count(*problem_, groups[k])};
            if (worth.measurements == 0) continue;
            work_limit const own(limit_.seconds() / static_cast<double>(groups.size() - k), limit_);
            result.integrations += leave_out(worth, own);
            result.complete = result.complete && is_close(worth.growth);
            result.groups.push_back(std::move(worth));
        }
        std::stable_sort(result.groups.begin(), result.groups.end(),
                         [](measurement_worth const& a, measurement_worth const& b) {
                             return a.growth.lower() != b.growth.lower()
                                        ? a.growth.lower() > b.growth.lower()
                                        : a.growth.upper() > b.growth.upper();
                         });
        result.seconds = limit_.spent();
        return result;
    }

private:
    [[nodiscard]] identify_options asking() const {
        identify_options result;
        static_cast<run_options&>(result.test) = options_->run;
        result.search.sufficient_ratio = 1 / (1 + options_->accuracy / 2);
        result.search.seconds = options_->seconds / 3;
        result.search.boxes = options_->boxes;
        result.search.keep_outside = false;
        result.search.keep_going = limit_;
        result.strategy = options_->strategy;
        result.drawn_boxes = 1000; // of products: nothing but whether any is reached
        return result;
    }
    [[nodiscard]] identification_problem const& posed() const {
        return all_.products ? all_.products->map.problem() : *problem_;
    }
    [[nodiscard]] subpaving const& searched() const {
        return all_.products ? all_.products->paving : all_.paving;
    }
    /// Products that share a factor hold points that no parameter reaches: parameters count there.
    [[nodiscard]] reduction const* shared() const {
        return all_.products && !all_.products->map.fills() ? &all_.products->map : nullptr;
    }
    [[nodiscard]] subpaving const& set() const {
        return shared() != nullptr ? all_.paving : searched();
    }
    [[nodiscard]] bool is_close(interval const& growth) const {
        return growth.upper() <= growth.lower() * (1 + options_->accuracy);
    }

    /// Finds by how much the set grows without a group. @returns integrations
    [[nodiscard]] std::size_t leave_out(measurement_worth& worth, work_limit const& limit) const {
        feasibility_test_options test;
        static_cast<run_options&>(test) = options_->run;
        test = limited(std::move(test), limit);
        work_limit const first(0.3 * limit.seconds(), limit);
        inquiry asked(others_leave::without(posed(), worth.what), limited(test, first), {}, first);
        contract(options_->strategy, asked);
        if (asked.empty()) {
            worth.growth = interval(1.0);
            return asked.integrations();
        }
        others_leave difference(posed(), worth.what, std::move(test), starts_);
        if (asked.narrowed()) difference.set_rest(asked.problem().prior);
        inversion_options search;
        search.accuracy_of_hull = true;
        search.sufficient_ratio = 1;
        search.seconds = limit.seconds();
        search.boxes = options_->boxes;
        search.keep_outside = false;
        search.keep_going = limit;
        double const least = searched().outer_volume().upper(),
                     most = searched().inner_volume().lower();
        search.progress = [&](paving_progress const& now) {
            return !(most > 0) ||
                   !is_close({1 + now.inner / least, std::max(1.0, 1 + now.outer / most)});
        };
        auto const more = invert(difference, posed().prior, search);
        auto const* const map = shared();
        worth.growth = growth_of(
            set(), map != nullptr ? reached_of(more.paving, *map, problem_->prior) : more.paving);
        worth.boxes = more.tested;
        return asked.integrations() + difference.integrations();
    }

    identification_problem const* problem_;
    measurement_ranking_options const* options_;
    work_limit limit_;
    identification all_;
    std::vector<box> starts_; ///< of the best fit, if there is one
};

} // namespace decision_detail

SIVID_DECL measurement_ranking rank_measurements(identification_problem const& problem,
                                                 measurement_ranking_options const& options,
                                                 std::vector<measurement_group> groups) {
    problem.require_valid_campaign();
    if (groups.empty()) groups = decision_detail::usual_groups(problem, options.times);
    return decision_detail::measurement_ranker(problem, options)(std::move(groups));
}

} // namespace sivid

#endif
