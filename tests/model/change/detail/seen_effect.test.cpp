// SPDX-License-Identifier: MIT
#include <sivid/model/change/detail/seen_effect.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <sivid/model/effects.hpp>

#include <cstddef>
#include <limits>
#include <vector>

using namespace sivid;
using namespace sivid::literals;

TEST_CASE("what the model sees stands behind the edits of others, in the order of the model") {
    auto const m =
        support::model_of({1, 1, 2}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            return std::vector{u[0] + u[1] - p[0] * x[0]};
        });
    auto doubled = effects::input_gain("seen", "u1", {0_dec, 1_dec}); // has that name already
    auto const seen = seen_effect(m.about, {doubled}, std::numeric_limits<int>::max());
    CHECK(seen.name == "seen'");
    auto const joined = with(m, {doubled, seen});
    REQUIRE(joined.rate.size() == 1 + 2 + 1 + 1); // inputs, the model's constant, the time
    auto const op = [&](std::size_t i) { return joined.g[joined.rate[1 + i]].op; };
    CHECK(op(0) == operation::input);
    CHECK(op(1) == operation::mul); // u1 (1 + k)
    CHECK(op(2) == operation::constant);
    CHECK(op(3) == operation::time);
    CHECK(joined.about.states[1].name == "seen' input u0");
}
