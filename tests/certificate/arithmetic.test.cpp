// SPDX-License-Identifier: MIT
// The checker's own arithmetic against long double, whose functions are good to far below a double.
#include "support/catch.hpp"

#include <sivid/number/text/sha256.hpp>

#include <array>
#include <cfloat>
#include <cmath>
#include <random>
#include <string>
#include <tuple>

extern "C" {
void checker_function(int which, double lo, double hi, double lo2, double hi2, double* result);
void checker_number(char const* text, double* result);
int checker_has_digest(char const* text, char const* digest);
}

namespace {

long double exact(int which, long double x, long double y) {
    switch (which) {
    case 0:
        return x + y;
    case 1:
        return x - y;
    case 2:
        return x * y;
    case 3:
        return x / y;
    case 4:
        return x * x;
    case 5:
        return std::sqrt(x);
    case 6:
        return std::exp(x);
    case 7:
        return std::sin(x);
    default:
        return std::cos(x);
    }
}

} // namespace

TEST_CASE("the checker's operations enclose, and not much more", "[certificate]") {
    if (LDBL_MANT_DIG < 64) SIVID_SKIP("long double is no longer than double here");
    std::mt19937_64 random(3);
    auto const draw = [&](double scale) {
        return scale * (2 * std::generate_canonical<double, 53>(random) - 1);
    };
    for (int k = 0; k < 200'000; ++k) {
        int const which = k % 9;
        double const scale = std::pow(10., draw(which < 6 ? 20 : 2.3));
        double x = draw(scale), y = draw(std::pow(10., draw(20)));
        if (which == 5) x = std::abs(x);
        double const w = k % 2 == 0 ? 0 : std::abs(draw(0.1 * std::abs(x)));
        std::array<double, 2> r{}, at{};
        checker_function(which, x, x + w, y, y, r.data());
        checker_function(which, x, x, y, y, at.data());
        for (double const p : {x, x + 0.3 * w, x + w}) {
            auto const v = exact(which, p, y);
            auto const slack = std::abs(v) * LDBL_EPSILON; // of long double
            INFO(which << " " << p << " " << y);
            if (!(r[0] <= v + slack) || !(v - slack <= r[1])) FAIL("not enclosed");
        }
        auto const v = std::abs(exact(which, x, y));
        if (v > 1e-280L && v < 1e280L && which < 6 && !(at[1] - at[0] <= 1e-14L * v))
            FAIL("too wide");
        if (which >= 7 && !(at[1] - at[0] <= 1e-12)) FAIL("too wide");
        if (which == 6 && v < 1e280L && !(at[1] - at[0] <= 1e-11L * v)) FAIL("too wide");
    }
}

TEST_CASE("the checker divides by no interval with 0, and knows no root below 0", "[certificate]") {
    std::array<double, 2> r{};
    for (auto const& [which, lo, hi, lo2, hi2] :
         {std::tuple{3, 1., 2., -1., 1.}, std::tuple{3, 1., 2., 0., 1.},
          std::tuple{5, -1., 4., 0., 0.}, std::tuple{2, 0., 0., -HUGE_VAL, 1.},
          std::tuple{1, -HUGE_VAL, 1., -HUGE_VAL, 1.}, std::tuple{0, std::nan(""), 1., 0., 0.}}) {
        checker_function(which, lo, hi, lo2, hi2, r.data());
        CHECK(r[0] == -HUGE_VAL);
        CHECK(r[1] == HUGE_VAL);
    }
    for (double const x : {5e-324, 1e-320, 2.2250738585072014e-308}) { // subnormal numbers
        checker_function(2, x, x, 0.1, 0.1, r.data());
        CHECK((r[0] <= 0.1L * x && 0.1L * x <= r[1]));
        checker_function(0, x, x, x, x, r.data());
        CHECK((r[0] <= 2 * x && 2 * x <= r[1]));
    }
    checker_function(6, 800, 900, 0, 0, r.data());
    CHECK(r[1] == HUGE_VAL);
    checker_function(6, -900, -800, 0, 0, r.data());
    CHECK((r[0] == 0 && r[1] > 0 && r[1] < 1e-300));
    checker_function(7, 1e7, 1e7, 0, 0, r.data());
    CHECK((r[0] == -1 && r[1] == 1));
}

TEST_CASE("the checker encloses decimals and knows the digest of a text", "[certificate]") {
    std::array<double, 2> r{};
    for (auto const* text :
         {"0.1", "-0.1", "3.141592653589793", "1e-3", "1e22", "123456789012345678",
          "0.3333333333333333333333", "1e-320", "2.5e+2"}) {
        checker_number(text, r.data());
        auto const v = std::stold(text);
        CHECK((r[0] < v && v < r[1]));
    }
    checker_number("12", r.data());
    CHECK((r[0] == 12 && r[1] == 12));
    checker_number("-0.00", r.data());
    CHECK((r[0] == 0 && r[1] == 0));
    for (std::size_t n : {0U, 1U, 55U, 56U, 63U, 64U, 65U, 1000U}) {
        auto const text = std::string(n, 'a');
        CHECK(checker_has_digest(text.c_str(), sivid::sha256(text).c_str()) != 0);
        CHECK(checker_has_digest((text + "b").c_str(), sivid::sha256(text).c_str()) == 0);
    }
}
