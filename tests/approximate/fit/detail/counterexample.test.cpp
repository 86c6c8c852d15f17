// SPDX-License-Identifier: MIT
#include <sivid/approximate/fit/detail/counterexample.hpp>

#include "support/catch.hpp"
#include "support/problems.hpp"

#include <vector>

using namespace sivid;
using support::draws;

TEST_CASE("a point that explains is found in boxes that are said to be excluded and in no other") {
    draws d(911);
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        for (double const spread : {0.0, 0.03}) {
            auto const planted = support::plant(
                d, model, {.experiments = 2, .samples = 10, .outliers = 1, .spread = spread});
            auto const& prior = planted.problem.prior;
            CAPTURE(model, spread);
            std::vector<double> point;
            counterexample_options how;
            how.seconds = 60;
            auto where = prior; // the boxes that are said to be excluded
            how.confirms = [&](approximate_fit const& f) {
                if (!contains(where, f.parameters)) return false;
                for (std::size_t e = 0; e < 2; ++e) {
                    if (planted.violated(e, f.parameters, f.starts[e], 1e-7) > 1) return false;
                }
                point = f.parameters;
                return true;
            };
            CHECK(find_explaining_point(planted.problem, {prior}, how));
            CHECK(contains(prior, point));
            // A small box around the truth among many others.
            std::vector<box> boxes;
            auto small = prior;
            for (std::size_t j = 0; j < prior.size(); ++j) {
                double const w = 1e-3 * width(prior[j]);
                small[j] =
                    intersect(prior[j], interval(planted.truth[j] - w, planted.truth[j] + w));
            }
            for (auto const& rest : difference(prior, small)) boxes.push_back(rest);
            boxes.insert(boxes.begin(), small);
            where = small;
            CHECK(find_explaining_point(planted.problem, {small}, how));
            CHECK(contains(small, point));
            CHECK(find_explaining_point(planted.problem, boxes, how));
        }
    }
    counterexample_options nobody;
    auto const planted = support::plant(d, 0, {});
    CHECK_FALSE(find_explaining_point(planted.problem, {planted.problem.prior}, nobody));
    CHECK_FALSE(find_unexplained_point(planted.problem, {planted.problem.prior}, nobody));
    nobody.confirms = [](approximate_fit const&) { return true; };
    CHECK_FALSE(find_explaining_point(planted.problem, {}, nobody));
}

TEST_CASE("a corner that does not explain is found in boxes that are said to be inside") {
    draws d(912);
    for (std::size_t model = 0; model < support::planted_models; ++model) {
        for (double const spread : {0.0, 0.03}) {
            auto const planted =
                support::plant(d, model, {.experiments = 2, .samples = 10, .spread = spread});
            CAPTURE(model, spread);
            std::vector<double> point;
            counterexample_options how;
            how.seconds = 60;
            how.confirms = [&](approximate_fit const& f) {
                point = f.parameters;
                return f.inflation > 1;
            };
            CHECK(find_unexplained_point(planted.problem, {planted.problem.prior}, how));
            CHECK(contains(planted.problem.prior, point));
        }
    }
}
