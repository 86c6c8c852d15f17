// SPDX-License-Identifier: MIT
#include <sivid/enclosure/step/step_method.hpp>

#include <sivid/enclosure/methods.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/interval_types.hpp"

#include <memory>
#include <stdexcept>
#include <vector>

using namespace sivid;

TEST_CASE("who names no method has none, and coefficients alone are refused") {
    auto const f = support::flow_of(
        support::model_of({1, 0, 0, 5}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{-x[0]};
        }));
    enclosure_options options;
    CHECK(make_step_method<interval>(*f, options) == nullptr);
    options.method = tableau{"euler", 1, {{}}, {{1, 1}}, {{0, 1}}};
    CHECK_THROWS_WITH(make_step_method<interval>(*f, options),
                      ContainsSubstring("'euler'") && ContainsSubstring("for_steps<I>"));
    options.method = for_steps(*options.method);
    auto const euler = make_step_method<interval>(*f, options);
    REQUIRE(euler != nullptr);
    CHECK_FALSE(euler->is_implicit());
    options.method = gauss4();
    CHECK(make_step_method<interval>(*f, options)->is_implicit());
    // A method makes steps in the types that it was told of.
    CHECK_THROWS_AS(make_step_method<support::coarse>(*f, options), std::invalid_argument);
    options.method = for_steps<support::coarse>(gauss4());
    CHECK(make_step_method<support::coarse>(*f, options)->is_implicit());
}
