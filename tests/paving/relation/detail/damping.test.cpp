// SPDX-License-Identifier: MIT
#include <sivid/paving/relation/detail/damping.hpp>

#include "diagnosis/planted_motion.hpp"
#include "support/catch.hpp"

using namespace diagnosis_support;

TEST_CASE("the damping of a state is the median of its own slope, never below 0") {
    using list = std::vector<expression>;
    auto const m =
        support::model_of({2, 1}, [](expression const&, list const& x, list const& p, list const&) {
            return list{-p[0] * x[0] - 1000 * max(x[0] - 10, 0.0), x[1]};
        });
    auto model = bind(m, {support::all_constants(1), {}}, {});
    experiment e{"S", {}, 0, box{between(1, 1), between(1, 1)}, {}, 0};
    for (int k = 1; k <= 10; ++k) {
        e.measurements.push_back({0.1 * k, 0, between(0, 1)});
        e.measurements.push_back({0.1 * k, 1, between(0, 3)});
    }
    box const prior{between(1, 5)};
    auto const motion =
        observe_motion(model, prior, e, {{0}, {1}}, {{{0.1, 5}, {0.1, 5}}, {}, {}}, 4);
    CHECK_THAT(damping_of(model, 0, {motion}), WithinAbs(3, 1e-9));
    CHECK(damping_of(model, 1, {motion}) == 0);
    CHECK(damping_of(model, 0, {}) == 0);
}
