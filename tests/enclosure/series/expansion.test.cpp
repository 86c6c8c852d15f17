// SPDX-License-Identifier: MIT
// Taylor coefficients of solutions and of their derivatives by initial state and parameters, order
// by order, against power series in 100 digits; derivatives by central differences of those.
#include <sivid/enclosure/series/expansion.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/systems.hpp"

#include <vector>

using namespace sivid;
using support::draws;
using support::encloses;
using support::mp;

namespace {

constexpr std::size_t K = 8;
using ps = support::power_series<K>;

template <class System>
std::vector<ps> exact(System const& system, mp const& t, std::vector<mp> const& x,
                      std::vector<mp> const& p, double start) {
    return support::solution_series<K>(system.rate, t, x, p, [&](ps const& time) {
        std::vector<ps> u;
        for (auto const& s : system.inputs) {
            auto const k = s.piece(start);
            ps value = s.values()[k];
            if (s.kind() == interpolation::linear) {
                mp const slope = (mp(s.values()[k + 1]) - mp(s.values()[k])) /
                                 (mp(s.times()[k + 1]) - mp(s.times()[k]));
                value = value + ps(slope) * (time - ps(mp(s.times()[k])));
            }
            u.push_back(value);
        }
        return u;
    });
}
std::vector<mp> lift(std::vector<double> const& x) { return {x.begin(), x.end()}; }

template <class System>
void check(System const& system, box const& x, box const& p, interval const& t, draws& d) {
    auto const f = system.flow();
    auto const n = f->states();
    auto const columns = n + f->parameters();
    expansion<interval> e(*f, K);
    e.set_parameters(p);
    double const start = t.lower();
    e.expand(start, t, x, K);
    if (e.kinked() || e.undefined()) return;
    expansion<interval> v(*f, K);
    v.set_parameters(p);
    v.expand_with_variations(start, t, x, K);
    for (int member = 0; member < 2; ++member) {
        mp const time = d.in(t);
        auto const x0 = lift(d.in(x));
        auto const q = lift(d.in(p));
        auto const series = exact(system, time, x0, q, start);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t k = 0; k <= K; ++k) {
                CAPTURE(system.name, i, k);
                CHECK(encloses(e.state(i, k), series[i].c[k], 1e-30));
                CHECK(encloses(v.state(i, k), series[i].c[k], 1e-30));
            }
        }
        for (std::size_t c = 0; c < columns; ++c) {
            auto const moved = [&](double step) {
                auto xs = x0;
                auto ps_ = q;
                (c < n ? xs[c] : ps_[c - n]) += step;
                return exact(system, time, xs, ps_, start);
            };
            double const h = 1e-14;
            auto const up = moved(h);
            auto const down = moved(-h);
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t k = 0; k <= K; ++k) {
                    mp const slope = (up[i].c[k] - down[i].c[k]) / (2 * mp(h));
                    CAPTURE(system.name, i, c, k, slope.str(20), v.variation(i, c, k).lower(),
                            v.variation(i, c, k).upper());
                    // h^2 times a third derivative.
                    CHECK(encloses(v.variation(i, c, k), slope, 1e-17));
                    if (!f->sensitive(i, c)) CHECK(slope == 0);
                }
            }
        }
    }
}

} // namespace

TEST_CASE("coefficients of solutions and variations at points and over boxes") {
    draws d(221);
    support::for_each_system([&](auto const& system) {
        check(system, point_box(d.in(system.initial)), point_box(d.in(system.parameters)),
              interval(0.125), d);
        check(system, system.initial, system.parameters, support::between(0.1, 0.2), d);
    });
}

TEST_CASE("coefficients at points are tight") {
    draws d(222);
    support::for_each_smooth_system([&](auto const& system) {
        auto const f = system.flow();
        expansion<interval> e(*f, K);
        e.set_parameters(point_box(mid(system.parameters)));
        e.expand_with_variations(0, interval(0.0), point_box(mid(system.initial)), K);
        for (std::size_t i = 0; i < f->states(); ++i) {
            for (std::size_t k = 0; k <= K; ++k) {
                CHECK(width(e.state(i, k)) <= 1e-10 * (1 + mag(e.state(i, k))));
            }
        }
    });
}

TEST_CASE("a kink or a pole within the box is reported, not differentiated") {
    auto const rough = support::flow_of(
        support::model_of({1, 0}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{abs(x[0])};
        }));
    expansion<interval> e(*rough, 4);
    e.set_parameters(box{});
    e.expand(0, interval(0.0), box{support::between(-1, 1)}, 4);
    CHECK(e.kinked());
    e.expand(0, interval(0.0), box{support::between(1, 2)}, 4);
    CHECK_FALSE(e.kinked());
    e.expand(0, interval(0.0), box{support::between(-1, 1)}, 1); // the first order needs no slope
    CHECK_FALSE(e.kinked());
    CHECK(contains(e.state(0, 1), 0.0));
    CHECK(contains(e.state(0, 1), 1.0));
}

TEST_CASE("derivatives read the values' coefficients of their own order") {
    // x' = -p x: the value needs the last coefficient of x alone, its derivative by p all of them.
    auto const f = support::flow_of(
        support::model_of({1, 1}, [](auto const&, auto const& x, auto const& p,
                                     auto const&) { return std::vector{-(p[0] * x[0])}; }),
        {});
    expansion<interval> e(*f, 8);
    e.set_parameters(box{interval(2.0)});
    e.expand_with_variations(0.0, interval(0.0), box{interval(3.0)}, 8);
    double by_start = 1; // (-p)^k / k!
    double by_parameter = 0;
    for (std::size_t k = 0; k <= 8; ++k) {
        CAPTURE(k);
        CHECK(contains(e.state(0, k), 3 * by_start));
        CHECK(contains(e.variation(0, 0, k), by_start));
        CHECK(contains(e.variation(0, 1, k), by_parameter));
        CHECK(width(e.variation(0, 1, k)) < 1e-13);
        by_parameter = -3 * by_start; // -x_0 (-p)^(k-1) / (k-1)!
        by_start *= -2.0 / static_cast<double>(k + 1);
    }
}
