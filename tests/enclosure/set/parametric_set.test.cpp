// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/taylor_models.hpp"

#include <sivid/enclosure/set/parametric_set.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/number/pack/lanes.hpp>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::rational;

namespace {

template <std::size_t N, std::size_t D>
parametric_set<taylor_model<double>> random_set(draws& d, std::size_t n, std::size_t columns,
                                                bool degenerate) {
    parametric_set<taylor_model<double>> set;
    for (std::size_t i = 0; i < n; ++i) {
        set.centre.push_back(support::random_model<N, D>(d, 1, 1, 0));
        set.centre.back().r() = 0;
    }
    std::vector<double> const common = [&] {
        std::vector<double> v(n);
        for (auto& x : v) x = d.uniform(-1, 1);
        return v;
    }();
    for (std::size_t j = 0; j < columns; ++j) { // a few in each step
        if (j % 2 == 0) set.append(std::vector<double>(std::min<std::size_t>(2, columns - j), 1.0));
        auto& g = set.columns[j];
        g.clear();
        double const size = std::pow(10, -d.uniform(0, 6));
        for (std::size_t i = 0; i < n; ++i) {
            auto entry =
                support::random_model<N, (D + 1) / 2>(d, degenerate ? 1e-3 * size : size, 0.5, 0);
            if (degenerate) entry.c()[0] += size * common[i]; // nearly parallel columns
            if (d.below(6) == 0) entry = {};
            entry.r() = 0;
            entry.finish();
            g.push_back(entry);
        }
    }
    set.measure();
    return set;
}

/// \f$ \sum_j g_j(q) \xi_j \f$
template <class Set>
Eigen::VectorXd remainder(Set const& set, std::vector<double> const& q,
                          std::vector<double> const& xi) {
    auto const n = set.centre.size();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(n));
    for (std::size_t j = 0; j < set.columns.size(); ++j) {
        for (std::size_t i = 0; i < n; ++i) {
            x[static_cast<Eigen::Index>(i)] += support::value<double>(set.columns[j][i], q) * xi[j];
        }
    }
    return x;
}

std::vector<double> signs(draws& d, std::size_t n) {
    std::vector<double> xi(n);
    for (auto& x : xi) x = d.below(4) == 0 ? d.uniform(-1, 1) : d.coin() ? 1.0 : -1.0;
    return xi;
}

/// Whether `direction . x` for the member given is at most the support function of the set at q.
template <class Set>
bool supported(Set const& set, std::vector<double> const& q, Eigen::VectorXd const& direction,
               Eigen::VectorXd const& member) {
    double reach = 0;
    for (auto const& g : set.columns) {
        double along = 0;
        for (std::size_t i = 0; i < g.size(); ++i) {
            along += direction[static_cast<Eigen::Index>(i)] * support::value<double>(g[i], q);
        }
        reach += std::abs(along);
    }
    double const height = direction.dot(member);
    return height <= reach + 1e-13 * (std::abs(height) + reach); // 1e-13: the test's own rounding
}

} // namespace

TEST_CASE("unknowns: sides with a width get a variable, the others a rest") {
    box const x0{between(1, 1), between(1, 2)};
    box const p{between(3, 3), between(-1, 1), hull(0.1_dec, 0.1_dec)};
    normalised_unknowns const u(x0, p);
    REQUIRE(u.variables == 2);
    REQUIRE(u.parameters[1].variable == 0);
    REQUIRE(u.initial[1].variable == 1);
    REQUIRE(u.parameters[2].radius == 0);
    REQUIRE(u.parameters[2].rest > 0);
    // each side is contained in centre + radius * [-1, 1] + rest, exactly
    draws d(1);
    for (int trial = 0; trial < 300; ++trial) {
        double const size = std::pow(10, d.uniform(-300, 300));
        auto const side = d.interval(-size, size, d.coin() ? size : size * 1e-15);
        normalised_unknowns const one({side}, {});
        auto const& s = one.initial[0];
        rational const reach = rational(s.radius) + rational(s.rest);
        REQUIRE(rational(s.centre) - reach <= rational(side.lower()));
        REQUIRE(rational(side.upper()) <= rational(s.centre) + reach);
        parametric_set<taylor_model<double>> set(1, model_shape<double>::of(1, 2));
        set.begin(0, 0, one);
        REQUIRE(subset(side, set.hull()[0]));
        REQUIRE(set.centre[0].r() == 0);
    }
}

