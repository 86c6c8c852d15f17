// SPDX-License-Identifier: MIT
// Dry friction as a steep hyperbolic tangent: over starts that reach from one side of it to the
// other no Taylor polynomial in the starts comes close to it.
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"

#include <sivid/enclosure/enclose.hpp>

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;
using support::extended_state;

namespace {

/// A slide under a force that swings: velocity, against the steepness and size of the friction.
template <class T, class X, class P>
X slide(T const& t, X const& x, P const& p) {
    using std::sin;
    using std::tanh;
    auto rate = x;
    rate[0] = 12 * sin(3 * t) - p[0] * tanh(10 * x[0]) - p[1] * x[0];
    return rate;
}

} // namespace

TEST_CASE("starts on both sides of dry friction are carried until they have come together") {
    auto const f = support::flow_of(
        support::model_of({1, 2, 0, 20}, [](auto const& t, auto const& x, auto const& p,
                                            auto const&) { return slide(t, x, p); }));
    box const start{between(-0.1, 0.1)}, friction{between(9.8, 10.2), between(0.25, 0.35)};
    auto const motion = enclose(f, start, friction, 0, 0.5);
    REQUIRE(motion.complete());
    draws d(3);
    std::vector<double> const times{0.001, 0.004, 0.01, 0.03, 0.1, 0.3, 0.5};
    for (int sample = 0; sample < 40; ++sample) {
        extended_state const x0{sample == 0   ? -0.1L
                                : sample == 1 ? 0.1L
                                              : static_cast<support::extended>(d.in(start[0]))};
        auto const exact = support::reference_states(
            [](auto const& t, auto const& x, auto const& p, auto const&) { return slide(t, x, p); },
            x0, support::extend(d.in(friction)), 0, times, {});
        for (std::size_t k = 0; k < times.size(); ++k) {
            CAPTURE(times[k], motion.at(times[k])[0].lower(), motion.at(times[k])[0].upper());
            REQUIRE(support::encloses_reference(motion.at(times[k])[0], exact[k][0]));
        }
    }
    CHECK(width(motion.at(0.03)[0]) < 0.06); // what friction has left of 0.2
}
