// SPDX-License-Identifier: MIT
#include <sivid/paving/products/detail/preimage_volume.hpp>

#include "support/catch.hpp"
#include "support/products.hpp"

#include <cmath>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

TEST_CASE("the volume of a set of products is that of a sample of the prior") {
    draws d(241);
    for (int trial = 0; trial < 10; ++trial) {
        auto const map = support::reduction_of_products();
        auto const& prior = support::prior_of_products();
        std::vector<box> inside;
        auto const reduced = support::random_paving(d, map.problem().prior);
        for (auto const& b : reduced.boxes()) {
            if (b.verdict == box_verdict::inside) inside.push_back(b.set);
        }
        auto const volume = preimage_volume(map, prior)(inside);
        constexpr int samples = 20000;
        int hits = 0;
        for (int sample = 0; sample < samples; ++sample) {
            std::vector<double> p;
            for (auto const& side : prior) p.push_back(d.uniform(side.lower(), side.upper()));
            auto const image = map.forward(point_box(p));
            for (auto const& b : inside) {
                if (!subset(image, b)) continue;
                ++hits;
                break;
            }
        }
        double const share = static_cast<double>(hits) / samples;
        CHECK(volume.lower() <= share + 0.02);
        CHECK(share - 0.02 <= volume.upper());
        CHECK(width(volume) < 0.02);
    }
}

TEST_CASE("a band of products has the volume of the logarithm") {
    // a <= p0 p1 <= b, all of it within the prior of p0: (b - a) ln(1.5 / 0.5).
    auto const map = support::reduction_of_products();
    auto const& prior = support::prior_of_products();
    auto band = map.problem().prior;
    band[0] = between(0.75, 0.8125);
    auto const volume = preimage_volume(map, prior)({band}, 2000, 1e-4);
    double const exact = 0.0625 * std::log(1.5 / 0.5) / (1.5 * 1.0);
    CHECK(contains(volume, exact));
    CHECK(width(volume) < 1e-3 * exact);
    CHECK(preimage_volume(map, prior)({}).upper() == 0);
    CHECK(contains(preimage_volume(map, prior)({map.problem().prior}), 1.0));
}
