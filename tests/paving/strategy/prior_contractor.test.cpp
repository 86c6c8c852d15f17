// SPDX-License-Identifier: MIT
#include <sivid/paving/strategy/prior_contractor.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

#include <sivid/paving/identify.hpp>

#include <memory>

using namespace sivid;

TEST_CASE("a contractor by a function takes part in identify, under its name") {
    auto const p = plain_problem::make();
    auto const upper =
        std::make_shared<prior_contractor>("upper half", [](auto const& q, auto const&) {
            auto left = q.prior;
            left[0] = interval(mid(left[0]), left[0].upper());
            return left;
        });
    identify_options options;
    options.search.boxes = 50;
    options.strategy.steps.insert(options.strategy.steps.begin(), {{upper}, 0.1});
    auto const found = identify(p, options);
    REQUIRE_FALSE(found.journal.empty());
    CHECK(found.journal[0].by == "upper half");
    CHECK(found.journal[0].how == contraction_record::outcome::gained);
    CHECK(found.hull[0].lower() >= mid(p.prior[0]));
    auto late = p;
    late.model.input_memory.push_back({});
    CHECK(upper->obstacle(late) == "the model has delays");
}
