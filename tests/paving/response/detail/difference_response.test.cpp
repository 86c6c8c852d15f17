// SPDX-License-Identifier: MIT
#include <sivid/paving/response/detail/difference_response.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <sivid/number/polynomial/monomial_space.hpp>
#include <sivid/paving/contract/detail/lifted_program.hpp>

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

using support::between;

namespace {

/// Two outputs with random coefficients over boxes of parameters and starts.
sivid::response random_response(support::draws& d, sivid::box const& start, sivid::box const& p) {
    sivid::response r{sivid::normalised_unknowns(start, p), nullptr, {}, {}, {}, {}, 2, 0};
    auto const& space = sivid::monomial_space::of(r.unknowns.variables, 2);
    auto table = sivid::monomial_table::of(space, r.unknowns.variables);
    table.find_lines();
    r.table = std::make_shared<sivid::monomial_table>(std::move(table));
    for (std::size_t k = 0; k < 2 * r.table->size(); ++k)
        r.coefficients.push_back(d.uniform(-1, 1));
    r.radius = {0.01, 0.02};
    r.bounds = {between(-9, 9), between(-9, 9)};
    return r;
}

double value(sivid::response const& r, std::vector<double> const& q, std::size_t y) {
    double sum = 0;
    for (std::size_t m = 0; m < r.table->size(); ++m) {
        double term = r.coefficients[m * r.outputs() + y];
        for (std::size_t v = 0; v < q.size(); ++v)
            term *= std::pow(q[v], static_cast<int>(r.table->exponents[m][v]));
        sum += term;
    }
    return sum;
}

} // namespace

TEST_CASE("the difference of two responses holds both sets of unknowns") {
    support::draws d{3};
    sivid::box const start{between(0, 1)}, fixed{sivid::interval(0.5)};
    sivid::box const p{between(1, 2), between(-1, 1)};
    for (int n = 0; n < 20; ++n) {
        auto const a = random_response(d, start, p);
        auto const b = random_response(d, n % 2 == 0 ? start : fixed, p);
        auto const bound = between(-0.1, 0.1);
        auto const r = sivid::difference_of(a, b, {{0, 0, bound}, {1, 0, bound}});
        auto const first = a.table->variables, second = b.table->variables;
        REQUIRE(r.table->variables == first + second);
        CHECK(r.unknowns.parameters.size() == 4);
        CHECK(r.unknowns.initial.size() == 2);
        CHECK(r.outputs() == 2);
        for (std::size_t j = 0; j < 2; ++j) {
            CHECK(r.unknowns.parameters[j].variable == a.unknowns.parameters[j].variable);
            CHECK(r.unknowns.parameters[2 + j].variable ==
                  first + b.unknowns.parameters[j].variable);
        }
        CHECK(r.unknowns.initial[0].variable == a.unknowns.initial[0].variable);
        CHECK(r.unknowns.initial[1].variable == first + b.unknowns.initial[0].variable);
        CHECK(r.unknowns.variables == first + second);
        for (std::size_t m = 0; m + 1 < r.table->size(); ++m) { // graded
            auto const degree = [&](std::size_t k) {
                int sum = 0;
                for (auto const e : r.table->exponents[k]) sum += e;
                return sum;
            };
            CHECK(degree(m) <= degree(m + 1));
        }
        for (int k = 0; k < 50; ++k) {
            std::vector<double> q;
            for (std::size_t v = 0; v < first + second; ++v) q.push_back(d.uniform(-1, 1));
            std::vector<double> const qa(q.begin(), q.begin() + static_cast<std::ptrdiff_t>(first));
            std::vector<double> const qb(q.begin() + static_cast<std::ptrdiff_t>(first), q.end());
            CHECK(std::abs(value(r, q, 0) - (value(a, qa, 0) - value(b, qb, 0))) < 1e-12);
            CHECK(std::abs(value(r, q, 1) - (value(a, qa, 1) - value(b, qb, 0))) < 1e-12);
        }
        CHECK(r.radius[0] >= a.radius[0] + b.radius[0]);
        CHECK(r.radius[1] >= a.radius[1] + b.radius[0]);
        CHECK(r.radius[1] <= a.radius[1] + b.radius[0] + 1e-14);
    }
}

TEST_CASE("a response beside another motion's parameters bounds what it did") {
    support::draws d{4};
    sivid::box const start{between(0, 1)}, p{between(1, 2), between(-1, 1)};
    auto a = random_response(d, start, p);
    a.bounds = {between(-0.2, 0.2), between(-0.2, 0.2)};
    sivid::box const other{between(3, 4)};
    for (bool const before : {false, true}) {
        auto const placed = std::make_shared<sivid::response>(sivid::beside(a, other, before));
        std::vector<sivid::interval> sides(p.begin(), p.end());
        sides.insert(before ? sides.begin() : sides.end(), between(3, 4));
        sivid::response_list const alone{std::make_shared<sivid::response>(a)}, both{placed};
        sivid::lifted_program const one(alone, p, {start}, 0.01);
        sivid::lifted_program const two(both, sivid::box(sides), {start}, 0.01);
        for (std::size_t j = 0; j < 2; ++j) {
            for (bool const up : {false, true})
                CHECK(std::abs(one.reach(j, up) - two.reach(j + (before ? 1 : 0), up)) < 1e-6);
        }
        CHECK(two.reach(before ? 0 : 2, true) == 1);
    }
}
