// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/taylor_models.hpp"

#include <sivid/number/pack/lanes.hpp>
#include <sivid/number/polynomial/detail/bernstein.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::draws;
using support::random_model;
using support::rational;
using support::sized_model;

namespace {

bool contains_exactly(interval const& x, rational const& v) {
    return rational(x.lower()) <= v && v <= rational(x.upper());
}

template <std::size_t N, std::size_t D>
void check_samples(std::uint64_t seed, int trials) {
    draws d(seed);
    for (int trial = 0; trial < trials; ++trial) {
        auto const a = random_model<N, D>(d, 1, 1, 0.1);
        auto const values = range(a);
        REQUIRE(subset(values, rough_range(a)));
        for (int sample = 0; sample < 60; ++sample) {
            auto const q = support::short_point(d, N);
            CAPTURE(N, D, trial, sample);
            REQUIRE(contains_exactly(values, support::member<rational>(d, a, q)));
        }
    }
}

} // namespace

TEST_CASE("the Bernstein basis: coefficients of powers by exact conversion") {
    // sum_k m[e * (degree + 1) + k] binomial(D,k) s^k (1-s)^(D-k) is (2s-1)^e: compared at D+1
    // points.
    constexpr std::size_t degree = 5;
    auto const* const m = number_detail::bernstein_of_powers(degree);
    for (std::size_t e = 0; e <= degree; ++e) {
        for (std::size_t point = 0; point <= degree; ++point) {
            double const s = static_cast<double>(point) / degree;
            double sum = 0;
            for (std::size_t k = 0; k <= degree; ++k) {
                REQUIRE(std::abs(m[e * (degree + 1) + k]) <= 1);
                sum += m[e * (degree + 1) + k] * static_cast<double>(binomial(degree, k)) *
                       std::pow(s, static_cast<double>(k)) *
                       std::pow(1 - s, static_cast<double>(degree - k));
            }
            REQUIRE(std::abs(sum - std::pow(2 * s - 1, static_cast<double>(e))) <= 1e-13);
        }
    }
}

TEST_CASE("ranges contain all values") {
    check_samples<1, 0>(1, 5);
    check_samples<1, 6>(2, 30);
    check_samples<2, 4>(3, 30);
    check_samples<3, 2>(4, 20);
    check_samples<4, 3>(5, 10);
}

TEST_CASE("ranges are exact where an extremum lies at a corner") {
    draws d(6);
    for (int trial = 0; trial < 50; ++trial) {
        // all coefficients positive: the maximum is at (1, 1)
        auto a = random_model<2, 4>(d, 1, 1, 0);
        a.r() = 0;
        double sum = 0;
        for (auto& c : a.coefficients()) sum += c = std::abs(c);
        a.finish();
        REQUIRE(range(a).upper() <= sum * (1 + 1e-12));
        REQUIRE(range(a).upper() >= sum * (1 - 1e-12));
        // multi-affine: all extrema at corners
        using model = sized_model<2, 2>;
        auto b = model::variable(0, d.uniform(-1, 1), d.uniform(-1, 1)) *
                 model::variable(1, d.uniform(-1, 1), d.uniform(-1, 1));
        double lo = HUGE_VAL, hi = -HUGE_VAL;
        for (double const x : {-1.0, 1.0}) {
            for (double const y : {-1.0, 1.0}) {
                double const v = support::value<double>(b, {x, y});
                lo = std::min(lo, v);
                hi = std::max(hi, v);
            }
        }
        REQUIRE(range(b).lower() >= lo - 1e-13);
        REQUIRE(range(b).upper() <= hi + 1e-13);
    }
}

TEST_CASE("ranges see cancellation that the norms do not") {
    // (q - 1)^4 on [-1, 1] is within [0, 16]; its norm is 16 about 1.
    using model = sized_model<1, 4>;
    auto const x = model::variable(0, -1, 1);
    auto const y = x * x * x * x;
    REQUIRE(rough_range(y).lower() < -13);
    REQUIRE(range(y).lower() > -1e-12);
    REQUIRE(range(y).lower() <= 0);
}

TEST_CASE("ranges of many variables contain all values") {
    // More than 4096 Bernstein coefficients: some variables are set or bounded by norms.
    check_samples<7, 3>(11, 5);
    check_samples<6, 4>(12, 4);
    check_samples<9, 2>(13, 8);
    check_samples<13, 2>(14, 3);
    // Those that are nearly or certainly monotone.
    draws d(15);
    for (int trial = 0; trial < 30; ++trial) {
        auto a = random_model<7, 3>(d, 0.3, 1, 0.1);
        auto const& t = sized_model<7, 3>::basis::data;
        for (std::size_t v = 0; v < 7; ++v) {
            double rest = 0; // of the slope
            for (std::size_t i = 0; i < a.terms(); ++i) {
                if (t.degree[i] > 1) rest += t.exponents[i][v] * std::abs(a.c()[i]);
            }
            double const share = d.coin() ? d.uniform(0, 1.5) : 1 + d.uniform(-1e-9, 1e-9);
            a.c()[1 + v] = std::copysign(share * rest, a.c()[1 + v]);
        }
        a.finish();
        auto const values = range(a);
        REQUIRE(subset(values, rough_range(a)));
        for (std::size_t corner = 0; corner < 128 + 30; ++corner) {
            auto q = support::short_point(d, 7);
            for (std::size_t v = 0; v < 7 && corner < 128; ++v) {
                q[v] = ((corner >> v) & 1U) != 0 ? 1 : -1;
            }
            REQUIRE(contains_exactly(values, support::member<rational>(d, a, q)));
        }
    }
}

