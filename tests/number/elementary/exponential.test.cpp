// SPDX-License-Identifier: MIT
#include <sivid/number/elementary.hpp>

#include "number/support.hpp"

using namespace sivid;

namespace {
auto const log_of = [](interval const& x, bool& cut) { return log(x, cut); };
auto const log1p_of = [](interval const& x, bool& cut) { return log1p(x, cut); };
} // namespace

TEST_CASE("exp and expm1 at their monotone ends") {
    CHECK(equal(exp(interval{0.0}), make(1, 1)));
    CHECK(equal(exp(make(-inf, 0)), make(0, 1)));
    CHECK(lower(exp(make(tiny, 1))) == 1.0);
    CHECK(upper(exp(make(-1, -tiny))) == 1.0);
    CHECK(equal(exp(everything()), make(0, inf)));
    CHECK(lower(exp(interval{800.0})) > 1.79e308);
    CHECK(upper(exp(interval{800.0})) == inf);
    CHECK(lower(exp(interval{-800.0})) == 0.0);
    CHECK(upper(exp(interval{-800.0})) > 0.0);
    CHECK(is_empty(exp(nothing())));
    CHECK(equal(expm1(interval{0.0}), make(0, 0)));
    CHECK(lower(expm1(everything())) == -1.0);
    CHECK(lower(expm1(interval{1e-300})) == 1e-300);
    CHECK(is_empty(expm1(nothing())));
}

TEST_CASE("log and log1p report the cut domain") {
    CHECK(equal(log(interval{1.0}), make(0, 0)));
    auto const [half, cut] = with_cut(log_of, make(-3, 1));
    CHECK(cut);
    CHECK(equal(half, make(-inf, 0)));
    auto const [at_zero, cut_at_zero] = with_cut(log_of, make(0, 1));
    CHECK(cut_at_zero);
    auto const [inside, not_cut] = with_cut(log_of, make(tiny, 1));
    CHECK_FALSE(not_cut);
    CHECK(lower(inside) > -745.2);
    auto const [none, cut_all] = with_cut(log_of, make(-3, 0));
    CHECK(cut_all);
    CHECK(is_empty(none));
    auto const [of_empty, cut_empty] = with_cut(log_of, nothing());
    CHECK(is_empty(of_empty));
    CHECK_FALSE(cut_empty);
    CHECK(upper(log(make(1, inf))) == inf);

    CHECK(with_cut(log1p_of, make(-1, 0)).second);
    CHECK_FALSE(with_cut(log1p_of, make(-0.5, 0)).second);
    CHECK(equal(log1p(make(-1, 0)), make(-inf, 0)));
    CHECK(is_empty(log1p(make(-3, -1))));
    CHECK(upper(log1p(interval{1e-300})) == 1e-300);
}

TEST_CASE("a cut that was seen stays seen") {
    bool cut = true;
    static_cast<void>(log(make(1, 2), cut));
    CHECK(cut);
}