TEST_CASE("the first family of lanes that stand idle is that of all of them") {
    using side_by_side = lane_traits<lanes<8>>;
    normalised_unknowns const first({between(1, 2), between(3, 3)}, {});
    normalised_unknowns const second({between(5, 7), between(4, 4)}, {});
    parametric_set<taylor_model<lanes<8>>> set(2, model_shape<lanes<8>>::of(1, 2));
    set.begin(2, 0.5, first, true);
    set.begin(4, 0.25, second);
    for (std::size_t l = 0; l < 8; ++l) {
        auto const hull = set.hull(l);
        CAPTURE(l);
        CHECK(subset(l == 4 ? between(5, 7) : between(1, 2), hull[0]));
        CHECK(width(hull[0]) < (l == 4 ? 2 : 1) + 1e-9);
        CHECK(subset(l == 4 ? between(4, 4) : between(3, 3), hull[1]));
        CHECK(side_by_side::get(set.time, l) == (l == 4 ? 0.25 : 0.5));
    }
}

TEST_CASE("append adds a box, and nothing is dropped that is not a number") {
    parametric_set<taylor_model<double>> set;
    set.centre.resize(3);
    set.append({0.5, 0.0, 0.25});
    set.measure();
    REQUIRE(set.columns.size() == 2);
    REQUIRE(set.reach[0] >= 0.5);
    REQUIRE(set.reach[1] == 0);
    REQUIRE(set.reach[2] >= 0.25);
    set.append({0, std::nan(""), 0});
    set.measure();
    REQUIRE_FALSE(std::isfinite(set.reach[1]));
    REQUIRE(width(set.hull()[1]) == std::numeric_limits<double>::infinity());
}

TEST_CASE("the reach and the hull contain all members") {
    draws d(2);
    for (int trial = 0; trial < 30; ++trial) {
        auto const set = random_set<2, 3>(d, 3, 12, d.coin());
        auto const hull = set.hull();
        for (int sample = 0; sample < 60; ++sample) {
            auto const q = support::short_point(d, 2);
            auto const xi = signs(d, set.columns.size());
            for (std::size_t i = 0; i < 3; ++i) {
                rational x = 0;
                for (std::size_t j = 0; j < set.columns.size(); ++j) {
                    x += support::value<rational>(set.columns[j][i], q) * rational(xi[j]);
                }
                REQUIRE(abs(x) <= rational(set.reach[i]));
                x += support::value<rational>(set.centre[i], q);
                REQUIRE(rational(hull[i].lower()) <= x);
                REQUIRE(x <= rational(hull[i].upper()));
            }
        }
    }
}

TEST_CASE("reduce keeps every member") {
    draws d(3);
    for (int trial = 0; trial < 24; ++trial) {
        std::size_t const n = 2 + d.below(3);
        auto const before = random_set<2, 3>(d, n, 10 * n + 1 + d.below(20), trial % 2 == 0);
        auto after = before;
        std::size_t const most = d.coin() ? 10 * n : 2 * n;
        std::vector<double> lost(n, 0.0);
        after.reduce(most, lost);
        REQUIRE(after.columns.size() <= std::max(most, n));
        after.append(lost);
        for (int sample = 0; sample < 60; ++sample) {
            auto const q = support::short_point(d, 2);
            // The farthest member in a direction, and random ones.
            Eigen::VectorXd direction(static_cast<Eigen::Index>(n));
            for (auto& x : direction) x = d.uniform(-1, 1);
            auto xi = signs(d, before.columns.size());
            if (d.coin()) {
                for (std::size_t j = 0; j < xi.size(); ++j) {
                    double along = 0;
                    for (std::size_t i = 0; i < n; ++i) {
                        along += direction[static_cast<Eigen::Index>(i)] *
                                 support::value<double>(before.columns[j][i], q);
                    }
                    xi[j] = along < 0 ? -1 : 1;
                }
            }
            CAPTURE(trial, n, sample);
            REQUIRE(supported(after, q, direction, remainder(before, q, xi)));
        }
    }
}

