// SPDX-License-Identifier: MIT
// Points whose centre is kept in twice the digits, against trajectories of 100 digits.
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/power_series.hpp"
#include "support/random.hpp"

#include <sivid/enclosure/taylor/parametric_flow.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <type_traits>
#include <vector>

using namespace sivid;
using support::between;
using support::flow_of;
using support::model_of;
using support::mp;

namespace {

template <class X>
X vector(std::initializer_list<typename X::value_type> values) {
    return X(values);
}

enclosure_options strict(std::size_t order, double tolerance) {
    enclosure_options o;
    o.order = order;
    o.tolerance = tolerance;
    o.relative_tolerance = 0;
    o.minimum_step = 1e-7; // of a span of 1: at low orders no step meets the tolerance
    return o;
}

/// x within centre, tail and generators, componentwise.
template <class Set>
bool encloses_exactly(Set const& set, std::vector<mp> const& x) {
    for (std::size_t i = 0; i < x.size(); ++i) {
        mp reach = 0;
        for (auto const& g : set.columns) reach += mp(g[i].norm());
        mp const off = x[i] - mp(set.centre[i].c()[0]) - mp(set.tail[i]);
        if (!(abs(off) <= reach)) return false;
    }
    return true;
}

/// How far the tail matters: the largest of the tails over the rest of the reach.
template <class Set>
double tail_share(Set const& set) {
    double most = 0;
    for (std::size_t i = 0; i < set.centre.size(); ++i) {
        double reach = 0;
        for (auto const& g : set.columns) reach += g[i].norm();
        most = std::max(most, std::abs(set.tail[i]) / reach);
    }
    return most;
}

using exact_solution = std::function<std::vector<mp>(mp const& t)>;

/// Every step against the exact solution. Returns the largest share of a tail.
template <std::size_t N, std::size_t D>
double check(flow const& f, enclosure_options const& options, box const& x0, box const& p,
             double begin, double end, exact_solution const& exact) {
    parametric_flow<taylor_model<double>> run(f, options, N, D);
    run.begin(begin, x0, p);
    double share = 0;
    while (run.time() < end) {
        if (!run.step(end)) FAIL(run.failure()->message("x"));
        auto const x = exact(mp(run.time()));
        CAPTURE(options.order, options.tolerance, run.time(), run.set().tail[0]);
        REQUIRE(encloses_exactly(run.set(), x));
        auto const hull = run.set().hull();
        for (std::size_t i = 0; i < x.size(); ++i) {
            REQUIRE(mp(hull[i].lower()) <= x[i]);
            REQUIRE(x[i] <= mp(hull[i].upper()));
        }
        share = std::max(share, tail_share(run.set()));
    }
    return share;
}

} // namespace

TEST_CASE("sharp centres: a rotation, at low orders and over long times") {
    auto const f =
        flow_of(model_of({2, 0, 0, 100}, [](auto const&, auto const& x, auto const&, auto const&) {
            return vector<std::decay_t<decltype(x)>>({-x[1], x[0]});
        }));
    exact_solution const exact = [](mp const& t) { return std::vector<mp>{cos(t), sin(t)}; };
    auto const x0 = point_box({1, 0});
    for (std::size_t const order : {3U, 4U, 6U}) {
        CHECK(check<1, 0>(*f, strict(order, 1e-19), x0, box(), 0, 0.02, exact) > 1);
    }
    for (std::size_t const order : {12U, 20U, 28U}) {
        CHECK(check<1, 0>(*f, strict(order, 1e-20), x0, box(), 0, 10, exact) > 1);
    }
    // Any degree may carry a point, and lanes as well, the latter in single digits.
    CHECK(check<2, 2>(*f, strict(16, 1e-20), x0, box(), 0, 1, exact) > 1);
    parametric_flow<taylor_model<lanes<8>>> eight(*f, strict(16, 1e-20), 1, 1);
    eight.begin(0, 0.0, x0, box());
    while (eight.time(0) < 1) (void)eight.advance(1.0);
    CHECK(encloses_exactly(lane_of(eight.set(), 0), exact(mp(1))));
}

TEST_CASE("sharp centres: time, quotients and roots, steps that are no doubles") {
    // From t = 0.1 on, the computed length of a step is not the exact one.
    auto const f = flow_of(
        model_of({3, 0, 0, 100}, [](auto const& t, auto const& x, auto const&, auto const&) {
            return vector<std::decay_t<decltype(x)>>(
                {1000 / (1 + t), sqrt(t) * 30, x[0] * x[2] / 4096});
        }));
    mp const a = 0.1;
    exact_solution const exact = [a](mp const& t) {
        mp const l = log((1 + t) / (1 + a));
        // x2' / x2 = 1000 log((1 + t) / (1 + a)) / 4096
        mp const integral = (1 + t) * l - (t - a);
        return std::vector<mp>{1000 * l, 20 * (t * sqrt(t) - a * sqrt(a)),
                               exp(1000 * integral / 4096)};
    };
    for (std::size_t const order : {10U, 20U}) {
        CHECK(check<1, 0>(*f, strict(order, 1e-19), point_box({0, 0, 1}), box(), 0.1, 2, exact) >
              1);
    }
}

