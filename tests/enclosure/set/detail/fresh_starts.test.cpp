// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/taylor_models.hpp"

#include <sivid/enclosure/set/detail/fresh_starts.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

using model = taylor_model<double>;
using set_of_models = parametric_set<model>;

/// Polynomials of degree 3 in three variables, and generators of degree 2 in them.
set_of_models random_set(draws& d, std::size_t n, std::size_t columns) {
    set_of_models set(n, model_shape<double>::of(3, 3));
    set.time = d.uniform(-1, 1);
    double const size = std::pow(10, d.uniform(-8, 3));
    for (std::size_t i = 0; i < n; ++i) {
        double const own = size * std::pow(10, d.uniform(-3, 0));
        if (d.below(8) == 0) {
            set.centre[i] = model::constant(own);
        } else {
            set.centre[i] = support::random_model<3, 3>(d, own, 1, 0);
        }
        set.centre[i].r() = 0;
    }
    for (std::size_t j = 0; j < columns; ++j) {
        auto& g = set.columns.emplace_back();
        for (std::size_t i = 0; i < n; ++i) {
            g.push_back(support::random_model<3, 2>(d, 0.1 * size, 0.5, 0));
            g.back().r() = 0;
        }
    }
    set.measure();
    return set;
}

std::vector<double> member(draws& d, std::size_t n) {
    std::vector<double> xi(n);
    for (auto& x : xi) x = d.below(3) == 0 ? d.uniform(-1, 1) : d.coin() ? 1.0 : -1.0;
    return xi;
}

} // namespace

TEST_CASE("a set with fresh starts contains the old one, for each value of the parameters") {
    draws d(5);
    for (int round = 0; round < 300; ++round) {
        std::size_t const kept = d.below(4); // of three variables, and a state for each other one
        std::size_t const n = std::max<std::size_t>(1, 3 - kept) + d.below(3);
        auto const set = random_set(d, n, d.below(9));
        auto const& shape = model_shape<double>::of(kept + n, 2 + d.below(3));
        auto const fresh = enclosure_detail::with_fresh_starts(set, kept, shape);
        REQUIRE(fresh.time == set.time);
        REQUIRE(fresh.centre.size() == n);
        for (int sample = 0; sample < 20; ++sample) {
            auto const q = member(d, 3), xi = member(d, set.columns.size());
            std::vector<double> direction(n);
            for (auto& x : direction) x = d.uniform(-1, 1);
            // How far the member and the new set reach along the direction, at these parameters.
            double height = 0, reach = 0, size = 0;
            std::vector<double> at(kept + n, 0.0);
            for (std::size_t v = 0; v < kept; ++v) at[v] = q[v];
            for (std::size_t i = 0; i < n; ++i) {
                double x = support::value<double>(set.centre[i], q);
                for (std::size_t j = 0; j < set.columns.size(); ++j) {
                    x += support::value<double>(set.columns[j][i], q) * xi[j];
                }
                height += direction[i] * (x - support::value<double>(fresh.centre[i], at));
                size += std::abs(direction[i]) * (set.centre[i].norm() + set.reach[i]);
                REQUIRE(fresh.centre[i].r() == 0);
                REQUIRE(&fresh.centre[i].shape() == &shape);
            }
            for (std::size_t k = 0; k < n; ++k) {
                double along = 0;
                for (std::size_t i = 0; i < n; ++i) {
                    along += direction[i] * fresh.centre[i].c(shape.space->variable(kept + k));
                }
                reach += std::abs(along);
            }
            for (auto const& g : fresh.columns) {
                double along = 0;
                for (std::size_t i = 0; i < n; ++i) along += direction[i] * g[i].c(0);
                reach += std::abs(along);
            }
            CAPTURE(n, kept, height, reach);
            REQUIRE(std::abs(height) <= reach + 1e-13 * size); // the test's own roundings
        }
    }
}

TEST_CASE("fresh starts: nothing is lost of an oblong box, or of what parameters do") {
    auto const& shape = model_shape<double>::of(3, 2);
    set_of_models set(2, shape);
    set.time = 1;
    for (std::size_t i = 0; i < 2; ++i) { // q_0 a parameter
        auto& p = set.centre[i];
        double const across = i == 0 ? -1 : 1;
        p.c(0) = 3;
        p.c(shape.space->variable(0)) = 0.5;
        p.c(shape.space->variable(1)) = 2;
        p.c(shape.space->variable(2)) = 0.001 * across;
        p.finish();
    }
    set.measure();
    auto const fresh = enclosure_detail::with_fresh_starts(set, 1, shape);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(fresh.centre[i].c(0) == 3);
        CHECK(fresh.centre[i].c(shape.space->variable(0)) == 0.5);
        CHECK(std::abs(fresh.centre[i].c(shape.space->variable(1))) < 2.0001);
        CHECK(std::abs(fresh.centre[i].c(shape.space->variable(2))) < 0.00101);
        CHECK(fresh.reach[i] < 1e-13);
    }
}
