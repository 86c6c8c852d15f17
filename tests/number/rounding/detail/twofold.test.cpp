// SPDX-License-Identifier: MIT
// Numbers of twice the digits against exact rationals, in every rounding mode.
#include "support/catch.hpp"
#include "support/rounding_modes.hpp"
#include "support/taylor_models.hpp"

#include <sivid/number/rounding/detail/twofold.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace sivid;
using support::draws;
using support::rational;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

rational middle(twofold const& a) { return rational(a.head()) + rational(a.tail()); }

/// |x - middle| as a share of the radius; 2 where x is outside.
double used(twofold const& a, rational const& x) {
    if (!std::isfinite(a.radius())) return 0;
    rational const off = abs(x - middle(a));
    if (off > rational(a.radius())) return 2;
    return a.radius() > 0 ? static_cast<double>(rational(off / rational(a.radius()))) : 0;
}

/// Any number, its tail at most a unit of its head, often with few digits.
twofold draw(draws& d, double size, double radius) {
    // Just above a power of two roundings are largest.
    double const shape =
        d.coin() ? d.uniform(-1, 1) : std::copysign(1 + d.uniform(0, 0x1p-9), d.uniform(-1, 1));
    double const head = shape * size;
    double tail = head * d.uniform(-1.5, 1.5) * twofold::unit;
    if (d.below(4) == 0) tail = 0;
    return twofold(d.below(6) == 0 ? std::trunc(8 * head) : head, tail, radius * std::abs(head));
}
/// A member, at one of the ends as a rule.
rational member(draws& d, twofold const& a) {
    return middle(a) + rational(a.radius()) * (static_cast<int>(d.below(3)) - 1);
}

double magnitude(draws& d, bool wild) {
    constexpr double sizes[] = {1, 1e-3, 1e-150, 1e-160, 1e-290, 1e-310, 1e150, 1e290};
    return wild ? sizes[d.below(8)] : std::pow(2.0, static_cast<double>(d.below(20)) - 10);
}

void check(std::uint64_t seed, bool wild, double radius) {
    draws d(seed);
    double most[4] = {0, 0, 0, 0};
    for (int trial = 0; trial < 6000; ++trial) {
        auto const a = draw(d, magnitude(d, wild), d.coin() ? radius : 0);
        auto const b = d.below(5) == 0 ? twofold(-a.head(), d.coin() ? 0 : a.tail(), a.radius())
                                       : draw(d, magnitude(d, wild), d.coin() ? radius : 0);
        // The digits themselves, for what the operations alone lose.
        auto const x = radius > 0 ? member(d, a) : middle(a);
        auto const y = radius > 0 ? member(d, b) : middle(b);
        for (int const mode : support::rounding_modes) {
            twofold sum, difference, times, over, root;
            bool undefined = false, cut = false;
            support::in_mode(mode, [&] {
                sum = a + b;
                difference = a - b;
                times = a * b;
                over = quotient(a, b, undefined);
                root = sqrt(a.head() < 0 ? -a : a, cut);
            });
            CAPTURE(trial, mode, a.head(), a.tail(), a.radius(), b.head(), b.tail(), b.radius());
            double const shares[3] = {used(sum, x + y), used(difference, x - y),
                                      used(times, x * y)};
            for (int k = 0; k < 3; ++k) {
                REQUIRE(shares[k] <= 1);
                most[k] = std::max(most[k], shares[k]);
            }
            REQUIRE((!undefined || !std::isfinite(over.radius())));
            if (!undefined && y != 0) {
                double const share = used(over, x / y);
                REQUIRE(share <= 1);
                most[3] = std::max(most[3], share);
            }
            if (!cut && std::isfinite(root.radius())) {
                rational const z = a.head() < 0 ? rational(-x) : x;
                rational const low = middle(root) - rational(root.radius());
                rational const high = middle(root) + rational(root.radius());
                REQUIRE(z <= high * high);
                REQUIRE((low <= 0 || low * low <= z));
            }
            for (auto const& c : {sum, difference, times, over, root}) {
                REQUIRE((!std::isfinite(c.radius()) || std::isfinite(c.head() + c.tail())));
                REQUIRE(std::abs(c.tail()) <=
                        twofold::unit * (1 + 4 * twofold::unit) * std::abs(c.head()) + 5e-324);
            }
            if (wild || radius > 0) continue;
            // Nothing is lost but the last digits.
            double const u2 = twofold::unit * twofold::unit;
            double const size = std::abs(a.head()) + std::abs(b.head());
            REQUIRE(sum.radius() <= 13 * u2 * size + 1e-285);
            REQUIRE(times.radius() <= 20 * u2 * std::abs(a.head() * b.head()) + 1e-285);
            if (a.head() == 0) continue; // nothing is left but `tiny`
            if (!undefined) {
                REQUIRE(over.radius() <= 60 * u2 * std::abs(a.head() / b.head()) + 1e-285);
            }
            REQUIRE(root.radius() <= 60 * u2 * std::sqrt(std::abs(a.head())) + 1e-285);
        }
    }
    if (wild || radius > 0) return;
    // The bounds, radii of the operands included, are met up to a factor: with a fourteenth of the
    // constants some of these results would be wrong.
    CAPTURE(most[0], most[1], most[2], most[3]);
    REQUIRE(std::max(most[0], most[1]) > 0.09);
    REQUIRE(most[2] > 0.075);
}

} // namespace

