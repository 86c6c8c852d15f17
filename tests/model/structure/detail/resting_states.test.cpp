// SPDX-License-Identifier: MIT
#include <sivid/model/structure/detail/resting_states.hpp>

#include "support/catch.hpp"
#include "support/formulas.hpp"
#include "support/models.hpp"

#include <sivid/enclosure/taylor/parametric_flow.hpp>
#include <sivid/model/bound_model.hpp>

#include <cmath>
#include <type_traits>
#include <vector>

using namespace sivid;
using support::draws;
using support::model_of;

namespace {

interval const point_zero(0.0);

/// Which states rest, without inputs.
std::vector<bool> rests(recorded_model const& m, box const& starts, box const& parameters) {
    auto const bound = bind(m, {support::all_constants(parameters.size()), {}}, {});
    return resting_states(bound.g, bound.rate, {{}, starts, parameters, {}});
}
template <class Rate>
bool second_rests(Rate const& second, interval const& start = point_zero) {
    auto const m = model_of({2, 1}, [&](auto const& t, auto const& x, auto const& p, auto const&) {
        return std::vector<std::decay_t<decltype(x[0])>>{x[0] - p[0], second(t, x, p)};
    });
    return rests(m, box{interval(1.0), start}, box{interval(0.5, 2.0)})[1];
}

} // namespace

TEST_CASE("states rest where their rates are zero as long as they do") {
    CHECK(second_rests([](auto const&, auto const& x, auto const&) { return -abs(x[1]) * x[1]; }));
    CHECK(second_rests([](auto const&, auto const& x, auto const& p) {
        return sin(x[1]) * x[0] / p[0] + x[1] / sqrt(sqr(x[0]) + sqr(x[1]) + 0.25);
    }));
    CHECK(second_rests([](auto const&, auto const& x, auto const&) { return x[1] - 1; },
                       interval(1.0)));
    CHECK(second_rests([](auto const&, auto const& x, auto const&) { return x[1] * sign(x[0]); }));
    CHECK(second_rests([](auto const& t, auto const& x, auto const&) { return x[1] * exp(t); }));
    CHECK_FALSE(second_rests([](auto const&, auto const& x, auto const&) { return x[1] - 1; }));
    CHECK_FALSE(second_rests([](auto const&, auto const& x, auto const&) { return x[1]; },
                             interval(0.0, 1e-300)));
    CHECK_FALSE(second_rests([](auto const&, auto const& x, auto const&) { return x[1] + x[0]; }));
    // 0.1 is no double: what is 0 in floating point need not be.
    CHECK_FALSE(second_rests(
        [](auto const&, auto const& x, auto const&) {
            using T = std::decay_t<decltype(x[1])>;
            return x[1] - T(1) / T(10);
        },
        interval(0.1)));
}

TEST_CASE("a state does not rest where another solution leaves the same start") {
    // x' = sqrt |x| has t^2/4 beside 0; x' = 2 x/t has c t^2; x' = sign x has t.
    CHECK_FALSE(
        second_rests([](auto const&, auto const& x, auto const&) { return sqrt(abs(x[1])); }));
    CHECK_FALSE(second_rests([](auto const&, auto const& x, auto const&) {
        return sqrt(sqr(x[1]) + sqr(x[0])) * x[1] - sqrt(abs(x[1])) * x[0];
    }));
    CHECK_FALSE(
        second_rests([](auto const& t, auto const& x, auto const&) { return 2 * x[1] / t; }));
    CHECK_FALSE(second_rests([](auto const&, auto const& x, auto const&) { return x[1] / x[0]; }));
    CHECK_FALSE(second_rests([](auto const&, auto const& x, auto const&) { return sign(x[1]); }));
    CHECK_FALSE(
        second_rests([](auto const&, auto const& x, auto const&) { return x[1] * log(x[0]); }));
}

TEST_CASE("states that hold each other rest together, and one that moves wakes the others") {
    auto const m = model_of({3, 0}, [](auto const&, auto const& x, auto const&, auto const&) {
        return std::vector{x[1], x[2], -x[0]};
    });
    using pattern = std::vector<bool>;
    CHECK(rests(m, box{point_zero, point_zero, point_zero}, {}) == pattern{true, true, true});
    CHECK(rests(m, box{point_zero, point_zero, interval(1.0)}, {}) == pattern{false, false, false});
    CHECK(rests(m, box{point_zero, point_zero, interval(-1.0, 1.0)}, {}) ==
          pattern{false, false, false});
}

