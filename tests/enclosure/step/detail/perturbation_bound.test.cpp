// SPDX-License-Identifier: MIT
#include <sivid/enclosure/step/perturbed_step.hpp>

#include "support/catch.hpp"
#include "support/matrix_exponential.hpp"
#include "support/random.hpp"

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

using namespace sivid;
using support::draws;
using support::mp;

namespace {

struct problem {
    std::size_t n = 1;
    std::vector<double> m, begin, end;
    double h = 1;
};

/// D(h) in 100 digits, by one exponential in the variables (D, s/h, 1).
std::vector<mp> exact(problem const& p) {
    auto const n = static_cast<Eigen::Index>(p.n);
    // Time runs in units of h, a power of two: the products are exact.
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + 2, n + 2);
    for (Eigen::Index i = 0; i < n; ++i) {
        auto const row = static_cast<std::size_t>(i);
        for (Eigen::Index j = 0; j < n; ++j) {
            a(i, j) = p.h * p.m[row * p.n + static_cast<std::size_t>(j)];
        }
        a(i, n) = p.h * (p.end[row] - p.begin[row]);
        a(i, n + 1) = p.h * p.begin[row];
    }
    a(n, n + 1) = 1;
    auto const e = support::exact_exponential(a, mp(1));
    std::vector<mp> result;
    for (std::size_t i = 0; i < p.n; ++i) result.push_back(e[i][p.n + 1]);
    return result;
}

/// Few bits, so that differences are exact.
double rough(draws& d, double lo, double hi) {
    return std::ldexp(std::round(std::ldexp(d.uniform(lo, hi), 20)), -20);
}

problem draw(draws& d, double stiffness) {
    problem p;
    p.n = 1 + d.below(5);
    p.h = std::ldexp(1.0, -static_cast<int>(d.below(8)));
    for (std::size_t i = 0; i < p.n; ++i) {
        for (std::size_t j = 0; j < p.n; ++j) {
            bool const none = d.below(3) == 0;
            p.m.push_back(i == j ? rough(d, -stiffness, 2) : none ? 0 : rough(d, 0, 2));
        }
        p.begin.push_back(d.below(4) == 0 ? 0 : rough(d, 0, 1));
        p.end.push_back(d.coin() ? p.begin.back() : rough(d, 0, 1));
    }
    return p;
}

void check(problem const& p, std::vector<double> const& bound) {
    auto const d = exact(p);
    double largest = 0;
    for (auto const& x : d) largest = std::max(largest, x.convert_to<double>());
    for (std::size_t i = 0; i < p.n; ++i) {
        CAPTURE(i, p.n, p.h);
        REQUIRE(mp(bound[i]) >= d[i]);
        REQUIRE(mp(bound[i]) <= d[i] + 1e-8 * mp(largest) + 1e-280);
    }
}

} // namespace

TEST_CASE("x' = -x + w: at most 1 - exp(-h), however long the step") {
    for (double const h : {1e-6, 0.01, 1.0, 30.0, 2000.0}) {
        auto const d = bound_perturbation<double>({-1}, {0.5}, {0.5}, h);
        CAPTURE(h);
        CHECK(d[0] >= -0.5 * std::expm1(-h));
        CHECK(d[0] <= -0.5 * std::expm1(-h) * (1 + 1e-8));
    }
}

TEST_CASE("bounds of random problems against 100 digits") {
    draws d(7);
    for (int round = 0; round < 400; ++round) {
        auto const p = draw(d, round % 4 == 0 ? 200 : 4);
        CAPTURE(round);
        check(p, bound_perturbation(p.m, p.begin, p.end, p.h));
    }
}

TEST_CASE("problems side by side are those one by one") {
    using C = lanes<8>;
    draws d(8);
    for (int round = 0; round < 20; ++round) {
        std::vector<problem> all;
        while (all.size() < 8) {
            auto p = draw(d, all.size() % 2 == 0 ? 3 : 80);
            if (p.n == 3) all.push_back(p);
        }
        std::vector<C> m(9), begin(3), end(3);
        C h;
        for (std::size_t l = 0; l < 8; ++l) {
            for (std::size_t k = 0; k < 9; ++k) m[k].set(l, all[l].m[k]);
            for (std::size_t k = 0; k < 3; ++k) {
                begin[k].set(l, all[l].begin[k]);
                end[k].set(l, all[l].end[k]);
            }
            h.set(l, all[l].h);
        }
        // One of them says nothing, and must not disturb the others.
        m[4].set(5, std::numeric_limits<double>::quiet_NaN());
        auto const bound = bound_perturbation(m, begin, end, h);
        for (std::size_t l = 0; l < 8; ++l) {
            std::vector<double> own;
            for (auto const& x : bound) own.push_back(x[l]);
            if (l == 5) {
                for (double const x : own) CHECK(x == std::numeric_limits<double>::infinity());
            } else {
                check(all[l], own);
            }
        }
    }
}

TEST_CASE("what is not finite or far too long is not bounded") {
    double const infinity = std::numeric_limits<double>::infinity();
    double const nan = std::numeric_limits<double>::quiet_NaN();
    for (double const bad : {infinity, nan}) {
        CHECK(bound_perturbation<double>({bad}, {1}, {1}, 1.0)[0] == infinity);
        CHECK(bound_perturbation<double>({-1}, {bad}, {1}, 1.0)[0] == infinity);
        CHECK(bound_perturbation<double>({-1}, {1}, {bad}, 1.0)[0] == infinity);
        CHECK(bound_perturbation<double>({-1}, {1}, {1}, bad)[0] == infinity);
    }
    CHECK(bound_perturbation<double>({-5000}, {1}, {1}, 1.0)[0] == infinity);
    CHECK(bound_perturbation<double>({1000}, {1}, {1}, 1.0)[0] == infinity); // e^1000
    // Nothing pushes: nothing moves.
    CHECK(bound_perturbation<double>({3}, {0}, {0}, 1.0)[0] < 1e-280);
}

TEST_CASE("bounds from a middle matrix hold, and oscillations cancel in them") {
    draws d(9);
    for (int round = 0; round < 100; ++round) {
        auto p = draw(d, 3);
        // Signs off the diagonal: then the exact reach is that of the modulus of the exponential,
        // at least what W does in one constant direction.
        for (std::size_t k = 0; k < p.m.size(); ++k) {
            if (d.coin()) p.m[k] = -p.m[k];
        }
        auto const bound = bound_linear_perturbation(p.m, p.begin, p.end, p.h);
        auto const one = exact(p);
        for (std::size_t i = 0; i < p.n; ++i) {
            CAPTURE(round, i);
            REQUIRE(mp(bound[i]) >= abs(one[i]));
        }
    }
    // x'' = -25 x + w over one period: |x| <= w/5 int |sin 5s| ds = 4 w/25.
    double const turn = 2 * 3.141592653589793 / 5;
    auto const bound = bound_linear_perturbation<double>({0, 1, -25, 0}, {0, 1}, {0, 1}, turn / 4);
    CHECK(bound[0] >= 1.0 / 25);
    CHECK(bound[0] <= 1.08 / 25);
    double const infinity = std::numeric_limits<double>::infinity();
    CHECK(bound_linear_perturbation<double>({infinity}, {1}, {1}, 1.0)[0] == infinity);
    CHECK(bound_linear_perturbation<double>({1}, {infinity}, {1}, 1.0)[0] == infinity);
    CHECK(bound_linear_perturbation<double>({40}, {1}, {1}, 1.0)[0] == infinity);
}
