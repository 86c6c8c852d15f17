// SPDX-License-Identifier: MIT
#include <sivid/paving/strategy/detail/by_shapes.hpp>

#include "support/catch.hpp"
#include "support/planted_curves.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"

#include <cstddef>
#include <cstdint>

using namespace sivid;
using support::draws;

namespace {

/// By one thread.
leftover left_by_shapes(identification_problem const& problem, work_limit const& limit,
                        contraction_record& says) {
    inquiry asked(problem, {}, {}, limit);
    return paving_detail::by_shapes()(asked, limit, says);
}

} // namespace

TEST_CASE("windows over shapes lose no parameter that explains the data, and leave little") {
    std::size_t tried = 0, halved = 0;
    support::each_planted_curve(support::swept(10U, 300U), [&](auto const& p, draws&) {
        contraction_record says;
        auto const left = left_by_shapes(p.problem, work_limit(4.5), says);
        REQUIRE(left.starts.size() == p.problem.experiments.size());
        REQUIRE(contains(left.parameters, p.truth));
        double const share = relative_volume(left.parameters, p.problem.prior).upper();
        if (!(share < 1)) return;
        ++tried;
        CHECK(subset(left.parameters, p.problem.prior));
        CHECK(says.figure("windows") > 0);
        CHECK(says.integrations > 0);
        halved += share < 0.5 ? 1 : 0;
    });
    CHECK(tried > support::swept(10U, 300U) / 2);
    CHECK(halved > tried / 2);
}

TEST_CASE("windows over shapes prove that nothing explains, and stop when they are told to") {
    for (std::uint64_t const seed : {9U, 10U, 37U}) {
        draws d(seed);
        auto p = support::plant_curve(d, true);
        p.problem.prior[0] = interval(1.2 * p.truth[0], 1.4 * p.truth[0]); // of the force
        contraction_record says;
        auto const left = left_by_shapes(p.problem, work_limit(54.0), says);
        CHECK(is_empty(left.parameters));
        CHECK(left.starts.size() == p.problem.experiments.size());
    }
    draws d(1);
    auto const p = support::plant_curve(d, true);
    contraction_record says;
    auto const left = left_by_shapes(p.problem, work_limit(5.0, [] { return false; }), says);
    CHECK(subset(p.problem.prior, left.parameters));
}
