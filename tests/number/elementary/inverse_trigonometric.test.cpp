// SPDX-License-Identifier: MIT
#include <sivid/number/elementary.hpp>

#include "number/support.hpp"

using namespace sivid;

namespace {
auto const asin_of = [](interval const& x, bool& cut) { return asin(x, cut); };
auto const acos_of = [](interval const& x, bool& cut) { return acos(x, cut); };

std::pair<interval, bool> angle(interval const& y, interval const& x) {
    bool cut = false;
    interval const a = atan2(y, x, cut);
    return {a, cut};
}
constexpr double pi = detail::pi_up, half_pi = detail::half_pi_up;
} // namespace

TEST_CASE("pi lies between the constants") {
    oracle::unary const constant = [](mpfr_ptr r, mpfr_srcptr, mpfr_rnd_t d) {
        return mpfr_const_pi(r, d);
    };
    oracle::value const v = oracle::at(constant, 0.0);
    CHECK(v.below == detail::pi_down);
    CHECK(v.above == detail::pi_up);
    CHECK(v.below / 2 == detail::half_pi_down);
    CHECK(v.above / 2 == detail::half_pi_up);
}

TEST_CASE("asin, acos, atan") {
    CHECK(upper(asin(interval{1.0})) == half_pi);
    CHECK(equal(asin(interval{0.0}), make(0, 0)));
    CHECK(with_cut(asin_of, make(-2, 0.5)).second);
    CHECK(lower(asin(make(-2, 0.5))) == -half_pi);
    CHECK(is_empty(asin(make(1.5, 2))));
    CHECK_FALSE(with_cut(asin_of, make(-1, 1)).second);
    CHECK(equal(acos(interval{1.0}), make(0, 0)));
    CHECK(equal(acos(make(-1, 1)), make(0, pi)));
    CHECK(with_cut(acos_of, make(0, 1.5)).second);
    CHECK(is_empty(acos(make(-3, -2))));
    CHECK(equal(atan(everything()), make(-half_pi, half_pi)));
    CHECK(equal(atan(interval{0.0}), make(0, 0)));
    CHECK(is_empty(atan(nothing())));
}

TEST_CASE("atan2 in every position of the box") {
    CHECK(equal(angle(make(0, 0), make(1, 2)).first, make(0, 0)));
    CHECK(equal(angle(make(0, 0), make(-2, -1)).first, make(detail::pi_down, pi)));
    CHECK(equal(angle(make(0, 0), make(-2, 1)).first, make(0, pi)));
    CHECK(angle(make(0, 0), make(-2, 1)).second);
    CHECK(is_empty(angle(make(0, 0), make(0, 0)).first));
    CHECK(angle(make(0, 0), make(0, 0)).second);
    CHECK(equal(angle(make(1, 2), make(0, 0)).first, make(detail::half_pi_down, half_pi)));
    CHECK(equal(angle(make(-2, -1), make(0, 0)).first, make(-half_pi, -detail::half_pi_down)));
    CHECK(equal(angle(make(-1, 1), make(-2, -1)).first, make(-pi, pi)));
    CHECK(equal(angle(make(-1, 0), make(-2, -1)).first, make(-pi, pi)));
    CHECK(equal(angle(make(-1, 1), make(-1, 1)).first, make(-pi, pi)));
    CHECK(equal(angle(make(-1, 1), make(0, 1)).first, make(-half_pi, half_pi)));
    CHECK(equal(angle(make(0, 1), make(0, 1)).first, make(0, half_pi)));
    CHECK(equal(angle(make(0, 1), make(-1, 0)).first, make(detail::half_pi_down, pi)));
    CHECK_FALSE(angle(make(1, 2), make(-1, 1)).second);
    CHECK(contains(angle(make(1, inf), make(1, inf)).first, 1.5));
    CHECK(lower(angle(make(1, inf), make(1, inf)).first) == 0.0);
    CHECK(is_empty(angle(nothing(), make(1, 2)).first));
}
