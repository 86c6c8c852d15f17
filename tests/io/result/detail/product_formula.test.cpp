// SPDX-License-Identifier: MIT
#include <sivid/io/result/detail/product_formula.hpp>

#include "support/catch.hpp"

using sivid::box;
using sivid::interval;
using sivid::product_formula;

TEST_CASE("products are read and enclosed") {
    std::vector<std::string> const names{"L", "Sg", "a"};
    box const p{interval(2, 3), interval(4, 5), interval(1, 2)};
    auto const range = [&](char const* text) {
        auto const f = product_formula::parse(text, names);
        REQUIRE(f);
        return f->over(p).value();
    };
    CHECK(range("L*Sg").lower() == 8);
    CHECK(range("L*Sg").upper() == 15);
    CHECK(range("L^2/a").lower() == 2);
    CHECK(range("L^2/a").upper() == 9);
    CHECK(range("1/(L*a)").upper() == 0.5);
    CHECK(range("L*Sg/(a^2)").lower() == 2);
    CHECK_FALSE(product_formula::parse("1/a", names)->over(box{p[0], p[1], interval(-1, 1)}));
}

TEST_CASE("what is no product of the names is refused") {
    std::vector<std::string> const names{"L", "Sg"};
    for (auto const* text : {"", "x", "L*", "L+Sg", "L^", "L^0", "L^-1", "1/1", "L/(Sg", "*L"}) {
        INFO(text);
        CHECK_FALSE(product_formula::parse(text, names));
    }
}

TEST_CASE("powers that no model has are refused, also as sums") {
    std::vector<std::string> const names{"a", "b"};
    CHECK(product_formula::parse("a^1000/b^2", names)->degree() == 1002);
    for (auto const* text : {"a^1001", "1/b^1001", "a^600*a^600", "a^2147483647*a^2147483647"}) {
        INFO(text);
        CHECK_FALSE(product_formula::parse(text, names));
    }
}
