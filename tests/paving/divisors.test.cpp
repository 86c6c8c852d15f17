// SPDX-License-Identifier: MIT
#include <sivid/paving/divisors.hpp>

#include <sivid/paving/identify.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>

using namespace sivid;

namespace {

/// x' = 1 / (a + b x^2 - 2), y = x / a; the divisor is `a + b * x^2 - 2`.
struct ratio {
    static constexpr auto name = "ratio";
    static constexpr auto states = sivid::states({{"x", "m", 2}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"y", "m"}});
    static constexpr auto constants = sivid::constants({{"a", "1", 3_dec}, {"b", "1", 1_dec}});
    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 2> const& c, vec<T, 0> const&) const {
        return {1 / (c[0] + c[1] * sqr(x[0]) - 2)};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 1> const& x, vec<T, 2> const& c, vec<T, 0> const&) const {
        return {x[0] / c[0]};
    }
};
/// The same without a gap that a sign would show: it touches zero.
struct touching : ratio {
    static constexpr auto name = "touching";
    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 2> const& c, vec<T, 0> const&) const {
        return {1 / sqr(x[0] - c[1])};
    }
};
/// Jumps over zero.
struct jumping : ratio {
    static constexpr auto name = "jumping";
    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 2> const&, vec<T, 0> const&) const {
        return {1 / (sign(x[0]) + sign(x[0] - 1) * 3)};
    }
};

/// Divides by what an input moves.
struct pushed {
    static constexpr auto name = "pushed";
    static constexpr auto states = sivid::states({{"x", "m", 2}});
    static constexpr auto inputs = sivid::inputs({{"u", "1"}});
    static constexpr auto channels = sivid::channels({{"x", "m"}});
    static constexpr auto constants = sivid::constants({{"a", "1", 3_dec}});
    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const&, vec<T, 1> const& c, vec<T, 1> const& u) const {
        return {1 / (c[0] + u[0])};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 1> const& x, vec<T, 1> const&, vec<T, 1> const&) const {
        return x;
    }
};

template <class Model>
std::vector<divisor> found(interval const& a, interval const& b, divisor_options const& how = {}) {
    experiment run{"run", {}, 0, {interval(0.0)}, {{1, 0, interval(0.0, 9.0)}}, 0};
    return divisors_of({record_model<Model>(), {{"a", "b"}, {}}, {a, b}, {run}}, how);
}

} // namespace

TEST_CASE("what equations divide by is named, with whether and where it vanishes") {
    auto const all = found<ratio>({1, 4}, {0, 1});
    REQUIRE(all.size() == 2);
    auto const& rate = all[0].formula == "a" ? all[1] : all[0];
    auto const& output = all[0].formula == "a" ? all[0] : all[1];
    CHECK(rate.equations == std::vector<std::string>{"x"});
    CHECK(rate.zeros == zeros::some);
    REQUIRE(rate.near.size() == 3);
    double a = 0, b = 0, x = 0;
    for (auto const& [name, value] : rate.near) (name == "a" ? a : name == "b" ? b : x) = value;
    CHECK(std::abs(a + b * x * x - 2) < 0.5);
    CHECK(output.equations == std::vector<std::string>{"output y"});
    CHECK(output.zeros == zeros::none);
    CHECK(output.near.empty());
}

TEST_CASE("no zero is claimed where there is none, and none is overlooked") {
    support::draws d(17);
    std::size_t none = 0, some = 0;
    for (int round = 0; round < 200; ++round) {
        double const a = d.uniform(1, 4), b = d.uniform(-0.6, 0.6);
        interval const as(a, a + d.uniform(0, 1)), bs(b, b + d.uniform(0, 0.3));
        // Over |x| <= 2: the range of a + b x^2 - 2.
        double const least = as.lower() - 2 + std::min(0.0, 4 * bs.lower());
        double const most = as.upper() - 2 + std::max(0.0, 4 * bs.upper());
        for (auto const& one : found<ratio>(as, bs)) {
            if (one.formula == "a") continue;
            CAPTURE(round, least, most);
            if (one.zeros == zeros::none) CHECK((least > 0 || most < 0));
            if (one.zeros == zeros::some) CHECK((least <= 0 && most >= 0));
            none += one.zeros == zeros::none ? 1U : 0U;
            some += one.zeros == zeros::some ? 1U : 0U;
        }
    }
    CHECK(none > 20);
    CHECK(some > 20);
}

TEST_CASE("what touches zero or jumps over it stays open, what was not looked at is not told") {
    for (auto const& d : found<touching>({1, 2}, {-1, 1})) {
        if (d.formula == "a") continue;
        CHECK(d.zeros == zeros::unknown);
        CHECK_FALSE(d.near.empty());
    }
    for (auto const& d : found<jumping>({1, 2}, {-1, 1})) {
        if (d.formula != "a") CHECK(d.zeros == zeros::unknown);
    }
    divisor_options at_once;
    at_once.keep_going = [] { return false; };
    auto const told = found<ratio>({1, 4}, {0, 1}, at_once); // one look at "a" is enough
    REQUIRE(told.size() == 1);
    CHECK((told[0].formula == "a" && told[0].zeros == zeros::none));
}

TEST_CASE("an identification that excludes little says what its equations divide by") {
    experiment run{"run", {}, 0, {interval(1.0)}, {{1, 0, interval(0.0, 9.0)}}, 0};
    identify_options quick;
    quick.search.boxes = 20;
    auto const said = [&](interval const& a) {
        return identify({record_model<ratio>(), {{"a", "b"}, {}}, {a, {0, 1}}, {run}}, quick)
            .divisors;
    };
    auto const some = said({1, 4});
    REQUIRE(some.size() == 1); // not the one that cannot vanish
    CHECK(some[0].zeros == zeros::some);
    CHECK(said({2.5, 4}).empty());
}

TEST_CASE("a domain without bounds leaves divisors open and ends no identification") {
    auto const m = record_model<pushed>();
    experiment run{"run",
                   {analytic_signal::from([](auto const& t) { return 1 / t; })},
                   0,
                   {interval(0.0)},
                   {{1, 0, interval(0.0, 9.0)}},
                   0};
    identification_problem const p{m, {{"a"}, {}}, {interval(1.0, 2.0)}, {run}};
    auto const all = divisors_of(p);
    REQUIRE(all.size() == 1);
    CHECK(all[0].zeros == zeros::unknown);
    identify_options quick;
    quick.search.boxes = 20;
    CHECK(identify(p, quick).divisors.size() == 1);
}
