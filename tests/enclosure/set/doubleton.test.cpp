// SPDX-License-Identifier: MIT
// The carried set under random affine maps: members stay members, in 100 digits.
#include <sivid/enclosure/set/doubleton.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/power_series.hpp"
#include "support/random.hpp"

#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::mp;

namespace {

using traits = interval_traits<interval>;
using index = Eigen::Index;

mp at(std::vector<std::vector<mp>> const& inverse, std::vector<mp> const& v, std::size_t i) {
    mp sum = 0;
    for (std::size_t k = 0; k < v.size(); ++k) sum += inverse[i][k] * v[k];
    return sum;
}
/// The inverse of a 2 x 2 matrix of doubles.
std::vector<std::vector<mp>> inverse(Eigen::MatrixXd const& b) {
    mp const det = mp(b(0, 0)) * mp(b(1, 1)) - mp(b(0, 1)) * mp(b(1, 0));
    return {{mp(b(1, 1)) / det, -mp(b(0, 1)) / det}, {-mp(b(1, 0)) / det, mp(b(0, 0)) / det}};
}
/// Whether x = m + C r0 + B r with some r in the remainder, and x in the hull.
bool member(doubleton<interval> const& set, std::vector<mp> const& x, std::vector<mp> const& r0) {
    std::vector<mp> rest(2);
    for (std::size_t i = 0; i < 2; ++i) {
        rest[i] = x[i] - mp(set.centre[i]);
        for (std::size_t c = 0; c < r0.size(); ++c) {
            rest[i] -= mp(set.shape(static_cast<index>(i), static_cast<index>(c))) * r0[c];
        }
    }
    auto const inv = inverse(set.axes);
    for (std::size_t i = 0; i < 2; ++i) {
        if (!support::encloses(set.remainder[i], at(inv, rest, i), 1e-40)) return false;
        if (!support::encloses(set.hull[i], x[i], 1e-40)) return false;
    }
    return true;
}

} // namespace

TEST_CASE("members stay members under random affine maps with uncertain matrices") {
    draws d(241);
    for (int round = 0; round < 150; ++round) {
        box const initial{d.interval(-1, 1, 0.2), d.interval(-1, 1, 0.2)};
        box const p{d.interval(-1, 1, 0.3)};
        ensemble<interval> const e(initial, p);
        auto set = doubleton<interval>::start(0, initial, 1);
        struct tracked {
            std::vector<mp> x, r0;
            mp q;
        };
        std::vector<tracked> all;
        for (int k = 0; k < 6; ++k) {
            auto const x0 = d.in(initial);
            auto const p0 = d.in(p);
            tracked t{{x0[0], x0[1]}, {}, mp(p0[0]) - mp(e.parameter_centre[0])};
            auto const m = mid(initial);
            for (std::size_t i = 0; i < 2; ++i) t.r0.push_back(mp(x0[i]) - mp(m[i]));
            t.r0.push_back(t.q);
            all.push_back(t);
            CHECK(member(set, t.x, t.r0));
        }
        for (int step = 0; step < 8; ++step) {
            // F(x, p) = a + Jx (x - m) + Jp (p - centre) with each member's own J from the box.
            interval_matrix<interval> j(2, 3);
            for (std::size_t i = 0; i < 2; ++i) {
                for (std::size_t c = 0; c < 3; ++c) {
                    j(i, c) = d.interval(-1, 1, d.coin() ? 0.05 : 0);
                    if (d.below(8) == 0) j(i, c) = interval(0.0); // singular maps too
                }
            }
            box const image{d.interval(-1, 1, 0.01), d.interval(-1, 1, 0.01)};
            box direct{traits::empty(), traits::empty()};
            for (auto& t : all) {
                std::vector<mp> next(2);
                for (std::size_t i = 0; i < 2; ++i) {
                    next[i] = d.in(image[i]);
                    for (std::size_t c = 0; c < 2; ++c) {
                        next[i] += mp(d.in(j(i, c))) * (t.x[c] - mp(set.centre[c]));
                    }
                    next[i] += mp(d.in(j(i, 2))) * t.q;
                    auto const value = static_cast<double>(next[i]);
                    direct[i] = traits::hull(direct[i], support::around(value, 1e-12));
                }
                t.x = next;
            }
            // Sometimes the direct box cuts hard, so that the centre has to move into it.
            if (d.coin()) direct = box{between(-9, 9), between(-9, 9)};
            set = set.mapped(step + 1, image, j, direct, e.deviation);
            CHECK(set.time == step + 1);
            CHECK(contains(set.hull, set.centre));
            for (auto const& t : all) CHECK(member(set, t.x, t.r0));
        }
    }
}

TEST_CASE("the dependence on parameters and initial state survives rotations") {
    // A quarter turn in 100 steps leaves a box of side 2 at width 2, not at 2 * sqrt(2)^100.
    box const initial{between(-1, 1), between(-1, 1)};
    ensemble<interval> const e(initial, box{});
    auto set = doubleton<interval>::start(0, initial, 0);
    double const c = 0.99987663248166; // cos(pi/200)
    double const s = 0.01570731731182;
    interval_matrix<interval> j(2, 2);
    j(0, 0) = interval(c);
    j(0, 1) = interval(-s);
    j(1, 0) = interval(s);
    j(1, 1) = interval(c);
    for (int k = 0; k < 100; ++k) {
        set = set.mapped(k + 1, box{interval(0.0), interval(0.0)}, j,
                         box{between(-9, 9), between(-9, 9)}, e.deviation);
    }
    CHECK(width(set.hull) < 2 + 1e-9);
    CHECK(width(set.remainder) < 1e-12);
}

TEST_CASE("contradictory enclosures are an error of the library, and said to be one") {
    box const initial{between(-1, 1)};
    ensemble<interval> const e(initial, box{});
    auto const set = doubleton<interval>::start(0, initial, 0);
    CHECK_THROWS_AS(set.mapped(1, box{interval(0.0)}, interval_matrix<interval>::identity(1),
                               box{between(5, 6)}, e.deviation),
                    std::logic_error);
}
