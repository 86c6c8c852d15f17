// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/derivative_bound.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <cmath>

using namespace sivid;
using support::around;
using support::between;
using support::draws;

TEST_CASE("the rate of a sampled quantity is told in both directions of time") {
    draws d(730);
    double widest = 0;
    for (int n = 0; n < 300; ++n) {
        // q = a sin(w t) + b t, r = q', r' = -a w^2 sin(w t)
        double const a = d.uniform(-1, 1);
        double const w = d.uniform(0.2, 4);
        double const b = d.uniform(-2, 2);
        double const period = d.uniform(0.02, 0.3);
        double const error = d.uniform(0, 0.02);
        double const slack = d.uniform(0, 0.2);
        double const way = d.coin() ? 1 : -1;
        derivative_bound bound;
        for (int k = 0; k < 80; ++k) {
            double const t = way * k * period;
            if (k > 0) {
                for (int piece = 0; piece < 3; ++piece) {
                    auto const from = t - way * period * (3 - piece) / 3.0;
                    auto const at = hull(interval(from), interval(from + way * period / 3));
                    auto const bend = interval(-a * w * w) * sin(interval(w) * at);
                    bound.add(around(period / 3.0, 1e-12),
                              bend + between(-slack, slack) + between(-1e-12, 1e-12));
                }
            }
            bound.mark(
                t, around(a * std::sin(w * t) + b * t + d.uniform(-error, error), error + 1e-12));
            auto const r = bound.told().rate;
            double const truth = a * w * std::cos(w * t) + b;
            CHECK(r.lower() <= truth + 1e-9);
            CHECK(truth - 1e-9 <= r.upper());
            CHECK(is_bounded(r) == (k > 0));
            if (k > 40 && period < 0.1 && w < 1) widest = std::max(widest, width(r));
        }
    }
    CHECK(widest < 0.4);
}

TEST_CASE("marks on either side tell a rate together, and better") {
    draws d(731);
    std::size_t better = 0, all = 0;
    for (int n = 0; n < 200; ++n) {
        // q = a sin(w t) + b t about t = 0, r(0) = a w + b
        double const a = d.uniform(-1, 1), w = d.uniform(0.2, 4), b = d.uniform(-2, 2);
        double const period = d.uniform(0.02, 0.3), error = d.uniform(0.0001, 0.02);
        double const slack = d.uniform(0, 0.2);
        double const off = d.uniform(-error, error); // of the mark that both end at
        auto const one_side = [&](double way) {
            derivative_bound bound;
            for (int k = 20; k >= 0; --k) {
                double const t = -way * k * period;
                double const from = t - way * period;
                auto const bend =
                    interval(-a * w * w) * sin(interval(w) * hull(interval(from), interval(t)));
                if (k < 20)
                    bound.add(around(period, 1e-12), bend + between(-slack - 1e-12, slack + 1e-12));
                double const wrong = k == 0 ? off : d.uniform(-error, error);
                bound.mark(t, around(a * std::sin(w * t) + b * t + wrong, error + 1e-12));
            }
            return bound;
        };
        auto const before = one_side(1), after = one_side(-1);
        auto const both = derivative_bound::between(before.told().views, after.told().views);
        double const truth = a * w + b;
        CHECK(both.lower() <= truth + 1e-9);
        CHECK(truth - 1e-9 <= both.upper());
        ++all;
        if (width(both) < 0.8 * width(intersect(before.told().rate, after.told().rate))) ++better;
    }
    CHECK(3 * better > all);
}

TEST_CASE("a rate that may change by anything tells nothing") {
    derivative_bound bound;
    bound.mark(0, between(0, 0));
    bound.add(interval(1.0), interval_traits<interval>::entire());
    bound.mark(1, between(1, 1));
    CHECK_FALSE(is_bounded(bound.told().rate));
    bound.add(interval(1.0), between(0, 0)); // from here on it is known
    bound.mark(2, between(3, 3));
    CHECK(equal(bound.told().rate, between(2, 2)));
}