TEST_CASE("twice the digits: operations on points, every rounding mode") { check(31, false, 0); }
TEST_CASE("twice the digits: radii are carried") { check(32, false, 1e-20); }
TEST_CASE("twice the digits: subnormal to overflow") {
    check(33, true, 0);
    check(34, true, 1e-3);
}

TEST_CASE("twice the digits: three numbers made one") {
    draws d(35);
    for (int trial = 0; trial < 4000; ++trial) {
        double const head = d.uniform(-1, 1),
                     tail = d.uniform(-1, 1) * std::pow(10, d.uniform(-20, 2));
        for (int const mode : support::rounding_modes) {
            twofold a;
            support::in_mode(mode, [&] { a = twofold(head, tail, 0); });
            CAPTURE(trial, mode);
            REQUIRE(used(a, rational(head) + rational(tail)) <= 1);
            REQUIRE(rational(a.bounds().upper()) >= middle(a) + rational(a.radius()));
            REQUIRE(rational(a.bounds().lower()) <= middle(a) - rational(a.radius()));
            REQUIRE(rational(a.size()) >= abs(middle(a)) + rational(a.radius()));
            REQUIRE(rational(a.least()) <= abs(middle(a)));
        }
    }
}

TEST_CASE("twice the digits: what is not known") {
    bool undefined = false;
    REQUIRE(!std::isfinite(quotient(twofold(1.0), twofold(0.0), undefined).radius()));
    REQUIRE(undefined);
    undefined = false;
    REQUIRE(!std::isfinite(quotient(twofold(1.0), twofold(1.0, 0.0, 1.5), undefined).radius()));
    REQUIRE(undefined);
    undefined = false;
    (void)sqrt(twofold(-1.0), undefined);
    REQUIRE(undefined);
    REQUIRE(!std::isfinite(twofold(infinity).radius()));
    REQUIRE(!std::isfinite(twofold(std::nan("")).radius()));
    REQUIRE(!std::isfinite(twofold(1.0, std::nan(""), 0.0).radius()));
    REQUIRE(!std::isfinite((twofold(1e200) * twofold(1e200)).radius()));
    REQUIRE(!std::isfinite((twofold(interval_traits<interval>::empty()) + twofold(1.0)).radius()));
    twofold const third(interval(1.0, 2.0));
    REQUIRE(contains(third.bounds(), 1.0));
    REQUIRE(contains(third.bounds(), 2.0));
}
