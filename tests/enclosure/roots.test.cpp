// SPDX-License-Identifier: MIT
// Roots that reach 0: a tank that runs empty and stays so, known in closed form, and starts from
// which solutions are not unique: all of them are enclosed.
#include <sivid/enclosure/enclose.hpp>
#include <sivid/enclosure/taylor/parametric_flow.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

/// h' = -k sqrt(max(h, 0)), or -k sqrt(|h|) sign(h).
std::shared_ptr<flow const> tank(bool absolute) {
    return support::flow_of(support::model_of(
        {1, 1, 0, 10}, [absolute](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{absolute ? -(p[0] * sqrt(abs(x[0])) * sign(x[0]))
                                        : -(p[0] * sqrt(max(x[0], 0)))};
        }));
}
long double level(double start, double k, double t) {
    long double const root = std::sqrt(static_cast<long double>(start)) -
                             static_cast<long double>(k) * static_cast<long double>(t) / 2;
    return root > 0 ? root * root : 0;
}

} // namespace

TEST_CASE("a tank runs empty and stays so, by any set, from a point or a box") {
    draws d(71);
    for (bool const absolute : {false, true}) {
        auto const f = tank(absolute);
        for (auto const set : {carried_set::taylor_model, carried_set::doubleton}) {
            for (double const r : {0.0, 0.02}) {
                CAPTURE(absolute, static_cast<int>(set), r);
                box const start{between(1 - r, 1 + r)}, k{between(1 - r, 1 + r)};
                enclosure_options steps;
                steps.maximum_step = 1; // from a point one ends where the tank does, at 2
                auto const motion = enclose(f, start, k, 0, 3, set, steps);
                double const end = motion.end_time();
                // First-order sets have no barrier: past a root they may grow too wide.
                REQUIRE((motion.complete() || set == carried_set::doubleton));
                REQUIRE(end > 2.05);
                for (int sample = 0; sample < 30; ++sample) {
                    double const h = d.in(start)[0], c = d.in(k)[0];
                    for (double const t : {1.0, 1.9, 1.96, 2.0, 2.0001, 2.04, end}) {
                        CAPTURE(h, c, t);
                        auto const at = motion.at(t)[0];
                        REQUIRE(support::encloses_reference(at, level(h, c, t)));
                    }
                    double const from = d.uniform(1.8, end), to = d.uniform(from, end);
                    auto const over = motion.over(from, to)[0];
                    for (double const t : {from, d.uniform(from, to), to})
                        REQUIRE(support::encloses_reference(over, level(h, c, t)));
                }
                if (set == carried_set::doubleton) continue;
                auto const last = motion.at(3)[0];
                CAPTURE(last.lower(), last.upper());
                CHECK(last.lower() > (r > 0 ? -1e-2 : -1e-12));
                CHECK(last.upper() < (r > 0 ? 1e-3 : 1e-12));
            }
        }
    }
}

TEST_CASE("eight tanks side by side, of which some are empty") {
    auto const f = tank(false);
    parametric_flow<taylor_model<lanes<8>>> run(*f, for_span({}, 3), 1, 2);
    std::array<double, 8> const starts{1, 4, 0.25, 0, 9, 1e-6, 2, 0.01};
    for (std::size_t l = 0; l < 8; ++l)
        run.begin(l, 0, box{interval(starts[l])}, box{between(0.99, 1.01)});
    int rounds = 0;
    while (lane_traits<lanes<8>>::any(run.running() & (run.set().time < lanes<8>(3.0)))) {
        REQUIRE(++rounds < 20000);
        (void)run.advance(lanes<8>(3.0));
        for (std::size_t l = 0; l < 8; ++l) {
            double const t = run.time(l);
            for (double const k : {0.99, 1.0, 1.01}) {
                CAPTURE(l, t, k);
                REQUIRE(support::encloses_reference(run.set().hull(l)[0], level(starts[l], k, t)));
            }
        }
    }
    for (std::size_t l = 0; l < 8; ++l) {
        CAPTURE(l);
        CHECK_FALSE(run.failure(l));
        CHECK(run.time(l) == 3);
    }
}

