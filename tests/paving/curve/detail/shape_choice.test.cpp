// SPDX-License-Identifier: MIT
#include <sivid/paving/curve/detail/shape_choice.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <sivid/model/bound_model.hpp>
#include <sivid/model/structure/unknown_curve.hpp>

#include <cmath>
#include <vector>

using namespace sivid;

TEST_CASE("shapes are chosen by what is visited, as many as move the curve") {
    auto const recorded =
        support::model_of({1, 2, 0}, [](auto const&, auto const& x, auto const& p, auto const&) {
            using std::sin;
            return std::vector{p[1] * sin(p[0] * x[0])};
        });
    auto const model = bind(recorded, {support::all_constants(2), {}}, {});
    auto const g = map_of(model.g, find_curves(model).at(0));
    paving_detail::shape_choice const choose(
        g, {paving_detail::parallelepiped::of(box{interval(0.8, 1.2), interval(1.5, 2.5)})});
    interval const range(-1.0, 0.9);
    auto const coarse = choose(range, {-0.5, 0.5}, 1e-2);
    auto const fine = choose(range, {-0.5, 0.5}, 1e-5);
    REQUIRE(coarse);
    REQUIRE(fine);
    CHECK(coarse->count() < fine->count());
    CHECK(fine->centre == 0); // an odd curve over a symmetric range: half of the powers
    for (std::size_t k = 0; k < fine->mean.size(); k += 2) CHECK(fine->mean[k] == 0);
    // Where the motion stays near rest, the first shape follows the slope there.
    std::vector<double> slow, fast;
    for (int k = 0; k < 100; ++k) {
        slow.push_back(0.002 * k);
        fast.push_back(1 - 0.002 * k);
    }
    auto const rest = choose(range, slow, 1e-2), far = choose(range, fast, 1e-2);
    REQUIRE(rest);
    REQUIRE(far);
    auto const bend = [](curve_shapes const& s) { return s.shapes[0][3] / s.shapes[0][1]; };
    CHECK(std::abs(bend(*rest) - bend(*far)) > 1e-3);
}
