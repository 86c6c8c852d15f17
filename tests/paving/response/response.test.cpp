// SPDX-License-Identifier: MIT
#include "support/catch.hpp"

#include <sivid/paving/response/response.hpp>

#include <cstddef>
#include <vector>

using namespace sivid;

TEST_CASE("the monomials of some variables of a space") {
    auto const all = monomial_table::of(monomial_space::of(3, 4), 3);
    REQUIRE(all.variables == 3);
    REQUIRE(all.degree == 4);
    REQUIRE(all.size() == monomials<3, 4>::count);
    for (std::size_t m = 0; m < all.size(); ++m) {
        for (std::size_t v = 0; v < 3; ++v) {
            REQUIRE(all.exponents[m][v] == monomials<3, 4>::data.exponents[m][v]);
        }
    }
    std::vector<std::size_t> place;
    // Of three variables only the first: powers 0 .. 4.
    auto const one = monomial_table::of(monomial_space::of(3, 4), 1, &place);
    REQUIRE(one.size() == 5);
    REQUIRE(place == std::vector<std::size_t>{0, 1, 4, 10, 20});
    for (std::size_t m = 0; m < 5; ++m) {
        REQUIRE(one.exponents[m].size() == 1);
        REQUIRE(one.exponents[m][0] == m);
    }
    REQUIRE(monomial_table::of(monomial_space::of(3, 4), 0).size() == 1);
}

TEST_CASE("lines: each monomial once per variable, with powers that grow by one") {
    for (std::size_t const used : {1U, 2U, 3U}) {
        auto const t = monomial_table::of(monomial_space::of(3, 3), used);
        REQUIRE(t.lines.size() == used);
        for (std::size_t v = 0; v < used; ++v) {
            std::vector<int> seen(t.size(), 0);
            for (auto const& line : t.lines[v]) {
                std::size_t degree = 0;
                for (std::size_t k = 0; k < line.size(); ++k) {
                    ++seen[line[k]];
                    REQUIRE(t.exponents[line[k]][v] == k);
                    auto e = t.exponents[line[k]];
                    e[v] = 0;
                    REQUIRE(e == t.exponents[line[0]]);
                }
                for (auto const x : t.exponents[line[0]]) degree += x;
                REQUIRE(line.size() == 3 - degree + 1); // to the end: no coefficient is left out
            }
            for (int const count : seen) REQUIRE(count == 1);
        }
    }
}

TEST_CASE("the builder lays outputs out by monomials") {
    response_builder collected(2);
    collected.add([](std::size_t m) { return m == 0 ? 1.0 : 2.0; }, 0.5, interval(7.0));
    collected.add([](std::size_t m) { return m == 0 ? 3.0 : 4.0; }, 0.25, interval(8.0));
    response r{normalised_unknowns({}, {interval(0.0, 1.0)}), nullptr, {}, {}, {}, {}, 2, 0};
    std::move(collected).finish(r);
    REQUIRE(r.outputs() == 2);
    REQUIRE(r.coefficients == std::vector<double>{1, 3, 2, 4});
    REQUIRE(r.radius == std::vector<double>{0.5, 0.25});
    REQUIRE(upper(r.bounds[1]) == 8);
}
