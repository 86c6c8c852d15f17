// SPDX-License-Identifier: MIT
#include <sivid/verifier/proof/detail/exclusion_check.hpp>

#include <sivid/paving/contract/detail/weighted_certificate.hpp>

#include "support/catch.hpp"
#include "support/polynomial_experiments.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

using namespace sivid;
using support::draws;
using support::polynomial_experiments;

TEST_CASE("a certificate of any weights excludes no feasible point and does exclude others") {
    draws d(2113);
    int excluded = 0, also = 0;
    for (int trial = 0; trial < 400; ++trial) {
        polynomial_experiments const e(d, 1 + d.below(2), 3, d.uniform(0, 0.3), 0.02, 0);
        auto const part = e.part(d);
        shared_unknowns const unknowns(e.known, part);
        auto const weights = e.draw_weights(d);
        bool const none = weighted_outputs<interval>(e.known, part, weights).positive();
        excluded += none ? 1 : 0;
        also += none && certified_inflation(e.known, unknowns, weights) > 1 ? 1 : 0;
        for (int sample = 0; sample < 300 && none; ++sample) {
            REQUIRE_FALSE(e.feasible(d.in(part), e.draw_starts(d)));
        }
    }
    CHECK(excluded > 10);
    CHECK(also > excluded / 2); // the search's certificate says the same of most
}

TEST_CASE("no weights prove nothing") {
    draws d(2114);
    polynomial_experiments const e(d, 1, 3, 0.1, 0.02, 0);
    CHECK_FALSE(weighted_outputs<interval>(e.known, e.part(d), {}).positive());
}

TEST_CASE("groups of any weights exclude no point that the outliers allow") {
    draws d(2115);
    int excluded = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        std::size_t const q = d.below(2);
        polynomial_experiments const e(d, 1 + d.below(2), 4, d.uniform(0, 0.3), 0.02, q);
        auto const part = e.part(d);
        proof_step::groups why(1 + d.below(4));
        for (auto& group : why) { // measurements may be shared, which must prove nothing
            for (std::size_t n = 1 + d.below(2); n-- > 0;) {
                group.push_back({d.below(e.known.size()), d.below(4), d.coin() ? 1.0 : -1.0});
            }
        }
        bool const none = weights_exclude<interval>(e.known, part, why);
        excluded += none ? 1 : 0;
        for (int sample = 0; sample < 300 && none; ++sample) {
            REQUIRE_FALSE(e.feasible(d.in(part), e.draw_starts(d)));
        }
    }
    CHECK(excluded > 20);
}

TEST_CASE("one measurement that fails excludes nothing where an outlier is allowed") {
    draws d(2116);
    polynomial_experiments e(d, 1, 3, 0, 0.01, 1);
    auto r = *e.known[0];
    r.bounds = {interval(100, 101), interval(100, 101), interval(-1000, 1000)};
    response_list const known{std::make_shared<response const>(r)};
    auto const excludes = [&](proof_step::groups const& why) {
        return weights_exclude<interval>(known, e.prior, why);
    };
    measurement_weight const first{0, 0, -1}, second{0, 1, -1}, holds{0, 2, 1};
    CHECK(excludes({{first}, {second}}));
    CHECK_FALSE(excludes({{first}}));
    CHECK_FALSE(excludes({{first, second}}));
    CHECK_FALSE(excludes({{first}, {first}}));          // the same outlier twice
    CHECK_FALSE(excludes({{first, second}, {second}})); // or in two groups
    CHECK_FALSE(excludes({{first}, {holds}}));
    CHECK_FALSE(excludes({{first}, {{0, 1, 1.0}}}));  // the wrong end
    CHECK_FALSE(excludes({{first}, {{1, 1, -1.0}}})); // of no experiment
    CHECK_FALSE(excludes({{first}, {{0, 3, -1.0}}})); // of no measurement
    CHECK_FALSE(excludes({{first}, {{0, 1, -HUGE_VAL}}}));
    CHECK_FALSE(excludes({{first}, {{0, 1, std::nan("")}}}));
    CHECK_FALSE(excludes({}));
    CHECK_FALSE(excludes({{}, {}}));
    CHECK_FALSE(weights_exclude<interval>({nullptr}, e.prior, {{first}, {second}}));
    // A measurement without a bound in the direction of its weight proves nothing.
    r.bounds[1] = interval_traits<interval>::bounds(-HUGE_VAL, 101);
    CHECK_FALSE(weights_exclude<interval>({std::make_shared<response const>(r)}, e.prior,
                                          {{first}, {second}}));
}
