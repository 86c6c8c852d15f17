// SPDX-License-Identifier: MIT
#include <sivid/paving/products/detail/drawing.hpp>

#include "support/catch.hpp"
#include "support/products.hpp"

#include <sivid/paving/invert.hpp>

#include <vector>

using namespace sivid;
using support::between;
using support::draws;

TEST_CASE("a paving drawn from a reduced one says of every point what that one says") {
    draws d(231);
    int inside = 0;
    int outside = 0;
    for (int trial = 0; trial < 12; ++trial) {
        auto const map = support::reduction_of_products();
        auto const& prior = support::prior_of_products();
        auto const reduced = support::random_paving(d, map.problem().prior);
        preimage_test test(map, reduced);
        inversion_options options;
        options.boxes = 300;
        options.accuracy = 1e-3;
        auto const drawn = invert(test, prior, options);
        for (int sample = 0; sample < 300; ++sample) {
            std::vector<double> p; // off all faces
            for (auto const& side : prior) p.push_back(d.uniform(side.lower(), side.upper()));
            auto const image = map.forward(point_box(p));
            bool may_be_inside = false;
            bool is_inside = true;
            for (auto const& b : reduced.boxes()) {
                if (is_empty(intersect(b.set, image))) continue;
                may_be_inside = may_be_inside || b.verdict != box_verdict::outside;
                is_inside = is_inside && b.verdict == box_verdict::inside;
            }
            for (auto const& b : drawn.paving.boxes()) {
                if (!contains(b.set, p)) continue;
                inside += b.verdict == box_verdict::inside ? 1 : 0;
                outside += b.verdict == box_verdict::outside ? 1 : 0;
                if (b.verdict == box_verdict::inside) CHECK(may_be_inside);
                if (b.verdict == box_verdict::outside) CHECK_FALSE(is_inside);
            }
        }
    }
    CHECK(inside > 300);
    CHECK(outside > 300);
}
