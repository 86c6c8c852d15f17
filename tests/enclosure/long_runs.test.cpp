// SPDX-License-Identifier: MIT
// Sets by Taylor models that wear out: what was lost to generators is given variables of its own.
// Whatever the flow does after that, no sampled trajectory may leave the motion.
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"
#include "support/uncertain_inputs.hpp"

#include <sivid/enclosure/enclose.hpp>

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

using namespace sivid;
using Catch::Matchers::ContainsSubstring;
using support::between;
using support::draws;
using support::extended_state;

namespace {

/// A reaction with a stable focus at (1, 1.55).
template <class X, class P>
X reaction(X const& x, P const& p) {
    auto rate = x;
    auto const s = x[0] * x[0] * x[1];
    rate[0] = p[0] + s - 2.55 * x[0];
    rate[1] = 1.55 * x[0] - s;
    return rate;
}
/// A limit cycle about an unstable focus.
template <class X, class P>
X cycle(X const& x, P const& p) {
    auto rate = x;
    rate[0] = x[1];
    rate[1] = p[0] * (1 - x[0] * x[0]) * x[1] - x[0];
    return rate;
}
/// A saddle between two stable foci: a box of starts on its stable manifold is torn apart.
template <class X, class P>
X two_wells(X const& x, P const& p) {
    auto rate = x;
    rate[0] = x[1];
    rate[1] = x[0] - x[0] * x[0] * x[0] - p[0] * x[1];
    return rate;
}

std::vector<double> times_up_to(double end) {
    std::vector<double> result;
    for (int k = 1; k < 12; ++k) result.push_back(end * k / 12);
    result.push_back(end); // end * 12 / 12 may be rounded past it
    return result;
}

/// Samples starts and parameters, corners first, and follows them as far as the motion is proved.
template <class Rate>
void check_contained(enclosed_motion const& motion, Rate const& rate, box const& starts,
                     box const& parameters) {
    draws d(23);
    auto const times = times_up_to(motion.end_time());
    std::vector<box> said;
    for (double const t : times) said.push_back(motion.at(t));
    for (int sample = 0; sample < 24; ++sample) {
        auto const draw = [&](box const& b) {
            auto x = d.in(b);
            for (std::size_t i = 0; i < x.size() && sample < 12; ++i) {
                x[i] = d.coin() ? b[i].lower() : b[i].upper();
            }
            return support::extend(x);
        };
        auto const exact = support::reference_states(
            [&](auto const&, auto const& x, auto const& p, auto const&) { return rate(x, p); },
            draw(starts), draw(parameters), 0, times);
        for (std::size_t k = 0; k < times.size(); ++k) {
            CAPTURE(sample, times[k], motion.end_time());
            for (std::size_t i = 0; i < said[k].size(); ++i) {
                REQUIRE(support::encloses_reference(said[k][i], exact[k][i]));
            }
            REQUIRE(
                support::encloses_reference(motion.over(0.9 * times[k], times[k])[0], exact[k][0]));
        }
    }
}

template <class Rate>
std::shared_ptr<flow const> flow_of(Rate const& rate, double limit) {
    return support::flow_of(
        support::model_of({2, 1, 0, limit}, [rate](auto const&, auto const& x, auto const& p,
                                                   auto const&) { return rate(x, p); }));
}
auto const reacting = [](auto const& x, auto const& p) { return reaction(x, p); };
auto const cycling = [](auto const& x, auto const& p) { return cycle(x, p); };
auto const falling = [](auto const& x, auto const& p) { return two_wells(x, p); };

} // namespace

TEST_CASE("motions that shrink to a point are enclosed for as long as they last") {
    for (double const r : {0.09, 0.1, 0.11, 0.15}) {
        CAPTURE(r);
        box const starts{between(1 - r, 1 + r), between(1 - r, 1 + r)}, one{interval(1.0)};
        auto const motion = enclose(flow_of(reacting, 10), starts, one, 0, 200);
        REQUIRE(motion.complete());
        CHECK(width(motion.at(200)) < 1e-10);
        CHECK(width(motion.observe_at(200)) < 1e-10);
        REQUIRE(motion.carried().taylor_models);
        CHECK(*motion.carried().taylor_models == 200);
        CHECK_FALSE(motion.carried().first_order);
        if (r > 0.09) { // the narrow box does without
            REQUIRE(motion.carried().fresh_starts);
            CHECK(*motion.carried().fresh_starts > 0);
            CHECK(*motion.carried().fresh_starts < 15);
        }
        for (std::size_t k = 1; k < motion.spans().size(); ++k) {
            REQUIRE(motion.spans()[k].from == motion.spans()[k - 1].to);
        }
        check_contained(motion, reacting, starts, one);
    }
}