TEST_CASE("where solutions are not unique, all of them are enclosed") {
    // x' = 2 sqrt(|x|) from 0: 0 up to any time c, then (t - c)^2.
    auto const f = support::flow_of(
        support::model_of({1, 0, 0, 100}, [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{2 * sqrt(abs(x[0]))};
        }));
    for (auto const set : {carried_set::taylor_model, carried_set::doubleton}) {
        for (double const start : {0.0, -0.01}) {
            CAPTURE(static_cast<int>(set), start);
            auto const motion = enclose(f, box{interval(start)}, box{}, 0, 1, set);
            REQUIRE(motion.complete()); // from -0.01 it gets to 0 at 0.1
            double const wait = std::sqrt(-start);
            for (double const t : {0.05, 0.2, 0.5}) {
                auto const all = motion.at(t)[0];
                CAPTURE(t, all.lower(), all.upper());
                double const least = t < wait ? -(wait - t) * (wait - t) : 0;
                double const most = t < wait ? least : (t - wait) * (t - wait);
                for (double const x : {least, 0.5 * (least + most), most})
                    REQUIRE(support::encloses_reference(all, static_cast<long double>(x)));
            }
        }
    }
}

TEST_CASE("an empty tank fills, by any set, in any unit of time") {
    // h' = 1 - sqrt(h) from 0: t = -2 sqrt(h) - 2 log(1 - sqrt(h)).
    auto const time_of = [](long double h) {
        long double const root = std::sqrt(h);
        return -2 * root - 2 * std::log1p(-root);
    };
    for (double const unit : {1.0, 1e3, 1 / 3600.0}) {
        for (bool const absolute : {false, true}) {
            auto const f = support::flow_of(
                support::model_of({1, 0, 0, 10}, [absolute, unit](auto const&, auto const& x,
                                                                  auto const&, auto const&) {
                    auto const root = absolute ? sqrt(abs(x[0])) * sign(x[0]) : sqrt(max(x[0], 0));
                    return std::vector{(1 - root) / unit};
                }));
            for (auto const set : {carried_set::taylor_model, carried_set::doubleton}) {
                CAPTURE(unit, absolute, static_cast<int>(set));
                auto const motion = enclose(f, box{interval(0.0)}, box{}, 0, 3 * unit, set);
                REQUIRE(motion.complete());
                for (double const share : {1e-6, 1e-3, 0.1, 0.5, 1.0}) {
                    double const t = 3 * share * unit;
                    auto const level = motion.at(t)[0];
                    CAPTURE(t, level.lower(), level.upper());
                    // The level rises: it is at least x where that is reached before t.
                    CHECK(time_of(level.lower()) * unit <= t * (1 + 1e-12L));
                    CHECK(time_of(level.upper()) * unit >= t * (1 - 1e-12L));
                    CHECK(width(level) < 1e-8);
                }
            }
        }
    }
}

TEST_CASE("roots and reciprocals that leave their domain still end the enclosure there") {
    auto const ended = [](auto const& rate, double start) {
        auto const f = support::flow_of(support::model_of({1, 0, 0, 10}, rate));
        auto const motion = enclose(f, box{interval(start)}, box{}, 0, 3);
        CHECK(motion.end_time() < 2);
        REQUIRE(motion.failure());
        CHECK(motion.failure()->reason == failure_reason::undefined);
        return motion.failure()->message("x");
    };
    CHECK_THAT(ended([](auto const&, auto const& x, auto const&,
                        auto const&) { return std::vector{-sqrt(max(x[0], 0) - 1e-3)}; },
                     1),
               ContainsSubstring("sqrt of a value in"));
    CHECK_THAT(ended([](auto const&, auto const& x, auto const&,
                        auto const&) { return std::vector{log(abs(x[0]))}; },
                     0.5),
               ContainsSubstring("log of a value in") && ContainsSubstring("abs("));
}
