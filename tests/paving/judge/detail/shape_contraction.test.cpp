// SPDX-License-Identifier: MIT
#include <sivid/paving/judge/detail/shape_contraction.hpp>

#include "support/catch.hpp"
#include "support/planted_curves.hpp"
#include "support/random.hpp"
#include "support/sweep.hpp"

#include <cstddef>
#include <cstdint>

using namespace sivid;
using support::draws;

namespace {

identify_options of_one_thread() {
    identify_options options;
    options.search.seconds = 60;
    return options;
}

} // namespace

TEST_CASE("windows over shapes lose no parameter that explains the data, and leave little") {
    std::size_t tried = 0, halved = 0;
    support::each_planted_curve(support::swept(10U, 300U), [&](auto const& p, draws&) {
        auto const left =
            paving_detail::contract_by_shapes(p.problem, of_one_thread(), work_limit(60.0, nullptr));
        if (!left) return;
        ++tried;
        REQUIRE(left->starts.size() == p.problem.experiments.size());
        REQUIRE(contains(left->rest, p.truth));
        CHECK(subset(left->rest, p.problem.prior));
        CHECK(left->windows > 0);
        halved += relative_volume(left->rest, p.problem.prior).upper() < 0.5 ? 1 : 0;
    });
    CHECK(tried > support::swept(10U, 300U) / 2);
    CHECK(halved > tried / 2);
}

TEST_CASE("windows over shapes prove that nothing explains, and stop when they are told to") {
    for (std::uint64_t const seed : {9U, 10U, 37U}) {
        draws d(seed);
        auto p = support::plant_curve(d, true);
        p.problem.prior[0] = interval(1.2 * p.truth[0], 1.4 * p.truth[0]); // of the force
        auto const left = paving_detail::contract_by_shapes(p.problem, of_one_thread(),
                                                            work_limit(60.0, nullptr));
        REQUIRE(left);
        CHECK(left->empty());
        CHECK(left->starts.size() == p.problem.experiments.size());
    }
    draws d(1);
    auto const p = support::plant_curve(d, true);
    CHECK_FALSE(paving_detail::contract_by_shapes(p.problem, of_one_thread(),
                                                  work_limit(5.0, [] { return false; })));
}