TEST_CASE("sharp centres: parameters and starts known to a unit") {
    auto const f = flow_of(
        model_of({1, 1, 0, 100}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return vector<std::decay_t<decltype(x)>>({p[0] * x[0]});
        }));
    double const last = std::nextafter(1.0, 2.0);
    box const p{interval(1.0, last)}, x0{interval(1.0, last)};
    for (double const rate : {1.0, last}) {
        for (double const start : {1.0, last}) {
            (void)check<1, 0>(*f, strict(16, 1e-20), x0, p, 0, 2, [&](mp const& t) {
                return std::vector<mp>{mp(start) * exp(mp(rate) * t)};
            });
        }
    }
}

TEST_CASE("sharp centres: elementary functions of doubles") {
    auto const f = flow_of(
        model_of({2, 0, 0, 100}, [](auto const& t, auto const& x, auto const&, auto const&) {
            return vector<std::decay_t<decltype(x)>>({cos(t) * x[0], exp(-x[1])});
        }));
    (void)check<1, 0>(*f, strict(16, 1e-18), point_box({1, 1}), box(), 0, 3, [](mp const& t) {
        return std::vector<mp>{exp(sin(t)), log(t + exp(mp(1)))};
    });
}

TEST_CASE("sharp centres: Lorenz's equations against 100 digits") {
    auto const f =
        flow_of(model_of({3, 0, 0, 100}, [](auto const&, auto const& s, auto const&, auto const&) {
            return vector<std::decay_t<decltype(s)>>(
                {10 * (s[1] - s[0]), s[0] * (28 - s[2]) - s[1], s[0] * s[1] - 8 * s[2] / 3});
        }));
    enclosure_options const options = strict(24, 1e-17);
    parametric_flow<taylor_model<double>> run(*f, options, 1, 0);
    run.begin(0, point_box({15, 15, 36}), box());
    std::array<mp, 3> x{15, 15, 36};
    constexpr std::size_t K = 40;
    mp now = 0;
    while (run.time() < 8) {
        REQUIRE(run.step(8));
        mp const h = (mp(run.time()) - now) / 2; // two steps of order 40
        for (int half = 0; half < 2; ++half) {
            std::array<std::array<mp, K + 1>, 3> c;
            for (std::size_t i = 0; i < 3; ++i) c[i][0] = x[i];
            for (std::size_t k = 0; k < K; ++k) {
                mp xz = 0, xy = 0;
                for (std::size_t j = 0; j <= k; ++j) {
                    xz += c[0][j] * c[2][k - j];
                    xy += c[0][j] * c[1][k - j];
                }
                mp const next = static_cast<double>(k + 1);
                c[0][k + 1] = 10 * (c[1][k] - c[0][k]) / next;
                c[1][k + 1] = (28 * c[0][k] - xz - c[1][k]) / next;
                c[2][k + 1] = (xy - 8 * c[2][k] / 3) / next;
            }
            for (std::size_t i = 0; i < 3; ++i) {
                mp sum = 0;
                for (std::size_t k = K + 1; k-- > 0;) sum = sum * h + c[i][k];
                x[i] = sum;
            }
        }
        now = mp(run.time());
        CAPTURE(run.time());
        REQUIRE(encloses_exactly(run.set(), {x[0], x[1], x[2]}));
    }
    // With single digits it is 5e-8 wide.
    auto const hull = run.set().hull();
    for (auto const& side : hull) CHECK(width(side) < 1e-9);
}

TEST_CASE("sharp centres: families keep single digits") {
    auto const f =
        flow_of(model_of({2, 0, 0, 100}, [](auto const&, auto const& x, auto const&, auto const&) {
            return vector<std::decay_t<decltype(x)>>({-x[1], x[0]});
        }));
    parametric_flow<taylor_model<double>> run(*f, strict(16, 1e-18), 1, 2);
    run.begin(0, {between(1, 1.125), between(0, 0)}, box());
    while (run.time() < 1) REQUIRE(run.step(1));
    CHECK(run.set().tail[0] == 0);
    CHECK(run.set().tail[1] == 0);
    run.begin(0, point_box({1, 0}), box()); // the same run, a point now
    while (run.time() < 1) REQUIRE(run.step(1));
    CHECK(run.set().tail[0] != 0);
    run.begin(0, {between(1, 1.125), between(0, 0)}, box());
    CHECK(run.set().tail[0] == 0);
}
