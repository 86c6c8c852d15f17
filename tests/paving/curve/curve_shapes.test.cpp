// SPDX-License-Identifier: MIT
#include <sivid/paving/curve/curve_shapes.hpp>

#include "support/catch.hpp"

#include <sivid/model/graph/graph_range.hpp>

#include <vector>

using namespace sivid;

TEST_CASE(
    "shapes in a graph are the sum of their polynomials, odd and even ones in half the steps") {
    struct form {
        std::vector<double> mean, shape;
    };
    for (auto const& f : {form{{1, 2, 3}, {0, 4, 5}}, form{{0, 2, 0, 3}, {0, 1, 0, -2}},
                          form{{1, 0, 3}, {2, 0, 0}}, form{{0, 0}, {0, 0}}}) {
        curve_shapes s;
        s.centre = 0.5;
        s.scale = 2;
        s.mean = f.mean;
        s.shapes = {f.shape};
        CHECK(s.count() == 1);
        graph g;
        auto const z = g.leaf(operation::time, 0);
        auto const sum = s.in(g, z, {g.leaf(operation::constant, 0)});
        graph_range range(g, {sum});
        for (double const at : {-1.0, 0.0, 0.5, 3.0}) {
            range.evaluate({interval(at), {}, box{interval(0.25)}, {}});
            double const x = (at - s.centre) * s.scale;
            double expected = 0, power = 1;
            for (std::size_t k = 0; k < f.mean.size(); ++k, power *= x)
                expected += power * (f.mean[k] + 0.25 * f.shape[k]);
            CHECK(contains(range.value(sum), expected));
            CHECK(width(range.value(sum)) < 1e-12 * (1 + std::abs(expected)));
        }
    }
}
