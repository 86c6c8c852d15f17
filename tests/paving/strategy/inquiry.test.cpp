// SPDX-License-Identifier: MIT
#include <sivid/paving/strategy/inquiry.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"
#include "support/pendulum.hpp"

#include <sivid/paving/invert.hpp>

#include <cstddef>
#include <stdexcept>
#include <vector>

using namespace sivid;

TEST_CASE("an inquiry forgets its runs when less is left, and never has more again") {
    auto const p = support::swinging(2, 0.2, 3, 0.1);
    inquiry asked(p, {}, {}, work_limit(60));
    CHECK_FALSE(asked.starts_known());
    double const wide = asked.reach();
    CHECK(asked.integrations() == 1);
    CHECK_FALSE(asked.narrow({p.prior}));
    CHECK_FALSE(asked.narrowed());
    auto part = asked.left();
    for (std::size_t j = 0; j < p.prior.size(); ++j)
        part.parameters[j] = interval(mid(p.prior[j]) - 1e-3, mid(p.prior[j]) + 1e-3);
    part.starts[0][0] = interval(0.49, 0.51);
    CHECK(asked.narrow(part));
    CHECK(asked.narrowed());
    CHECK(asked.reach() >= wide);
    CHECK(asked.integrations() == 2);
    CHECK_FALSE(asked.narrow({p.prior, {p.experiments[0].initial}}));
    CHECK(subset(asked.left().starts[0], part.starts[0]));
    CHECK(subset(asked.problem().prior, part.parameters));
    // The search sees the whole prior, and cuts off what is not left.
    CHECK(subset(p.prior, asked.searched().prior));
    auto const found = invert(asked.search_test(), p.prior, {.boxes = 1});
    CHECK(subset(found.paving.outer_hull(), part.parameters));
}

TEST_CASE("an inquiry is empty as soon as one of its sides is") {
    auto const p = support::swinging(2, 0.2, 3, 0.1);
    inquiry by_start(p, {}, {}, work_limit(60)), by_prior(p, {}, {}, work_limit(60));
    CHECK(by_start.narrow({p.prior, {{interval(7), interval(7)}}}));
    CHECK(by_start.empty());
    CHECK(by_prior.narrow({empty_box(p.prior.size())}));
    CHECK(by_prior.empty());
    CHECK_FALSE(invert(by_prior.search_test(), p.prior, {}).paving.has_outer());
}

TEST_CASE("what is left of another problem is refused") {
    auto const p = plain_problem::make();
    inquiry asked(p, {}, {}, work_limit(60));
    CHECK_THROWS_AS(asked.narrow({empty_box(p.prior.size() + 1)}), std::invalid_argument);
    CHECK_THROWS_AS(asked.narrow({p.prior, std::vector<box>(7)}), std::invalid_argument);
    approximate_fit fit;
    CHECK_THROWS_AS(asked.propose(fit, p.prior), std::invalid_argument);
}