TEST_CASE("ranges of many variables: nearly monotone is not monotone") {
    // sum of c_v (2 a_v q_v - q_v^2), a_v just below 1: largest at q = a, inside of the box.
    using model = sized_model<7, 3>;
    draws d(18);
    for (int trial = 0; trial < 20; ++trial) {
        model a;
        std::vector<double> best(7);
        for (std::size_t v = 0; v < 7; ++v) {
            best[v] = d.uniform(0.55, 0.999) * (d.coin() ? 1 : -1);
            double const c = d.uniform(0.5, 2);
            auto const x = model::variable(v, 0, 1);
            a = a + scaled(x, 2 * best[v] * c) - scaled(x * x, c);
        }
        a.r() = 0;
        REQUIRE(contains_exactly(range(a), support::value<rational>(a, best)));
        REQUIRE(contains_exactly(range(-a), -support::value<rational>(a, best)));
    }
}

TEST_CASE("ranges of many variables side by side") {
    // A variable is set where all lanes agree that it can be, each lane at its own end.
    using pack = taylor_model<lanes<8>>;
    using side_by_side = pack::side_by_side;
    draws d(17);
    for (int trial = 0; trial < 8; ++trial) {
        pack all(model_shape<lanes<8>>::of(7, 3));
        std::vector<sized_model<7, 3>> alone;
        for (std::size_t l = 0; l < 8; ++l) {
            auto a = random_model<7, 3>(d, 0.3, 1, 0.1);
            for (std::size_t v = 0; v <= static_cast<std::size_t>(trial) % 7; ++v) {
                a.c()[1 + v] = d.coin() ? 100 : -100;
            }
            a.finish();
            for (std::size_t i = 0; i < a.terms(); ++i) side_by_side::put(all.c()[i], l, a.c()[i]);
            side_by_side::put(all.r(), l, a.r());
            alone.push_back(a);
        }
        all.finish();
        auto const values = bounds(all);
        for (std::size_t l = 0; l < 8; ++l) {
            interval const x(side_by_side::get(values.lower, l),
                             side_by_side::get(values.upper, l));
            REQUIRE(subset(x, rough_range(alone[l])));
            for (int sample = 0; sample < 40; ++sample) {
                auto const q = support::short_point(d, 7);
                REQUIRE(contains_exactly(x, support::member<rational>(d, alone[l], q)));
            }
        }
    }
}

TEST_CASE("ranges of what is nearly a line are hardly wider than it, and contain it") {
    // 1024 and 4096 Bernstein coefficients, which nobody needs there.
    check_samples<5, 3>(19, 4);
    check_samples<6, 3>(20, 4);
    using pack = taylor_model<lanes<8>>;
    using side_by_side = pack::side_by_side;
    using one = sized_model<6, 3>;
    auto const& t = one::basis::data;
    draws d(21);
    for (int trial = 0; trial < 8; ++trial) {
        pack all(model_shape<lanes<8>>::of(6, 3));
        std::vector<one> alone;
        for (std::size_t l = 0; l < 8; ++l) {
            auto a = random_model<6, 3>(d, 1, 1, l == 5 ? 0.0 : 0.01);
            double linear = 0, bent = 0;
            for (std::size_t i = 1; i < a.terms(); ++i)
                (t.degree[i] == 1 ? linear : bent) += std::abs(a.c()[i]);
            for (std::size_t i = 0; i < a.terms(); ++i) {
                if (t.degree[i] > 1) a.c()[i] *= d.uniform(0, 0.05) * linear / bent;
                if (l == 5) a.c()[i] = 0; // stands idle
            }
            a.finish();
            for (std::size_t i = 0; i < a.terms(); ++i) side_by_side::put(all.c()[i], l, a.c()[i]);
            // Of the last two nothing is known.
            bool const lost = l > 5;
            side_by_side::put(all.r(), l, lost ? HUGE_VAL : a.r());
            if (lost) side_by_side::put(all.c()[3], l, l == 6 ? HUGE_VAL : NAN);
            alone.push_back(a);
        }
        all.finish();
        auto const values = bounds(all);
        for (std::size_t l = 0; l < 8; ++l) {
            double const low = side_by_side::get(values.lower, l);
            double const high = side_by_side::get(values.upper, l);
            CAPTURE(trial, l);
            if (l > 5) {
                CHECK_FALSE((std::isfinite(low) || std::isfinite(high)));
                continue;
            }
            double lowest = HUGE_VAL, highest = -HUGE_VAL;
            for (std::size_t corner = 0; corner < 64 + 40; ++corner) {
                auto q = support::short_point(d, 6);
                for (std::size_t v = 0; v < 6 && corner < 64; ++v)
                    q[v] = ((corner >> v) & 1U) != 0 ? 1 : -1;
                REQUIRE(contains_exactly(interval(low, high),
                                         support::member<rational>(d, alone[l], q)));
                lowest = std::min(lowest, support::value<double>(alone[l], q));
                highest = std::max(highest, support::value<double>(alone[l], q));
            }
            CHECK(high - low <= 1.15 * (highest - lowest) + 2.001 * alone[l].r() + 1e-12);
        }
    }
}