TEST_CASE("reduce: the argument, step by step") {
    // All columns of the reduced set that are new are constant: the frame's axes times sides, and
    // the axes' box. Exactly: Q^-1 (sum of the dropped columns) lies within the sides.
    draws d(4);
    for (int trial = 0; trial < 10; ++trial) {
        std::size_t const n = 3;
        auto const before = random_set<1, 2>(d, n, 12, trial % 2 == 0);
        auto after = before;
        std::vector<double> lost(n, 0.0);
        after.reduce(0, lost); // everything is boxed, up to the longest
        Eigen::MatrixXd frame(3, 3);
        for (Eigen::Index j = 0; j < 3; ++j) {
            for (Eigen::Index i = 0; i < 3; ++i) {
                auto const& entry =
                    after.columns[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
                for (std::size_t k = 1; k < entry.terms(); ++k) REQUIRE(entry.c()[k] == 0);
                frame(i, j) = entry.c()[0];
            }
        }
        Eigen::MatrixXd const inverse = frame.inverse();
        for (int sample = 0; sample < 50; ++sample) {
            auto const q = support::short_point(d, 1);
            Eigen::VectorXd const xi =
                inverse * remainder(before, q, signs(d, before.columns.size()));
            REQUIRE(xi.lpNorm<Eigen::Infinity>() <= 1 + 1e-12);
        }
    }
}

TEST_CASE("reduce does not lose a column that is not finite") {
    draws d(5);
    for (double const bad : {HUGE_VAL, std::nan("")}) {
        auto set = random_set<1, 2>(d, 2, 30, false);
        for (auto& c : set.columns[17][1].coefficients()) c = bad;
        set.columns[17][1].finish();
        std::vector<double> lost(2, 0.0);
        set.reduce(10, lost);
        REQUIRE(set.columns.size() <= 10);
        set.measure();
        REQUIRE_FALSE(std::isfinite(set.reach[0] + set.reach[1]));
        auto const hull = set.hull();
        REQUIRE_FALSE(is_empty(hull[1]));
        REQUIRE(width(hull[1]) == HUGE_VAL);
    }
}

TEST_CASE("what thousands of steps lose is not boxed thousands of times") {
    // A heading that drifts, and a place that drifts with it and turns slowly: each step adds a box.
    std::size_t const n = 3;
    double const turned = 0.002, h = 0.15;
    Eigen::Matrix3d step;
    step << std::cos(turned), -std::sin(turned), 0, std::sin(turned), std::cos(turned), h, 0, 0, 1;
    Eigen::Vector3d const added(1e-4, 1e-4, 1e-3);
    Eigen::Vector3d exact = Eigen::Vector3d::Zero();
    parametric_set<taylor_model<double>> set(n);
    Eigen::Matrix3d power = Eigen::Matrix3d::Identity();
    for (int k = 0; k < 3000; ++k) {
        exact += power.cwiseAbs() * added;
        power *= step;
        for (auto& g : set.columns) {
            Eigen::Vector3d const now = step * Eigen::Vector3d(g[0].c(0), g[1].c(0), g[2].c(0));
            for (std::size_t i = 0; i < n; ++i) {
                g[i] = taylor_model<double>::constant(now[static_cast<Eigen::Index>(i)]);
            }
        }
        std::vector<double> lost{added[0], added[1], added[2]};
        set.reduce(13 * n, lost);
        set.append(lost);
        set.measure();
    }
    CHECK(set.columns.size() <= 14 * n);
    for (std::size_t i = 0; i < n; ++i) {
        CAPTURE(i, set.reach[i], exact[static_cast<Eigen::Index>(i)]);
        CHECK(set.reach[i] >= exact[static_cast<Eigen::Index>(i)] * (1 - 1e-9));
        CHECK(set.reach[i] <= exact[static_cast<Eigen::Index>(i)] * 2);
    }
}
