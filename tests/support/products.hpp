// SPDX-License-Identifier: MIT
// A problem whose parameters act through products, and random pavings.
#ifndef SIVID_TESTS_SUPPORT_PRODUCTS_HPP
#define SIVID_TESTS_SUPPORT_PRODUCTS_HPP

#include "support/models.hpp"
#include "support/random.hpp"

#include <sivid/paving/identify.hpp>
#include <sivid/paving/products/dependence.hpp>

namespace support {

inline box const& prior_of_products() {
    static box const prior{between(0.5, 2), between(0.5, 1.5), between(-1, 1)};
    return prior;
}
/// x' = p2 - p0 p1 x: p0 and p1 act through their product only.
inline sivid::reduction reduction_of_products() {
    sivid::identification_problem problem;
    problem.model = model_of({1, 3}, [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[2] - p[0] * p[1] * x[0]};
    });
    problem.choice.unknown = all_constants(3);
    problem.prior = prior_of_products();
    sivid::experiment e;
    e.name = "E";
    e.initial = box{interval(1.0)};
    e.measurements = {{1, 0, between(-100, 100)}};
    problem.experiments = {e};
    return sivid::reduction::find(problem, sivid::dependence_of(problem)).value();
}
/// y0 = p0 p1 and y1 = p1 p2 with all p in a range, each measured once: the products share p1.
inline sivid::identification_problem
with_shared_factor(interval const& range, interval const& first, interval const& second) {
    sivid::identification_problem problem;
    problem.model = model_of(
        {1, 3},
        [](auto const&, auto const& x, auto const&, auto const&) { return std::vector{0 * x[0]}; },
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * p[1] * x[0], p[1] * p[2] * x[0]};
        });
    problem.choice.unknown = all_constants(3);
    problem.prior = {range, range, range};
    sivid::experiment e;
    e.name = "run";
    e.initial = box{interval(1.0)};
    e.measurements = {{1, 0, first}, {1, 1, second}};
    problem.experiments = {e};
    return problem;
}
/// Bisections at random, verdicts at random.
inline sivid::subpaving random_paving(draws& d, box const& prior) {
    sivid::subpaving paving(prior);
    std::vector<box> boxes{prior};
    for (int k = 0; k < 12; ++k) {
        auto const which = d.below(boxes.size());
        auto const side = d.below(prior.size());
        auto const& range = boxes[which][side];
        double const cut = range.lower() + d.uniform(0.2, 0.8) * width(range);
        auto [low, high] = bisect(boxes[which], side, cut);
        boxes[which] = std::move(low);
        boxes.push_back(std::move(high));
    }
    for (auto& b : boxes) {
        auto const verdict = d.below(3);
        paving.add(std::move(b), verdict == 0   ? sivid::box_verdict::inside
                                 : verdict == 1 ? sivid::box_verdict::outside
                                                : sivid::box_verdict::undecided);
    }
    return paving;
}

} // namespace support

#endif
