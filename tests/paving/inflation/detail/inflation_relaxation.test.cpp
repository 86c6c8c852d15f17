// SPDX-License-Identifier: MIT
#include <sivid/paving/inflation/detail/inflation_relaxation.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

/// Experiments whose outputs are random polynomials in two parameters and a start of their own.
struct random_experiments {
    box prior{between(0.5, 2), between(-1, 3)};
    inflation_bounder::responses known;
    std::vector<std::size_t> outliers;

    random_experiments(draws& d, std::size_t experiments, std::size_t outputs, double curvature,
                       double radius, std::size_t q) {
        for (std::size_t s = 0; s < experiments; ++s) {
            box const start{d.coin() ? between(-1, 2) : interval(1.0)};
            response r{normalised_unknowns(start, prior), nullptr, {}, {}, {}, {}, outputs, 0};
            auto const used = r.unknowns.variables;
            r.table = std::make_shared<monomial_table const>(
                monomial_table::of(sivid::monomial_space::of(3, 3), used));
            for (std::size_t m = 0; m < r.table->size(); ++m) {
                std::size_t degree = 0;
                for (auto const e : r.table->exponents[m]) degree += e;
                for (std::size_t y = 0; y < outputs; ++y) {
                    r.coefficients.push_back(d.uniform(-1, 1) * (degree > 1 ? curvature : 1));
                }
            }
            for (std::size_t y = 0; y < outputs; ++y) {
                r.radius.push_back(d.uniform(0, radius));
                double const middle = d.uniform(-1, 1);
                double const e = std::pow(10, d.uniform(-1.5, 0));
                r.bounds.push_back(between(middle - e, middle + e));
            }
            known.push_back(std::make_shared<response const>(std::move(r)));
            outliers.push_back(q);
        }
    }

    /// The inflation at a point, with the remainders drawn or as kind as they can be.
    [[nodiscard]] double inflation(std::vector<double> const& p,
                                   std::vector<double> const& starts) const {
        double worst = 0;
        for (std::size_t s = 0; s < known.size(); ++s) {
            auto const& r = *known[s];
            std::vector<double> q(r.unknowns.variables);
            for (std::size_t j = 0; j < p.size(); ++j) {
                auto const& side = r.unknowns.parameters[j];
                q[side.variable] = (p[j] - side.centre) / side.radius;
            }
            if (r.unknowns.initial[0].radius > 0) {
                q[r.unknowns.initial[0].variable] = starts[s];
            }
            std::vector<double> misfits;
            for (std::size_t y = 0; y < r.outputs(); ++y) {
                double value = 0;
                for (std::size_t m = 0; m < r.table->size(); ++m) {
                    double term = r.coefficients[m * r.outputs() + y];
                    for (std::size_t v = 0; v < q.size(); ++v) {
                        term *= std::pow(q[v], r.table->exponents[m][v]);
                    }
                    value += term;
                }
                double const off = std::abs(value - mid(r.bounds[y])) - r.radius[y];
                misfits.push_back(std::max(off, 0.0) / (0.5 * width(r.bounds[y])));
            }
            worst = std::max(worst, largest_after(misfits, outliers[s]));
        }
        return worst;
    }
};

} // namespace

TEST_CASE("no point of the box has a smaller inflation than the relaxation proves") {
    draws d(91);
    std::size_t useful = 0;
    for (int trial = 0; trial < 150; ++trial) {
        random_experiments const e(d, 1 + d.below(3), 2 + d.below(10),
                                   std::pow(10, -d.uniform(0, 3)), d.coin() ? 0 : 0.05, d.below(3));
        auto part = e.prior;
        for (std::size_t j = 0; j < 2; ++j) {
            double const share = std::pow(10, -d.uniform(0, 2));
            double const lo = part[j].lower() + d.uniform(0, 1 - share) * width(part[j]);
            part[j] = between(lo, std::min(lo + share * width(part[j]), part[j].upper()));
        }
        double const target = d.uniform(0, 5);
        auto const found = inflation_bounder(e.known, e.outliers, part)(target);
        useful += found.lower > 0 ? 1 : 0;
        REQUIRE(found.lower >= 0);
        REQUIRE(found.smear.size() == 2);
        REQUIRE(found.blur.size() == e.known.size());
        auto const check = [&](std::vector<double> const& p, std::vector<double> const& x0) {
            REQUIRE(found.lower <= e.inflation(p, x0) * (1 + 1e-12) + 1e-12);
        };
        for (int sample = 0; sample < 200; ++sample) {
            std::vector<double> x0;
            for (std::size_t s = 0; s < e.known.size(); ++s) x0.push_back(d.in(between(-1, 1)));
            check(d.in(part), x0);
        }
        // Where the relaxation itself expects the least.
        REQUIRE(found.point.size() == 2);
        CHECK(contains(part, found.point));
        std::vector<double> x0;
        for (std::size_t s = 0; s < e.known.size(); ++s) {
            auto const& side = e.known[s]->unknowns.initial[0];
            x0.push_back(side.radius > 0 ? (found.starts[s][0] - side.centre) / side.radius : 0);
            CHECK(std::abs(x0.back()) <= 1 + 1e-9);
        }
        check(found.point, x0);
    }
    CHECK(useful > 80);
}

TEST_CASE("affine outputs without outliers: the bound is attained") {
    draws d(92);
    for (int trial = 0; trial < 50; ++trial) {
        random_experiments const e(d, 1 + d.below(4), 3 + d.below(20), 0, 0, 0);
        auto const found = inflation_bounder(e.known, e.outliers, e.prior)(1);
        CHECK_THAT(found.lower, WithinAbs(found.approximate_value, 1e-8));
        CHECK(found.slack <= 1e-9);
    }
}
