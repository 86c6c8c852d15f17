// SPDX-License-Identifier: MIT
// Outputs of carried sets as affine functions of the deviations, member by member.
#include <sivid/enclosure/observation.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"
#include "support/systems.hpp"

#include <sivid/enclosure/trajectory.hpp>
#include <sivid/number/mp_interval.hpp>

#include <cmath>

using namespace sivid;
using support::between;
using support::draws;
using support::extended;

TEST_CASE("each member's output lies in its own affine form and in the value") {
    auto const rate = [](auto const&, auto const& x, auto const& p, auto const&) {
        using namespace support::real;
        return std::vector{x[1], -(p[0] * sin(x[0]))};
    };
    auto const observe = [](auto const& t, auto const& x, auto const& p, auto const&) {
        using namespace support::real;
        return std::vector{x[0] * x[1] + p[0] * t,      abs(x[1]),
                           exp(x[0]) / (1 + sqr(x[1])), sign(x[1] - p[0]),
                           max(x[0], p[0] * x[1]),      0 * x[0] + p[0]};
    };
    auto const f = support::flow_of(support::model_of({2, 1}, rate, observe));
    draws d(271);
    enclosure_options options;
    for (int round = 0; round < 12; ++round) {
        box const start{d.interval(0, 1, 0.1), d.interval(-1, 1, 0.1)};
        box const p{d.interval(1, 2, 0.1)};
        trajectory<interval> run(*f, options);
        run.begin(0, start, p);
        observer<interval> look(*f);
        look.set_ensemble(run.ensemble());
        auto const m = mid(start);
        for (double const t : {0.0, 0.5, 1.0, 1.5}) {
            while (run.time() < t) REQUIRE(run.step(t));
            auto const seen = look(run.set());
            for (int member = 0; member < 6; ++member) {
                auto const x0 = d.in(start);
                auto const q = d.in(p);
                auto const x = support::reference_states(rate, support::extend(x0),
                                                         support::extend(q), 0, {t})[0];
                auto const y = observe(static_cast<extended>(t), x, support::extend(q), 0);
                std::vector<extended> const r0{
                    static_cast<extended>(x0[0]) - m[0], static_cast<extended>(x0[1]) - m[1],
                    static_cast<extended>(q[0]) - run.ensemble().parameter_centre[0]};
                for (std::size_t k = 0; k < y.size(); ++k) {
                    CAPTURE(round, t, k);
                    CHECK(seen[k].defined);
                    CHECK(support::encloses_reference(seen[k].value, y[k]));
                    extended rest = y[k];
                    for (std::size_t c = 0; c < 3; ++c) rest -= seen[k].gradient[c] * r0[c];
                    CHECK(support::encloses_reference(seen[k].rest, rest));
                }
            }
            auto const direct = look.over(t, interval(t), run.set().hull);
            for (std::size_t k = 0; k < direct.size(); ++k) CHECK(subset(seen[k].value, direct[k]));
        }
    }
}

TEST_CASE("smooth outputs are affine up to second order") {
    auto const f = support::flow_of(support::model_of(
        {1, 0},
        [](auto const&, auto const& x, auto const&, auto const&) { return std::vector{0 * x[0]}; },
        [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{sqr(x[0]) + 3 * x[0]};
        }));
    trajectory<interval> run(*f, {});
    observer<interval> look(*f);
    std::vector<double> rests;
    for (double const r : {0.1, 0.05}) {
        run.begin(0, box{between(1 - r, 1 + r)}, box{});
        look.set_ensemble(run.ensemble());
        auto const y = look(run.set())[0];
        CHECK(std::abs(y.gradient[0] - 5) < 1e-9);
        rests.push_back(width(y.rest));
    }
    CHECK(rests[0] < 0.05);
    CHECK(rests[0] / rests[1] > 3.9);
}

TEST_CASE("an output that is not defined on the whole set says so") {
    auto const f = support::flow_of(support::model_of(
        {1, 0},
        [](auto const&, auto const& x, auto const&, auto const&) { return std::vector{0 * x[0]}; },
        [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{log(x[0])};
        }));
    trajectory<interval> run(*f, {});
    observer<interval> look(*f);
    run.begin(0, box{between(-1, 2)}, box{});
    look.set_ensemble(run.ensemble());
    CHECK_FALSE(look(run.set())[0].defined);
    CHECK(width(look.over(0, interval(0.0), run.set().hull)[0]) == HUGE_VAL);
    run.begin(0, box{between(1, 2)}, box{});
    look.set_ensemble(run.ensemble());
    CHECK(look(run.set())[0].defined);
}

TEST_CASE("a set narrower than a double: its centre may stand on the other side of a jump") {
    // x(1) = 1/10, the double next to it is above the jump.
    auto const f = support::flow_of(support::model_of(
        {1, 0},
        [](auto const& t, auto const&, auto const&, auto const&) { return std::vector{t / 5}; },
        [](auto const&, auto const& x, auto const&, auto const&) {
            return std::vector{sign((10 * x[0] - 1) - std::ldexp(1.0, -55))};
        }));
    using traits = interval_traits<mp_interval>;
    trajectory<mp_interval> run(*f, {});
    run.begin(0, basic_box<mp_interval>{traits::point(0.0)}, basic_box<mp_interval>(0));
    while (run.time() < 1) REQUIRE(run.step(1));
    auto const& set = run.set();
    REQUIRE_FALSE(traits::contains(set.hull[0], set.centre[0]));
    observer<mp_interval> look(*f);
    look.set_ensemble(run.ensemble());
    auto const y = look(set)[0];
    CHECK(y.defined);
    for (auto const& says : {y.value, y.rest}) {
        CHECK(traits::lower(says) == -1);
        CHECK(traits::upper(says) == -1);
    }
}
