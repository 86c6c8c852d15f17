// SPDX-License-Identifier: MIT
#include <sivid/paving/curve/detail/curve_program.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/arithmetic.hpp>

#include <cmath>
#include <vector>

using namespace sivid;

TEST_CASE("a curve is computed alone, by its argument and its own parameters") {
    auto const recorded =
        support::model_of({2, 4, 0}, [](auto const&, auto const& x, auto const& p, auto const&) {
            using std::atan, std::sin;
            auto const z = x[0] * x[1];
            return std::vector{p[3] * sin(p[2] * atan(p[0] * z)), -p[1] * x[1]};
        });
    auto const model = bind(recorded, {support::all_constants(4), {}}, {});
    auto const curves = find_curves(model);
    REQUIRE(curves.size() == 1);
    auto const& own = curves[0].parameters;
    paving_detail::curve_program const g(model.g, curves[0]);
    std::vector<double> const all{2, 3, 1.4, 5};
    std::vector<double> p;
    for (auto const j : own) p.push_back(all[j]);
    double const factor = own.size() == 3 ? all[3] : 1;
    for (double const z : {-0.7, 0.0, 0.2, 3.0}) {
        auto const value = g.at<approximate_arithmetic>(z, p);
        REQUIRE(value);
        CHECK(std::abs(*value - factor * std::sin(1.4 * std::atan(2 * z))) < 1e-14 * factor);
    }
    auto const rooted =
        support::model_of({1, 1, 0}, [](auto const&, auto const& x, auto const& p, auto const&) {
            using std::sqrt;
            return std::vector{sqrt(p[0] - x[0])};
        });
    auto const root = bind(rooted, {support::all_constants(1), {}}, {});
    paving_detail::curve_program const h(root.g, find_curves(root).at(0));
    CHECK_FALSE(h.at<proven_arithmetic<interval>>(interval(2.0, 3.0),
                                                  std::vector<interval>{interval(1.0)}));
}
