// SPDX-License-Identifier: MIT
#include <sivid/paving/identify.hpp>
#include <sivid/paving/judge/detail/core_box.hpp>

#include "support/catch.hpp"
#include "support/problems.hpp"
#include "support/random_response.hpp"
#include "support/some_start.hpp"
#include "support/sweep.hpp"

#include <cstddef>
#include <memory>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::rational;

namespace {

/// A chain of three tanks with seven constants, measured everywhere.
support::planted_problem chain(draws& d, support::planting const& how) {
    box prior(7);
    for (std::size_t j = 0; j < 7; ++j) prior[j] = between(0.5, 1.5);
    return support::plant(
        d, {3, 7, 0, 30},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] - p[1] * x[0], p[2] * x[0] - p[3] * x[1] + p[4] * x[2],
                               p[5] * x[1] - p[6] * x[2] * x[2]};
        },
        prior, {0.4, 1, 0.7}, how);
}

} // namespace

TEST_CASE("all members of a core hold by exact arithmetic, outliers included") {
    draws d(31);
    std::size_t proved = 0, grown = 0;
    for (int trial = 0; trial < support::swept(60, 200); ++trial) {
        std::size_t const outputs = 4 + d.below(6);
        support::random_response<3, 3> x(d, box{between(1, 1)},
                                         box{between(-1, 1), between(3, 3.1), between(0, 4)},
                                         outputs, d.coin() ? 0.02 : 0.3, 0.01);
        x.known.allowed = d.below(2);
        auto const normalised = [&](std::vector<double> const& p) {
            std::vector<rational> q(3);
            for (std::size_t j = 0; j < 3; ++j) {
                auto const& s = x.known.unknowns.parameters[j];
                q[s.variable] = (rational(p[j]) - rational(s.centre)) / rational(s.radius);
            }
            return q;
        };
        auto const point = d.in(x.prior);
        double const e = d.uniform(0.05, 0.3);
        for (std::size_t y = 0; y < outputs; ++y) {
            double const off = y < x.known.allowed ? 3 : d.uniform(-0.8, 0.8) * e;
            double const at = static_cast<double>(x.value(y, normalised(point))) + off;
            x.known.bounds.push_back(between(at - e, at + e));
        }
        response_list const all{std::make_shared<response const>(x.known)};
        core_search search(all, x.prior, point);
        auto core = search.scaled();
        if (!core) continue;
        ++proved;
        auto const first = *core;
        core = search.grown();
        CHECK(subset(first, *core));
        REQUIRE(subset(*core, x.prior));
        CHECK(contains(*core, point));
        bool wider = false;
        for (int member = 0; member < 20; ++member) {
            std::vector<double> p;
            for (auto const& side : *core) {
                p.push_back(member < 8 ? (d.coin() ? side.lower() : side.upper()) : d.in(side));
            }
            std::size_t held = 0;
            for (std::size_t y = 0; y < outputs; ++y) {
                auto const exact = x.value(y, normalised(p));
                rational const r(x.known.radius[y]);
                bool const holds = rational(x.known.bounds[y].lower()) <= exact - r &&
                                   exact + r <= rational(x.known.bounds[y].upper());
                held += holds ? 1 : 0;
                // Some margin is used, so a core that is too large would be noticed.
                wider = wider || (holds && abs(exact - rational(mid(x.known.bounds[y]))) >
                                               rational(0.8) * rational(e));
            }
            CHECK(held + x.known.allowed >= outputs);
        }
        grown += wider ? 1 : 0;
    }
    INFO(proved << " found, " << grown << " of them use up a margin");
    CHECK(proved > support::swept(std::size_t{40}, std::size_t{150}));
    CHECK(grown > proved / 2);
}

TEST_CASE("a point that fails has no core") {
    draws d(32);
    support::random_response<2, 2> x(d, box{}, box{between(0, 1), between(0, 1)}, 2, 0.1, 0.0);
    x.known.bounds = {between(10, 11), between(10, 11)};
    response_list const all{std::make_shared<response const>(x.known)};
    CHECK_FALSE(core_search(all, x.prior, {0.5, 0.5}).scaled());
    CHECK_FALSE(explained_by_responses(all, x.prior));
}

TEST_CASE("with seven unknowns a box is proved inside, and all of it explains the data") {
    draws d(33);
    for (double const spread : {0.0, 0.01}) {
        support::planting how;
        how.experiments = 2;
        how.samples = 12;
        how.noise = 0.05;
        how.spread = spread;
        how.outliers = spread > 0 ? 0 : 1;
        auto const planted = chain(d, how);
        identify_options options;
        options.search.boxes = 300;
        options.search.seconds = 60;
        auto const found = identify(planted.problem, options);
        CAPTURE(spread, found.boxes, found.integrations);
        CHECK(found.verdict == verdict::consistent);
        CHECK(found.paving.inner_volume().lower() > 0);
        CHECK(contains(found.hull, planted.truth));
        REQUIRE(found.guess);
        std::size_t inside = 0;
        for (auto const& b : found.paving.boxes()) {
            if (b.verdict != box_verdict::inside) continue;
            ++inside;
            for (int member = 0; member < 10; ++member) {
                std::vector<double> p;
                for (auto const& side : b.set) {
                    p.push_back(member < 5 ? (d.coin() ? side.lower() : side.upper()) : d.in(side));
                }
                for (std::size_t e = 0; e < planted.starts.size(); ++e) {
                    CHECK(support::some_start_explains(planted, e, p, {found.guess->starts[e]},
                                                       1e-10));
                }
            }
        }
        CHECK(inside > 0);
        // What was cut about the core is still there: a random point is paved, or was excluded.
        for (auto const& p : {found.witness->parameters, planted.truth}) {
            bool covered = false;
            for (auto const& b : found.paving.boxes()) {
                covered = covered || (b.verdict != box_verdict::outside && contains(b.set, p));
            }
            CHECK(covered);
        }
    }
}
