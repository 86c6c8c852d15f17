// SPDX-License-Identifier: MIT
// Contact with a floor: the right-hand side has a kink where the ball touches it. Impacts are
// entered and left at times that differ between the members of a family.
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"

#include <sivid/enclosure/enclose.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::extended;

namespace {

constexpr double gravity = 9.81;

/// Height and velocity of an elastic ball, let go at a height: parabolas, and within the floor arcs
/// of a harmonic motion about the height at which the floor carries the ball.
struct bounce {
    extended x, v;
    int impacts;
};
bounce elastic_ball(extended t, extended height, extended stiffness) {
    extended const omega = std::sqrt(stiffness), g = gravity;
    extended const fall = std::sqrt(2 * height / g), speed = g * fall;
    extended const depth = g / stiffness; // at rest
    // x = -depth + A cos(omega s + phase) from x = 0, v = -speed until x = 0 again.
    extended const amplitude = std::hypot(depth, speed / omega);
    extended const phase = std::atan2(speed / omega, depth);
    extended const contact = 2 * (std::acos(extended(-1)) - phase) / omega;
    if (t < fall) return {height - g * t * t / 2, -g * t, 0};
    extended const period = contact + 2 * fall;
    auto const count = std::floor((t - fall) / period);
    extended const s = t - fall - count * period;
    int const impacts = static_cast<int>(count) + 1;
    if (s < contact) {
        return {-depth + amplitude * std::cos(omega * s + phase),
                -amplitude * omega * std::sin(omega * s + phase), impacts};
    }
    extended const up = s - contact;
    return {speed * up - g * up * up / 2, speed - g * up, impacts};
}

} // namespace

TEST_CASE("a ball bounces ten times on a stiff floor, by any set") {
    auto const f = support::flow_of(support::model_of(
        {2, 1, 0, 20}, [](auto const&, auto const& x, auto const& p, auto const&) {
            auto rate = x;
            rate[0] = x[1];
            rate[1] = -gravity - p[0] * min(x[0], 0 * x[0]);
            return rate;
        }));
    struct plan {
        carried_set set;
        double part, width; ///< of the box, and of the height at the end
        double end;
    };
    for (auto const& [set, part, widest, end] :
         {plan{carried_set::taylor_model, 1e-10, 1e-2, 7.7},
          plan{carried_set::doubleton, 1e-11, 1e-2, 7.7},
          plan{carried_set::taylor_model, 1e-3, 0.05, 1.0}}) {
        box const start{between(0.5 * (1 - part), 0.5 * (1 + part)), interval(0.0)};
        box const stiffness{between(1000 * (1 - part), 1000 * (1 + part))};
        auto const motion = enclose(f, start, stiffness, 0, end, set);
        CAPTURE(static_cast<int>(set), part, motion.end_time());
        REQUIRE(motion.complete());
        draws d(11);
        for (int sample = 0; sample < 40; ++sample) {
            extended const height = d.in(start[0]), k = d.in(stiffness[0]);
            double const t = sample == 0 ? end : d.uniform(0, end);
            auto const exact = elastic_ball(t, height, k);
            if (sample == 0 && end > 7) CHECK(exact.impacts >= 10);
            auto const x = motion.at(t);
            CAPTURE(t, x[0].lower(), x[0].upper(), static_cast<double>(exact.x));
            REQUIRE(support::encloses_reference(x[0], exact.x, 1e-12));
            REQUIRE(support::encloses_reference(x[1], exact.v, 1e-12));
            CHECK(width(x[0]) < widest);
        }
    }
}