// Random formulas g and (x_1 - s) g: wherever a state is said to rest, its rate is 0 there and
// grows at most in proportion to how far it has moved.
TEST_CASE("random rates of states that rest are zero and Lipschitz") {
    std::size_t rest = 0, all = 0;
    for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
        draws d(seed);
        auto const f = support::random_formula(d, 1 + d.below(7), false);
        bool const factor = d.coin();
        double const starts[] = {0, 1, -0.5};
        double const s = starts[d.below(3)];
        auto const rate = [&](auto const& t, auto const& x, auto const& p) {
            using value = std::decay_t<decltype(x[0])>;
            auto const leaf = [&](operation op, std::size_t i) -> value {
                if (op == operation::time) return value(t);
                return op == operation::state ? x[i] : p[i];
            };
            auto const g = support::value<value>(f, leaf);
            return factor ? g * (x[1] - s) : g;
        };
        box const parameters{interval(0.5, 2.0), interval(-1.0, 1.0)};
        std::vector<bool> found;
        try {
            auto const m =
                model_of({2, 2}, [&](auto const& t, auto const& x, auto const& p, auto const&) {
                    return std::vector{x[0] + p[0], rate(t, x, p)};
                });
            found = rests(m, box{interval(0.0, 1.0), interval(s)}, parameters);
        } catch (std::domain_error const&) {
            continue;
        }
        ++all;
        if (!found[1]) continue;
        ++rest;
        for (int sample = 0; sample < 10; ++sample) {
            std::vector<double> const p{d.uniform(0.5, 2), d.uniform(-1, 1)};
            double const t = d.uniform(0, 2), other = d.uniform(-2, 2);
            auto const at = [&](double moved) { return rate(t, std::vector{other, s + moved}, p); };
            CAPTURE(seed, sample);
            REQUIRE(at(0) == 0);
            // s + moved is exact for these.
            double const near = std::abs(at(0x1p-40)) * 0x1p40,
                         far = std::abs(at(0x1p-14)) * 0x1p14;
            if (std::isfinite(near) && std::isfinite(far)) REQUIRE(near <= 1e3 * (far + 1));
        }
    }
    CHECK(rest > all / 20);
    CHECK(rest < all);
}

TEST_CASE("a flow for given runs has numbers for states that rest and inputs that never change") {
    // x1' = u1 - |x1| x1 with u1 = 0: the kink at rest would cost steps of first order.
    auto const m =
        model_of({2, 1, 2}, [](auto const&, auto const& x, auto const& p, auto const& u) {
            using value = std::decay_t<decltype(x[0])>;
            return std::vector<value>{u[0] - p[0] * x[0] + x[1], u[1] - abs(x[1]) * x[1]};
        });
    parameter_choice const choice{{"p0"}, {}};
    std::vector<signal> const inputs{sampled_signal({0, 1, 2}, {1, 2, 1}, interpolation::linear),
                                     sampled_signal({0, 1, 2}, {0, 0, 0}, interpolation::hold)};
    region_of_runs const runs{box{interval(1.0), point_zero}, box{interval(0.5, 1.5)}};
    flow const whole(m, choice, inputs), folded(m, choice, inputs, runs);
    CHECK(folded.sampled_inputs() == std::vector<std::size_t>{0});
    CHECK(folded.model().g.is(folded.model().rate[1], 0));
    CHECK_FALSE(folded.sensitive(0, 1));
    CHECK(whole.sensitive(0, 1));

    // Steps until time 2; more than 2000 where a run does not get there.
    auto const steps = [&](flow const& f) -> std::size_t {
        parametric_flow<taylor_model<double>> run(f, {}, 3, 2);
        run.begin(0, runs.starts, runs.parameters);
        std::size_t taken = 0;
        while (run.set().time < 2) {
            if (!run.step(2) || ++taken > 2000) return 5000;
        }
        CHECK(run.set().hull()[1].lower() <= 0);
        CHECK(run.set().hull()[1].upper() >= 0);
        // p0 = 1: t + e^-t until 1, then 4 - t + (e^-1 - 2) e^(1-t).
        CHECK(contains(run.set().hull()[0], 2 + std::exp(-2.0) - 2 * std::exp(-1.0)));
        return taken;
    };
    auto const with = steps(whole), without = steps(folded);
    INFO(with << " steps with the kink, " << without << " without");
    CHECK(without < 40);
    CHECK(with > 5 * without);

    // Another start, or an input that is known up to an error alone: nothing rests.
    region_of_runs const awake{box{interval(1.0), interval(0.0, 0.1)}, runs.parameters};
    CHECK_FALSE(flow(m, choice, inputs, awake)
                    .model()
                    .g.is(flow(m, choice, inputs, awake).model().rate[1], 0));
    auto uncertain = inputs;
    uncertain[1] = sampled_signal({0, 1}, {0, 0}, interpolation::hold, {0.01, 0.01});
    flow const pushed(m, choice, uncertain, runs);
    CHECK_FALSE(pushed.model().g.is(pushed.model().rate[1], 0));
    CHECK(pushed.sampled_inputs() == std::vector<std::size_t>{0, 1});
}
