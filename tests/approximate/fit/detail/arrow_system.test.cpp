// SPDX-License-Identifier: MIT
#include <sivid/approximate/fit/detail/arrow_system.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <Eigen/LU>

#include <utility>

using namespace sivid;
using support::draws;

TEST_CASE("block elimination solves the whole system, held variables and variances included") {
    draws d(871);
    for (int trial = 0; trial < 20; ++trial) {
        Eigen::Index const g = 1 + trial % 3;
        std::vector<Eigen::Index> const locals{2, 0, 3};
        arrow_system system;
        system.reset(g, locals);
        Eigen::Index const n = g + 5;
        Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(n, n);
        Eigen::VectorXd side = Eigen::VectorXd::Zero(n);
        Eigen::Index first = g;
        for (std::size_t e = 0; e < locals.size(); ++e) {
            auto const l = locals[e];
            Eigen::MatrixXd const a = d.matrix(g + l + 4, g + l);
            Eigen::VectorXd const b = d.matrix(g + l, 1);
            system.matrix(e).triangularView<Eigen::Lower>() = a.transpose() * a;
            system.side(e) = b;
            Eigen::MatrixXd place = Eigen::MatrixXd::Zero(n, g + l);
            place.topLeftCorner(g, g).setIdentity();
            place.block(first, g, l, l).setIdentity();
            whole += place * a.transpose() * a * place.transpose();
            side += place * b;
            first += l;
        }
        arrow_vector held;
        held.global = Eigen::VectorXd::Zero(g);
        held.local = {Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(0), Eigen::VectorXd::Zero(3)};
        arrow_vector x;
        REQUIRE(system.solve(0, held, x));
        Eigen::VectorXd found(n);
        found << x.global, x.local[0], x.local[2];
        CHECK((whole * found - side).norm() < 1e-6 * (1 + found.norm()));
        Eigen::MatrixXd const inverse = whole.inverse();
        CHECK(std::abs(system.local_inverse(0)(1, 1) / inverse(g + 1, g + 1) - 1) < 1e-4);
        CHECK(std::abs(system.local_inverse(2)(2, 2) / inverse(g + 4, g + 4) - 1) < 1e-4);
        held.local[0][1] = 1;
        held.global[0] = 1;
        REQUIRE(system.solve(0.1, held, x));
        CHECK(x.local[0][1] == 0);
        CHECK(x.global[0] == 0);
    }
}

TEST_CASE("in other units of its variables a system has the same solution in these") {
    draws d(872);
    Eigen::Index const g = 2, l = 3;
    Eigen::MatrixXd const a = d.matrix(12, g + l);
    Eigen::VectorXd const b = d.matrix(g + l, 1);
    auto const solved = [&](Eigen::VectorXd const& unit) {
        arrow_system system;
        system.reset(g, {l});
        Eigen::MatrixXd const scaled = a * unit.asDiagonal();
        system.matrix(0).triangularView<Eigen::Lower>() = scaled.transpose() * scaled;
        system.side(0) = unit.cwiseProduct(b);
        arrow_vector const held{Eigen::VectorXd::Zero(g), {Eigen::VectorXd::Zero(l)}};
        arrow_vector x;
        REQUIRE(system.solve(1e-3, held, x));
        Eigen::VectorXd all(g + l);
        all << x.global, x.local[0];
        Eigen::VectorXd const deviations =
            system.local_inverse(0).diagonal().cwiseSqrt().cwiseProduct(unit.tail(l));
        return std::pair(Eigen::VectorXd(unit.cwiseProduct(all)), deviations);
    };
    auto const [x, deviations] = solved(Eigen::VectorXd::Ones(g + l));
    for (double const size : {1e-12, 1e-6, 1e6, 1e12}) {
        Eigen::VectorXd unit = Eigen::VectorXd::Constant(g + l, size);
        unit[1] = 1 / size;
        unit[3] = 1;
        auto const [same, own] = solved(unit);
        CAPTURE(size);
        CHECK((same - x).norm() < 1e-9 * x.norm());
        CHECK((own - deviations).norm() < 1e-9 * deviations.norm());
    }
}

TEST_CASE("a variable of which nothing depends stays where it is") {
    arrow_system system;
    system.reset(2, {1});
    system.matrix(0)(0, 0) = 1e-9;
    system.side(0)[0] = 2e-9;
    arrow_vector const held{Eigen::VectorXd::Zero(2), {Eigen::VectorXd::Zero(1)}};
    arrow_vector x;
    REQUIRE(system.solve(0, held, x));
    CHECK_THAT(x.global[0], WithinRel(2.0, 1e-9));
    CHECK(x.global[1] == 0);
    CHECK(x.local[0][0] == 0);
}
