// SPDX-License-Identifier: MIT
#include <sivid/paving/set_test.hpp>

#include "support/catch.hpp"

using namespace sivid;

namespace {

struct plain {
    assessment<> operator()(box const& x) { return {box_verdict::undecided, x}; }
};
struct learning {
    struct knowledge {};
    assessment<knowledge> operator()(box const& x, std::shared_ptr<knowledge const> const&) {
        return {box_verdict::undecided, x};
    }
};
struct wrong {
    box_verdict operator()(box const&) { return box_verdict::inside; }
};

} // namespace

TEST_CASE("the two kinds of set tests are told apart") {
    STATIC_REQUIRE(plain_set_test<plain>);
    STATIC_REQUIRE_FALSE(learning_set_test<plain>);
    STATIC_REQUIRE(learning_set_test<learning>);
    STATIC_REQUIRE_FALSE(plain_set_test<learning>);
    STATIC_REQUIRE(set_test<plain>);
    STATIC_REQUIRE(set_test<learning>);
    STATIC_REQUIRE_FALSE(set_test<wrong>);
    CHECK(assessment<>{}.verdict == box_verdict::undecided); // the weaker verdict by default
    CHECK(assessment<>{}.smear.empty());
}
