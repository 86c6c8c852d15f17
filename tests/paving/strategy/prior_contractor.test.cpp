// SPDX-License-Identifier: MIT
#include <sivid/paving/strategy/prior_contractor.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

#include <sivid/paving/identify.hpp>

#include <memory>
#include <stdexcept>

using namespace sivid;

namespace {

/// Begins with a contractor that leaves a range of the first parameter.
identify_options with(interval const& range) {
    auto const mine =
        std::make_shared<prior_contractor>("mine", [range](auto const& p, auto const&) {
            auto left = p.prior;
            left[0] = intersect(left[0], range);
            return left;
        });
    identify_options options;
    options.search.boxes = 50;
    options.strategy.steps.insert(options.strategy.steps.begin(), {{mine}, 0.1});
    return options;
}

} // namespace

TEST_CASE("a contractor by a function takes part in identify, under its name") {
    auto const p = plain_problem::make();
    auto const feasible = plain_problem::feasible();
    interval const around(feasible.lower() - 0.01, feasible.upper() + 0.01);
    auto const options = with(around);
    auto const found = identify(p, options);
    REQUIRE_FALSE(found.journal.empty());
    CHECK(found.journal[0].by == "mine");
    CHECK(found.journal[0].how == contraction_record::outcome::gained);
    CHECK(found.verdict == verdict::consistent);
    CHECK(subset(found.hull[0], around));
    auto late = p;
    late.model.input_memory.push_back({});
    CHECK(options.strategy.steps[0].by[0]->obstacle(late) == "the model has delays");
}

TEST_CASE("a contractor that excludes a verified witness is found out") {
    auto const p = plain_problem::make();
    interval const above(plain_problem::feasible().upper() + 0.01, p.prior[0].upper());
    CHECK_THROWS_AS(identify(p, with(above)), std::logic_error);
}
