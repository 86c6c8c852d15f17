// SPDX-License-Identifier: MIT
// Motions that are theorems about the equations: those that are, those that are not, and random
// models in which simulated outputs must agree with what is claimed.
#include <sivid/model/structure/symmetry.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"
#include "support/reference.hpp"

#include "../../../examples/hovercraft/model.hpp"

#include <cmath>

using namespace sivid;
using support::draws;

namespace {

constexpr auto every_state = [](auto const&, auto const& x, auto const&, auto const&) { return x; };

template <class Rate, class Observe>
bound_model bound(support::shape const& s, Rate const& rate, Observe const& observe) {
    return bind(support::model_of(s, rate, observe), {support::all_constants(s.constants), {}}, {});
}
model_motion scaling(std::vector<int> p, std::vector<int> x = {0}) {
    return {motion_kind::scaling, std::move(p), std::move(x)};
}
model_motion translation(std::vector<int> p, std::vector<int> x = {0}) {
    return {motion_kind::translation, std::move(p), std::move(x)};
}

} // namespace

TEST_CASE("sums, multiplied out or not, may be shifted, products and ratios scaled") {
    auto const both = bound(
        {1, 5},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[2] * p[3] * x[0] - p[0] * x[0] - x[0] * p[1] + sqr(p[2]) / p[4]};
        },
        every_state);
    CHECK(is_symmetry(both, translation({1, -1, 0, 0, 0})));
    CHECK(is_symmetry(both, scaling({0, 0, 1, -1, 2})));
    CHECK_FALSE(is_symmetry(both, translation({1, 1, 0, 0, 0})));
    CHECK_FALSE(is_symmetry(both, scaling({1, -1, 0, 0, 0})));
    CHECK_FALSE(is_symmetry(both, scaling({0, 0, 1, -1, 1})));
    CHECK_FALSE(is_symmetry(both, translation({0, 0, 1, -1, 0})));
    auto const weights = bound(
        {1, 2},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{exp(-(p[0] + 2 * p[1]) * x[0])};
        },
        every_state);
    CHECK(is_symmetry(weights, translation({2, -1})));
    CHECK_FALSE(is_symmetry(weights, translation({1, -2})));
    // Absent parameters move as they like.
    auto const absent = bound(
        {1, 2},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[0] * x[0]};
        },
        every_state);
    CHECK(is_symmetry(absent, scaling({0, 1})));
    CHECK(is_symmetry(absent, translation({0, 1})));
}

TEST_CASE("states may move along when their starts do") {
    auto const seen = [](auto const&, auto const& x, auto const& p, auto const&) {
        return std::vector{p[1] * x[0]};
    };
    auto const linear = bound(
        {1, 2},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{-(p[0] * x[0])};
        },
        seen);
    CHECK(is_symmetry(linear, scaling({0, 1}, {-1})));
    CHECK_FALSE(is_symmetry(linear, scaling({0, 1}, {0})));
    CHECK_FALSE(is_symmetry(linear, scaling({0, 1}, {1})));
    auto const quadratic = bound(
        {1, 2},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{-(p[0] * sqr(x[0]))};
        },
        seen);
    CHECK_FALSE(is_symmetry(quadratic, scaling({0, 1}, {-1})));
    CHECK(is_symmetry(quadratic, scaling({1, 1}, {-1})));
    auto const offset = bound(
        {1, 1},
        [](auto const&, auto const&, auto const& p, auto const&) { return std::vector{p[0]}; },
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{x[0] + p[0]};
        });
    CHECK_FALSE(is_symmetry(offset, translation({1}, {-1})));
}

TEST_CASE("a jump that moves is no symmetry, a kink may be one") {
    auto const jump = bound(
        {1, 2},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{sign(p[0] * p[1] - x[0])};
        },
        every_state);
    CHECK_FALSE(is_symmetry(jump, scaling({1, 1})));
    CHECK_FALSE(is_symmetry(jump, scaling({1, 0})));
    auto const kink = bound(
        {1, 2},
        [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{max(p[0] * p[1], x[0]) + abs(p[0] * p[1] - x[0])};
        },
        every_state);
    CHECK(is_symmetry(kink, scaling({1, -1})));
    CHECK_FALSE(is_symmetry(kink, scaling({1, 1})));
}

