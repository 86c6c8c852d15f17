// SPDX-License-Identifier: MIT
#include <sivid/approximate/fit/detail/arrow_system.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <Eigen/LU>

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