TEST_CASE("ranges of many variables are exact where they can be") {
    // Multi-affine and monotone in one to seven of seven variables: both ends lie at corners, and
    // Bernstein coefficients of the other variables are means of values at corners.
    constexpr std::size_t variables = 7;
    using model = support::sized_model<variables, 3>;
    auto const& t = model::basis::data;
    draws d(16);
    for (int trial = 0; trial < 60; ++trial) {
        model a;
        for (std::size_t i = 0; i < a.terms(); ++i) {
            bool affine = true;
            for (auto const e : t.exponents[i]) affine = affine && e <= 1;
            a.c()[i] = affine ? d.uniform(-1, 1) : 0;
        }
        std::size_t const monotone = 1 + d.below(variables);
        for (std::size_t v = 0; v < monotone; ++v) {
            double rest = 0;
            for (std::size_t i = 0; i < a.terms(); ++i) {
                if (t.degree[i] > 1 && t.exponents[i][v] > 0) rest += std::abs(a.c()[i]);
            }
            a.c()[1 + v] = std::copysign(1.01 * rest, a.c()[1 + v]);
        }
        a.finish();
        auto const values = range(a);
        double lo = HUGE_VAL, hi = -HUGE_VAL;
        for (std::size_t corner = 0; corner < 128; ++corner) {
            std::vector<double> q(variables);
            for (std::size_t v = 0; v < variables; ++v) q[v] = ((corner >> v) & 1U) != 0 ? 1 : -1;
            REQUIRE(contains_exactly(values, support::value<rational>(a, q)));
            double const value = support::value<double>(a, q);
            lo = std::min(lo, value);
            hi = std::max(hi, value);
        }
        CAPTURE(trial, monotone);
        REQUIRE(values.upper() <= hi + 1e-9);
        REQUIRE(values.lower() >= lo - 1e-9);
    }
}

TEST_CASE("ranges of tiny and huge models") {
    draws d(8);
    for (double const size : {5e-324, 1e-310, 1e-290, 1e150, 1e300}) {
        for (int trial = 0; trial < 10; ++trial) {
            auto const a = random_model<2, 3>(d, size, 1, size);
            auto const values = range(a);
            for (int sample = 0; sample < 10; ++sample) {
                auto const q = support::short_point(d, 2);
                CAPTURE(size, trial);
                REQUIRE(contains_exactly(values, support::member<rational>(d, a, q)));
            }
        }
    }
}

TEST_CASE("ranges of many variables: tops of squares inside of the box are contained") {
    using model = sized_model<12, 2>;
    draws d(21);
    for (int trial = 0; trial < 30; ++trial) {
        model a;
        std::array<rational, 2> end{}; // of the sum of c q^2 + b q, by exact numbers
        for (std::size_t v = 0; v < 12; ++v) {
            double const c = d.coin() ? d.uniform(-2, 2) : 0.0, b = d.uniform(-3, 3);
            auto const x = model::variable(v, 0, 1);
            a = a + x * x * model::constant(c) + x * model::constant(b);
            rational const at_end[2] = {rational(c) - rational(b), rational(c) + rational(b)};
            rational lo = std::min(at_end[0], at_end[1]), hi = std::max(at_end[0], at_end[1]);
            if (std::abs(b) < 2 * std::abs(c)) {
                rational const top = -rational(b) * rational(b) / (4 * rational(c));
                lo = std::min(lo, top);
                hi = std::max(hi, top);
            }
            end[0] += lo;
            end[1] += hi;
        }
        auto const values = range(a);
        REQUIRE(contains_exactly(values, end[0]));
        REQUIRE(contains_exactly(values, end[1]));
    }
}

TEST_CASE("a polynomial that changes its sign at corners has a range of both signs") {
    draws d(22);
    int changes = 0;
    for (int trial = 0; trial < 200; ++trial) {
        auto a = random_model<4, 3>(d, 1, 1, 0.1);
        a.c(0) = d.uniform(-3, 3);
        a.finish();
        if (!changes_sign(a)) continue;
        ++changes;
        auto const values = range(a);
        REQUIRE(values.lower() < 0);
        REQUIRE(values.upper() > 0);
    }
    CHECK(changes > 20);
    CHECK(changes < 200);
}