TEST_CASE("with an unknown parameter the set keeps what that does, and shrinks to it") {
    box const starts{between(0.9, 1.1), between(0.9, 1.1)}, unknown{between(0.999, 1.001)};
    auto const motion = enclose(flow_of(reacting, 10), starts, unknown, 0, 60);
    check_contained(motion, reacting, starts, unknown);
    REQUIRE(motion.complete());
    REQUIRE(motion.carried().fresh_starts);
    CHECK(width(motion.at(60)[0]) > 0.002); // x rests at p
    CHECK(width(motion.at(60)[0]) < 0.0021);
}

TEST_CASE("fresh starts neither lose a trajectory to, nor blow up on, cycles and saddles") {
    box const damped{between(0.45, 0.55)};
    for (double const r : {0.05, 0.2, 0.4}) {
        CAPTURE(r);
        box const near_cycle{between(1.4 - r, 1.4 + r), between(2.3 - r, 2.3 + r)};
        box const cycle_speed{between(0.99, 1.01)};
        auto const round = enclose(flow_of(cycling, 10), near_cycle, cycle_speed, 0, 30);
        CHECK(round.end_time() > 1);
        check_contained(round, cycling, near_cycle, cycle_speed);
        // The stable manifold of 0 runs through this box.
        box const on_saddle{between(0.5 - r, 0.5 + r), between(-0.6 - r, -0.6 + r)};
        auto const torn = enclose(flow_of(falling, 10), on_saddle, damped, 0, 40);
        CHECK(torn.end_time() > 1);
        check_contained(torn, falling, on_saddle, damped);
    }
}

TEST_CASE("fresh starts and inputs within error bounds") {
    sampled_signal const held = support::with_errors(
        sampled_signal({0, 5, 10}, {1, 1.02, 1}, interpolation::hold), {0.002, 0.002, 0.002});
    auto const rate = [](auto const&, auto const& x, auto const&, auto const& u) {
        return reaction(x, u); // the input in place of the parameter
    };
    auto const f = support::flow_of(support::model_of({2, 0, 1, 10}, rate), {held});
    box const starts{between(0.89, 1.11), between(0.89, 1.11)};
    auto const motion = enclose(f, starts, box{}, 0, 60);
    CHECK(motion.end_time() > 9);
    draws d(31);
    auto const times = times_up_to(motion.end_time());
    for (int sample = 0; sample < 20; ++sample) {
        auto x0 = d.in(starts);
        for (std::size_t i = 0; i < 2 && sample < 8; ++i) {
            x0[i] = d.coin() ? starts[i].lower() : starts[i].upper();
        }
        double const share = d.coin() ? 1 : -1;
        sampled_signal const real({0, 5, 10},
                                  {1 + 0.002 * share, 1.02 + 0.002 * share, 1 + 0.002 * share},
                                  interpolation::hold);
        auto const exact =
            support::reference_states(rate, support::extend(x0), {}, 0, times, {real});
        for (std::size_t k = 0; k < times.size(); ++k) {
            auto const said = motion.at(times[k]);
            CAPTURE(sample, times[k]);
            for (std::size_t i = 0; i < 2; ++i) {
                REQUIRE(support::encloses_reference(said[i], exact[k][i]));
            }
        }
    }
}

TEST_CASE("where no set goes on, the advice is what the caller of enclose can do") {
    box const starts{between(0.7, 1.3), between(0.7, 1.3)}, one{interval(1.0)};
    auto const motion = enclose(flow_of(reacting, 10), starts, one, 0, 200);
    REQUIRE_FALSE(motion.complete());
    auto const said = motion.failure()->message("x");
    CHECK_THAT(said, !ContainsSubstring("degree") && !ContainsSubstring("Taylor"));
    CHECK_THAT(said, ContainsSubstring("split"));
    check_contained(motion, reacting, starts, one);
    auto const first_order =
        enclose(flow_of(reacting, 10), starts, one, 0, 200, carried_set::doubleton);
    REQUIRE_FALSE(first_order.complete());
    CHECK_THAT(first_order.failure()->message("x"), !ContainsSubstring("degree"));
    CHECK(first_order.carried().first_order == first_order.end_time());
    CHECK_FALSE(first_order.carried().taylor_models);
}

TEST_CASE("a single start is enclosed by both sets, and at least as well as by each") {
    box const start{interval(1.25), interval(1.5)}, one{interval(1.0)};
    for (auto const& f : {flow_of(reacting, 10), flow_of(cycling, 10), flow_of(falling, 10)}) {
        auto const both = enclose(f, start, one, 0, 20);
        auto const first_order = enclose(f, start, one, 0, 20, carried_set::doubleton);
        REQUIRE(both.complete());
        REQUIRE(first_order.complete());
        CHECK(both.carried().first_order == 20);
        CHECK(both.carried().taylor_models == 20);
        for (double const t : times_up_to(20)) {
            for (std::size_t i = 0; i < 2; ++i) {
                CHECK(subset(both.at(t)[i], first_order.at(t)[i]));
            }
            CHECK(subset(both.over(t / 2, t), first_order.over(t / 2, t)));
        }
    }
    check_contained(enclose(flow_of(cycling, 10), start, one, 0, 20), cycling, start, one);
}
