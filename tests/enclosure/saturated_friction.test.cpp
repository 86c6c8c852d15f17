// SPDX-License-Identifier: MIT
// Friction as a steep function of the velocity: while a body slides the force is constant, whatever
// the steepness s, so steps are as long as those of the force's other parts, and as many are needed
// for any s.
#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/reference.hpp"

#include <sivid/enclosure/enclose.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

using namespace sivid;
using support::between;

namespace {

/// x' = v, v' = force cos t - f(v / s), with s the parameter.
template <class Function>
std::shared_ptr<flow const> block(double force, Function const& friction) {
    return support::flow_of(support::model_of(
        {2, 1, 0, 20}, [=](auto const& t, auto const& x, auto const& p, auto const&) {
            return std::vector{x[1], force * cos(t) - friction(x[1] / p[0])};
        }));
}
auto const by_tanh = [](auto const& y) { return tanh(y); };
/// 1 - 2/(1 + e^(2y)) for y > 0
auto const by_exp = [](auto const& y) { return (1 - exp(-2 * y)) / (1 + exp(-2 * y)); };

} // namespace

TEST_CASE("steps of a sliding body do not depend on how steep its friction is") {
    for (auto const& f : {block(1, by_tanh), block(1, by_exp)}) {
        for (auto const set : {carried_set::taylor_model, carried_set::doubleton}) {
            for (double s = 1e-2; s > 1e-8; s *= 0.1) {
                CAPTURE(s, static_cast<int>(set));
                for (double const w : {0.0, 0.125}) {
                    box const start{interval(0.0), between(5 - w, 5 + w)};
                    auto const motion = enclose(f, start, box{interval(s)}, 0, 4, set);
                    REQUIRE(motion.complete());
                    CHECK(motion.spans().size() < 40);
                    for (double const t : {0.5, 1.7, 4.0}) { // v = v(0) + sin t - t, up to e^(-20)
                        auto const v = motion.at(t)[1];
                        for (double const v0 : {5 - w, 5.0, 5 + w}) {
                            CHECK(support::encloses_reference(
                                v, v0 + std::sin(static_cast<long double>(t)) - t,
                                s > 5e-3 ? 1e-9 : 1e-15));
                        }
                        CHECK(width(v) < 2 * w * 1.001 + 1e-9); // steps may lose 1e-4 of the set
                    }
                }
            }
        }
    }
}

TEST_CASE("a body that turns back: about as many steps for any steepness, and no sample is lost") {
    // x and v at 3, 4.5 and 6, by the classical Runge-Kutta method in long double, with steps of
    // 1e-4, and of s/200 where |v| < 100 s + 0.002.
    struct {
        double s;
        std::array<long double, 6> states;
    } const known[] = {{1e-2,
                        {1.6734935654483086L, -0.55246503410172447L, -0.011957404223213639L,
                         -1.2897652855516535L, -0.59608363422021167L, 0.39813220202202802L}},
                       {1e-3,
                        {1.6822552045529326L, -0.54173240299578463L, 0.012903181540322145L,
                         -1.2790326544457127L, -0.56577630578401415L, 0.39116681536821179L}},
                       {1e-4,
                        {1.6832705677154904L, -0.54051755577705208L, 0.015740815530978827L,
                         -1.2778178072269802L, -0.56231491682247852L, 0.39042578423021387L}}};
    std::size_t most = 0;
    for (double const s : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        auto const motion =
            enclose(block(2, by_tanh), box{interval(0.0), interval(0.5)}, box{interval(s)}, 0, 6);
        CAPTURE(s, motion.end_time());
        REQUIRE(motion.complete());
        if (most == 0) most = motion.spans().size();
        CHECK(motion.spans().size() < 2 * most);
        CHECK(width(motion.at(6)) < 1e-9);
        for (auto const& k : known) {
            if (k.s != s) continue;
            std::array<double, 3> const times{3, 4.5, 6};
            for (std::size_t j = 0; j < 6; ++j) {
                CAPTURE(times[j / 2], j % 2);
                CHECK(support::encloses_reference(motion.at(times[j / 2])[j % 2], k.states[j],
                                                  1e-14));
            }
        }
    }
}
