// SPDX-License-Identifier: MIT
#include <sivid/paving/contract/detail/lifted_program.hpp>

#include "support/catch.hpp"
#include "support/polynomial_experiments.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::polynomial_experiments;

namespace {

/// Whether what was proved of an unknown allows a value in its range.
bool allows(interval const& range, double up, double down, double x) {
    double const d = (x - mid(range)) / std::max(rad(range), 1e-300);
    return d <= up + 1e-12 && -d <= down + 1e-12;
}

} // namespace

TEST_CASE("nothing that meets all measurements lies beyond what a lifted program proves") {
    draws d(431);
    int cut = 0, empty = 0, kept = 0, ends = 0;
    for (int trial = 0; trial < 250; ++trial) {
        polynomial_experiments const e(d, 1 + d.below(3), 1 + d.below(4), d.uniform(0, 0.5), 0.02,
                                       0);
        auto const part = e.part(d);
        std::vector<box> starts;
        for (auto const& r : e.known) {
            bool const is_point = !(r->unknowns.initial[0].radius > 0);
            double const low = d.uniform(-1, 1), high = d.uniform(low, 1);
            starts.push_back(is_point ? box{interval(1.0)} : box{between(low, high)});
        }
        lifted_program const program(e.known, part, starts, d.coin() ? 0.0 : 0.1, d.coin());
        auto const count = program.unknowns().count;
        std::vector<double> up, down;
        for (std::size_t j = 0; j < count; ++j) {
            up.push_back(program.reach(j, true));
            down.push_back(program.reach(j, false));
            cut += up.back() < 0.9 ? 1 : 0;
            empty += std::isinf(up.back()) ? 1 : 0;
        }
        auto const s = d.below(e.known.size());
        auto const y = d.below(e.known[s]->outputs());
        double const most = program.end_of(s, y, true), least = program.end_of(s, y, false);
        ends += most < mid(e.known[s]->bounds[y]) + rad(e.known[s]->bounds[y]) ? 1 : 0;
        for (int sample = 0; sample < 300; ++sample) {
            auto const p = d.in(part);
            std::vector<double> x;
            for (auto const& start : starts) x.push_back(d.in(start[0]));
            if (!e.feasible(p, x)) continue;
            ++kept;
            for (std::size_t j = 0; j < p.size(); ++j)
                REQUIRE(allows(part[j], up[j], down[j], p[j]));
            for (std::size_t k = 0; k < starts.size(); ++k) {
                auto const& side = e.known[k]->unknowns.initial[0];
                if (!(side.radius > 0)) continue;
                auto const u = program.unknowns().places[k][side.variable].unknown;
                REQUIRE(allows(starts[k][0], up[u], down[u], x[k]));
            }
            auto const value = polynomial_experiments::values(*e.known[s], p, x[s])[y];
            double const room = e.known[s]->radius[y]; // some remainder meets the bound
            REQUIRE(value - room <= most + 1e-9);
            REQUIRE(value + room >= least - 1e-9);
        }
    }
    CHECK(cut > 200);
    CHECK(empty > 20);
    CHECK(ends > 10);
    CHECK(kept > 500);
}

TEST_CASE("a product that stands in two measurements is the same in both") {
    // p0 + p0 p1 and p0 - p0 p1 within 0.1 of zero: as errors the products hide all.
    box const prior{between(-1, 1), between(-1, 1)};
    response r{normalised_unknowns(box{}, prior),
               std::make_shared<monomial_table const>(
                   monomial_table::of(sivid::monomial_space::of(2, 2), 2)),
               {},
               {0, 0},
               {},
               {between(-0.1, 0.1), between(-0.1, 0.1)},
               2,
               0};
    for (auto const& e : r.table->exponents) {
        double const linear = e[0] == 1 && e[1] == 0 ? 1 : 0,
                     mixed = e[0] == 1 && e[1] == 1 ? 1 : 0;
        r.coefficients.push_back(linear + mixed);
        r.coefficients.push_back(linear - mixed);
    }
    response_list const known{std::make_shared<response const>(r)};
    lifted_program const program(known, prior, {box{}}, 0.0);
    CHECK_THAT(program.reach(0, true), WithinAbs(0.1, 1e-6));
    CHECK_THAT(program.reach(0, false), WithinAbs(0.1, 1e-6));
    CHECK(program.reach(1, true) == 1);
    lifted_program const plain(known, prior, {box{}}, 10); // the product is an error
    CHECK(plain.reach(0, true) == 1);
}

TEST_CASE("squares are held by their tangents") {
    // p^2 + p / 4 within 0.01 of 0.36 + 0.15: p = 0.6 or about -0.85
    box const prior{between(-0.2, 1)};
    response r{normalised_unknowns(box{}, prior),
               std::make_shared<monomial_table const>(
                   monomial_table::of(sivid::monomial_space::of(1, 2), 1)),
               {},
               {0},
               {},
               {between(0.50, 0.52)},
               1,
               0};
    double const c = mid(prior[0]), h = rad(prior[0]);
    for (auto const& e : r.table->exponents) {
        r.coefficients.push_back(e[0] == 0 ? c * c + c / 4 : e[0] == 1 ? 2 * c * h + h / 4 : h * h);
    }
    response_list const known{std::make_shared<response const>(r)};
    lifted_program const program(known, prior, {box{}}, 0.0);
    double const most = c + h * program.reach(0, true), least = c - h * program.reach(0, false);
    CHECK(most < 0.75);
    CHECK(most >= 0.6);
    CHECK(least <= 0.6);
    CHECK(least > 0.28);
}
