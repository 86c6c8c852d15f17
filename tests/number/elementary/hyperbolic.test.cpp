// SPDX-License-Identifier: MIT
#include <sivid/number/elementary.hpp>

#include "number/support.hpp"

using namespace sivid;

namespace {
auto const acosh_of = [](interval const& x, bool& cut) { return acosh(x, cut); };
auto const atanh_of = [](interval const& x, bool& cut) { return atanh(x, cut); };
} // namespace

TEST_CASE("sinh, cosh, tanh at their ends") {
    CHECK(equal(sinh(interval{0.0}), make(0, 0)));
    CHECK(equal(cosh(interval{0.0}), make(1, 1)));
    CHECK(lower(cosh(make(-1, 2))) == 1.0);
    CHECK(equal(tanh(everything()), make(-1, 1)));
    CHECK(equal(tanh(interval{0.0}), make(0, 0)));
    CHECK(upper(tanh(interval{700.0})) == 1.0);
    CHECK(lower(tanh(interval{700.0})) > 0.999);
    CHECK(equal(cosh(everything()), make(1, inf)));
    CHECK(equal(sinh(everything()), everything()));
    CHECK(upper(sinh(interval{800.0})) == inf);
    CHECK(lower(sinh(interval{800.0})) > 1e308);
    CHECK(lower(sinh(interval{tiny})) == tiny);
    CHECK(is_empty(cosh(nothing())));
    CHECK(is_empty(tanh(nothing())));
}

TEST_CASE("inverse functions report the cut domain") {
    CHECK(equal(acosh(interval{1.0}), make(0, 0)));
    CHECK(with_cut(acosh_of, make(0, 2)).second);
    CHECK_FALSE(with_cut(acosh_of, make(1, 2)).second);
    CHECK(is_empty(acosh(make(-1, 0.5))));
    CHECK(with_cut(atanh_of, make(-1, 0)).second);
    CHECK(equal(atanh(make(-1, 0)), make(-inf, 0)));
    CHECK(equal(atanh(make(-2, 2)), everything()));
    CHECK(is_empty(atanh(make(1, 2))));
    CHECK_FALSE(with_cut(atanh_of, make(-0.5, 0.5)).second);
    CHECK(equal(asinh(interval{0.0}), make(0, 0)));
}
