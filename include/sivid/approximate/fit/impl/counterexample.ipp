// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_FIT_IMPL_COUNTEREXAMPLE_IPP
#define SIVID_APPROXIMATE_FIT_IMPL_COUNTEREXAMPLE_IPP

#include <sivid/approximate/fit/detail/counterexample.hpp>

#include <sivid/approximate/fit/detail/approximate_campaign.hpp>
#include <sivid/approximate/fit/detail/descent.hpp>
#include <sivid/approximate/fit/fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace sivid {

namespace approximate_detail {

/// The point of a box next to another point.
inline std::vector<double> nearest_in(box const& x, std::vector<double> p) {
    for (std::size_t j = 0; j < p.size(); ++j) {
        p[j] = std::clamp(p[j], x[j].lower(), x[j].upper());
    }
    return p;
}

inline identification_problem within(identification_problem const& problem, box const& part) {
    auto own = problem;
    own.prior = part;
    return own;
}

/// Looks for the corner of a box that explains the data least.
class corner_search {
public:
    explicit corner_search(identification_problem const& problem)
        : problem_(&problem),
          campaign_(problem),
          free_starts_(std::any_of(problem.experiments.begin(), problem.experiments.end(),
                                   [](experiment const& e) { return has_width(e.initial); })) {}

    /// Hands the corners that seem to explain nothing to `use`, until it says true.
    template <class Use>
    [[nodiscard]] bool operator()(box const& x, Use const& use) {
        auto const middle = mid(x);
        auto const starts = starts_at(middle);
        if (starts.empty()) return false;
        residual_lists r;
        if (!campaign_.linearise(campaign_.variables(middle, starts), r)) return false;
        std::vector<std::vector<double>> corners;
        for (std::size_t e = 0; e < r.size(); ++e) {
            for (auto const k : farthest(e, x, r[e])) {
                auto corner = corner_of(e, x, k, r[e][k]);
                if (std::find(corners.begin(), corners.end(), corner) == corners.end()) {
                    corners.push_back(std::move(corner));
                }
            }
        }
        for (auto const& corner : corners) {
            auto const found = at(corner, starts);
            if (std::isfinite(found.inflation) && found.inflation > 1 && use(found)) return true;
        }
        return false;
    }

private:
    static bool has_width(box const& x) {
        return std::any_of(x.begin(), x.end(),
                           [](interval const& side) { return side.lower() < side.upper(); });
    }
    /// What explains the data at this point best.
    [[nodiscard]] approximate_fit at(std::vector<double> const& p,
                                     std::vector<std::vector<double>> const& starts) {
        if (free_starts_) return approximate_fitter(within(*problem_, point_box(p)))({p});
        descent_point here;
        if (!descent(campaign_).evaluate(campaign_.variables(p, starts), here)) return {};
        return fit_at(campaign_, std::move(here));
    }
    [[nodiscard]] std::vector<std::vector<double>> starts_at(std::vector<double> const& p) {
        if (free_starts_) return approximate_fitter(within(*problem_, point_box(p)))({p}).starts;
        std::vector<std::vector<double>> result;
        for (auto const& e : problem_->experiments) result.push_back(mid(e.initial));
        return result;
    }
    [[nodiscard]] double slope(std::size_t e, std::size_t k, std::size_t column) const {
        return campaign_.derivatives(e)(static_cast<Eigen::Index>(k),
                                        static_cast<Eigen::Index>(column));
    }
    /// The measurements that are missed most somewhere in the box, but for the outliers allowed.
    [[nodiscard]] std::vector<std::size_t> farthest(std::size_t e, box const& x,
                                                    std::vector<double> const& r) const {
        constexpr std::size_t most = 3;
        auto const& free = campaign_.free_parameters();
        std::vector<double> reach(r.size());
        for (std::size_t k = 0; k < r.size(); ++k) {
            reach[k] = std::abs(r[k]);
            for (std::size_t c = 0; c < free.size(); ++c) {
                reach[k] += std::abs(slope(e, k, c)) * rad(x[free[c]]);
            }
        }
        std::vector<std::size_t> order(r.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::sort(order.begin(), order.end(),
                  [&](std::size_t a, std::size_t b) { return reach[a] > reach[b]; });
        auto const first = std::min(campaign_.outliers()[e], order.size());
        auto const last = std::min(first + most, order.size());
        return {order.begin() + static_cast<std::ptrdiff_t>(first),
                order.begin() + static_cast<std::ptrdiff_t>(last)};
    }
    [[nodiscard]] std::vector<double> corner_of(std::size_t e, box const& x, std::size_t k,
                                                double r) const {
        auto corner = mid(x);
        auto const& free = campaign_.free_parameters();
        for (std::size_t c = 0; c < free.size(); ++c) {
            bool const up = (slope(e, k, c) >= 0) == (r >= 0);
            corner[free[c]] = up ? x[free[c]].upper() : x[free[c]].lower();
        }
        return corner;
    }

    identification_problem const* problem_;
    approximate_campaign campaign_;
    bool free_starts_;
};

} // namespace approximate_detail

SIVID_DECL bool find_explaining_point(identification_problem const& problem,
                                      std::vector<box> const& excluded,
                                      counterexample_options const& options) {
    using namespace approximate_detail;
    if (excluded.empty() || !options.confirms) return false;
    work_limit const limit(options.seconds, options.keep_going);
    approximate_fitter whole(problem);
    auto const explains = [&](approximate_fit const& f) {
        return !f.parameters.empty() && f.inflation <= 1 && options.confirms(f);
    };
    auto const best = whole();
    if (explains(best)) return true;
    struct tried_box {
        std::size_t box;
        double inflation, volume;
    };
    std::vector<tried_box> list;
    for (std::size_t k = 0; k < excluded.size(); ++k) {
        tried_box next{k, HUGE_VAL, relative_volume(excluded[k], problem.prior).upper()};
        if (!best.parameters.empty() && limit() && 2 * limit.spent() < options.seconds) {
            auto const near = whole.at(nearest_in(excluded[k], best.parameters), best.starts);
            if (explains(near)) return true;
            next.inflation = near.inflation;
        }
        list.push_back(next);
    }
    auto const by = [&](auto const& before, std::size_t count) {
        std::vector<tried_box> first(std::min(count, list.size()));
        std::partial_sort_copy(list.begin(), list.end(), first.begin(), first.end(), before);
        return first;
    };
    auto const promising =
        by([](tried_box const& a, tried_box const& b) { return a.inflation < b.inflation; },
           options.fits - options.fits / 4);
    auto const large =
        by([](tried_box const& a, tried_box const& b) { return a.volume > b.volume; },
           options.fits / 4);
    for (bool const near : {false, true}) {
        for (auto const& c : near ? promising : large) {
            if (!limit()) return false;
            auto const own = within(problem, excluded[c.box]);
            if (near && best.parameters.empty()) continue;
            if (explains(near ? approximate_fitter(own)({nearest_in(own.prior, best.parameters)})
                              : approximate_fitter(own)())) {
                return true;
            }
        }
    }
    return false;
}

SIVID_DECL bool find_unexplained_point(identification_problem const& problem,
                                       std::vector<box> const& inside,
                                       counterexample_options const& options) {
    if (inside.empty() || !options.confirms) return false;
    work_limit const limit(options.seconds, options.keep_going);
    approximate_detail::corner_search search(problem);
    for (auto const& x : inside) {
        if (!limit()) return false;
        if (search(x, options.confirms)) return true;
    }
    return false;
}

} // namespace sivid

#endif
