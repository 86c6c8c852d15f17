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

TEST_CASE("groups of measurements prove more than single ones when outliers are allowed") {
    // Pairs that contradict each other: y = p, measured as -1 +- 0.1 and as 1 +- 0.1, five times.
    response r{normalised_unknowns(box{}, box{between(-1, 1)}),
               std::make_shared<monomial_table const>(
                   monomial_table::of(sivid::monomial_space::of(1, 1), 1)),
               {},
               {},
               {},
               {},
               10,
               0};
    for (std::size_t y = 0; y < 10; ++y) {
        r.bounds.push_back(y < 5 ? between(-1.1, -0.9) : between(0.9, 1.1));
        r.radius.push_back(0);
    }
    r.coefficients.assign(10, 0.0);
    r.coefficients.insert(r.coefficients.end(), 10, 1.0);
    inflation_bounder::responses const known{std::make_shared<response const>(r)};
    auto const lower = [&](std::size_t q, double target) {
        std::vector<std::size_t> const outliers{q};
        box const part{between(-1, 1)};
        return inflation_bounder(known, outliers, part)(target).lower;
    };
    // Whatever p, five of the ten are wrong by at least 1: ten times their half width.
    CHECK_THAT(lower(0, 9), WithinAbs(10, 1e-6));
    for (std::size_t q = 1; q < 5; ++q) CHECK(lower(q, 9) == 9);
    CHECK(lower(4, 11) < 10);
    CHECK(lower(5, 9) == 0); // p = 1 with five outliers
    CHECK(lower(10, 9) == 0);
}

TEST_CASE("a relaxation of odd measurements") {
    response r{normalised_unknowns(box{}, box{between(-1, 1)}),
               std::make_shared<monomial_table const>(
                   monomial_table::of(sivid::monomial_space::of(1, 1), 1)),
               {0, 0, 1, 1},
               {0, 0},
               {},
               {interval_traits<interval>::entire(), between(2, HUGE_VAL)},
               2,
               0};
    std::vector<std::size_t> const none{0};
    box const part{between(-1, 1)};
    auto const lower = [&] {
        inflation_bounder::responses const known{std::make_shared<response const>(r)};
        return inflation_bounder(known, none, part)(1).lower;
    };
    CHECK(lower() == 0); // nothing bounded
    r.bounds[0] = interval(3.0);
    CHECK(lower() > 1e10); // a point that cannot be met
    r.bounds[0] = interval(0.5);
    CHECK(lower() == 0);
    r.bounds[0] = between(2.5, 3.5);
    CHECK_THAT(lower(), WithinAbs(4, 1e-9));
    r.radius[0] = HUGE_VAL;
    CHECK(lower() == 0);
    r.radius[0] = std::nan("");
    CHECK(lower() == 0);
    // Nothing was reached.
    r.coefficients.clear();
    r.radius.clear();
    r.bounds.clear();
    CHECK(lower() == 0);
}

TEST_CASE("a remainder that hides the worst measurement counts as blur") {
    draws d(92);
    random_experiments e(d, 1, 4, 0, 0, 0);
    auto r = *e.known.front();
    double const error = 0.5 * width(r.bounds[2]);
    for (std::size_t m = 0; m < r.table->size(); ++m) {
        std::size_t degree = 0;
        for (auto const k : r.table->exponents[m]) degree += k;
        r.coefficients[m * 4 + 2] = degree > 0 ? 0 : mid(r.bounds[2]) + 1000 * error;
    }
    auto const found = [&](double radius) {
        r.radius[2] = radius * error;
        e.known.front() = std::make_shared<response const>(r);
        return inflation_bounder(e.known, e.outliers, e.prior)(detail::infinity);
    };
    auto const sharp = found(0);
    CHECK(std::abs(sharp.lower - 1000) < 1e-6);
    auto const masked = found(999.9);
    CHECK(masked.lower < 500);
    CHECK(masked.blur.front() > 500);
    auto const beside = found(1);
    CHECK(std::abs(beside.lower - 999) < 1e-6);
    CHECK(std::abs(beside.blur.front() - 1) < 1e-6);
}

TEST_CASE("what ends an experiment early is told by the parameters that spread its last outputs") {
    // Thirty outputs: the first parameter moves the early ones, the second one the last ones.
    response r{normalised_unknowns(box{}, box{between(-1, 1), between(0, 4)}),
               std::make_shared<monomial_table const>(
                   monomial_table::of(sivid::monomial_space::of(2, 1), 2)),
               std::vector<double>(90, 0.0),
               std::vector<double>(30, 0.0),
               {},
               std::vector<interval>(30, between(-0.5, 0.5)),
               30,
               0};
    for (std::size_t m = 0; m < r.table->size(); ++m) {
        auto const& e = r.table->exponents[m];
        for (std::size_t y = 0; y < 30; ++y) {
            if (e[0] == 1 && y < 15) r.coefficients[m * 30 + y] = 100;
            if (e[1] == 1 && y >= 15) r.coefficients[m * 30 + y] = 1;
        }
    }
    std::vector<std::size_t> const none{0};
    auto const found = [&](box const& part) {
        inflation_bounder::responses const known{std::make_shared<response const>(r)};
        return inflation_bounder(known, none, part)(1);
    };
    box const whole{between(-1, 1), between(0, 4)};
    CHECK(found(whole).ending == std::vector<double>{0, 0}); // it did not end early
    r.measurements = 60;
    auto const ended = found(whole).ending;
    CHECK(ended[0] == 0);
    CHECK(ended[1] > 0);
    auto const half = found(box{between(-1, 1), between(0, 2)}).ending;
    CHECK(std::abs(half[1] - ended[1] / 2) < 1e-9 * ended[1]);
}

TEST_CASE("a measurement that its curvature hides smears the parameters in its nonlinear terms") {
    // One output is off by two bounds everywhere, one by five and more or less with p q.
    response r{normalised_unknowns(box{}, box{between(-1, 1), between(-1, 1)}),
               std::make_shared<monomial_table const>(
                   monomial_table::of(sivid::monomial_space::of(2, 2), 2)),
               {},
               {0, 0},
               {},
               {between(-1, 1), between(-1, 1)},
               2,
               0};
    for (auto const& e : r.table->exponents) {
        bool const constant = e[0] + e[1] == 0;
        r.coefficients.push_back(constant ? 2 : 0);
        r.coefficients.push_back(constant ? 5 : e[0] * e[1] == 1 ? 40 : 0);
    }
    auto const found = [&] {
        std::vector<std::size_t> const none{0};
        box const part{between(-1, 1), between(-1, 1)};
        inflation_bounder::responses const known{std::make_shared<response const>(r)};
        return inflation_bounder(known, none, part)(detail::infinity);
    };
    auto const hidden = found();
    CHECK(std::abs(hidden.lower - 2) < 1e-9);
    CHECK((hidden.smear[0] > 1 && hidden.smear[1] > 1));
    r.bounds[1] = interval_traits<interval>::entire(); // nothing to gain there
    CHECK(found().smear == std::vector<double>{0, 0});
}