TEST_CASE("equal bounds do not make uncertain constants equal") {
    auto const model =
        support::model_of({1, 4}, [](auto const&, auto const& x, auto const& p, auto const&) {
            return std::vector{p[2] * p[0] * x[0] + p[3] * p[1] * x[0]};
        });
    auto const with_constants = [&](interval const& a, interval const& b) {
        return bind(model, {{"p0", "p1"}, {{"p2", a}, {"p3", b}}}, {});
    };
    auto const wide = support::between(1, 2);
    CHECK_FALSE(is_symmetry(with_constants(wide, wide), translation({1, -1})));
    CHECK(is_symmetry(with_constants(interval(1.5), interval(1.5)), translation({1, -1})));
    CHECK_FALSE(is_symmetry(with_constants(interval(1.5), interval(2.5)), translation({1, -1})));
}

TEST_CASE("the hovercraft with its inertias unknown") {
    sampled_signal const samples({0, 1}, {0, 0}, interpolation::linear);
    auto const craft = bind(record_model(hovercraft{}), {{"Sg", "L", "Iz", "D33", "Sv", "m"}, {}},
                            {samples, samples});
    std::vector<int> const rest(6, 0);
    CHECK(is_symmetry(craft, scaling({1, -1, 0, 0, 0, 0}, rest)));
    CHECK(is_symmetry(craft, scaling({1, 0, 1, 1, 0, 0}, rest)));
    CHECK_FALSE(is_symmetry(craft, scaling({1, 0, 1, 0, 0, 0}, rest)));
    CHECK_FALSE(is_symmetry(craft, scaling({0, 0, 0, 0, 1, 1}, rest)));
    CHECK_FALSE(is_symmetry(craft, translation({1, -1, 0, 0, 0, 0}, rest)));
}

TEST_CASE("what is called a symmetry changes no simulated trajectory") {
    draws d(631);
    int claimed = 0;
    for (int round = 0; round < 400; ++round) {
        // Sums of terms p_a^e p_b^f x or of them without x.
        struct term {
            std::size_t a, b;
            int e, f;
            bool with_state;
        };
        std::vector<term> terms;
        for (std::size_t k = 0, n = 1 + d.below(3); k < n; ++k) {
            terms.push_back({d.below(3), d.below(3), static_cast<int>(1 + d.below(2)),
                             static_cast<int>(d.below(3)), d.coin()});
        }
        auto const rate = [&terms](auto const&, auto const& x, auto const& p, auto const&) {
            auto sum = x[0] * 0;
            for (auto const& q : terms) {
                auto term = q.e == 1 ? p[q.a] * 1 : p[q.a] * p[q.a];
                if (q.f == 1) term = term / p[q.b];
                if (q.f == 2) term = term + p[q.b];
                sum = q.with_state ? sum - term * x[0] : sum + term;
            }
            return std::vector{sum};
        };
        auto const model = bound({1, 3}, rate, every_state);
        model_motion motion{d.coin() ? motion_kind::scaling : motion_kind::translation, {}, {0}};
        for (int j = 0; j < 3; ++j) motion.parameters.push_back(static_cast<int>(d.below(3)) - 1);
        if (motion.parameters == std::vector{0, 0, 0} || !is_symmetry(model, motion)) continue;
        ++claimed;
        support::extended_state here, there;
        double const s = d.uniform(0.1, 0.4);
        for (std::size_t j = 0; j < 3; ++j) {
            double const p = d.uniform(0.5, 1.5);
            double const w = motion.parameters[j] * s;
            here.push_back(p);
            there.push_back(motion.kind == motion_kind::scaling ? p * std::exp(w) : p + w);
        }
        auto const end = [&](support::extended_state const& p) {
            return support::reference_states(rate, {1}, p, 0, {0.7}, {}, 1e-14L)[0][0];
        };
        auto const a = end(here), b = end(there);
        REQUIRE(std::abs(a - b) <= 1e-9L * (1 + std::abs(a)));
    }
    CHECK(claimed > 20);
}
