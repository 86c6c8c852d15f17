// SPDX-License-Identifier: MIT
#include "../../benchmarks/enclosure/parametric_cover.hpp"
#include "support/catch.hpp"
#include "support/flow_simulation.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using namespace benchmark;
using support::between;
using support::draws;

namespace {

/// A pendulum of unknown frequency and start: turns over for some of the starts.
std::shared_ptr<flow const> pendulum() {
    return support::flow_of(
        support::model_of({2, 1, 0, 20},
                          [](auto const&, auto const& x, auto const& p, auto const&) {
                              return std::vector{x[1], -(p[0] * sin(x[0]))};
                          }),
        {});
}

double volume(box const& x, box const& p) {
    double v = 1;
    for (auto const* part : {&x, &p}) {
        for (auto const& side : *part) v *= width(side);
    }
    return v;
}

template <std::size_t D, class C>
std::size_t check(box const& x0, box const& p, double end, std::size_t halvings) {
    auto const f = pendulum();
    enclosure_options options;
    options.order = 8;
    options.tolerance = 1e-6;
    options.minimum_step = 1e-3;
    options.remainder_share = 0.05;
    auto const all = cover<C>(3, D, *f, options, x0, p, 0, end, {.first_halvings = halvings});
    REQUIRE(all.complete());
    double covered = 0;
    for (auto const& part : all.parts) {
        covered += volume(part.initial, part.parameters);
        REQUIRE(part.set.time == end);
        for (std::size_t i = 0; i < 2; ++i) REQUIRE(subset(part.initial[i], x0[i]));
        REQUIRE(subset(part.parameters[0], p[0]));
    }
    CHECK_THAT(covered, WithinRel(volume(x0, p), 1e-12));
    draws d(3);
    support::flow_simulation simulate(*f);
    auto const hull = all.hull();
    for (int sample = 0; sample < 300; ++sample) {
        auto const x = d.in(x0);
        auto const c = d.in(p);
        auto const exact = simulate(x, c, 0, {end}, 1e-12).states.back();
        std::size_t members = 0;
        for (auto const& part : all.parts) {
            if (!contains(part.initial[0], x[0]) || !contains(part.initial[1], x[1]) ||
                !contains(part.parameters[0], c[0])) {
                continue;
            }
            ++members;
            auto const box = part.set.hull();
            for (std::size_t i = 0; i < 2; ++i) {
                REQUIRE(exact[i] >= box[i].lower() - 1e-8);
                REQUIRE(exact[i] <= box[i].upper() + 1e-8);
                REQUIRE(subset(box[i], hull[i]));
            }
        }
        REQUIRE(members >= 1);
    }
    return all.parts.size();
}

} // namespace

TEST_CASE("parts cover the box, and their sets the ends, alone and in lanes") {
    box const x0{between(-1, 2.4), between(-0.5, 0.5)};
    box const p{between(0.8, 1.6)};
    auto const alone = check<3, double>(x0, p, 3, 0);
    CHECK(alone > 3); // far too wide for one set
    auto const eight = check<3, lanes<8>>(x0, p, 3, 0);
    CHECK(eight > 3);
    CHECK(check<3, lanes<8>>(x0, p, 3, 3) >= 8);
    CHECK(check<4, lanes<8>>(x0, p, 3, 0) < 2 * eight);
}

TEST_CASE("a cover that may not split says why it stopped") {
    auto const f = pendulum();
    enclosure_options options;
    options.minimum_step = 1e-3;
    options.remainder_share = 0.05;
    auto const all = cover<double>(3, 2, *f, options, box{between(-1, 2.4), between(-0.5, 0.5)},
                                   box{between(0.8, 1.6)}, 0, 3, {.most_parts = 1});
    CHECK_FALSE(all.complete());
    REQUIRE(all.failure);
    CHECK(all.failure->time < 3);
}
